#include "postproc/report/skin_chart.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "postproc/report/limbs.hpp"

namespace snug::postproc::report {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d area_vector(const Skin& skin, const Triangle& t) {
  return 0.5 * (skin.nodes[t[1]] - skin.nodes[t[0]]).cross(skin.nodes[t[2]] - skin.nodes[t[0]]);
}

/// Columns: two directions across and the axis. A tube's normals are across its axis, and they cancel; a flat skin's
/// normals are its third direction.
struct Frame {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  bool tube = true, upright = true;
};

Frame frame_of(const Skin& skin) {
  Vector3d sum = Vector3d::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  double area = 0.0;
  for (const Triangle& t : skin.triangles) {
    const Vector3d a = area_vector(skin, t);
    if (!(a.norm() > 0.0)) continue;
    sum += a, area += a.norm();
    spread += a * a.transpose() / a.norm();
  }
  Frame frame;
  frame.tube = sum.norm() < 0.5 * area;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  frame.upright = frame.tube ? spread(2, 2) < 0.25 * area : std::abs(sum.z()) > 0.9 * sum.norm();
  if (frame.upright) return frame;  // the usual frame: x to the side, y to the front, z up
  const Vector3d third = frame.tube ? Vector3d(solver.eigenvectors().col(0)) : sum.normalized();
  const Vector3d helper = std::abs(third.z()) < 0.9 ? Vector3d::UnitZ() : Vector3d::UnitX();
  const Vector3d first = helper.cross(third).normalized();
  frame.axes << first, third.cross(first), third;
  return frame;
}

/// Middle of the skin at a height: the centroid of its section's area, at heights sampled over all of it, linear between these.
class CentreLine {
 public:
  /// Of all the skin (limb 0) or one limb of it, `limb_of` by node. A limb is closed as far up as its nodes reach with all triangles that one of them is in.
  CentreLine(const std::vector<Vector3d>& nodes, const std::vector<Triangle>& triangles, const std::vector<int>& limb_of, int limb) {
    double low = std::numeric_limits<double>::max(), high = -low;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (limb == 0 || limb_of[n] == limb) low = std::min(low, nodes[n].z()), high = std::max(high, nodes[n].z());
    if (!(high > low)) return;
    std::vector<double> height;
    for (int s = 0; s < samples; ++s) height.push_back(low + std::clamp(s / (samples - 1.0), inside, 1.0 - inside) * (high - low));
    std::vector<Section> sections(samples);
    for (const Triangle& t : triangles) {
      if (limb > 0 && std::none_of(t.begin(), t.end(), [&](int n) { return limb_of[n] == limb; })) continue;
      const auto [from, to] = std::minmax({nodes[t[0]].z(), nodes[t[1]].z(), nodes[t[2]].z()});
      for (auto z = std::upper_bound(height.begin(), height.end(), from); z != height.end() && *z <= to; ++z)
        sections[z - height.begin()].push_back(cut(nodes, t, *z));
    }
    for (int s = 0; s < samples; ++s)
      if (!sections[s].empty()) middles_.push_back(at_height(centroid(sections[s]), height[s]));
  }

  Vector2d at(double z) const {
    if (middles_.empty()) return Vector2d::Zero();
    if (z <= middles_.front().z()) return middles_.front().head<2>();
    for (std::size_t i = 0; i + 1 < middles_.size(); ++i) {
      const Vector3d &a = middles_[i], &b = middles_[i + 1];
      if (z <= b.z()) return (a + (b - a) * ((z - a.z()) / std::max(b.z() - a.z(), 1e-12))).head<2>();
    }
    return middles_.back().head<2>();
  }

 private:
  using Side = std::array<Vector2d, 2>;
  using Section = std::vector<Side>;
  static constexpr int samples = 65;
  static constexpr double inside = 1e-6;  // of the height: a section through the nodes of an end may be open

  static Vector3d at_height(const Vector2d& middle, double z) { return {middle.x(), middle.y(), z}; }

  /// Where a triangle that reaches from below z to z or above meets it.
  static Side cut(const std::vector<Vector3d>& nodes, const Triangle& t, double z) {
    Side side;
    int ends = 0;
    for (int i = 0; i < 3; ++i) {
      const Vector3d &a = nodes[t[i]], &b = nodes[t[(i + 1) % 3]];
      if ((a.z() < z) != (b.z() < z)) side[ends++] = (a + (b - a) * ((z - a.z()) / (b.z() - a.z()))).head<2>();
    }
    return side;
  }

  /// Of the triangles between the sides and their middle, in whichever sense each side runs: of all sections that can be seen whole from there.
  static Vector2d centroid(const Section& section) {
    Vector2d middle = Vector2d::Zero(), moment = Vector2d::Zero();
    double length = 0.0, area = 0.0;
    for (const auto& [a, b] : section) length += (b - a).norm(), middle += (b - a).norm() * 0.5 * (a + b);
    if (!(length > 0.0)) return section.front()[0];
    middle /= length;
    for (const Side& side : section) {
      const Vector2d a = side[0] - middle, b = side[1] - middle;
      const double part = 0.5 * std::abs(a.x() * b.y() - a.y() * b.x());
      area += part, moment += part * (a + b) / 3.0;
    }
    return area > 0.0 ? Vector2d(middle + moment / area) : middle;
  }

  std::vector<Vector3d> middles_;
};

/// Limbs are slit on their inner sides and laid out with their outer sides below those of the trunk, half as wide: front at 45 and 135 deg.
double on_map(double angle, int limb) { return limb == 0 ? angle : limb == 1 ? 0.5 * angle : 90.0 + 0.5 * wrapped(angle, 0.0); }

}  // namespace

double wrapped(double angle, double from) { return angle - 360.0 * std::floor((angle - from) / 360.0); }

SkinChart skin_chart(const Skin& skin) {
  const Frame frame = frame_of(skin);
  std::vector<Vector3d> nodes;
  for (const Vector3d& x : skin.nodes) nodes.push_back(frame.axes.transpose() * x);
  SkinChart chart;
  chart.tube = frame.tube, chart.upright = frame.upright;
  if (!chart.tube) {
    for (const Vector3d& x : nodes) chart.at.push_back(x.head<2>());
    return chart;
  }
  chart.limb = limbs_of(nodes, skin.triangles);
  const auto line = [&](int limb) { return CentreLine(nodes, skin.triangles, chart.limb, limb); };
  const std::array<CentreLine, 3> centre = {line(0), line(1), line(2)};
  double radii = 0.0;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const Vector2d across = nodes[n].head<2>() - centre[chart.limb[n]].at(nodes[n].z());
    radii += across.norm();
    chart.angle.push_back(std::atan2(across.y(), across.x()) * 180.0 / std::numbers::pi);
    chart.at.emplace_back(on_map(chart.angle.back(), chart.limb[n]), nodes[n].z());
  }
  chart.girth = 2.0 * std::numbers::pi * radii / static_cast<double>(nodes.size());
  return chart;
}

}  // namespace snug::postproc::report
