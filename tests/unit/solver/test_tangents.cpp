// Every term's tangent is the derivative of its residual, its residual the gradient of its energy.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

#include "solver/terms/skin_membrane_term.hpp"
#include "solver/terms/pressure_load.hpp"
#include "tests/unit/solver/terms.hpp"

namespace snug::tests {
namespace {

using solver::Skin, solver::State, solver::Tangent, solver::Term;

/// A coarse tube with a skin membrane, a pressure and a sleeve, off equilibrium everywhere: the sleeve is turned
/// against the skin, stretched along the axis by `axial`, and all nodes are shaken by 0.02 mm.
struct Shaken {
  input::Case description;
  solver::Meshes meshes;
  solver::Scene scene;
  State state;

  explicit Shaken(Skin skin, input::GapTests basis = input::GapTests::hat, double axial = 1.05)
      : description(describe(basis)),
        meshes(make_meshes(description)),
        scene(tests::make_scene(description, meshes, skin)),
        state(solver::placed_state(scene.layout(), meshes)) {
    const solver::Layout& layout = scene.layout();
    state.load = 0.6, state.stiffening = 3.0;
    state.values.head(layout.positions()) += random_vector(layout.positions(), 2e-5, 1);
    const Eigen::AngleAxisd turn(0.07, Eigen::Vector3d::UnitZ());
    const Eigen::Vector3d middle(0.0, 0.0, 0.03);
    for (int node = 0; node < layout["garment"].count; ++node) {
      auto x = state.values.segment<3>(layout["garment"](node));
      const Eigen::Vector3d arm = turn * (x - middle);
      x = middle + Eigen::Vector3d(arm.x(), arm.y(), axial * arm.z());
    }
    for (int i = 0; i < layout["contact"].count; ++i) state.values[layout["contact"](i)] = 5000.0 + 1000.0 * std::sin(i);
    for (const auto& term : scene.terms()) settle(*term, state);
  }

  static input::Case describe(input::GapTests basis) {
    TubeCase tube;
    tube.around = 6, tube.along = 2, tube.through = 1, tube.cell_size = 0.03, tube.basis = basis;
    input::Case c = describe_tube(tube);
    c.load.emplace();
    c.load->skin_pressure = 3000.0;
    input::LayerSpec& skin = c.body->layers.emplace_back();
    skin.name = "skin", skin.form = input::LayerForm::membrane, skin.thickness = 1.5e-3, skin.material.table = input::table_of(tube.tissue);
    return c;
  }

  /// Random direction of the positions, and what follows from them; contact pressures stay.
  Eigen::VectorXd direction() const {
    Eigen::VectorXd d = random_vector(scene.layout().size(), 1.0, 2);
    d.tail(scene.layout()["contact"].count).setZero();
    for (const auto& term : scene.terms()) term->recover(state, d);
    return d;
  }
  /// All multipliers decide for contact whatever the gap, so that the active set stays over the differences.
  solver::Contact& contact() {
    auto* contact = scene.find<solver::Contact>();
    contact->set_stiffness(1.0);
    contact->update(state);
    return *contact;
  }
};

void expect_energy_slope(const Term& term, const State& state, const Eigen::VectorXd& direction) {
  const auto energy = [&](double s) {
    State moved = state;
    moved.values += s * direction;
    return term.energy(moved);
  };
  const auto slope = [&](double h) { return (energy(h) - energy(-h)) / (2.0 * h); };
  const double extrapolated = (4.0 * slope(4e-6) - slope(8e-6)) / 3.0;
  const double exact = assemble(term, state, Tangent::none).residual.dot(direction);
  EXPECT_NEAR(extrapolated, exact, 1e-6 * std::abs(exact)) << term.name();
}

void expect_consistent(Term& term, const State& state, const Eigen::VectorXd& direction) {
  expect_factor_four(term, state, direction);
  expect_energy_slope(term, state, direction);
  EXPECT_LE(asymmetry(assemble(term, state, Tangent::full).tangent), 1e-12) << term.name();
}

TEST(Tangents, TissueIsTheSecondDerivativeOfItsEnergy) {
  Shaken shaken(Skin::deformable);
  expect_consistent(*shaken.scene.find<solver::Tissue>(), shaken.state, shaken.direction());
}

TEST(Tangents, SkinMembraneIsTheSecondDerivativeOfItsEnergy) {
  Shaken shaken(Skin::deformable);
  expect_consistent(*shaken.scene.find<solver::SkinMembraneTerm>(), shaken.state, shaken.direction());
}

TEST(Tangents, TautFabricIsTheSecondDerivativeOfItsEnergy) {
  Shaken shaken(Skin::deformable, input::GapTests::hat, 1.05);
  auto& fabric = *shaken.scene.find<solver::FabricMembrane>();
  for (int t = 0; t < fabric.triangles(); ++t) EXPECT_EQ(fabric.summary(shaken.state, t).wrinkled, 0.0);
  expect_consistent(fabric, shaken.state, shaken.direction());
}

TEST(Tangents, WrinkledFabricIsTheSecondDerivativeOfItsRelaxedEnergy) {
  Shaken shaken(Skin::deformable, input::GapTests::hat, 0.94);
  auto& fabric = *shaken.scene.find<solver::FabricMembrane>();
  for (int t = 0; t < fabric.triangles(); ++t) EXPECT_EQ(fabric.summary(shaken.state, t).wrinkled, 1.0);
  expect_consistent(fabric, shaken.state, shaken.direction());
}

class ContactTangent : public testing::TestWithParam<std::tuple<Skin, input::GapTests>> {};

TEST_P(ContactTangent, IsTheDerivativeOfForcesAndGapsWithPointsFoundAnew) {
  Shaken shaken(std::get<0>(GetParam()), std::get<1>(GetParam()));
  expect_factor_four(shaken.contact(), shaken.state, shaken.direction());
}

TEST_P(ContactTangent, IsSymmetricAlsoInItsConvexForm) {
  Shaken shaken(std::get<0>(GetParam()), std::get<1>(GetParam()));
  solver::Contact& contact = shaken.contact();
  for (const Tangent tangent : {Tangent::full, Tangent::convex})
    EXPECT_LE(asymmetry(assemble(contact, shaken.state, tangent).tangent), 1e-12);
}

TEST_P(ContactTangent, ForcesAreLinearInThePressures) {
  Shaken shaken(std::get<0>(GetParam()), std::get<1>(GetParam()));
  solver::Contact& contact = shaken.contact();
  const Eigen::Index forces = shaken.scene.layout()["contact"](0);
  Eigen::VectorXd direction = random_vector(shaken.scene.layout().size(), 1.0, 3);
  direction.head(forces).setZero();
  const Assembled at = assemble(contact, shaken.state, Tangent::full);
  State moved = shaken.state;
  moved.values += 1000.0 * direction;
  const Eigen::VectorXd change = (assemble(contact, moved, Tangent::none).residual - at.residual).head(forces);
  const Eigen::VectorXd exact = 1000.0 * (at.tangent * direction).head(forces);
  EXPECT_LE((change - exact).norm(), 1e-12 * exact.norm());
}

/// Contact that yields on a shaken tube, so stiff that it is pressed at half of its vertices and off the skin at the others.
struct Yielding {
  static constexpr double yielding = 2.0;
  Shaken shaken{Skin::rigid};
  solver::Contact& contact = *shaken.scene.find<solver::Contact>();
  Eigen::VectorXd direction = shaken.direction();
  double stiffness = 0.0;  // Pa/m

  Yielding() {
    contact.update(shaken.state);
    std::vector<double> ratio;  // at which the pressure that a vertex starts from is lost to its gap
    for (int i = 0; i < contact.vertices(); ++i)
      ratio.push_back(yielding * contact.multiplier(shaken.state, i) * contact.rest_area(i) / contact.history(shaken.state).weighted_gap[i]);
    std::nth_element(ratio.begin(), ratio.begin() + ratio.size() / 2, ratio.end());
    stiffness = 1.001 * ratio[ratio.size() / 2];
    contact.set_stiffness(stiffness);
  }
  State at(double s) const {
    State state = shaken.state;
    state.yielding = yielding;
    state.values += s * direction;
    contact.update(state);
    return state;
  }
};

// Forces of contact that yields are the slope of sum_i A_i y / (2 c) p_i^2, whatever pressures it went on from; nothing changes sides.
TEST(ContactThatYields, HasForcesThatAreTheSlopeOfAnEnergy) {
  const Yielding scene;
  const auto energy = [&](double s) {
    const State state = scene.at(s);
    double sum = 0.0;
    for (int i = 0; i < scene.contact.vertices(); ++i) sum += scene.contact.rest_area(i) * std::pow(scene.contact.multiplier(state, i), 2);
    return 0.5 * Yielding::yielding / scene.stiffness * sum;
  };
  const State state = scene.at(0.0);
  solver::Measure measure;
  scene.contact.measure(state, measure);
  EXPECT_GT(measure.active, 0);
  EXPECT_LT(measure.active, scene.contact.vertices());
  EXPECT_EQ(measure.changed, 0);
  EXPECT_EQ(measure.penetration, 0.0);
  const double h = 1e-8, slope = (energy(h) - energy(-h)) / (2.0 * h);
  const double exact = assemble(scene.contact, state, Tangent::none).residual.dot(scene.direction);
  EXPECT_NEAR(slope, exact, 1e-5 * std::abs(exact));
}

// With the pressures following the positions, its tangent is the derivative of its forces, and its rows stay fulfilled.
TEST(ContactThatYields, HasATangentInWhichPressuresFollow) {
  const Yielding scene;
  const Eigen::Index forces = scene.shaken.scene.layout()["contact"](0);
  const double h = 1e-8;
  const State state = scene.at(0.0);
  EXPECT_GT(state.values.tail(scene.contact.vertices()).maxCoeff(), 0.0);
  const Eigen::VectorXd along = (scene.at(h).values - scene.at(-h).values) / (2.0 * h);
  const Assembled now = assemble(scene.contact, state, Tangent::full);
  const Eigen::VectorXd change = (assemble(scene.contact, scene.at(h), Tangent::none).residual - assemble(scene.contact, scene.at(-h), Tangent::none).residual) / (2.0 * h);
  const Eigen::VectorXd expected = now.tangent * along;
  EXPECT_LE((change - expected).head(forces).norm(), 1e-4 * expected.head(forces).norm());
  EXPECT_LE(expected.tail(expected.size() - forces).norm(), 1e-4 * (now.tangent.bottomLeftCorner(expected.size() - forces, forces) * along.head(forces)).norm());
  EXPECT_LE(now.residual.tail(expected.size() - forces).norm(), 1e-12 * now.residual.norm());
}

// Pressure on what bulges is unstable by itself: its stiffness has negative eigenvalues, which the convex form leaves out.
TEST(ContactThatYields, IsPositiveInItsConvexForm) {
  const Yielding scene;
  const Eigen::Index forces = scene.shaken.scene.layout()["contact"](0);
  const State state = scene.at(0.0);
  const auto eigenvalues = [&](Tangent tangent) -> Eigen::VectorXd {
    const Eigen::MatrixXd matrix = Eigen::MatrixXd(assemble(scene.contact, state, tangent).tangent).topLeftCorner(forces, forces);
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
  };
  const double scale = eigenvalues(Tangent::full).cwiseAbs().maxCoeff();
  EXPECT_LT(eigenvalues(Tangent::full).minCoeff(), -0.1 * scale);
  EXPECT_GT(eigenvalues(Tangent::convex).minCoeff(), -1e-12 * scale);
}

INSTANTIATE_TEST_SUITE_P(SkinsAndBases, ContactTangent,
                         testing::Combine(testing::Values(Skin::rigid, Skin::deformable),
                                          testing::Values(input::GapTests::hat, input::GapTests::dual)),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param) == Skin::rigid ? "rigid_" : "deformable_") +
                                  text_of(std::get<1>(info.param));
                         });

/// The force is a quadratic polynomial of the positions, so that central differences are exact at any step.
TEST(Tangents, SkinPressureIsExactAndSymmetricWhereTheCutPlanesStand) {
  Shaken shaken(Skin::deformable);
  auto& load = *shaken.scene.find<solver::PressureLoad>();
  Eigen::VectorXd direction = shaken.direction();
  for (const char* name : {"lower", "upper"})
    for (const int node : shaken.meshes.body.surface(name)->nodes) direction.segment<3>(shaken.scene.layout()["body"](node)).setZero();
  for (const double error : tangent_errors(load, shaken.state, direction, 1e-3)) EXPECT_LE(error, 1e-11);
  EXPECT_LE(asymmetry(assemble(load, shaken.state, Tangent::full).tangent), 1e-12);
}

/// What the symmetric part leaves out is a force of the edges' supports, whose rows do not count. Where nothing holds the
/// edges the whole tangent is assembled, and exact in all rows.
TEST(Tangents, PressureOnAGarmentIsExactWhereItsEdgesStayInAPlane) {
  Shaken shaken(Skin::rigid);
  const solver::Layout& layout = shaken.scene.layout();
  solver::PressureLoad load(layout["garment"], shaken.meshes.garments.front(), -3000.0);
  Eigen::VectorXd free = Eigen::VectorXd::Ones(layout.size());
  for (const auto& [name, nodes] : shaken.meshes.garments.front().edges)
    for (const int node : nodes) {
      shaken.state.values[layout["garment"](node, 2)] = name == "upper" ? 0.06 : 0.0;
      free[layout["garment"](node, 2)] = 0.0;
    }
  const Eigen::VectorXd direction = shaken.direction().cwiseProduct(free);
  const auto residual_at = [&](double s) {
    State moved = shaken.state;
    moved.values += s * direction;
    return assemble(load, moved, Tangent::none).residual;
  };
  const Eigen::VectorXd rate = (residual_at(1e-3) - residual_at(-1e-3)) / 2e-3;  // exact: the force is quadratic
  EXPECT_LE((rate - assemble(load, shaken.state, Tangent::full).tangent * direction).norm(), 1e-11 * rate.norm());
  EXPECT_FALSE(load.symmetric());
  load.hold_border(shaken.scene.numbering());
  ASSERT_TRUE(load.symmetric());
  const Eigen::VectorXd error = rate - assemble(load, shaken.state, Tangent::full).tangent * direction;
  EXPECT_LE(error.cwiseProduct(free).norm(), 1e-11 * rate.norm());
  EXPECT_GT(error.norm(), 1e-3 * rate.norm());
}

// The pressure blows up: on a closed sleeve between two planes its force along outward normals does the work p dV.
TEST(Tangents, NegativePressureOnAGarmentPushesItOutwards) {
  Shaken shaken(Skin::rigid);
  const solver::Layout& layout = shaken.scene.layout();
  const solver::PressureLoad load(layout["garment"], shaken.meshes.garments.front(), -3000.0);
  const Eigen::VectorXd force = -assemble(load, shaken.state, Tangent::none).residual;
  double outwards = 0.0;
  for (int node = 0; node < layout["garment"].count; ++node)
    outwards += force.segment<2>(layout["garment"](node)).dot(shaken.state.values.segment<2>(layout["garment"](node)));
  EXPECT_GT(outwards, 0.0);
}

TEST(StepBound, AnInvertingDirectionIsCutBeforeACellInverts) {
  const Shaken shaken(Skin::deformable);
  const auto& tissue = *shaken.scene.find<solver::Tissue>();
  const solver::Layout& layout = shaken.scene.layout();
  Eigen::VectorXd inwards = Eigen::VectorXd::Zero(layout.size());  // turns the tube inside out at a full step
  for (int node = 0; node < layout["body"].count; ++node) {
    const Eigen::Vector2d x = shaken.meshes.body.nodes[node].head<2>();
    inwards.segment<2>(layout["body"](node)) = -2.0 * (x.norm() - 0.020) * x.normalized();
  }
  const double bound = tissue.step_bound(shaken.state, inwards, 1.0);
  const auto admissible = [&](double fraction) {
    State moved = shaken.state;
    moved.values += fraction * inwards;
    return std::isfinite(tissue.energy(moved));
  };
  EXPECT_GT(bound, 0.3);
  EXPECT_LT(bound, 0.5);  // radial stretch 1 - 2 a
  EXPECT_TRUE(admissible(bound));
  EXPECT_TRUE(admissible(bound / 0.9));  // the root of det F = 0.05 det F0, before the safety factor
  EXPECT_FALSE(admissible(0.55));
  EXPECT_EQ(tissue.step_bound(shaken.state, -0.2 * inwards, 1.0), 1.0);  // outwards: nothing to cut
}

}  // namespace
}  // namespace snug::tests
