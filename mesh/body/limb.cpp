#include "mesh/body/limb.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/body/outlines.hpp"
#include "mesh/body/scan.hpp"
#include "mesh/body/stations.hpp"

namespace snug::mesh {

namespace {

constexpr int section_samples = 256;  // the trapezoidal rule on a smooth periodic section converges exponentially

std::vector<Eigen::Vector3d> sample_section(const Outline& outline, double z, int samples) {
  std::vector<Eigen::Vector3d> points(samples);
  for (int i = 0; i < samples; ++i) points[i] = outline.at(static_cast<double>(i) / samples, z);
  return points;
}

/// Even-odd rule in the horizontal plane.
bool inside_section(const std::vector<Eigen::Vector3d>& section, const Eigen::Vector3d& point) {
  bool inside = false;
  for (std::size_t i = 0, j = section.size() - 1; i < section.size(); j = i++) {
    const auto &a = section[i], &b = section[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y())) inside = !inside;
  }
  return inside;
}

}  // namespace

OutlinePoint Outline::derivatives(double turn, double z) const {
  // Fourth-order differences; a step of 1e-3 turns balances truncation against round-off at about 1e-10.
  const double t = 1e-3;
  const Eigen::Vector3d x = at(turn, z);
  const auto first = [&](auto f, double h) -> Eigen::Vector3d {
    return (8.0 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12.0 * h);
  };
  const auto second = [&](auto f, double h) -> Eigen::Vector3d {
    return (16.0 * (f(h) + f(-h)) - (f(2 * h) + f(-2 * h)) - 30.0 * x) / (12.0 * h * h);
  };
  const auto round = [&](double d) { return at(turn + d, z); };
  const auto up = [&](double d) { return at(turn, z + d); };
  OutlinePoint point;
  point.x = x;
  point.x_t = first(round, t);
  const double h = t * point.x_t.norm();  // a length of the section's own scale
  point.x_z = first(up, h);
  point.x_tt = second(round, t);
  point.x_zz = second(up, h);
  point.x_tz = first([&](double d) { return first([&](double e) { return at(turn + e, z + d); }, t); }, h);
  return point;
}

double Outline::turn_at_angle(double angle, double) const { return angle / (2.0 * std::numbers::pi); }

Eigen::Vector3d outward_normal(const Outline& outline, double turn, double z) {
  const OutlinePoint p = outline.derivatives(turn, z);
  return p.x_t.cross(p.x_z).normalized();  // round counter-clockwise x up = outwards
}

Eigen::Vector2d section_centre(const Outline& outline, double z) {
  // Green's theorem on the polygon of samples, relative to the first point against cancellation.
  const auto points = sample_section(outline, z, section_samples);
  const Eigen::Vector2d origin = points[0].head<2>();
  double area = 0.0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (int i = 0; i < section_samples; ++i) {
    const Eigen::Vector2d a = points[i].head<2>() - origin;
    const Eigen::Vector2d b = points[(i + 1) % section_samples].head<2>() - origin;
    const double cross = a.x() * b.y() - a.y() * b.x();
    area += cross / 2.0;
    moment += cross * (a + b) / 6.0;
  }
  return origin + moment / area;
}

Eigen::Vector3d Limb::skin_normal(double turn, double z) const { return outward_normal(*skin, turn, z); }

double Limb::girth(double z) const {
  double sum = 0.0;
  for (int i = 0; i < section_samples; ++i)
    sum += skin->derivatives(static_cast<double>(i) / section_samples, z).x_t.norm();
  return sum / section_samples;
}

Eigen::Vector2d Limb::skin_curvature(double turn, double z) const {
  // Normal curvature II(d, d) / I(d, d) with the fundamental forms of the parametrisation (t, z).
  const OutlinePoint p = skin->derivatives(turn, z);
  const Eigen::Vector3d n = p.x_t.cross(p.x_z).normalized();
  const double l = -p.x_tt.dot(n), m = -p.x_tz.dot(n), k = -p.x_zz.dot(n);
  const double e = p.x_t.dot(p.x_t), f = p.x_t.dot(p.x_z), g = p.x_z.dot(p.x_z);
  const double a = -f / e;  // the direction (a, 1) is at right angles to (1, 0)
  return {l / e, (a * a * l + 2.0 * a * m + k) / (a * a * e + 2.0 * a * f + g)};
}

std::vector<GirthRow> girth_table(const Limb& limb, int rows) {
  std::vector<GirthRow> table(std::max(rows, 2));
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double z = limb.lower + (limb.upper - limb.lower) * static_cast<double>(i) / (table.size() - 1.0);
    const auto points = sample_section(*limb.skin, z, section_samples);
    const auto extent = [&](int axis) {
      const auto by_axis = [axis](const auto& a, const auto& b) { return a[axis] < b[axis]; };
      const auto [low, high] = std::minmax_element(points.begin(), points.end(), by_axis);
      return (*high)[axis] - (*low)[axis];
    };
    table[i] = {z, limb.girth(z), extent(0), extent(1)};
  }
  return table;
}

void check_bone_inside(const Limb& limb, const input::Location& where) {
  constexpr int heights = 101, turns = 180;
  for (int j = 0; j < heights; ++j) {
    const double z = limb.lower + (limb.upper - limb.lower) * j / (heights - 1.0);
    const auto skin = sample_section(*limb.skin, z, turns);
    for (int i = 0; i < turns; ++i) {
      const double turn = static_cast<double>(i) / turns;
      if (inside_section(skin, limb.bone->at(turn, z))) continue;
      throw input::InputError(
          where,
          fmt::format("the bone is outside the skin at height {:.1f} mm, angle {:.0f} deg (layers cross)", 1e3 * z,
                      360.0 * turn),
          "make the bone's girth smaller or move its centre towards the middle of the section");
    }
  }
}

Limb make_limb(const input::BodySpec& spec) {
  if (spec.kind == input::BodyKind::stations) return spec.stations.extension() == ".json" ? limb_from_outlines(spec) : limb_from_stations(spec);
  if (spec.kind == input::BodyKind::scan) return limb_from_scan(spec);
  throw input::InputError(spec.where, fmt::format("the body is of kind \"{}\", which has no outlines", text_of(spec.kind)),
                          "write \"stations\" or \"scan\"");
}

}  // namespace snug::mesh
