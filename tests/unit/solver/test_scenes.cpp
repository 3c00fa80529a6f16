// A scene has the parts that the case names and no others; one without equilibrium is recognised and named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <algorithm>

#include "solver/scene/laplace.hpp"
#include "tests/unit/solver/terms.hpp"

namespace snug::tests {
namespace {

using solver::Skin;
using testing::ElementsAre, testing::HasSubstr, testing::Key, testing::UnorderedElementsAre;

TubeCase coarse_tube() {
  TubeCase tube;
  tube.around = 8, tube.along = 2, tube.through = 1;
  return tube;
}

std::vector<std::string> term_names(const input::Case& c, Skin skin) {
  const solver::Meshes meshes = make_meshes(c);
  const solver::Scene scene = tests::make_scene(c, meshes, skin);
  std::vector<std::string> names;
  for (const auto& term : scene.terms()) names.push_back(term->name());
  return names;
}

std::vector<std::string> phase_names(const postproc::RunResult& result) {
  std::vector<std::string> names;
  for (const auto& phase : result.phases) names.push_back(phase.name);
  return names;
}

TEST(Parts, ACaseWithoutGarmentHasNoGarmentNoContactAndNoRigidPhase) {
  input::Case c = describe_tube(coarse_tube());
  c.garments.clear(), c.contacts.clear();
  c.load.emplace().skin_pressure = 1000.0;
  const solver::Meshes meshes = make_meshes(c);
  EXPECT_THAT(tests::plan(c, meshes).unknowns, ElementsAre(Key("body")));
  EXPECT_THAT(term_names(c, Skin::deformable), ElementsAre("tissue", "pressure on skin"));
  const postproc::RunResult result = tests::solve(c, meshes);
  EXPECT_EQ(result.status, postproc::Status::converged);
  EXPECT_THAT(result.unknowns, ElementsAre(Key("body")));
  EXPECT_THAT(phase_names(result), ElementsAre("set-up", "body", "results"));
  EXPECT_TRUE(result.samples.empty());
  EXPECT_TRUE(result.garment.triangles.empty());
  EXPECT_EQ(result.numbers.count("mean_contact_pressure_Pa"), 0u);
}

TEST(Parts, TheRigidTierHasNoBodyUnknownsAndNoTissue) {
  TubeCase tube = coarse_tube();
  tube.tier = input::Tier::L1;
  const input::Case c = describe_tube(tube);
  EXPECT_THAT(term_names(c, Skin::rigid), ElementsAre("fabric of garment", "contact"));
  const postproc::RunResult result = run(tube);
  EXPECT_EQ(result.status, postproc::Status::converged);
  EXPECT_THAT(result.unknowns, UnorderedElementsAre(Key("garment"), Key("contact")));
  EXPECT_THAT(phase_names(result), ElementsAre("law of Laplace", "set-up", "rigid skin", "results"));
  EXPECT_TRUE(result.body.cells.empty());
}

TEST(Parts, AGarmentWithoutContactHasNoContactTermAndNoMultipliers) {
  input::Case c = describe_tube(coarse_tube());
  c.contacts.clear();
  c.solver.tier = input::Tier::L1;
  const solver::Meshes meshes = make_meshes(c);
  EXPECT_THAT(tests::plan(c, meshes).unknowns, ElementsAre(Key("garment")));
  EXPECT_THAT(term_names(c, Skin::rigid), ElementsAre("fabric of garment"));
}

TEST(Parts, TierL0HasNoUnknownsAtAll) {
  TubeCase tube = coarse_tube();
  tube.tier = input::Tier::L0;
  const input::Case c = describe_tube(tube);
  EXPECT_TRUE(tests::plan(c, make_meshes(c)).unknowns.empty());
  const postproc::RunResult result = run(tube);
  EXPECT_EQ(result.status, postproc::Status::converged);
  EXPECT_TRUE(result.unknowns.empty());
  EXPECT_TRUE(result.history.empty());
}

TEST(Parts, EveryPartOfTheFullSceneIsThereOnce) {
  EXPECT_THAT(term_names(describe_tube(coarse_tube()), Skin::deformable),
              ElementsAre("tissue", "fabric of garment", "contact"));
}

bool says(const std::vector<std::string>& list, const std::string& text) {
  return std::any_of(list.begin(), list.end(), [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

TEST(Parts, LooseClothHasBendingAndWeightAndTightClothHasThemWhereTheCaseSaysSo) {
  TubeCase tube = coarse_tube();
  tube.sleeve = 0.058;  // on a limb of 55 mm
  input::Case c = describe_tube(tube);
  EXPECT_THAT(term_names(c, Skin::rigid), ElementsAre("fabric of garment", "bending of garment", "weight of garment", "contact"));
  const solver::Plan plan = tests::plan(c, make_meshes(c));
  EXPECT_TRUE(says(plan.parts_in, "bending: 4.24e-06 N m along the warp, 4.24e-06 along the weft (assumed: a bending length of 12 mm); "
                                  "the garment is up to 3 mm wider all round than the body"));
  EXPECT_TRUE(says(plan.parts_in, "weight of the garment: 250 g/m2 (assumed)"));
  c.garments.front().fabric.table.set("B", input::value_without_place(std::string("2e-6 N m")));
  c.garments.front().fabric.table.set("weight", input::value_without_place(std::string("100 g/m2")));
  EXPECT_TRUE(says(tests::plan(c, make_meshes(c)).parts_in, "weight of the garment: 100 g/m2; the garment is"));
  c.garments.front().bending = false, c.garments.front().weight = false;
  EXPECT_THAT(term_names(c, Skin::rigid), ElementsAre("fabric of garment", "contact"));
  EXPECT_TRUE(says(tests::plan(c, make_meshes(c)).parts_out, "bending: the case says so"));

  c = describe_tube(coarse_tube());
  EXPECT_THAT(term_names(c, Skin::rigid), ElementsAre("fabric of garment", "contact"));
  EXPECT_TRUE(says(tests::plan(c, make_meshes(c)).parts_out, "bending: the garment is nowhere wider than the body"));
  c.garments.front().bending = true;
  EXPECT_THAT(term_names(c, Skin::rigid), ElementsAre("fabric of garment", "bending of garment", "contact"));
  c.garments.front().order = 1;
  EXPECT_THROW(term_names(c, Skin::rigid), input::InputError);
}

/// A loose sleeve hangs from its upper edge: that edge bears its weight, no more and no less.
TEST(Equilibrium, ALooseSleeveHangsFromItsHeldEdgeByItsWeight) {
  TubeCase tube = coarse_tube();
  tube.sleeve = 0.058;
  tube.tier = input::Tier::L1;
  input::Case c = describe_tube(tube);
  c.garments.front().held = {{.edge = "upper", .held = input::HeldDirection::axis}};
  c.garments.front().fabric.table.set("B", input::value_without_place(std::string("2e-6 N m")));
  c.garments.front().fabric.table.set("weight", input::value_without_place(std::string("100 g/m2")));
  const postproc::RunResult result = tests::solve(c, make_meshes(c));
  EXPECT_EQ(result.status, postproc::Status::converged) << result.message;
  const double weight = 0.1 * 9.80665 * 2.0 * std::numbers::pi * 0.058 * 0.060;
  EXPECT_NEAR(result.balance.garment_weight.z(), -weight, 1e-9 * weight);
  EXPECT_NEAR(result.balance.reactions.at("upper edge").z(), weight, 1e-6 * weight);
  EXPECT_LE(result.balance.force_error.norm(), 1e-6 * weight);
  EXPECT_EQ(result.numbers.count("contact_area_m2") ? result.numbers.at("contact_area_m2") : 0.0, 0.0);
}

/// A sleeve of 40 mm that no edge holds, on a limb of 60 mm whose radius grows from `lower` to `upper`.
input::Case free_sleeve(double lower, double upper) {
  TubeCase tube = coarse_tube();
  tube.along = 4;
  input::Case c = describe_tube(tube);
  c.body->stations = std::filesystem::temp_directory_path() / ("snug-cone-" + std::to_string(::getpid()) + ".csv");
  std::ofstream out(c.body->stations);
  out.precision(17);
  out << "height [m], girth [m], bone_girth [m]\n";
  for (const double s : {0.0, 0.5, 1.0})
    out << s * tube.length << ", " << 2.0 * std::numbers::pi * (lower + s * (upper - lower)) << ", 0.12\n";
  c.garments.front().held.clear();
  c.garments.front().position = 0.010;
  c.garments.front().pattern.length = 0.040;
  return c;
}

/// Statics: on a frictionless cone of half angle a every hoop tension pushes the sleeve towards the narrow end
/// (reference book 3, "frictionless sleeve on a rigid cone"): it holds only when an edge is held.
TEST(Equilibrium, AFreeSleeveOnAConeIsRecognisedAndTheRemedyNamed) {
  const input::Case c = free_sleeve(0.049, 0.055);
  const postproc::RunResult result = tests::solve(c, make_meshes(c));
  EXPECT_EQ(result.status, postproc::Status::failed);
  EXPECT_THAT(result.message, HasSubstr("no equilibrium"));
  EXPECT_THAT(result.message, HasSubstr("pushes it down"));
  EXPECT_THAT(result.message, HasSubstr("hold an edge: garment.held ="));
}

TEST(Equilibrium, TheDirectionOfSlidingFollowsTheCone) {
  const input::Case c = free_sleeve(0.055, 0.049);
  const solver::Meshes meshes = make_meshes(c);
  EXPECT_EQ(solver::probe_edge(meshes.garments.front()), "lower");
  const postproc::RunResult result = tests::solve(c, meshes);
  EXPECT_EQ(result.status, postproc::Status::failed);
  EXPECT_THAT(result.message, HasSubstr("pushes it up"));
  EXPECT_THAT(result.message, HasSubstr("edge = \"lower\""));
}

TEST(Equilibrium, AFreeSleeveOnARigidCylinderIsInEquilibrium) {
  input::Case c = free_sleeve(0.055, 0.055);
  c.solver.tier = input::Tier::L1;
  const postproc::RunResult result = tests::solve(c, make_meshes(c));
  EXPECT_EQ(result.status, postproc::Status::converged) << result.message;
}

/// Hoop stretch l = R / Rf; T = c l (l^2 - 1) / 2 by the fabric law (S = c E); p = T / R by Laplace.
TEST(Laplace, PressureOnACylinderIsTensionOverRadius) {
  const TubeCase tube = coarse_tube();
  const input::Case c = describe_tube(tube);
  const solver::Meshes meshes = make_meshes(c);
  const auto l0 =
      solver::laplace_pressure(mesh::tube_fit(c.garments.front()), solver::GarmentModel{c.garments.front(), materials::find_fabric(c.garments.front().fabric)}, meshes.limb, meshes.body);
  const double stretch = tube.radius / tube.sleeve;
  const double exact = 1000.0 * stretch * (stretch * stretch - 1.0) / 2.0 / tube.radius;  // 6392.045 Pa
  EXPECT_NEAR(l0.mean, exact, 1e-8 * exact);
  for (const auto& facet : meshes.body.skin_facets)
    for (const int node : facet) {
      EXPECT_TRUE(l0.covered[node]);
      EXPECT_NEAR(l0.pressure[node], exact, 1e-8 * exact);
    }
}

// What a rigid body leaves out is said, and its facets by their right name.
TEST(Parts, ARigidBodySaysWhatItLeavesOut) {
  TubeCase tube;
  tube.tier = input::Tier::L1, tube.elements = input::Elements::P2P1;
  input::Case c = describe_tube(tube);
  input::SupportSpec& support = c.support.emplace_back();
  support.on = "upper", support.z = 0.0;
  const solver::Plan plan = tests::plan(c, make_meshes(c));
  EXPECT_TRUE(says(plan.parts_out, "support: upper, for tier L1 takes the body as rigid"));
  EXPECT_TRUE(says(plan.parts_in, "quadratic triangular facets"));
}

/// Sleeves "low", at the bottom, and "high" on one tube with a rigid skin; lengths and place in m.
input::Case two_sleeves(double low, double high, double high_at, double taper = 0.0) {
  TubeCase tube;
  tube.tier = input::Tier::L1, tube.length = 0.12, tube.taper = taper;
  input::Case c = describe_tube(tube);
  c.garments.push_back(c.garments.front());
  c.garments[0].name = "low", c.garments[0].pattern.length = low;
  c.garments[1].name = "high", c.garments[1].pattern.length = high, c.garments[1].position = high_at;
  return c;
}

// Two sleeves on one tube far enough apart press as each does alone, and each has its own unknowns, contact and edges.
TEST(Parts, TwoGarmentsAreTwoParts) {
  input::Case both = two_sleeves(0.04, 0.03, 0.08);
  both.garments[1].pattern.flat_circumference *= 1.1;
  const postproc::RunResult result = tests::solve(both, make_meshes(both));
  EXPECT_EQ(result.status, postproc::Status::converged);
  ASSERT_EQ(result.garment.parts.size(), 2u);
  EXPECT_EQ(result.unknowns.count("contact of high"), 1u);
  for (int g = 0; g < 2; ++g) {
    input::Case alone = both;
    alone.garments = {both.garments[g]};
    const postproc::RunResult one = tests::solve(alone, make_meshes(alone));
    const auto& part = result.garment.parts[g];
    ASSERT_EQ(one.garment.pattern.size(), static_cast<std::size_t>(part.end_node - part.first_node));
    for (int n = part.first_node; n < part.end_node; ++n)
      EXPECT_NEAR(result.garment.fields[postproc::field::contact_pressure][n], one.garment.fields[postproc::field::contact_pressure][n - part.first_node], 1e-5 * 9000.0) << part.name;
    const std::string edge = part.name + ", upper edge";
    EXPECT_LE((result.balance.reactions.at(edge) - one.balance.reactions.at("upper edge")).norm(), 1e-6 * one.balance.contact_force);
  }
}

// Of two sleeves on a taper the one that rubs stays; the other is held by nothing, and the run says which and does not converge.
TEST(Parts, AGarmentWithoutFrictionBesideOneThatRubsSlidesOff) {
  input::Case c = two_sleeves(0.03, 0.03, 0.08, 0.1);
  c.garments[0].name = "rough", c.garments[1].name = "smooth";
  for (auto& garment : c.garments) garment.held.clear();
  c.contacts.push_back(c.contacts.front());
  c.contacts[0].slave = "rough", c.contacts[0].friction = 0.4;
  c.contacts[1].slave = "smooth", c.contacts[1].friction = 0.0;
  const postproc::RunResult result = tests::solve(c, make_meshes(c));
  EXPECT_EQ(result.status, postproc::Status::failed);
  EXPECT_THAT(result.message, testing::HasSubstr("nothing holds the smooth along the axis"));
  c.contacts[1].friction = 0.4;
  EXPECT_EQ(tests::solve(c, make_meshes(c)).status, postproc::Status::converged);
}

// The plan says what lies on what; a contact that names the skin leaves the garment under it out, and that is said, too.
TEST(Parts, GarmentsOverOneAnotherAreSaid) {
  input::Case c = two_sleeves(0.06, 0.06, 0.05);
  EXPECT_TRUE(says(tests::plan(c, make_meshes(c)).parts_in, "contact of high: weighted gaps, hat multipliers, on low where it lies over it, else on the skin"));
  c.contacts.front().master = "skin";
  EXPECT_TRUE(says(tests::plan(c, make_meshes(c)).parts_out, "contact of high with low: the case lays it on the skin alone; over one another at heights 50 to 60 mm"));
  c.contacts.front().master = "", c.garments[1].position = 0.061, c.garments[1].pattern.length = 0.05;
  EXPECT_FALSE(says(tests::plan(c, make_meshes(c)).parts_in, "on low"));
}

// The echo of a model names no entry: everything stands in it in SI, and a case read from it is the same model.
TEST(Parts, TheEchoOfAModelReadsBackToTheSameModel) {
  TubeCase tube;
  input::Case c = describe_tube(tube);
  c.title = "echo";
  c.body->layers[1].material = {.name = "relaxed thigh"};
  c.garments.front().fabric = {.name = "N85L15"};
  const solver::Model model = solver::make_model(c);
  const std::string echo = solver::echo_text(model);
  EXPECT_THAT(echo, testing::HasSubstr("law = \"kes\""));
  EXPECT_THAT(echo, testing::HasSubstr("name = \"relaxed thigh\""));
  const auto folder = std::filesystem::temp_directory_path() / ("snug-echo-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "case.toml") << echo;
  input::Case read = input::read_case(folder, {.allow_outside = true});
  read.directory = c.directory;
  const solver::Model again = solver::make_model(read);
  EXPECT_EQ(solver::echo_text(again), echo);
  EXPECT_EQ(again.garments.front().fabric.name, "N85L15");
  EXPECT_EQ(again.garments.front().fabric.relaxed({0.1, 0.2, 0.0}, 1e-3).force, model.garments.front().fabric.relaxed({0.1, 0.2, 0.0}, 1e-3).force);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace snug::tests
