#include "solver/app/state_files.hpp"

#include <fmt/format.h>

namespace snug::app {

namespace fs = std::filesystem;

namespace {

void list_series(std::vector<postproc::GridStep> steps, const fs::path& out, const char* name) {
  const fs::path series = out / name;
  const auto result = postproc::read_series(series);
  if (steps.empty() || result.empty()) return;
  fs::remove(out / steps.back().file);
  steps.back().file = result.back().file;
  postproc::write_series(steps, series);
}

}  // namespace

void StateFiles::write(double way, const postproc::RunResult& state, const fs::path& out) {
  fs::create_directories(out / "states");
  if (!state.body.skin_facets.empty() || !state.body.cells.empty()) {
    body_.push_back({way, fmt::format("states/body_{:04}.vtu", body_.size())});
    postproc::write_body(state.body, {}, out / body_.back().file);
  }
  if (!state.garment.triangles.empty()) {
    garment_.push_back({way, fmt::format("states/garment_{:04}.vtu", garment_.size())});
    postproc::write_garment(state.garment, out / garment_.back().file);
  }
}

void StateFiles::list(const fs::path& out) {
  list_series(body_, out, "body.pvd");
  list_series(garment_, out, "garment.pvd");
}

}  // namespace snug::app
