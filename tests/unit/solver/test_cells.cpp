// Cells of every kind and law: the tangent is the derivative of the residual, the residual the gradient of the energy.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "solver/terms/dead_load.hpp"
#include "solver/terms/facet_kind.hpp"
#include "solver/terms/pressure_load.hpp"
#include "solver/terms/pressure_unknowns.hpp"
#include "tests/unit/solver/terms.hpp"
#include "tests/verification/blocks.hpp"

namespace snug::tests {
namespace {

using solver::State, solver::Tangent;

/// Two cells of each direction in two layers, all nodes shaken; pressures of tetrahedra off their law, dilatations and
/// pressures of hexahedra where the positions want them.
struct ShakenBlock {
  BlockCase block;
  solver::Scene scene;
  State state;

  ShakenBlock(CellKind kind, const std::string& second)
      : block(make(kind, second)),
        scene(tests::make_scene(block.c, block.mesh, {}, solver::Skin::deformable)),
        state(tests::placed_state(scene.layout(), block.mesh, {})) {
    const solver::Layout& layout = scene.layout();
    state.load = 0.6, state.stiffening = 2.0;
    state.values.head(layout.positions()) += random_vector(layout.positions(), 0.02, 1);
    state.values.segment(layout.positions(), layout["body pressure"].count) = random_vector(layout["body pressure"].count, 500.0, 3);
    settle(tissue(), state);
  }

  const solver::Tissue& tissue() const { return *scene.find<solver::Tissue>(); }

  /// Dilatations by a few hundredths and pressures by 500 Pa off what the positions want.
  void unsettle() {
    const solver::Layout& layout = scene.layout();
    const int modes = solver::pressure_modes(block.mesh.kind);
    for (std::size_t c = 0; c < block.mesh.cells.size(); ++c) {
      const int first = layout["body cells"](2 * modes * static_cast<int>(c));
      state.values.segment(first, modes) += random_vector(modes, 0.02, 100 + static_cast<unsigned>(c));
      state.values.segment(first + modes, modes) += random_vector(modes, 500.0, 200 + static_cast<unsigned>(c));
    }
  }

  static BlockCase make(CellKind kind, const std::string& second) {
    Block grid;
    grid.cells = {2, 2, 2}, grid.kind = kind;
    grid.layers = {"soft", "other"};
    grid.layer = [](const Eigen::Vector3d& middle) { return middle.x() > 0.5 ? 1 : 0; };
    BlockCase block(make_block(grid), {neo_hooke(10.0, 0.49), second});
    block.hold("bottom", 0.0, 0.0, 0.0);
    block.traction("right", 100.0, 50.0, 20.0), block.pressure("top", 800.0);
    block.c.load->gravity = {0.0, 0.0, -9.81};
    return block;
  }

  /// Positions by 1, pressures by 1e4: both move the residual alike. What is eliminated goes along.
  Eigen::VectorXd direction() const {
    const solver::Layout& layout = scene.layout();
    Eigen::VectorXd d = random_vector(layout.size(), 1.0, 2);
    d.segment(layout.positions(), layout["body pressure"].count) *= 1e4;
    tissue().recover(state, d);
    return d;
  }
};

class Cells : public testing::TestWithParam<std::tuple<CellKind, std::string>> {};

TEST_P(Cells, TangentAndResidualAreDerivatives) {
  ShakenBlock shaken(std::get<0>(GetParam()), std::get<1>(GetParam()));
  auto& tissue = *shaken.scene.find<solver::Tissue>();
  const Eigen::VectorXd direction = shaken.direction();
  const auto errors = tangent_errors(tissue, shaken.state, direction, 1e-3);
  EXPECT_LE(errors[2], 1e-4);
  EXPECT_GE(errors[0] / errors[1], 3.8);  // central differences: a quarter with half the step
  EXPECT_GE(errors[1] / errors[2], 3.8);
  const Assembled at = assemble(tissue, shaken.state, Tangent::full);
  EXPECT_LE((at.tangent - at.tangent.transpose()).norm(), 1e-12 * at.tangent.norm());
  const auto energy = [&](double s) {
    State moved = shaken.state;
    moved.values += s * direction;
    return tissue.energy(moved);
  };
  const double h = 1e-4, slope = (energy(h) - energy(-h)) / (2.0 * h), exact = at.residual.dot(direction);
  const double coarse = std::abs((energy(2 * h) - energy(-2 * h)) / (4.0 * h) - exact);
  EXPECT_LE(std::abs(slope - exact), 1e-5 * std::abs(exact));
  EXPECT_GE(coarse / std::abs(slope - exact), 3.5);
}

/// Where dilatations and pressures of hexahedra are off, the residual is the gradient of the energy while they stand.
TEST_P(Cells, ResidualIsTheGradientWithTheFieldsHeld) {
  ShakenBlock shaken(std::get<0>(GetParam()), std::get<1>(GetParam()));
  shaken.unsettle();
  const solver::Layout& layout = shaken.scene.layout();
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(layout.size());
  direction.head(layout.positions()) = random_vector(layout.positions(), 1.0, 2);
  const auto energy = [&](double s) {
    State moved = shaken.state;
    moved.values += s * direction;
    return shaken.tissue().energy(moved);
  };
  const auto slope = [&](double h) { return (energy(h) - energy(-h)) / (2.0 * h); };
  const double exact = assemble(shaken.tissue(), shaken.state, Tangent::none).residual.dot(direction);
  const double error = std::abs(slope(1e-4) - exact);
  EXPECT_LE(error, 1e-5 * std::abs(exact));
  EXPECT_GE(std::abs(slope(2e-4) - exact) / error, 3.5);
}

/// One Newton step of the whole system: along the positions' step with what `recover` makes of it, the residual changes by
/// the condensed tangent times the step plus the condensed right side, and the fields' own equations fall quadratically.
TEST_P(Cells, EliminationIsTheNewtonStepOfAllFields) {
  ShakenBlock shaken(std::get<0>(GetParam()), std::get<1>(GetParam()));
  shaken.unsettle();
  const State& state = shaken.state;
  const Assembled at = assemble(shaken.tissue(), state, Tangent::full);
  Eigen::VectorXd step = Eigen::VectorXd::Zero(state.values.size());
  step.head(shaken.scene.layout().positions()) = random_vector(shaken.scene.layout().positions(), 1e-3, 5);
  shaken.tissue().recover(state, step);
  const auto moved = [&](double s) {
    State m = state;
    m.values += s * step;
    return m;
  };
  const Eigen::VectorXd change = at.tangent * step + at.condensed;
  const auto error = [&](double h) {
    return ((assemble(shaken.tissue(), moved(h), Tangent::none).residual -
             assemble(shaken.tissue(), moved(-h), Tangent::none).residual) / (2.0 * h) - change).norm() / change.norm();
  };
  EXPECT_LE(error(0.05), 1e-3);
  EXPECT_NEAR(error(0.1) / error(0.05), 4.0, 0.3);
  if (solver::pressure_modes(shaken.block.mesh.kind) == 0) {
    EXPECT_EQ(at.condensed.norm(), 0.0);  // nothing is eliminated
    return;
  }
  EXPECT_GT(at.condensed.norm(), 1e-3 * at.residual.norm());
  const auto off = [&](double s) {  // the volume that is missed beyond the linear share of the step not taken
    const State m = moved(s);
    Eigen::VectorXd rest = Eigen::VectorXd::Zero(state.values.size());
    shaken.tissue().recover(m, rest);
    Eigen::VectorXd full = Eigen::VectorXd::Zero(state.values.size());
    shaken.tissue().recover(state, full);
    return (rest - (1.0 - s) * full).segment(shaken.scene.layout()["body cells"](0), 1)[0];
  };
  EXPECT_NEAR(off(0.2) / off(0.1), 4.0, 0.3);
}

INSTANTIATE_TEST_SUITE_P(
    KindsAndLaws, Cells,
    testing::Combine(testing::Values(CellKind::hex27, CellKind::hex8, CellKind::tet10),
                     testing::Values(neo_hooke(500.0, 0.4999),
                                     std::string("law = 'linear-elastic'\nyoungs_modulus = '1 MPa'\npoisson_ratio = 0.3"))),
    [](const auto& info) {
      const int kind = static_cast<int>(std::get<0>(info.param));
      return std::string(kind == 0 ? "hex27" : kind == 1 ? "hex8" : "tet10") +
             (std::get<1>(info.param).find("linear") < 20 ? "_displacement" : "_split");
    });

/// A pressure on a face whose border is free derives from no energy: its tangent is unsymmetric, and the derivative of its
/// forces all the same: the error of one-sided differences halves with the step. A border that is held in its plane, or held
/// wholly, makes it symmetric.
TEST(Loads, PressureOnAnOpenFaceHasItsUnsymmetricTangent) {
  for (const CellKind kind : {CellKind::hex27, CellKind::hex8, CellKind::tet10}) {
    const ShakenBlock shaken(kind, neo_hooke(500.0, 0.4999));
    const auto& load = *shaken.scene.find<solver::PressureLoad>();
    const Assembled at = assemble(load, shaken.state, Tangent::full);
    const Eigen::VectorXd direction = random_vector(shaken.state.values.size(), 1.0, 2), exact = at.tangent * direction;
    const auto error = [&](double h) {
      State moved = shaken.state;
      moved.values += h * direction;
      return ((assemble(load, moved, Tangent::none).residual - at.residual) / h - exact).norm() / exact.norm();
    };
    EXPECT_NEAR(error(1e-3) / error(5e-4), 2.0, 1e-3) << to_string(kind);
    EXPECT_FALSE(load.symmetric());
    EXPECT_GT(asymmetry(at.tangent), 1e-2) << to_string(kind);
    BlockCase led = ShakenBlock::make(kind, neo_hooke(500.0, 0.4999)), bonded = led;
    led.hold("left", 0.0, {}, {}), led.hold("right", 0.0, {}, {}), led.hold("front", {}, {}, 0.0), led.hold("back", {}, {}, 0.0);
    bonded.hold("top", 0.0, {}, 0.0);
    for (const BlockCase& c : {led, bonded})
      EXPECT_TRUE(tests::make_scene(c.c, c.mesh, {}, solver::Skin::deformable).find<solver::PressureLoad>()->symmetric());
  }
}

TEST(Loads, DeadLoadsSumToTractionTimesAreaAndWeight) {
  for (const CellKind kind : {CellKind::hex27, CellKind::hex8, CellKind::tet10}) {
    const ShakenBlock shaken(kind, neo_hooke(500.0, 0.4999));
    const Assembled at = assemble(*shaken.scene.find<solver::DeadLoad>(), shaken.state, Tangent::none);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int node = 0; node < shaken.scene.layout()["body"].count; ++node) sum += at.residual.segment<3>(3 * node);
    const Eigen::Vector3d exact(100.0, 50.0, 20.0 - 1060.0 * 9.81);  // on 1 m2, of 1 m3 of tissue
    EXPECT_LE((sum + 0.6 * exact).norm(), 1e-11 * exact.norm()) << to_string(kind);
  }
}

TEST(Facets, EveryKindHasAPartitionOfUnityWithItsDerivatives) {
  using mesh::FacetKind;
  for (const FacetKind kind : {FacetKind::quad9, FacetKind::quad4, FacetKind::tri6}) {
    const Eigen::Vector2d xi(0.21, 0.34);
    const auto shape = solver::facet_shape(kind, xi);
    EXPECT_NEAR(shape.N.sum(), 1.0, 1e-15);
    EXPECT_LE(shape.dN.colwise().sum().norm(), 1e-14);
    const double h = 1e-4;
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d step = h * Eigen::Vector2d::Unit(axis);
      const auto up = solver::facet_shape(kind, xi + step), down = solver::facet_shape(kind, xi - step);
      EXPECT_LE(((up.N - down.N) / (2 * h) - shape.dN.col(axis)).norm(), 1e-10);
      EXPECT_LE(((up.dN.col(axis) - down.dN.col(axis)) / (2 * h) - shape.ddN.col(axis)).norm(), 1e-10);
      EXPECT_LE(((up.dN.col(1 - axis) - down.dN.col(1 - axis)) / (2 * h) - shape.ddN.col(2)).norm(), 1e-10);
    }
  }
}

}  // namespace
}  // namespace snug::tests
