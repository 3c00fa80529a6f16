// Rigid motions that nothing holds: found, named, and held without force where the loads balance.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "solver/scene/rigid_motions.hpp"
#include "tests/verification/blocks.hpp"

namespace snug::tests {
namespace {

using solver::FreePart, solver::NodeComponent;
using testing::HasSubstr;

BodyMesh block(CellKind kind = CellKind::hex27) {
  Block grid;
  grid.cells = {2, 1, 1}, grid.kind = kind;
  grid.map = [](const Eigen::Vector3d& u) { return Eigen::Vector3d(0.2 * u.x(), 0.1 * u.y(), 0.1 * u.z()); };
  return make_block(grid);
}

std::set<NodeComponent> held_components(const BodyMesh& mesh, const std::string& surface, const std::vector<int>& components) {
  std::set<NodeComponent> held;
  for (const int node : mesh.surface(surface)->nodes)
    for (const int c : components) held.emplace(node, c);
  return held;
}

std::string free_text(const BodyMesh& mesh, const std::set<NodeComponent>& held) {
  const auto parts = solver::free_parts(mesh, held);
  return parts.empty() ? "" : motions_text(parts.front());
}

// What supports leave free is named by axes; a line of nodes leaves the turn about itself, also where it is no axis.
TEST(RigidMotions, AreNamedByWhatSupportsLeaveFree) {
  for (const CellKind kind : {CellKind::hex27, CellKind::hex8, CellKind::tet10}) {
    BodyMesh mesh = block(kind);
    EXPECT_EQ(free_text(mesh, {}), "to move along x, y and z and to turn about x, y and z");
    EXPECT_EQ(free_text(mesh, held_components(mesh, "back", {2})), "to move along x and y and to turn about z");
    EXPECT_EQ(free_text(mesh, held_components(mesh, "left", {1, 2})), "to move along x and to turn about y and z");
    EXPECT_EQ(free_text(mesh, held_components(mesh, "left", {0, 1, 2})), "");
    name_nodes(mesh, "edge", [](const Eigen::Vector3d& x) { return x.x() < 1e-9 && x.z() < 1e-9; });
    EXPECT_EQ(free_text(mesh, held_components(mesh, "edge", {0, 1, 2})), "to turn about y");
    name_nodes(mesh, "corners", [](const Eigen::Vector3d& x) {
      return x.norm() < 1e-9 || (x - Eigen::Vector3d(0.2, 0.1, 0.0)).norm() < 1e-9;
    });
    EXPECT_EQ(free_text(mesh, held_components(mesh, "corners", {0, 1, 2})), "to turn about (0.894, 0.447, 0)");
  }
}

// A part that no cell connects with the held rest is free by itself, and is named by its place.
TEST(RigidMotions, OfUnconnectedPartsAreFoundByPart) {
  BodyMesh mesh = block(), other = block();
  const auto held = held_components(mesh, "left", {0, 1, 2});
  const int first = static_cast<int>(mesh.nodes.size());
  for (const Eigen::Vector3d& x : other.nodes) mesh.nodes.push_back(x + Eigen::Vector3d(0.0, 0.5, 0.0));
  for (mesh::CellNodes cell : other.cells) {
    for (int& node : cell) node += first;
    mesh.cells.push_back(cell), mesh.cell_layer.push_back(0);
  }
  const auto parts = solver::free_parts(mesh, held);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].motions.cols(), 6);
  EXPECT_GE(parts[0].nodes.front(), first);
  EXPECT_EQ(parts[0].name, "the part of the body round (100, 550, 50) mm, of \"tissue\",");
}

// As many components as motions, and they leave none.
TEST(RigidMotions, AreHeldByAsManyComponents) {
  const BodyMesh mesh = block();
  for (const std::vector<int>& components : {std::vector<int>{}, {2}, {1, 2}}) {
    std::set<NodeComponent> held = held_components(mesh, "back", components);
    const auto parts = solver::free_parts(mesh, held);
    ASSERT_EQ(parts.size(), 1u);
    const auto chosen = determinate_supports(parts.front(), mesh);
    EXPECT_EQ(static_cast<Eigen::Index>(chosen.size()), parts.front().motions.cols());
    held.insert(chosen.begin(), chosen.end());
    EXPECT_TRUE(solver::free_parts(mesh, held).empty());
  }
}

/// Pressure all round on a block that nothing holds.
BlockCase floating(CellKind kind) {
  BlockCase c(block(kind), {neo_hooke(10.0, 0.4)});
  for (const char* face : {"left", "right", "bottom", "top", "back", "front"}) c.pressure(face, 2e3);
  return c;
}

// A floating block under pressure all round is squeezed as one that is held so that it can shrink: the same stress, and
// nothing is borne where it is held.
TEST(RigidMotions, ABalancedBodyFloatsWithoutReactions) {
  for (const CellKind kind : {CellKind::hex27, CellKind::hex8, CellKind::tet10}) {
    const BlockAnswer a = solve(floating(kind));
    const Eigen::Vector3d reaction = a.result.balance.reactions.at("free motions of the body");
    EXPECT_LE(reaction.norm(), 1e-9 * 2e3 * 0.01);
    EXPECT_LE(a.result.numbers.at("free_motions_share_of_load"), 1e-9);
    for (const auto& stress : a.result.body.fields[postproc::field::cauchy_stress])
      EXPECT_LE((stress + 2e3 * Eigen::Matrix<double, 6, 1>(1, 1, 1, 0, 0, 0)).norm(), 1e-6 * 2e3) << to_string(kind);
  }
}

// Loads that do not balance are refused before anything is solved, with the force or the moment that is left.
TEST(RigidMotions, AnUnbalancedBodyIsRefusedWithItsNetLoad) {
  const auto message = [](const BlockCase& c) -> std::string {
    try {
      tests::make_scene(c.c, c.mesh, {}, solver::Skin::deformable);
    } catch (const input::InputError& error) {
      return error.what();
    }
    return "";
  };
  BlockCase pushed = floating(CellKind::hex27);
  pushed.traction("right", 300.0, 0.0, 0.0);  // on 0.01 m2
  EXPECT_THAT(message(pushed), HasSubstr("the body is free to move along x, y and z and to turn about x, y and z, and its loads do not "
                                         "balance: (3, 0, 0) N is left"));
  BlockCase turned = floating(CellKind::hex27);
  turned.traction("top", 500.0, 0.0, 0.0), turned.traction("bottom", -500.0, 0.0, 0.0);  // 10 N, 0.1 m apart
  EXPECT_THAT(message(turned), HasSubstr("(0, 0, -1) N m about its middle is left"));
  turned.hold("left", 0.0, {}, {}), turned.hold("back", {}, {}, 0.0);
  EXPECT_EQ(message(turned), "");  // free along y alone, where nothing pulls
  EXPECT_EQ(message(floating(CellKind::hex27)), "");
}

// Springs under a flat shell hold it along its normal only; rotations held along an edge take the turn about it.
TEST(RigidMotions, OfShellsCountSpringsAndClampedEdges) {
  BodyMesh mesh;
  mesh.kind = CellKind::tet10;
  mesh.layers.push_back({"plate", {}});
  for (const auto& [x, y] : std::vector<std::pair<double, double>>{{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}})
    mesh.nodes.emplace_back(x, y, 0.0);
  mesh::ShellTriangle triangle;
  triangle.nodes = {0, 1, 2, 3, 4, 5, -1, -1, -1};
  mesh.shell = {triangle};
  EXPECT_EQ(free_text(mesh, {}), "to move along x, y and z and to turn about x, y and z");
  mesh.shell[0].foundation = 1e5;
  EXPECT_EQ(free_text(mesh, {}), "to move along x and y and to turn about z");
  mesh.shell[0].foundation = 0.0;
  const std::set<NodeComponent> along_x = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}};
  EXPECT_EQ(free_text(mesh, along_x), "to turn about x");
  mesh.held_rotations = {{0, 0}, {1, 0}, {3, 0}};
  EXPECT_EQ(free_text(mesh, along_x), "");
}

}  // namespace
}  // namespace snug::tests
