// A joint as a case describes it, found on the body's mesh.
#pragma once

#include <string>
#include <vector>

#include "cases/input/posture_spec.hpp"
#include "mesh/body/skeleton.hpp"

namespace snug::mesh {

struct FoundJoint {
  Joint joint;
  std::vector<double> share;  ///< of each node of the body
};

/// The bone `name` is what hangs together beyond the joint: of limbs side by side the one that the point lies in. Throws input::InputError with the joint's place: no such
/// cut, no direction, a point outside the body, a joint with nothing of the core on one of its sides.
FoundJoint find_joint(const input::JointSpec& spec, const std::string& name, const BodyMesh& body);

}  // namespace snug::mesh
