// Inputs as users bring them: what is likely a slip is said, what cannot be is refused, what a file asks for and is done otherwise is told.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "tests/cases/program.hpp"

namespace snug {
namespace {

bool has(const Outcome& outcome, const std::string& part) { return outcome.text.find(part) != std::string::npos; }

TEST_F(Program, SlipsOfUnitsAreWarningsOrErrorsWithWhatWasPerhapsMeant) {
  // The cut of the shipped sleeve ten times too small or too large, its radius for its circumference; the girths of the table in the
  // unit of another; the case as it ships says nothing.
  ASSERT_EQ(snug("new mine --like tube-sleeve").status, 0);
  const Outcome right = snug("check mine");
  EXPECT_EQ(right.status, 0) << right.text;
  EXPECT_FALSE(has(right, "warning")) << right.text;
  const Outcome small = snug("check mine --set garment.pattern.flat_circumference='27 mm'");
  EXPECT_EQ(small.status, 2) << small.text;
  EXPECT_TRUE(has(small, "% smaller; mm written for cm, or a digit too few?")) << small.text;
  const Outcome large = snug("check mine --set garment.pattern.flat_circumference='2760 mm'");
  EXPECT_EQ(large.status, 2) << large.text;
  EXPECT_TRUE(has(large, "% larger; cm written for mm, or a digit too many?")) << large.text;
  const Outcome loose = snug("check mine --set garment.pattern.flat_circumference='950 mm'");
  EXPECT_EQ(loose.status, 0) << loose.text;
  EXPECT_TRUE(has(loose, "case.toml:") && has(loose, ": warning: ")) << loose.text;
}

TEST_F(Program, WhatIsSaidBeforeAnErrorIsOftenItsCause) {
  // Girths in cm under a head in mm: the garment is refused, and the girths are asked about before. A fabric whose sheet has a share for a percentage is asked
  // about, and so is cloth that the law of Laplace stretches beyond its data.
  ASSERT_EQ(snug("new mine --like tube-sleeve").status, 0);
  write("mine/body/tube.csv", "height [mm],girth [mm]\n0,25\n60,26\n");
  const Outcome small = snug("check mine");
  EXPECT_EQ(small.status, 2) << small.text;
  EXPECT_TRUE(has(small, "tube.csv:3:4: warning: girth is up to 0.026 m; is the unit [cm] instead of [mm]?")) << small.text;
  ASSERT_EQ(snug("new other --like tube-sleeve").status, 0);
  const std::string sheet = "{ law = \"kes\", LT = 0.8, WT = \"7 gf cm/cm2\", EMT = 0.35, G = \"0.5 gf/(cm degree)\" }";
  const Outcome share = snug("run other --tier L0 --no-report --set 'garment.fabric=" + sheet + "'");
  EXPECT_TRUE(has(share, "warning: the curve of the fabric ends at an elongation of 0.35 %") && has(share, "write \"35 %\"")) << share.text;
  EXPECT_TRUE(has(share, "beyond the 0.35 % up to which there are data")) << share.text;
}

/// A closed tube of 63 mm radius and 260 mm length along y as OBJ, in mm.
std::string scanned_tube_along_y() {
  constexpr int around = 48, along = 27;
  std::string text;
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / around;
      text += "v " + std::to_string(63.0 * std::cos(turn)) + " " + std::to_string(10.0 * j - 130.0) + " " + std::to_string(-63.0 * std::sin(turn)) + "\n";
    }
  text += "v 0 -130 0\nv 0 130 0\n";
  const auto node = [&](int i, int j) { return std::to_string(1 + j * around + i % around); };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j + 1 < along; ++j) text += "f " + node(i, j) + " " + node(i + 1, j) + " " + node(i + 1, j + 1) + " " + node(i, j + 1) + "\n";
    text += "f " + node(i + 1, 0) + " " + node(i, 0) + " " + std::to_string(around * along + 1) + "\n";
    text += "f " + node(i, along - 1) + " " + node(i + 1, along - 1) + " " + std::to_string(around * along + 2) + "\n";
  }
  return text;
}

TEST_F(Program, AScanWithYUpThatIsCutAlongIsWarnedAbout) {
  // Sections at heights along z are strips of a tube that lies along y; with up = "y" they are circles, and nothing is said.
  std::filesystem::create_directories(folder_ / "limb");
  write("limb/tube.obj", scanned_tube_along_y());
  const auto limb = [](const std::string& axes, const std::string& lower, const std::string& upper) {
    return "title = \"limb\"\n[body]\nkind = \"scan\"\ncells_around = 16\ncells_along = 4\nlayers = [{ name = \"bone\", material = \"rigid\" },\n"
           "{ name = \"tissue\", material = \"relaxed thigh\", cells = 2 }]\n[body.scan]\nsurface = \"tube.obj\"\nunit = \"1 mm\"\n" + axes +
           "lower = { point = " + lower + " }\nupper = { point = " + upper + " }\nbone = { girth = \"90 mm\" }\n[load]\nskin_pressure = \"1 kPa\"\n";
  };
  write("limb/case.toml", limb("up = \"z\"\nfront = \"y\"\n", "[\"0 mm\", \"0 mm\", \"-30 mm\"], normal = [0, 0, -1]", "[\"0 mm\", \"0 mm\", \"30 mm\"], normal = [0, 0, 1]"));
  const Outcome along = snug("check limb");
  EXPECT_TRUE(has(along, "warning: the sections of the scan are ")) << along.text;
  EXPECT_TRUE(has(along, "cut along instead of across? programs of clothes and animation write files with up = \"y\"")) << along.text;
  write("limb/case.toml", limb("up = \"y\"\nfront = \"-z\"\n", "[\"0 mm\", \"-60 mm\", \"0 mm\"], normal = [0, -1, 0]", "[\"0 mm\", \"60 mm\", \"0 mm\"], normal = [0, 1, 0]"));
  const Outcome across = snug("check limb");
  EXPECT_EQ(across.status, 0) << across.text;
  EXPECT_FALSE(has(across, "cut along")) << across.text;
}

TEST_F(Program, AFileThatIsNotThereIsNotSaidToBeOutside) {
  // With the case directory as the present one: names of files that do not exist used to be taken for places outside.
  write("case.toml", "title = \"here\"\n[body]\nkind = \"stations\"\nstations = \"calv.csv\"\n");
  const Outcome outcome = snug("check .");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(has(outcome, "there is no file \"calv.csv\"")) << outcome.text;
}

TEST_F(Program, ABodyWithoutASkinSaysSoWhereSomethingActsOnIt) {
  // A gmsh box whose surface is called "Hull": a pressure on the skin used to do nothing. "SKIN" is found in any capitals.
  const std::string script = "SetFactory(\"OpenCASCADE\");\nBox(1) = {0,0,0,40,30,20};\nMesh.MeshSizeMax = 20;\nPhysical Volume(\"flesh\") = {1};\n"
                             "Physical Surface(\"low\") = {5};\nPhysical Surface(\"Hull\") = {6};\n";
  std::filesystem::create_directories(folder_ / "box");
  write("box/box.geo", script);
  write("box/case.toml", "title = \"box\"\n[body]\nkind = \"imported\"\nmesh = \"box.geo\"\nunit = \"1 mm\"\n"
                         "layers = [{ name = \"flesh\", material = { law = \"neo-Hooke\", shear_modulus = \"8 kPa\", poisson_ratio = 0.4 } }]\n"
                         "[[support]]\non = \"low\"\nx = \"0 mm\"\ny = \"0 mm\"\nz = \"0 mm\"\n[load]\nskin_pressure = \"300 Pa\"\n");
  const Outcome none = snug("check box");
  EXPECT_EQ(none.status, 2) << none.text;
  EXPECT_TRUE(has(none, "has no surface \"skin\", on which the skin_pressure acts") && has(none, "\"Hull\"")) << none.text;
  std::string named = script;
  named.replace(named.find("Hull"), 4, "SKIN");
  write("box/box.geo", named);
  EXPECT_EQ(snug("check box").status, 0);
  EXPECT_EQ(snug("check box --set body.unit='1 m'").status, 2);  // a body of 40 m
}

TEST_F(Program, WhatAFileAsksForAndIsDoneOtherwiseIsAWarningOfTheRun) {
  // A step of small displacements, a linear hexahedron under forces at its corners: solved with a warning, the same at all four nodes.
  std::filesystem::create_directories(folder_ / "bar");
  write("bar/bar.inp", "*NODE\n1,0,0,0\n2,8,0,0\n3,8,6,0\n4,0,6,0\n5,0,0,5\n6,8,0,5\n7,8,6,5\n8,0,6,5\n*ELEMENT, TYPE=C3D8R, ELSET=E\n1, 1,2,3,4,5,6,7,8\n"
                       "*MATERIAL, NAME=M\n*ELASTIC\n0.04, 0.\n*SOLID SECTION, ELSET=E, MATERIAL=M\n*BOUNDARY\n1,1,3\n2,2,3\n3,3,3\n4,1,1\n4,3,3\n5,1,2\n6,2,2\n8,1,1\n"
                       "*STEP\n*STATIC\n*CLOAD\n5,3,0.0048\n6,3,0.0048\n7,3,0.0048\n8,3,0.0048\n*END STEP\n");
  write("bar/case.toml", "title = \"bar\"\n[body]\nkind = \"imported\"\nmesh = \"bar.inp\"\nunit = \"1 mm\"\nforce_unit = \"1 N\"\n");
  const Outcome run = snug("run bar --no-report");
  EXPECT_EQ(run.status, 0) << run.text;
  EXPECT_TRUE(has(run, "bar.inp:25:1: warning: the step is one of small displacements there")) << run.text;
  // E = 0.04 N/mm2, nu = 0, 0.0004 N/mm2: a strain of 1 %, 0.05 mm to first order at 5 to 8 (St. Venant-Kirchhoff: 1.5 % less)
  write("bar/u.csv", "node,UZ\n5,0.0493\n6,0.0493\n7,0.0493\n8,0.0493\n");
  const Outcome alike = snug("compare bar/out bar/u.csv --length-unit mm --relative 5e-3");
  EXPECT_EQ(alike.status, 0) << alike.text;
}

}  // namespace
}  // namespace snug
