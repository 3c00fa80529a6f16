// What supports, held edges and free motions bear in a state.
#pragma once

#include <optional>

#include "solver/scene/scene.hpp"

namespace snug::solver {

/// What holds a node, by the residual r there (full_residual): a prescribed entry c answers with r_c; an entry that is bound to
/// others of its node by u_c = sum of a_k u_k answers along the line that it holds, with r_c there and -a_k r_c in each k.
/// `first`: the node's x entry. N.
Eigen::Vector3d holding_force(const Scene& scene, const Eigen::VectorXd& residual, int first);

/// What an edge of a garment is held with, N.
Eigen::Vector3d edge_force(const Scene& scene, const Eigen::VectorXd& residual, const mesh::GarmentMesh& garment, const std::string& edge);

/// The share of all loads that is borne by what keeps free parts of the body in place: nothing where their loads balance on the
/// deformed body, too. Empty where nothing is free.
std::optional<double> borne_by_free_motions(const Scene& scene, const State& state);

}  // namespace snug::solver
