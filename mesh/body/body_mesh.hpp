// The layered body as structured Q2 hexahedra with named layers, surfaces and locations.
#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

#include "mesh/body/limb.hpp"

namespace snug::mesh {

/// A solid layer of the body mesh, from the inside out.
struct Layer {
  std::string name;
  input::MaterialReference material;
};

/// A membrane carried by the skin surface.
struct SkinMembrane {
  std::string name;
  input::MaterialReference material;
  double thickness = 0.0;  ///< m
};

/// Nodes are reference positions in the frame of the body (z along the axis, x side, y front), metres.
struct BodyMesh {
  std::vector<Eigen::Vector3d> nodes;
  /// 27 nodes a cell in tensor order: node (i, j, k) stands at 9 k + 3 j + i; i runs round the body, j along the axis,
  /// k outwards, so that the Jacobian is positive and face k = 2 is the outer one.
  std::vector<std::array<int, 27>> cells;
  std::vector<int> cell_layer;  ///< index into `layers`
  std::vector<Layer> layers;
  std::vector<SkinMembrane> membranes;  ///< skin as surface membrane (empty or one)
  /// Outer surface: 9 nodes a facet in tensor order (node (i, j) at 3 j + i); d/di x d/dj points out of the body.
  std::vector<std::array<int, 9>> skin_facets;
  std::vector<int> bone_nodes;                ///< on the rigid bone; empty when the bone is not rigid
  std::vector<int> lower_nodes, upper_nodes;  ///< on the cut planes
  std::vector<std::string> locations;         ///< names of the skin patches
  std::vector<int> node_location;             ///< per node: index into `locations`, -1 for none and for nodes inside
  double mean_skin_cell = 0.0;                ///< m, mean edge length of the skin facets
};

struct QualityRow {
  std::string layer;
  int cells = 0;
  double min_scaled_jacobian = 0.0;
  double mean_scaled_jacobian = 0.0;
  double max_aspect = 0.0;
  double volume = 0.0;  ///< m3
};

/// Meshes the limb through the gmsh API. Throws input::InputError naming layer, angle and height where a cell would
/// invert.
BodyMesh make_body_mesh(const input::BodySpec& spec, const Limb& limb);

/// One row a layer; Jacobians sampled at the 27 Gauss points and the 27 nodes.
std::vector<QualityRow> quality(const BodyMesh& mesh);

}  // namespace snug::mesh
