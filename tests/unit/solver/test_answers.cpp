// What is an answer: every condition of equilibrium is asked for, and a run that ends short of it says so and keeps the last state
// that was one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "solver/library/size_estimate.hpp"
#include "solver/stepping/load_path.hpp"
#include "solver/stepping/newton.hpp"
#include "solver/stepping/stages.hpp"
#include "tests/unit/solver/terms.hpp"

namespace snug::tests {
namespace {

using solver::NewtonSettings, solver::Skin;
using testing::HasSubstr, testing::Not;

TubeCase coarse() {
  TubeCase tube;
  tube.around = 8, tube.along = 2, tube.through = 1;
  return tube;
}

/// Asks for nothing.
NewtonSettings anything() {
  NewtonSettings settings;
  settings.residual = settings.complementarity = settings.penetration = settings.volume = std::numeric_limits<double>::max();
  return settings;
}

/// A state in which nothing is right: the garment in the skin with tensile multipliers here and there, the body shaken.
struct Wrong {
  solver::Meshes meshes;
  solver::Scene scene;
  solver::State state;

  Wrong() : Wrong(describe_tube(coarse())) {}
  explicit Wrong(const input::Case& c)
      : meshes(make_meshes(c)), scene(tests::make_scene(c, meshes, Skin::deformable)),
        state(solver::placed_state(scene.layout(), meshes)) {
    const solver::Layout& layout = scene.layout();
    const int pressures = layout["contact"].count;
    state.values.head(layout.positions()) += random_vector(layout.positions(), 2e-5, 1);
    state.values.segment(layout["contact"](0), pressures) = Eigen::VectorXd::Constant(pressures, 5000.0) + random_vector(pressures, 5100.0, 2);
    look();
  }
  void look() {
    scene.update(state);
    scene.assemble(state, solver::Tangent::full);
  }
  bool done(const NewtonSettings& settings) const { return solver::check(scene, state, settings).done; }
};

// Each condition alone keeps a state from being an answer: the balance, no tension in contact, the gap, the volume.
TEST(Answer, HasEveryConditionMet) {
  Wrong wrong;
  while (solver::check(wrong.scene, wrong.state, anything()).measure.changed > 0) wrong.look();
  ASSERT_TRUE(wrong.done(anything()));
  for (double NewtonSettings::* condition : {&NewtonSettings::residual, &NewtonSettings::complementarity, &NewtonSettings::penetration, &NewtonSettings::volume}) {
    NewtonSettings settings = anything();
    settings.*condition = NewtonSettings{}.*condition;
    EXPECT_FALSE(wrong.done(settings));
  }
}

// While vertices come and go the forces are those of another set of them: no answer, whatever is asked for.
TEST(Answer, HasAnActiveSetAtRest) {
  Wrong wrong;
  ASSERT_GT(solver::check(wrong.scene, wrong.state, anything()).measure.changed, 0);
  EXPECT_FALSE(wrong.done(anything()));
}

// A vertex that the skin pulls counts by its pull over the mean pressure, also where all the others are pressed.
TEST(Answer, HasNoTensionInContact) {
  Wrong wrong;
  const solver::Layout& layout = wrong.scene.layout();
  const solver::Field &garment = layout["garment"], &pressure = layout["contact"];
  for (int node = 0; node < garment.count; ++node) wrong.state.values.segment<2>(garment(node)) *= 0.98;  // all in the skin
  wrong.state.values.segment(pressure(0), pressure.count).setConstant(5000.0);
  wrong.state.values[pressure(3)] = -50.0;
  wrong.look(), wrong.look();
  const solver::Check found = solver::check(wrong.scene, wrong.state, anything());
  ASSERT_EQ(found.measure.active, pressure.count);
  EXPECT_NEAR(found.complementarity, 50.0 / (5000.0 - 5050.0 / pressure.count), 1e-12);
}

/// A tube without a garment whose upper cut is moved up by 1 mm.
input::Case pulled() {
  input::Case c = describe_tube(coarse());
  c.garments.clear(), c.contacts.clear();
  c.support.push_back({.on = "upper", .x = {}, .y = {}, .z = 1e-3, .turn = 0.0, .where = {}});
  return c;
}

// A body that balances is no answer while a support has not come to its place.
TEST(Answer, HasItsSupportsInPlace) {
  const input::Case c = pulled();
  const solver::Meshes meshes = make_meshes(c);
  solver::Scene scene = tests::make_scene(c, meshes, Skin::deformable);
  solver::State state = solver::placed_state(scene.layout(), meshes);
  state.load = 1.0;
  scene.update(state);
  scene.assemble(state, solver::Tangent::full);
  EXPECT_FALSE(solver::check(scene, state, anything()).done);
  for (const int node : meshes.body.surface("upper")->nodes) state.values[scene.layout()["body"](node, 2)] += 1e-3;
  EXPECT_TRUE(solver::check(scene, state, anything()).done);
}

// Supports go with the load: at half of it they are half way.
TEST(Supports, MoveWithTheLoad) {
  const input::Case c = pulled();
  const solver::Meshes meshes = make_meshes(c);
  int states = 0;
  const auto keep = [&](double way, const postproc::RunResult& result) {
    ++states;
    for (const int node : meshes.body.surface("upper")->nodes) {
      const bool on_bone = std::count(meshes.body.bone_nodes.begin(), meshes.body.bone_nodes.end(), node) > 0;  // which stands still
      EXPECT_NEAR(result.body.fields[postproc::field::displacement][node].z(), on_bone ? 0.0 : way * 1e-3, 1e-15);
    }
  };
  EXPECT_EQ(solver::solve(solver::make_model(c, meshes.body), meshes, {}, {2, keep}).status, postproc::Status::converged);
  EXPECT_EQ(states, 3);
}

/// The stages of every way of a case, "a, b | c": by name.
std::string stages(const input::Case& c) {
  const solver::Meshes meshes = make_meshes(c);
  const solver::Model model = solver::make_model(c, meshes.body), worn = model.with_friction(solver::usual_friction);
  std::string text;
  for (const solver::Way& way : solver::ways_of(model, worn, meshes, false)) {
    if (!text.empty()) text += " | ";
    for (const solver::Stage& stage : way.stages) text += (&stage == &way.stages.front() ? "" : ", ") + stage.name;
    EXPECT_FALSE(way.stages.back().leads_on) << "the last stage of " << text << " ends in the answer";
  }
  return text;
}

// An increment that does not converge is no state: with one iteration allowed the path ends where it began, and says so.
TEST(Path, WhatDoesNotConvergeIsNotGoneOnFrom) {
  const input::Case c = describe_tube(coarse());
  const solver::Meshes meshes = make_meshes(c);
  solver::Scene scene = tests::make_scene(c, meshes, Skin::rigid);
  const solver::State start = solver::placed_state(scene.layout(), meshes);
  solver::PathSettings settings;
  settings.newton.iterations = 1, settings.failures = 2;
  const solver::PathResult path = solver::follow_path(scene, start, solver::tightening(), settings, [](const postproc::Iteration&) {});
  EXPECT_FALSE(path.complete);
  EXPECT_EQ(path.increments, 0);
  EXPECT_EQ(path.reached, 0.0);
  EXPECT_GT(path.lost, 0);
  EXPECT_EQ((path.state.values - start.values).norm(), 0.0);
}

// Where the skin yields under the garment and hardens, the garment comes to lie where it lies at once on a hard one.
TEST(Path, ASkinThatYieldsAndHardensLeadsToTheSameAnswer) {
  input::Case c = describe_tube(coarse());
  c.contacts.front().friction = 0.0;
  const solver::Meshes meshes = make_meshes(c);
  solver::PathSettings settings;
  settings.newton.penetration = 1e-6 * meshes.garments.front().mean_edge;
  const auto walk = [&](const solver::Homotopy& way, double first_step) {
    solver::Scene scene = tests::make_scene(c, meshes, Skin::rigid);
    settings.first_step = first_step;
    return solver::follow_path(scene, solver::placed_state(scene.layout(), meshes), way, settings, [](const postproc::Iteration&) {});
  };
  const solver::PathResult hard = walk(solver::tightening(), 1.0), soft = walk(solver::hardening(), 0.5);
  ASSERT_TRUE(hard.complete) << hard.message;
  ASSERT_TRUE(soft.complete) << soft.message;
  EXPECT_GE(soft.increments, 2);
  EXPECT_EQ(soft.state.yielding, 0.0);
  // Pressures most of all, which depend a little on the state near the answer by which the quadrature was cut.
  EXPECT_LE((soft.state.values - hard.state.values).norm(), 1e-5 * hard.state.values.norm());
}

// A case walks the stages that it needs and no others; where a held garment does not rub, another way stands in.
TEST(Stage, AreThoseOfTheCase) {
  input::Case c = describe_tube(coarse());
  c.contacts.front().friction = 0.0;
  const std::string rubbing = "tightening where it was placed, releasing the body, letting go";
  EXPECT_EQ(stages(c), "rigid skin, body | " + rubbing + ", fading friction, without friction");
  c.solver.tier = input::Tier::L1;
  EXPECT_EQ(stages(c), "rigid skin | tightening where it was placed, letting go, fading friction, without friction");
  c.garments.front().held.clear();
  EXPECT_EQ(stages(c), "rigid skin");  // it would slide off on the other way, too
  c.contacts.front().friction = 0.4;
  EXPECT_EQ(stages(c), "tightening where it was placed, letting go");
  c.solver.tier = input::Tier::L4;
  EXPECT_EQ(stages(c), rubbing);
  c.contacts.clear();
  EXPECT_EQ(stages(c), "body");
  c.solver.tier = input::Tier::L0;
  EXPECT_EQ(stages(c), "");
}

// Every stage ends in the scene that the case describes: the whole load, the body's own stiffness, friction's own bound.
TEST(Stage, EndsInTheSceneOfTheCase) {
  solver::State state;
  state.load = 0.0, state.release = 0.0;
  solver::tightening()(state, 1.0), solver::letting_go()(state, 1.0), solver::releasing(1000.0)(state, 1.0);
  EXPECT_EQ(state.load, 1.0);
  EXPECT_EQ(state.release, 1.0);
  EXPECT_EQ(state.stiffening, 1.0);
  solver::hardening()(state, 0.5);
  EXPECT_NEAR(state.yielding, 0.3, 1e-12);
  solver::hardening()(state, 1.0);
  EXPECT_EQ(state.yielding, 0.0);
  solver::releasing(1000.0)(state, 0.0);
  EXPECT_NEAR(state.stiffening, 1000.0, 1e-9);
}

// The body is put under the garment as it is: tight, sticking, with the tractions that hold it.
TEST(Stage, TheBodyComesUnderTheGarmentAsItIs) {
  input::Case c = describe_tube(coarse());
  c.contacts.front().friction = 0.3;
  const solver::Meshes meshes = make_meshes(c);
  const solver::Scene rigid = tests::make_scene(c, meshes, Skin::rigid);
  const solver::Scene soft = tests::make_scene(c, meshes, Skin::deformable);
  solver::State state = solver::placed_state(rigid.layout(), meshes);
  rigid.look(state);
  rigid.commit(state);
  state.load = 0.9, state.release = 0.0;
  auto& tractions = state.history.edit<solver::FrictionHistory>("friction").traction;
  tractions = random_vector(tractions.size(), 300.0, 1);
  const solver::State moved = soft.transfer(state, rigid.layout(), solver::placed_state(soft.layout(), meshes));
  EXPECT_EQ(moved.load, 0.9);
  EXPECT_EQ(moved.release, 0.0);
  EXPECT_EQ(moved.history.get<solver::FrictionHistory>("friction").traction, tractions);
}

/// A sleeve on a limb, given up as soon as its run is in the phase.
postproc::RunResult stopped_in(const std::string& phase, double friction) {
  input::Case c = describe_tube(coarse());
  c.contacts.front().friction = friction;
  const solver::Meshes meshes = make_meshes(c);
  bool there = false;
  return solver::solve(solver::make_model(c, meshes.body), meshes, [&](const solver::Progress& now) { there = there || now.phase.starts_with(phase); }, {},
                       [&] { return there; });
}

/// A garment on the rigid skin of the tube presses with tension over radius (test_scenes.cpp, Laplace).
constexpr double on_rigid_skin = 6392.045;  // Pa

void expect_rigid_skin(const postproc::RunResult& result) {
  EXPECT_EQ(result.status, postproc::Status::partial);
  EXPECT_EQ(result.truth.stage, "rigid skin");
  EXPECT_THAT(result.message, HasSubstr("what is reported is the garment on the rigid skin (tier L1)"));
  EXPECT_NEAR(result.numbers.at("mean_contact_pressure_Pa"), on_rigid_skin, 0.03 * on_rigid_skin);
  for (const Eigen::Vector3d& u : result.body.fields[postproc::field::displacement]) EXPECT_EQ(u.norm(), 0.0);
}

// Where nothing of the body converged, the garment on the rigid skin is the result, and the run is partial. With friction it
// still sticks there where it was placed.
TEST(Partial, ABodyThatDoesNotConvergeLeavesTheAnswerOnTheRigidSkin) {
  const postproc::RunResult result = stopped_in("body", 0.3);
  expect_rigid_skin(result);
  EXPECT_TRUE(std::isinf(result.truth.friction_bound));
}

// The same without friction, although another way stands in there where the body fails.
TEST(Partial, ARunThatIsStoppedLooksForNoOtherWay) { expect_rigid_skin(stopped_in("body", 0.0)); }

// Later the last state that converged is the result: on the body, at the stage and the friction where it stood.
TEST(Partial, AStageThatIsGivenUpKeepsTheStateBeforeIt) {
  const postproc::RunResult result = stopped_in("let go", 0.3);
  EXPECT_EQ(result.status, postproc::Status::partial);
  EXPECT_EQ(result.truth.stage, "letting go");
  EXPECT_EQ(result.truth.fraction, 0.0);
  EXPECT_THAT(result.message, HasSubstr("letting go stopped at 0.0 % of its path"));
  EXPECT_THAT(result.message, Not(HasSubstr("no equilibrium")));
  const double pressure = result.numbers.at("mean_contact_pressure_Pa");
  EXPECT_LT(pressure, 0.97 * on_rigid_skin);  // tissue gives way
  EXPECT_GT(pressure, 0.5 * on_rigid_skin);
}

// Where nothing converged at all there is no part of an answer.
TEST(Partial, ARunWithoutAnyStepHasFailed) {
  EXPECT_EQ(stopped_in("tightening", 0.3).status, postproc::Status::failed);
  EXPECT_EQ(stopped_in("rigid skin", 0.0).status, postproc::Status::failed);
}

/// Shares of the garment's triangles: by corners that slip, and of those whose corners do not all do the same.
struct Slipping { double corners = 0.0, mixed = 0.0; };

Slipping slipping(const postproc::GarmentResult& garment) {
  double area = 0.0;
  Slipping share;
  for (const auto& t : garment.triangles) {
    const Eigen::Vector3d &a = garment.current[t[0]], &b = garment.current[t[1]], &c = garment.current[t[2]];
    const double one = (b - a).cross(c - a).norm();
    int corners = 0;
    for (int k = 0; k < 3; ++k) corners += garment.fields[postproc::field::slip][t[k]] == 2.0;
    area += one, share.corners += one * corners / 3.0, share.mixed += corners % 3 != 0 ? one : 0.0;
  }
  return {share.corners / area, share.mixed / area};
}

/// A sleeve whose ends draw in until friction bears what the stretch of the hoop pulls along: some 15 N/m.
postproc::RunResult drawn_in(double friction) {
  TubeCase tube = coarse();
  tube.tier = input::Tier::L1, tube.cell_size = 0.012;
  tube.fabric = "law = 'linear'\nwarp = '1000 N/m'\nweft = '1000 N/m'\nshear = '300 N/m'\npoisson = 0.05";
  input::Case c = describe_tube(tube);
  c.garments.front().held.clear();
  c.contacts.front().friction = friction;
  return tests::solve(c, make_meshes(c));
}

// A point slips with the majority of what it stands between. A triangle with one slipping corner slips on a quarter of itself, with
// two on three quarters; corners by thirds differ from this by a twelfth of the triangles between slip and stick.
TEST(Slip, IsThatOfTheMajority) {
  const postproc::RunResult result = drawn_in(0.08);
  ASSERT_EQ(result.status, postproc::Status::converged) << result.message;
  const Slipping share = slipping(result.garment);
  ASSERT_GT(share.mixed, 0.1);
  EXPECT_NEAR(result.numbers.at("slipping_share_of_contact"), share.corners, share.mixed / 12.0);
}

// Where the garment slips its traction is the case's coefficient times the pressure, less what the directions of a vertex's triangles
// differ by, and nowhere is it more.
TEST(Slip, StandsAtTheBoundOfTheCase) {
  const auto garment = drawn_in(0.08).garment;
  int slips = 0;
  for (const auto& t : garment.triangles)
    for (int k = 0; k < 3; ++k) {
      const double bound = 0.08 * garment.fields[postproc::field::contact_pressure][t[k]], traction = garment.fields[postproc::field::shear_traction][t[k]].norm();
      ASSERT_LE(traction, bound * (1.0 + 1e-6));
      if (garment.fields[postproc::field::slip][t[k]] != 2.0) continue;
      ASSERT_GE(traction, 0.85 * bound);
      ++slips;
    }
  EXPECT_GT(slips, 10);
}

// Force over length and pressure of a sleeve on a rigid tube, by hand: hoop stretch l = 1.25, tension c l (l^2 - 1) / 2, over the radius.
TEST(Numbers, TensionAndPressureOnARigidTube) {
  TubeCase tube = coarse();
  tube.tier = input::Tier::L1, tube.around = 16;
  const postproc::RunResult result = run(tube);
  const double tension = 1000.0 * 1.25 * (1.25 * 1.25 - 1.0) / 2.0;  // 351.6 N/m
  for (const double found : result.garment.fields[postproc::field::tension_weft]) EXPECT_NEAR(found, tension, 0.01 * tension);
  EXPECT_NEAR(result.numbers.at("mean_contact_pressure_Pa"), tension / tube.radius, 0.01 * tension / tube.radius);
}

// The mean pressure is the force over the area that touches: cloth that stands off is not counted.
TEST(Numbers, TheMeanPressureIsOverWhatTouches) {
  TubeCase tube = coarse();
  tube.tier = input::Tier::L1, tube.along = 4, tube.taper = 0.1, tube.sleeve = 0.0575;  // on a limb of 55 to 61 mm
  const postproc::RunResult result = run(tube);
  ASSERT_EQ(result.status, postproc::Status::converged) << result.message;
  double force = 0.0, touching = 0.0, all = 0.0;
  for (const auto& sample : result.samples) {
    all += sample.area;
    if (sample.touching) force += sample.force, touching += sample.area;
  }
  EXPECT_LT(touching, 0.8 * all);
  EXPECT_NEAR(result.numbers.at("mean_contact_pressure_Pa"), force / touching, 1e-9 * force / touching);
  EXPECT_NEAR(result.numbers.at("contact_area_m2"), touching, 1e-9 * touching);
}

// What the solver leaves of round-off at vertices that do not touch is no contact: the area is the same when they hold +1e-14 Pa, and
// when they hold -1e-14 Pa.
TEST(Numbers, RoundOffIsNoContact) {
  TubeCase tube = coarse();
  tube.tier = input::Tier::L1, tube.along = 4, tube.taper = 0.1, tube.sleeve = 0.0575;
  const input::Case c = describe_tube(tube);
  const solver::Meshes meshes = make_meshes(c);
  solver::Scene scene = tests::make_scene(c, meshes, solver::Skin::rigid);
  solver::State state = solver::placed_state(scene.layout(), meshes);
  state.load = 1.0;
  ASSERT_EQ(solver::newton(scene, state, {}, [](const postproc::Iteration&) {}), solver::Outcome::converged);
  const auto& contact = *scene.find<solver::Contact>();
  const auto touching = [&](double off) {
    solver::State noisy = state;
    for (int i = 0; i < contact.vertices(); ++i)
      if (!contact.active(state)[i]) noisy.values[scene.layout()[contact.name()](i)] = off;
    int points = 0;
    for (const auto& point : contact.point_forces(noisy)) points += point.pressing > 0.0;
    return points;
  };
  EXPECT_GT(touching(0.0), 0);
  EXPECT_EQ(touching(1e-14), touching(0.0));
  EXPECT_EQ(touching(-1e-14), touching(0.0));
}

// What does not fit into memory is planned with its factor on disk, which takes less memory and is said; smaller factors stay, and so
// does everything where there is no bound.
TEST(NeedOfRun, PutsTheFactorOnDiskWhereMemoryIsShort) {
  const solver::Need large = solver::need_of_run(5e3, 3e5), small = solver::need_of_run(0.0, 2e4);
  EXPECT_LT(large.memory_beside_disk, 0.7 * large.memory);
  EXPECT_GT(large.disk, 1e9);
  EXPECT_DOUBLE_EQ(small.memory_beside_disk, small.memory);
  EXPECT_DOUBLE_EQ(small.disk, 0.0);
  const double growth = solver::need_of_run(0.0, 1e6).disk / solver::need_of_run(0.0, 1e5).disk;
  EXPECT_NEAR(std::log10(growth), 4.0 / 3.0, 1e-9);  // George 1973
}

// Two ranks are taken of a body of over 100,000 unknowns that deforms, where there are two cores and memory for both.
TEST(UsualRanks, FollowSizeCoresAndMemory) {
  input::Case c = describe_tube(coarse());
  const auto sized = [&](int around, int along, int through) -> input::Case& {
    c.body->cells_around = around, c.body->cells_along = along;
    for (input::LayerSpec& layer : c.body->layers)
      if (layer.form == input::LayerForm::solid) layer.cells = through;
    return c;
  };
  constexpr double much = 64e9;
  EXPECT_EQ(solver::usual_ranks(sized(32, 14, 3), 2, much), 1);
  EXPECT_EQ(solver::usual_ranks(sized(64, 28, 6), 2, much), 2);
  EXPECT_EQ(solver::usual_ranks(c, 1, much), 1);
  EXPECT_EQ(solver::usual_ranks(c, 2, 8e9), 1);
  c.solver.tier = input::Tier::L1;
  EXPECT_EQ(solver::usual_ranks(c, 2, much), 1);
}

}  // namespace
}  // namespace snug::tests
