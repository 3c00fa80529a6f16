// Drag against which cloth creeps: it belongs to its energy, holds cloth and skin, and is gone when it is taken away.
#include <gtest/gtest.h>

#include "solver/terms/drag.hpp"
#include "tests/unit/solver/terms.hpp"

namespace snug::tests {
namespace {

using solver::Drag, solver::Skin;

/// A sleeve with friction on a coarse soft tube.
struct Sleeve {
  input::Case description;
  solver::Meshes meshes;
  solver::Scene scene;
  solver::State state;

  Sleeve() : description(describe()), meshes(make_meshes(description)), scene(tests::make_scene(description, meshes, Skin::deformable)), state(solver::placed_state(scene.layout(), meshes)) {}
  static input::Case describe() {
    TubeCase tube;
    tube.around = 6, tube.along = 2, tube.through = 1, tube.cell_size = 0.02;
    input::Case c = describe_tube(tube);
    c.contacts.front().friction = 0.3;
    return c;
  }
  const Drag& drag() const { return *scene.find<Drag>(); }
};

TEST(Drag, IsTheDerivativeOfItsEnergy) {
  // Force and stiffness of a step of 1 mm from where it set out, to round-off: the energy is quadratic.
  Sleeve sleeve;
  Drag::hold_back(sleeve.state, 0.3);
  const solver::State from = sleeve.state;
  const Eigen::VectorXd direction = random_vector(from.values.size(), 1e-3, 1);
  sleeve.state.values += direction;
  const Assembled at = assemble(sleeve.drag(), sleeve.state, solver::Tangent::full);
  EXPECT_NEAR(at.residual.dot(direction), 2.0 * sleeve.drag().energy(sleeve.state), 1e-12 * at.residual.norm() * direction.norm());
  EXPECT_LE((at.tangent * direction - at.residual).norm(), 1e-12 * at.residual.norm());
  EXPECT_GT(sleeve.drag().energy(sleeve.state), 0.0);
  EXPECT_EQ(assemble(sleeve.drag(), from, solver::Tangent::none).residual.norm(), 0.0);  // where it set out from
}

TEST(Drag, TellsTheLargestWayOfANode) {
  // Of two nodes of the garment one goes 3, 4 and 12 mm along x, y and z and another 10 mm along x: 13 mm; what moves inside the body is not cloth.
  Sleeve sleeve;
  Drag::hold_back(sleeve.state, 1.0);
  solver::State moved = sleeve.state;
  moved.values.array() += 1e-3;
  const Eigen::VectorXd held = assemble(sleeve.drag(), moved, solver::Tangent::none).residual, from = sleeve.state.values;
  const solver::Field &garment = sleeve.scene.layout()[sleeve.meshes.garments.front().name], &body = sleeve.scene.layout()["body"];
  Eigen::VectorXd to = from;
  for (int node = 0; node < body.count; ++node)
    if (held[body(node, 0)] == 0.0) to[body(node, 0)] += 0.5;
  to[garment(0, 0)] += 3e-3, to[garment(0, 1)] += 4e-3, to[garment(0, 2)] += 12e-3;
  to[garment(1, 0)] += 10e-3;
  EXPECT_NEAR(sleeve.drag().way(from, to), 13e-3, 1e-12);
}

TEST(Drag, WaysAreOfNodesWhereACutBindsADirectionToOthers) {
  // On a tilted cut one direction of a node follows the others and is not held back: of three nodes and a pressure behind them the last node's 13 mm count, not
  // the 200 mm that the second one is said to go along z, nor what the pressure does.
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(10), to = Eigen::VectorXd::Zero(10);
  weights.head<9>().setConstant(2.0);
  weights[5] = 0.0;
  to[4] = 5e-3, to[5] = 0.2;
  to[6] = 3e-3, to[7] = 4e-3, to[8] = 12e-3;
  to[9] = 300.0;
  EXPECT_NEAR(Drag(weights).way(Eigen::VectorXd::Zero(10), to), 13e-3, 1e-15);
}

TEST(Drag, HoldsClothAndSkinAndNothingBelow) {
  // Every node of the garment and of the skin is held back, none in the depth of the body is.
  Sleeve sleeve;
  Drag::hold_back(sleeve.state, 1.0);
  sleeve.state.values.array() += 1e-3;
  const Eigen::VectorXd force = assemble(sleeve.drag(), sleeve.state, solver::Tangent::none).residual;
  const solver::Field& garment = sleeve.scene.layout()[sleeve.meshes.garments.front().name];
  for (int node = 0; node < garment.count; ++node)
    if (sleeve.meshes.garments.front().merged.empty() || sleeve.meshes.garments.front().merged[node] == node) EXPECT_GT(force[garment(node, 0)], 0.0) << node;
  std::vector<char> skin(sleeve.meshes.body.nodes.size(), 0);
  for (const auto& facet : sleeve.meshes.body.skin_facets)
    for (const int node : facet)
      if (node >= 0) skin[node] = 1;
  const solver::Field& body = sleeve.scene.layout()["body"];
  for (std::size_t node = 0; node < skin.size(); ++node) EXPECT_EQ(force[body(static_cast<int>(node), 0)] > 0.0, skin[node] == 1) << node;
}

TEST(Drag, IsNotThereWhereNothingRubs) {
  // Without friction cloth has one place to rest: there is nothing to creep against.
  input::Case c = Sleeve::describe();
  c.contacts.front().friction = 0.0;
  const solver::Meshes meshes = make_meshes(c);
  EXPECT_EQ(tests::make_scene(c, meshes, Skin::deformable).find<Drag>(), nullptr);
}

TEST(Drag, IsGoneWhereItIsTakenAway) {
  // Without a drag there is neither force nor stiffness nor energy, and none is stored at any time.
  Sleeve sleeve;
  const auto nothing = [&] {
    return assemble(sleeve.drag(), sleeve.state, solver::Tangent::full).tangent.norm() + assemble(sleeve.drag(), sleeve.state, solver::Tangent::none).residual.norm() + sleeve.drag().energy(sleeve.state);
  };
  EXPECT_EQ(nothing(), 0.0);
  Drag::hold_back(sleeve.state, 1.0);
  sleeve.state.values.array() += 1e-3;
  EXPECT_GT(nothing(), 0.0);
  EXPECT_EQ(sleeve.drag().stored_energy(sleeve.state), 0.0);
  Drag::hold_back(sleeve.state, 0.0);
  EXPECT_EQ(nothing(), 0.0);
}

}  // namespace
}  // namespace snug::tests
