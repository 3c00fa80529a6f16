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
    : vertices_(&body.surface.vertices), stature_(body.stature), scale_(body.scale), layer_(body.stature / 200.0), layers_(201) {
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
    return x.least < -0.024 * scale_ && x.largest > 0.024 * scale_;
  });
}

std::optional<SectionLoop> BodySections::leg(Side side, double z) const {
  constexpr double widest_stance = 0.2;  // an ankle from the middle over the stature; a hand that hangs there is thinner than the thigh beside it
  return largest(at(z), [&](const SectionLoop& loop) {
    const double x = sign_of(side) * loop.centroid.x();
    return x > 0.0 && x < widest_stance * scale_;
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

/// Landmarks of a body that may be a part of one: found from below, each where those before it let it be.
class Search {
 public:
  Search(const BodySections& sections, const BodySurface& body)
      : sections_(sections), body_(body), height_(sections.stature()), scale_(sections.scale()) {}

  Landmarks operator()() {
    find_crotch();
    find_ankle();
    find_armpit();
    find_neck();
    find_girths();
    return marks_;
  }

 private:
  /// Of a whole body feet and knees may touch; of one that is cut nothing is known of its heights.
  void find_crotch() {
    const double from = body_.is_cut() ? 1e-3 * height_ : 0.3 * height_, to = body_.is_cut() ? height_ : 0.6 * height_;
    for (marks_.crotch = from; marks_.crotch < to && !sections_.trunk(marks_.crotch);) marks_.crotch += 0.0012 * scale_;
    if (!(marks_.crotch < to))
      throw InputError(body_.where, body_.is_cut() ? "no section of the skin reaches across the middle of the body" : "the legs of the body do not meet between 0.3 and 0.6 of its height",
                       body_.is_cut() ? "a garment with several openings goes on a trunk, with legs or arms or without, z up and y to the front"
                                      : "give a whole standing body, and the axis of the file that points up");
    marks_.legs = marks_.crotch > from;
    if (!marks_.legs) marks_.crotch = 0.0;
  }

  void find_ankle() {
    if (!marks_.legs) return;
    double cut = 0.0;
    for (std::size_t t = 0; t < body_.surface.triangles.size(); ++t)
      for (const int vertex : body_.surface.triangles[t])
        if (const double z = body_.surface.vertices[vertex].z(); !body_.is_skin(t) && z < marks_.crotch) cut = std::max(cut, z), cut_legs_ = true;
    marks_.ankle = cut;
    if (cut_legs_) return;
    marks_.ankle = 0.035 * scale_;
    double least = std::numeric_limits<double>::max();
    for (double z = 0.035 * scale_; z < 0.12 * scale_; z += 0.0018 * scale_)
      if (const auto leg = sections_.leg(Side::right, z); leg && leg->girth < least) least = leg->girth, marks_.ankle = z;
  }

  /// The armpit is where the trunk's section is 1.2 times wider at once.
  void find_armpit() {
    const double from = !body_.is_cut() ? 0.65 * height_ : marks_.legs ? marks_.crotch + 0.18 * scale_ : 0.02 * scale_;
    const double to = body_.is_cut() ? height_ : 0.9 * height_, step = 0.0012 * scale_;
    double before = 0.0;
    for (double z = from; z < to; z += step) {
      const auto trunk = sections_.trunk(z);
      if (!trunk) continue;
      const Range x = across(*trunk);
      const double width = x.largest - x.least;
      marks_.armpit = z - step, marks_.armpit_half_width = 0.5 * before;
      if (before > 0.0 && width > 1.2 * before) return;
      before = width;
    }
    if (!body_.is_cut())
      throw InputError(body_.where, "the arms of the body are not apart from its trunk between 0.65 and 0.9 of its height",
                       "give a body with its arms held away from the trunk");
    marks_.arms = false;
    marks_.armpit = height_;
  }

  void find_neck() {
    marks_.neck = height_;
    if (!marks_.arms) return;
    const double to = body_.is_cut() ? height_ : 0.95 * height_;
    double least = std::numeric_limits<double>::max();
    for (double z = marks_.armpit + 0.03 * scale_; z < to; z += 0.003 * scale_)
      if (const auto trunk = sections_.trunk(z); trunk && trunk->girth < least) least = trunk->girth, marks_.neck = z;
  }

  void find_girths() {
    const double below_arms = marks_.arms ? marks_.armpit - 0.03 * scale_ : height_;
    marks_.waist_girth = std::numeric_limits<double>::max();
    for (double z = marks_.crotch + 0.012 * scale_; z < marks_.armpit; z += 0.003 * scale_) {
      const auto trunk = sections_.trunk(z);
      if (!trunk) continue;
      const double girth = taped_girth(*trunk);
      if (marks_.legs && z < marks_.crotch + 0.12 * scale_ && girth > marks_.seat_girth) marks_.seat_girth = girth, marks_.seat = z;
      if (z > marks_.crotch + (marks_.legs ? 0.07 * scale_ : 0.0) && z < below_arms && girth < marks_.waist_girth)
        marks_.waist_girth = girth, marks_.waist = z;
      if (marks_.arms && z > marks_.armpit - 0.07 * scale_) marks_.chest_girth = std::max(marks_.chest_girth, girth);
    }
  }

  const BodySections& sections_;
  const BodySurface& body_;
  double height_, scale_;
  bool cut_legs_ = false;
  Landmarks marks_;
};

}  // namespace

double shoulder_top(const BodySurface& body, const Landmarks& marks, double x) {
  constexpr double beside = 0.010;  // m
  double top = 0.0;
  for (const Vector3d& vertex : body.surface.vertices)
    if (std::abs(vertex.x() - x) < beside && vertex.z() < marks.neck) top = std::max(top, vertex.z());
  return top;
}

Landmarks find_landmarks(const BodySections& sections, const BodySurface& body) { return Search(sections, body)(); }

}  // namespace snug::mesh
