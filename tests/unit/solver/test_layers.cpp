// Garments over one another: what the outer one meets, the derivatives of its contact and friction, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "solver/scene/layers.hpp"
#include "tests/unit/solver/terms.hpp"

namespace snug::tests {
namespace {

using solver::Skin;

/// "outer" as long as a coarse soft tube over "inner" in its middle; both shaken by 0.02 mm and turned against each other.
struct Dressed {
  input::Case description;
  solver::Meshes meshes;
  solver::Scene scene;
  solver::State state;

  explicit Dressed(Skin skin, double friction = 0.0, const std::string& master = {})
      : description(describe(friction, master)), meshes(make_meshes(description)), scene(tests::make_scene(description, meshes, skin)),
        state(solver::placed_state(scene.layout(), meshes)) {
    const solver::Layout& layout = scene.layout();
    state.load = 0.6;
    state.values.head(layout.positions()) += random_vector(layout.positions(), 2e-5, 1);
    turn("inner", 0.05), turn("outer", -0.03);
    for (const char* contact : {"contact of inner", "contact of outer"})
      for (int i = 0; i < layout[contact].count; ++i) state.values[layout[contact](i)] = 5000.0 + 1000.0 * std::sin(i);
    for (const auto& term : scene.terms()) settle(*term, state);
  }

  static input::Case describe(double friction, const std::string& master) {
    TubeCase tube;
    tube.around = 6, tube.along = 2, tube.through = 1, tube.cell_size = 0.03;
    input::Case c = describe_tube(tube);
    c.garments.push_back(c.garments.front());
    c.garments[0].name = "inner", c.garments[0].position = 0.015, c.garments[0].pattern.length = 0.03, c.garments[0].cell_size = 0.02;
    c.garments[1].name = "outer", c.garments[1].pattern.flat_circumference *= 1.1;
    c.contacts.front().friction = friction, c.contacts.front().master = master;
    return c;
  }
  void turn(const char* garment, double angle) {
    const solver::Field& field = scene.layout()[garment];
    for (int node = 0; node < field.count; ++node) {
      auto x = state.values.segment<3>(field(node));
      x = (Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) * Eigen::Vector3d(x)).eval();
    }
  }
  Eigen::VectorXd direction() const {
    Eigen::VectorXd d = random_vector(scene.layout().size(), 1.0, 2);
    for (const char* contact : {"contact of inner", "contact of outer"}) d.segment(scene.layout()[contact].first, scene.layout()[contact].count).setZero();
    for (const auto& term : scene.terms()) term->recover(state, d);
    return d;
  }
  solver::Contact& outer() {
    auto* contact = scene.find<solver::Contact>("contact of outer");
    contact->set_stiffness(1.0);  // all multipliers decide for contact
    contact->update(state);
    return *contact;
  }
};

TEST(Layers, EveryPointOfTheOuterGarmentMeetsTheInnerOneOrBeyondItsEdgesTheSkin) {
  Dressed dressed(Skin::deformable);
  const solver::Contact& contact = dressed.outer();
  double on_inner = 0.0, on_skin = 0.0;
  for (const auto& point : contact.point_forces(dressed.state)) {
    ASSERT_GE(point.facet, 0);
    const bool inner = contact.master().surface_of(point.facet) == 0;
    EXPECT_EQ(contact.master().surface(inner ? 0 : 1).deformable(), true);
    if (point.x.z() > 0.0155 && point.x.z() < 0.0445) EXPECT_TRUE(inner) << point.x.transpose();
    if (point.x.z() < 0.0145 || point.x.z() > 0.0455) EXPECT_FALSE(inner) << point.x.transpose();
    (inner ? on_inner : on_skin) += point.weight * contact.slave().triangles[point.triangle].area;
  }
  EXPECT_NEAR(on_inner + on_skin, dressed.description.garments[1].pattern.flat_circumference * 0.06, 1e-9);
  EXPECT_NEAR(on_inner / (on_inner + on_skin), 0.5, 0.01);
}

TEST(Layers, TheContactOfTheOuterIsTheDerivativeOfItsForcesAndGaps) {
  for (const Skin skin : {Skin::rigid, Skin::deformable}) {
    Dressed dressed(skin);
    expect_factor_four(dressed.outer(), dressed.state, dressed.direction());
    EXPECT_LE(asymmetry(assemble(dressed.outer(), dressed.state, solver::Tangent::full).tangent), 1e-12);
  }
}

// What the outer presses and rubs the inner one and the skin with it feels itself: forces and moments are in balance to round-off.
TEST(Layers, ForcesBetweenTheLayersAreInBalance) {
  Dressed dressed(Skin::deformable, 0.3);
  for (const auto& term : dressed.scene.terms()) term->renew(dressed.state);
  for (const auto& term : dressed.scene.terms()) term->update(dressed.state);
  const solver::State before = dressed.state;
  dressed.turn("outer", 1e-4);
  for (const auto& term : dressed.scene.terms()) term->update(dressed.state);
  for (const char* name : {"contact of outer", "friction of outer"}) {
    const solver::Term* term = name[0] == 'c' ? static_cast<solver::Term*>(dressed.scene.find<solver::Contact>(name)) : dressed.scene.find<solver::Friction>(name);
    const Eigen::VectorXd r = assemble(*term, dressed.state, solver::Tangent::none).residual;
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = force;
    double sum = 0.0, on_inner = 0.0;
    for (int first = 0; first < dressed.scene.layout().positions(); first += 3) {
      const Eigen::Vector3d f = r.segment<3>(first);
      force += f, moment += Eigen::Vector3d(dressed.state.values.segment<3>(first)).cross(f), sum += f.norm();
      if (const auto& inner = dressed.scene.layout()["inner"]; first >= inner.first && first < inner.end()) on_inner += f.norm();
    }
    EXPECT_GT(on_inner, 0.1 * sum) << name;
    EXPECT_LE(force.norm(), 1e-12 * sum) << name;
    EXPECT_LE(moment.norm(), 1e-12 * sum) << name;
  }
}

// The outermost first; a garment whose contact names the skin meets nothing else, and one that stands apart is not met.
TEST(Layers, AGarmentMeetsThoseBeforeItThatItLiesOver) {
  input::Case c = Dressed::describe(0.0, {});
  c.garments.push_back(c.garments[1]);
  c.garments[2].name = "coat";
  const solver::Meshes meshes = make_meshes(c);
  const auto under = [&](int g) { return solver::layers_under(solver::make_model(c, meshes.body), meshes.garments, g); };
  EXPECT_EQ(under(0), std::vector<int>{});
  EXPECT_EQ(under(1), std::vector<int>{0});
  EXPECT_EQ(under(2), (std::vector<int>{1, 0}));
  c.contacts.front().slave = "inner";
  c.contacts.resize(3, c.contacts.front());
  c.contacts[1].slave = "outer", c.contacts[1].master = "skin";
  c.contacts[2].slave = "coat", c.contacts[2].master = "inner";
  EXPECT_EQ(under(1), std::vector<int>{});
  EXPECT_EQ(under(2), std::vector<int>{0});
  // each is placed outside those that it meets
  EXPECT_LT(meshes.garments[0].placed[0].head<2>().norm(), meshes.garments[1].placed[0].head<2>().norm());
  EXPECT_LT(meshes.garments[1].placed[0].head<2>().norm(), meshes.garments[2].placed[0].head<2>().norm());
}

TEST(Layers, WhatCannotLieOnAnotherIsRefusedByName) {
  const auto refusal = [](const input::Case& c) -> std::string {
    const solver::Meshes meshes = make_meshes(c);
    try {
      tests::make_scene(c, meshes, Skin::rigid);
    } catch (const input::InputError& error) {
      return error.what();
    }
    return {};
  };
  input::Case c = Dressed::describe(0.0, {});
  c.garments[0].order = 1;
  EXPECT_THAT(refusal(c), testing::HasSubstr("inner is made of linear triangles and outer lies on it; leave its order out"));
  c.garments[0].order = 2, c.garments[0].pattern.length = 0.01, c.garments[0].position = 0.0;
  c.garments[1].position = 0.03, c.garments[1].pattern.length = 0.03;
  c.contacts.front().slave = "inner";
  c.contacts.push_back(c.contacts.front());
  c.contacts[1].slave = "outer", c.contacts[1].master = "inner";
  EXPECT_THAT(refusal(c), testing::HasSubstr("outer is to lie on inner, which it is nowhere near"));
}

}  // namespace
}  // namespace snug::tests
