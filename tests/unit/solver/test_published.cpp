// What a term publishes comes into the result, the files and what reads these, and no other source knows of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <stdexcept>

#include "postproc/comparison.hpp"
#include "postproc/recorders.hpp"
#include "postproc/report/page.hpp"
#include "postproc/store.hpp"
#include "solver/scene/result.hpp"
#include "solver/terms/garment_shape.hpp"
#include "tests/unit/postproc/scene.hpp"
#include "tests/unit/solver/terms.hpp"

namespace snug::tests {
namespace {

using postproc::NamedField, postproc::Place;
using testing::HasSubstr;

/// A term that is nothing but its fields: a temperature that rises by `rise` along z, and the number of each triangle.
class Warmth : public solver::Term {
 public:
  Warmth(std::string part, std::vector<Eigen::Vector3d> nodes, std::size_t triangles, double rise)
      : part_(std::move(part)), nodes_(std::move(nodes)), triangles_(triangles), rise_(rise) {}
  std::string name() const override { return "warmth"; }
  const solver::ElementEntries& entries(const solver::State&) const override { return none_; }
  bool assemble(const solver::State&, solver::Tangent, solver::Sink&) const override { return true; }
  void publish(const solver::State&, solver::PublishedFields& fields) const override {
    std::vector<double> at_nodes, at_triangles;
    for (const Eigen::Vector3d& x : nodes_) at_nodes.push_back(300.0 + rise_ * x.z());
    for (std::size_t t = 0; t < triangles_; ++t) at_triangles.push_back(static_cast<double>(t));
    fields[part_].add({"warmth", "K", "temperature <here>", Place::node, at_nodes, {}});
    if (triangles_ > 0) fields["garment"].add({"count", "", "of the triangle", Place::cell, at_triangles, {}});
  }

 private:
  std::string part_;
  std::vector<Eigen::Vector3d> nodes_;
  std::size_t triangles_;
  double rise_;
  solver::ElementEntries none_;
};

struct Placed {
  solver::Meshes meshes;
  postproc::RunResult result;
};

/// The tube sleeve where it is placed, with that term in the scene.
Placed placed(double rise, const std::string& part = "body") {
  TubeCase tube;
  tube.around = 8, tube.along = 2, tube.through = 1;
  const input::Case c = describe_tube(tube);
  Placed placed{make_meshes(c), {}};
  solver::Scene scene = tests::make_scene(c, placed.meshes, solver::Skin::deformable);
  scene.add(std::make_unique<Warmth>(part, placed.meshes.body.nodes, placed.meshes.garments.front().triangles.size(), rise));
  solver::State state = solver::placed_state(scene.layout(), placed.meshes);
  scene.look(state);
  placed.result.status = postproc::Status::converged;
  placed.result.body = solver::body_result(placed.meshes.body, true);
  tests::fill_result(scene, state, placed.meshes, placed.result);
  return placed;
}

// A field of a term that no source knows stands in the grid with its values, is read back with its unit and meaning, is named by the
// page and compared when it is asked for: two fields whose rise differs by 2 K/m over 0.1 m differ by 0.2 K at the top.
TEST(Published, AFieldOfATermsOwnGoesAllTheWay) {
  const Placed first = placed(10.0), second = placed(12.0);
  const auto folder = postproc::test::fresh_folder("published-first"), other = postproc::test::fresh_folder("published-second");
  postproc::write_results(first.result, {}, folder);
  postproc::write_results(second.result, {}, other);
  const postproc::StoredRun read = postproc::read_run(folder);
  const NamedField* warmth = read.body_grid->fields.find("warmth");
  ASSERT_NE(warmth, nullptr);
  double top = 0.0;
  for (std::size_t n = 0; n < first.meshes.body.nodes.size(); ++n) {
    top = std::max(top, first.meshes.body.nodes[n].z());
    EXPECT_EQ(warmth->at(n), 300.0 + 10.0 * first.meshes.body.nodes[n].z());
  }
  EXPECT_EQ(warmth->unit, "K");
  EXPECT_EQ(warmth->description, "temperature <here>");
  const NamedField* count = read.garment_grid->fields.find("count");
  ASSERT_NE(count, nullptr);
  EXPECT_EQ(count->place, Place::cell);
  EXPECT_EQ(count->at(3), 3.0);
  const std::string page = postproc::report::page(folder, {});
  EXPECT_THAT(page, HasSubstr("Further fields"));
  EXPECT_THAT(page, HasSubstr("temperature &lt;here&gt;"));
  const postproc::Comparison comparison =
      compare(postproc::read_field(other), postproc::read_field(folder), {.columns = {"warmth"}});
  ASSERT_EQ(comparison.columns.size(), 1u);
  EXPECT_NEAR(comparison.columns[0].maximum, 2.0 * top, 1e-12);
  EXPECT_NEAR(comparison.columns[0].scale, 300.0 + 10.0 * top, 1e-12);
  for (const auto& column : compare(postproc::read_field(other), postproc::read_field(folder)).columns) EXPECT_NE(column.label, "warmth");
}

// The terms of a case publish what its files have always had: stress of the tissue, forces and stretches of the fabric.
TEST(Published, TheTermsOfACasePublishTheirFields) {
  const Placed scene = placed(1.0);
  for (const char* name : {"displacement", "contact_pressure", "coverage", "cauchy_stress", "von_mises", "principal_stress", "warmth"})
    EXPECT_NE(scene.result.body.fields.find(name), nullptr) << name;
  EXPECT_EQ(scene.result.body.fields.find("stress_top"), nullptr);
  for (const char* name : {"contact_pressure", "tension_warp", "tension_weft", "shear", "stretch", "wrinkled"})
    EXPECT_NE(scene.result.garment.fields.find(name), nullptr) << name;
}

/// int p da over the garment with `pressure` linear between the vertices of its triangles as they lie.
double carried(const postproc::GarmentResult& garment, const std::vector<double>& pressure) {
  double sum = 0.0;
  for (const auto& triangle : garment.triangles) {
    Eigen::Matrix<double, 3, 6> x;
    for (int a = 0; a < 6; ++a) x.col(a) = garment.current[triangle[a]];
    for (const solver::TrianglePoint& q : solver::triangle_rule()) {
      const Eigen::Matrix<double, 3, 2> tangents = x * solver::garment_slopes(2, q.L);
      const double part = 0.5 * q.weight * tangents.col(0).cross(tangents.col(1)).norm();
      for (int v = 0; v < 3; ++v) sum += part * q.L[v] * pressure[triangle[v]];
    }
  }
  return sum;
}

// Contact publishes on its slave what it carries: the pressure on the cloth times its area as worn is the contact force, but for the
// slivers that the cut leaves out. There is no field of friction where there is none.
TEST(Published, ThePressureOnTheClothCarriesTheContactForce) {
  TubeCase tube;
  tube.around = 8, tube.along = 2, tube.through = 1;
  const input::Case c = describe_tube(tube);
  const postproc::RunResult result = tests::solve(c, make_meshes(c));
  ASSERT_EQ(result.status, postproc::Status::converged) << result.message;
  double force = 0.0;
  for (const auto& sample : result.samples) force += sample.force;
  ASSERT_GT(force, 0.0);
  EXPECT_NEAR(carried(result.garment, result.garment.fields[postproc::field::contact_pressure]), force, 1e-6 * force);
  EXPECT_EQ(result.garment.fields.has(postproc::field::slip), result.balance.friction_force > 0.0);
}

// A term that speaks of a part that the scene does not have is a mistake of its programmer, and is told.
TEST(Published, APartThatIsNotThereIsRefused) { EXPECT_THROW(placed(1.0, "hat"), std::logic_error); }

// A body alone has no field of a garment and none of contact but the bare skin's pressure and coverage, both zero.
TEST(Published, ASceneWithoutGarmentHasNoFieldsOfOne) {
  TubeCase tube;
  tube.around = 8, tube.along = 2, tube.through = 1;
  input::Case c = describe_tube(tube);
  c.garments.clear(), c.contacts.clear();
  const solver::Meshes meshes = make_meshes(c);
  solver::Scene scene = tests::make_scene(c, meshes, solver::Skin::deformable);
  postproc::RunResult result;
  result.body = solver::body_result(meshes.body, true);
  tests::fill_result(scene, solver::placed_state(scene.layout(), meshes), meshes, result);
  EXPECT_TRUE(result.garment.fields.empty());
  for (const char* name : {"hem", "pressure_inside", "shear_traction", "slip"}) EXPECT_EQ(result.body.fields.find(name), nullptr) << name;
  for (const double p : result.body.fields[postproc::field::contact_pressure]) EXPECT_EQ(p, 0.0);
  const postproc::StoredRun stored = postproc::stored_run(result, {}, {}, "out");
  EXPECT_TRUE(stored.body_grid && !stored.garment_grid);
}

}  // namespace
}  // namespace snug::tests
