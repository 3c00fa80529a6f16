#include "postproc/report/shown_run.hpp"

#include <stdexcept>

#include "cases/input/diagnostics.hpp"

namespace snug::postproc::report {

bool knows_pressure(const ShownRun& run) { return run.body_grid && run.body_grid->fields.has(field::contact_pressure); }

ShownRun shown(StoredRun run) {
  ShownRun result{std::move(run), {}, {}};
  if (result.body_grid && !result.skin_nodes.empty()) result.skin = skin_of(*result.body_grid, result.skin_nodes);
  if (result.skin && result.skin->triangles.empty()) result.skin.reset();
  if (result.garment_grid) result.garment = garment_of(*result.garment_grid);
  return result;
}

ShownRun read_shown(const std::filesystem::path& directory) {
  StoredRun run = read_run(directory);
  try {
    return shown(std::move(run));
  } catch (const std::runtime_error& error) {
    throw input::InputError({directory.string(), 0, 0}, error.what(), "run the case again");
  }
}

}  // namespace snug::postproc::report
