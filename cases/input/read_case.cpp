#include <algorithm>

#include "cases/input/case.hpp"
#include "cases/input/case_checks.hpp"
#include "cases/input/overrides.hpp"
#include "cases/input/paths.hpp"
#include "cases/input/reader.hpp"

namespace snug::input {

namespace fs = std::filesystem;

namespace {

/// A curve file that the case names is found beside case.toml; other names are entries of the shipped data.
void resolve_curves(MaterialReference& curves, const ReadRules& rules, Diagnostics& diagnostics) {
  if (fs::path(curves.name).extension() == ".csv")
    curves.name = resolve_path(curves.name, curves.where, rules, diagnostics).string();
}

Table parse_case(const fs::path& directory, Diagnostics& diagnostics) {
  if (fs::is_directory(directory)) return parse_file(directory / "case.toml", diagnostics);
  const bool is_file = fs::exists(directory);
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
  refuse_unavailable(root, diagnostics);
  const ReadRules rules{.directory = directory, .allow_outside = options.allow_outside};
  Case description = read<Case>(root, diagnostics, rules);
  description.directory = directory;
  complete(description, root);
  if (description.comfort) resolve_curves(description.comfort->curves, rules, diagnostics);
  check_case(description, root, diagnostics);
  diagnostics.throw_if_any();
  return description;
}

}  // namespace snug::input
