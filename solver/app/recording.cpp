#include "solver/app/recording.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>

#include "cases/input/files.hpp"
#include "cases/input/overrides.hpp"
#include "materials/database/named.hpp"
#include "materials/database/sha256.hpp"
#include "materials/database/snapshot.hpp"
#include "solver/app/library_commands.hpp"
#include "solver/app/library_file.hpp"

namespace snug::app {

namespace fs = std::filesystem;

using materials::LibraryFile, materials::RunValue;

namespace {

constexpr std::uintmax_t most_kept = 1 << 20;  // bytes of an input that is kept with the run; of larger ones the hash

LibraryFile file_of(const std::string& name, std::string content) {
  return {.hash = materials::sha256(content), .name = "run:" + name, .content = std::move(content)};
}

/// Calls `visit(path, entry)` for every value of a table and of those in it. Tables of a list are told apart by their names, else by their numbers; the only
/// one needs none, as for --set.
template <class Visit>
void walk(const input::Table& table, const std::string& path, const Visit& visit) {
  for (const input::Entry& entry : table.entries) {
    const std::string key = path.empty() ? entry.key : path + "." + entry.key;
    visit(key, entry);
    if (const input::Table* inner = entry.value.table()) walk(*inner, key, visit);
    const std::vector<input::Value>* list = entry.value.array();
    for (std::size_t n = 0; list && n < list->size(); ++n) {
      const input::Table* inner = (*list)[n].table();
      const input::Value* name = inner ? inner->find("name") : nullptr;
      if (inner) walk(*inner, list->size() == 1 ? key : key + "." + (name && name->text() ? *name->text() : std::to_string(n)), visit);
    }
  }
}

/// Every text of a table, those in lists too.
template <class Visit>
void texts_in(const input::Value& value, const Visit& visit) {
  if (const std::string* text = value.text()) visit(*text);
  if (const auto* list = value.array())
    for (const input::Value& one : *list) texts_in(one, visit);
  if (const input::Table* table = value.table())
    for (const input::Entry& entry : table->entries) texts_in(entry.value, visit);
}

bool is_switched_off() {
  const char* switched = std::getenv("SNUG_RECORD");
  return switched && std::string(switched) == "off";
}

std::optional<double> number_at(const postproc::Json& from, const char* key) {
  const auto at = from.is_object() ? from.find(key) : from.end();
  if (!from.is_object() || at == from.end() || !at->is_number()) return std::nullopt;
  return at->get<double>();
}

/// Pressures and ratings by location, comfort, and the numbers of summary.json under their names there.
std::vector<RunValue> results_of(const postproc::StoredRun& run) {
  std::vector<RunValue> results;
  const auto add = [&](const std::string& name, std::optional<double> value, const char* unit) {
    if (value) results.push_back({.name = name, .value = fmt::format("{}", *value), .unit = unit, .number = *value});
  };
  add("comfort", number_at(run.comfort, "score"), "");
  for (const postproc::Json& row : run.summary.value("locations", postproc::Json::array())) {
    const std::string location = row.value("location", "");
    add(location, number_at(row, "mean_pressure_Pa"), "Pa");
    add(location + ", largest", number_at(row, "max_pressure_Pa"), "Pa");
    add(location + ", rating", number_at(row, "rating"), "");
  }
  const postproc::Json numbers = run.summary.value("numbers", postproc::Json::object());
  for (const auto& [name, value] : numbers.items())
    if (value.is_number()) add(name, value.get<double>(), "");
  return results;
}

}  // namespace

void RecordingOptions::declare(CLI::App& app) {
  app.add_option("--project", project, "the project that the run is recorded under (else the name of the case directory)")->type_name("NAME");
  app.add_option("--note", note, "kept with the recorded run")->type_name("TEXT");
  app.add_flag("--no-record", off, "do not record the run in the library (SNUG_RECORD=off: none)");
}

std::vector<RunValue> flattened(const input::Table& table, materials::UnitBook& units) {
  std::vector<RunValue> values;
  walk(table, "", [&](const std::string& key, const input::Entry& entry) {
    double storage = 0.0;
    if (const double* number = entry.value.number(storage)) return values.push_back({.name = key, .value = fmt::format("{}", *number), .number = *number});
    if (const bool* flag = std::get_if<bool>(&entry.value.data)) return values.push_back({.name = key, .value = *flag ? "true" : "false"});
    const std::string* text = entry.value.text();
    if (!text) return;
    RunValue value{.name = key, .value = *text};
    const auto blank = text->find(' ');
    const std::string unit = blank == text->npos ? "" : text->substr(blank + 1);
    if (const auto number = materials::plain_number(text->substr(0, blank)); number && !unit.empty() && units.find(unit))
      value.number = number, value.unit = unit;
    values.push_back(std::move(value));
  });
  return values;
}

Recording::Recording(const PreparedCase& prepared, const CaseOptions& options, const RecordingOptions& asked)
    : off_(asked.off || is_switched_off()) {
  if (off_) return;
  try {
    directory_ = fs::absolute(prepared.description.directory).lexically_normal();
    if (!directory_.has_filename()) directory_ = directory_.parent_path();
    run_.directory = directory_.string(), run_.note = asked.note;
    run_.project = asked.project.empty() ? directory_.filename().string() : asked.project;
    read_inputs(prepared, options);
  } catch (const std::exception& error) {
    fault_ = error.what();
  }
}

void Recording::read_inputs(const PreparedCase& prepared, const CaseOptions& options) {
  input::Diagnostics diagnostics;
  input::Table text = input::parse_file(directory_ / "case.toml", diagnostics);
  input::apply_overrides(text, options.preparation().reading.overrides, diagnostics);
  diagnostics.throw_if_any();
  keep_file("case.toml");
  name_files(text);
  walk(text, "", [&](const std::string& key, const input::Entry& entry) {
    if (entry.value.text() && (entry.key == "fabric" || entry.key == "material")) named_.push_back({key, *entry.value.text(), {}});
  });
  const std::string echo = solver::echo_text(prepared.model);
  name_files(input::table_of(echo));
  run_.echo = materials::sha256(echo);
  files_.push_back(file_of("case.echo.toml", echo));
  std::string all = echo;
  for (const RunValue& file : run_.inputs)
    if (file.name != "case.toml") all += file.name + " " + file.value + "\n";
  run_.case_hash = materials::sha256(all);
}

/// Files of the case directory that a text of the table names.
void Recording::name_files(const input::Table& table) {
  texts_in(input::value_without_place(table), [&](const std::string& text) {
    std::error_code none;
    if (!text.empty() && text.size() < 4096 && text.find('\0') == text.npos && fs::is_regular_file(directory_ / text, none)) keep_file(text);
  });
}

void Recording::keep_file(const std::string& name) {
  if (std::any_of(run_.inputs.begin(), run_.inputs.end(), [&](const RunValue& one) { return one.name == name; })) return;
  LibraryFile file = file_of(name, input::read_file(directory_ / name));
  run_.inputs.push_back({.name = name, .value = file.hash, .unit = "bytes", .number = static_cast<double>(file.content.size())});
  if (file.content.size() <= most_kept) files_.push_back(std::move(file));
}

/// A derived case has its materials written out; those that are still the parent's come from the same entities.
void Recording::inherit(const materials::RunRecord& parent) {
  const auto values_of = [](const materials::RunRecord& run, const std::string& part) {
    std::vector<RunValue> values;
    std::copy_if(run.settings.begin(), run.settings.end(), std::back_inserter(values), [&](const RunValue& one) { return one.name.starts_with(part + "."); });
    return values;
  };
  for (const materials::RunMaterial& one : parent.materials) {
    const bool is_named = std::any_of(run_.materials.begin(), run_.materials.end(), [&](const auto& own) { return own.part == one.part; });
    if (!is_named && values_of(run_, one.part) == values_of(parent, one.part)) run_.materials.push_back(one);
  }
}

std::int64_t Recording::record(const postproc::StoredRun& run, const fs::path& results) {
  const fs::path place = fs::absolute(results).lexically_normal();
  run_.title = run.summary.value("title", ""), run_.status = run.summary.value("status", ""), run_.message = run.summary.value("message", "");
  run_.place = place.string(), run_.proof = materials::sha256(input::read_file(place / postproc::summary_file));
  run_.command = run.summary.value("command", ""), run_.seconds = number_at(run.summary, "seconds").value_or(0.0);
  const postproc::Json versions = run.summary.value("versions", postproc::Json::object());
  for (const auto& [name, value] : versions.items())
    if (value.is_string()) run_.versions.push_back({.name = name, .value = value.get<std::string>()});
  if (run_.status != "failed") run_.results = results_of(run);
  materials::Library library = open_library();
  run_.settings = flattened(input::table_of(run.echo, {"case.echo.toml", 1, 1}), library.units());  // a place keeps the order
  for (const materials::RunMaterial& named : named_)
    if (const auto entity = library.find(named.entity)) {
      files_.push_back(file_of(entity->id + ".json", materials::snapshot(*entity)));
      run_.materials.push_back({named.part, entity->id, files_.back().hash});
    }
  materials::Runs runs(library);
  run_.parent = runs.parent_of(run_.directory);
  if (run_.parent) inherit(runs.run(*run_.parent));
  return runs.record(run_, files_);
}

std::string Recording::finish(const postproc::StoredRun& run, const fs::path& results) {
  if (off_) return {};
  try {
    if (!fault_.empty()) throw std::runtime_error(fault_);
    const std::int64_t number = record(run, results);
    return fmt::format("  recorded           run {} of project {} (snug project show {})\n", number, run_.project, number);
  } catch (const std::exception& error) {
    fmt::print(stderr, "snug: warning: the run is not recorded in the library: {}; --no-record or SNUG_RECORD=off leaves it out\n", error.what());
    return {};
  }
}

}  // namespace snug::app
