// What a result is measured for, whatever the solver says of it, and what it then warns of.
#pragma once

#include <string>
#include <vector>

#include "postproc/result.hpp"
#include "solver/scene/run.hpp"

namespace snug::solver {

/// Looks at a result with a garment: fabric beyond its data, gathered and slack cloth, cloth off the skin, contact area and mean
/// pressure against what garment and limb let expect, strain of the body. Writes every measure into result.numbers and what
/// exceeds its limit into result.warnings; both stay as they are for a scene without a garment on a mesh.
///
///   fabric_beyond_data_share, fabric_largest_strain, fabric_data_end   of the cloth as worn; the end where the fabric has one
///   gathered_share, largest_gathering       share of the cloth that lies in folds; 1 - stretch / stretch of taut cloth
///   slack_share                             share of the cloth without tension in any direction
///   off_skin_share                          share of the cloth beside the hems that bears nothing
///   contact_area_over_expected              against the placed garment's area on the skin
///   mean_pressure_over_laplace              against tension times curvature on the skin as far as it has given way
///   body_largest_stretch, body_smallest_volume_ratio
void guard(const Model& model, const Meshes& meshes, postproc::RunResult& result);

/// What to try when a run has not converged, from what the case has and where it stopped; one sentence each.
std::vector<std::string> what_to_try(const Model& model, const Meshes& meshes, const postproc::RunResult& result);

}  // namespace snug::solver
