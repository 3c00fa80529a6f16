// Past the largest load: curves of equilibria that a path of loads cannot follow.
#include "solver/stepping/arc_length.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/shell_models.hpp"

namespace snug::tests {
namespace {

/// One half of von Mises' truss as a strip of a shell whose ends are hinges: span 10, rise 1, thickness 1 (so that it does not
/// buckle: Euler's strain is 0.8 %, its largest 0.5 %), nu = 0. The apex moves along z only, under a force.
struct Truss {
  static constexpr double span = 10.0, rise = 1.0, width = 1.0, thickness = 1.0, youngs = 1e6;
  BodyMesh mesh;
  input::Case c;

  explicit Truss(double force) {
    mesh.kind = CellKind::tet10;
    input::MaterialEntry& law = mesh.layers.emplace_back(mesh::Layer{"strip", {}}).material;
    law.table = input::table_of(fmt::format("law = 'linear-elastic'\nyoungs_modulus = '{} Pa'\npoisson_ratio = 0", youngs));
    const int cells = 8;
    const auto node = [](int i, int j) { return 3 * i + j; };
    for (int i = 0; i <= 2 * cells; ++i)
      for (int j = 0; j <= 2; ++j) mesh.nodes.emplace_back(0.5 * span * i / cells, 0.5 * width * j, 0.5 * rise * i / cells);
    for (int k = 0; k < cells; ++k) {
      const int i = 2 * k;
      using Corner = std::pair<int, int>;
      for (const std::array<Corner, 3>& of : {std::array<Corner, 3>{Corner{i, 0}, {i + 2, 0}, {i + 2, 2}},
                                              std::array<Corner, 3>{Corner{i, 0}, {i + 2, 2}, {i, 2}}}) {
        const auto& [a, b, d] = of;
        const auto middle = [&](const Corner& p, const Corner& q) { return node((p.first + q.first) / 2, (p.second + q.second) / 2); };
        mesh::ShellTriangle triangle;
        triangle.nodes = {node(a.first, a.second), node(b.first, b.second), node(d.first, d.second),
                          middle(a, b), middle(b, d), middle(d, a), -1, -1, -1};
        triangle.thickness = thickness;
        mesh.shell.push_back(triangle);
      }
    }
    for (int j = 0; j <= 2; ++j) {
      for (int component = 0; component < 3; ++component) mesh.held.push_back({node(0, j), component, 0.0});
      mesh.held.push_back({node(2 * cells, j), 0, 0.0}), mesh.held.push_back({node(2 * cells, j), 1, 0.0});
      mesh.forces.push_back({node(2 * cells, j), Eigen::Vector3d(0.0, 0.0, -force * (j == 1 ? 4.0 : 1.0) / 6.0)});
    }
    mesh.node_location.assign(mesh.nodes.size(), -1);
    c.body.emplace();
    c.body->kind = input::BodyKind::imported;
  }
  int apex() const { return static_cast<int>(mesh.nodes.size()) - 2; }
  double sunk(const solver::Layout& layout, const solver::State& state) const { return rise - state.values[layout["body"](apex(), 2)]; }
};

/// Force on the apex (of half the truss) at the sinking w, St. Venant & Kirchhoff: E A (w^2/2 - h w) (w - h) / L0^3.
double truss_force(double w) {
  const double l0 = std::hypot(Truss::span, Truss::rise), h = Truss::rise;
  return Truss::youngs * Truss::width * Truss::thickness * (0.5 * w * w - h * w) * (w - h) / (l0 * l0 * l0);
}

// Von Mises' truss snaps through at P = 2 E A h^3 / (3 sqrt 3 L0^3) (both bars; reference book 4 A): the curve goes through both
// limit points and comes up to a load above the first one on the other side.
TEST(LimitPoints, TrussSnapsThroughAtItsLimitLoad) {
  const double limit = Truss::youngs / (3.0 * std::sqrt(3.0) * std::pow(std::hypot(Truss::span, Truss::rise), 3)), full = 1.5 * limit;
  const char* source = "reference book 4 A, closed form";
  const Truss truss(full);
  const mesh::GarmentMesh none;
  solver::Scene scene = tests::make_scene(truss.c, truss.mesh, none, solver::Skin::deformable);
  double lowest = 1.0, worst = 0.0;
  solver::PathSettings settings;
  settings.accepted = [&](const solver::Scene&, const solver::State& state, double) {
    lowest = std::min(lowest, state.load);
    worst = std::max(worst, std::abs(full * state.load - truss_force(truss.sunk(scene.layout(), state))) / limit);
  };
  int iterations = 0;
  const auto count = [&](const postproc::Iteration&) { ++iterations; };
  const auto loaded = solver::follow_load(scene, tests::placed_state(scene.layout(), truss.mesh, none), true, settings, count, count);
  fmt::print("truss: {} increments, {} iterations\n", loaded.path.increments, iterations);
  ASSERT_TRUE(loaded.path.complete) << loaded.path.message;
  ASSERT_TRUE(loaded.limit_load.has_value());
  book("4 A truss, arc length", "limit load over the closed form", *loaded.limit_load * full / limit, 1.0, 1e-3, source);
  book("4 A truss, arc length", "distance of every state from the closed form, over the limit load", worst, 0.0, 1e-6, source);
  EXPECT_LT(lowest, -0.6);  // the second limit point is at -1/1.5 of the load
  EXPECT_GT(truss.sunk(scene.layout(), loaded.path.state), 2.0 * Truss::rise);
}

}  // namespace
}  // namespace snug::tests
