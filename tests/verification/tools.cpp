// A rigid tool against exact answers: a ball on a half space (Hertz), a flat punch on a bonded layer (Hayes), and the balance of forces.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>

#include "solver/scene/run.hpp"
#include "solver/scene/tools.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/two_solids.hpp"
#include "tests/verification/wedge.hpp"

namespace snug::tests {
namespace {

constexpr double slice = std::numbers::pi / 6.0;  // of the wedge, rad

/// Places over the unit interval, by cells.
struct Places {
  int count;
  std::function<double(double)> at;
  Places(const Graded& graded) : count(graded.cells()), at(graded) {}
  /// Fine on both sides of a radius.
  Places(double radius, const Graded& inwards, const Graded& outwards)
      : count(inwards.cells() + outwards.cells()), at([=, inner = double(inwards.cells()) / (inwards.cells() + outwards.cells())](double u) {
          return u <= inner ? radius - inwards(std::max(0.0, 1.0 - u / inner)) : radius + outwards((u - inner) / (1.0 - inner));
        }) {}
  int cells() const { return count; }
  double operator()(double u) const { return at(u); }
};

/// A slice of a disc of material on a bonded floor, its face at y = 0, radii and depths by cells; the rim is free.
BlockCase layer(const Places& radii, const Places& depths, double youngs_modulus, double poisson) {
  Block block;
  block.kind = CellKind::tet10, block.cells = {radii.cells(), depths.cells(), 1};
  block.map = [=](const Eigen::Vector3d& u) {
    const double r = radii(u.x()), angle = slice * u.z();
    return Eigen::Vector3d(r * std::cos(angle), -depths(1.0 - u.y()), r * std::sin(angle));
  };
  BodyMesh mesh = make_block(block);
  close_at_axis(mesh);
  std::set<int> used;
  for (const auto& cell : mesh.cells) used.insert(cell.begin(), cell.begin() + 10);
  for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node)  // corners that were closed leave some
    for (int c = 0; c < 3 && !used.contains(node); ++c) mesh.held.push_back({node, c, 0.0});
  const std::set<int> axis(mesh.surface("left")->nodes.begin(), mesh.surface("left")->nodes.end());
  for (const int node : axis) mesh.held.push_back({node, 0, 0.0}), mesh.held.push_back({node, 2, 0.0});
  const std::set<int> floor(mesh.surface("bottom")->nodes.begin(), mesh.surface("bottom")->nodes.end());
  for (const int node : mesh.surface("back")->nodes)
    if (!axis.contains(node) && !floor.contains(node)) mesh.held.push_back({node, 2, 0.0});
  for (const int node : mesh.surface("front")->nodes)
    if (!axis.contains(node) && !floor.contains(node)) mesh.held_along.push_back({node, {-std::sin(slice), 0.0, std::cos(slice)}, 0.0});
  for (const int node : floor)
    for (int c = 0; c < 3; ++c)
      if (c == 1 || !axis.contains(node)) mesh.held.push_back({node, c, 0.0});
  mesh.skin_facets = mesh.surface("top")->facets;
  return {std::move(mesh), {fmt::format("law = 'linear-elastic'\nyoungs_modulus = '{:.17g} Pa'\npoisson_ratio = {}", youngs_modulus, poisson)}};
}

input::ToolSpec tool_on_top(double radius, double edge, double travel) {
  input::ToolSpec tool;
  tool.on = "top", tool.radius = radius, tool.edge_radius = edge, tool.travel = travel, tool.direction = {0, -1, 0}, tool.tip = {0, 1, 0};
  tool.steps = 1;
  return tool;
}

postproc::RunResult pressed(BlockCase block, const input::ToolSpec& tool) {
  block.c.tools = {tool};
  block.c.load.reset();
  solver::Meshes meshes;
  meshes.body = std::move(block.mesh);
  const solver::Model model = solver::make_model(block.c, meshes.body);
  postproc::RunResult result = solver::solve(model, meshes);
  EXPECT_EQ(result.status, postproc::Status::converged) << result.message;
  const double round_off = 1e-13;  // N, of positions to 5 cm in 10 kPa: eps E L^2 an entry, beside forces of 1e-6 N
  EXPECT_LE(result.balance.force_error.norm(), 1e-9 * result.balance.contact_force + round_off);
  return result;
}

/// Of the whole disc, N.
double force(const postproc::RunResult& result) { return result.tools.front().end().force * 2.0 * std::numbers::pi / slice; }

// A ball on a block 100 contact radii wide and deep: F = 4/3 E/(1 - nu^2) sqrt(R) d^(3/2). The error falls with the cells; what is left is the block's, of
// the order of a/L, and the strain's.
TEST(Tools, BallOnAHalfSpace) {
  const double E = 10e3, nu = 0.3, R = 0.05, a = 5e-4, d = a * a / R;
  const double exact = 4.0 / 3.0 * E / (1.0 - nu * nu) * std::sqrt(R) * std::pow(d, 1.5);
  std::vector<double> errors;
  for (const int cells : {2, 4, 8}) {
    const Graded grid(a / cells, 3 * cells / 2, cells == 2 ? 9 : 10, 100.0 * a);
    input::ToolSpec ball = tool_on_top(R, 0.0, d);
    ball.shape = input::ToolShape::sphere;
    const auto result = pressed(layer(grid, grid, E, nu), ball);
    errors.push_back(std::abs(force(result) / exact - 1.0));
    fmt::print("ball, {} cells a contact radius: {:.6g} N, exact {:.6g}, area {:.4g}\n", cells, force(result), exact, result.tools.front().end().area * 2.0 * std::numbers::pi / slice / (std::numbers::pi * a * a));
  }
  book("tool, ball on a half space", "force", 1.0 + errors.back(), 1.0, 2e-2, "Hertz; Johnson, Contact Mechanics (1985), eq. 4.23");
  EXPECT_LT(errors[2], errors[0]);
}

// Twice as deep, 2^(3/2) times the force: of two runs on one mesh, in which the block's own error is nearly the same.
TEST(Tools, ForceOfABallGrowsWithTheDepthToTheThreeHalves) {
  const double E = 10e3, R = 0.05, a = 5e-4, d = a * a / R;
  const Graded grid(a / 6, 14, 10, 100.0 * a);
  std::array<double, 2> found{};
  for (int k = 0; k < 2; ++k) {
    input::ToolSpec ball = tool_on_top(R, 0.0, (1 + k) * d);
    ball.shape = input::ToolShape::sphere;
    found[k] = force(pressed(layer(grid, grid, E, 0.3), ball));
  }
  book("tool, ball on a half space", "exponent of the depth", std::log2(found[1] / found[0]), 1.5, 1e-2, "Hertz");
}

/// kappa of Hayes, Keer, Herrmann & Mockros, J. Biomech. 5 (1972) 541: F = 4 G a w kappa/(1 - nu) of a flat punch on a bonded layer, by the integral
/// equation that they solve, phi(t) + 2/pi int_0^1 phi(s) K(t, s) ds = 1, K = int (T(k h) - 1) cos(kt) cos(ks) dk, with T the layer's compliance over the half
/// space's (Johnson, Contact Mechanics, sec. 5.8), on Gauss points.
double kappa(double radius_over_height, double nu) {
  const auto points = [](int n) { return fem::quadrature(fem::Domain::line, 2 * n - 1); };
  const fem::Rule of_t = points(24), of_k = points(60);
  const double q = 3.0 - 4.0 * nu, end = 18.0;
  const int n = static_cast<int>(of_t.weights.size());
  const auto T = [&](double x) { return (2.0 * q * std::sinh(2.0 * x) - 4.0 * x) / (2.0 * q * std::cosh(2.0 * x) + 4.0 * x * x + 1.0 + q * q); };
  const auto t = [&](int i) { return 0.5 * (1.0 + of_t.points(0, i)); };
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index m = 0; m < of_k.weights.size(); ++m) {
    const double x = 0.5 * end * (1.0 + of_k.points(0, m)), k = x * radius_over_height, weight = 0.5 * end * of_k.weights[m] * radius_over_height * (T(x) - 1.0);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) A(i, j) += std::numbers::inv_pi * of_t.weights[j] * weight * std::cos(k * t(i)) * std::cos(k * t(j));
  }
  return 0.5 * of_t.weights.dot(A.partialPivLu().solve(Eigen::VectorXd::Ones(n)));
}

// The equation gives the table of the paper.
TEST(Tools, KappaOfTheBondedLayerIsThatOfTheTable) {
  for (const auto& [aspect, nu, printed] : {std::tuple{0.2, 0.3, 1.207}, {0.4, 0.4, 1.542}, {1.0, 0.45, 3.085}, {0.2, 0.5, 1.281}, {0.6, 0.5, 2.211}, {1.0, 0.5, 3.609}})
    EXPECT_NEAR(kappa(aspect, nu), printed, 3e-3 * printed) << aspect << ", " << nu;
}

// A flat punch on a bonded layer. With its edge rounded by r the contact ends between radius - r and radius, and so the force lies between those of the two punches.
TEST(Tools, FlatPunchOnABondedLayer) {
  const double E = 10e3, a = 0.01;
  for (const auto& [aspect, nu] : {std::pair{0.4, 0.3}, {1.0, 0.45}}) {
    const double edge = 0.02 * a, depth = 1e-3 * a, height = a / aspect;
    const auto exact = [&](double radius) { return 4.0 * 0.5 * E / (1.0 + nu) * radius * depth * kappa(radius / height, nu) / (1.0 - nu); };
    std::vector<double> found;
    for (const int cells : {1, 2}) {  // over the rounding
      const double size = edge / cells;
      const auto result = pressed(layer(Places(a, Graded(size, 2 * cells, 7, a), Graded(size, 1, 8, 4.0 * height)), Graded(2.0 * size, 2, 8, height), E, nu),
                                  tool_on_top(a, edge, depth));
      found.push_back(force(result) / exact(a));
    }
    fmt::print("flat punch, a/h {}: {:.4f}, {:.4f} of the sharp punch; the inner one has {:.4f}\n", aspect, found[0], found[1], exact(a - edge) / exact(a));
    EXPECT_LT(found[1], 1.02);
    EXPECT_GT(found[1], exact(a - edge) / exact(a) - 0.01);
  }
}

}  // namespace
}  // namespace snug::tests
