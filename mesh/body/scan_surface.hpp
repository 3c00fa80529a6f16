// The surface of a scan in the frame of the body.
#pragma once

#include <string>
#include <vector>

#include "cases/input/body_spec.hpp"
#include "mesh/formats/triangle_surface.hpp"

namespace snug::mesh {

struct ScanSurface {
  TriangleSurface surface;         ///< m, x side, y front, z up
  Eigen::Matrix3d to_body;         ///< turns the file's axes
  double unit = 1.0;               ///< m a unit of the file
  std::vector<std::string> said;   ///< what was guessed
  std::vector<Eigen::Vector3d> before;  ///< m, the vertices of a standard body before it got other girths; empty: it has its own
};

/// Reads the surface of `spec` and turns its axes; a unit that is left out is guessed from the size. Throws input::InputError: no such file, up
/// and front along one axis, unit not positive.
ScanSurface read_scan_surface(const input::ScanSpec& spec, const input::Location& where);

/// The landmarks that come with a standard body where its skin has them now: each goes with the nearest vertex.
std::vector<input::LocationSpec> on_skin(std::vector<input::LocationSpec> locations, const ScanSurface& scan);

}  // namespace snug::mesh
