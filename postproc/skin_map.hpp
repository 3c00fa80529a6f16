// Pressure and displacement of the skin as a map, and how far one map is from an exact answer or from another map.
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <limits>
#include <vector>

namespace snug::postproc {

/// What skin.csv holds; a row a node of the skin.
struct SkinMap {
  std::vector<Eigen::Vector3d> nodes;         ///< reference positions, m
  std::vector<Eigen::Vector3d> displacement;  ///< m
  std::vector<double> pressure;               ///< Pa
  std::vector<double> coverage;               ///< 0..1
};

/// Reads skin.csv. Throws input::InputError with file and line.
SkinMap read_skin_map(const std::filesystem::path& file);

/// Heights between which nodes are compared, m.
struct Zone {
  double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
};

/// Relative errors over the nodes of the zone that the garment covers by half or more; NaN where there are none.
/// Pressures over the exact pressure (or the other map's mean), displacements over the exact radial displacement (or
/// the other map's rms).
struct MapError {
  double pressure_rms = std::numeric_limits<double>::quiet_NaN(), pressure_max = pressure_rms,
         displacement_rms = pressure_rms;
  long nodes = 0;
};

/// Against a pressure (Pa) and a displacement away from the z axis (m) that are the same everywhere. Displacements
/// count by their radial part, as the exact answer does.
MapError error_against(const SkinMap& map, const Zone& zone, double pressure, double radial_displacement);

/// Against a finer map on another mesh, interpolated to the nodes of `map`.
MapError error_against(const SkinMap& map, const Zone& zone, const SkinMap& finer);

/// Pressure (Pa) and displacement (m) of a map at a reference position on or near the skin, by the quadratic that
/// fits the sixteen nearest nodes best in the tangent plane, weighted by distance (moving least squares: Lancaster &
/// Salkauskas, Math. Comp. 37 (1981) 141-158). Exact for quadratic fields on a flat skin. Needs sixteen nodes.
Eigen::Vector4d interpolate(const SkinMap& map, const Eigen::Vector3d& position);

}  // namespace snug::postproc
