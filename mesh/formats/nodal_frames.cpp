#include "mesh/formats/nodal_frames.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace snug::mesh {

namespace {

constexpr double straight = 1e-6;  // rad; angles are printed with as many digits

/// What holds the three displacements or the three rotations of a node, along its axes.
using Held = std::array<std::optional<double>, 3>;

/// The global axis along which a unit vector lies, or -1.
int global_axis(const Eigen::Vector3d& direction) {
  for (int c = 0; c < 3; ++c)
    if (std::abs(direction[c]) > 1.0 - 0.5 * straight * straight) return c;
  return -1;
}

/// What is held in the global frame, and along which of the node's axes else.
struct Turned {
  Held global;
  std::vector<int> oblique;
};
Turned turned(const Held& held, const Eigen::Matrix3d& frame) {
  Turned turned;
  if (held[0] && held[1] && held[2]) {
    const Eigen::Vector3d way = frame * Eigen::Vector3d(*held[0], *held[1], *held[2]);
    for (int c = 0; c < 3; ++c) turned.global[c] = way[c];
    return turned;
  }
  for (int a = 0; a < 3; ++a) {
    if (!held[a]) continue;
    const int axis = global_axis(frame.col(a));
    if (axis < 0) turned.oblique.push_back(a);
    else turned.global[axis] = *held[a] == 0.0 ? 0.0 : *held[a] * (frame(axis, a) > 0.0 ? 1.0 : -1.0);
  }
  return turned;
}

void turn_supports(Model& model, const NodalFrames& frames, const std::string& file, input::Diagnostics& diagnostics) {
  std::map<std::pair<int, int>, Held> in_frame;  // by node, and 0 for displacements, 1 for rotations
  std::erase_if(model.supports, [&](const ModelSupport& support) {
    if (!frames.contains(support.node)) return false;
    in_frame[{support.node, support.component / 3}][support.component % 3] = support.value;
    return true;
  });
  for (const auto& [key, held] : in_frame) {
    const auto [node, rotations] = key;
    const Eigen::Matrix3d& frame = frames.at(node);
    const Turned at = turned(held, frame);
    if (rotations && !at.oblique.empty()) {
      diagnostics.error({file, 0, 0}, fmt::format("the turn of node {} is held about an axis of its own frame that is none of x, y, z", node),
                        "hold the turns about all three axes, or model the part so that its planes of symmetry stand along x, y, z");
      continue;
    }
    for (int c = 0; c < 3; ++c)
      if (at.global[c]) model.supports.push_back({node, 3 * rotations + c, *at.global[c]});
    for (const int a : at.oblique) model.oblique_supports.push_back({node, frame.col(a), *held[a]});
  }
}

void turn_forces(Model& model, const NodalFrames& frames) {
  std::map<int, Eigen::Vector3d> in_frame;
  std::erase_if(model.forces, [&](const ModelForce& force) {
    if (!frames.contains(force.node)) return false;
    in_frame.try_emplace(force.node, Eigen::Vector3d::Zero()).first->second[force.component] += force.value;
    return true;
  });
  for (const auto& [node, force] : in_frame) {
    const Eigen::Vector3d global = frames.at(node) * force;
    for (int c = 0; c < 3; ++c)
      if (std::abs(global[c]) > 1e-14 * force.norm()) model.forces.push_back({node, c, global[c]});
  }
}

}  // namespace

Eigen::Matrix3d frame_of_angles(double thxy, double thyz, double thzx) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  const double degree = std::numbers::pi / 180.0;
  return (AngleAxisd(thxy * degree, Vector3d::UnitZ()) * AngleAxisd(thyz * degree, Vector3d::UnitX()) * AngleAxisd(thzx * degree, Vector3d::UnitY()))
      .toRotationMatrix();
}

bool FrameByPoints::is_one() const { return (cylindrical ? Eigen::Vector3d(b - a) : a.cross(b)).norm() > 0.0; }

Eigen::Matrix3d FrameByPoints::at(const Eigen::Vector3d& node) const {
  const Eigen::Vector3d z = (cylindrical ? Eigen::Vector3d(b - a) : a.cross(b)).normalized(), out = cylindrical ? Eigen::Vector3d(node - a) : a;
  const Eigen::Vector3d across = out - out.dot(z) * z;
  if (!(across.norm() > 1e-12 * (out.norm() + a.norm()))) return Eigen::Matrix3d::Identity();
  Eigen::Matrix3d axes;
  axes << across.normalized(), z.cross(across.normalized()), z;
  return axes;
}

void turn_into_global(Model& model, const NodalFrames& frames, const std::string& file, input::Diagnostics& diagnostics) {
  if (frames.empty()) return;
  turn_supports(model, frames, file, diagnostics);
  turn_forces(model, frames);
}

}  // namespace snug::mesh
