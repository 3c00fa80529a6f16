#include "mesh/body/elliptic_outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace snug::mesh {

namespace {

Spline spline_of(const std::vector<Ellipse>& sections, double Ellipse::*member) {
  std::vector<double> z, values;
  for (const Ellipse& section : sections) {
    z.push_back(section.z);
    values.push_back(section.*member);
  }
  return {z, values};
}

}  // namespace

Ellipse ellipse_of_girth(double z, double girth, double width_to_depth, double centre_x, double centre_y) {
  const double major = std::max(width_to_depth, 1.0), minor = std::min(width_to_depth, 1.0);
  const double eccentricity = std::sqrt(std::max(0.0, 1.0 - (minor * minor) / (major * major)));
  const double unit_girth = 4.0 * major * std::comp_ellint_2(eccentricity);  // of the ellipse of half depth 1
  const double half_depth = girth / unit_girth;
  return {z, half_depth * width_to_depth, half_depth, centre_x, centre_y};
}

EllipticOutline::EllipticOutline(const std::vector<Ellipse>& sections)
    : half_width_(spline_of(sections, &Ellipse::half_width)),
      half_depth_(spline_of(sections, &Ellipse::half_depth)),
      centre_x_(spline_of(sections, &Ellipse::centre_x)),
      centre_y_(spline_of(sections, &Ellipse::centre_y)) {}

Eigen::Vector3d EllipticOutline::at(double turn, double z) const {
  const double angle = 2.0 * std::numbers::pi * turn;
  return {centre_x_(z) + half_width_(z) * std::cos(angle), centre_y_(z) + half_depth_(z) * std::sin(angle), z};
}

OutlinePoint EllipticOutline::derivatives(double turn, double z) const {
  const double w = 2.0 * std::numbers::pi, c = std::cos(w * turn), s = std::sin(w * turn);
  const auto a = half_width_.derivatives(z), b = half_depth_.derivatives(z);
  const auto x = centre_x_.derivatives(z), y = centre_y_.derivatives(z);
  return {.x = {x[0] + a[0] * c, y[0] + b[0] * s, z},
          .x_t = {-w * a[0] * s, w * b[0] * c, 0.0},
          .x_z = {x[1] + a[1] * c, y[1] + b[1] * s, 1.0},
          .x_tt = {-w * w * a[0] * c, -w * w * b[0] * s, 0.0},
          .x_tz = {-w * a[1] * s, w * b[1] * c, 0.0},
          .x_zz = {x[2] + a[2] * c, y[2] + b[2] * s, 0.0}};
}

double EllipticOutline::turn_at_angle(double angle, double z) const {
  // (a cos t, b sin t) lies at the angle f with tan f = (b/a) tan t; both are in the same quarter.
  const double turn = std::atan2(half_width_(z) * std::sin(angle), half_depth_(z) * std::cos(angle)) / (2.0 * std::numbers::pi);
  return turn + std::round(angle / (2.0 * std::numbers::pi) - turn);
}

Limb straight_limb(const Ellipse& skin, const Ellipse& bone, double lower, double upper) {
  const auto outline = [&](Ellipse section) {
    std::vector<Ellipse> sections(2, section);
    sections[0].z = lower;
    sections[1].z = upper;
    return std::make_unique<EllipticOutline>(sections);
  };
  return {outline(skin), outline(bone), lower, upper};
}

}  // namespace snug::mesh
