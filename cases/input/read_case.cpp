#include <algorithm>

#include "cases/input/case.hpp"
#include "cases/input/case_checks.hpp"
#include "cases/input/overrides.hpp"
#include "cases/input/paths.hpp"
#include "cases/input/reader.hpp"

namespace snug::input {

namespace fs = std::filesystem;

namespace {

/// A file that [comfort] names must lie in the case directory; other names are entries of the shipped data.
void check_file(const MaterialEntry& reference, const ReadRules& rules, Diagnostics& diagnostics) {
  for (const char* ending : {".csv", ".toml", ".fll", ".fis"})
    if (fs::path(reference.name).extension() == ending)
      resolve_path(reference.name, reference.where, rules, diagnostics);
}

void check_files(const ComfortSpec& comfort, const ReadRules& rules, Diagnostics& diagnostics) {
  check_file(comfort.curves, rules, diagnostics);
  check_file(comfort.fuzzy, rules, diagnostics);
  for (const MaterialEntry& set : comfort.thresholds) check_file(set, rules, diagnostics);
}

Table parse_case(const fs::path& directory, Diagnostics& diagnostics) {
  std::error_code failed;
  if (fs::is_directory(directory, failed)) return parse_file(directory / "case.toml", diagnostics);
  const bool is_file = fs::exists(directory, failed);
  diagnostics.error({directory.string(), 0, 0},
                    is_file ? "this is a file, not a case directory" : "there is no such case directory",
                    is_file ? "name the directory that holds case.toml"
                            : "correct its name, or make one with snug new NAME --like CASE");
  return {};
}

}  // namespace

Case read_case(const fs::path& directory, const ReadOptions& options) {
  Diagnostics diagnostics;
  Table root = parse_case(directory, diagnostics);
  diagnostics.throw_if_any();  // without a document every key would be missing
  apply_overrides(root, options.overrides, diagnostics);
  const ReadRules rules{.directory = directory, .allow_outside = options.allow_outside};
  Case description = read<Case>(root, diagnostics, rules);
  description.directory = directory;
  complete(description, root);
  if (description.comfort) check_files(*description.comfort, rules, diagnostics);
  check_case(description, root, diagnostics);
  diagnostics.throw_if_any();
  return description;
}

}  // namespace snug::input
