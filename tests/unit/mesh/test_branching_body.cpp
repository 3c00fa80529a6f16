// Scans with any number of cuts become layered bodies of tetrahedra whose measures are those of the scan.
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "mesh/body/branching_body.hpp"
#include "mesh/body/locations.hpp"
#include "tests/unit/mesh/bodies.hpp"
#include "tests/unit/mesh/scanned_shapes.hpp"

namespace snug::mesh {
namespace {

using std::numbers::pi;
constexpr tests::Tube coarse_scan{.around = 60, .along = 30};  // where its measures are not looked at

input::BodySpec spec_of(const tests::ObjFile& file, std::vector<input::NamedCut> cuts, double tissue, double size) {
  input::BodySpec spec;
  spec.kind = input::BodyKind::scan;
  input::LayerSpec bone, muscle, fat;
  bone.name = "bone", bone.form = input::LayerForm::rigid;
  muscle.name = "muscle";
  fat.name = "fat", fat.thickness = 0.4 * tissue;
  spec.layers = {bone, muscle, fat};
  spec.scan.emplace();
  spec.scan->surface = file.path, spec.scan->unit = 1.0;
  spec.scan->cuts = std::move(cuts);
  spec.scan->core = input::CoreSpec{.surface = {}, .thickness = tissue, .places = {}, .cell_size = {}};
  spec.scan->cell_size = size;
  return spec;
}

const std::vector<input::NamedCut> tube_cuts = {{"low", {0, 0, 0.1}, {0, 0, -1}, {}}, {"high", {0, 0, 0.3}, {0, 0, 1}, {}}};
const std::vector<input::NamedCut> trouser_cuts = {{"waist", {0, 0, 0.6}, {0, 0, 1}, {}}, {"left", {0.08, 0, 0.15}, {0, 0, -1}, {}}, {"right", {-0.08, 0, 0.15}, {0, 0.2, -1}, {}}};

std::string error_of(const input::BodySpec& spec) {
  try {
    body_from_scan(spec);
  } catch (const input::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(BranchingBody, ATubeHasItsVolumeInEachLayerAndItsGirths) {
  const tests::ObjFile file(tests::tube({}));
  const ScannedBody body = body_from_scan(spec_of(file, tube_cuts, 0.03, 0.02));
  const auto rows = quality(body.mesh);
  ASSERT_EQ(rows.size(), 2u);
  const auto shell = [](double outer, double inner) { return pi * 0.2 * (outer * outer - inner * inner); };
  EXPECT_EQ(rows[0].layer, "muscle");
  EXPECT_NEAR(rows[0].volume / shell(0.038, 0.02), 1.0, 5e-3);
  EXPECT_NEAR(rows[1].volume / shell(0.05, 0.038), 1.0, 5e-3);
  EXPECT_NEAR(body.report.volume / shell(0.05, 0.0), 1.0, 1e-3);
  for (const auto& row : rows) EXPECT_GT(row.min_scaled_jacobian, 0.0);
  for (const CutRow& cut : body.report.cuts) EXPECT_NEAR(cut.girth, 2 * pi * 0.05, 1e-4) << cut.name;
  for (const SectionRow& row : body.report.sections) EXPECT_NEAR(row.girth, 2 * pi * 0.05, 1e-4) << row.height;
  const double sagitta = 0.05 * (1.0 - std::cos(pi / tests::Tube{}.around));  // of the scan's facets, 17 um: their corners are on the tube
  double farthest = 0.0;
  for (const int node : body.mesh.surface("skin")->nodes) farthest = std::max(farthest, std::abs(body.mesh.nodes[node].head<2>().norm() - 0.05));
  EXPECT_LT(farthest, sagitta);
  for (const int node : body.mesh.surface("high")->nodes) EXPECT_NEAR(body.mesh.nodes[node].z(), 0.3, 1e-9);
}

TEST(BranchingBody, TrunkAndTwoLegsAreOneBodyWithNamedCutsOfWhichOneIsTilted) {
  const tests::ObjFile file(tests::trousers({}));
  const ScannedBody body = body_from_scan(spec_of(file, trouser_cuts, 0.03, 0.026));
  EXPECT_NEAR(body.report.volume / body.report.volume_of_scan, 1.0, 5e-3);
  // Where the legs join the trunk the fillet is as narrow as a cell: what lies above the crotch loses a fifth of one.
  for (const SectionRow& row : body.report.sections) EXPECT_NEAR(row.girth, row.girth_of_scan, std::abs(row.height - 0.33) < 0.026 ? 0.2 * 0.026 : 1e-3) << row.height;
  EXPECT_EQ(body.report.sections.front().limbs, 2);
  EXPECT_EQ(body.report.sections.back().limbs, 1);
  std::set<std::string> names;
  for (const Surface& surface : body.mesh.surfaces) {
    names.insert(surface.name);
    EXPECT_FALSE(surface.nodes.empty()) << surface.name;
  }
  EXPECT_EQ(names, (std::set<std::string>{"skin", "muscle to fat", "bone", "waist", "left", "right"}));
  const Eigen::Vector3d normal = Eigen::Vector3d(0, 0.2, -1).normalized();
  for (const int node : body.mesh.surface("right")->nodes) EXPECT_NEAR(normal.dot(body.mesh.nodes[node] - Eigen::Vector3d(-0.08, 0, 0.15)), 0.0, 1e-9);
  for (const auto& row : quality(body.mesh)) EXPECT_GT(row.min_scaled_jacobian, 0.0) << row.layer;
  EXPECT_FALSE(body.mesh.bone_nodes.empty());
}

TEST(BranchingBody, AnElasticCoreIsALayerOfItsOwn) {
  const tests::ObjFile file(tests::tube({}));
  input::BodySpec spec = spec_of(file, tube_cuts, 0.03, 0.022);
  spec.layers[0].form = input::LayerForm::solid;
  const ScannedBody body = body_from_scan(spec);
  EXPECT_TRUE(body.mesh.bone_nodes.empty());
  ASSERT_EQ(quality(body.mesh).size(), 3u);
  EXPECT_NEAR(quality(body.mesh)[0].volume / (pi * 0.2 * 0.02 * 0.02), 1.0, 5e-3);
}

TEST(BranchingBody, WhatTheCutsDropMayHaveHolesWhatTheyKeepMayNot) {
  TriangleSurface open = tests::tube(coarse_scan);
  std::erase_if(open.triangles, [&](const auto& t) { return open.vertices[t[0]].z() > 0.37 && open.vertices[t[0]].x() > -0.02; });
  const tests::ObjFile file(open);
  EXPECT_EQ(error_of(spec_of(file, tube_cuts, 0.03, 0.022)), "no error");
  input::BodySpec higher = spec_of(file, tube_cuts, 0.03, 0.022);
  higher.scan->cuts[1].point[2] = 0.38;
  EXPECT_NE(error_of(higher).find("hole"), std::string::npos) << error_of(higher);
}

TEST(BranchingBody, WrongCutsAndCoresAreRefusedWithTheirNames) {
  const tests::ObjFile file(tests::tube(coarse_scan));
  const auto with = [&](auto change) {
    input::BodySpec spec = spec_of(file, tube_cuts, 0.03, 0.022);
    change(spec);
    return error_of(spec);
  };
  const auto expect = [](const std::string& error, const std::string& part) { EXPECT_NE(error.find(part), std::string::npos) << error; };
  expect(with([](auto& s) { s.scan->cuts[1].point[2] = 0.5; }), "\"high\" misses the surface");
  expect(with([](auto& s) { s.scan->cuts[1].point[0] = 0.2; }), "the point of the cut \"high\" lies 150 mm outside the surface");
  expect(with([](auto& s) { s.scan->core->thickness = 0.2; }), "so deep");
  expect(with([](auto& s) { s.scan->surface = "/nowhere.obj"; }), "no such file");
  expect(with([](auto& s) { s.scan->cuts[0].normal = {0, 0, 1}; }), "cut \"high\" misses");
}

TEST(BranchingBody, APointBesideALimbMeansTheLimbUnlessAnotherIsNearlyAsNear) {
  const tests::ObjFile legs(tests::trousers({.spacing = 0.012}), "beside");
  input::BodySpec spec = spec_of(legs, trouser_cuts, 0.03, 0.03);
  spec.scan->cuts[1].point = {0.18, 0.0, 0.15};  // 40 mm beside a leg of 60 mm
  const ScannedBody body = body_from_scan(spec);
  EXPECT_TRUE(std::any_of(body.report.said.begin(), body.report.said.end(), [](const std::string& line) { return line.find("the limb next to it is cut") != std::string::npos; }));
  spec.scan->cuts[1].point = {0.0, 0.08, 0.15};  // as far from either leg
  EXPECT_NE(error_of(spec).find("the point of the cut \"left\" lies 51 mm outside the surface"), std::string::npos) << error_of(spec);
}

TEST(BranchingBody, ACoreThatIsHardlyThereIsMeshed) {
  // 3 mm of radius are left inside of 47 mm of tissue; on a cone they run out at the upper cut.
  const tests::ObjFile thin(tests::tube(coarse_scan));
  const ScannedBody body = body_from_scan(spec_of(thin, tube_cuts, 0.047, 0.03));
  EXPECT_NEAR(body.report.volume / (pi * 0.2 * 0.05 * 0.05), 1.0, 2e-3);
  TriangleSurface cone = tests::tube(coarse_scan);
  for (auto& x : cone.vertices) x.head<2>() *= 1.0 - 0.5 * x.z();  // 35 to 47.5 mm between the cuts
  const tests::ObjFile tapered(cone, "cone");
  const ScannedBody ends = body_from_scan(spec_of(tapered, tube_cuts, 0.0423, 0.03));
  EXPECT_NEAR(ends.report.volume / ends.report.volume_of_scan, 1.0, 5e-3);
}

TEST(BranchingBody, CellsThatAreTooLargeForALayerAreMadeSmallerAndThatIsSaid) {
  // On a radius of 50 mm facets of 46 mm lie up to 5 mm inside, as far as a layer is thick.
  const tests::ObjFile file(tests::tube(coarse_scan));
  input::BodySpec spec = spec_of(file, tube_cuts, 0.02, 0.046);
  spec.layers[2].thickness = 0.005;
  const ScannedBody body = body_from_scan(spec);
  EXPECT_LT(body.report.cell_size, 0.046);
  EXPECT_TRUE(std::any_of(body.report.said.begin(), body.report.said.end(), [](const std::string& line) { return line.starts_with("cells of 46.0 mm did not do: "); }));
}

TEST(BranchingBody, OneTubeBetweenTwoCutsBecomesHexahedraAndWhatBranchesTetrahedra) {
  const tests::ObjFile tube(tests::tube(coarse_scan)), legs(tests::trousers({}), "legs");
  input::BodySpec spec = spec_of(tube, tube_cuts, 0.03, 0.022);
  EXPECT_TRUE(choose_cells(spec).tetrahedra);  // a core
  spec.scan->core.reset(), spec.scan->bone = input::BoneSpec{.girth = 0.1};
  EXPECT_FALSE(choose_cells(spec).tetrahedra);
  spec.scan->cells = input::ScanCells::tetrahedra;
  EXPECT_TRUE(choose_cells(spec).tetrahedra);
  input::BodySpec branched = spec_of(legs, {trouser_cuts[0], trouser_cuts[1]}, 0.03, 0.022);
  branched.scan->core.reset(), branched.scan->bone = input::BoneSpec{.girth = 0.1};
  EXPECT_TRUE(choose_cells(branched).tetrahedra);
  EXPECT_NE(choose_cells(branched).reason.find("no single limb"), std::string::npos) << choose_cells(branched).reason;
}

TEST(BranchingBody, AUnitThatIsLeftOutIsGuessedAndSaid) {
  TriangleSurface millimetres = tests::tube({});
  for (auto& x : millimetres.vertices) x *= 1e3;
  const tests::ObjFile file(millimetres);
  input::BodySpec spec = spec_of(file, tube_cuts, 0.03, 0.022);
  spec.scan->unit.reset();
  const ScannedBody body = body_from_scan(spec);
  EXPECT_NEAR(body.report.cuts[0].girth, 2 * pi * 0.05, 1e-4);
  ASSERT_FALSE(body.report.said.empty());
  EXPECT_NE(body.report.said[0].find("count in mm"), std::string::npos) << body.report.said[0];
}

// Cells of 10 mm: by nodes alone the areas are some tenths off.
TEST(Locations, LandmarkPolygonAndSectorOfALimbAreFoundWhereTheyAre) {
  const tests::ObjFile file(tests::trousers({.spacing = 0.01}));
  input::BodySpec spec = spec_of(file, trouser_cuts, 0.03, 0.02);
  input::LocationSpec landmark, polygon, sector;
  landmark.name = "front waist", landmark.at = std::array{0.0, 0.12, 0.5}, landmark.radius = 0.05;
  polygon.name = "back", polygon.polygon = {{-0.05, -0.11, 0.45}, {0.05, -0.11, 0.45}, {0.05, -0.11, 0.55}, {-0.05, -0.11, 0.55}};
  sector.name = "front left thigh", sector.from_angle = 0.25 * pi, sector.to_angle = 0.75 * pi, sector.from_height = 0.18, sector.to_height = 0.28, sector.limb = std::array{0.08, 0.0, 0.2};
  spec.locations = {landmark, polygon, sector};
  const BodyMesh mesh = body_from_scan(spec).mesh;
  for (const int node : mesh.surface("skin")->nodes) {
    const Eigen::Vector3d& x = mesh.nodes[node];
    switch (mesh.node_location[node]) {
      case 0: EXPECT_LE((x - Eigen::Vector3d(0, 0.12, 0.5)).norm(), 0.0501); break;
      case 1: EXPECT_TRUE(std::abs(x.x()) < 0.051 && x.y() < 0.0 && x.z() > 0.449 && x.z() < 0.551) << x.transpose(); break;
      case 2: EXPECT_TRUE(x.x() > 0.02 && x.y() > 0.03 && x.z() > 0.179 && x.z() < 0.281) << x.transpose(); break;
      default: break;
    }
  }
  constexpr double radius = 0.12, leg = 0.06;  // of the trunk, a cylinder there, and of a leg
  EXPECT_NEAR(covered_by(mesh, 0).area / (pi * 0.05 * 0.05 * (1.0 + 0.05 * 0.05 / (32.0 * radius * radius))), 1.0, 0.03);
  EXPECT_NEAR(covered_by(mesh, 1).area / (0.1 * 2.0 * radius * std::asin(0.05 / radius)), 1.0, 0.03);
  EXPECT_NEAR(covered_by(mesh, 2).area / (0.1 * 0.5 * pi * leg), 1.0, 0.03);
}

TEST(Locations, ALandmarkFarFromTheSkinIsRefusedWithTheNearestPlace) {
  const tests::ObjFile file(tests::tube(coarse_scan));
  input::BodySpec spec = spec_of(file, tube_cuts, 0.03, 0.022);
  input::LocationSpec landmark;
  landmark.name = "knee", landmark.at = std::array{0.2, 0.0, 0.2}, landmark.radius = 0.03;
  spec.locations = {landmark};
  EXPECT_NE(error_of(spec).find("\"knee\" is 150 mm away"), std::string::npos) << error_of(spec);
}

TEST(Locations, OfAStandardBodyThoseAreTakenThatThePartHas) {
  // Of four patches beside a tube between two cuts: one lies on it whole, one is cut in two by the upper end, one is beyond it, one on another limb.
  const tests::ObjFile file(tests::tube(coarse_scan));
  input::BodySpec spec = spec_of(file, tube_cuts, 0.03, 0.022);
  const BodyMesh bare = body_from_scan(spec).mesh;
  double low = 1e9, high = -1e9, reach = 0.0;
  for (const int node : bare.surface("skin")->nodes) {
    low = std::min(low, bare.nodes[node].z()), high = std::max(high, bare.nodes[node].z());
    reach = std::max(reach, bare.nodes[node].x());
  }
  const auto patch = [&](const std::string& name, double x, double z) {
    input::LocationSpec location;
    location.name = name, location.at = std::array{x, 0.0, z}, location.radius = 0.03, location.where_there = true;
    return location;
  };
  spec.locations = {patch("beyond", reach, high + 0.1), patch("cut in two", reach, high - 0.005), patch("there", reach, 0.5 * (low + high)), patch("elsewhere", reach + 0.2, 0.5 * (low + high))};
  const BodyMesh mesh = body_from_scan(spec).mesh;
  ASSERT_EQ(mesh.locations, std::vector<std::string>{"there"});
  EXPECT_GT(covered_by(mesh, 0).area, 0.4 * pi * 0.03 * 0.03);
  spec.locations[1].where_there = false;  // asked for by a case: taken as far as it goes
  EXPECT_EQ(body_from_scan(spec).mesh.locations, (std::vector<std::string>{"cut in two", "there"}));
}

}  // namespace
}  // namespace snug::mesh
