#include "postproc/recorders.hpp"

#include <sstream>

#include "cases/input/files.hpp"
#include "postproc/store.hpp"
#include "postproc/tables.hpp"

namespace snug::postproc {
namespace {

using Path = std::filesystem::path;

bool always(const Record&) { return true; }
bool has_body(const Record& record) { return record.stored.body_grid.has_value(); }
bool has_skin(const Record& record) { return !record.run.body.skin_facets.empty(); }
bool has_stress(const Record& record) { return record.run.body.fields.has(field::cauchy_stress); }
bool has_displacement(const Record& record) { return record.run.body.fields.has(field::displacement); }
bool has_garment(const Record& record) { return record.stored.garment_grid.has_value(); }
bool has_locations(const Record& record) { return !record.evaluation.locations.empty(); }
bool has_tool(const Record& record) { return !record.run.tools.empty(); }
bool has_movement(const Record& record) { return !record.run.movement.empty() && !record.evaluation.movement.empty(); }
bool has_comfort(const Record& record) { return judges(record.evaluation); }

/// Writes the file whole with what `fill` puts into a stream.
template <class Fill>
void write_text(const Path& file, Fill fill) {
  std::ostringstream out;
  fill(out);
  input::write_file(file, out.view());
}

/// The load parameter that the state has reached.
double reached(const Record& record) { return record.run.history.empty() ? 1.0 : record.run.history.back().load; }

void body_vtu(const Record& record, const Path& file) { write_grid(*record.stored.body_grid, file); }
void body_pvd(const Record& record, const Path& file) { write_series({{reached(record), body_grid_file}}, file); }
void garment_vtu(const Record& record, const Path& file) { write_grid(*record.stored.garment_grid, file); }
void garment_pvd(const Record& record, const Path& file) { write_series({{reached(record), garment_grid_file}}, file); }

void displacements(const Record& record, const Path& file) {
  write_text(file, [&](std::ostream& out) { write_listing(out, displacement_listing(record.run.body)); });
}
void stresses(const Record& record, const Path& file) {
  write_text(file, [&](std::ostream& out) { write_listing(out, stress_listing(record.run.body)); });
}
void nodes(const Record& record, const Path& file) {
  write_text(file, [&](std::ostream& out) { write_listing(out, node_listing(record.run.body)); });
}
void locations(const Record& record, const Path& file) {
  write_text(file, [&](std::ostream& out) { write_locations(out, record.evaluation, record.csv); });
}
void skin(const Record& record, const Path& file) {
  const report::SkinChart chart = report::skin_chart(report::skin_of(*record.stored.body_grid, record.stored.skin_nodes));
  write_text(file, [&](std::ostream& out) { write_skin(out, record.run.body, chart, record.csv); });
}
void comfort(const Record& record, const Path& file) {
  input::write_file(file, text_of(record.stored.comfort));
}
void history(const Record& record, const Path& file) {
  write_text(file, [&](std::ostream& out) { write_history(out, record.run); });
}
void tools(const Record& record, const Path& file) {
  write_text(file, [&](std::ostream& out) { write_tools(out, record.run, record.csv); });
}
void movement(const Record& record, const Path& file) {
  write_text(file, [&](std::ostream& out) { write_movement(out, record.run, record.evaluation, record.csv); });
}
void summary(const Record& record, const Path& file) {
  input::write_file(file, text_of(record.stored.summary));
}

void write_one(const Recorder& recorder, const Record& record, const Path& out) {
  if (recorder.applies(record))
    recorder.write(record, out / recorder.file);
  else
    std::filesystem::remove(out / recorder.file);
}

}  // namespace

const std::vector<Recorder>& recorders() {
  static const std::vector<Recorder> list = {
      {body_grid_file, has_body, body_vtu},          {body_series_file, has_body, body_pvd},
      {garment_grid_file, has_garment, garment_vtu}, {garment_series_file, has_garment, garment_pvd},
      {"nodes.lis", has_body, nodes},           {"displacement.lis", has_displacement, displacements},
      {"stress.lis", has_stress, stresses},     {"locations.csv", has_locations, locations},
      {skin_file, has_skin, skin},
      {comfort_file, has_comfort, comfort},   {history_file, always, history},
      {"tool.csv", has_tool, tools},           {"comfort.csv", has_movement, movement},
      {summary_file, always, summary},
  };
  return list;
}

void write_results(const RunResult& run, const Evaluation& evaluation, const StoredRun& stored, const Path& out, CsvStyle csv) {
  std::filesystem::create_directories(out);
  const Record record{run, evaluation, stored, csv};
  for (const Recorder& recorder : recorders()) write_one(recorder, record, out);
}

void write_results(const RunResult& run, const Evaluation& evaluation, const Path& out, const Provenance& provenance) {
  write_results(run, evaluation, stored_run(run, evaluation, provenance, out), out);
}

}  // namespace snug::postproc
