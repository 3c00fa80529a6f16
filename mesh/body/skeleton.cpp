#include "mesh/body/skeleton.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/body/joints.hpp"

namespace snug::mesh {

namespace {

constexpr double least_ratio = 0.1;  // of the core's volume in the fold of a joint: below it its surface is nearly folded
constexpr double same = 0.99;        // of the nodes of two bones

std::vector<Bone> bones_of(const std::vector<input::MovingBoneSpec>& specs, const BodyMesh& body, input::Diagnostics& errors) {
  std::vector<Bone> bones;
  for (const input::MovingBoneSpec& spec : specs) {
    Bone bone{.name = spec.name, .joint = {}, .where = spec.where};
    if (spec.joint) {
      try {
        FoundJoint found = find_joint(*spec.joint, spec.name, body);
        bone.joint = found.joint, bone.share = std::move(found.share);
      } catch (const input::InputError& error) {
        for (const input::Diagnostic& one : error.errors()) errors.error(one.where, one.found, one.remedy);
      }
    }
    bones.push_back(std::move(bone));
  }
  return bones;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

double common(const Bone& a, const Bone& b) {
  double both = 0.0;
  for (std::size_t n = 0; n < a.share.size(); ++n) both += std::min(a.share[n], b.share[n]);
  return both;
}

/// The bone hangs on the smallest one that it lies within.
void hang(std::vector<Bone>& bones, input::Diagnostics& errors) {
  for (std::size_t b = 0; b < bones.size(); ++b) {
    Bone& bone = bones[b];
    if (bone.share.empty()) continue;
    const double size = sum(bone.share);
    for (std::size_t o = 0; o < bones.size(); ++o) {
      const Bone& other = bones[o];
      if (o == b || other.share.empty()) continue;
      const double other_size = sum(other.share), both = common(bone, other);
      const bool within = both > same * size, contains = both > same * other_size;
      if (within && contains && o < b)
        errors.error(bone.where, fmt::format("the bones \"{}\" and \"{}\" are the same part of the body", other.name, bone.name), "leave one of them out, or move its joint");
      else if (!within && !contains && both > (1.0 - same) * std::min(size, other_size) && o < b)
        errors.error(bone.where, fmt::format("the bones \"{}\" and \"{}\" overlap, and neither lies within the other", other.name, bone.name),
                     "let both reach away from the part that stays where it is (towards, direction)");
      if (within && !contains && (bone.parent < 0 || other_size < sum(bones[bone.parent].share))) bone.parent = static_cast<int>(o);
    }
  }
}

}  // namespace

double Joint::share(double distance) const {
  if (everything()) return 1.0;
  const double u = std::clamp(distance / blend + 0.5, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

double Joint::slope_of_share(double distance) const {
  if (everything()) return 0.0;
  const double u = std::clamp(distance / blend + 0.5, 0.0, 1.0);
  return 6.0 * u * (1.0 - u) / blend;
}

Eigen::Vector3d Joint::placed(const Eigen::Vector3d& x, double share, const BoneMove& move) const {
  if (share == 0.0) return x;
  return point + Eigen::AngleAxisd(share * move.turn, axis) * (x - point) + share * move.shift;
}

Eigen::Vector3d Joint::unplaced(const Eigen::Vector3d& x, double share, const BoneMove& move) const {
  if (share == 0.0) return x;
  return point + Eigen::AngleAxisd(-share * move.turn, axis) * (x - share * move.shift - point);
}

Skeleton::Skeleton(const std::vector<input::MovingBoneSpec>& specs, const BodyMesh& body) {
  if (specs.empty()) return;
  if (body.bone_nodes.empty())
    throw input::InputError(specs.front().where, fmt::format("\"{}\" is a bone, and the body has no rigid core to move", specs.front().name),
                            "let the innermost layer be rigid (material = \"rigid\"), or leave [[bone]] and [[posture]] out");
  input::Diagnostics errors;
  bones_ = bones_of(specs, body, errors);
  errors.throw_if_any();
  hang(bones_, errors);
  errors.throw_if_any();
  const auto depth = [&](int bone) {
    int steps = 0;
    for (int at = bones_[bone].parent; at >= 0; at = bones_[at].parent) ++steps;
    return steps;
  };
  order_.resize(bones_.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return depth(a) > depth(b); });
}

int Skeleton::find(const std::string& name) const {
  const auto it = std::find_if(bones_.begin(), bones_.end(), [&](const Bone& bone) { return bone.name == name; });
  return it == bones_.end() ? -1 : static_cast<int>(it - bones_.begin());
}

std::vector<double> Skeleton::shares_of(int node) const {
  std::vector<double> shares;
  for (const Bone& bone : bones_) shares.push_back(bone.joint ? bone.share[node] : 0.0);
  return shares;
}

Eigen::Vector3d Skeleton::placed(Eigen::Vector3d x, std::span<const double> shares, const Pose& pose) const {
  for (const int b : order_)
    if (bones_[b].joint) x = bones_[b].joint->placed(x, shares[b], pose[b]);
  return x;
}

Eigen::Vector3d Skeleton::unplaced(Eigen::Vector3d x, std::span<const double> shares, const Pose& pose) const {
  for (auto b = order_.rbegin(); b != order_.rend(); ++b)
    if (bones_[*b].joint) x = bones_[*b].joint->unplaced(x, shares[*b], pose[*b]);
  return x;
}

Skeleton::Squeeze Skeleton::squeeze(const Pose& pose, const BodyMesh& body) const {
  Squeeze worst;
  for (std::size_t b = 0; b < bones_.size(); ++b) {
    if (!bones_[b].joint || bones_[b].joint->everything() || !pose[b].moves()) continue;
    const Joint& joint = *bones_[b].joint;
    for (const int node : body.bone_nodes) {
      if (bones_[b].share[node] <= 0.0 || bones_[b].share[node] >= 1.0) continue;
      const Eigen::Vector3d arm = body.nodes[node] - joint.point;
      const double s = joint.distance(body.nodes[node]);
      const Eigen::Vector3d back = Eigen::AngleAxisd(-joint.share(s) * pose[b].turn, joint.axis) * pose[b].shift;
      const double pressed = -(pose[b].turn * joint.axis.cross(arm) + back).dot(joint.direction);  // m
      const double ratio = 1.0 - joint.slope_of_share(s) * pressed;
      if (ratio < worst.ratio) worst.ratio = ratio, worst.bone = static_cast<int>(b);
      if (ratio < least_ratio) worst.blend_needed = std::max(worst.blend_needed, 1.5 * pressed / (1.0 - least_ratio));
    }
  }
  return worst;
}

}  // namespace snug::mesh
