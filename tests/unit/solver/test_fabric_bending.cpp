// Bending of the garment: derivatives by rate, what costs nothing, warp against weft, and a seam like any other edge.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "solver/terms/fabric_bending.hpp"
#include "tests/unit/solver/terms.hpp"
#include "tests/verification/membrane_scene.hpp"

namespace snug::tests {
namespace {

using solver::FabricBending, solver::State;

constexpr materials::BendingStiffness knit = {.warp = 4e-6, .weft = 1e-6};  // N m

State placed(const Sheet& sheet) {
  State state = tests::placed_state(sheet.layout, {}, sheet.mesh);
  state.load = 1.0;
  return state;
}

/// A rectangle of 60 x 20 mm cut on the bias.
Sheet rectangle(int n, int m) {
  Sheet sheet(mapped_sheet(n, m, [](double u, double v) { return Plane(0.06 * u, 0.02 * v); }), isotropic(100.0, 0.3));
  sheet.mesh.warp.assign(sheet.mesh.triangles.size(), Plane(std::cos(0.4), std::sin(0.4)));
  return sheet;
}

/// The same, rolled to a tube and sewn.
Sheet tube(int n, int m) {
  Sheet sheet = rectangle(n, m);
  sheet.sew([](const Plane& x) { return x.x() < 1e-9; }, [](const Plane& x) { return x.x() > 0.06 - 1e-9; });
  const double radius = 0.06 / (2.0 * std::numbers::pi);
  for (int node = 0; node < sheet.size(); ++node) {
    const Plane& x = sheet.mesh.pattern[sheet.mesh.merged[node]];
    sheet.mesh.placed[node] = {radius * std::cos(x.x() / radius), radius * std::sin(x.x() / radius), x.y()};
  }
  return sheet;
}

TEST(FabricBending, TangentAndResidualAreDerivativesByRate) {
  // On a sewn tube, dented by 3 % of its radius; the seam's edges among the others.
  const Sheet sheet = tube(6, 2);
  FabricBending bending("garment", sheet.layout["garment"], sheet.mesh, {knit});
  State state = placed(sheet);
  state.values += random_vector(state.values.size(), 3e-4, 1);
  const Eigen::VectorXd direction = random_vector(state.values.size(), 1.0, 2);
  expect_factor_four(bending, state, direction);
  EXPECT_LE(asymmetry(assemble(bending, state, solver::Tangent::full).tangent), 1e-12);
  const double slope = assemble(bending, state, solver::Tangent::none).residual.dot(direction);
  double before = 0.0;
  for (const double h : {8e-5, 4e-5}) {
    const auto energy = [&](double s) {
      State moved = state;
      moved.values += s * direction;
      return bending.energy(moved);
    };
    const double error = (energy(h) - energy(-h)) / (2.0 * h) - slope;
    if (before != 0.0) {
      EXPECT_NEAR(before / error, 4.0, 0.2);
    }
    before = error;
  }
}

TEST(FabricBending, WithoutTurningNormalsTheTangentOfARolledTubeHasNoNegativeEigenvalueToSpeakOf) {
  // Positive for flat triangles (edge_penalty); neighbours at an angle may take a share of some 1e-8.
  const Sheet sheet = tube(16, 2);
  const FabricBending bending("garment", sheet.layout["garment"], sheet.mesh, {knit});
  const auto smallest = [&](solver::Tangent tangent) {
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(assemble(bending, placed(sheet), tangent).tangent).eigenvalues();
    return values.minCoeff() / values.maxCoeff();
  };
  EXPECT_LT(smallest(solver::Tangent::full), -1e-6);  // the state can tell
  EXPECT_GE(smallest(solver::Tangent::convex), -1e-7);
}

TEST(FabricBending, AFlatPieceMovedAsABodyCostsNothing) {
  const Sheet sheet = rectangle(5, 2);
  const FabricBending bending("garment", sheet.layout["garment"], sheet.mesh, {knit});
  State state = placed(sheet);
  const Eigen::AngleAxisd turn(2.0, Eigen::Vector3d(1, 2, 3).normalized());
  for (int node = 0; node < sheet.size(); ++node)
    state.values.segment<3>(sheet.layout["garment"](node)) = turn * sheet.mesh.placed[node] + Eigen::Vector3d(0.01, -0.02, 0.005);
  const double scale = 4e-6 * 0.06 * 0.02 / (0.06 * 0.06);  // J, of a bend over its length
  EXPECT_LE(bending.energy(state), 1e-20 * scale);
  EXPECT_LE(assemble(bending, state, solver::Tangent::none).residual.norm(), 1e-11 * scale / 0.06);
}

TEST(FabricBending, AnEvenBendCostsWhatOrthotropySaysInEveryDirection) {
  // Along the direction at the angle a to the warp: k11 = k cos^2 a, k22 = k sin^2 a, 2 k12 = 2 k sin a cos a, with twist
  // stiffness sqrt(B1 B2)/2; small slopes, quadratic shape: exact on any mesh, no edge turns.
  const Sheet sheet = rectangle(5, 2);
  const FabricBending bending("garment", sheet.layout["garment"], sheet.mesh, {knit});
  const double k = 1e-3;  // 1/m
  for (const double angle : {0.0, 0.3, 0.8, 1.2, 0.5 * std::numbers::pi}) {
    const Plane along(std::cos(0.4 + angle), std::sin(0.4 + angle));
    State state = placed(sheet);
    for (int node = 0; node < sheet.size(); ++node)
      state.values[sheet.layout["garment"](node, 2)] = 0.5 * k * std::pow(along.dot(sheet.mesh.pattern[node]), 2);
    const double c = std::cos(angle), s = std::sin(angle);
    const double exact = 0.5 * k * k * (4e-6 * std::pow(c, 4) + 1e-6 * std::pow(s, 4) + 4.0 * 1e-6 * c * c * s * s) * 0.06 * 0.02;
    EXPECT_NEAR(bending.energy(state), exact, 1e-6 * exact) << angle;
  }
}

TEST(FabricBending, ASewnTubeIsBentByItsRoundnessAndTheSeamIsLikeAnyOtherEdge) {
  // Rolled along x, at 0.4 rad to the warp: k = 1/r everywhere. Quadratic triangles on a circle with the angles at their edges:
  // error of the fourth order.
  const double r = 0.06 / (2.0 * std::numbers::pi), c = std::cos(0.4), s = std::sin(0.4);
  const double exact = 0.5 / (r * r) * (4e-6 * std::pow(c, 4) + 1e-6 * std::pow(s, 4) + 4e-6 * c * c * s * s) * 0.06 * 0.02;
  double before = 0.0;
  for (const int n : {12, 24, 48}) {
    const Sheet sheet = tube(n, n / 3);
    const double error = FabricBending("garment", sheet.layout["garment"], sheet.mesh, {knit}).energy(placed(sheet)) / exact - 1.0;
    EXPECT_LT(std::abs(error), 0.5 / n);
    if (before != 0.0) {
      EXPECT_NEAR(before / error, 16.0, 1.5);
    }
    before = error;
  }
  // A turn of the pattern moves the seam, not the shape: the residual keeps the tube's symmetry at seam nodes, too.
  const Sheet sheet = tube(12, 2);
  const Eigen::VectorXd residual = assemble(FabricBending("garment", sheet.layout["garment"], sheet.mesh, {knit}), placed(sheet), solver::Tangent::none).residual;
  const auto radial = [&](double x) {
    const int node = sheet.node_at({x, 0.01});
    return residual.segment<3>(sheet.layout["garment"](sheet.mesh.merged[node])).dot(sheet.mesh.placed[node].cwiseProduct(Eigen::Vector3d(1, 1, 0)) / r);
  };
  EXPECT_NEAR(radial(0.0), radial(0.03), 1e-9 * std::abs(radial(0.03)));
}

}  // namespace
}  // namespace snug::tests
