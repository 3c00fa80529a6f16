// The recorder of the library: every run with what went into it and what came out of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "materials/database/runs.hpp"
#include "postproc/store.hpp"
#include "solver/app/prepared_case.hpp"

namespace CLI {
class App;
}

namespace snug::app {

struct RecordingOptions {
  bool off = false;
  std::string project, note;

  void declare(CLI::App& app);
};

/// Keys of a section in the order of the file, "garment.fabric.WT", with the values that stand there; entries of lists are
/// called by their names, else by their number. Lists of numbers are left out.
std::vector<materials::RunValue> flattened(const input::Table& table, materials::UnitBook& units);

/// One run. What goes wrong with it is a warning and costs neither the run nor its exit status.
class Recording {
 public:
  /// Looks at the inputs before the solution: they may be edited while it runs. SNUG_RECORD=off in the environment is as
  /// the option.
  Recording(const PreparedCase& prepared, const CaseOptions& options, const RecordingOptions& asked);
  /// Once the results are in their place. Gives what is to be said of it; empty: nothing was recorded.
  std::string finish(const postproc::StoredRun& run, const std::filesystem::path& results);

 private:
  void read_inputs(const PreparedCase& prepared, const CaseOptions& options);
  void name_files(const input::Table& table);
  void keep_file(const std::string& name);
  void inherit(const materials::RunRecord& parent);
  std::int64_t record(const postproc::StoredRun& run, const std::filesystem::path& results);

  bool off_ = false;
  std::filesystem::path directory_;
  materials::RunRecord run_;
  std::vector<materials::LibraryFile> files_;
  std::vector<materials::RunMaterial> named_;  ///< parts and the names that the case has for them
  std::string fault_;                          ///< why it cannot be recorded
};

}  // namespace snug::app
