// Skin and garment of a result as triangles, from its grids.
#pragma once

#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace snug::postproc {
struct Grid;
}

namespace snug::postproc::report {

using Triangle = std::array<int, 3>;

/// The skin; its nodes only. Curved facets are cut into plane triangles at all their nodes.
struct Skin {
  std::vector<int> numbers;                          ///< of the nodes, as in skin.csv and the nodal listings
  std::vector<Eigen::Vector3d> nodes, displacement;  ///< reference positions and displacements, m
  std::vector<double> pressure;                      ///< Pa
  std::vector<double> beside;                        ///< Pa, of the contact beside the hems; empty: there are none
  std::vector<double> coverage;                      ///< 0..1
  std::vector<int> location;                         ///< -1: none
  std::vector<std::string> locations;                ///< names
  std::vector<Triangle> triangles;
};

struct Garment {
  std::vector<Eigen::Vector3d> nodes, displacement;  ///< current positions; displacements from the placed shape; m
  std::vector<double> pressure;                      ///< Pa, a node
  std::vector<Triangle> triangles;
  std::vector<double> tension_warp, tension_weft, wrinkled;  ///< N/m; 0 taut, 1 wrinkled, 2 slack; a triangle
};

/// The skin of a body's grid: its `nodes`, and the facets all of whose nodes are among them.
Skin skin_of(const Grid& grid, const std::vector<int>& nodes);
Garment garment_of(const Grid& grid);

/// Facets of the body all of whose nodes are rows of skin.csv. Throws std::runtime_error naming the file that cannot
/// be read, input::InputError for a wrong skin.csv.
Skin read_skin(const std::filesystem::path& vtu, const std::filesystem::path& skin_csv);

Garment read_garment(const std::filesystem::path& vtu);

}  // namespace snug::postproc::report
