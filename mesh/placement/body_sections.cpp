#include "mesh/placement/body_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using input::InputError;

struct Range {
  double least = std::numeric_limits<double>::max(), largest = std::numeric_limits<double>::lowest();
};

Range across(const SectionLoop& loop) {
  Range range;
  for (const Vector2d& p : loop.points)
    range.least = std::min(range.least, p.x()), range.largest = std::max(range.largest, p.x());
  return range;
}

template <class Wanted>
std::optional<SectionLoop> largest(std::vector<SectionLoop> loops, const Wanted& wanted) {
  std::optional<SectionLoop> result;
  for (SectionLoop& loop : loops)
    if ((!result || loop.girth > result->girth) && wanted(loop)) result = std::move(loop);
  return result;
}

double taped_girth(const SectionLoop& loop) { return closed_length(convex_hull(loop.points)); }

}  // namespace

std::vector<Vector2d> convex_hull(std::vector<Vector2d> points) {
  if (points.size() < 3) return points;
  std::sort(points.begin(), points.end(),
            [](const Vector2d& a, const Vector2d& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Vector2d> hull;
  const auto turns_left = [&](const Vector2d& next) {
    const Vector2d u = hull[hull.size() - 1] - hull[hull.size() - 2], v = next - hull[hull.size() - 2];
    return u.x() * v.y() - u.y() * v.x() > 0.0;
  };
  const auto add = [&](const Vector2d& p, std::size_t least) {
    while (hull.size() > least && !turns_left(p)) hull.pop_back();
    hull.push_back(p);
  };
  for (const Vector2d& p : points) add(p, 1);  // lower chain, then the upper one back (Andrew)
  const std::size_t lower = hull.size();
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) add(*p, lower);
  hull.pop_back();
  return hull;
}

double closed_length(const std::vector<Vector2d>& points) {
  double sum = 0.0;
  for (std::size_t n = 0; n < points.size(); ++n) sum += (points[(n + 1) % points.size()] - points[n]).norm();
  return sum;
}

BodySections::BodySections(const BodySurface& body)
    : vertices_(&body.surface.vertices), stature_(body.stature), layer_(body.stature / 200.0), layers_(201) {
  const auto layer = [&](double z) { return static_cast<std::size_t>(std::clamp(z / layer_, 0.0, 200.0)); };
  for (const auto& t : body.surface.triangles) {
    const auto [low, high] = std::minmax({(*vertices_)[t[0]].z(), (*vertices_)[t[1]].z(), (*vertices_)[t[2]].z()});
    for (std::size_t n = layer(low); n <= layer(high); ++n) layers_[n].push_back(t);
  }
}

std::vector<SectionLoop> BodySections::at(double z) const {
  if (!(z > 0.0) || !(z < stature_)) return {};
  return slice(*vertices_, layers_[static_cast<std::size_t>(z / layer_)], z);
}

std::optional<SectionLoop> BodySections::trunk(double z) const {
  return largest(at(z), [&](const SectionLoop& loop) {
    const Range x = across(loop);
    return x.least < -0.024 * stature_ && x.largest > 0.024 * stature_;
  });
}

std::optional<SectionLoop> BodySections::leg(Side side, double z) const {
  return largest(at(z), [&](const SectionLoop& loop) {
    const double x = sign_of(side) * loop.centroid.x();
    return x > 0.0 && x < 0.12 * stature_;
  });
}

std::optional<std::array<double, 2>> BodySections::between_legs(double z) const {
  const auto left = leg(Side::left, z), right = leg(Side::right, z);
  if (!left || !right) return std::nullopt;
  return std::array{across(*left).largest, across(*right).least};
}

std::optional<SectionLoop> BodySections::arm(Side side, double z, double x) const {
  return largest(at(z), [&](const SectionLoop& loop) { return sign_of(side) * loop.centroid.x() > x; });
}

namespace {

double find_crotch(const BodySections& sections, const input::Location& where) {
  const double height = sections.stature();
  for (double z = 0.3 * height; z < 0.6 * height; z += 0.0012 * height)
    if (sections.trunk(z)) return z;
  throw InputError(where, "the legs of the body do not meet between 0.3 and 0.6 of its height",
                   "give a whole standing body, and the axis of the file that points up");
}

double find_ankle(const BodySections& sections) {
  const double height = sections.stature();
  double ankle = 0.035 * height, least = std::numeric_limits<double>::max();
  for (double z = 0.035 * height; z < 0.12 * height; z += 0.0018 * height)
    if (const auto leg = sections.leg(Side::right, z); leg && leg->girth < least) least = leg->girth, ankle = z;
  return ankle;
}

/// The armpit is where the trunk's section is 1.2 times wider at once.
void find_armpit(const BodySections& sections, const input::Location& where, Landmarks& marks) {
  const double height = sections.stature(), step = 0.0012 * height;
  double before = 0.0;
  for (double z = 0.65 * height; z < 0.9 * height; z += step) {
    const auto trunk = sections.trunk(z);
    if (!trunk) continue;
    const Range x = across(*trunk);
    const double width = x.largest - x.least;
    if (before > 0.0 && width > 1.2 * before) {
      marks.armpit = z - step, marks.armpit_half_width = 0.5 * before;
      return;
    }
    before = width;
  }
  throw InputError(where, "the arms of the body are not apart from its trunk between 0.65 and 0.9 of its height",
                   "give a body with its arms held away from the trunk");
}

double find_neck(const BodySections& sections, double armpit) {
  const double height = sections.stature();
  double neck = 0.9 * height, least = std::numeric_limits<double>::max();
  for (double z = armpit + 0.03 * height; z < 0.95 * height; z += 0.003 * height)
    if (const auto trunk = sections.trunk(z); trunk && trunk->girth < least) least = trunk->girth, neck = z;
  return neck;
}

}  // namespace

double shoulder_top(const BodySurface& body, const Landmarks& marks, double x) {
  constexpr double beside = 0.010;  // m
  double top = 0.0;
  for (const Vector3d& vertex : body.surface.vertices)
    if (std::abs(vertex.x() - x) < beside && vertex.z() < marks.neck) top = std::max(top, vertex.z());
  return top;
}

Landmarks find_landmarks(const BodySections& sections, const input::Location& where) {
  Landmarks marks;
  marks.crotch = find_crotch(sections, where);
  marks.ankle = find_ankle(sections);
  find_armpit(sections, where, marks);
  marks.neck = find_neck(sections, marks.armpit);
  const double height = sections.stature();
  marks.waist_girth = std::numeric_limits<double>::max();
  for (double z = marks.crotch + 0.012 * height; z < marks.armpit; z += 0.003 * height) {
    const auto trunk = sections.trunk(z);
    if (!trunk) continue;
    const double girth = taped_girth(*trunk);
    if (z < marks.crotch + 0.12 * height && girth > marks.seat_girth) marks.seat_girth = girth, marks.seat = z;
    if (z > marks.crotch + 0.07 * height && z < marks.armpit - 0.03 * height && girth < marks.waist_girth)
      marks.waist_girth = girth, marks.waist = z;
    if (z > marks.armpit - 0.07 * height) marks.chest_girth = std::max(marks.chest_girth, girth);
  }
  return marks;
}

}  // namespace snug::mesh
