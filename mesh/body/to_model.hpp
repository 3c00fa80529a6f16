// A body with its supports and loads as the model of another program.
#pragma once

#include "mesh/body/body_mesh.hpp"
#include "mesh/formats/model.hpp"

namespace snug::mesh {

/// What acts on a body, in SI, beside what its mesh already says (rotations of a shell).
struct BodyLoads {
  std::vector<HeldComponent> held;
  std::vector<Eigen::Vector3d> forces;  ///< N, one a node; empty: none
  std::vector<FacetPressure> pressures;
};

/// The model in SI. `materials`: one a layer. Quadratic hexahedra become 20-node ones: forces at the nodes that these do
/// not have go to the others with the weights of their shape functions there, so that the work is the same. Nodes keep
/// their numbers; the named surfaces are node sets.
Model model_of(const BodyMesh& body, const std::vector<ModelMaterial>& materials, const BodyLoads& loads);

}  // namespace snug::mesh
