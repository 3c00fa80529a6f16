// The obstacle problem of a stretched membrane over a shallow dome (reference book 3).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/stepping/load_path.hpp"
#include "solver/terms/contact.hpp"
#include "solver/terms/fabric_membrane.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/press.hpp"

namespace snug::tests {
namespace {

/// u >= psi = sqrt(1 - r^2), Laplace's equation where the membrane is free, u = A ln(2/r) on the square's border, which is
/// the exact solution outside r*: r*^2 (1 - ln(r*/2)) = 1.
constexpr double contact_radius = 0.697965148223374, coefficient = 0.680259411891717, at_one = 0.471519893402110,
                 contact_force = 4.274195941869;
/// Heights are this times those of the book, so that slopes are small and the tension stays what it is.
constexpr double shallow = 2e-3;
constexpr double tension = 100.0, prestretch = 1.2;  // N/m, -

double free_height(double r) { return coefficient * std::log(2.0 / r); }

/// The dome inside r = 0.85, beyond it its tangent paraboloid, which lies below the membrane.
mesh::BodyMesh dome(int n) {
  const auto height = [](double r2) {
    const double edge = 0.85 * 0.85, root = std::sqrt(1.0 - edge);
    return r2 < edge ? std::sqrt(1.0 - r2) : root - (r2 - edge) / (2.0 * root);
  };
  const double half = 0.8;
  mesh::BodyMesh body;
  const int row = 2 * n + 1;
  for (int j = 0; j < row; ++j)
    for (int i = 0; i < row; ++i) {
      const double x = half * (i - n) / n, y = half * (j - n) / n;
      body.nodes.emplace_back(x, y, shallow * height(x * x + y * y));
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      auto& facet = body.skin_facets.emplace_back();
      for (int a = 0; a < 9; ++a) facet[a] = (2 * j + a / 3) * row + 2 * i + a % 3;
    }
  body.node_location.assign(body.nodes.size(), -1);
  body.mean_skin_cell = 2.0 * half / n;
  return body;
}

struct ObstacleAnswer { double rms = 0.0, at_one = 0.0, radius = 0.0, force = 0.0; };

ObstacleAnswer solve_obstacle(int n) {
  mesh::GarmentMesh membrane = sheet({n, n}, {4.0, 4.0}, [](const Eigen::Vector2d& x) {
    const double r = (x - Eigen::Vector2d(2.0, 2.0)).norm();
    return shallow * free_height(std::max(r, 0.4));  // over the dome
  });
  for (Eigen::Vector3d& x : membrane.placed) x -= Eigen::Vector3d(2.0, 2.0, 0.0);
  const mesh::BodyMesh body = dome(static_cast<int>(std::lround(n / 3.3)));
  const solver::Layout layout = tests::make_layout(body, membrane, false, true);
  Fixed fixed(layout);
  for (std::size_t node = 0; node < membrane.placed.size(); ++node)
    if (membrane.placed[node].head<2>().cwiseAbs().maxCoeff() > 2.0 - 1e-9)
      for (int c = 0; c < 3; ++c) fixed.fix(layout["garment"](static_cast<int>(node), c));
  solver::Scene scene(layout, solver::Numbering(std::move(fixed.master)));
  materials::Fabric fabric;  // equal tension both ways: S E = tension at the strain of the prestretch
  fabric.warp = fabric.weft = materials::TensionCurve::linear(tension / (0.5 * (prestretch * prestretch - 1.0)));
  fabric.shear = tension;
  scene.add(std::make_unique<solver::FabricMembrane>("garment", layout["garment"], membrane, std::vector{fabric}, prestretch));
  scene.add(std::make_unique<solver::Contact>("contact", solver::Interface{layout["contact"], solver::garment_slave(layout["garment"], membrane), solver::MasterSurface(layout["body"], body, body.skin_facets)}, tension / (membrane.mean_edge * membrane.mean_edge),
                                              solver::GapBasis::hat));
  solver::State start = tests::placed_state(layout, body, membrane);
  start.load = 1.0;
  solver::PathSettings settings;
  settings.newton.penetration = 1e-6 * shallow * membrane.mean_edge;
  const auto path = solver::follow_path(scene, start, [](solver::State&, double) {}, settings, [](const postproc::Iteration&) {});
  EXPECT_TRUE(path.complete) << path.message;
  ObstacleAnswer a;
  const auto& contact = *scene.find<solver::Contact>();
  double area = 0.0, count = 0.0, ring = 0.0;
  for (int node = 0; node < layout["garment"].count; ++node) {
    const Eigen::Vector3d x = path.state.values.segment<3>(layout["garment"](node));
    const double r = x.head<2>().norm(), u = x.z() / shallow;
    const double exact = r < contact_radius ? std::sqrt(1.0 - r * r) : free_height(r);
    a.rms += (u - exact) * (u - exact);
    count += 1.0;
    if (std::abs(r - 1.0) < 0.1) a.at_one += u / free_height(r) * at_one, ring += 1.0;
    const int i = contact.multiplier_of(node);
    if (i >= 0 && contact.active(path.state)[i]) area += contact.rest_area(i);
  }
  for (const auto& point : contact.point_forces(path.state)) a.force += point.force.z() / (tension * shallow);
  a.rms = std::sqrt(a.rms / count), a.at_one /= ring, a.radius = std::sqrt(area / std::numbers::pi);
  return a;
}

// A stretched membrane over a dome meets the free boundary and the height of the obstacle problem; heights converge with
// the second power of the cells, the boundary with the first.
TEST(Obstacle, AMembraneOverADomeConvergesToTheFreeBoundaryProblem) {
  std::vector<ObstacleAnswer> rows;
  for (const int n : {8, 16, 32}) {
    rows.push_back(solve_obstacle(n));
    const ObstacleAnswer& a = rows.back();
    fmt::print("{} x {}: rms of u {:.2e}, u(1) {:+.2e}, contact radius {:+.3f}, force {:+.2e}\n", n, n, a.rms, a.at_one / at_one - 1.0,
               a.radius / contact_radius - 1.0, a.force / contact_force - 1.0);
    EXPECT_LE(std::abs(a.radius - contact_radius), 4.0 / n);  // a cell
  }
  EXPECT_GE(std::log2(rows[0].rms / rows[2].rms) / 2.0, 1.8);
  const char* source = "free boundary, reference book 3 (s08)";
  book("obstacle, 32 x 32", "height at r = 1", rows[2].at_one, at_one, 1e-3, source);
  book("obstacle, 32 x 32", "contact force over tension", rows[2].force, contact_force, 1e-3, source);
}

}  // namespace
}  // namespace snug::tests
