// report.html: one self-contained page about a run.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "postproc/csv_writer.hpp"

namespace snug::postproc {
struct StoredRun;
}

namespace snug::postproc::report {

/// Pictures of the run in three dimensions, drawn by another program.
struct Pictures {
  std::string png;      ///< the bytes of the image; empty: none
  std::string missing;  ///< why there are none, and the remedy
};

/// The page about a run that stands in memory, or was read (store.hpp).
std::string page(const StoredRun& run, const Pictures& pictures);

/// The page about the results in `out`, without any request to elsewhere. Throws input::InputError when `out` holds no
/// result of a run.
std::string page(const std::filesystem::path& out, const Pictures& pictures);

/// Runs that are set side by side.
struct Comparison {
  struct Run {
    std::filesystem::path out;
    std::string name;  ///< empty: that of the directory
  };
  struct Missing {
    std::string name, message;
  };
  std::vector<Run> runs;
  std::vector<Missing> missing;  ///< that were asked for and have no results, with the reason
  std::string title;             ///< empty: the names of the runs
  std::string axis;              ///< of a sweep: its key with its unit
  std::vector<double> values;    ///< of it, one a run; empty: no numbers were swept
};

/// A page that puts several results side by side: figures and their differences from the first, what differs in the
/// cases, pressures by location, comfort, maps with one scale of colour. Needs one at least; throws as `page` does.
std::string comparison_page(const std::vector<std::filesystem::path>& outs);
std::string comparison_page(const Comparison& comparison);

/// The same as a table for spreadsheets, a row a run: its value or name, status, mean and largest pressure, comfort, locations, sensors (SI).
std::string comparison_table(const Comparison& comparison, CsvStyle style = CsvStyle::comma);

/// One line of a specification: as printed, with its source.
struct ProjectItem {
  std::string name, value, source;
};

/// A run of a project as its page lists it.
struct ProjectVariant {
  std::string name;                    ///< "run 12"
  std::vector<std::string> cells = {}; ///< one a heading
  std::filesystem::path results = {};  ///< empty: nothing to show beyond the row
  bool chosen = false;
};

struct ProjectHeading {
  std::string name;
  bool is_text = false;  ///< to the left
};

struct ProjectView {
  std::string name;
  std::vector<ProjectItem> specification = {};
  std::vector<ProjectHeading> headings = {};
  std::vector<ProjectVariant> variants = {};
  std::string why = {}, decided_by = {};  ///< of the one that is chosen
  std::string left_out = {};              ///< what of the variants is not shown, and why
};

/// The page of a project: its specification, a row a variant, the variants with results side by side as comparison_page has them, the decision.
std::string project_page(const ProjectView& project);

/// The page to browse entities: { "entities": [{ kind, id, parent, own, data: [{ name, printed, unit, source, si, factor }], curves: [{ test, name, x, y,
/// points: [[at, value, beyond]] }] }] }. `si` is null where a datum is no number; `factor` is its unit in SI.
std::string library_page(const std::string& title, const std::string& date, const nlohmann::ordered_json& entities);

}  // namespace snug::postproc::report
