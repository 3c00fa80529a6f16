#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <cmath>
#include <map>
#include <set>

#include "mesh/body/section_centres.hpp"
#include "tests/unit/mesh/bodies.hpp"

namespace snug::mesh {
namespace {

using std::numbers::pi;

CellPositions positions(const BodyMesh& mesh, int cell) {
  return cell_positions(mesh.kind, mesh.cells[cell], mesh.nodes);
}

TEST(BodyMesh, LayerVolumesOfACylinderAreThoseOfItsRings) {
  auto spec = layered_spec();
  spec.cells_around = 32;
  const auto rows = quality(make_body_mesh(spec, cylinder()));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].layer, "tissue");
  EXPECT_EQ(rows[0].cells, 32 * 6 * 2);
  EXPECT_NEAR(rows[0].volume / (pi * (0.048 * 0.048 - 0.015 * 0.015) * 0.2), 1.0, 2e-5);
  EXPECT_NEAR(rows[1].volume / (pi * (0.05 * 0.05 - 0.048 * 0.048) * 0.2), 1.0, 2e-5);
  for (const auto& row : rows) EXPECT_GT(row.min_scaled_jacobian, 0.98);
}

TEST(BodyMesh, EveryCellHasAPositiveJacobianAtGaussPointsAndNodes) {
  const BodyMesh mesh = make_body_mesh(layered_spec(), ellipse());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (const auto& sample : check_points(mesh.kind))
      ASSERT_GT(jacobian(positions(mesh, static_cast<int>(c)), sample).determinant(), 0.0);
}

TEST(BodyMesh, IRunsRoundJUpAndKOutwards) {
  const BodyMesh mesh = make_body_mesh(layered_spec(), cylinder());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto x = positions(mesh, static_cast<int>(c));
    const Eigen::Vector3d outward = x.col(13).cwiseProduct(Eigen::Vector3d(1, 1, 0)).normalized();
    EXPECT_GT((x.col(22) - x.col(4)).dot(outward), 0.0);
    EXPECT_GT((x.col(16) - x.col(10)).z(), 0.0);
    EXPECT_GT(Eigen::Vector3d::UnitZ().cross(outward).dot(x.col(14) - x.col(12)), 0.0);
  }
}

TEST(BodyMesh, AllNineNodesOfASkinFacetLieOnTheTrueSurfaceWithTheNormalOutwards) {
  const BodyMesh mesh = make_body_mesh(layered_spec(), cylinder());
  EXPECT_EQ(mesh.skin_facets.size(), 16u * 6u);
  for (const auto& facet : mesh.skin_facets) {
    for (int node : facet) EXPECT_NEAR(mesh.nodes[node].head<2>().norm(), 0.05, 1e-15);
    const auto x = [&](int n) { return mesh.nodes[facet[n]]; };
    const Eigen::Vector3d normal = (x(5) - x(3)).cross(x(7) - x(1));
    EXPECT_GT(normal.normalized().dot(Eigen::Vector3d(x(4).x(), x(4).y(), 0).normalized()), 0.999);
  }
}

TEST(BodyMesh, TheMeshClosesRoundTheBodyWithoutDuplicateNodes) {
  const BodyMesh mesh = make_body_mesh(layered_spec(), ellipse());
  EXPECT_EQ(mesh.nodes.size(), 2u * 16 * (2 * 6 + 1) * (2 * 3 + 1));
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    for (std::size_t b = a + 1; b < mesh.nodes.size(); ++b) ASSERT_GT((mesh.nodes[a] - mesh.nodes[b]).norm(), 1e-5);
  // The Euler number V - E + F of a tube is 0.
  std::set<int> vertices;
  std::set<std::set<int>> edges;
  for (const auto& f : mesh.skin_facets)
    for (auto [a, b] : {std::pair{0, 2}, {2, 8}, {8, 6}, {6, 0}}) {
      vertices.insert(f[a]);
      edges.insert({f[a], f[b]});
    }
  EXPECT_EQ(
      static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) + static_cast<int>(mesh.skin_facets.size()),
      0);
}

TEST(BodyMesh, BoneAndCutPlanesHoldExactlyTheirNodes) {
  const BodyMesh mesh = make_body_mesh(layered_spec(), cylinder());
  EXPECT_EQ(mesh.bone_nodes.size(), 32u * 13);
  for (int node : mesh.bone_nodes) EXPECT_NEAR(mesh.nodes[node].head<2>().norm(), 0.015, 1e-15);
  const auto &lower = mesh.surface("lower")->nodes, &upper = mesh.surface("upper")->nodes;
  EXPECT_EQ(lower.size(), 32u * 7);
  EXPECT_EQ(upper.size(), 32u * 7);
  for (int node : lower) EXPECT_EQ(mesh.nodes[node].z(), 0.0);
  for (int node : upper) EXPECT_EQ(mesh.nodes[node].z(), 0.2);
  EXPECT_NEAR(mesh.mean_skin_cell, 0.5 * (0.2 / 6 + 0.1 * std::sin(pi / 16)), 1e-12);
}

TEST(BodyMesh, AMembraneSkinTakesNoCells) {
  auto spec = layered_spec();
  spec.layers[2].form = input::LayerForm::membrane;
  const BodyMesh mesh = make_body_mesh(spec, cylinder());
  EXPECT_EQ(mesh.cells.size(), 16u * 6 * 2);
  ASSERT_EQ(mesh.membranes.size(), 1u);
  EXPECT_EQ(mesh.membranes[0].thickness, 2e-3);
}

TEST(BodyMesh, LocationsAreSectorsThatMayWrapAndRangesOfHeight) {
  auto spec = layered_spec();
  const double degree = pi / 180;
  input::LocationSpec front, back;
  front.name = "front";
  front.from_angle = 45 * degree;
  front.to_angle = 135 * degree;
  front.from_height = 0.05;
  back.name = "inner";
  back.from_angle = 135 * degree;
  back.to_angle = -135 * degree;
  back.to_height = 0.09;
  spec.locations = {front, back};
  const BodyMesh mesh = make_body_mesh(spec, cylinder());
  std::map<int, int> count;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    ++count[mesh.node_location[n]];
    EXPECT_TRUE(mesh.node_location[n] != 0 || mesh.nodes[n].y() > 0.03);
    EXPECT_TRUE(mesh.node_location[n] != 1 || mesh.nodes[n].x() < -0.03);
  }
  EXPECT_EQ(count[0], 8 * 10);  // 32 nodes round, from 45 up to but not including 135 deg; heights j = 3 .. 12
  EXPECT_EQ(count[1], 8 * 6);   // j = 0 .. 5
}

// Means over a location must not hang on which rows of nodes fall inside: by nodes alone the area below is 4 to 13 % off, and its middle by up to 5 mm.
TEST(BodyMesh, ALocationCoversItsOwnAreaOnEveryMesh) {
  auto spec = layered_spec();
  input::LocationSpec patch;
  patch.name = "patch", patch.from_angle = 0.4 * pi, patch.to_angle = 0.9 * pi, patch.from_height = 0.033, patch.to_height = 0.137;
  spec.locations = {patch};
  for (const auto elements : {input::Elements::Q2P1, input::Elements::Q1P0, input::Elements::P2P1})
    for (const auto& [around, along] : {std::pair(16, 6), std::pair(22, 9), std::pair(28, 11)}) {
      spec.elements = elements, spec.cells_around = around, spec.cells_along = along;
      const BodyMesh mesh = make_body_mesh(spec, cylinder());
      const Covered covered = covered_by(mesh, 0);
      const double each = elements == input::Elements::Q1P0 ? 1.0 : 2.0;  // triangles of a cell's side
      const double chords = std::sin(pi / (each * around)) / (pi / (each * around)), step = 0.2 / (each * along) / 12.0;  // of the rule, m
      EXPECT_NEAR(covered.area / (0.05 * 0.5 * pi * 0.104 * chords), 1.0, step / 0.104) << around << " cells round";
      EXPECT_NEAR(covered.middle.z(), 0.085, 0.5 * step) << around << " cells round";
    }
}

TEST(BodyMesh, AThicknessIsMeasuredAcrossTheSkin) {
  const Limb limb = ellipse();
  auto spec = layered_spec();
  spec.cells_around = 64;
  const BodyMesh mesh = make_body_mesh(spec, limb);
  const double girth = limb.girth(0.2);
  EXPECT_NEAR(quality(mesh)[1].volume / (0.2 * (girth * 2e-3 - pi * 4e-6)), 1.0, 2e-3);
}

TEST(BodyMesh, WrongLayersAreRefusedWithARemedy) {
  const auto refused = [](auto change, const std::string& text) {
    auto spec = layered_spec();
    change(spec);
    try {
      make_body_mesh(spec, cylinder());
      ADD_FAILURE() << "not refused: " << text;
    } catch (const input::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  refused([](auto& s) { s.layers.erase(s.layers.begin()); }, "not exactly one solid layer");
  refused([](auto& s) { s.layers[1].thickness = 0.01; }, "without thickness");
  refused([](auto& s) { s.layers[2].thickness = 0.05; }, "nothing is left for layer \"tissue\"");
  refused([](auto& s) { s.layers[2].thickness = 0.0; }, "thickness 0");
  refused([](auto& s) { s.layers[1].cells = 0; }, "0 cells");
  refused([](auto& s) { s.cells_around = 2; }, "2 cells around");
}

// An elastic bone is filled by a square of cells and rings round it; its volume is that of its outline.
TEST(BodyMesh, AnElasticBoneIsMeshedToItsMiddle) {
  auto spec = layered_spec();
  spec.layers[0].form = input::LayerForm::solid, spec.layers[0].material.name = "bone";
  for (const input::Elements elements : {input::Elements::Q2P1, input::Elements::Q1P0}) {
    spec.elements = elements, spec.cells_around = 32;
    const BodyMesh mesh = make_body_mesh(spec, cylinder());
    const auto rows = quality(mesh);
    const bool quadratic = mesh.kind == CellKind::hex27;
    EXPECT_EQ(rows[0].cells, (8 * 8 + 32 * 2) * 6);
    EXPECT_NEAR(rows[0].volume / (pi * 0.015 * 0.015 * 0.2), 1.0, quadratic ? 2e-5 : 1e-2);
    EXPECT_GT(rows[0].min_scaled_jacobian, 0.5);
    EXPECT_TRUE(mesh.bone_nodes.empty());
    EXPECT_FALSE(mesh.surface("bone")->nodes.empty());
  }
}

// Six tetrahedra in each hexahedron: same volume, same curved skin, no gaps between them.
TEST(BodyMesh, TetrahedraFillTheLimbUpToItsCurvedSkin) {
  auto spec = layered_spec();
  spec.elements = input::Elements::P2P1, spec.cells_around = 32;
  const BodyMesh mesh = make_body_mesh(spec, cylinder());
  const auto rows = quality(mesh);
  EXPECT_EQ(rows[0].cells, 6 * 32 * 6 * 2);
  EXPECT_NEAR(rows[0].volume / (pi * (0.048 * 0.048 - 0.015 * 0.015) * 0.2), 1.0, 1e-4);
  EXPECT_EQ(mesh.skin_facets.size(), 2u * 32 * 6);
  for (const auto& facet : mesh.skin_facets)
    for (int a = 0; a < 6; ++a) EXPECT_NEAR(mesh.nodes[facet[a]].head<2>().norm(), 0.05, 1e-15);
  std::vector<char> all(mesh.nodes.size(), 1);
  std::size_t named = 0;
  for (const auto& surface : mesh.surfaces) named += surface.facets.size();
  EXPECT_EQ(boundary_facets(mesh, all).size(), named);  // bone, skin and the two cuts close it
}

TEST(BodyMesh, ACellThatWouldInvertIsRefusedWithLayerAngleAndHeight) {
  // A bone whose angle runs the other way round twists the cells through themselves.
  class Twisted final : public Outline {
   public:
    Eigen::Vector3d at(double turn, double z) const override {
      return {0.03 * std::cos(2 * pi * turn), -0.03 * std::sin(2 * pi * turn), z};
    }
  };
  Limb limb = cylinder();
  limb.bone = std::make_unique<Twisted>();
  try {
    make_body_mesh(layered_spec(), limb);
    ADD_FAILURE();
  } catch (const input::InputError& error) {
    const std::string text = error.what();
    for (const char* part : {"tissue", "deg", "mm"}) EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

// Angles of a leaning body count round the middle of its section at each height, not round one line through all of it.
TEST(SectionCentres, FollowALeaningBody) {
  BodyMesh mesh = make_body_mesh(layered_spec(), ellipse());  // round (10, -20) mm from 100 to 300 mm
  for (Eigen::Vector3d& x : mesh.nodes) x.x() += 0.5 * (x.z() - 0.1), x.y() -= 0.2 * (x.z() - 0.1);
  const SectionCentres centres(mesh);
  for (const double z : {0.1, 0.1371, 0.2, 0.3})
    EXPECT_LE((centres.at(z) - Eigen::Vector2d(0.01 + 0.5 * (z - 0.1), -0.02 - 0.2 * (z - 0.1))).norm(), 1e-4) << z;
}

// An open patch of skin has no section that closes: the mean of its nodes serves.
TEST(SectionCentres, OfAnOpenPatchAreTheMeanOfItsNodes) {
  BodyMesh mesh = make_body_mesh(layered_spec(), cylinder());
  std::erase_if(mesh.skin_facets, [&](const FacetNodeNumbers& facet) { return mesh.nodes[facet[4]].x() < 0.0; });
  const Eigen::Vector2d centre = SectionCentres(mesh).at(0.1);
  EXPECT_GT(centre.x(), 0.02);
  EXPECT_LT(std::abs(centre.y()), 5e-3);
}

}  // namespace
}  // namespace snug::mesh
