// Cells of every kind and law: the tangent is the derivative of the residual, the residual the gradient of the energy.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "solver/terms/dead_load.hpp"
#include "solver/terms/facet_kind.hpp"
#include "solver/terms/pressure_load.hpp"
#include "tests/unit/solver/terms.hpp"
#include "tests/verification/blocks.hpp"

namespace snug::tests {
namespace {

using solver::State, solver::Tangent;

/// Two cells of each direction in two layers, all nodes shaken and pressures off their law.
struct ShakenBlock {
  BlockCase block;
  solver::Scene scene;
  State state;

  ShakenBlock(CellKind kind, const std::string& second)
      : block(make(kind, second)),
        scene(solver::make_scene(block.c, block.mesh, {}, solver::Skin::deformable)),
        state(solver::placed_state(scene.layout(), block.mesh, {})) {
    const solver::Layout& layout = scene.layout();
    state.load = 0.6, state.stiffening = 2.0;
    state.values.head(layout.pressure(0)) += random_vector(layout.pressure(0), 0.02, 1);
    state.values.segment(layout.pressure(0), layout.pressures) = random_vector(layout.pressures, 500.0, 3);
  }

  static BlockCase make(CellKind kind, const std::string& second) {
    Block grid;
    grid.cells = {2, 2, 2}, grid.kind = kind;
    grid.layers = {"soft", "other"};
    grid.layer = [](const Eigen::Vector3d& middle) { return middle.x() > 0.5 ? 1 : 0; };
    BlockCase block(make_block(grid), {neo_hooke(10.0, 0.49), second});
    block.traction("right", 100.0, 50.0, 20.0), block.pressure("top", 800.0);
    block.c.load->gravity = {0.0, 0.0, -9.81};
    return block;
  }

  /// Positions by 1, pressures by 1e4: both move the residual alike.
  Eigen::VectorXd direction() const {
    Eigen::VectorXd d = random_vector(scene.layout().size(), 1.0, 2);
    d.tail(scene.layout().pressures) *= 1e4;
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

TEST(Loads, DeadLoadsSumToTractionTimesAreaAndWeight) {
  for (const CellKind kind : {CellKind::hex27, CellKind::hex8, CellKind::tet10}) {
    const ShakenBlock shaken(kind, neo_hooke(500.0, 0.4999));
    const Assembled at = assemble(*shaken.scene.find<solver::DeadLoad>(), shaken.state, Tangent::none);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int node = 0; node < shaken.scene.layout().body_nodes; ++node) sum += at.residual.segment<3>(3 * node);
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
