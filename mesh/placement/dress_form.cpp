#include "mesh/placement/dress_form.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>

namespace snug::mesh {

namespace {

using Eigen::Vector3d;
using Path = std::vector<Vector3d>;

constexpr double bin_size = 0.02;  // m
constexpr double beyond = 10.0;    // m, where a line ends, far from all cloth

Vector3d centre(const SectionLoop& loop, double z) { return {loop.centroid.x(), loop.centroid.y(), z}; }

/// Down the trunk to a height, from above the head.
Path down_trunk(const DressForm& form, double to) {
  const double step = 0.006 * form.body.scale;
  Path path;
  for (double z = form.body.stature - step; z > to; z -= step)
    if (const auto trunk = form.sections.trunk(z)) {
      if (path.empty()) path.emplace_back(trunk->centroid.x(), trunk->centroid.y(), beyond);
      path.push_back(centre(*trunk, z));
    }
  return path;
}

/// Through the shoulder, just above the armpit, down the middles of the arm's sections and off to the side.
Path out_of_arm(const DressForm& form, Side side) {
  if (!form.marks.arms) return {};
  const double step = 0.006 * form.body.scale, over = form.marks.armpit + 2.0 * step;
  Path path = down_trunk(form, over);
  for (double z = form.marks.armpit - step; z > 0.0; z -= step) {
    const auto arm = form.sections.arm(side, z, form.marks.armpit_half_width);
    if (!arm) break;
    if (z + 1.5 * step > form.marks.armpit) path.push_back(centre(*arm, over));
    path.push_back(centre(*arm, z));
  }
  if (!path.empty()) path.emplace_back(sign_of(side) * beyond, path.back().y(), path.back().z());
  return path;
}

Path out_of_leg(const DressForm& form, Side side) {
  const double step = 0.006 * form.body.scale;
  Path path = down_trunk(form, form.marks.crotch + step);
  for (double z = form.marks.crotch - step; z > form.marks.ankle; z -= step)  // none without legs
    if (const auto leg = form.sections.leg(side, z)) path.push_back(centre(*leg, z));
  if (!path.empty()) path.emplace_back(path.back().x(), path.back().y(), -beyond);
  return path;  // without legs: out of the trunk's lower end
}

/// Linking number of a closed line with one from far away to far away: how often that passes through the fan of
/// triangles from the closed line's middle.
int linking_number(const Path& loop, const Path& path) {
  const Vector3d middle =
      std::accumulate(loop.begin(), loop.end(), Vector3d(Vector3d::Zero())) / static_cast<double>(loop.size());
  int sum = 0;
  for (std::size_t n = 0; n < loop.size(); ++n)
    for (std::size_t k = 1; k < path.size(); ++k)
      sum += crossing(path[k - 1], path[k], {middle, loop[n], loop[(n + 1) % loop.size()]});
  return sum;
}

}  // namespace

DressForm::DressForm(BodySurface surface, double cell)
    : body(std::move(surface)),
      sections(body),
      marks(find_landmarks(sections, body)),
      distance(body.surface, cell),
      bins(body.surface.vertices, body.surface.triangles, bin_size) {}

double winding_number(const TriangleSurface& surface, const Vector3d& p) {
  double sum = 0.0;
  for (const auto& t : surface.triangles) {
    const Vector3d a = surface.vertices[t[0]] - p, b = surface.vertices[t[1]] - p, c = surface.vertices[t[2]] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4.0 * std::numbers::pi);
}

double LimbSection::off(const Eigen::Vector2d& p) const { return (p - loop.centroid).norm() - 0.5 * loop.girth / std::numbers::pi; }

std::vector<LimbSection> limbs_at(const DressForm& form, double z) {
  std::vector<LimbSection> limbs;
  const auto add = [&](BodyPart part, std::optional<SectionLoop> loop) {
    if (loop) limbs.push_back({part, std::move(*loop)});
  };
  if (z < form.marks.crotch) {
    add(BodyPart::right_leg, form.sections.leg(Side::right, z));
    add(BodyPart::left_leg, form.sections.leg(Side::left, z));
    return limbs;
  }
  add(BodyPart::trunk, form.sections.trunk(z));
  if (!form.marks.arms || z >= form.marks.armpit) return limbs;
  add(BodyPart::right_arm, form.sections.arm(Side::right, z, form.marks.armpit_half_width));
  add(BodyPart::left_arm, form.sections.arm(Side::left, z, form.marks.armpit_half_width));
  return limbs;
}

std::optional<LimbSection> limb_at(const DressForm& form, const Vector3d& p) {
  std::vector<LimbSection> limbs = limbs_at(form, p.z());
  if (limbs.empty()) return std::nullopt;
  const Eigen::Vector2d at = p.head<2>();
  return std::move(*std::min_element(limbs.begin(), limbs.end(), [&](const auto& a, const auto& b) { return a.off(at) < b.off(at); }));
}

LimbPaths::LimbPaths(const DressForm& form)
    : paths_{out_of_arm(form, Side::right), out_of_arm(form, Side::left), out_of_leg(form, Side::right),
             out_of_leg(form, Side::left)} {}

BodyPart LimbPaths::enclosed_by(const Path& loop) const {
  std::array<int, 4> links{};
  for (std::size_t n = 0; n < paths_.size(); ++n) links[n] = linking_number(loop, paths_[n]);
  const int sign = links[0] + links[1] + links[2] + links[3] < 0 ? -1 : 1;
  for (int& link : links) link *= sign;
  using Links = std::array<int, 4>;
  if (links == Links{1, 1, 1, 1}) return BodyPart::neck;
  if (links == Links{0, 0, 1, 1}) return BodyPart::trunk;
  if (links == Links{1, 0, 0, 0}) return BodyPart::right_arm;
  if (links == Links{0, 1, 0, 0}) return BodyPart::left_arm;
  if (links == Links{0, 0, 1, 0}) return BodyPart::right_leg;
  if (links == Links{0, 0, 0, 1}) return BodyPart::left_leg;
  return BodyPart::nothing;
}

}  // namespace snug::mesh
