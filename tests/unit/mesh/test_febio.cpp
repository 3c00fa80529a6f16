// Models of FEBio as bodies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh/body/foreign.hpp"
#include "mesh/formats/model.hpp"

namespace snug::mesh {
namespace {

using testing::ElementsAre, testing::HasSubstr, testing::IsEmpty, testing::SizeIs, testing::UnorderedElementsAre;

Model feb(const std::string& text, int load_step = 0) {
  input::Diagnostics diagnostics;
  Model model = parse_febio(text, "leg.feb", diagnostics, load_step);
  diagnostics.throw_if_any();
  return model;
}

std::string febio_fault(const std::string& text, int load_step = 0) {
  try {
    feb(text, load_step);
  } catch (const input::InputError& error) {
    return error.what();
  }
  return "";
}

/// A brick of 2 x 1 x 3 and a tetrahedron on a wedge's worth of it, of two materials.
const std::string nodes = "<Nodes name=\"all\"><node id=\"1\">0,0,0</node><node id=\"2\">2.0, 0, 0</node><node id=\"3\">2,1,0</node><node id=\"4\">0,1,0</node>\n"
                          "<node id=\"5\">0,0,3</node><node id=\"6\">2,0,3</node><node id=\"7\">2,1,3</node><node id=\"8\">0,1,3</node></Nodes>\n";
const std::string materials = "<Material><material id=\"1\" name=\"fat\" type=\"Mooney-Rivlin\"><density>1.1</density><c1>0.4</c1><c2>0.1</c2><k>50</k></material>\n"
                              "<material id=\"2\" name=\"muscle\" type=\"neo-Hookean\"><E>6</E><v>0.25</v></material></Material>\n";

std::string four(const std::string& rest, const std::string& mesh = "<Elements type=\"hex8\" name=\"brick\"><elem id=\"7\">1,2,3,4,5,6,7,8</elem></Elements>\n") {
  return "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n<febio_spec version=\"4.0\">\n<Module type=\"solid\"/>\n<Control><time_steps>4</time_steps><step_size>0.5</step_size></Control>\n" + materials +
         "<Mesh>" + nodes + mesh +
         "<NodeSet name=\"low\">1,2,3,\n4</NodeSet><NodeSet name=\"top\">5,6,7,8</NodeSet>\n<Surface name=\"lid\"><quad4 id=\"1\">5,6,7,8</quad4></Surface><Surface name=\"turned\"><quad4 id=\"1\">1,2,6,5</quad4></Surface>"
         "<Surface name=\"wrong\"><quad4 id=\"1\">6,2,1,5</quad4></Surface></Mesh>\n<MeshDomains><SolidDomain name=\"brick\" mat=\"muscle\"/></MeshDomains>\n"
         "<LoadData><load_controller id=\"1\" type=\"loadcurve\"><interpolate>LINEAR</interpolate><points><pt>0,0</pt><pt>4,1</pt></points></load_controller></LoadData>\n" +
         rest + "<Output><plotfile type=\"febio\"/></Output></febio_spec>\n";
}

TEST(Febio, AModelOfFormatFourIsRead) {
  // The end is at 4 steps of 0.5: the curve, which comes to 1 at 4, is at a half there. The lid is pressed from outside; a facet that turns the other way is pulled.
  const Model model = feb(four("<Boundary><bc type=\"zero displacement\" node_set=\"low\"><x_dof>1</x_dof><y_dof>0</y_dof><z_dof>1</z_dof></bc>"
                               "<bc type=\"prescribed displacement\" node_set=\"top\"><dof>y</dof><value lc=\"1\">0.2</value><relative>0</relative></bc></Boundary>"
                               "<Loads><surface_load type=\"pressure\" surface=\"lid\"><pressure lc=\"1\">0.3</pressure><linear>0</linear></surface_load>"
                               "<surface_load type=\"pressure\" surface=\"wrong\"><pressure>2</pressure></surface_load>"
                               "<nodal_load type=\"nodal_force\" node_set=\"top\"><value lc=\"1\">0,4,-6</value></nodal_load></Loads>"));
  ASSERT_THAT(model.elements, SizeIs(1));
  EXPECT_EQ(model.elements[0].number, 7);
  ASSERT_THAT(model.materials, SizeIs(2));
  EXPECT_EQ(model.materials[model.elements[0].material].law, ModelLaw::compressible_neo_hooke);
  EXPECT_THAT(model.materials[0].constants, ElementsAre(0.4, 0.1, 50));
  EXPECT_EQ(model.materials[0].volume, ModelVolume::logarithmic);
  EXPECT_THAT(model.supports, SizeIs(8 + 4));
  EXPECT_EQ(std::count(model.supports.begin(), model.supports.end(), ModelSupport{6, 1, 0.1}), 1);
  EXPECT_EQ(std::count(model.supports.begin(), model.supports.end(), ModelSupport{3, 1, 0.0}), 0);
  EXPECT_THAT(model.pressures, UnorderedElementsAre(ModelPressure{7, 1, 0.15}, ModelPressure{7, 2, -2.0}));
  EXPECT_THAT(model.forces, SizeIs(8));
  EXPECT_EQ(std::count(model.forces.begin(), model.forces.end(), ModelForce{8, 2, -3.0}), 1);
  EXPECT_THAT(model.node_sets.at("lid"), ElementsAre(5, 6, 7, 8));
  input::BodySpec spec;
  spec.kind = input::BodyKind::imported, spec.mesh = "leg.feb", spec.unit = 0.01;
  const BodyMesh body = body_of(model, spec);
  double volume = 0.0;
  for (const QualityRow& row : quality(body)) volume += row.volume;
  EXPECT_NEAR(volume, 6e-6, 1e-18);
  ASSERT_THAT(body.layers, SizeIs(2));
  EXPECT_EQ(body.layers[1].material.table.find("law") != nullptr, true);
}

TEST(Febio, FormatThreeNamesThingsOtherwise) {
  const std::string text = "<febio_spec version=\"3.0\"><Module type=\"solid\"/>\n" + materials + "<Mesh>" + nodes +
                           "<Elements type=\"tet4\" mat=\"1\" name=\"a\"><elem id=\"1\">1,2,4,5</elem></Elements><Elements type=\"tet4\" name=\"b\"><elem id=\"2\">2,3,4,7</elem></Elements>"
                           "<NodeSet name=\"s\"><n id=\"1\"/><n id=\"4\"/></NodeSet><Surface name=\"f\"><tri3 id=\"1\">1,4,2</tri3></Surface></Mesh><MeshDomains><SolidDomain name=\"b\" mat=\"muscle\"/></MeshDomains>\n"
                           "<Boundary><bc type=\"fix\" node_set=\"s\"><dofs>x,z</dofs></bc><bc type=\"prescribe\" node_set=\"@surface:f\"><dof>y</dof><scale lc=\"1\">0.5</scale></bc></Boundary>"
                           "<Loads><nodal_load type=\"nodal_load\" node_set=\"s\"><dof>z</dof><scale>3</scale></nodal_load></Loads>"
                           "<LoadData><load_controller id=\"1\" type=\"loadcurve\"><points><point>0,0</point><point>1,1</point></points></load_controller></LoadData></febio_spec>";
  const Model model = feb(text);
  EXPECT_EQ(model.materials[model.elements[0].material].name, "fat");
  EXPECT_EQ(model.materials[model.elements[1].material].name, "muscle");
  EXPECT_THAT(model.supports, SizeIs(4 + 3));
  EXPECT_THAT(model.forces, UnorderedElementsAre(ModelForce{1, 2, 3.0}, ModelForce{4, 2, 3.0}));
}

TEST(Febio, AStepHasTheLoadsOutsideOfStepsAndItsOwn) {
  const std::string text = four("<Boundary><bc type=\"zero displacement\" node_set=\"low\"><x_dof>1</x_dof></bc></Boundary><Step>"
                                "<step id=\"1\"><Control><time_steps>10</time_steps><step_size>0.1</step_size></Control><Loads><nodal_load type=\"nodal_force\" node_set=\"top\"><value lc=\"1\">0,0,8</value></nodal_load></Loads></step>"
                                "<step id=\"2\"><Control><time_steps>1</time_steps><step_size>1</step_size></Control><Loads><surface_load type=\"pressure\" surface=\"lid\"><pressure lc=\"1\">4</pressure></surface_load></Loads></step></Step>");
  EXPECT_THAT(feb(text, 1).forces, testing::Contains(ModelForce{5, 2, 2.0}));  // at time 1 of 4
  EXPECT_THAT(feb(text, 1).pressures, IsEmpty());
  const Model last = feb(text);
  EXPECT_THAT(last.pressures, ElementsAre(ModelPressure{7, 1, 2.0}));  // at time 2
  EXPECT_THAT(last.forces, IsEmpty());
  EXPECT_THAT(last.supports, SizeIs(4));
  EXPECT_THAT(last.remarks[0].found, HasSubstr("there are 2 steps"));
  EXPECT_THAT(febio_fault(text, 3), HasSubstr("load step 3 is asked for, and there are 2"));
}

TEST(Febio, OfTwentySevenNodesTheFirstTwentyAreTaken) {
  // A cube of 2: corners, middles below, above, upright, then faces and the centre. Its edge 1-2 bulges.
  const std::vector<std::array<double, 3>> at = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}, {1, -0.2, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2},
                                                 {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}, {1, 0, 1}, {2, 1, 1}, {1, 2, 1}, {0, 1, 1}, {1, 1, 0}, {1, 1, 2}, {1, 1, 1}};
  std::string list, connected;
  for (std::size_t n = 0; n < at.size(); ++n) {
    list += "<node id=\"" + std::to_string(n + 1) + "\">" + std::to_string(at[n][0]) + "," + std::to_string(at[n][1]) + "," + std::to_string(at[n][2]) + "</node>";
    connected += (n ? "," : "") + std::to_string(n + 1);
  }
  const Model model = feb("<febio_spec version=\"4.0\"><Module type=\"solid\"/>" + materials + "<Mesh><Nodes>" + list + "</Nodes><Elements type=\"hex27\" name=\"c\"><elem id=\"1\">" + connected +
                          "</elem></Elements><Surface name=\"s\"><quad9 id=\"1\">1,2,6,5,9,18,13,17,21</quad9></Surface></Mesh><MeshDomains><SolidDomain name=\"c\" mat=\"fat\"/></MeshDomains>"
                          "<Loads><surface_load type=\"pressure\" surface=\"s\"><pressure>1</pressure></surface_load></Loads></febio_spec>");
  EXPECT_EQ(model.elements[0].kind, ElementKind::hex20);
  EXPECT_THAT(model.pressures, ElementsAre(ModelPressure{1, 2, 1.0}));
  input::BodySpec spec;
  spec.kind = input::BodyKind::imported, spec.mesh = "c.feb";
  const BodyMesh body = body_of(model, spec);
  ASSERT_THAT(body.cells, SizeIs(1));
  EXPECT_EQ(body.nodes[body.cells[0][1]].y(), -0.2);
}

TEST(Febio, WhatIsNotTakenOverIsSaidWithItsLine) {
  EXPECT_THAT(febio_fault("<febio_spec version=\"2.5\"><Module type=\"solid\"/></febio_spec>"), HasSubstr("save it in format 4.0"));
  EXPECT_THAT(febio_fault("<febio_spec version=\"4.0\"><Module type=\"biphasic\"/></febio_spec>"), HasSubstr("the module is \"biphasic\""));
  EXPECT_THAT(febio_fault("<febio_spec version=\"4.0\">\n<Module type=\"solid\">\n</febio_spec>"), HasSubstr("leg.feb:3:1: error: this is no XML"));
  EXPECT_THAT(febio_fault(four("<Contact><contact type=\"sliding-elastic\"/></Contact>")), HasSubstr("the model has contact"));
  EXPECT_THAT(febio_fault(four("<Loads><body_load type=\"const\"/></Loads>")), HasSubstr("the load <body_load type=\"const\"> is not taken over"));
  EXPECT_THAT(febio_fault(four("<Boundary><bc type=\"rigid\" node_set=\"top\"/></Boundary>")), HasSubstr("of type \"rigid\""));
  EXPECT_THAT(febio_fault(four("<Boundary><bc type=\"zero displacement\" node_set=\"lower\"><x_dof>1</x_dof></bc></Boundary>")), HasSubstr("leg.feb:15:1: error: there is no node set \"lower\""));
  EXPECT_THAT(febio_fault(four("<Loads><surface_load type=\"pressure\" surface=\"lid\"><pressure type=\"math\">X*2</pressure></surface_load></Loads>")), HasSubstr("<pressure> is not one number"));
  EXPECT_THAT(febio_fault(four("<Loads><surface_load type=\"pressure\" surface=\"lid\"><pressure lc=\"9\">1</pressure></surface_load></Loads>")), HasSubstr("there is no load curve 9"));
  EXPECT_THAT(febio_fault(four("", "<Elements type=\"quad4\" name=\"brick\"><elem id=\"1\">1,2,3,4</elem></Elements>")), HasSubstr("elements of type quad4 are not taken over"));
  EXPECT_THAT(febio_fault(four("", "<Elements type=\"hex8\" name=\"other\"><elem id=\"1\">1,2,3,4,5,6,7,8</elem></Elements>")), HasSubstr("element 1 has no material"));
  std::string viscous = four("");
  viscous.replace(viscous.find("neo-Hookean"), 11, "viscoelastic");
  EXPECT_THAT(febio_fault(viscous), HasSubstr("the material \"muscle\" is of type \"viscoelastic\""));
}

}  // namespace
}  // namespace snug::mesh
