// Rigid tools: their distance function, the derivatives of their contact, and what is said of a tool that does not meet the body.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <vector>

#include "solver/library/plausibility.hpp"
#include "solver/scene/tools.hpp"
#include "solver/terms/tool_contact.hpp"
#include "tests/unit/solver/terms.hpp"
#include "tests/verification/press.hpp"

namespace snug::tests {
namespace {

using solver::RigidTool, solver::ToolGap;

const Eigen::Vector3d oblique = Eigen::Vector3d(1.0, -2.0, 2.0) / 3.0;

/// Largest error of central differences of slope and curvature at a place for a step h, over the largest value.
double derivative_error(const RigidTool& tool, const Eigen::Vector3d& x, double h) {
  const ToolGap at = tool.gap(x);
  double error = 0.0;
  for (int c = 0; c < 3; ++c) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(c);
    const ToolGap up = tool.gap(x + step), down = tool.gap(x - step);
    error = std::max(error, std::abs((up.value - down.value) / (2.0 * h) - at.normal[c]));
    error = std::max(error, 1e-3 * ((up.normal - down.normal) / (2.0 * h) - at.curvature.col(c)).norm());
  }
  return error;
}

// Slope and curvature are the derivatives of the distance: halving the step quarters the error, on the face's side, beside the edge and behind it, of disc and ball.
TEST(RigidTools, SlopeAndCurvatureAreDerivativesOfTheDistance) {
  const Eigen::Vector3d across = Eigen::Vector3d(2.0, 1.0, 0.0).normalized(), other = oblique.cross(across);
  for (const RigidTool& tool : {RigidTool{oblique, 0.012, 0.003}, RigidTool{oblique, 0.0, 0.015}})
    for (const double along : {0.001, -0.001, -0.006})
      for (const double beside : {0.0141, 0.017}) {
        const Eigen::Vector3d x = along * oblique + beside * (0.6 * across + 0.8 * other);
        const double coarse = derivative_error(tool, x, 4e-4), fine = derivative_error(tool, x, 2e-4);
        EXPECT_NEAR(coarse / fine, 4.0, 0.3) << tool.flat << ", " << along << ", " << beside;
        EXPECT_NEAR(tool.gap(x).normal.norm(), 1.0, 1e-14);
      }
}

// A ball is a disc without a flat: distance from its centre less the radius.
TEST(RigidTools, BallMeasuresFromItsCentre) {
  const RigidTool ball{oblique, 0.0, 0.02};
  const Eigen::Vector3d centre = -0.02 * oblique, x = centre + 0.025 * (oblique + Eigen::Vector3d(0.1, 0.2, -0.3)).normalized();
  EXPECT_NEAR(ball.gap(x).value, 0.005, 1e-15);
}

// How far a tool goes until it meets a point: there the distance is zero, and beside the tool there is no such way.
TEST(RigidTools, WayToAPointEndsWhereTheDistanceIsZero) {
  const RigidTool disc{oblique, 0.012, 0.003};
  const Eigen::Vector3d across = oblique.unitOrthogonal();
  for (const double beside : {0.0, 0.007, 0.0135, 0.0149}) {
    const Eigen::Vector3d x = 0.03 * oblique + beside * across;
    EXPECT_NEAR(disc.gap(x - disc.way_to(x) * oblique).value, 0.0, 1e-15) << beside;
  }
  EXPECT_TRUE(std::isinf(disc.way_to(0.03 * oblique + 0.0151 * across)));
}

/// A block 40 x 40 x 20 mm, bonded below, with a ball over its top.
struct Pressed {
  BlockCase block;
  solver::Meshes meshes;
  solver::Model model;

  explicit Pressed(CellKind kind, const std::function<void(input::ToolSpec&)>& change = [](input::ToolSpec&) {}, int cells = 4) : block(body(kind, cells), {neo_hooke(10.0, 0.45)}) {
    block.c.load.reset();
    block.hold("bottom", 0.0, 0.0, 0.0);
    input::ToolSpec tool;
    tool.name = "probe", tool.on = "top", tool.radius = 0.012, tool.edge_radius = 0.003, tool.direction = {0.1, 0.05, -1.0}, tool.tip = {0.021, 0.018, 0.05}, tool.travel = 0.002;
    change(tool);
    block.c.tools = {tool};
    meshes.body = block.mesh;
    model = solver::make_model(block.c, meshes.body);
  }
  static BodyMesh body(CellKind kind, int cells) {
    BodyMesh mesh = upright_block({cells, 2, cells}, [](double u, double v, double w) { return Eigen::Vector3d(0.04 * u, 0.04 * v, 0.02 * w); });
    return kind == CellKind::hex27 ? mesh : convert(mesh, kind);
  }
};

// The tangent is the derivative of forces and rows and symmetric, on facets of every kind, with the tool's own entries.
TEST(ToolContact, TangentIsTheDerivativeOfTheResidual) {
  for (const CellKind kind : {CellKind::hex27, CellKind::tet10, CellKind::hex8}) {
    Pressed pressed(kind, [](input::ToolSpec& tool) { tool.shape = input::ToolShape::sphere; });  // whose distance has no jump in its curvature
    solver::Scene scene = solver::make_scene(pressed.model, pressed.meshes, solver::Skin::deformable);
    solver::State state = solver::placed_state(scene.layout(), pressed.model, pressed.meshes);
    const solver::Layout& layout = scene.layout();
    state.values.head(layout.positions()) += random_vector(layout.positions(), 2e-5, 1);
    const solver::Field& pressures = layout["contact of probe"];
    for (int i = 0; i < pressures.count; ++i) state.values[pressures(i)] = 1e7 + 1e6 * std::sin(i);  // they decide for contact whatever the gap
    const auto& contact = *scene.find<solver::ToolContact>();
    contact.renew(state);
    Eigen::VectorXd direction = random_vector(layout.size(), 1.0, 2);
    direction.segment(pressures.first, pressures.size()).setZero();
    contact.update(state);
    expect_factor_four(contact, state, direction);
    EXPECT_LE(asymmetry(assemble(contact, state, solver::Tangent::full).tangent), 1e-12);
  }
}

std::string message(const std::function<void(input::ToolSpec&)>& change) {
  try {
    Pressed pressed(CellKind::hex27, change);
    solver::place_tool(pressed.meshes.body, pressed.block.c.tools.front());
  } catch (const input::InputError& error) {
    return error.what();
  }
  return "";
}

// A tool that starts inside the body, ends before it, goes by it or meets a surface that is not there is refused with what is wrong and what to do.
TEST(Tools, WhatDoesNotMeetTheBodyIsRefusedByName) {
  EXPECT_EQ(message([](input::ToolSpec&) {}), "");
  const std::string inside = message([](input::ToolSpec& tool) { tool.from_touch = false, tool.tip = {0.02, 0.02, 0.017}, tool.direction = {0, 0, -1}; });
  EXPECT_NE(inside.find("\"probe\" starts 3 mm inside the body"), std::string::npos) << inside;
  EXPECT_NE(inside.find("move tip back by 3 mm"), std::string::npos) << inside;
  const std::string before = message([](input::ToolSpec& tool) { tool.from_touch = false, tool.tip = {0.02, 0.02, 0.025}, tool.direction = {0, 0, -2}; });
  EXPECT_NE(before.find("ends 3 mm before the surface \"top\""), std::string::npos) << before;
  EXPECT_NE(message([](input::ToolSpec& tool) { tool.tip = {0.08, 0.02, 0.05}; }).find("misses the surface \"top\""), std::string::npos);
  EXPECT_NE(message([](input::ToolSpec& tool) { tool.direction = {0, 0, 1}; }).find("misses the surface"), std::string::npos);
  EXPECT_NE(message([](input::ToolSpec& tool) { tool.on = "lid"; }).find("the body has no surface \"lid\""), std::string::npos);
}

// What a case does not name is not in its scene.
TEST(Tools, ASceneWithoutAToolHasNoneOfItsFields) {
  Pressed pressed(CellKind::hex27);
  pressed.block.c.tools.clear();
  const solver::Model model = solver::make_model(pressed.block.c, pressed.meshes.body);
  const solver::Layout layout = solver::make_layout(model, pressed.meshes, solver::Skin::deformable);
  EXPECT_EQ(layout["probe"].count, 0);
  EXPECT_EQ(layout.fields().size(), 2u);  // positions and cells of the body
  EXPECT_EQ(solver::make_scene(model, pressed.meshes, solver::Skin::deformable).find<solver::ToolContact>(), nullptr);
}

// A disc and a ball on facets of every kind: what moves the tool, what the body is held by and their moments balance to 1e-9; the rows of the way rise.
TEST(Tools, ForcesAndMomentsBalance) {
  for (const CellKind kind : {CellKind::hex27, CellKind::tet10, CellKind::hex8})
    for (const auto shape : {input::ToolShape::disc, input::ToolShape::sphere}) {
      Pressed pressed(kind, [&](input::ToolSpec& tool) { tool.shape = shape, tool.steps = 2, tool.radius = shape == input::ToolShape::sphere ? 0.03 : 0.015, tool.edge_radius = 0.012; }, kind == CellKind::hex8 ? 14 : 7);
      const postproc::RunResult result = solver::solve(pressed.model, pressed.meshes);
      ASSERT_EQ(result.status, postproc::Status::converged) << result.message;
      const postproc::ToolResult& tool = result.tools.front();
      EXPECT_GT(tool.end().force, 0.01);
      EXPECT_LE(result.balance.force_error.norm(), 1e-9 * result.balance.contact_force);
      EXPECT_LE(result.balance.moment_error.norm(), 1e-9 * 0.04 * result.balance.contact_force);
      EXPECT_LE((result.balance.reactions.at("probe") + tool.reaction).norm(), 1e-9 * tool.end().force);
      ASSERT_GE(tool.history.size(), 3u);
      for (std::size_t n = 1; n < tool.history.size(); ++n) EXPECT_GT(tool.history[n].force, tool.history[n - 1].force);
      EXPECT_NEAR(tool.end().depth, 0.002, 1e-15);
      EXPECT_GT(tool.end().largest_pressure, tool.mean_pressure());
    }
}

// Where the surface slips round a disc between the cells' corners the solver converges, with a force that is too small: that is no answer either, and it is warned of before.
TEST(Tools, ASurfaceThatSlipsRoundTheToolIsNoAnswer) {
  const auto small = [](input::ToolSpec& tool) { tool.radius = 0.008, tool.edge_radius = 0.002, tool.direction = {0, 0, -1}, tool.tip = {0.02, 0.02, 0.05}, tool.travel = 0.006, tool.steps = 1; };
  Pressed pressed(CellKind::hex27, small);
  const postproc::RunResult result = solver::solve(pressed.model, pressed.meshes);
  EXPECT_EQ(result.status, postproc::Status::failed);
  EXPECT_NE(result.message.find("coarse beside the contact; refine the mesh below the tool"), std::string::npos) << result.message;
  EXPECT_GT(result.numbers.at("tool_penetration_m"), 0.002);
  const auto warnings = solver::implausible(pressed.model, pressed.meshes, {});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings.front().found.find("the surface slips round it between them"), std::string::npos) << warnings.front().found;
}

/// What is said of a tool before anything is solved: of a way that ends in what is held, and the warnings of others.
std::pair<std::string, std::string> plausibility(CellKind kind, const std::function<void(input::ToolSpec&)>& change, bool bone) {
  Pressed pressed(kind, change, 8);
  if (bone) pressed.block.c.support.clear(), pressed.meshes.body.bone_nodes = pressed.meshes.body.surface("bottom")->nodes, pressed.model = solver::make_model(pressed.block.c, pressed.meshes.body);
  try {
    const auto warnings = solver::implausible(pressed.model, pressed.meshes, {});
    return {"", warnings.empty() ? "" : warnings.front().found + "; " + warnings.front().remedy};
  } catch (const input::InputError& error) {
    return {error.what(), ""};
  }
}

// A block 20 mm thick on a floor that is held, by a support or as bone: a tool that goes 2 mm deep passes, one that goes 12 mm deep is warned of, one that would go through the floor is refused
// with the thickness there and what to write, straight and oblique, from touch or from afar; where nothing is held below it nothing is said.
TEST(Tools, AWayThroughWhatIsHeldIsRefused) {
  for (const CellKind kind : {CellKind::hex27, CellKind::tet10})
    for (const bool bone : {false, true}) {
      const auto deep = [&](double travel, bool afar = false) {
        return plausibility(kind, [=](input::ToolSpec& tool) { tool.travel = travel, tool.direction = {0, 0, -1}, tool.tip = {0.02, 0.02, 0.05}, tool.from_touch = !afar; }, bone);
      };
      EXPECT_EQ(deep(0.002), std::pair(std::string(), std::string()));
      EXPECT_EQ(deep(0.012).first, "");
      EXPECT_NE(deep(0.012).second.find("goes 12 mm deep into the body, which is 20 mm thick there in front of what is held: 60 % of it; let it travel up to 10 mm"), std::string::npos) << deep(0.012).second;
      EXPECT_NE(deep(0.021).first.find("goes 21 mm deep into the body, which is 20 mm thick"), std::string::npos) << deep(0.021).first;
      EXPECT_NE(deep(0.051, true).first.find("let it travel less than 40 mm"), std::string::npos) << deep(0.051, true).first;
      EXPECT_EQ(deep(0.032, true), std::pair(std::string(), std::string()));
    }
  const auto oblique = [](double travel) { return plausibility(CellKind::hex27, [=](input::ToolSpec& tool) { tool.shape = input::ToolShape::sphere, tool.direction = {0, 1, -1}, tool.travel = travel, tool.tip = {0.02, 0.0, 0.04}; }, false).first; };
  EXPECT_EQ(oblique(0.018), "");
  EXPECT_NE(oblique(0.03).find("in front of what is held"), std::string::npos);  // sqrt(2) 20 mm
  EXPECT_EQ(plausibility(CellKind::hex27, [](input::ToolSpec& tool) { tool.travel = 0.5, tool.direction = {1, 0, 0}, tool.on = "left", tool.tip = {-0.1, 0.02, 0.015}, tool.radius = 0.004; }, false).first, "");
}

// On cells that are coarse beside its contact a ball meets no vertex: that is no answer, and what to do is said.
TEST(Tools, AContactThatTheMeshDoesNotSeeIsNoAnswer) {
  Pressed pressed(CellKind::hex27, [](input::ToolSpec& tool) { tool.shape = input::ToolShape::sphere, tool.travel = 1e-4; });
  const postproc::RunResult result = solver::solve(pressed.model, pressed.meshes);
  EXPECT_EQ(result.status, postproc::Status::failed);
  EXPECT_NE(result.message.find("refine the mesh below the tool"), std::string::npos) << result.message;
}

// Friction: with a large coefficient the surface goes with the ball and the force is larger than without; forces and moments balance as well. (Corners slip to and fro on the way: without the secant it stops at 63 %.)
TEST(Tools, FrictionHoldsTheSurface) {
  std::array<double, 2> force{};
  for (const double coefficient : {0.0, 0.5}) {
    Pressed pressed(CellKind::hex27, [&](input::ToolSpec& tool) { tool.friction = coefficient, tool.steps = 2, tool.direction = {0, 0, -1}, tool.shape = input::ToolShape::sphere, tool.radius = 0.03; }, 6);
    const postproc::RunResult result = solver::solve(pressed.model, pressed.meshes);
    ASSERT_EQ(result.status, postproc::Status::converged) << result.message;
    const postproc::ToolRow& end = result.tools.front().end();
    force[coefficient > 0.0] = end.force;
    EXPECT_EQ(end.friction_force > 0.0, coefficient > 0.0);
    EXPECT_LE(end.friction_force, coefficient * result.balance.contact_force * (1.0 + 1e-6));
    EXPECT_LE(result.balance.force_error.norm(), 1e-9 * result.balance.contact_force);
    EXPECT_LE(result.balance.moment_error.norm(), 1e-9 * 0.04 * result.balance.contact_force);
  }
  EXPECT_GT(force[1], 1.001 * force[0]);
}

// A way that begins over the body gives the force of one that begins at touch, at the same depth.
TEST(Tools, TravelBeforeTouchCostsNothing) {
  Pressed touching(CellKind::hex27), above(CellKind::hex27);
  const solver::PlacedTool placed = solver::place_tool(touching.meshes.body, touching.block.c.tools.front());
  input::ToolSpec& tool = above.block.c.tools.front();
  const Eigen::Vector3d tip = placed.start - 0.001 * placed.shape.direction;
  tool.tip = {tip.x(), tip.y(), tip.z()}, tool.travel = 0.003, tool.from_touch = false;
  above.model = solver::make_model(above.block.c, above.meshes.body);
  const auto one = solver::solve(touching.model, touching.meshes).tools.front(), other = solver::solve(above.model, above.meshes).tools.front();
  EXPECT_NEAR(other.end().depth, one.end().depth, 1e-9);
  EXPECT_NEAR(other.end().force, one.end().force, 1e-6 * one.end().force);
}

}  // namespace
}  // namespace snug::tests
