// Models of other programs: read, written, read again, and made a body.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <sstream>

#include "mesh/body/foreign.hpp"
#include "mesh/body/to_model.hpp"
#include "mesh/formats/model.hpp"

namespace snug::mesh {
namespace {

Model apdl(const std::string& text) {
  input::Diagnostics diagnostics;
  Model model = parse_apdl(text, "body.txt", diagnostics);
  diagnostics.throw_if_any();
  return model;
}

Model calculix(const std::string& text) {
  input::Diagnostics diagnostics;
  Model model = parse_calculix(text, "body.inp", diagnostics);
  diagnostics.throw_if_any();
  return model;
}

std::string shipped(const std::string& name) {
  std::ifstream in(std::string(SNUG_SOURCE_DIR) + "/tests/data/models/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

template <class Parse>
std::string error_of(Parse parse, const std::string& text) {
  try {
    parse(text);
  } catch (const input::InputError& error) {
    return error.what();
  }
  return "";
}

// The commands of the thesis' section 4.4.2 (its r has the foundation last): a double pyramid of eight triangles.
const std::string double_pyramid = shipped("double_pyramid.txt");

TEST(Apdl, TheCommandsOfTheThesisGiveAShellOnSpringsUnderForces) {
  // One division a line: an element an area, nodes numbered like the keypoints; thickness 6, foundation 40; PRXY is 0.3
  // where nothing is said (Ansys' default).
  const Model model = apdl(double_pyramid);
  ASSERT_EQ(model.nodes.size(), 6u);
  ASSERT_EQ(model.elements.size(), 8u);
  EXPECT_EQ(model.elements[0].kind, ElementKind::tri3);
  EXPECT_EQ(model.elements[4].nodes, (std::vector<int>{2, 1, 6}));
  EXPECT_EQ(model.nodes[4], (ModelNode{5, {0, 0, 12.5}}));
  ASSERT_EQ(model.sections.size(), 1u);
  EXPECT_EQ(model.sections[0], (ModelSection{6, 40}));
  ASSERT_EQ(model.materials.size(), 1u);
  EXPECT_EQ(model.materials[0].constants, (std::vector<double>{2.05e-2, 0.3}));
  EXPECT_EQ(model.forces, (std::vector<ModelForce>{{5, 0, 1.842}, {5, 2, -0.207}, {1, 1, 0.593}}));
}

TEST(Apdl, AreasAreDividedAndShareTheNodesOfTheirLines) {
  // Three divisions: nine triangles an area; a closed surface keeps Euler's V - E + F = 2, so V = 2 + F/2.
  std::string text = double_pyramid;
  text.replace(text.find("esize, , 1"), 10, "esize, , 3");
  const Model model = apdl(text);
  EXPECT_EQ(model.elements.size(), 72u);
  EXPECT_EQ(model.nodes.size(), 38u);
  const Model quadrilateral = apdl("et,1,181\nmp,ex,1,1\nsectype,1,shell\nsecdata,2\nk,1\nk,2,2\nk,3,2,2\nk,4,,2\na,1,2,3,4\nesize,,2\ndk,1,all\n");
  EXPECT_EQ(quadrilateral.elements.size(), 4u);
  EXPECT_EQ(quadrilateral.nodes.size(), 9u);
  EXPECT_EQ(quadrilateral.supports.size(), 6u);
  EXPECT_EQ(quadrilateral.sections[0], (ModelSection{2, 0}));
}

TEST(Apdl, BlocksOfACdbFileAreReadByTheirColumns) {
  // Reference book, section 5.3: trailing zeros left out, columns that touch, ranges in components.
  const Model model = apdl(shipped("block.cdb"));
  EXPECT_EQ(model.nodes[5].at, Eigen::Vector3d(1, -1.5e-3, 1));
  EXPECT_EQ(model.node_sets.at("FIXED"), (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(model.materials[0].constants, (std::vector<double>{2000, 0.25}));
  EXPECT_EQ(model.supports, (std::vector<ModelSupport>{{1, 0, 0.0}}));
  EXPECT_EQ(model.forces, (std::vector<ModelForce>{{7, 0, 125.0}}));
  EXPECT_EQ(model.pressures, (std::vector<ModelPressure>{{1, 1, 3.5}}));
}

TEST(Apdl, NodesAreSelectedByPlace) {
  const Model model = apdl("et,1,solid285\nmp,ex,1,1\nn,1\nn,2,1\nn,3,,1\nn,4,,,1\nnsel,s,loc,z,0\nd,all,uz,0\ncm,base,node\n"
                           "nsel,r,loc,x,0.5,2\nf,all,fx,3\nallsel\nd,1,all $ e,1,2,3,4\n");
  EXPECT_EQ(model.node_sets.at("BASE"), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(model.supports.size(), 9u);
  EXPECT_EQ(model.forces, (std::vector<ModelForce>{{2, 0, 3}}));
}

TEST(Apdl, WhatCannotBeTakenOverIsSaidWithItsLine) {
  EXPECT_NE(error_of(apdl, "et,1,beam188\nn,1\nn,2,1\ne,1,2\n").find("body.txt:4:1: error: element 1 is of type 188"), std::string::npos);
  EXPECT_NE(error_of(apdl, "et,1,185\nvmesh,all\n").find("body.txt:2:1: error: the command \"vmesh\" is not read"), std::string::npos);
  EXPECT_NE(error_of(apdl, "n,1,a*2\n").find("body.txt:1:5: error: \"a*2\" is no number"), std::string::npos);
  EXPECT_NE(error_of(apdl, "k,1,0,0,0\n.....\nk,9,1,1,1\n").find("body.txt:2:1: error: lines are left out"), std::string::npos);
  EXPECT_NE(error_of(apdl, "et,1,285\nmp,ex,1,1\nn,1\nn,2,1\nn,3,,1\ne,1,2,3,4\n").find("body.txt:6:1: error: element 1 names node 4"), std::string::npos)
      << error_of(apdl, "et,1,285\nmp,ex,1,1\nn,1\nn,2,1\nn,3,,1\ne,1,2,3,4\n");
  EXPECT_NE(error_of(apdl, "et,1,63\nk,1\nk,2,1\nk,3,,1\na,1,2,3\n").find("not said how fine"), std::string::npos);
  EXPECT_NE(error_of(apdl, "et,1,63\nn,1\nn,2,1\nn,3,,1\ne,1,2,3\n").find("has no thickness"), std::string::npos);
}

const std::string cube = shipped("cube.inp");

TEST(CalculixInput, CardsSetsAndLoadsAreRead) {
  // C10 = mu/2 and D1 = 2/kappa (reference book, section 5.4).
  const Model model = calculix(cube);
  EXPECT_EQ(model.elements[0].nodes, (std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(model.materials[0].law, ModelLaw::neo_hooke);
  EXPECT_EQ(model.materials[0].constants, (std::vector<double>{10, 1000}));
  EXPECT_EQ(model.node_sets.at("SOME"), (std::vector<int>{2, 4, 6}));
  EXPECT_EQ(model.supports.size(), 6u);
  EXPECT_EQ(model.forces.size(), 3u);
  EXPECT_EQ(model.pressures, (std::vector<ModelPressure>{{1, 1, 4.0}}));
}

TEST(CalculixInput, WhatCannotBeTakenOverIsSaidWithItsLine) {
  EXPECT_NE(error_of(calculix, "*NODE\n1,0,0,0\n*ELEMENT, TYPE=C3D27, ELSET=E\n1,1,1,1,1,1,1\n").find("body.inp:3:11: error: elements of type C3D27"), std::string::npos);
  EXPECT_NE(error_of(calculix, "*NODE\n1,0,0,zero\n").find("body.inp:2:7: error: \"zero\" is no number"), std::string::npos);
  EXPECT_NE(error_of(calculix, "*CONTACT PAIR\nA,B\n").find("body.inp:1:1: error: the card *CONTACT PAIR is not taken over"), std::string::npos);
  std::string bare = cube;
  bare.erase(bare.find("*SOLID SECTION"), 47);
  EXPECT_NE(error_of(calculix, bare).find("body.inp:13:1: error: element 1 has no section"), std::string::npos) << error_of(calculix, bare);
}

/// One element of each kind in the order of ElementKind, beside each other, with everything a model may hold.
Model everything(bool shells) {
  Model model;
  const auto add = [&](ElementKind kind, int material, int section) {
    ModelElement element{static_cast<int>(model.elements.size()) * 3 + 2, kind, {}, material, section};
    for (int n = 0; n < node_count(kind); ++n) {
      const int number = static_cast<int>(model.nodes.size()) * 2 + 1;
      model.nodes.push_back({number, Eigen::Vector3d(std::sqrt(number), -1.0 / number, 1e-7 * number)});
      element.nodes.push_back(number);
    }
    model.elements.push_back(element);
  };
  model.materials = {{"MUSCLE", ModelLaw::neo_hooke, {10.0, 1000.0}, 1.06e-9},
                     {"BONE", ModelLaw::elastic, {17000.0, 0.3}, 0.0},
                     {"FAT", ModelLaw::ogden, {1.5, 4.0, -0.25, -2.0, 250.0}, 0.0},
                     {"SKIN_2", ModelLaw::mooney_rivlin, {4.0, 1.0, 512.0}, 0.0}};
  if (shells) {
    model.sections = {{2.5, 0.0}, {1.0 / 3.0, 0.0}};
    int m = 0;
    for (const ElementKind kind : {ElementKind::tri3, ElementKind::tri6, ElementKind::quad4, ElementKind::quad8})
      add(kind, m % 4, m / 2), ++m;
    model.supports.push_back({1, 4, 0.0});
  } else {
    int m = 0;
    for (const ElementKind kind : {ElementKind::tet4, ElementKind::tet10, ElementKind::hex8, ElementKind::hex20}) add(kind, m++, -1);
  }
  model.node_sets = {{"LEFT", {1, 3, 5}}};
  model.supports.insert(model.supports.begin(), {{1, 0, 0.0}, {3, 2, 0.125}});
  model.forces = {{5, 1, -std::numbers::pi}, {7, 0, 1e-12}};
  model.pressures = {{2, 0, 3.25}, {8, 0, -1.0}};
  if (!shells) model.pressures.push_back({11, 5, 2.0}), model.pressures.push_back({11, 1, 2.0});
  return model;
}

/// Takes the value of a where b is within `relative` of it.
void settle(double a, double& b, double relative) {
  if (std::abs(a - b) <= relative * std::abs(a)) b = a;
}

/// Everything is the same, values to `relative` (0: to the last bit); constants differ by the round-off of kappa = 2/D1 and of
/// Ogden's convention besides.
void expect_same(Model a, Model b, double relative = 0.0) {
  b.node_sets.erase("NALL");
  for (Model* model : {&a, &b})  // CalculiX's fixed supports stand before the step, those that move in it
    std::stable_sort(model->supports.begin(), model->supports.end(), [](const auto& x, const auto& y) {
      return std::pair(x.node, x.component) < std::pair(y.node, y.component);
    });
  for (std::size_t n = 0; n < std::min(a.nodes.size(), b.nodes.size()); ++n)
    for (int c = 0; c < 3; ++c) settle(a.nodes[n].at[c], b.nodes[n].at[c], relative);
  for (std::size_t n = 0; n < std::min(a.forces.size(), b.forces.size()); ++n) settle(a.forces[n].value, b.forces[n].value, relative);
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (ModelElement& element : b.elements) {  // materials in the order of their elements: find them by name
    const auto& name = b.materials[element.material].name;
    for (std::size_t m = 0; m < a.materials.size(); ++m)
      if (a.materials[m].name == name) element.material = static_cast<int>(m);
  }
  for (const ModelMaterial& material : a.materials) {
    const auto same = std::find_if(b.materials.begin(), b.materials.end(), [&](const auto& m) { return m.name == material.name; });
    ASSERT_NE(same, b.materials.end()) << material.name;
    EXPECT_EQ(same->law, material.law);
    EXPECT_EQ(same->density, material.density);
    ASSERT_EQ(same->constants.size(), material.constants.size());
    for (std::size_t c = 0; c < material.constants.size(); ++c)
      EXPECT_NEAR(same->constants[c], material.constants[c], (relative + 4e-16) * std::abs(material.constants[c]));
  }
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.elements, b.elements);
  EXPECT_EQ(a.sections, b.sections);
  EXPECT_EQ(a.node_sets, b.node_sets);
  EXPECT_EQ(a.supports, b.supports);
  EXPECT_EQ(a.forces, b.forces);
  EXPECT_EQ(a.pressures, b.pressures);
}

TEST(RoundTrip, WhatIsWrittenIsReadBack) {
  // A CDB file to the last bit; CalculiX reads 20 characters of a number, so that 1e-14 of long ones is lost.
  for (const bool shells : {false, true}) {
    const Model model = everything(shells);
    std::ostringstream inp, cdb;
    write_calculix(inp, model);
    write_cdb(cdb, model);
    expect_same(model, calculix(inp.str()), 1e-13);
    expect_same(model, apdl(cdb.str()));
  }
  Model springs = everything(true);
  std::erase_if(springs.elements, [](const auto& e) { return e.kind != ElementKind::tri3; });
  springs.sections = {{2.5, 40.0}}, springs.materials.resize(1), springs.pressures.resize(1);
  std::ostringstream cdb;
  write_cdb(cdb, springs);
  expect_same(springs, apdl(cdb.str()));
}

input::BodySpec spec_in_mm() {
  input::BodySpec spec;
  spec.kind = input::BodyKind::imported, spec.mesh = "body.inp", spec.unit = 1e-3;
  return spec;
}

TEST(ForeignBody, AStraightHexahedronBecomesAQuadraticOneInSi) {
  // A cube of 1 mm: 27 nodes, volume 1e-9 m3; the face x = 0 is held with all nine of its nodes, one edge in y; 2.5 N a
  // node; kappa = 1000 N/mm2.
  const BodyMesh body = body_of(calculix(cube), spec_in_mm());
  ASSERT_EQ(body.nodes.size(), 27u);
  EXPECT_EQ(body.kind, CellKind::hex27);
  EXPECT_NEAR(quality(body)[0].volume, 1e-9, 1e-20);
  EXPECT_EQ(std::count_if(body.held.begin(), body.held.end(), [](const auto& h) { return h.component == 0; }), 9);
  EXPECT_EQ(std::count_if(body.held.begin(), body.held.end(), [](const auto& h) { return h.component == 1; }), 1);
  ASSERT_EQ(body.forces.size(), 3u);
  EXPECT_EQ(body.forces[0].force, Eigen::Vector3d(0, 0, 2.5));
  ASSERT_EQ(body.surface("NX0")->facets.size(), 1u);
  ASSERT_EQ(body.pressures.size(), 1u);
  EXPECT_NEAR(body.pressures[0].value, 4e6, 1e-6);
  for (const int node : body.pressures[0].facets[0]) EXPECT_NEAR(body.nodes[node].z(), 1e-3, 1e-18);
  EXPECT_EQ(body.layers[0].name, "TISSUE");
  EXPECT_EQ(*body.layers[0].material.table.find("bulk_modulus")->text(), "1000000000 Pa");
  EXPECT_TRUE(std::is_sorted(body.node_numbers.begin(), body.node_numbers.end()));
  input::BodySpec linear = spec_in_mm();
  linear.elements = input::Elements::Q1P0;
  EXPECT_EQ(body_of(calculix(cube), linear).nodes.size(), 8u);
}

TEST(ForeignBody, ABodyGoesThereAndBack) {
  // A 20-node cell with curved edges: body -> model -> body has the same nodes, held components, forces and pressures.
  Model model;
  for (int n = 0; n < 20; ++n) model.nodes.push_back({n + 1, Eigen::Vector3d::Zero()});
  const double at[20][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1},
                            {.5, -.1, 0}, {1.1, .5, 0}, {.5, 1, 0}, {0, .5, 0}, {.5, -.1, 1}, {1.1, .5, 1}, {.5, 1, 1},
                            {0, .5, 1.1}, {0, 0, .5}, {1, 0, .5}, {1, 1, .5}, {0, 1, .5}};
  ModelElement element{1, ElementKind::hex20, {}, 0, -1};
  for (int n = 0; n < 20; ++n) model.nodes[n].at = {at[n][0], at[n][1], at[n][2]}, element.nodes.push_back(n + 1);
  model.elements = {element};
  model.materials = {{"M", ModelLaw::elastic, {100, 0.3}, 0}};
  model.supports = {{1, 0, 0.0}, {1, 1, 0.5}};
  model.forces = {{7, 2, 1.5}};
  model.pressures = {{1, 3, 0.25}};
  input::BodySpec spec = spec_in_mm();
  spec.unit = 1.0;
  const BodyMesh body = body_of(model, spec);
  BodyLoads loads{body.held, std::vector<Eigen::Vector3d>(body.nodes.size(), Eigen::Vector3d::Zero()), body.pressures};
  for (const NodalForce& force : body.forces) loads.forces[force.node] = force.force;
  Model again = model_of(body, {{"M", ModelLaw::elastic, {100, 0.3}, 0}}, loads);
  again.node_sets.clear();  // the skin is named on the way
  expect_same(model, again);
  loads.forces.assign(body.nodes.size(), Eigen::Vector3d(0, 0, 1));  // also at the nodes that 20-node cells do not have
  double sum = 0.0;
  for (const ModelForce& force : model_of(body, again.materials, loads).forces) sum += force.value;
  EXPECT_NEAR(sum, 27.0, 1e-12);
}

TEST(ForeignBody, InvertedAndMixedCellsAreRefused) {
  std::string inverted = cube;
  inverted.replace(inverted.find("1, 1,2,3,4,5,\n6,7,8"), 19, "1, 5,6,7,8,1,\n2,3,4");
  EXPECT_NE(error_of([](const std::string& text) { return body_of(calculix(text), spec_in_mm()); }, inverted)
                .find("body.inp:13:1: error: element 1 is inverted or flat"), std::string::npos);
  EXPECT_NE(error_of([](const std::string& text) { return body_of(calculix(text), spec_in_mm()); }, cube + "*ELEMENT, TYPE=C3D4, ELSET=EALL\n2, 1,2,3,5\n")
                .find("element 2 is a 4-node tetrahedron"), std::string::npos);
}

TEST(ForeignBody, TheThesisShellIsOneClosedSurfaceInSi) {
  // Centimetres and newtons: thickness 6 cm, springs 40 N/cm3 = 4e7 N/m3, E = 2.05e-2 N/cm2 = 205 Pa; triangles that are
  // given inside out are turned.
  std::string text = double_pyramid;
  text.replace(text.find("a, 2, 3, 5"), 10, "a, 3, 2, 5");
  input::BodySpec spec;
  spec.kind = input::BodyKind::imported, spec.mesh = "body.txt", spec.unit = 1e-2;
  const BodyMesh body = body_of(apdl(text), spec);
  ASSERT_EQ(body.shell.size(), 8u);
  EXPECT_TRUE(body.cells.empty());
  EXPECT_EQ(body.nodes.size(), 18u);  // 6 corners, 12 edges
  EXPECT_NEAR(body.shell[0].thickness, 0.06, 1e-15);
  EXPECT_NEAR(body.shell[0].foundation, 4e7, 1e-6);
  EXPECT_EQ(body.layers[0].material.table.find("youngs_modulus")->text()->substr(0, 3), "205");
  double volume = 0.0;  // Gauss: of the double pyramid, 2/3 area height, if all normals point one way
  for (const ShellTriangle& t : body.shell)
    volume += body.nodes[t.nodes[0]].dot(body.nodes[t.nodes[1]].cross(body.nodes[t.nodes[2]])) / 6.0;
  EXPECT_NEAR(std::abs(volume), 2.0 / 3.0 * 0.02 * 0.125, 1e-12);
  EXPECT_EQ(body.forces.size(), 2u);
  EXPECT_EQ(body.skin_facets.size(), 8u);
}

TEST(ForeignBody, QuadrilateralsAreCutAndBranchesRefused) {
  const Model quad = calculix("*NODE\n1,0,0,0\n2,2,0,0\n3,2,1,0\n4,0,1,0\n5,1,0,0\n6,2,.5,0\n7,1,1,0\n8,0,.5,0\n*ELEMENT,TYPE=S8R,ELSET=E\n"
                              "1,1,2,3,4,5,6,7,8\n*MATERIAL,NAME=M\n*ELASTIC\n10.,.3\n*SHELL SECTION,ELSET=E,MATERIAL=M\n.1\n*BOUNDARY\n1,1,6\n4,1,6\n*STEP\n*STATIC\n*DLOAD\nE,P,2.\n*END STEP\n");
  input::BodySpec spec;
  spec.kind = input::BodyKind::imported, spec.mesh = "body.inp";
  const BodyMesh body = body_of(quad, spec);
  EXPECT_EQ(body.shell.size(), 2u);
  EXPECT_EQ(body.nodes.size(), 9u);
  EXPECT_EQ(body.held_rotations.size(), 6u);
  ASSERT_EQ(body.pressures.size(), 1u);
  EXPECT_EQ(body.pressures[0].value, -2.0);  // along the normal, ours act against it
  EXPECT_NE(error_of([&](const std::string& text) { return body_of(apdl(text), spec); },
                     "et,1,181\nmp,ex,1,1\nsectype,1,shell\nsecdata,1\nn,1\nn,2,1\nn,3,,1\nn,4,,-1\nn,5,,,1\ne,1,2,3\ne,1,2,4\ne,1,2,5\n")
                .find("share an edge"), std::string::npos);
}

}  // namespace
}  // namespace snug::mesh
