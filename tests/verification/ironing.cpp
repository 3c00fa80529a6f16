// A stiff rounded tool is pressed deep into a soft slab and drawn along it: friction between two solids.
#include <gtest/gtest.h>

#include "solver/stepping/load_path.hpp"
#include "solver/terms/friction.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/two_solids.hpp"

namespace snug::tests {
namespace {

constexpr double coefficient = 0.3, depth = 0.12;  // of a slab 1 m thick

Solid slab() {
  Block block;
  block.cells = {15, 3, 1};
  block.map = [](const Eigen::Vector3d& u) { return Eigen::Vector3d(3.6 * u.x() - 1.6, u.y() - 1.0, 0.25 * u.z()); };
  return {make_block(block), "top", 1.0, 0.3};
}

/// Of radius 1 m at its lower face.
Solid tool() {
  Block block;
  block.cells = {8, 2, 1}, block.kind = CellKind::tet10;
  block.map = [](const Eigen::Vector3d& u) {
    const double x = 1.4 * (u.x() - 0.5), sagitta = 1.0 - std::sqrt(1.0 - x * x);
    return Eigen::Vector3d(x, sagitta + u.y() * (0.6 - sagitta), 0.25 * u.z());
  };
  return {make_block(block), "bottom", 1e3, 0.3};
}

/// Plane strain; the slab's bottom is held and the tool's top is led.
struct Ironing : TwoSolids {
  solver::Scene scene;
  Ironing() : TwoSolids(slab(), tool()), scene(rough()) {}

  solver::Scene rough() {
    for (const Solid* solid : {&master, &slave}) hold(*solid, "front", 2), hold(*solid, "back", 2);
    for (int c = 0; c < 2; ++c) hold(master, "bottom", c), hold(slave, "top", c);
    solver::Scene made = TwoSolids::scene();
    const double edge = mesh::mean_edge(slave.mesh, slave.mesh.surface("bottom")->facets);
    made.add(std::make_unique<solver::Friction>("friction", *made.find<solver::Contact>(), coefficient,
                                                solver::Friction::usual_elastic_slip * edge));
    return made;
  }
  /// Leads the tool to a place in steps; `from` and `to` are along and down, m.
  bool lead(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    solver::PathSettings settings;
    settings.first_step = 0.25, settings.newton.residual = 1e-6;
    const auto place = [&](State& s, double t) {
      const Eigen::Vector2d at = from + t * (to - from);
      for (const int node : slave.mesh.surface("top")->nodes)
        s.values.segment<2>(entry(slave, node)) = slave.mesh.nodes[node].head<2>() + Eigen::Vector2d(at.x(), -at.y());
      s.load = 1.0;
    };
    const auto path = solver::follow_path(scene, state, place, settings, [](const postproc::Iteration&) {});
    state = path.state;
    return path.complete;
  }
  /// Of the tool's support, N.
  Eigen::Vector3d force() const {
    const Eigen::VectorXd residual = scene.full_residual(state);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int node : slave.mesh.surface("top")->nodes) sum += residual.segment<3>(entry(slave, node));
    return sum;
  }
  double stored_energy() const {
    double sum = 0.0;
    for (const auto& term : scene.terms())
      if (dynamic_cast<const solver::Tissue*>(term.get())) sum += term->energy(state);
    return sum;
  }
};

// In steady sliding the pull is mu times the load, the friction of all points is mu times their pressure, and the stored
// energy stays as it is: all work is dissipated. The slab's face slants under the tool, for which the pull may differ from
// mu times the load by the difference of its slopes before and behind.
TEST(Ironing, PullIsTheCoefficientTimesTheLoad) {
  Ironing iron;
  ASSERT_TRUE(iron.lead({0.0, 0.0}, {0.0, depth}));
  ASSERT_TRUE(iron.lead({0.0, depth}, {0.1, depth}));
  const double before = iron.stored_energy();
  ASSERT_TRUE(iron.lead({0.1, depth}, {0.2, depth}));
  const Eigen::Vector3d force = iron.force();
  double rubbing = 0.0, pressing = 0.0;
  for (const auto& point : iron.scene.find<solver::Friction>()->point_forces(iron.state)) rubbing += point.force.norm();
  for (const auto& point : iron.scene.find<solver::Contact>()->point_forces(iron.state)) pressing += point.force.norm();
  const std::string source = "Coulomb's law; reference book 3, ironing (qualitative)";
  book("3 ironing", "pull over load", -force.x() / force.y(), coefficient, 2e-2, source);
  book("3 ironing", "friction over pressure, sums over the points", rubbing / pressing, coefficient, 1e-2, source);
  book("3 ironing", "stored energy: relative change on the way", iron.stored_energy() / before - 1.0, 0.0, 1e-2, source);
}

}  // namespace
}  // namespace snug::tests
