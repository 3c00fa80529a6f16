// The states of a load path as a film: key frames read back, in-between frames made, a series written.
#pragma once

#include <cstddef>
#include <filesystem>

namespace snug::postproc::animation {

struct FilmSettings {
  double step = 0.0;      ///< m, no point moves farther between two frames; 0: as many frames as there may be
  std::size_t most = 60;  ///< frames
};

struct Film {
  std::size_t keys = 0, frames = 0;
  double widest = 0.0;  ///< m, the largest way of a point between two frames
};

/// Reads the states that body.pvd and garment.pvd in `out` list and writes skin.pvd and garment.pvd with their frames
/// into `folder`: shape, contact pressure, coverage and tension, in SI. In between pressures stay non-negative. Throws
/// input::InputError when `out` lists fewer than two states.
Film make_film(const std::filesystem::path& out, const std::filesystem::path& folder, const FilmSettings& settings);

}  // namespace snug::postproc::animation
