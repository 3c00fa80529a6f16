// Patch tests of contact between two solids whose flat faces have meshes that do not match.
#include <gtest/gtest.h>

#include "tests/verification/book.hpp"
#include "tests/verification/two_solids.hpp"

namespace snug::tests {
namespace {

/// Two blocks of 1 x 1 x 0.5 m, one upon the other; their common face goes through (0.5, 1) and is tilted in the plane of x
/// and y. 3 x 3 cells below, 4 x 5 above.
struct Arrangement {
  double degrees = 0.0;
  double below = 1.0, above = 1.0;  ///< Young's moduli, Pa
  bool lower_is_slave = false;
  bool tetrahedra = true;           ///< of the master, too
  std::string words() const {
    return fmt::format("{} deg, E {:g} {:g}, {} slave, {}", degrees, below, above, lower_is_slave ? "lower" : "upper",
                       tetrahedra ? "tetrahedra" : "master of hexahedra");
  }
};

Solid lower_block(const Arrangement& a) {
  const double slope = std::tan(a.degrees * std::numbers::pi / 180.0);
  Block block;
  block.cells = {3, 3, 1};
  block.map = [=](const Eigen::Vector3d& u) { return Eigen::Vector3d(u.x(), u.y() * (1.0 + slope * (u.x() - 0.5)), 0.5 * u.z()); };
  block.kind = a.lower_is_slave || a.tetrahedra ? CellKind::tet10 : CellKind::hex27;
  return {make_block(block), "top", a.below, 0.3};
}

Solid upper_block(const Arrangement& a) {
  const double slope = std::tan(a.degrees * std::numbers::pi / 180.0);
  Block block;
  block.cells = {4, 5, 2};
  block.map = [=](const Eigen::Vector3d& u) {
    return Eigen::Vector3d(u.x(), 2.0 - (1.0 - u.y()) * (1.0 - slope * (u.x() - 0.5)), 0.5 * u.z());
  };
  block.kind = a.lower_is_slave && !a.tetrahedra ? CellKind::hex27 : CellKind::tet10;
  return {make_block(block), "bottom", a.above, 0.3};
}

struct Blocks : TwoSolids {
  Solid &lower, &upper;
  explicit Blocks(const Arrangement& a)
      : TwoSolids(a.lower_is_slave ? upper_block(a) : lower_block(a), a.lower_is_slave ? lower_block(a) : upper_block(a)),
        lower(a.lower_is_slave ? slave : master), upper(a.lower_is_slave ? master : slave) {
    for (const Solid* solid : {&lower, &upper}) hold(*solid, "front", 2), hold(*solid, "back", 2);
  }
  void load(Solid& solid, const std::string& face, const Eigen::Vector3d& traction) {
    solver::add_traction(solid.mesh, solid.mesh.surface(face)->facets, traction, solid.forces);
  }
};

/// A block pressed along n that keeps its lateral shape: F = 1 + e n n, first Piola-Kirchhoff stress
/// -p n n + q (1 - n n) with (1 + e) (lambda + 2 mu) (e + e^2/2) = -p, q = lambda (e + e^2/2) (St. Venant-Kirchhoff).
struct Pressed {
  double strain, lateral;  ///< e, q
  Pressed(const Solid& solid, double pressure) {
    const double E = solid.youngs_modulus, nu = solid.poisson;
    const double lame = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), modulus = lame + E / (1.0 + nu);
    strain = -pressure / modulus;
    const auto green = [&] { return strain + 0.5 * strain * strain; };
    for (int i = 0; i < 50; ++i)
      strain -= ((1.0 + strain) * green() + pressure / modulus) / (green() + (1.0 + strain) * (1.0 + strain));
    lateral = lame * green();
  }
};

struct Errors {
  double pressure, soft_stress, stiff_stress;
};

/// Largest deviations from the pressure when the outer faces of both blocks feel the tractions of that state, in which
/// nothing slips at the common face whatever its tilt.
Errors press_along_the_normal(const Arrangement& arrangement) {
  const double pressure = 0.02, angle = arrangement.degrees * std::numbers::pi / 180.0;
  Blocks blocks(arrangement);
  const Eigen::Vector3d n(-std::sin(angle), std::cos(angle), 0.0), middle(0.5, 1.0, 0.0);
  for (Solid* solid : {&blocks.lower, &blocks.upper}) {
    const Pressed at(*solid, pressure);
    const auto load = [&](const std::string& face, const Eigen::Vector3d& normal) {
      blocks.load(*solid, face, -pressure * n.dot(normal) * n + at.lateral * (normal - n.dot(normal) * n));
    };
    load("left", -Eigen::Vector3d::UnitX()), load("right", Eigen::Vector3d::UnitX());
    if (solid == &blocks.upper) load("top", Eigen::Vector3d::UnitY());
    for (int node = 0; node < static_cast<int>(solid->mesh.nodes.size()); ++node)
      blocks.state.values.segment<3>(blocks.entry(*solid, node)) += at.strain * n.dot(solid->mesh.nodes[node] - middle) * n;
  }
  for (int c = 0; c < 3; ++c) blocks.hold(blocks.lower, "bottom", c);
  blocks.fixed.fix(blocks.entry(blocks.upper, blocks.upper.mesh.surface("top")->nodes.front(), 0));  // else it slides
  // closed at the start: nothing but contact holds the upper block up
  blocks.state.values.tail(blocks.layout["contact"].count).setConstant(0.5 * pressure);
  solver::Scene scene = blocks.scene();
  EXPECT_EQ(blocks.solve(scene, 1e-13), solver::Outcome::converged) << arrangement.words();

  const auto stress_error = [&](const Solid& solid) {
    double worst = 0.0;
    for (const auto& [node, stress] : nodal_stress(blocks, solid)) worst = std::max(worst, std::abs(n.dot(stress * n) / pressure + 1.0));
    return worst;
  };
  const bool soft_below = arrangement.below < arrangement.above;
  return {blocks.unevenness(pressure), stress_error(soft_below ? blocks.lower : blocks.upper),
          stress_error(soft_below ? blocks.upper : blocks.lower)};
}

// Two blocks pressed together transmit a uniform pressure exactly, whatever the tilt of their common face, the ratio of
// their moduli, which of them is the slave, and whether the master is made of tetrahedra or hexahedra.
// The stress of the stiff block is known no better than round-off of its positions makes it: about eps E |x| / (h p) = 1e-7.
TEST(SolidContact, PatchTestOfTwoBlocksIsExact) {
  const std::string source = "uniform state; reference book 3, patch test: 1e-10";
  for (const double degrees : {0.0, 10.0, 37.0}) {
    Errors even{}, contrast{};
    const auto enlarge = [](double& worst, double error) { worst = std::max(worst, error); };
    for (const bool lower_is_slave : {false, true})
      for (const bool tetrahedra : {false, true}) {
        const Errors same = press_along_the_normal({degrees, 1.0, 1.0, lower_is_slave, tetrahedra});
        enlarge(even.pressure, same.pressure), enlarge(even.soft_stress, std::max(same.soft_stress, same.stiff_stress));
        for (const bool stiff_below : {false, true}) {
          const Errors errors = press_along_the_normal(
              {degrees, stiff_below ? 1e6 : 1.0, stiff_below ? 1.0 : 1e6, lower_is_slave, tetrahedra});
          enlarge(contrast.pressure, errors.pressure), enlarge(contrast.soft_stress, errors.soft_stress);
          enlarge(contrast.stiff_stress, errors.stiff_stress);
        }
      }
    const std::string scene = fmt::format("3 patch test of two blocks, {} deg", degrees);
    book(scene, "contact pressure, E2 = E1: largest deviation", even.pressure, 0.0, 1e-10, source);
    book(scene, "normal stress, E2 = E1: largest deviation", even.soft_stress, 0.0, 1e-10, source);
    book(scene, "contact pressure, E2 = 1e6 E1: largest deviation", contrast.pressure, 0.0, 1e-10, source);
    book(scene, "normal stress in the soft block: largest deviation", contrast.soft_stress, 0.0, 1e-10, source);
    book(scene, "normal stress in the stiff block: largest deviation", contrast.stiff_stress, 0.0, 1e-6,
         "uniform state; bound: round-off of positions");
  }
}

// With free sides in plane strain the soft block widens and slides under the stiff one: linear theory up to terms of the
// order of the strain, 1e-6 here.
TEST(SolidContact, BlocksWithFreeSidesSettleAsInLinearTheory) {
  const double pressure = 1e-6;
  Blocks blocks({0.0, 1.0, 1e6});
  blocks.load(blocks.upper, "top", {0.0, -pressure, 0.0});
  blocks.hold(blocks.lower, "bottom", 1);
  for (const Solid* solid : {&blocks.lower, &blocks.upper})
    blocks.fixed.fix(blocks.entry(*solid, solid->mesh.surface("bottom")->nodes.front(), 0));
  blocks.state.values.tail(blocks.layout["contact"].count).setConstant(0.5 * pressure);
  solver::Scene scene = blocks.scene();
  ASSERT_EQ(blocks.solve(scene, 1e-14), solver::Outcome::converged);
  double sunk = 0.0;
  const auto& top = blocks.upper.mesh.surface("top")->nodes;
  for (const int node : top) sunk += (2.0 - blocks.place(blocks.upper, node).y()) / static_cast<double>(top.size());
  const std::string source = "reference book 3, patch test; bound: order of the strain";
  book("3 patch test of two blocks, free sides", "settlement, E2 = 1e6 E1", sunk / pressure, 0.91 + 9.1e-7, 1e-5, source);
  book("3 patch test of two blocks, free sides", "contact pressure: largest deviation", blocks.unevenness(pressure), 0.0, 1e-5, source);
}

}  // namespace
}  // namespace snug::tests
