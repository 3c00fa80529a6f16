// Two elastic bodies pressed together at a line or a point: Hertz's theory with both sides soft.
// It is linear. Under the book's forces the solids strain by 2.4 and 2.9 %, and the cylinders' peak comes out 4 % lower for
// it. The forces here strain them a tenth as much: they make a tenth of the half width and of the pressure, and answers are
// scaled back. The book has no units: m, Pa.
#include <gtest/gtest.h>

#include "tests/verification/book.hpp"
#include "tests/verification/two_solids.hpp"
#include "tests/verification/wedge.hpp"

namespace snug::tests {
namespace {

constexpr double scale = 10.0, solid_poisson = 0.3;

/// Half of a cylinder round its line of contact, to 16 half widths b along and across the face; `cells` a half width.
Solid cylinder(double b, double slice, int cells, CellKind kind, double side) {
  const double R = 8.0, length = 16.0 * b;
  const Graded along(b / cells, 5 * cells / 4, 8, length), across(b / cells, 3, 10, length);
  Block block;
  block.kind = kind, block.cells = {along.cells(), across.cells(), 1};
  block.map = [=](const Eigen::Vector3d& u) {
    const double x = along(u.x()), sagitta = R - std::sqrt(R * R - x * x), y = across(side > 0.0 ? u.y() : 1.0 - u.y());
    return Eigen::Vector3d(x, side * (y + sagitta * (1.0 - y / length)), slice * u.z());
  };
  return {make_block(block), side > 0.0 ? "bottom" : "top", 200.0, solid_poisson};
}

// Two equal cylinders: half width (from the second moment of the pressure, b^2/4 for an ellipse), peak and profile.
TEST(HertzSolids, TwoEqualCylinders) {
  const double b = 0.68077837 / scale, peak = 9.35135129 / scale, force = 10.0 / (scale * scale), slice = 0.2 * b;
  for (const auto& [kind, name] : {std::pair{CellKind::hex27, "hexahedra"}, {CellKind::tet10, "tetrahedra"}}) {
    TwoSolids cylinders(cylinder(b, slice, 16, kind, -1.0), cylinder(b, slice, 15, CellKind::tet10, 1.0));
    for (const Solid* solid : {&cylinders.master, &cylinders.slave})
      for (const auto& [face, c] : {std::pair{"left", 0}, {"right", 0}, {"front", 2}, {"back", 2}}) cylinders.hold(*solid, face, c);
    cylinders.hold(cylinders.master, "bottom", 1);
    cylinders.press("top", 0.5 * force * slice, 1.5 * b * b / 8.0);
    solver::Scene scene = cylinders.scene();
    ASSERT_EQ(cylinders.solve(scene, 1e-9 * b), solver::Outcome::converged);
    double sum = 0.0, moment = 0.0;
    for (const auto& point : scene.find<solver::Contact>()->point_forces(cylinders.state))
      sum += point.force.y(), moment += point.force.y() * point.x.x() * point.x.x();
    const auto profile = cylinders.profile(b, [](const Eigen::Vector3d& x) { return x.x(); });
    const std::string row = fmt::format("3 Hertz, two equal cylinders, lower of {}", name), source = "Hertz; reference book 3, F/100";
    book(row, "half width b", 2.0 * std::sqrt(moment / sum) * scale, 0.68077837, 1e-2, source);
    book(row, "peak pressure p0", profile.begin()->second * scale, 9.35135129, 1e-2, source);
    book(row, "rms of the profile over p0, to 1.2 b", error_of_ellipse(profile, b, peak), 0.0, 2e-2, source);
  }
}

/// An eighth of a ball round its point of contact, to 16 radii a of it: axis along y, between the planes z = 0 ("back") and
/// x = z ("front").
Solid ball(double a, int cells, int round, double side) {
  const double R = 10.0, length = 16.0 * a;
  const Graded along(a / cells, 5 * cells / 4, 7, length), across(a / cells, 2, 8, length);
  Block block;
  block.kind = CellKind::tet10, block.cells = {along.cells(), across.cells(), round};
  block.map = [=](const Eigen::Vector3d& u) {
    const double r = along(u.x()), sagitta = R - std::sqrt(R * R - r * r), y = across(side > 0.0 ? u.y() : 1.0 - u.y());
    const double angle = 0.25 * std::numbers::pi * u.z();
    return Eigen::Vector3d(r * std::cos(angle), side * (y + sagitta * (1.0 - y / length)), r * std::sin(angle));
  };
  BodyMesh mesh = make_block(block);
  close_at_axis(mesh);
  return {std::move(mesh), side > 0.0 ? "bottom" : "top", 1e3, solid_poisson};
}

// Two equal balls: radius of the contact (from the second moment of the pressure, 2 a^2/5), peak and profile.
TEST(HertzSolids, TwoEqualSpheres) {
  const double a = 0.40866510 / scale, peak = 28.58948173 / scale, force = 10.0 / (scale * scale * scale);
  TwoSolids balls(ball(a, 16, 3, -1.0), ball(a, 15, 2, 1.0));
  for (const Solid* solid : {&balls.master, &balls.slave}) {
    for (const int node : solid->mesh.surface("front")->nodes)
      balls.fixed.master[balls.entry(*solid, node, 2)] = balls.entry(*solid, node, 0);
    balls.hold(*solid, "back", 2), balls.hold(*solid, "left", 0), balls.hold(*solid, "left", 2);
  }
  balls.hold(balls.master, "bottom", 1);
  balls.press("top", force / 8.0, 1.5 * a * a / 10.0);
  solver::Scene scene = balls.scene();
  ASSERT_EQ(balls.solve(scene, 1e-9 * a), solver::Outcome::converged);
  const auto squared = [](const Eigen::Vector3d& x) { return x.x() * x.x() + x.z() * x.z(); };
  double sum = 0.0, moment = 0.0;
  for (const auto& point : scene.find<solver::Contact>()->point_forces(balls.state))
    sum += point.force.y(), moment += point.force.y() * squared(point.x);
  const auto profile = balls.profile(a, [&](const Eigen::Vector3d& x) { return std::sqrt(squared(x)); });
  const std::string row = "3 Hertz, two equal spheres", source = "Hertz; reference book 3, F/1000";
  book(row, "radius a", std::sqrt(2.5 * moment / sum) * scale, 0.40866510, 1e-2, source);
  book(row, "peak pressure p0", profile.begin()->second * scale, 28.58948173, 1e-2, source);
  book(row, "rms of the profile over p0, to 1.2 a", error_of_ellipse(profile, a, peak), 0.0, 2e-2, source);
}

}  // namespace
}  // namespace snug::tests
