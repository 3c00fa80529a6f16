// Files of Abaqus and CalculiX as these and their users write them, and forces on faces of linear and quadratic cells.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "mesh/body/foreign.hpp"
#include "mesh/formats/apdl_script.hpp"
#include "mesh/formats/model.hpp"
#include "solver/fem/element.hpp"
#include "tests/unit/mesh/foreign_texts.hpp"

namespace snug::mesh {
namespace {

const std::string inp_nodes = "*NODE, NSET=ALL\n1,0,0,0\n2,2,0,0\n3,2,1,0\n4,0,1,0\n5,0,0,3\n6,2,0,3\n7,2,1,3\n8,0,1,3\n";
const std::string inp_rest = "*MATERIAL, NAME=M\n*ELASTIC\n4.5, 0.2\n*SOLID SECTION, ELSET=E, MATERIAL=M\n";

TEST(Calculix, NodesInCylindricalCoordinatesAndFramesOfNodes) {
  // SYSTEM=C gives radius, angle, height. *TRANSFORM: CLOAD 1 acts outwards from the axis, or along the local x.
  const Model polar = inp("*NODE, SYSTEM=C\n1,2,0,0\n2,2,90,0\n3,2,180,0\n4,2,45,7\n*NSET, NSET=W\n2\n*NSET,NSET=T\n4\n*TRANSFORM, NSET=W, TYPE=C\n0,0,0, 0,0,1\n*TRANSFORM, NSET=T, TYPE=R\n0,1,0, -1,0,0\n"
                          "*ELEMENT, TYPE=C3D4H, ELSET=E\n1, 1,2,3,4\n" + inp_rest + "*STEP, NLGEOM\n*STATIC\n*CLOAD\n2,1,3.\n4,1,5.\n*END STEP\n");
  EXPECT_NEAR((polar.nodes[1].at - Eigen::Vector3d(0, 2, 0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((polar.nodes[3].at - Eigen::Vector3d(std::sqrt(2.0), std::sqrt(2.0), 7)).norm(), 0.0, 1e-15);
  EXPECT_EQ(polar.forces, (std::vector<ModelForce>{{2, 1, 3.0}, {4, 1, 5.0}}));
  EXPECT_TRUE(polar.remarks.empty());
  EXPECT_NE(fault(inp, "*NODE, SYSTEM=S\n1,2,0,0\n").find("in the system S"), std::string::npos);
}

TEST(Calculix, AStepOfSmallDisplacementsIsSaidToBeSolvedWithLargeOnes) {
  const std::string body = inp_nodes + "*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1,2,3,4,5,6,7,8\n" + inp_rest;
  ASSERT_EQ(inp(body + "*STEP\n*STATIC\n*END STEP\n").remarks.size(), 1u);
  EXPECT_NE(inp(body + "*STEP, NLGEOM=NO\n*STATIC\n*END STEP\n").remarks[0].found.find("small displacements"), std::string::npos);
  EXPECT_TRUE(inp(body + "*STEP, NLGEOM=YES\n*STATIC\n*END STEP\n").remarks.empty());
  EXPECT_TRUE(inp(body).remarks.empty());  // a mesh without a step
}

TEST(ForeignBody, ForcesOfALinearFaceAreTheTractionThatTheyStandFor) {
  // A box of two 8-node hexahedra side by side, uniform traction on its top as 1/4 of a face a corner: on the 9-node facets 1/36, 1/9
  // and 4/9. The same box of six tetrahedra (1/3 a corner): nothing at corners, 1/3 at mid-edges. A linear traction keeps its moment.
  const std::string nodes = "*NODE\n1,0,0,0\n2,2,0,0\n3,5,0,0\n4,0,1,0\n5,2,1,0\n6,5,1,0\n7,0,0,3\n8,2,0,3\n9,5,0,3\n10,0,1,3\n11,2,1,3\n12,5,1,3\n";
  const std::string hexahedra = nodes + "*ELEMENT, TYPE=C3D8RH, ELSET=E\n1, 1,2,5,4,7,8,11,10\n2, 2,3,6,5,8,9,12,11\n" + inp_rest;
  const std::string uniform = "*STEP, NLGEOM\n*STATIC\n*CLOAD\n7,3,.5\n10,3,.5\n8,3,1.25\n11,3,1.25\n9,3,.75\n12,3,.75\n*END STEP\n";
  const BodyMesh body = body_of(inp(hexahedra + uniform), in_centimetres());
  EXPECT_NEAR((resultant(body) - Eigen::Vector3d(0, 0, 5)).norm(), 0.0, 1e-12);
  std::map<int, double> at;
  for (const NodalForce& force : body.forces) at[body.node_numbers[force.node]] = force.force.z();
  EXPECT_EQ(at.size(), 15u);
  EXPECT_NEAR(at[7], 2.0 / 36, 1e-12);
  EXPECT_NEAR(at[8], 5.0 / 36, 1e-12);
  EXPECT_NEAR(at[12], 3.0 / 36, 1e-12);
  double most = 0.0;
  for (const auto& [node, force] : at) most = std::max(most, force);
  EXPECT_NEAR(most, 3.0 * 4 / 9, 1e-12);
  input::BodySpec linear = in_centimetres();
  linear.elements = input::Elements::Q1P0;
  EXPECT_NEAR(body_of(inp(hexahedra + uniform), linear).forces[0].force.z(), 0.5, 1e-15);

  // t = 1 + x: f_a = int N_a t; over the edge of length L with ends p, q: L (2 p + q)/6.
  const auto end = [](double L, double p, double q) { return 0.5 * L * (2 * p + q) / 6; };
  std::ostringstream load;
  load.precision(17);
  const double f7 = end(2, 1, 3), f8 = end(2, 3, 1) + end(3, 3, 6), f9 = end(3, 6, 3);
  load << "*STEP, NLGEOM\n*STATIC\n*CLOAD\n7,3," << f7 << "\n10,3," << f7 << "\n8,3," << f8 << "\n11,3," << f8 << "\n9,3," << f9 << "\n12,3," << f9 << "\n*END STEP\n";
  const BodyMesh sloping = body_of(inp(hexahedra + load.str()), in_centimetres());
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const NodalForce& force : sloping.forces) moment += sloping.nodes[force.node].cross(force.force);
  EXPECT_NEAR(resultant(sloping).z(), 5 + 12.5, 1e-12);
  EXPECT_NEAR(moment.y(), -1e-2 * (12.5 + 125.0 / 3), 1e-12);  // int x (1 + x) over 0..5
}

TEST(ForeignBody, ForcesOnLinearTetrahedraActAtTheMiddlesOfTheirEdges) {
  const std::string text = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT, TYPE=C3D4, ELSET=E\n1, 1,2,3,4\n" + inp_rest +
                           "*STEP, NLGEOM\n*STATIC\n*CLOAD\n1,3,-2.\n2,3,-2.\n3,3,-2.\n*END STEP\n";
  const BodyMesh body = body_of(inp(text), in_centimetres());
  for (const NodalForce& force : body.forces) EXPECT_NEAR(force.force.z(), body.node_numbers[force.node] < 4 ? 0.0 : -2.0, 1e-14);
  EXPECT_NEAR(resultant(body).z(), -6.0, 1e-14);
  // A force at one node is one.
  std::string point = text;
  point.erase(point.find("1,3,-2."), 16);
  ASSERT_EQ(body_of(inp(point), in_centimetres()).forces.size(), 1u);
}

TEST(ForeignBody, ForcesOfTwentyNodeFacesBelongToTheirShapes) {
  // Uniform traction on a 20-node cell: -1/12 at corners, 1/3 at mid-edges (Zienkiewicz & Taylor); on the 27-node cell 1/36, 1/9, 4/9.
  std::ostringstream text;
  text << "*NODE\n1,0,0,0\n2,2,0,0\n3,2,2,0\n4,0,2,0\n5,0,0,2\n6,2,0,2\n7,2,2,2\n8,0,2,2\n9,1,0,0\n10,2,1,0\n11,1,2,0\n12,0,1,0\n13,1,0,2\n14,2,1,2\n15,1,2,2\n16,0,1,2\n"
          "17,0,0,1\n18,2,0,1\n19,2,2,1\n20,0,2,1\n*ELEMENT, TYPE=C3D20RH, ELSET=E\n1, 1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,\n16,17,18,19,20\n"
       << inp_rest << "*STEP, NLGEOM\n*STATIC\n*CLOAD\n5,1,-1\n6,1,-1\n7,1,-1\n8,1,-1\n13,1,4\n14,1,4\n15,1,4\n16,1,4\n*END STEP\n";
  const BodyMesh body = body_of(inp(text.str()), in_centimetres());
  ASSERT_EQ(body.forces.size(), 9u);
  std::map<int, double> at;
  for (const NodalForce& force : body.forces) at[body.node_numbers[force.node]] = force.force.x();
  EXPECT_NEAR(at[5], 12.0 / 36, 1e-12);
  EXPECT_NEAR(at[14], 12.0 / 9, 1e-12);
  EXPECT_NEAR(resultant(body).x(), 12.0, 1e-12);
}

TEST(Calculix, PartsSurfacesNamedSupportsAndQuotedNames) {
  // The form of a job file: one part and instance, sets of the assembly, a pressure on a surface, supports by name, an amplitude that
  // ends at one half, a keyword over two lines.
  const std::string text = "*Part, name=Leg\n" + inp_nodes +
                           "*Element, type=C3D8IH\n1, 1,2,3,4,5,6,7,8\n*Elset, elset=\"All cells\", generate\n1,1,1\n*Solid Section, elset=\"All cells\",\nmaterial=\"Soft one\"\n,\n*End Part\n"
                           "*Assembly, name=A\n*Instance, name=Leg-1, part=Leg\n0., 0., 10.\n*End Instance\n*Nset, nset=low, instance=Leg-1\n1,2,3,4\n*Elset, elset=_S_S2, internal, instance=Leg-1\n1\n"
                           "*Surface, type=ELEMENT, name=S\n_S_S2, S2\n*End Assembly\n*Amplitude, name=half\n0., 0., 2., 1.\n*Material, name=\"Soft one\"\n*Hyperelastic, yeoh\n5., 1., 0.1, 0.02, 0., 0.\n"
                           "*Step, nlgeom=YES\n*Static\n0.1, 1., 1e-5, 1.\n*Boundary\nlow, ENCASTRE\nLeg-1.8, YSYMM\n*Dsload, amplitude=half\nS, P, 0.5\n*End Step\n";
  std::string numbered = text;
  numbered.replace(numbered.find("Leg-1.8"), 7, "8");
  const Model model = inp(numbered);
  EXPECT_EQ(model.nodes[0].at.z(), 10.0);
  EXPECT_EQ(model.materials[0].law, ModelLaw::yeoh);
  EXPECT_EQ(model.materials[0].constants, (std::vector<double>{5, 1, 0.1, 100}));
  EXPECT_EQ(model.pressures, (std::vector<ModelPressure>{{1, 1, 0.25}}));
  EXPECT_EQ(std::count_if(model.supports.begin(), model.supports.end(), [](const auto& s) { return s.node < 5; }), 24);
  EXPECT_EQ(std::count(model.supports.begin(), model.supports.end(), ModelSupport{8, 1, 0.0}), 1);
  EXPECT_NE(fault(inp, text + "*PART, NAME=Q\n").find("second part"), std::string::npos);
}

TEST(Calculix, OfSeveralStepsTheEndOfTheLastIsTaken) {
  // What a later step sets again takes the place of the earlier value, what it does not name stays (OP=MOD), OP=NEW begins anew.
  const std::string body = inp_nodes + "*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1,2,3,4,5,6,7,8\n" + inp_rest + "*BOUNDARY\n1,1,3\n2,2,3\n4,3,3\n";
  const std::string first = "*STEP, NLGEOM\n*STATIC\n*CLOAD\n7,1,1.\n7,1,0.5\n8,2,2.\n*DLOAD\n1,P2,0.3\n*END STEP\n";
  const Model both = inp(body + first + "*STEP\n*STATIC\n*CLOAD\n8,2,5.\n*DLOAD\n1,P2,0.4\n*BOUNDARY\n1,3,3,0.1\n*END STEP\n");
  EXPECT_EQ(both.forces, (std::vector<ModelForce>{{7, 0, 1.0}, {7, 0, 0.5}, {8, 1, 5.0}}));  // within a step forces add up
  EXPECT_EQ(both.pressures, (std::vector<ModelPressure>{{1, 1, 0.4}}));
  ASSERT_EQ(both.remarks.size(), 1u);
  EXPECT_NE(both.remarks[0].found.find("there are 2 steps"), std::string::npos);
  const Model anew = inp(body + first + "*STEP\n*STATIC\n*CLOAD, OP=NEW\n6,3,1.\n*END STEP\n");
  EXPECT_EQ(anew.forces, (std::vector<ModelForce>{{6, 2, 1.0}}));
  EXPECT_EQ(anew.pressures.size(), 1u);
  EXPECT_NE(fault(inp, body + first + "*STEP\n*STATIC\n*BOUNDARY, FIXED\n7,1,3\n*END STEP\n").find("the parameter FIXED is not taken over"), std::string::npos);
  const BodyMesh moved = body_of(both, in_centimetres());
  EXPECT_EQ(std::count_if(moved.held.begin(), moved.held.end(), [](const auto& h) { return h.displacement == 0.001; }), 1);
}

const char* const tetrahedron = "*NODE\n1,0,0,0\n2,4,0,0\n3,0,4,0\n4,0,0,4\n*ELEMENT, TYPE=C3D4, ELSET=E\n7, 1,2,3,4\n*SOLID SECTION, ELSET=E, MATERIAL=M\n*MATERIAL, NAME=M\n";

TEST(Calculix, WeightActsOnTheDensityOfItsSet) {
  // GRAV with a direction of any length, half of it by its amplitude: 0.002 * 6 * 980/2 in the file's units downwards, through the middle of the box, of which a
  // Q2 cell takes 8/27 at its centre. The acceleration set again in a later step counts; without a density, without a direction and on shells it is refused.
  const std::string body = inp_nodes + "*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1,2,3,4,5,6,7,8\n" + inp_rest;
  const std::string dense = body + "*AMPLITUDE, NAME=half\n0., 0., 2., 1.\n*MATERIAL, NAME=D\n*ELASTIC\n4.5, 0.2\n*DENSITY\n0.002\n*SOLID SECTION, ELSET=E, MATERIAL=D\n*BOUNDARY\n1,1,3\n2,2,3\n4,3,3\n";
  const std::string step = "*STEP, NLGEOM\n*STATIC\n*DLOAD, AMPLITUDE=half\nE, GRAV, 980., 0., 0., -2.\n*END STEP\n";
  const Model model = inp(dense + step);
  EXPECT_EQ(model.weights, (std::vector<ModelWeight>{{1, {0.0, 0.0, -490.0}}}));
  const input::BodySpec spec = in_centimetres();
  const BodyMesh made = body_of(model, spec);
  const double weight = 0.002 * 6 * 490 * spec.force_unit;
  EXPECT_NEAR((resultant(made) - Eigen::Vector3d(0, 0, -weight)).norm(), 0.0, 1e-12 * weight);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double largest_share = 0.0;
  for (const NodalForce& force : made.forces) moment += made.nodes[force.node].cross(force.force), largest_share = std::max(largest_share, -force.force.z() / weight);
  EXPECT_NEAR((moment - Eigen::Vector3d(0.01, 0.005, 0.015).cross(Eigen::Vector3d(0, 0, -weight))).norm(), 0.0, 1e-14 * weight);
  EXPECT_NEAR(largest_share, 8.0 / 27.0, 1e-12);
  EXPECT_EQ(inp(dense + step + "*STEP\n*STATIC\n*DLOAD\n1, GRAV, 100., 0., 0., -1.\n1, GRAV, 7., 1., 0., 0.\n*END STEP\n").weights,
            (std::vector<ModelWeight>{{1, {0.0, 0.0, -100.0}}, {1, {7.0, 0.0, 0.0}}}));
  EXPECT_TRUE(inp(dense + step + "*STEP\n*STATIC\n*DLOAD, OP=NEW\n1, P2, 1.\n*END STEP\n").weights.empty());
  EXPECT_NE(fault(inp, body + "*STEP, NLGEOM\n*STATIC\n*DLOAD\nE, GRAV, 980., 0., 0., -1.\n*END STEP\n").find("its material \"M\" has no density"), std::string::npos);
  EXPECT_NE(fault(inp, dense + "*STEP, NLGEOM\n*STATIC\n*DLOAD\nE, GRAV, 980.\n*END STEP\n").find("the weight has no direction"), std::string::npos);
  const std::string shell = inp_nodes + "*ELEMENT, TYPE=S4, ELSET=E\n1, 1,2,3,4\n*MATERIAL, NAME=M\n*ELASTIC\n4.5, 0.2\n*DENSITY\n0.002\n*SHELL SECTION, ELSET=E, MATERIAL=M\n0.1\n";
  EXPECT_NE(fault(inp, shell + "*STEP, NLGEOM\n*STATIC\n*DLOAD\nE, GRAV, 980., 0., 0., -1.\n*END STEP\n").find("a shell, is not taken over"), std::string::npos);
}

TEST(Calculix, PolynomialsOfTheInvariantsAreTheLawsThatTheyAre) {
  // POLYNOMIAL of one term is Mooney-Rivlin's, and so is a law without a name; REDUCED POLYNOMIAL of one to three terms neo-Hooke's and Yeoh's.
  const auto law = [](const std::string& card) { return inp(tetrahedron + card + "*BOUNDARY\n1,1,3\n").materials.at(0); };
  for (const char* card : {"*HYPERELASTIC, POLYNOMIAL, N=1\n0.02,0.005,0.1\n", "*HYPERELASTIC, POLYNOMIAL\n0.02,0.005,0.1\n", "*HYPERELASTIC\n0.02,0.005,0.1\n"}) {
    EXPECT_EQ(law(card).law, ModelLaw::mooney_rivlin) << card;
    EXPECT_EQ(law(card).constants, (std::vector<double>{0.02, 0.005, 20.0})) << card;
  }
  EXPECT_EQ(law("*HYPERELASTIC, REDUCED POLYNOMIAL\n0.02,0.1\n").constants, (std::vector<double>{0.04, 20.0}));
  EXPECT_EQ(law("*HYPERELASTIC, REDUCED POLYNOMIAL, N=2\n0.02,0.003,0.1,0\n").constants, (std::vector<double>{0.02, 0.003, 0.0, 20.0}));
  EXPECT_EQ(law("*HYPERELASTIC, YEOH\n0.02,0.003,0.001,0.1\n").constants, (std::vector<double>{0.02, 0.003, 0.001, 20.0}));
  EXPECT_NE(fault(inp, tetrahedron + std::string("*HYPERELASTIC, POLYNOMIAL, N=2\n1,1,1,1,1,1,1\n")).find("part.inp:10:1"), std::string::npos);
}

TEST(Calculix, ArrudaBoyceIsTakenOverWithItsMuAndItsVolumeEnergy) {
  // mu, lambda_m, D: mu is no shear modulus, D is 2/kappa of kappa/4 (J^2 - 1 - 2 ln J). In N and cm 0.02 N/cm2 are 200 Pa.
  const Model model = inp(tetrahedron + std::string("*HYPERELASTIC, ARRUDA-BOYCE\n0.02, 2.5, 0.1\n*BOUNDARY\n1,1,3\n"));
  EXPECT_EQ(model.materials.at(0).law, ModelLaw::arruda_boyce);
  EXPECT_EQ(model.materials.at(0).constants, (std::vector<double>{0.02, 2.5, 20.0}));
  EXPECT_EQ(model.materials.at(0).volume, ModelVolume::barrier);
  const input::BodySpec spec = in_centimetres();
  const BodyMesh body = body_of(model, spec);
  const input::Table& law = body.layers.at(0).material.table;
  EXPECT_EQ(*law.find("law")->text(), "Arruda-Boyce");
  EXPECT_EQ(*law.find("mu")->text(), fmt::format("{:.17g} Pa", 0.02 * (spec.force_unit / (spec.unit * spec.unit))));
  EXPECT_EQ(*law.find("volumetric")->text(), "barrier");
  EXPECT_NE(fault(inp, tetrahedron + std::string("*HYPERELASTIC, ARRUDA-BOYCE\n0.02, 2.5\n")).find("incompressible"), std::string::npos);
}

TEST(Calculix, APressureWithoutAFaceIsOneOfShells) {
  // On a solid it used to act on its first face.
  const std::string text = tetrahedron + std::string("*ELASTIC\n1,0.3\n*STEP, NLGEOM\n*STATIC\n*DLOAD\nE, P, 0.01\n*END STEP\n");
  EXPECT_NE(fault(inp, text).find("part.inp:15:4: error: the pressure P acts along the normal of a shell, and element 7 is a solid"), std::string::npos) << fault(inp, text);
}

TEST(Calculix, WhatIsMissingBecauseACardIsNotReadIsNotReported) {
  // The nodes that *NGEN would make are no errors of their own.
  const std::string text = "*NODE\n1,0,0,0\n2,4,0,0\n*NGEN\n1,2,1\n*ELEMENT, TYPE=C3D4, ELSET=E\n7, 1,2,3,4\n*SOLID SECTION, ELSET=E, MATERIAL=M\n*MATERIAL, NAME=M\n*ELASTIC\n1,0.3\n";
  EXPECT_NE(fault(inp, text).find("part.inp:4:1: error: the card *NGEN"), std::string::npos) << fault(inp, text);
  EXPECT_EQ(fault(inp, text).find("node 3"), std::string::npos) << fault(inp, text);
}

TEST(Calculix, OgdenOfSeveralTermsGoesOn) {
  // Nine constants, eight a line; D2 and D3 must be 0.
  const std::string head = inp_nodes + "*ELEMENT, TYPE=C3D8R, ELSET=E\n1, 1,2,3,4,5,6,7,8\n*MATERIAL, NAME=M\n*HYPERELASTIC, OGDEN, N=3\n";
  const Model model = inp(head + "0.2, 2., 0.03, 6., 0.05, -1., 0.4, 0.\n0.\n*SOLID SECTION, ELSET=E, MATERIAL=M\n");
  const std::vector<double> due = {0.2, 2.0, 0.01, 6.0, -0.1, -1.0, 5.0};  // mu = 2 mu_inp/alpha, kappa = 2/D1
  ASSERT_EQ(model.materials[0].constants.size(), due.size());
  for (std::size_t c = 0; c < due.size(); ++c) EXPECT_NEAR(model.materials[0].constants[c], due[c], 1e-15);
  EXPECT_NE(fault(inp, head + "0.2, 2., 0.03, 6., 0.05, -1., 0.4, 0.7\n0.\n*SOLID SECTION, ELSET=E, MATERIAL=M\n").find("D2 is 0.7"), std::string::npos);
}

TEST(Calculix, ElementsThatMarkSurfacesGiveSetsOfNodes) {
  // A mesher's file: lines and triangles beside the solids, one set of them.
  const Model model = inp("*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT, TYPE=T3D2, ELSET=L\n1, 1,2\n*ELEMENT, TYPE=CPS3, ELSET=F\n2, 2,3,4\n*ELEMENT, TYPE=C3D4, ELSET=E\n3, 1,2,3,4\n"
                          "*ELSET, ELSET=outside\n2\n" + inp_rest);
  EXPECT_EQ(model.elements.size(), 1u);
  EXPECT_EQ(model.node_sets.at("OUTSIDE"), (std::vector<int>{2, 3, 4}));
  EXPECT_EQ(model.node_sets.at("L"), (std::vector<int>{1, 2}));
  EXPECT_NE(fault(inp, "*NODE\n1,0,0,0\n2,1,0,0\n*ELEMENT, TYPE=B31, ELSET=E\n1, 1,2\n" + inp_rest).find("type B31"), std::string::npos);
}

TEST(Calculix, IncludedFilesLieInTheFolderOfTheCase) {
  // A file of the folder below, which includes its neighbour; not one outside, not itself without end.
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("snug-include-" + std::to_string(::getpid()));
  fs::create_directories(folder / "case/parts");
  const auto write = [&](const char* name, const std::string& text) { std::ofstream(folder / name) << text; };
  write("case/main.inp", "*INCLUDE, INPUT=parts/mesh.msh\n" + inp_rest);
  write("case/parts/mesh.msh", "*INCLUDE, INPUT=nodes.inc\n*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1,2,3,4,5,6,7,8\n");
  write("case/parts/nodes.inc", inp_nodes + "x, 1\n");
  write("secret.inp", inp_nodes);
  write("case/out.inp", "*INCLUDE, INPUT=../secret.inp\n*INCLUDE, INPUT=" + (folder / "secret.inp").string() + "\n*INCLUDE, INPUT=none.inp\n");
  write("case/round.inp", "*INCLUDE, INPUT=round.inp\n");
  const std::string wrong = fault([&](const std::string& name) { return read_model(folder / name); }, "case/main.inp");
  EXPECT_NE(wrong.find("parts/nodes.inc:10:1: error: \"x\" is no"), std::string::npos) << wrong;
  write("case/parts/nodes.inc", inp_nodes);
  EXPECT_EQ(read_model(folder / "case/main.inp").nodes.size(), 8u);
  write("case/parts/xyz.txt", inp_nodes.substr(inp_nodes.find('\n') + 1));  // data lines alone, named by the card itself; a range over gaps
  write("case/data.inp", "*NODE, NSET=A, INPUT=parts/xyz.txt\n*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1,2,3,4,5,6,7,8\n*NSET, NSET=R, GENERATE\n5, 40, 1\n" + inp_rest);
  EXPECT_EQ(read_model(folder / "case/data.inp").node_sets.at("R"), (std::vector<int>{5, 6, 7, 8}));
  EXPECT_EQ(read_model(folder / "case/data.inp").node_sets.at("A").size(), 8u);
  const std::string outside = fault([&](const std::string& name) { return read_model(folder / name); }, "case/out.inp");
  EXPECT_EQ(outside.find("there twice"), std::string::npos);
  EXPECT_NE(outside.find("\"../secret.inp\" is included, which is outside"), std::string::npos) << outside;
  EXPECT_NE(outside.find("none.inp\" is included, which is not there"), std::string::npos) << outside;
  EXPECT_NE(fault([&](const std::string& name) { return read_model(folder / name); }, "case/round.inp").find("without end"), std::string::npos);
  EXPECT_NE(fault(inp, "*INCLUDE, INPUT=any.inp\n").find("put its lines here"), std::string::npos);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace snug::mesh
