#include <algorithm>

#include "cases/input/case.hpp"
#include "cases/input/case_checks.hpp"
#include "cases/input/echo.hpp"
#include "cases/input/job_checks.hpp"
#include "cases/input/overrides.hpp"
#include "cases/input/paths.hpp"
#include "cases/input/reader.hpp"
#include "cases/input/standard_body.hpp"

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

/// Thresholds are enough: nobody is asked then.
void complete_comfort(Table& root) {
  Value* comfort = root.find("comfort");
  if (Table* table = comfort ? comfort->table() : nullptr; table && !table->find("curves") && table->find("thresholds"))
    table->set("curves", {table->where, std::string("none")});
}

std::vector<std::string> keys_of_jobs() {
  std::vector<std::string> keys;
  Jobs jobs;
  Jobs::describe(jobs, [&](const Field& field, const auto&) { keys.push_back(field.key); });
  return keys;
}

/// The sections of the jobs alone.
Jobs jobs_of(const Table& root, Diagnostics& diagnostics, const ReadRules& rules) {
  Table sections{.where = root.where, .entries = {}};
  for (const std::string& key : keys_of_jobs())
    if (const Value* value = root.find(key)) sections.set(key, *value);
  return read<Jobs>(sections, diagnostics, rules);
}

}  // namespace

Jobs read_jobs(const fs::path& directory, const ReadOptions& options) {
  Diagnostics diagnostics;
  Table root = parse_case(directory, diagnostics);
  diagnostics.throw_if_any();
  apply_overrides(root, options.overrides, diagnostics);
  const Jobs jobs = jobs_of(root, diagnostics, {.directory = directory, .allow_outside = options.allow_outside});
  diagnostics.throw_if_any();
  return jobs;
}

std::string echo_text(const Jobs& jobs) {
  Jobs alone = jobs;
  alone.variants.clear();
  return jobs.target || !jobs.sensors.empty() ? "\n" + to_toml(to_table(alone)) : "";
}

Case read_case(const fs::path& directory, const ReadOptions& options) {
  Diagnostics diagnostics;
  Table root = parse_case(directory, diagnostics);
  diagnostics.throw_if_any();  // without a document every key would be missing
  apply_overrides(root, options.overrides, diagnostics);
  complete_comfort(root);
  const ReadRules rules{.directory = directory, .allow_outside = options.allow_outside};
  ReadRules of_case = rules;
  of_case.also_known = keys_of_jobs();
  Case description = read<Case>(root, diagnostics, of_case);
  description.directory = directory;
  complete(description, root);
  if (const Table* body = root.table("body"); body && description.body) use_standard_body(*description.body, *body, options.bodies, diagnostics);
  if (description.comfort) check_files(*description.comfort, rules, diagnostics);
  check_case(description, root, diagnostics);
  check_jobs(jobs_of(root, diagnostics, rules), description, root, diagnostics);
  diagnostics.throw_if_any();
  return description;
}

}  // namespace snug::input
