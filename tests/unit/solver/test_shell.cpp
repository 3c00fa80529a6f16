// The shell's derivatives by rate, its frame indifference, and what it refuses.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "solver/terms/shell.hpp"
#include "tests/unit/solver/terms.hpp"
#include "tests/verification/shell_models.hpp"

namespace snug::tests {
namespace {

using solver::Shell, solver::State;

/// A curved shell of eight triangles on springs, clamped on one side.
struct CurvedShell {
  mesh::BodyMesh body;
  solver::Layout layout;
  Shell shell;
  State rest;

  explicit CurvedShell(bool bound) : body(make(bound)), layout(tests::make_layout(body, {}, true, false)), shell(layout["body"], body, {{100.0, 0.3}}) {
    rest = tests::placed_state(layout, body, {});
    rest.load = 1.0;
  }
  static mesh::BodyMesh make(bool bound) {
    mesh::Model model = square_shell(2, 2, [](double u, double v) { return Eigen::Vector3d(u, v, 0.3 * u * u - 0.2 * u * v + 0.1 * v); }, 100.0, 0.3, 0.1);
    if (bound) {
      model.sections[0].foundation = 3.0;
      hold(model, [](const Eigen::Vector3d& x) { return x.y() < 1e-9; }, {0, 1, 2, 3, 4, 5});
    }
    return shell_case(model).mesh;
  }
  /// Zero on the clamped side.
  Eigen::VectorXd direction(double size, unsigned seed) const {
    Eigen::VectorXd d = random_vector(rest.values.size(), size, seed);
    for (const mesh::HeldComponent& held : body.held) d[layout["body"](held.node, held.component)] = 0.0;
    return d;
  }
};

TEST(Shell, TangentAndResidualAreDerivativesByRate) {
  // Away from rest by 2 % of its side; edges between triangles, the clamped edge and the springs included. The clamped
  // side stands: its reactions are not asked for.
  CurvedShell c(true);
  State state = c.rest;
  state.values += c.direction(0.02, 1);
  const Eigen::VectorXd direction = c.direction(1.0, 2);
  const auto errors = tangent_errors(c.shell, state, direction, 1e-3);
  const auto at = [&](double s) {
    State moved = state;
    moved.values += s * direction;
    return moved;
  };
  const double slope = assemble(c.shell, state, solver::Tangent::none).residual.dot(direction);
  double before = 0.0;
  for (const double h : {1e-3, 5e-4}) {
    const double error = (c.shell.energy(at(h)) - c.shell.energy(at(-h))) / (2.0 * h) - slope;
    if (before != 0.0) {
      EXPECT_NEAR(before / error, 4.0, 0.1);
    }
    before = error;
  }
  CurvedShell free(false);
  State moved = free.rest;
  moved.values += free.direction(0.02, 3);
  const auto free_errors = tangent_errors(free.shell, moved, free.direction(1.0, 4), 1e-3);
  EXPECT_NEAR(free_errors[0] / free_errors[1], 4.0, 0.2);
  EXPECT_NEAR(free_errors[1] / free_errors[2], 4.0, 0.2);
  const Eigen::MatrixXd tangent = assemble(c.shell, state, solver::Tangent::full).tangent;
  EXPECT_LE((tangent - tangent.transpose()).norm(), 1e-12 * tangent.norm());
  EXPECT_LT(errors[0], 1.0);
}

TEST(Shell, RestAndRotationCostNothing) {
  CurvedShell c(false);
  EXPECT_LE(c.shell.energy(c.rest), 1e-25);
  EXPECT_LE(assemble(c.shell, c.rest, solver::Tangent::none).residual.norm(), 1e-12);
  State turned = c.rest;
  const Eigen::AngleAxisd turn(2.0, Eigen::Vector3d(1, 2, 3).normalized());
  for (std::size_t n = 0; n < c.body.nodes.size(); ++n) turned.values.segment<3>(3 * n) = turn * c.body.nodes[n];
  EXPECT_LE(c.shell.energy(turned), 1e-25);
}

TEST(Shell, ARotationHeldAtOneNodeIsRefused) {
  mesh::Model model = square_shell(2, 2, [](double u, double v) { return Eigen::Vector3d(u, v, 0.0); }, 1.0, 0.3, 0.1);
  model.supports = {{1, 3, 0.0}};
  const mesh::BodyMesh body = shell_case(model).mesh;
  const solver::Field positions = tests::make_layout(body, {}, true, false)["body"];
  EXPECT_THROW(Shell(positions, body, {{1.0, 0.3}}), input::InputError);
  model.supports = {{1, 5, 0.0}};  // about the normal: means nothing
  EXPECT_NO_THROW(Shell(positions, shell_case(model).mesh, {{1.0, 0.3}}));
}

}  // namespace
}  // namespace snug::tests
