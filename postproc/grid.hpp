// Body and garment as files for ParaView (VTU, PVD). SI units.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "postproc/evaluate.hpp"
#include "postproc/result.hpp"

namespace snug::postproc {

/// One time step of a series.
struct GridStep {
  double time = 0.0;
  std::filesystem::path file;  ///< VTU, relative to the PVD
};

/// What a grid file holds: points, cells with VTK's types and order of nodes, fields with a value a point or a cell, lists of names.
struct Grid {
  std::vector<Eigen::Vector3d> points;  ///< m
  std::vector<unsigned char> types;     ///< VTK's, one a cell
  std::vector<int> nodes, ends;         ///< of all cells; where a cell's end
  Fields fields;
  std::vector<std::pair<std::string, std::vector<std::string>>> names;  ///< "location_names", "layer_names", "piece_names"

  std::size_t cells() const { return types.size(); }
  std::span<const int> nodes_of(std::size_t cell) const {
    const int first = cell == 0 ? 0 : ends[cell - 1];
    return std::span(nodes).subspan(first, ends[cell] - first);
  }
  const std::vector<std::string>* find_names(std::string_view name) const;
};

/// Writes a grid whole. Throws std::runtime_error when it cannot be written or a field does not have a value an entry.
void write_grid(const Grid& grid, const std::filesystem::path& vtu);
/// Reads it back, every number and name as it was written. Throws input::InputError (vtu_file.hpp).
Grid read_grid(const std::filesystem::path& vtu);

/// The body: points are the reference positions (ParaView: Warp By Vector with `displacement`); cells are
/// VTK_TRIQUADRATIC_HEXAHEDRON, VTK_HEXAHEDRON or VTK_QUADRATIC_TETRA, or the skin facets of a rigid body.
Grid grid_of(const BodyResult& body, const Evaluation& evaluation = {});
/// The garment: points are the current positions, cells VTK_QUADRATIC_TRIANGLE; point field `displacement`
/// counts from the placed shape, so that warping by -1 goes back to it.
Grid grid_of(const GarmentResult& garment);

void write_body(const BodyResult& body, const Evaluation& evaluation, const std::filesystem::path& vtu);
void write_garment(const GarmentResult& garment, const std::filesystem::path& vtu);

/// Plane triangles without fields.
Grid surface_grid(std::vector<Eigen::Vector3d> points, const std::vector<std::array<int, 3>>& triangles);

/// Writes the series file that ParaView opens.
void write_series(const std::vector<GridStep>& steps, const std::filesystem::path& pvd);

/// The steps of a series file in their order; none where there is no such file. Throws input::InputError where it
/// names no time, or a file elsewhere.
std::vector<GridStep> read_series(const std::filesystem::path& pvd);

}  // namespace snug::postproc
