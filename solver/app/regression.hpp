// The result of a run against the tables that the case names in [reference].
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "cases/input/case.hpp"
#include "postproc/comparison.hpp"
#include "postproc/store.hpp"

namespace snug::app {

/// One table of [reference], read, with what may differ.
struct ReferenceTable {
  std::string quantity;  ///< "displacement", "stress"
  postproc::NodalField field;
  std::optional<postproc::ShellSurface> surface;  ///< of shells, that the result is taken from too
  postproc::ComparisonOptions options;
};

/// Reads the tables of [reference]; none when the case has no such section. Throws input::InputError.
std::vector<ReferenceTable> read_references(const input::Case& description);

/// Compares a result with every table. Leaves comparison.txt and difference_<quantity>.vtu (where coordinates are known) in
/// `folder` and the text in `run.comparison`; messages name the result as `shown_as`. Throws input::InputError.
std::vector<postproc::Comparison> compare_with(const std::vector<ReferenceTable>& references, postproc::StoredRun& run,
                                               const std::filesystem::path& folder, const std::filesystem::path& shown_as);

/// One line a column.
std::string verdict_text(const std::vector<postproc::Comparison>& comparisons);

}  // namespace snug::app
