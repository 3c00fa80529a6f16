// The table of what is not free: contradictions are refused, agreement is shared, what follows others is resolved.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <tuple>

#include "mesh/body/branching_body.hpp"
#include "solver/scene/constraint_table.hpp"
#include "solver/scene/constraints.hpp"
#include "solver/scene/partition.hpp"
#include "tests/verification/blocks.hpp"
#include "tests/verification/tube.hpp"

namespace snug::tests {
namespace {

using solver::ConstraintTable, solver::Motion;
using testing::ElementsAre, testing::HasSubstr;

BlockCase cube() {
  Block block;
  block.cells = {2, 2, 2};
  BlockCase c(make_block(block), {neo_hooke(10.0, 0.3)});
  return c;
}

std::string refusal(const BlockCase& c) {
  try {
    tests::make_scene(c.c, c.mesh, {}, solver::Skin::deformable);
  } catch (const input::InputError& error) {
    return error.what();
  }
  return "";
}

// The edge where two faces meet cannot stay and go: the message names both, the component and a node.
TEST(ConstraintTable, TwoSupportsThatContradictEachOtherAreRefused) {
  BlockCase c = cube();
  c.hold("left", {}, 0.0, {}), c.hold("back", {}, 0.05, {});
  const std::string error = refusal(c);
  EXPECT_THAT(error, HasSubstr("contradict each other at node"));
  EXPECT_THAT(error, HasSubstr("along y"));
  EXPECT_THAT(error, HasSubstr("\"left\" holds it"));
  EXPECT_THAT(error, HasSubstr("\"back\" moves it by 50 mm"));
}

// The order of the file decides nothing: the other way round it is refused, too, and with other components it is none.
TEST(ConstraintTable, TheirOrderDoesNotMatterAndOtherComponentsDoNotMeet) {
  BlockCase turned = cube(), apart = cube(), opposite = cube();
  turned.hold("back", {}, 0.05, {}), turned.hold("left", {}, 0.0, {});
  EXPECT_THAT(refusal(turned), HasSubstr("contradict"));
  apart.hold("left", 0.0, {}, {}), apart.hold("back", {}, 0.05, {});
  EXPECT_EQ(refusal(apart), "");
  opposite.hold("left", {}, 0.0, {}), opposite.hold("right", {}, 0.05, {});
  EXPECT_EQ(refusal(opposite), "");
}

// A whole turn ends where it began and is another way all the same.
TEST(ConstraintTable, AWholeTurnIsNotStandingStill) {
  BlockCase c = cube();
  c.hold("left", 0.0, 0.0, 0.0), c.hold("back", 0.0, 0.0, {}, 2.0 * std::numbers::pi);
  EXPECT_THAT(refusal(c), HasSubstr("contradict"));
}

// Where a cut meets the rigid bone the node is the bone's; a support on "bone" moves it.
TEST(ConstraintTable, NodesOfTheBoneGoWithTheBone) {
  TubeCase tube;
  tube.around = 8, tube.along = 2, tube.through = 1;
  input::Case c = describe_tube(tube);
  c.garments.clear(), c.contacts.clear();
  c.support = {{.on = "upper", .x = {}, .y = {}, .z = 1e-3, .where = {}}};
  const solver::Meshes meshes = make_meshes(c);  // its cuts slide, but where the case says otherwise
  const auto gap_at = [&](const input::Case& description, int node) {
    const solver::Model model = solver::make_model(description, meshes.body);
    const solver::Layout layout = solver::make_layout(model, meshes, solver::Skin::deformable);
    solver::State state = solver::placed_state(layout, meshes);
    state.load = 1.0;
    return solver::Supports(model, meshes.body, layout).gap(state)[layout["body"](node, 2)];
  };
  const std::set<int> bone(meshes.body.bone_nodes.begin(), meshes.body.bone_nodes.end());
  for (const int node : meshes.body.surface("upper")->nodes) EXPECT_NEAR(gap_at(c, node), bone.contains(node) ? 0.0 : 1e-3, 1e-15);
  input::Case led = c;
  led.support = {{.on = "bone", .x = {}, .y = {}, .z = 2e-3, .where = {}}};
  for (const int node : bone) EXPECT_NEAR(gap_at(led, node), 2e-3, 1e-15);
}

// The cuts of a limb of hexahedra have the names that the case gives them, each held once; a support of the case on one of them counts instead, by either name.
TEST(ConstraintTable, ACutHasOneName) {
  TubeCase tube;
  tube.around = 8, tube.along = 2, tube.through = 1;
  input::Case c = describe_tube(tube);
  c.garments.clear(), c.contacts.clear();
  solver::Meshes meshes = make_meshes(c);
  c.body->kind = input::BodyKind::scan;
  c.body->scan.emplace();
  c.body->scan->cuts = {{"below the hip", {0, 0, 1}, {0, 0, 1}, {}}, {"knee", {0, 0, 0}, {0, 0, -1}, {}}};
  mesh::name_cuts(*c.body, meshes.body);
  const auto held = [&](const input::Case& description) {
    const solver::Model model = solver::make_model(description, meshes.body);
    const solver::Layout layout = solver::make_layout(model, meshes, solver::Skin::deformable);
    const solver::Supports supports(model, meshes.body, layout);
    std::map<std::string, std::size_t> entries;
    for (std::size_t h = 0; h < supports.table().holders().size(); ++h) entries[supports.table().holders()[h].name] += supports.table().held_by(static_cast<int>(h)).size();
    return entries;
  };
  const std::set<int> bone(meshes.body.bone_nodes.begin(), meshes.body.bone_nodes.end());
  const auto beside_bone = [&](const char* surface) {
    const auto& nodes = meshes.body.surface(surface)->nodes;
    return static_cast<std::size_t>(std::count_if(nodes.begin(), nodes.end(), [&](int node) { return !bone.contains(node); }));
  };
  const std::map<std::string, std::size_t> alone = {{"bone", 3 * bone.size()}, {"cut \"knee\"", beside_bone("lower")}, {"cut \"below the hip\"", beside_bone("upper")}};
  EXPECT_EQ(held(c), alone);
  for (const char* name : {"knee", "lower"}) {
    input::Case led = c;
    led.support = {{.on = name, .x = {}, .y = {}, .z = 1e-3, .where = {}}};
    auto expected = alone;
    expected.erase("cut \"knee\""), expected[name] = beside_bone("lower");
    EXPECT_EQ(held(led), expected) << name;
  }
  input::Case aside = c;
  aside.support = {{.on = "knee", .x = 0.0, .y = {}, .z = {}, .where = {}}};  // across the axis: the cut keeps its height
  EXPECT_EQ(held(aside).at("cut \"knee\""), beside_bone("lower"));
}

// Two supports that say the same of a face bear the same share of its force, and the node is held once.
TEST(ConstraintTable, SupportsThatAgreeShareTheForceEvenly) {
  BlockCase c = cube();
  name_nodes(c.mesh, "also left", [](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
  c.hold("left", 0.0, {}, {}), c.hold("also left", 0.0, {}, {}), c.hold("bottom", {}, 0.0, {}), c.hold("back", {}, {}, 0.0);
  c.traction("right", 100.0, 0.0, 0.0);
  const BlockAnswer a = solve(c);
  EXPECT_NEAR(a.result.balance.reactions.at("left").x(), -50.0, 1e-6);
  EXPECT_NEAR(a.result.balance.reactions.at("also left").x(), -50.0, 1e-6);
  EXPECT_LE(a.result.balance.force_error.norm(), 1e-9);
}

// A block between planes that lie askew, one of which moves, answers as the same block along the axes does: displacements and reactions are turned, nothing
// else. Strains of a tenth, of two kinds of cell.
TEST(ConstraintTable, ALineInSpaceHoldsAsAnAxisDoes) {
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(-0.4, Eigen::Vector3d::UnitX())).toRotationMatrix();
  for (const CellKind kind : {CellKind::hex27, CellKind::tet10}) {
    Block straight, askew;
    straight.cells = askew.cells = {2, 1, 1}, straight.kind = askew.kind = kind;
    straight.map = [](const Eigen::Vector3d& u) { return Eigen::Vector3d(0.02 * u.x(), 0.01 * u.y(), 0.015 * u.z() * (1.0 + 0.3 * u.x())); };
    askew.map = [&](const Eigen::Vector3d& u) -> Eigen::Vector3d { return turn * straight.map(u); };
    BlockCase one(make_block(straight), {neo_hooke(10.0, 0.4)}), other(make_block(askew), {neo_hooke(10.0, 0.4)});
    const std::vector<std::tuple<const char*, int, double>> planes = {{"left", 0, 0.0}, {"bottom", 1, 0.0}, {"back", 2, 0.0}, {"top", 1, -1e-3}};
    for (const auto& [face, axis, way] : planes) {
      std::array<std::optional<double>, 3> held;
      held[axis] = way;
      one.hold(face, held[0], held[1], held[2]);
      for (const int node : other.mesh.surface(face)->nodes) other.mesh.held_along.push_back({node, turn.col(axis), way});
    }
    const Eigen::Vector3d pull(4000.0, 500.0, 0.0), turned = turn * pull;  // Pa
    one.traction("right", pull.x(), pull.y(), pull.z()), other.traction("right", turned.x(), turned.y(), turned.z());
    const BlockAnswer a = solve(one), b = solve(other);
    ASSERT_TRUE(a.path.complete && b.path.complete) << b.path.message;
    const auto &u = a.result.body.fields[postproc::field::displacement], &v = b.result.body.fields[postproc::field::displacement];
    for (std::size_t n = 0; n < u.size(); ++n) EXPECT_LE((v[n] - turn * u[n]).norm(), 1e-9 * 4e-3) << n;
    EXPECT_LE(b.result.balance.force_error.norm(), 1e-9);
    EXPECT_LE(b.result.balance.moment_error.norm(), 1e-9);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& [name, force] : a.result.balance.reactions) sum += force;
    EXPECT_LE((b.result.balance.reactions.at("supports of the file") - turn * sum).norm(), 1e-7 * sum.norm());
  }
}

// Lines at a node and components that are prescribed there already take the node together; what says otherwise is refused, what says the same is not.
TEST(ConstraintTable, ALineGivesWayToWhatIsPrescribedAlready) {
  const Eigen::Vector3d rest(1.0, 2.0, 3.0), askew(0.6, 0.8, 0.0);
  ConstraintTable table(3);
  const int wall = table.add({"wall"}), roller = table.add({"roller"});
  table.prescribe(1, wall, 1, {.displacement = {0.0, 0.3, 0.0}}, rest, 5);
  table.hold_along(0, {{roller, askew, 0.5}}, rest, 5);
  EXPECT_EQ(table.numbering({}, 1).unknowns(), 1);  // z alone
  const Eigen::VectorXd gap = table.gap(rest, 0.5);  // 0.6 x + 0.8 y = 0.5 at full load, y = 0.3: x = 13/30
  EXPECT_LE((gap - Eigen::Vector3d(0.5 * 13.0 / 30.0, 0.15, 0.0)).norm(), 1e-14);
  ConstraintTable twice(3);
  const int one = twice.add({"one"}), two = twice.add({"two"});
  for (int c = 0; c < 2; ++c) twice.prescribe(c, one, c, {.displacement = {0.3, 0.4, 0.0}}, rest, 5);
  twice.hold_along(0, {{two, askew, 0.5}, {two, -askew, -0.5}}, rest, 5);  // 0.6 0.3 + 0.8 0.4 = 0.5
  EXPECT_EQ(twice.numbering({}, 1).unknowns(), 1);
  try {
    twice.hold_along(0, {{two, askew, 0.4}}, rest, 5);
    ADD_FAILURE();
  } catch (const input::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("contradict each other at node 5: \"two\" moves it by 400 mm along (0.6, 0.8, 0)"));
  }
}

// An entry that follows one that follows others ends with those; one that follows what is prescribed has no unknown.
TEST(ConstraintTable, WhatFollowsIsResolvedToTheEnd) {
  ConstraintTable table(6);
  table.fix(0);
  table.bind(1, {{2, 0.4}, {3, -1.5}});
  table.tie(4, 1);
  table.tie(5, 0);
  const solver::Numbering numbering = table.numbering({}, 1);
  EXPECT_EQ(numbering.unknowns(), 2);
  for (const int entry : {0, 1, 4, 5}) EXPECT_EQ(numbering.unknown(entry), -1) << entry;
  const auto& line = numbering.bound().at(4);
  ASSERT_EQ(line.size(), 2u);
  EXPECT_EQ(line[0].entry, 2);
  EXPECT_EQ(line[0].weight, 0.4);
  EXPECT_EQ(line[1].entry, 3);
  EXPECT_EQ(line[1].weight, -1.5);
}

// A motion at a quarter of the load has gone a quarter of its way and turned by a quarter of its angle.
TEST(ConstraintTable, MotionsGrowWithTheLoad) {
  const Motion motion{.displacement = {0.0, 0.0, 0.4}, .turn = 2.0 * std::numbers::pi, .middle = {1.0, 0.0}};
  EXPECT_LE((motion.at({2.0, 0.0, 0.0}, 0.25) - Eigen::Vector3d(1.0, 1.0, 0.1)).norm(), 1e-15);
  ConstraintTable table(3);
  const int lid = table.add({"lid"});
  for (int c = 0; c < 3; ++c) table.prescribe(c, lid, c, motion, {2.0, 0.0, 0.0}, 1);
  EXPECT_LE((table.gap(Eigen::Vector3d(2.0, 0.0, 0.0), 0.25) - Eigen::Vector3d(-1.0, 1.0, 0.1)).norm(), 1e-15);
  EXPECT_THAT(table.prescribed_entries(), ElementsAre(0, 1, 2));
}

// Ranks share out the entries of a body of any kind of cell about evenly, and a node's components stay together.
TEST(Partition, SharesOutBodiesOfEveryKindOfCell) {
  for (const CellKind kind : {CellKind::hex27, CellKind::hex8, CellKind::tet10}) {
    Block block;
    block.cells = {8, 2, 2}, block.kind = kind;
    const BlockCase c(make_block(block), {neo_hooke(10.0, 0.3)});
    const solver::Model model = solver::make_model(c.c, c.mesh);
    const solver::Meshes meshes = meshes_of(c.mesh, {});
    const solver::Layout layout = solver::make_layout(model, meshes, solver::Skin::deformable);
    const std::vector<int> owner = solver::entry_owners(model, meshes, layout, 2);
    ASSERT_EQ(static_cast<int>(owner.size()), layout.size());
    const solver::Field& position = layout["body"];
    int first = 0;
    for (int node = 0; node < position.count; ++node) {
      EXPECT_EQ(owner[position(node, 0)], owner[position(node, 2)]);
      first += owner[position(node, 0)] == 0;
    }
    EXPECT_NEAR(static_cast<double>(first) / position.count, 0.5, 0.15) << to_string(kind);
  }
}

}  // namespace
}  // namespace snug::tests
