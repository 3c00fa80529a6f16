// Body and garment as files for ParaView (VTU, PVD). SI units.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "postproc/evaluate.hpp"
#include "postproc/result.hpp"

namespace snug::postproc {

/// One time step of a series.
struct GridStep {
  double time = 0.0;
  std::filesystem::path file;  ///< VTU, relative to the PVD
};

/// Writes the body: points are the reference positions (ParaView: Warp By Vector with `displacement`); cells are
/// VTK_TRIQUADRATIC_HEXAHEDRON, VTK_HEXAHEDRON or VTK_QUADRATIC_TETRA, or the skin facets of a rigid body.
/// Throws std::runtime_error when the file cannot be written.
void write_body(const BodyResult& body, const Evaluation& evaluation, const std::filesystem::path& vtu);

/// Writes the garment: points are the current positions, cells VTK_QUADRATIC_TRIANGLE; point field `displacement`
/// counts from the placed shape, so that warping by -1 goes back to it.
void write_garment(const GarmentResult& garment, const std::filesystem::path& vtu);

/// A surface of plane triangles with named fields, a value a point or a triangle.
struct SurfaceGrid {
  std::vector<Eigen::Vector3d> points;  ///< m
  std::vector<std::array<int, 3>> triangles;
  std::map<std::string, std::vector<double>> point_fields, cell_fields;
  std::vector<Eigen::Vector3d> displacement;  ///< m, a point field; may be empty
};
void write_surface(const SurfaceGrid& surface, const std::filesystem::path& vtu);

/// Writes the series file that ParaView opens.
void write_series(const std::vector<GridStep>& steps, const std::filesystem::path& pvd);

/// The steps of a series file in their order; none where there is no such file. Throws input::InputError where it
/// names no time, or a file elsewhere.
std::vector<GridStep> read_series(const std::filesystem::path& pvd);

}  // namespace snug::postproc
