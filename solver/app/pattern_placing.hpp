// A pattern placed on a scanned body: what the command prints and writes of it.
#pragma once

#include <filesystem>
#include <string>

#include "mesh/pattern/sewn_mesh.hpp"
#include "mesh/placement/place_garment.hpp"
#include "solver/app/console.hpp"

namespace snug::app {

/// Where the garment goes and how.
struct PlacingRequest {
  std::filesystem::path scan;
  mesh::BodyAxes axes;
  mesh::PlacementOptions options;
  std::filesystem::path out;  ///< folder of garment.vtu, body.vtu and placed.svg
};

/// Places the pattern, prints landmarks, gaps, stretches, times and the acceptance line by line, and writes the shapes
/// in the frame of the body. Throws input::InputError where it cannot be placed, after what there is has been written.
void place_on_scan(const mesh::CheckedPattern& checked, const mesh::SewnMesh& sewn, const PlacingRequest& request, Console& console);

}  // namespace snug::app
