// Bones as named rigid parts of the body's core, parted by joints, and where they carry what belongs to them.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cases/input/posture_spec.hpp"
#include "mesh/body/body_mesh.hpp"

namespace snug::mesh {

/// How a bone stands against the one that it hangs on.
struct BoneMove {
  double turn = 0.0;                                ///< rad, about the axis of its joint
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< m

  bool moves() const { return turn != 0.0 || !shift.isZero(0.0); }
};
/// A move of every bone, in the order of the skeleton.
using Pose = std::vector<BoneMove>;

/// A hinge. With the signed distance s of a place at rest from the plane through `point` across `direction`, the bone's share of it is
///   w = u^2 (3 - 2 u),  u = s / blend + 1/2 held to [0, 1]:  0 before the joint, 1 beyond it, with a continuous slope.
struct Joint {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();        ///< m
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();        ///< unit vector
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();  ///< unit vector into the bone
  double blend = 0.0;                                     ///< m; 0: the bone is the whole body

  bool everything() const { return blend == 0.0; }
  double distance(const Eigen::Vector3d& rest) const { return direction.dot(rest - point); }
  double share(double distance) const;
  double slope_of_share(double distance) const;  ///< 1/m
  /// p + R(w turn) (x - p) + w shift, and back.
  Eigen::Vector3d placed(const Eigen::Vector3d& x, double share, const BoneMove& move) const;
  Eigen::Vector3d unplaced(const Eigen::Vector3d& x, double share, const BoneMove& move) const;
};

struct Bone {
  std::string name;
  std::optional<Joint> joint;      ///< none: it stays where it is
  std::vector<double> share = {};  ///< of each node of the body, in [0, 1]; empty without a joint
  int parent = -1;                 ///< the bone that it lies within and goes with; -1: none
  input::Location where = {};
};

/// The bones of a body. A place goes with the bones that it has a share in, those that hang on others first, so that the joints of those go along.
class Skeleton {
 public:
  Skeleton() = default;
  /// Throws input::InputError with all errors together: a body without a rigid core, a joint that lies outside, or parts nothing, bones that overlap.
  Skeleton(const std::vector<input::MovingBoneSpec>& specs, const BodyMesh& body);

  const std::vector<Bone>& bones() const { return bones_; }
  /// Index of a bone, -1: there is none.
  int find(const std::string& name) const;
  /// Shares of a node of the body, one a bone.
  std::vector<double> shares_of(int node) const;
  /// A place x (m) that stood so before anything moved, in a pose, and back. `shares`: one a bone.
  Eigen::Vector3d placed(Eigen::Vector3d x, std::span<const double> shares, const Pose& pose) const;
  Eigen::Vector3d unplaced(Eigen::Vector3d x, std::span<const double> shares, const Pose& pose) const;
  /// Smallest volume ratio of the core at its nodes in a pose (1 + (turn a x (X - p) + R^T shift) . d w', a joint), with the bone whose joint it is of.
  struct Squeeze {
    double ratio = 1.0;
    int bone = -1;
    double blend_needed = 0.0;  ///< m, for a ratio of a tenth
  };
  Squeeze squeeze(const Pose& pose, const BodyMesh& body) const;

 private:
  std::vector<Bone> bones_;
  std::vector<int> order_;  ///< bones that hang on others first
};

}  // namespace snug::mesh
