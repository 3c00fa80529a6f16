// Contact whose slave is a curved surface of quadratic tetrahedra: its tangent is the derivative of its forces and gaps, its
// areas are those of the curved facets, and it acts with equal and opposite forces.
#include <gtest/gtest.h>

#include "tests/unit/solver/terms.hpp"
#include "tests/verification/two_solids.hpp"

namespace snug::tests {
namespace {

using solver::Tangent;

Solid tube(double inner, double outer, int round, CellKind kind, const std::string& surface) {
  Block block;
  block.cells = {round, 1, 2}, block.closed = true, block.kind = kind, block.map = ring(inner, outer, 0.05);
  return {make_block(block), surface, 10e3, 0.3};
}

/// Two rings that overlap by 0.1 mm, all nodes shaken by 0.02 mm, all vertices pressed.
struct Rings {
  TwoSolids two;
  solver::Scene scene;
  State& state = two.state;

  explicit Rings(CellKind master)
      : two(tube(0.02, 0.0401, 9, master, "top"), tube(0.04, 0.06, 7, CellKind::tet10, "bottom")), scene(two.scene()) {
    const Layout& layout = two.layout;
    state.values.head(layout.positions()) += random_vector(layout.positions(), 2e-5, 1);
    for (int i = 0; i < layout["contact"].count; ++i) state.values[layout["contact"](i)] = 5000.0 + 1000.0 * std::sin(i);
    contact().set_stiffness(1.0);  // all vertices decide for contact
    contact().update(state);
  }
  solver::Contact& contact() { return *scene.find<solver::Contact>(); }
  Eigen::VectorXd direction() const {
    Eigen::VectorXd d = random_vector(two.layout.size(), 1.0, 2);
    d.tail(two.layout.size() - two.layout.positions()).setZero();
    return d;
  }
};

class SolidSlave : public testing::TestWithParam<CellKind> {};

TEST_P(SolidSlave, TangentIsTheDerivativeOfForcesAndGaps) {
  Rings rings(GetParam());
  expect_factor_four(rings.contact(), rings.state, rings.direction());
  for (const Tangent tangent : {Tangent::full, Tangent::convex})
    EXPECT_LE(asymmetry(assemble(rings.contact(), rings.state, tangent).tangent), 1e-12);
}

TEST_P(SolidSlave, BothSidesFeelTheSameForcesAndMoments) {
  Rings rings(GetParam());
  const Eigen::VectorXd residual = assemble(rings.contact(), rings.state, Tangent::none).residual;
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  double sum = 0.0;
  for (int entry = 0; entry < rings.two.layout.positions(); entry += 3) {
    const Eigen::Vector3d f = residual.segment<3>(entry);
    force += f, moment += rings.state.values.segment<3>(entry).cross(f), sum += f.norm();
  }
  EXPECT_LE(force.norm(), 1e-12 * sum);
  EXPECT_LE(moment.norm(), 1e-12 * 0.05 * sum);
}

// The bore of the outer ring measures 2 pi R L up to the fourth power of the facets' angle; the rule's points have it all.
TEST_P(SolidSlave, AreasAreThoseOfTheCurvedFacets) {
  Rings rings(GetParam());
  const double exact = 2.0 * std::numbers::pi * 0.04 * 0.05;
  double vertices = 0.0, points = 0.0;
  for (const auto& vertex : rings.two.vertices()) vertices += vertex.area;
  EXPECT_NEAR(vertices, exact, 1e-3 * exact);
  std::vector<solver::Contact::Meeting> met;
  for (int t = 0; t < rings.contact().triangles(); ++t) {
    rings.contact().meetings(rings.state, t, met);
    for (const auto& point : met) points += point.weight;
  }
  EXPECT_NEAR(points, vertices, 1e-3 * exact);  // the shaken ends do not quite overlap
}

INSTANTIATE_TEST_SUITE_P(Masters, SolidSlave, testing::Values(CellKind::hex27, CellKind::hex8, CellKind::tet10),
                         [](const auto& info) {
                           return info.param == CellKind::hex27 ? "hex27" : info.param == CellKind::hex8 ? "hex8" : "tet10";
                         });

}  // namespace
}  // namespace snug::tests
