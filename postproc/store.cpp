#include "postproc/store.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <unordered_map>

#include "cases/input/csv.hpp"
#include "cases/input/files.hpp"
#include "postproc/tables.hpp"

namespace snug::postproc {

namespace fs = std::filesystem;

namespace {

std::string text_of_file(const fs::path& file) {
  return fs::exists(file) ? input::read_file(file) : std::string();
}

Json read_json(const fs::path& file) {
  try {
    return Json::parse(text_of_file(file));
  } catch (const Json::exception& error) {  // of parsing: also a number beyond the largest
    throw input::InputError({file.string(), 0, 0}, std::string("this is no JSON: ") + error.what(),
                            "run the case again");
  }
}

/// What every run writes, of its kind: a page of less would be empty and look like a result. Throws Json::exception.
void check_summary(const Json& summary) {
  for (const char* key : {"title", "tier", "status", "message"}) summary.at(key).get_ref<const std::string&>();
  for (const char* key : {"numbers", "balance", "unknowns", "plan"}) summary.at(key).get_ref<const Json::object_t&>();
  for (const char* key : {"warnings", "phases"}) summary.at(key).get_ref<const Json::array_t&>();
}

/// What a number outside of an int would become is not defined.
int whole(double value) { return std::abs(value) < 2e9 ? static_cast<int>(value) : 0; }

/// The numbers of a column that an earlier snug may not have written; `none` where there is none or a cell is empty.
std::vector<double> numbers_or(const input::Csv& csv, const char* name, double none) {
  std::vector<double> values(csv.rows.size(), none);
  const int column = csv.find(name);
  for (std::size_t r = 0; column >= 0 && r < values.size(); ++r) {
    const std::string& cell = csv.rows[r].cells[column];
    std::from_chars(cell.data(), cell.data() + cell.size(), values[r]);
  }
  return values;
}

std::vector<Iteration> read_history(const fs::path& file) {
  if (!fs::exists(file) || text_of_file(file) == history_head) return {};  // nothing was iterated
  input::Diagnostics diagnostics;
  const input::Csv csv = input::read_csv(file, diagnostics);
  const auto column = [&](const char* name) { return input::numbers(csv, name, "", diagnostics); };
  const auto increment = column("increment"), load = column("load"), residual = column("residual"),
             complementarity = column("complementarity"), contact = column("contact_nodes");
  const std::vector<std::string> event = input::texts(csv, "event", diagnostics);
  diagnostics.throw_if_any();
  const auto iteration = numbers_or(csv, "iteration", 0.0), step = numbers_or(csv, "step", 0.0), changed = numbers_or(csv, "changed", 0.0),
             energy = numbers_or(csv, "energy_J", std::numeric_limits<double>::quiet_NaN());
  std::vector<Iteration> rows;
  for (std::size_t n = 0; n < load.size(); ++n)
    rows.push_back({.increment = whole(increment[n]), .load = load[n], .iteration = whole(iteration[n]), .residual = residual[n],
                    .complementarity = complementarity[n], .step = step[n], .contact_nodes = whole(contact[n]),
                    .changed = whole(changed[n]), .energy = energy[n], .event = event[n]});
  return rows;
}

fs::path without_trailing_slash(const fs::path& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

/// "thigh-sleeve" for thigh-sleeve/out: every run in its case directory is called out.
std::string name_of(const fs::path& out) {
  const fs::path path = without_trailing_slash(out);
  return path.filename() == "out" ? path.parent_path().filename().string() : path.filename().string();
}

/// Grids do not hold units and meanings; those of fields that are not our own stand in the summary.
void add_meanings(const Json& summary, const char* part, Grid& grid) {
  for (const Json& entry : summary.value("fields", Json::array())) {
    if (entry.at("part").get<std::string>() != part) continue;
    NamedField* field = grid.fields.find(std::string_view(entry.at("name").get_ref<const std::string&>()));
    if (!field) continue;
    field->unit = entry.at("unit").get<std::string>();
    field->description = entry.at("description").get<std::string>();
  }
}

std::vector<int> skin_nodes(const BodyResult& body) {
  std::vector<char> skin(body.nodes.size(), 0);
  for (const auto& facet : body.skin_facets)
    for (const int node : std::span(facet).first(body.facet_nodes)) skin[node] = 1;
  std::vector<int> nodes;
  for (std::size_t n = 0; n < skin.size(); ++n)
    if (skin[n]) nodes.push_back(static_cast<int>(n));
  return nodes;
}

void read_grids(const fs::path& out, StoredRun& run) {
  const std::vector<GridStep> body = read_series(out / body_series_file), garment = read_series(out / garment_series_file);
  if (!body.empty()) run.body_grid = read_grid(out / body.back().file);
  if (run.body_grid && fs::exists(out / skin_file)) run.skin_nodes = read_skin_nodes(out / skin_file, *run.body_grid);
  if (!garment.empty()) run.garment_grid = read_grid(out / garment.back().file);
  if (run.body_grid) add_meanings(run.summary, "body", *run.body_grid);
  if (run.garment_grid) add_meanings(run.summary, "garment", *run.garment_grid);
}

}  // namespace

input::InputError not_as_written(const fs::path& out, const Json::exception& error) {
  return {{(out / summary_file).string(), 0, 0}, std::string("this or comfort.json is not as a run writes it: ") + error.what(), "run the case again"};
}

std::vector<int> read_skin_nodes(const fs::path& file, const Grid& grid) {
  std::unordered_map<int, int> point_of;
  const std::vector<int>* given = grid.fields.find(field::node_number);
  for (std::size_t n = 0; n < grid.points.size(); ++n) point_of.emplace(given ? (*given)[n] : static_cast<int>(n) + 1, static_cast<int>(n));
  input::Diagnostics diagnostics;
  const input::Csv csv = input::read_csv(file, diagnostics);
  const std::vector<double> numbers = input::numbers(csv, "node", "", diagnostics);
  std::vector<int> nodes;
  for (std::size_t r = 0; r < numbers.size(); ++r) {
    const auto found = std::abs(numbers[r]) < 2e9 ? point_of.find(static_cast<int>(numbers[r])) : point_of.end();
    if (found != point_of.end())
      nodes.push_back(found->second);
    else
      diagnostics.error({file.string(), csv.rows[r].line, 1}, "node " + csv.rows[r].cells[csv.find("node")] + " is none of the grid's " + std::to_string(grid.points.size()),
                        "run the case again");
  }
  diagnostics.throw_if_any();
  return nodes;
}

StoredRun stored_run(const RunResult& run, const Evaluation& evaluation, const Provenance& provenance, const fs::path& directory) {
  StoredRun stored;
  stored.name = name_of(directory);
  stored.summary = summary_document(run, evaluation, provenance);
  if (judges(evaluation)) stored.comfort = comfort_document(evaluation);
  for (const Iteration& row : run.history) stored.history.push_back(as_recorded(row));
  if (!run.body.skin_facets.empty() || !run.body.cells.empty()) stored.body_grid = grid_of(run.body, evaluation);
  if (!run.garment.triangles.empty()) stored.garment_grid = grid_of(run.garment);
  stored.skin_nodes = skin_nodes(run.body);
  return stored;
}

StoredRun read_run(const fs::path& out) {
  if (!fs::is_regular_file(out / summary_file))
    throw input::InputError({out.string(), 0, 0}, "there is no summary.json here",
                            "name the directory that a run wrote, such as cases/thigh-sleeve/out");
  StoredRun run;
  run.name = name_of(out);
  run.summary = read_json(out / summary_file);
  try {
    check_summary(run.summary);
    if (fs::exists(out / comfort_file)) run.comfort = read_json(out / comfort_file);
    run.history = read_history(out / history_file);
    run.echo = text_of_file(out / "case.echo.toml");
    run.comparison = text_of_file(out / "comparison.txt");
    read_grids(out, run);
  } catch (const Json::exception& error) {
    throw not_as_written(out, error);
  }
  return run;
}

}  // namespace snug::postproc
