#include "postproc/report/run_files.hpp"

#include <cmath>

#include "cases/input/csv.hpp"
#include "cases/input/files.hpp"
#include "postproc/grid.hpp"

namespace snug::postproc::report {

namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& file) {
  return fs::exists(file) ? input::read_file(file) : std::string();
}

Json read_json(const fs::path& file) {
  try {
    return Json::parse(text_of(file));
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

std::vector<HistoryRow> read_history(const fs::path& file) {
  if (!fs::exists(file)) return {};
  input::Diagnostics diagnostics;
  const input::Csv csv = input::read_csv(file, diagnostics);
  const auto column = [&](const char* name) { return input::numbers(csv, name, "", diagnostics); };
  const auto increment = column("increment"), load = column("load"), residual = column("residual"),
             complementarity = column("complementarity"), contact = column("contact_nodes");
  const std::vector<std::string> event = input::texts(csv, "event", diagnostics);
  diagnostics.throw_if_any();
  std::vector<HistoryRow> rows;
  for (std::size_t n = 0; n < load.size(); ++n)
    rows.push_back({whole(increment[n]), load[n], residual[n], complementarity[n], whole(contact[n]), event[n]});
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

}  // namespace

input::InputError not_as_written(const fs::path& out, const Json::exception& error) {
  return {{(out / "summary.json").string(), 0, 0}, std::string("this or comfort.json is not as a run writes it: ") + error.what(), "run the case again"};
}

RunFiles read_run(const fs::path& out) {
  if (!fs::is_regular_file(out / "summary.json"))
    throw input::InputError({out.string(), 0, 0}, "there is no summary.json here",
                            "name the directory that a run wrote, such as cases/thigh-sleeve/out");
  RunFiles run;
  run.name = name_of(out);
  run.summary = read_json(out / "summary.json");
  try {
    check_summary(run.summary);
  } catch (const Json::exception& error) {
    throw not_as_written(out, error);
  }
  if (fs::exists(out / "comfort.json")) run.comfort = read_json(out / "comfort.json");
  run.history = read_history(out / "history.csv");
  run.echo = text_of(out / "case.echo.toml");
  run.comparison = text_of(out / "comparison.txt");
  try {
    const std::vector<GridStep> body = read_series(out / "body.pvd"), garment = read_series(out / "garment.pvd");
    if (!body.empty() && fs::exists(out / "skin.csv"))
      run.skin = read_skin(out / body.back().file, out / "skin.csv");
    if (run.skin && run.skin->triangles.empty()) run.skin.reset();
    if (!garment.empty()) run.garment = read_garment(out / garment.back().file);
  } catch (const std::runtime_error& error) {
    if (dynamic_cast<const input::InputError*>(&error)) throw;
    throw input::InputError({out.string(), 0, 0}, error.what(), "run the case again");
  }
  return run;
}

}  // namespace snug::postproc::report
