// Frictionless bands on smooth rigid surfaces whose tension is known in closed form (reference book 3).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/verification/book.hpp"
#include "tests/verification/strip.hpp"

namespace {

using namespace snug;
using tests::Strip;

using std::numbers::pi;

solver::PathSettings settings_for(const mesh::GarmentMesh& mesh) {
  solver::PathSettings settings;
  settings.newton.penetration = 1e-6 * mesh.mean_edge;
  return settings;
}

struct Ellipse {
  double a = 0.060, b = 0.040;
  Eigen::Vector3d at(double t, double z) const { return {a * std::cos(t), b * std::sin(t), z}; }
  double speed(double t) const { return std::hypot(a * std::sin(t), b * std::cos(t)); }
  double curvature(double t) const { return a * b / std::pow(speed(t), 3); }
};

// Without friction the tension of a band is the same all along and presses with tension times curvature: 50 N/m on the
// ellipse with the semi-axes 60 and 40 mm give 1875 Pa at the end of the long axis and 555.56 Pa at that of the short one.
TEST(SmoothBand, PressesAnEllipseWithTensionTimesCurvature) {
  const Ellipse ellipse;
  const double from = -pi / 3.0, span = 7.0 * pi / 6.0;
  const int fine = 20000;
  std::vector<double> arc(fine + 1, 0.0);  // length from the start at evenly spaced parameters
  for (int i = 0; i < fine; ++i) arc[i + 1] = arc[i] + ellipse.speed(from + (i + 0.5) * span / fine) * span / fine;
  const auto parameter = [&](double s) {
    const auto it = std::upper_bound(arc.begin() + 1, arc.end() - 1, s);
    const auto i = it - arc.begin() - 1;
    return from + span / fine * (i + (s - arc[i]) / (arc[i + 1] - arc[i]));
  };
  Strip s;
  s.cells = 140, s.friction = 0.0, s.rest_length = arc.back() / 1.05;  // 1000 N/m x 0.05
  mesh::GarmentMesh band = tests::strip_mesh(s);
  for (std::size_t n = 0; n < band.placed.size(); ++n)
    band.placed[n] = ellipse.at(parameter(1.05 * band.pattern[n].x()), band.pattern[n].y());
  mesh::BodyMesh body = tests::cylinder_skin(0.05, tests::strip_width(s), s.skin_cell * band.mean_edge);
  for (Eigen::Vector3d& x : body.nodes) x = ellipse.at(std::atan2(x.y(), x.x()), x.z());
  solver::Scene scene = tests::strip_scene(s, band, body);
  const solver::Layout& layout = scene.layout();
  solver::State start = tests::placed_state(layout, body, band);
  start.load = 1.0;
  start.values.tail(layout["contact"].count).setConstant(1000.0);
  const auto path = solver::follow_path(scene, start, [](solver::State&, double) {}, settings_for(band), [](const auto&) {});
  ASSERT_TRUE(path.complete) << path.message;
  const auto& contact = *scene.find<solver::Contact>();
  double major = 0.0, minor = 0.0, near_major = 1.0, near_minor = 1.0;
  for (int node = 0; node < layout["garment"].count; ++node) {
    const int i = contact.multiplier_of(node);
    if (i < 0 || std::abs(band.pattern[node].y()) > 1e-12) continue;
    const Eigen::Vector3d x = path.state.values.segment<3>(layout["garment"](node));
    const double t = std::atan2(x.y() / ellipse.b, x.x() / ellipse.a), p = path.state.values[layout["contact"](i)] / 1.05;
    if (std::abs(t) < near_major) near_major = std::abs(t), major = p;
    if (std::abs(t - 0.5 * pi) < near_minor) near_minor = std::abs(t - 0.5 * pi), minor = p;
  }
  tests::book("band on an ellipse", "pressure at the end of the long axis, Pa", major, 1875.0, 1e-2, "T A / B^2, reference book 3");
  tests::book("band on an ellipse", "pressure at the end of the short axis, Pa", minor, 555.55555556, 1e-2, "T B / A^2, reference book 3");
}

// Two panels sewn to a ring on a frictionless cylinder share one tension, and their seams slide to where both carry it.
TEST(SmoothBand, TwoPanelsInSeriesShareTheirTension) {
  const double radius = 0.050, l1 = 0.160, l2 = 0.100, k1 = 500.0, k2 = 1500.0;
  Strip s;
  s.radius = radius, s.span = 2.0 * pi, s.rest_length = l1 + l2, s.cells = 130;
  const int columns = 2 * s.cells + 1, seam = 2 * 80;  // 80 cells of 2 mm and 50
  mesh::GarmentMesh ring = tests::strip_mesh(s);
  for (int j = 0; j < 5; ++j) ring.merged[j * columns + columns - 1] = j * columns;
  mesh::GarmentMesh first = ring, second = ring;
  first.triangles.clear(), second.triangles.clear(), first.warp.clear(), second.warp.clear();
  for (const auto& triangle : ring.triangles) {
    int largest = 0;
    for (const int node : triangle) largest = std::max(largest, node % columns);
    auto& panel = largest <= seam ? first : second;
    panel.triangles.push_back(triangle), panel.warp.push_back(Eigen::Vector2d::UnitX());
  }
  const mesh::BodyMesh body = tests::cylinder_skin(radius, tests::strip_width(s), s.skin_cell * ring.mean_edge);
  const solver::Layout layout = tests::make_layout(body, ring, false, true);
  std::vector<int> master(layout.size());
  for (int i = 0; i < layout.size(); ++i) master[i] = i;
  for (int node = 0; node < layout["garment"].count; ++node)
    for (int c = 0; c < 3; ++c) master[layout["garment"](node, c)] = layout["garment"](ring.merged[node], c);
  for (int node = 0; node < layout["garment"].count; ++node) master[layout["garment"](node, 2)] = -1;
  for (int j = 0; j < 5; ++j)  // the ring may not turn
    for (const int node : {j * columns, j * columns + columns - 1}) master[layout["garment"](node, 1)] = -1;
  solver::Scene scene(layout, solver::Numbering(std::move(master)));
  scene.add(std::make_unique<solver::FabricMembrane>("garment", layout["garment"], first, std::vector{tests::straight_fabric(k1, 0.3 * k1)}));
  scene.add(std::make_unique<solver::FabricMembrane>("garment", layout["garment"], second, std::vector{tests::straight_fabric(k2, 0.3 * k2)}));
  scene.add(std::make_unique<solver::Contact>("contact", solver::Interface{layout["contact"], solver::garment_slave(layout["garment"], ring), solver::MasterSurface(layout["body"], body, body.skin_facets)},
                                              k2 / (ring.mean_edge * ring.mean_edge), solver::GapBasis::hat));
  solver::State start = tests::placed_state(layout, body, ring);
  start.load = 1.0;
  start.values.tail(layout["contact"].count).setConstant(3000.0);
  const auto path = solver::follow_path(scene, start, [](solver::State&, double) {}, settings_for(ring), [](const auto&) {});
  ASSERT_TRUE(path.complete) << path.message;
  const Eigen::Vector3d x = path.state.values.segment<3>(layout["garment"](2 * columns + seam));
  const double angle = std::atan2(x.y(), x.x()), arc = angle < 0.0 ? angle + 2.0 * pi : angle;
  const double stretch1 = radius * arc / l1, stretch2 = radius * (2.0 * pi - arc) / l2;
  const char* source = "closed form, reference book 3";
  tests::book("two panels in series", "arc of the first panel, deg", arc * 180.0 / pi, 234.7081053649, 1e-6, source);
  tests::book("two panels in series", "stretch of the first panel", stretch1, 1.2801341312, 1e-6, source);
  tests::book("two panels in series", "stretch of the second panel", stretch2, 1.0933780437, 1e-6, source);
  tests::book("two panels in series", "tension, N/m", k1 * (stretch1 - 1.0), 140.0670655836, 1e-5, source);
}

}  // namespace
