// Files of Ansys as it and its users write them.
#include <gtest/gtest.h>

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

// A bar of 2 x 1 x 3 cm of two tetrahedral pyramids' worth of nodes: a box of eight corners.
const std::string box_nodes = "n,1,0,0,0\nn,2,2,0,0\nn,3,2,1,0\nn,4,0,1,0\nn,5,0,0,3\nn,6,2,0,3\nn,7,2,1,3\nn,8,0,1,3\n";
const std::string elastic = "mp,ex,1,4.5\nmp,nuxy,1,0.2\n";

TEST(Apdl, ForcesAndSupportsActAlongTheAxesOfTheirNodes) {
  // THXY = 30: FX of 2 is (2 cos 30, 2 sin 30, 0); THYZ = 90 turns y to z: UY holds z; held along all three axes with 0 or with values
  // the node is held in the global ones; an axis that is oblique is held as such, of turns it is refused.
  const std::string head = "et,1,solid185\n" + elastic + box_nodes + "e,1,2,3,4,5,6,7,8\n";
  const Model turned = apdl(head + "n,7,2,1,3,30\nf,7,fx,2\nn,6,2,0,3,0,90\nd,6,uy,0.25\nn,2,2,0,0,90\nd,2,ux,0.1\nd,2,uy,0.2\nd,2,uz,0.3\nnlgeom,on\n");
  ASSERT_EQ(turned.forces.size(), 2u);
  EXPECT_NEAR(turned.forces[0].value, 2.0 * std::cos(std::numbers::pi / 6), 1e-14);
  EXPECT_NEAR(turned.forces[1].value, 1.0, 1e-14);
  EXPECT_EQ(turned.forces[1].component, 1);
  std::map<std::pair<int, int>, double> held;
  for (const ModelSupport& s : turned.supports) held[{s.node, s.component}] = s.value;
  ASSERT_EQ(held.size(), 4u);
  EXPECT_NEAR((held[{6, 2}]), 0.25, 1e-15);
  EXPECT_NEAR((held[{2, 0}]), -0.2, 1e-15);  // its y axis points to -x
  EXPECT_NEAR((held[{2, 1}]), 0.1, 1e-15);
  EXPECT_NEAR((held[{2, 2}]), 0.3, 1e-15);
  const Model oblique = apdl(head + "n,7,2,1,3,30\nd,7,ux,0.4\n");
  ASSERT_EQ(oblique.oblique_supports.size(), 1u);
  EXPECT_TRUE(oblique.supports.empty());
  EXPECT_NEAR((oblique.oblique_supports[0].direction - Eigen::Vector3d(std::cos(std::numbers::pi / 6), 0.5, 0)).norm(), 0.0, 1e-15);
  EXPECT_EQ(oblique.oblique_supports[0].value, 0.4);
  EXPECT_NE(fault(apdl, head + "n,7,2,1,3,30\nd,7,rotx,0\n").find("the turn of node 7 is held about an axis of its own"), std::string::npos);
  EXPECT_EQ(fault(apdl, head + "n,7,2,1,3,30\nd,7,uz,0\nd,6,ux,0\n"), "");  // z is z still; nothing acts in the turned plane
  // The same in a block, in the columns behind the place.
  const std::string block = "et,1,185\n" + elastic +
                            "NBLOCK,6,SOLID,8,8\n(3i5,6e10.3)\n"
                            "    1    0    0 0.000E+00 0.000E+00 0.000E+00\n    2    0    0 2.000E+00 0.000E+00 0.000E+00\n"
                            "    3    0    0 2.000E+00 1.000E+00 0.000E+00\n    4    0    0 0.000E+00 1.000E+00 0.000E+00\n"
                            "    5    0    0 0.000E+00 0.000E+00 3.000E+00\n    6    0    0 2.000E+00 0.000E+00 3.000E+00\n"
                            "    7    0    0 2.000E+00 1.000E+00 3.000E+00-4.500E+01\n    8    0    0 0.000E+00 1.000E+00 3.000E+00\nN,R5.3,LOC,-1,\n"
                            "en,1,1,2,3,4,5,6,7,8\nf,7,fy,1\n";
  const Model blocked = apdl(block);
  ASSERT_EQ(blocked.forces.size(), 2u);
  EXPECT_NEAR(blocked.forces[0].value, std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(blocked.forces[1].value, std::sqrt(0.5), 1e-14);
}

TEST(Apdl, NodesInCylindricalCoordinatesAreConverted) {
  // csys,1: radius, angle in degrees, height; nsel,loc,x is the radius there.
  const Model model = apdl("et,1,285\n" + elastic + "csys,1\nn,1,2,90,0\nn,2,3,180,1\nn,3,2,0,0\nn,4,1,45,5\ne,3,1,2,4\nnsel,s,loc,x,2\nd,all,ux,0\nnlgeom,on\n");
  EXPECT_NEAR((model.nodes[0].at - Eigen::Vector3d(0, 2, 0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((model.nodes[1].at - Eigen::Vector3d(-3, 0, 1)).norm(), 0.0, 1e-15);
  ASSERT_EQ(model.supports.size(), 2u);
  EXPECT_EQ(model.supports[1].node, 3);
}

TEST(Apdl, ATableInTheTemperatureIsOneValueOrRefused) {
  // MPDATA over several lines, of which the last used to count: alike they are one value, unlike they are refused, also in one line.
  const std::string head = "et,1,185\nmp,prxy,1,0.2\n" + box_nodes + "e,1,2,3,4,5,6,7,8\nnlgeom,on\nf,7,fx,1\n";
  const Model same = apdl(head + "MPTEMP,R5.0,2,1,0.0,50.0\nMPDATA,R5.0, 2,EX  , 1, 1, 7.5, 7.5,\nMPDATA,R5.0, 1,EX  , 1, 3, 7.5,\n");
  EXPECT_EQ(same.materials[0].constants[0], 7.5);
  for (const char* lines : {"MPDATA,R5.0,1,EX,1,1,7.5,\nMPDATA,R5.0,1,EX,1,2,9.0,\n", "mpdata,ex,1,1,7.5,9.0\n", "mp,ex,1,7.5,0.01\n"})
    EXPECT_NE(fault(apdl, head + lines).find("EX depends on the temperature"), std::string::npos) << lines;
  EXPECT_EQ(apdl(head + "mpdata,ex,1,1,9.0\nmpdata,ex,1,1,7.5\n").materials[0].constants[0], 7.5);  // begins anew
  EXPECT_NE(fault(apdl, head + "tb,hype,2,2,1,neo\nmp,ex,1,1\n").find("depends on the temperature"), std::string::npos);
}

TEST(Apdl, AForceGivenAgainTakesThePlaceOfTheFirst) {
  const Model model = apdl("et,1,185\n" + elastic + box_nodes + "e,1,2,3,4,5,6,7,8\nf,7,fx,1\nf,7,fy,3\nf,7,fx,2\nsfe,1,6,pres,,4\nsfe,1,6,pres,,5\n");
  EXPECT_EQ(model.forces, (std::vector<ModelForce>{{7, 0, 2.0}, {7, 1, 3.0}}));
  ASSERT_EQ(model.pressures.size(), 1u);
  EXPECT_EQ(model.pressures[0].value, 5.0);
}

TEST(Apdl, WhatCdwriteWritesRoundTheModelIsPassedOver) {
  // Head and tail of a database file, in a form of its own; loads in it that are not zero are errors.
  const std::string head = "/COM,ANSYS RELEASE 2021\n/PREP7\n/NOPR\n*IF,_CDRDOFF,EQ,1,THEN     !if solid model was read in\n_CDRDOFF=             !reset flag\nTHIS,IS,NOT,READ\n*ELSE\n"
                           "NUMOFF,NODE,      900\n*ENDIF\n*SET,_WB_UNIT,'MKS     '\n*SET,_RETURN ,  0.000000000000    \nDOF,DELETE\nTOFFST,  273.15\n";
  const std::string tail = "EXTOPT,ATTR,      0,      0,      0\nBFUNIF,TEMP,_TINY\nTREF,  0.0\nACEL,  0.0    ,  0.0    ,  0.0\nOMEGA,  0.0,0.0,0.0\nCGLOC,0,0,0\nERESX,DEFA\n"
                           "NCNV,     1,  0.0    ,     0,  0.0    ,  0.0\nNEQIT,     0\nCRPLIM,  0.100000000    ,   0\n/GO\nFINISH\n";
  const std::string model = "ET,1,186\n" + elastic + box_nodes + "EN,R5.5,ATTR,20,1,1,1,1,0,3,0,0,0\nEN,R5.5,NODE,1,1,2,3,4,5,6,7,8\nEN,R5.5,ATTR,-1\n";
  const Model read = apdl(head + model + tail);
  ASSERT_EQ(read.elements.size(), 1u);
  EXPECT_EQ(read.elements[0].number, 3);
  EXPECT_NE(fault(apdl, head + model + "ACEL,0,0,9810\n").find("an acceleration acts"), std::string::npos);
  EXPECT_NE(fault(apdl, head + model + "IRLF,1\n").find("its inertia balances the loads"), std::string::npos);
  EXPECT_NE(fault(apdl, head + model + "mp,alpx,1,1e-5\ntunif,40\n").find("expands"), std::string::npos);
}

TEST(Apdl, ControlsOfOtherAnalysesAndOfTheSolverSayNothingAboutTheModel) {
  // CDWRITE writes those of modes, harmonics, buckling and steps with the model; what adds stiffness or load to it, or takes elements away, is still refused.
  const std::string model = "ET,1,185\n" + elastic + box_nodes + "E,1,2,3,4,5,6,7,8\n";
  const std::string controls = "MODOPT,LANB,10,0.0,0.0,0,OFF\nMODCONTROL,ON\nMXPAND,10,0,0,NO\nHROPT,AUTO\nHARFRQ,0.0,50.0\nBUCOPT,LANB,1\nMDAMP,1,0.02\nDMPSTR,0.01\nARCLEN,OFF\n"
                               "ARCTRM,OFF\nCUTCONTROL,PLSLIMIT,0.15\nMSAVE,OFF\nDDOPTION,AUTO\nMIDTOL,OFF\nTRNOPT,FULL\nEQSLV,SPARSE\nLUMPM,0\nPSTRES,0\nRESCONTROL,DEFINE,NONE\n"
                               "AUTOTS,ON\nNCNV,1\nOUTRES,ALL,ALL\nOUTPR,NSOL,LAST\nKBC,0\nDELTIM,0.1\nTIME,1.0\nNROPT,FULL\nCNVTOL,F,1\nNEQIT,25\nIRLF,0\n";
  EXPECT_EQ(fault(apdl, model + controls), "");
  EXPECT_EQ(apdl(model + controls).elements.size(), 1u);
  for (const char* line : {"EKILL,1\n", "CE,1,0,1,UX,1,2,UX,-1\n", "CP,1,UX,1,2\n", "CEINTF,0.25\n", "INISTATE,DEFINE,1,,,,100\n", "LVSCALE,2.0\n", "ARCTRM,U,0.01,3,UX\n"})
    EXPECT_NE(fault(apdl, model + line), "") << line;
}

TEST(Apdl, WedgesPyramidsAndTetrahedraOfCollapsedHexahedraAreTaken) {
  // A box of 2 x 1 x 3 cm with a roof: hexahedron 1 and pyramid 2 on it, wedge 3 beside, in SOLID185; by hand the
  // volumes are box 6, pyramid 2*1*1.5/3 = 1, wedge 3*1/2*2 = 3 cm3. Pressures on the wedge's slope and the pyramid's base count as there.
  const std::string text = "et,1,185\n" + elastic + box_nodes + "n,9,1,0.5,4.5\nn,10,0,2,0\nn,11,2,2,0\n"
                           "e,1,2,3,4,5,6,7,8\ne,5,6,7,8,9,9,9,9\ne,4,10,8,8,3,11,7,7\nsfe,3,3,pres,,0.5\nnlgeom,on\n";
  const Model model = apdl(text);
  EXPECT_EQ(model.elements[1].kind, ElementKind::pyramid5);
  EXPECT_EQ(model.elements[2].kind, ElementKind::wedge6);
  const BodyMesh body = body_of(model, in_centimetres());
  EXPECT_EQ(body.kind, CellKind::tet10);
  EXPECT_NEAR(volume_of(body), 10e-6, 1e-18);
  ASSERT_EQ(body.pressures.size(), 1u);
  EXPECT_EQ(body.pressures[0].facets.size(), 2u);  // face 3 of the wedge (nodes 10 8 7 11): the slope
  for (const auto& facet : body.pressures[0].facets)
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(body.nodes[facet[a]].y() - 0.01, (0.03 - body.nodes[facet[a]].z()) / 3.0, 1e-12);
  double area = 0.0;  // the skin is closed: its facets are those that one cell has
  for (const auto& facet : body.skin_facets) {
    const Eigen::Vector3d a = body.nodes[facet[0]], b = body.nodes[facet[1]], c = body.nodes[facet[2]];
    area += 0.5 * (b - a).cross(c - a).norm();
  }
  const double slope = std::sqrt(10.0), roof = 2 * 0.5 * 2 * std::sqrt(1.5 * 1.5 + 0.25) + 2 * 0.5 * 1 * std::sqrt(1.5 * 1.5 + 1.0);
  EXPECT_NEAR(area * 1e4, 2 * 1 + 2 * 1 + 2 * 3 + 2 * (3 * 1) + 2 * (0.5 * 3) + 2 * slope + roof, 1e-9);
}

TEST(Apdl, QuadraticWedgesAndMiddlesLeftOut) {
  // SOLID186 as a wedge with its middles, one of which stands out: the volume follows it. SOLID187 without middles is straight.
  const std::string nodes = "n,1,0,0,0\nn,2,1,0,0\nn,3,0,1,0\nn,4,0,0,2\nn,5,1,0,2\nn,6,0,1,2\nn,7,.5,0,0\nn,8,.5,.5,0\nn,9,0,.5,0\nn,10,.5,0,2\nn,11,.5,.5,2\n"
                            "n,12,0,.5,2\nn,13,0,0,1\nn,14,1.1,0,1\nn,15,0,1,1\n";
  const Model wedge = apdl("et,1,186\n" + elastic + nodes + "e,1,2,3,3,4,5,6,6\nemore,7,8,3,9,10,11,6,12\nemore,13,14,15,15\n");
  ASSERT_EQ(wedge.elements[0].kind, ElementKind::wedge15);
  EXPECT_EQ(wedge.elements[0].nodes, (std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}));
  const double volume = volume_of(body_of(wedge, in_centimetres())) * 1e6;
  EXPECT_GT(volume, 1.0 + 0.1 / 3.0 - 0.02);  // an edge that bulges by 0.1 over a height of 2, mean 2/3 of it
  EXPECT_LT(volume, 1.1);
  const Model straight = apdl("et,1,187\n" + elastic + nodes + "e,1,2,3,4,0,0,0,0\nemore,0,0\ne,2,3,4,5,8,0,0,0\nemore,0,0\n");
  EXPECT_EQ(straight.elements[0].kind, ElementKind::tet4);
  EXPECT_EQ(straight.elements[1].kind, ElementKind::tet10);
  EXPECT_NEAR(volume_of(body_of(straight, in_centimetres())) * 1e6, 1.0 / 3 + 1.0 / 3, 1e-12);
  std::ostringstream written;
  write_calculix(written, straight);
  EXPECT_EQ(inp(written.str()).elements[1].nodes.back(), 20);  // five middles made on the way: 16 to 20
}

TEST(Apdl, PressuresOnSurfaceElementsActOnTheSolidBelow) {
  // SURF154 on the top of the box, turned outwards and inwards: a pressure pushes into the solid, or pulls.
  const std::string head = "et,1,185\net,2,154\nkeyopt,2,4,1\n" + elastic + box_nodes + "type,1\ne,1,2,3,4,5,6,7,8\ntype,2\n";
  const Model out = apdl(head + "e,5,6,7,8\nsfe,2,1,pres,,0.3\n"), in = apdl(head + "e,5,8,7,6\nsfe,2,1,pres,,0.3\n");
  EXPECT_EQ(out.elements.size(), 1u);
  EXPECT_EQ(out.pressures, (std::vector<ModelPressure>{{1, 1, 0.3}}));
  EXPECT_EQ(in.pressures, (std::vector<ModelPressure>{{1, 1, -0.3}}));
  EXPECT_NE(fault(apdl, head + "e,1,2,7,8\nsfe,2,1,pres,,0.3\n").find("lies on no face"), std::string::npos);
  EXPECT_NE(fault(apdl, head + "keyopt,2,2,1\ne,5,6,7,8\n").find("key option 2 of SURF154"), std::string::npos);
}

TEST(Apdl, ParametersLoopsAndConditionsAreEvaluated) {
  // Expressions follow the usual order; -2**2 is -4; sin takes radians. Nothing else runs.
  const std::map<std::string, double> names = {{"R", 2.0}, {"N_1", 3.0}};
  EXPECT_DOUBLE_EQ(*apdl_value("r*(n_1+1)**2/4 - 1e-1", names), 7.9);
  EXPECT_DOUBLE_EQ(*apdl_value("-2**2", names), -4.0);
  EXPECT_DOUBLE_EQ(*apdl_value("2*sin(0.5)+abs(-r)", names), 2 * std::sin(0.5) + 2);
  EXPECT_FALSE(apdl_value("q+1", names));
  EXPECT_FALSE(apdl_value("1/0", names));
  EXPECT_FALSE(apdl_value(std::string(500, '(') + "1", names));
  const Model model = apdl("rad=2\nlayers=2\net,1,solid185\n*set,e0,4.5\nmp,ex,1,e0\nmp,nuxy,1,1/5\n*do,k,0,layers\n*do,j,0,1\nn,1+4*k+2*j,0,j*rad,k*1.5\nn,2+4*k+2*j,rad,j*rad,k*1.5\n*enddo\n*enddo\n"
                           "*do,k,1,layers\n*if,k,eq,1,then\ne,1,2,4,3,5,6,8,7\n*else\ne,5,6,8,7,9,10,12,11\n*endif\n*enddo\n*do,k,3,1\ncut,off\n*enddo\nf,12,fz,rad/8\n");
  ASSERT_EQ(model.nodes.size(), 12u);
  EXPECT_EQ(model.nodes[11].at, Eigen::Vector3d(2, 2, 3));
  EXPECT_EQ(model.elements.size(), 2u);
  EXPECT_EQ(model.forces[0].value, 0.25);
  EXPECT_NEAR(volume_of(body_of(model, in_centimetres())), 12e-6, 1e-17);
  const std::string wrong = fault(apdl, "*get,h,node,1,loc,z\nn,1,h,0,0\n*do,i,1,1e9\nx=i\n*enddo\n*if,1,eq,1,then\n*create,file\n");
  for (const char* part : {"part.cdb:2:5: error: \"h\" is no number", "more than a million turns", "this condition has no end", "\"*create\" is not read"})
    EXPECT_NE(wrong.find(part), std::string::npos) << part << "\n" << wrong;
}

TEST(Apdl, AllErrorsOfAFileAreTold) {
  std::string text;
  for (int i = 0; i < 60; ++i) text += "nonsense" + std::to_string(i) + ",1\n";
  const std::string told = fault(apdl, text);
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 59) << told;
}

const char* const block = "ET,1,285\nN,1,0,0,0\nN,2,4,0,0\nN,3,0,4,0\nN,4,0,0,4\n";

TEST(Apdl, ElasticTablesAndPolynomialsOfOneTermAreRead) {
  const ModelMaterial elastic = apdl(block + std::string("TB,ELAS,1,1,2,ISOT\nTBDATA,1,0.07,0.41\nE,1,2,3,4\nD,1,ALL\n")).materials.at(0);
  EXPECT_EQ(elastic.law, ModelLaw::elastic);
  EXPECT_EQ(elastic.constants, (std::vector<double>{0.07, 0.41}));
  const ModelMaterial polynomial = apdl(block + std::string("TB,HYPER,1,1,1,POLY\nTBDATA,1,0.02,0.005,0.1\nE,1,2,3,4\nD,1,ALL\n")).materials.at(0);
  EXPECT_EQ(polynomial.law, ModelLaw::mooney_rivlin);
  EXPECT_EQ(polynomial.constants, (std::vector<double>{0.02, 0.005, 20.0}));
}

TEST(Apdl, AShearModulusOfItsOwnMakesAMaterialOrthotropic) {
  // That of an isotropic one is E/(2 (1 + nu)); another one used to be passed over.
  const std::string text = block + std::string("MP,EX,1,0.06\nMP,PRXY,1,0.2\nMP,GXY,1,");
  EXPECT_EQ(fault(apdl, text + "0.025\nE,1,2,3,4\nD,1,ALL\n"), "");
  EXPECT_NE(fault(apdl, text + "0.01\nE,1,2,3,4\nD,1,ALL\n").find("GXY of material 1 is 0.01, and E/(2 (1 + nu)) is 0.025"), std::string::npos);
}

TEST(Apdl, LocalSystemsOfCdwriteSayNothingAndAMarkBeforeTheTextNeither) {
  const std::string text = "\xEF\xBB\xBF/PREP7\nLOCAL,R5.0,LOC, 11,1,  0.0, 0.0, 0.0\nLOCAL,R5.0,ANG, 11,1,  0.0, 0.0, 0.0\nCSCIR,11,0,0\n" + std::string(block) + "MP,EX,1,1\nE,1,2,3,4\nD,1,ALL\n";
  const auto file = std::filesystem::temp_directory_path() / ("snug-mark-" + std::to_string(::getpid()) + ".cdb");
  std::ofstream(file) << text;
  EXPECT_EQ(read_model(file).elements.size(), 1u);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace snug::mesh
