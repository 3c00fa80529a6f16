// From a state to plain result data.
#pragma once

#include "postproc/result.hpp"
#include "solver/scene/scene.hpp"

namespace snug::solver {

/// Reference geometry, names and zero fields of the body (skin only when `cells` is false).
postproc::BodyResult body_result(const mesh::BodyMesh& mesh, bool cells);

/// Adds a garment's nodes, triangles and part behind those that are there.
void append(const mesh::GarmentMesh& mesh, postproc::GarmentResult& result);

/// Named edges of a garment as sides of its triangles: those whose mid-edge node is a node of the edge. `alone`: it is the only one;
/// `garment`: its number; `first`: its first node in the result.
void add_named_edges(const mesh::GarmentMesh& mesh, bool alone, int garment, int first, std::vector<postproc::GarmentEdge>& edges);

/// Fills displacement, stress, contact samples, skin pressure, garment fields, balance and `numbers` from the state.
void fill_result(const Scene& scene, const State& state, const Model& model, const Meshes& meshes, postproc::RunResult& result);

/// Tier L0: the pressure by the law of Laplace, where the body has it, is that of the contact.
void show_laplace(postproc::BodyResult& body);

/// Name of a garment's edge among the reactions.
std::string edge_name(const Model& model, const mesh::GarmentMesh& garment, const std::string& edge);

/// Counts a force that acts on the garment at `at` and, opposite, on the skin. On a rigid skin its support answers.
void add_action(const Eigen::Vector3d& force, const Eigen::Vector3d& at, bool deformable, postproc::Balance& balance);

}  // namespace snug::solver
