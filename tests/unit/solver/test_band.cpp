// The elastic band: its tangent and residual belong to its energy, its rest length follows the way of the fabric.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "solver/scene/bands.hpp"
#include "tests/unit/solver/terms.hpp"

namespace snug::tests {
namespace {

using solver::Skin;

/// A sleeve on a coarse tube with a band along its upper edge, its nodes shaken by 0.5 mm.
struct Banded {
  input::Case description;
  solver::Meshes meshes;
  solver::Scene scene;
  solver::State state;

  explicit Banded(double load, int order = 2)
      : description(describe(order)), meshes(make_meshes(description)), scene(tests::make_scene(description, meshes, Skin::rigid)),
        state(solver::placed_state(scene.layout(), meshes)) {
    state.load = load;
  }
  static input::Case describe(int order) {
    TubeCase tube;
    tube.around = 6, tube.along = 2, tube.through = 1, tube.cell_size = 0.02;
    input::Case c = describe_tube(tube);
    c.garments.front().order = order;
    c.garments.front().band = {{.edge = "upper", .rest_length = "-8 %", .stiffness = 400.0, .width = 0.025}};
    return c;
  }
  const solver::Band& band() const { return *scene.find<solver::Band>(); }
};

TEST(Band, IsTheSecondDerivativeOfItsEnergy) {
  for (const double load : {0.4, 1.0}) {
    Banded banded(load);
    banded.state.values.head(banded.scene.layout().positions()) += random_vector(banded.scene.layout().positions(), 5e-4, 1);
    const Eigen::VectorXd direction = random_vector(banded.state.values.size(), 1.0, 2);
    expect_factor_four(banded.band(), banded.state, direction);
    const auto energy = [&](double s) {
      solver::State moved = banded.state;
      moved.values += s * direction;
      return banded.band().energy(moved);
    };
    const auto slope = [&](double h) { return (energy(h) - energy(-h)) / (2.0 * h); };
    const double exact = assemble(banded.band(), banded.state, solver::Tangent::none).residual.dot(direction);
    EXPECT_NEAR((4.0 * slope(4e-6) - slope(8e-6)) / 3.0, exact, 1e-6 * std::abs(exact));
    EXPECT_LE(asymmetry(assemble(banded.band(), banded.state, solver::Tangent::full).tangent), 1e-12);
  }
}

// Placed it is without tension; at full load it is stretched from 0.92 of the edge as cut to where it is.
TEST(Band, ItsRestLengthGoesFromThePlacedEdgeToItsOwn) {
  for (const int order : {1, 2}) {
    Banded banded(0.0, order);
    EXPECT_NEAR(banded.band().worn(banded.state).largest, 0.0, 1e-9);
    const double cut = banded.description.garments.front().pattern.flat_circumference, placed = banded.band().worn(banded.state).length;
    EXPECT_NEAR(banded.band().rest_length(), 0.92 * cut, 1e-9);
    EXPECT_NEAR(placed, 2.0 * std::numbers::pi * 0.0552, order == 2 ? 1e-4 : 6e-3);
    banded.state.load = 1.0;
    EXPECT_NEAR(banded.band().worn(banded.state).tension, 10.0 * (placed / (0.92 * cut) - 1.0), 2e-2);
    // halfway its rest length is the geometric mean of both
    banded.state.load = 0.5;
    EXPECT_NEAR(banded.band().worn(banded.state).tension, 10.0 * (std::sqrt(placed / (0.92 * cut)) - 1.0), 2e-2);
  }
}

TEST(Band, AShortenedOneBearsNothing) {
  Banded banded(1.0);
  const solver::Field& garment = banded.scene.layout()["garment"];
  for (int node = 0; node < garment.count; ++node) banded.state.values.segment<2>(garment(node)) *= 0.6;
  EXPECT_EQ(banded.band().energy(banded.state), 0.0);
  EXPECT_EQ(assemble(banded.band(), banded.state, solver::Tangent::full).residual.norm(), 0.0);
}

// A closed line turns by 2 pi, and its tension times its curvature is what it presses with.
TEST(Band, PressesWithItsTensionTimesItsCurvature) {
  Banded banded(1.0);
  const solver::Band::Worn worn = banded.band().worn(banded.state);
  EXPECT_NEAR(worn.turn, 2.0 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(worn.line_load(), worn.tension / 0.0552, 1e-3 * worn.tension / 0.0552);
}

TEST(Band, IsNotThereWhereTheCaseNamesNoneAndRefusedAtAnEdgeThatIsNot) {
  input::Case c = Banded::describe(2);
  const solver::Meshes meshes = make_meshes(c);
  c.garments.front().band.front().edge = "cuff";
  try {
    tests::make_scene(c, meshes, Skin::rigid);
    FAIL() << "a band along an edge that is not there";
  } catch (const input::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("garment has no edge \"cuff\" for a band; its edges are: \"lower\", \"upper\""));
  }
  c.garments.front().band.clear();
  EXPECT_EQ(tests::make_scene(c, meshes, Skin::rigid).find<solver::Band>(), nullptr);
}

}  // namespace
}  // namespace snug::tests
