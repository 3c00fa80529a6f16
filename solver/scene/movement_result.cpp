#include "solver/scene/movement_result.hpp"

#include <fmt/format.h>

#include "postproc/evaluate.hpp"
#include "solver/scene/skin_overlap.hpp"

namespace snug::solver {

postproc::MovementState movement_state(const Movement& movement, int posture, double share, const postproc::RunResult& shot, double skin_cell) {
  const auto number = [&](const char* name) {
    const auto it = shot.numbers.find(name);
    return it == shot.numbers.end() ? 0.0 : it->second;
  };
  postproc::MovementState row{.posture = movement.name(posture), .progress = posture == 0 ? 0.0 : posture - 1 + share, .share = share, .bones = {}};
  const mesh::Pose pose = movement.pose(row.progress);
  for (std::size_t b = 0; b < pose.size(); ++b)
    if (const mesh::Bone& bone = movement.skeleton().bones()[b]; bone.joint) row.bones.push_back({bone.name, pose[b].turn, pose[b].shift});
  row.contact_area = number("contact_area_m2"), row.mean_pressure = number("mean_contact_pressure_Pa"), row.max_pressure = number("max_contact_pressure_Pa");
  row.contact_force = shot.balance.contact_force, row.friction_force = shot.balance.friction_force;
  row.force_error = shot.balance.force_error.norm(), row.moment_error = shot.balance.moment_error.norm();
  row.locations = postproc::evaluate(shot, {}).locations;
  row.overlapping_facets = skin_overlap(shot.body, skin_cell);
  return row;
}

void look_at_movement(postproc::RunResult& result) {
  for (const postproc::MovementState& state : result.movement) {
    if (state.overlapping_facets == 0) continue;
    result.numbers["overlapping_skin_facets"] = state.overlapping_facets;
    result.warnings.push_back({.name = "the skin overlaps itself",
                               .text = fmt::format("at {:.0f} % of the way to the posture \"{}\" {} facets of the skin lie behind others that face them; skin does not touch skin here, so that from there on the fold is "
                                                   "too deep and what presses in it is not known",
                                                   100.0 * state.share, state.posture, state.overlapping_facets),
                               .place = {},
                               .remedy = "read the postures before it, turn less, or let the joint go over along more (blend)",
                               .quantity = "overlapping_skin_facets",
                               .value = static_cast<double>(state.overlapping_facets),
                               .limit = 0.0});
    return;
  }
}

}  // namespace snug::solver
