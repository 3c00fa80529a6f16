// Friction with the frames of its last update: its tangent is the derivative of its forces, its forces that of its
// potential; garment and skin feel opposite forces and moments; no traction exceeds the bound.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/unit/solver/terms.hpp"

namespace snug::tests {
namespace {

using solver::Skin, solver::State, solver::Tangent;

/// A coarse sleeve on a tube, moved against the skin by `slip` (m, round the tube and along it) since a reference state
/// in which its tractions were not zero; all nodes shaken, so that there are gaps, too.
struct Rubbed {
  input::Case description;
  solver::Meshes meshes;
  solver::Scene scene;
  State state;

  explicit Rubbed(Skin skin, double slip, double mu = 0.3)
      : description(describe(mu)), meshes(make_meshes(description)),
        scene(tests::make_scene(description, meshes, skin)),
        state(solver::placed_state(scene.layout(), meshes)) {
    const solver::Layout& layout = scene.layout();
    state.values.head(layout.positions()) += random_vector(layout.positions(), 2e-5, 1);
    for (int i = 0; i < layout["contact"].count; ++i) state.values[layout["contact"](i)] = 5000.0 + 1000.0 * std::sin(i);
    scene.find<solver::Contact>()->set_stiffness(1.0);  // all vertices decide for contact
    friction().renew(state);
    update();
    scene.commit(state);
    auto& history = state.history.edit<solver::FrictionHistory>("friction");
    history.traction = random_vector(history.traction.size(), 300.0, 4);
    const Eigen::AngleAxisd turn(slip / 0.055, Eigen::Vector3d::UnitZ());
    for (int node = 0; node < layout["garment"].count; ++node) {
      auto x = state.values.segment<3>(layout["garment"](node));
      x = turn * x + Eigen::Vector3d(0.0, 0.0, 0.6 * slip);
    }
    state.values.head(layout.positions()) += random_vector(layout.positions(), 0.3 * slip, 5);
    update();
  }

  solver::Friction& friction() { return *scene.find<solver::Friction>(); }
  void update() {
    scene.find<solver::Contact>()->update(state);
    friction().update(state);
  }

  static input::Case describe(double mu) {
    TubeCase tube;
    tube.around = 6, tube.along = 2, tube.through = 1, tube.cell_size = 0.03;
    input::Case c = describe_tube(tube);
    c.contacts.front().friction = mu;
    return c;
  }

  Eigen::VectorXd direction() const { return random_vector(scene.layout().size(), 1.0, 2); }
};

// One that sticks everywhere (elastic slip is 0.15 mm here), one that slips everywhere.
constexpr double sticking = 1e-6, slipping = 1e-3;

class FrictionTangent : public testing::TestWithParam<std::tuple<Skin, double>> {};

TEST_P(FrictionTangent, IsTheDerivativeOfTheForcesAndTheForcesThatOfThePotential) {
  Rubbed rubbed(std::get<0>(GetParam()), std::get<1>(GetParam()));
  const auto& friction = rubbed.friction();
  const Eigen::VectorXd direction = rubbed.direction();
  const auto moved = [&](double s) {
    State m = rubbed.state;
    m.values += s * direction;
    return m;
  };
  const Assembled at = assemble(friction, rubbed.state, Tangent::full);
  const Eigen::VectorXd exact = at.tangent * direction;
  const auto error = [&](double h) {
    const Eigen::VectorXd difference = assemble(friction, moved(h), Tangent::none).residual -
                                       assemble(friction, moved(-h), Tangent::none).residual;
    return (difference / (2.0 * h) - exact).norm() / exact.norm();
  };
  if (std::get<1>(GetParam()) == sticking) {
    EXPECT_LE(error(1e-6), 1e-8);  // linear: differences are exact
  } else {
    const double first = error(4e-5), second = error(2e-5), third = error(1e-5);
    EXPECT_NEAR(first / second, 4.0, 0.3) << first << " " << second;
    EXPECT_NEAR(second / third, 4.0, 0.3) << second << " " << third;
  }
  const auto slope = [&](double h) { return (friction.energy(moved(h)) - friction.energy(moved(-h))) / (2.0 * h); };
  const double exact_slope = at.residual.dot(direction);
  EXPECT_NEAR((4.0 * slope(4e-6) - slope(8e-6)) / 3.0, exact_slope, 1e-6 * std::abs(exact_slope));
}

TEST_P(FrictionTangent, IsSymmetricAndPositiveSemidefinite) {
  Rubbed rubbed(std::get<0>(GetParam()), std::get<1>(GetParam()));
  const Eigen::MatrixXd K = assemble(rubbed.friction(), rubbed.state, Tangent::full).tangent;
  EXPECT_LE((K - K.transpose()).norm(), 1e-12 * K.norm());
  for (unsigned seed = 10; seed < 20; ++seed) {
    const Eigen::VectorXd d = random_vector(K.rows(), 1.0, seed);
    EXPECT_GE(d.dot(K * d), 0.0);
  }
}

/// What an update makes of other pressures is what stands in no matrix: forces of corners that slip, none of those that stick.
TEST_P(FrictionTangent, WhatFollowsThePressuresIsTheirDerivativeOnOneSide) {
  Rubbed rubbed(std::get<0>(GetParam()), std::get<1>(GetParam()));
  const auto& layout = rubbed.scene.layout();
  Eigen::VectorXd pressures = Eigen::VectorXd::Zero(layout.size());
  for (int i = 0; i < layout["contact"].count; ++i) pressures[layout["contact"](i)] = 100.0 * std::cos(2.0 * i);
  std::vector<Eigen::Triplet<double>> parts;
  rubbed.friction().add_one_way(rubbed.state, parts);
  Eigen::SparseMatrix<double> derivative(layout.size(), layout.size());
  derivative.setFromTriplets(parts.begin(), parts.end());
  const Eigen::VectorXd expected = derivative * pressures, before = assemble(rubbed.friction(), rubbed.state, Tangent::none).residual;
  rubbed.state.values += pressures;
  rubbed.update();
  const Eigen::VectorXd found = assemble(rubbed.friction(), rubbed.state, Tangent::none).residual - before;
  EXPECT_LE((found - expected).norm(), 1e-11 * before.norm());
  if (std::get<1>(GetParam()) == sticking) {
    EXPECT_TRUE(parts.empty());
  } else {
    EXPECT_GE(expected.norm(), 1e-3 * before.norm());
  }
}

TEST_P(FrictionTangent, TractionsKeepTheBound) {
  Rubbed rubbed(std::get<0>(GetParam()), std::get<1>(GetParam()));
  const auto& layout = rubbed.scene.layout();
  int slips = 0, sticks = 0;
  const auto vertices = rubbed.friction().vertex_tractions(rubbed.state);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double bound = 0.3 * rubbed.state.values[layout["contact"](static_cast<int>(i))];
    EXPECT_LE(vertices[i].traction.norm(), (1.0 + 1e-12) * bound);
    (vertices[i].slip == solver::Friction::Slip::slip ? slips : sticks) += 1;
  }
  EXPECT_EQ(std::get<1>(GetParam()) == sticking ? slips : sticks, 0);
}

INSTANTIATE_TEST_SUITE_P(SkinsAndSlips, FrictionTangent,
                         testing::Combine(testing::Values(Skin::rigid, Skin::deformable),
                                          testing::Values(sticking, slipping)),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param) == Skin::rigid ? "rigid_" : "deformable_") +
                                  (std::get<1>(info.param) == sticking ? "sticks" : "slips");
                         });

/// Forces on the nodes of garment and skin sum to nothing, and so do their moments, although there are gaps.
TEST(Friction, ForcesAndMomentsBalanceToRoundOff) {
  Rubbed rubbed(Skin::deformable, slipping);
  const auto& layout = rubbed.scene.layout();
  const Eigen::VectorXd f = assemble(rubbed.friction(), rubbed.state, Tangent::none).residual;
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  double size = 0.0;
  for (int entry = 0; entry < layout.positions(); entry += 3) {
    const Eigen::Vector3d x = rubbed.state.values.segment<3>(entry), nodal = f.segment<3>(entry);
    force += nodal, moment += x.cross(nodal), size += nodal.norm();
  }
  EXPECT_GT(size, 1.0);  // N
  EXPECT_LE(force.norm(), 1e-13 * size);
  EXPECT_LE(moment.norm(), 1e-13 * size * 0.055);
}

/// What a rigid motion of garment and skin together leaves alone: no slip, no force.
TEST(Friction, ACommonDisplacementDoesNotRub) {
  Rubbed rubbed(Skin::deformable, sticking);
  State state = rubbed.state;
  auto& history = state.history.edit<solver::FrictionHistory>("friction");
  history.traction.setZero();
  state.values = history.anchor;
  for (int entry = 0; entry < rubbed.scene.layout().positions(); entry += 3)
    state.values.segment<3>(entry) += Eigen::Vector3d(1e-3, -2e-3, 3e-3);
  EXPECT_LE(assemble(rubbed.friction(), state, Tangent::none).residual.norm(), 1e-10);
}

/// The memory of friction stands on the garment's vertices, not on the points: cutting the quadrature anew leaves it alone.
TEST(Friction, RenewedQuadratureKeepsTheTractions) {
  Rubbed rubbed(Skin::deformable, sticking);
  rubbed.scene.commit(rubbed.state);
  const auto tractions = [&] { return rubbed.friction().vertex_tractions(rubbed.state); };
  const auto force = [&] { return assemble(rubbed.friction(), rubbed.state, Tangent::none).residual; };
  rubbed.update();
  const auto before = tractions();
  const Eigen::VectorXd force_before = force();
  const auto points_before = rubbed.scene.find<solver::Contact>()->point_forces(rubbed.state).size();
  for (int node = 0; node < rubbed.scene.layout()["garment"].count; ++node) {  // a cut elsewhere
    auto x = rubbed.state.values.segment<3>(rubbed.scene.layout()["garment"](node));
    x = Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()) * x;
  }
  rubbed.scene.renew(rubbed.state);
  rubbed.update();
  EXPECT_NE(rubbed.scene.find<solver::Contact>()->point_forces(rubbed.state).size(), points_before);
  rubbed.state.values = rubbed.state.history.get<solver::FrictionHistory>("friction").anchor;  // back; the quadrature is cut there again
  rubbed.scene.renew(rubbed.state);
  rubbed.update();
  const auto after = tractions();
  for (std::size_t i = 0; i < after.size(); ++i)
    EXPECT_LE((after[i].traction - before[i].traction).norm(), 1e-3 * before[i].traction.norm()) << i;
  EXPECT_LE((force() - force_before).norm(), 1e-3 * force_before.norm());
}

/// A scene without friction has neither the term nor a history.
/// All that forces depend on is in the state: written down and read back by another scene it gives them to the last bit.
TEST(Friction, AStateFromAFileGivesTheSameForcesToTheLastBit) {
  Rubbed first(Skin::deformable, 4e-4), second(Skin::deformable, 0.0);
  first.scene.commit(first.state);
  first.state.values.head(first.scene.layout().positions()) += random_vector(first.scene.layout().positions(), 1e-6, 7);
  first.scene.update(first.state);
  solver::ByteWriter writer;
  each(writer, first.state);
  State read;
  solver::ByteReader reader(writer.bytes);
  each(reader, read);
  EXPECT_TRUE(reader.at_end());
  second.scene.restore(read);
  EXPECT_EQ(second.scene.full_residual(read), first.scene.full_residual(first.state));
  solver::ByteWriter again;
  each(again, read);
  EXPECT_EQ(again.bytes, writer.bytes);
}

/// A trial step is a copy: what terms do to it leaves the state that it came from alone.
TEST(Friction, ACopyIsIndependent) {
  Rubbed rubbed(Skin::deformable, 4e-4);
  const Eigen::VectorXd before = rubbed.scene.full_residual(rubbed.state);
  State trial = rubbed.state;
  trial.values.head(rubbed.scene.layout().positions()) += random_vector(rubbed.scene.layout().positions(), 1e-4, 8);
  rubbed.scene.renew(trial), rubbed.scene.update(trial), rubbed.scene.commit(trial);
  EXPECT_NE(rubbed.scene.full_residual(trial), before);
  EXPECT_EQ(rubbed.scene.full_residual(rubbed.state), before);
}

/// A history that belongs to another scene is refused.
TEST(Friction, AStateOfAnotherSceneIsRefused) {
  Rubbed rubbed(Skin::deformable, 4e-4);
  solver::ByteWriter writer;
  each(writer, rubbed.state);
  TubeCase finer;
  finer.around = 8, finer.along = 2, finer.through = 1, finer.cell_size = 0.02;
  input::Case other = describe_tube(finer);
  other.contacts.front().friction = 0.3;
  const solver::Meshes meshes = make_meshes(other);
  State read;
  solver::ByteReader reader(writer.bytes);
  each(reader, read);
  EXPECT_THROW(tests::make_scene(other, meshes, Skin::deformable).restore(read), std::runtime_error);
}

/// Nothing is released at 0, everything at 1; between them the bound is mu p / release.
TEST(Friction, SticksWithoutABoundUntilItIsReleased) {
  Rubbed r(Skin::rigid, 5e-3);
  const auto largest = [&](double release) {
    r.state.release = release;
    r.friction().renew(r.state);
    r.update();
    double most = 0.0;
    for (const auto& vertex : r.friction().vertex_tractions(r.state)) most = std::max(most, vertex.traction.norm());
    return most;
  };
  const double whole = largest(1.0), half = largest(0.5), sticking = largest(0.0);
  EXPECT_GT(whole, 0.0);
  EXPECT_NEAR(half, 2.0 * whole, 1e-9 * whole);  // 5 mm are far beyond the elastic slip: all vertices are at their bound
  EXPECT_GT(sticking, 3.0 * whole);
  for (const auto& vertex : r.friction().vertex_tractions(r.state)) EXPECT_NE(vertex.slip, solver::Friction::Slip::slip);
}

/// What the case says comes first, then the fabric, then the literature.
TEST(Friction, IsThatOfTheCaseElseOfTheFabricElseTheUsualOne) {
  input::Case c = Rubbed::describe(0.17);
  const auto coefficient = [&] { return solver::make_model(c).contact_of(0)->friction.coefficient; };
  EXPECT_EQ(coefficient(), 0.17);
  c.contacts.front().friction.reset();
  EXPECT_EQ(coefficient(), 0.3);
  c.garments.front().fabric.table.set("MIU", input::value_without_place(0.22));
  EXPECT_EQ(coefficient(), 0.22);
  c.contacts.front().friction = 0.0;
  EXPECT_FALSE(solver::make_model(c).has_friction());
  c.contacts.clear();
  EXPECT_EQ(solver::make_model(c).contact_of(0), nullptr);
  EXPECT_FALSE(solver::make_model(c).has_friction());
}

/// A traction that has come along a tube is turned into the plane where it is and keeps its size: round the tube as along it.
TEST(Friction, ATractionKeepsItsSizeWhereTheSkinTurns) {
  Rubbed r(Skin::rigid, sticking);
  r.state.release = 0.0;
  r.friction().renew(r.state);
  r.update();
  auto& history = r.state.history.edit<solver::FrictionHistory>("friction");
  history.anchor = r.state.values;
  const auto energy = [&](const Eigen::Vector3d& direction) {  // the square of the tractions over the stiffness
    for (Eigen::Index i = 0; i < history.traction.size(); i += 3) history.traction.segment<3>(i) = 300.0 * direction;
    return r.friction().energy(r.state);
  };
  const double along = energy(Eigen::Vector3d::UnitZ());
  EXPECT_GT(along, 0.0);
  EXPECT_NEAR(energy(Eigen::Vector3d::UnitX()), along, 0.01 * along);
}

/// What slipped is remembered at its bound, not at what it would have been without one.
TEST(Friction, HistoryKeepsTheBound) {
  Rubbed r(Skin::rigid, slipping);
  r.scene.commit(r.state);
  r.state.release = 0.01;  // the bound is now a hundred times as large
  r.update();
  const auto vertices = r.friction().vertex_tractions(r.state);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    EXPECT_LE(vertices[i].traction.norm(), 1.01 * 0.3 * r.state.values[r.scene.layout()["contact"](static_cast<int>(i))]);
}

TEST(Friction, IsLeftOutWhereTheCaseHasNone) {
  const input::Case c = Rubbed::describe(0.0);
  const solver::Meshes meshes = make_meshes(c);
  const solver::Scene scene = tests::make_scene(c, meshes, Skin::rigid);
  State state = solver::placed_state(scene.layout(), meshes);
  scene.look(state), scene.commit(state);
  EXPECT_EQ(scene.find<solver::Friction>(), nullptr);
  EXPECT_FALSE(state.history.has("friction"));
}

TEST(Friction, ACornerThatTurnsHasTheStiffnessOfItsSecant) {
  // Where the slip has turned against the last iterate's, the tangent times the way since the accepted state is the force itself
  // (t = mu p u / |u|), so that no step goes on past the sticking; where it goes on the same way, that product is nothing.
  Rubbed rubbed(Skin::rigid, slipping);
  const Eigen::VectorXd anchor = rubbed.state.history.get<solver::FrictionHistory>("friction").anchor;
  rubbed.state.history.edit<solver::FrictionHistory>("friction").traction.setZero();
  rubbed.update();
  const Eigen::Index positions = rubbed.scene.layout().positions();
  rubbed.state.values.head(positions) = (2.0 * anchor - rubbed.state.values).head(positions).eval();
  rubbed.update();
  const auto product = [&](const Assembled& at) -> Eigen::VectorXd {
    Eigen::VectorXd way = rubbed.state.values - rubbed.state.history.get<solver::FrictionHistory>("friction").anchor;
    way.tail(way.size() - positions).setZero();
    return at.tangent * way;
  };
  const Assembled turned = assemble(rubbed.friction(), rubbed.state, Tangent::full);
  EXPECT_GT(turned.residual.norm(), 1.0);
  EXPECT_LE((product(turned) - turned.residual).norm(), 1e-12 * turned.residual.norm());
  rubbed.update();
  const Assembled on = assemble(rubbed.friction(), rubbed.state, Tangent::full);
  EXPECT_LE((on.residual - turned.residual).norm(), 1e-14 * on.residual.norm());
  EXPECT_LE(product(on).norm(), 1e-12 * on.residual.norm());
}

TEST(Friction, ClothThatTouchesNothingIsLetGoByAndBy) {
  // What stuck without a bound keeps (1 - release) of its traction as a bound where nothing presses it, and nothing of it at the end.
  Rubbed rubbed(Skin::rigid, 1e-4);
  const solver::Field& pressures = rubbed.scene.layout()["contact"];
  for (int i = 0; i < pressures.count; ++i) rubbed.state.values[pressures(i)] = 0.0;
  rubbed.scene.find<solver::Contact>()->set_stiffness(0.0);
  auto& history = rubbed.state.history.edit<solver::FrictionHistory>("friction");
  for (Eigen::Index corner = 0; corner < history.held.size(); ++corner) history.held[corner] = 100.0 + static_cast<double>(corner);
  for (const double release : {0.25, 1.0}) {
    rubbed.state.release = release;
    rubbed.update();
    const auto& frames = *rubbed.state.history.edit<solver::FrictionHistory>("friction").frames;
    for (std::size_t e = 0; e < frames.size(); ++e)
      for (int v = 0; v < 3; ++v) ASSERT_DOUBLE_EQ(frames[e][v].bound, (1.0 - release) * (100.0 + 3.0 * e + v));
  }
}

}  // namespace
}  // namespace snug::tests
