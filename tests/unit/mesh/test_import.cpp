// Meshes of cells from gmsh files, made here by gmsh itself.
#include <gtest/gtest.h>

#include <gmsh.h>
#include <unistd.h>

#include <filesystem>
#include <functional>

#include "mesh/body/import.hpp"
#include "mesh/formats/gmsh_session.hpp"

namespace snug::mesh {
namespace {

struct File {
  std::filesystem::path path;
  ~File() { std::filesystem::remove(path); }
};

enum class GmshNames { given, numbers, none };  ///< of the volumes

/// A box of 2 x 1 x 1 mm in two volumes, "soft" (x < 1) and "hard", meshed by gmsh; `finish` changes the mesh.
File two_boxes(bool hexahedra, int order, const std::function<void()>& finish = [] {}, GmshNames names = GmshNames::given) {
  const GmshSession session;
  namespace occ = gmsh::model::occ;
  occ::addBox(0, 0, 0, 1, 1, 1, 1), occ::addBox(1, 0, 0, 1, 1, 1, 2);
  gmsh::vectorpair out;
  std::vector<gmsh::vectorpair> map;
  occ::fragment({{3, 1}}, {{3, 2}}, out, map);
  occ::synchronize();
  gmsh::option::setNumber("Mesh.MeshSizeMin", 0.5), gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
  if (hexahedra) gmsh::model::mesh::setTransfiniteAutomatic();
  const auto name = [](int dimension, const std::vector<int>& tags, const std::string& text) {
    gmsh::model::setPhysicalName(dimension, gmsh::model::addPhysicalGroup(dimension, tags), text);
  };
  const auto in_box = [](double x0, double x1, int dimension) {
    gmsh::vectorpair found;
    gmsh::model::getEntitiesInBoundingBox(x0 - 1e-6, -1e-6, -1e-6, x1 + 1e-6, 1 + 1e-6, 1 + 1e-6, found, dimension);
    return std::vector<int>{found.at(0).second};
  };
  if (names == GmshNames::given) name(3, {1}, "soft"), name(3, {2}, "hard");
  if (names == GmshNames::numbers) gmsh::model::addPhysicalGroup(3, {1}, 17), gmsh::model::addPhysicalGroup(3, {2}, 4);
  if (names != GmshNames::none) name(2, in_box(0, 0, 2), "left"), name(2, in_box(2, 2, 2), "skin");
  gmsh::model::mesh::generate(3);
  if (order > 1) gmsh::model::mesh::setOrder(order);
  finish();
  File file{std::filesystem::temp_directory_path() / ("snug-import-" + std::to_string(::getpid()) + ".msh")};
  gmsh::write(file.path.string());
  return file;
}

input::BodySpec spec_of(const File& file) {
  input::BodySpec spec;
  spec.kind = input::BodyKind::imported, spec.mesh = file.path, spec.unit = 1e-3;
  for (const char* name : {"soft", "hard"}) spec.layers.emplace_back().name = name;
  return spec;
}

TEST(Import, HexahedraAndTetrahedraComeWithTheirLayersAndSurfaces) {
  for (const bool hexahedra : {true, false})
    for (const int order : {1, 2}) {
      const File file = two_boxes(hexahedra, order);
      const BodyMesh mesh = import_body_mesh(spec_of(file));
      EXPECT_EQ(mesh.kind, hexahedra ? CellKind::hex27 : CellKind::tet10);
      for (const QualityRow& row : quality(mesh)) EXPECT_NEAR(row.volume, 1e-9, 1e-18) << row.layer;
      ASSERT_TRUE(mesh.surface("skin") && mesh.surface("left"));
      EXPECT_EQ(mesh.skin_facets.size(), mesh.surface("skin")->facets.size());
      EXPECT_GE(mesh.skin_facets.size(), 4u);
      for (const int node : mesh.surface("left")->nodes) EXPECT_NEAR(mesh.nodes[node].x(), 0.0, 1e-15);
      for (const int node : mesh.surface("skin")->nodes) EXPECT_NEAR(mesh.nodes[node].x(), 2e-3, 1e-15);
    }
}

TEST(Import, LinearHexahedraStayLinearWhenAskedFor) {
  const File file = two_boxes(true, 2);
  auto spec = spec_of(file);
  spec.elements = input::Elements::Q1P0;
  const BodyMesh mesh = import_body_mesh(spec);
  EXPECT_EQ(mesh.kind, CellKind::hex8);
  for (const QualityRow& row : quality(mesh)) EXPECT_NEAR(row.volume, 1e-9, 1e-18);
}

TEST(Import, ARigidVolumeIsLeftOutAndHeldWhereItTouches) {
  const File file = two_boxes(true, 1);
  auto spec = spec_of(file);
  spec.layers[1].form = input::LayerForm::rigid;
  const BodyMesh mesh = import_body_mesh(spec);
  EXPECT_EQ(mesh.layers.size(), 1u);
  EXPECT_FALSE(mesh.bone_nodes.empty());
  for (const int node : mesh.bone_nodes) EXPECT_NEAR(mesh.nodes[node].x(), 1e-3, 1e-15);
}

void expect_import_refused(const File& file, const std::function<void(input::BodySpec&)>& change, const std::vector<std::string>& parts) {
  auto spec = spec_of(file);
  change(spec);
  try {
    import_body_mesh(spec);
    ADD_FAILURE() << "not refused: " << parts[0];
  } catch (const input::InputError& error) {
    for (const auto& part : parts) EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(Import, WhatDoesNotFitIsRefusedWithARemedy) {
  const File file = two_boxes(false, 1);
  expect_import_refused(file, [](auto& s) { s.layers[0].name = "softt"; }, {"no physical volume \"softt\"", "soft, hard"});
  expect_import_refused(file, [](auto& s) { s.layers.pop_back(); }, {"\"hard\"", "is no layer of the case"});
  expect_import_refused(file, [](auto& s) { s.elements = input::Elements::Q1P0; }, {"tetrahedra", "cannot be Q1/P0"});
}

TEST(Import, CellsOfThirdOrderAreRefusedByTheirNameWithTheOrderToSave) {
  for (const bool hexahedra : {false, true})
    expect_import_refused(two_boxes(hexahedra, 3), [](auto&) {}, {"third order or higher", hexahedra ? "(Hexahedron 64)" : "(Tetrahedron 20)", "Mesh.ElementOrder = 2, or gmsh -order 2"});
}

TEST(Import, AFileWithoutPhysicalVolumesSaysHowToNameThem) {
  const File file = two_boxes(false, 1, [] {}, GmshNames::none);
  expect_import_refused(file, [](auto&) {}, {"no physical volume \"soft\"", "it has no physical volumes", "Physical Volume(\"soft\") = {1};", "Physical Surface(\"skin\")"});
}

TEST(Import, VolumesWithoutANameGoByTheirNumber) {
  // 17 is the left box and 4 the right one: the surface at x = 0 belongs to cells of the first layer, that at 2 mm to those of the second.
  const File file = two_boxes(false, 1, [] {}, GmshNames::numbers);
  expect_import_refused(file, [](auto&) {}, {"no physical volume \"soft\"", "4, 17", "groups without a name go by their number"});
  auto spec = spec_of(file);
  spec.layers[0].name = "17", spec.layers[1].name = "4";
  const BodyMesh mesh = import_body_mesh(spec);
  ASSERT_EQ(mesh.layers.size(), 2u);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (const int node : mesh.cells[c])
      if (node >= 0) EXPECT_TRUE(mesh.layers[mesh.cell_layer[c]].name == "17" ? mesh.nodes[node].x() < 1e-3 + 1e-12 : mesh.nodes[node].x() > 1e-3 - 1e-12);
}

TEST(Import, AnInvertedCellIsNamedWithNumberLayerAndPlace) {
  // A corner of the soft box is pushed through to the other side of its cells.
  const File file = two_boxes(true, 1, [] {
    std::vector<std::size_t> tags;
    std::vector<double> x, parameters;
    gmsh::model::mesh::getNodes(tags, x, parameters);
    for (std::size_t n = 0; n < tags.size(); ++n)
      if (x[3 * n] + x[3 * n + 1] + x[3 * n + 2] < 1e-9) gmsh::model::mesh::setNode(tags[n], {1.0, 1.0, 1.0}, {});
  });
  try {
    import_body_mesh(spec_of(file));
    ADD_FAILURE();
  } catch (const input::InputError& error) {
    for (const char* part : {"cell ", "layer \"soft\"", "mm is inverted", "optimise the mesh"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(Import, PhysicalSurfacesBecomeAShell) {
  // A panel of 2 x 1 mm in quadrilaterals or triangles: its area times the thickness, its edge as a named curve.
  for (const bool quadrilaterals : {false, true}) {
    File file{std::filesystem::temp_directory_path() / ("snug-import-shell-" + std::to_string(::getpid()) + ".msh")};
    {
      const GmshSession session;
      gmsh::model::occ::addRectangle(0, 0, 0, 2, 1);
      gmsh::model::occ::synchronize();
      gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {1}), "panel");
      gmsh::model::setPhysicalName(1, gmsh::model::addPhysicalGroup(1, {4}), "left");
      gmsh::option::setNumber("Mesh.MeshSizeMin", 0.5), gmsh::option::setNumber("Mesh.MeshSizeMax", 0.5);
      gmsh::model::mesh::setTransfiniteAutomatic();
      if (quadrilaterals) gmsh::model::mesh::setRecombine(2, 1);
      gmsh::model::mesh::generate(2);
      gmsh::write(file.path.string());
    }
    input::BodySpec spec;
    spec.kind = input::BodyKind::imported, spec.mesh = file.path, spec.unit = 1e-3;
    input::LayerSpec& panel = spec.layers.emplace_back();
    panel.name = "panel", panel.form = input::LayerForm::shell, panel.thickness = 2e-4, panel.foundation = 5e6;
    const BodyMesh body = import_body_mesh(spec);
    EXPECT_TRUE(body.cells.empty());
    EXPECT_NEAR(quality(body)[0].volume, 2e-6 * 2e-4, 1e-18);
    EXPECT_NEAR(body.shell[0].foundation, 5e6, 1e-3);
    ASSERT_TRUE(body.surface("left"));
    const std::vector<int>& left = body.surface("left")->nodes;
    EXPECT_EQ(left.size() % 2, 1u);  // nodes and the middles between them
    for (const int node : left) EXPECT_EQ(body.nodes[node].x(), 0.0);
    panel.name = "pannel";
    EXPECT_THROW(import_body_mesh(spec), input::InputError);
  }
}

}  // namespace
}  // namespace snug::mesh
