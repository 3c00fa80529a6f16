// snug compare and [reference], as a user meets them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/cases/program.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;

class CompareProgram : public Program {
 protected:
  std::string text_of(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name).rdbuf();
    return text.str();
  }
  static bool holds(const Outcome& outcome, const std::string& part) {
    return outcome.text.find(part) != std::string::npos;
  }
};

TEST_F(CompareProgram, ExitStatusTellsWhetherTablesAgree) {
  // 0 within the tolerance, 1 outside, 2 for a wrong file; an error has its line.
  const std::string head = "    NODE       UX\n";
  write("a.lis", head + "       1  0.10000\n       2  0.20000\n");
  write("b.lis", head + "       1  0.10000\n       2  0.20100\n");
  write("wrong.lis", head + "       1  0.10000 3.0\n");
  EXPECT_EQ(snug("compare a.lis a.lis").status, 0);
  const Outcome differ = snug("compare a.lis b.lis");
  EXPECT_EQ(differ.status, 1) << differ.text;
  EXPECT_TRUE(holds(differ, "node 2")) << differ.text;
  EXPECT_EQ(snug("compare a.lis b.lis --relative 1e-2").status, 0);
  EXPECT_EQ(snug("compare a.lis b.lis --absolute-displacement '2 mm'").status, 0);
  const Outcome wrong = snug("compare a.lis wrong.lis");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_TRUE(holds(wrong, "wrong.lis:2:9: error: node 1 has 2 values where the head names 1 columns")) << wrong.text;
  EXPECT_EQ(snug("compare a.lis none.lis").status, 2);
  EXPECT_EQ(snug("compare a.lis b.lis --vtu d.vtu").status, 2);  // no coordinates
}

TEST_F(CompareProgram, ShellListingsCompareWithThemselves) {
  // Listings in the shape of the thesis' section 4.4.3 are read by the program and differ from themselves by nothing.
  const std::string data = std::string("'") + SNUG_SOURCE_DIR + "/tests/data/listings/";
  for (const std::string name : {"shell_displacement.lis'", "shell_stress.lis'"}) {
    const Outcome outcome = snug("compare " + data + name + " " + data + name + " --relative 0");
    EXPECT_EQ(outcome.status, 0) << outcome.text;
  }
}

TEST_F(CompareProgram, ARunIsComparedWithItsReference) {
  // A run meets its own listings within the printed precision (status 0), and a reference that says something else ends
  // with status 1, results kept, difference there.
  ASSERT_EQ(snug("new mine --like limb-alone").status, 0);
  const std::string coarse = "run mine --quiet --set body.cells_around=8 --set body.cells_along=1 ";
  ASSERT_EQ(snug(coarse).status, 0);
  fs::create_directories(folder_ / "mine/reference");
  for (const std::string name : {"displacement.lis", "stress.lis", "nodes.lis"})
    fs::copy_file(folder_ / "mine/out" / name, folder_ / "mine/reference" / name);
  const std::string plain = text_of("mine/case.toml");
  write("mine/case.toml", plain +
                              "\n[reference]\nnodes = \"reference/nodes.lis\"\n"
                              "displacement = { file = \"reference/displacement.lis\", relative = 5e-5 }\n"
                              "stress = { file = \"reference/stress.lis\", relative = 5e-5 }\n");
  const Outcome same = snug(coarse);
  EXPECT_EQ(same.status, 0) << same.text;
  EXPECT_TRUE(fs::exists(folder_ / "mine/out/difference_stress.vtu"));
  EXPECT_NE(text_of("mine/out/comparison.txt").find("by node number"), std::string::npos);
  EXPECT_EQ(snug("compare mine/out mine/reference --vtu d.vtu").status, 0);
  EXPECT_TRUE(fs::exists(folder_ / "d.vtu"));

  const Outcome other = snug(coarse + "--set load.skin_pressure='6 kPa'");
  EXPECT_EQ(other.status, 1) << other.text;
  EXPECT_TRUE(holds(other, "OUTSIDE")) << other.text;
  EXPECT_TRUE(fs::exists(folder_ / "mine/out/summary.json"));

  fs::remove(folder_ / "mine/reference/stress.lis");
  EXPECT_EQ(snug(coarse).status, 2);
}

TEST_F(CompareProgram, AnotherMeshOfTheBodyIsComparedByCoordinates) {
  // One tissue to the axis, its ends sliding, under a pressure all round is in a homogeneous state, which every mesh has
  // exactly: on a second mesh the stresses agree with the listing of the first to the half unit of its fifth digit,
  // 5e-5 of a value. (The displacements do not: the body floats.)
  ASSERT_EQ(snug("new mine --like limb-alone").status, 0);
  const std::string tissue = "material = { law = \"neo-Hooke\", shear_modulus = \"10 kPa\", poisson_ratio = 0.45 }";
  const std::string body = "title = \"one tissue\"\n[body]\nkind = \"stations\"\nstations = \"body/tube.csv\"\nlayers = [\n"
                           "{ name = \"core\", " + tissue + " },\n{ name = \"rest\", " + tissue + ", cells = 1 }]\n"
                           "cells_around = 16\ncells_along = 1\n[load]\nskin_pressure = \"5 kPa\"\n";
  write("mine/case.toml", body);
  ASSERT_EQ(snug("run mine --quiet --out first").status, 0);
  fs::create_directories(folder_ / "mine/reference");
  for (const std::string name : {"stress.lis", "nodes.lis"})
    fs::copy_file(folder_ / "first" / name, folder_ / "mine/reference" / name);
  write("mine/case.toml", body + "[reference]\nnodes = \"reference/nodes.lis\"\n"
                                 "stress = { file = \"reference/stress.lis\", relative = 5e-5 }\n");
  const Outcome finer = snug("run mine --quiet --set body.cells_around=24");
  EXPECT_EQ(finer.status, 0) << finer.text;
  EXPECT_NE(text_of("mine/out/comparison.txt").find("interpolated in the cells of the result"), std::string::npos);
}

TEST_F(CompareProgram, AShellIsComparedAtItsTop) {
  // A shell's listing has top and bottom of each node; [reference] picks the surface, and numbers of the file match nodes.
  ASSERT_EQ(snug("new mine --like shell-body").status, 0);
  ASSERT_EQ(snug("run mine --quiet --out first").status, 0);
  fs::create_directories(folder_ / "mine/reference");
  fs::copy_file(folder_ / "first/stress.lis", folder_ / "mine/reference/stress.lis");
  const std::string plain = text_of("mine/case.toml");
  const auto reference = [&](const std::string& surface) {
    write("mine/case.toml", plain + "\n[reference]\nstress = { file = \"reference/stress.lis\", relative = 5e-5" + surface + " }\n");
    return snug("run mine --quiet").status;
  };
  EXPECT_EQ(reference(""), 0);
  EXPECT_EQ(reference(", surface = \"top\""), 0);
  EXPECT_EQ(snug("compare first first/stress.lis --surface bottom").status, 0);
  EXPECT_EQ(snug("compare first first/stress.lis --surface middle").status, 2);  // the listing has none
}

TEST_F(CompareProgram, ABodyWithoutAnyLoadIsRefusedBeforeTheSolve) {
  ASSERT_EQ(snug("new mine --like shell-body").status, 0);
  std::string text = text_of("mine/body/torso.txt");
  for (std::size_t at; (at = text.find("fk,")) != std::string::npos;) text.erase(at, text.find('\n', at) - at);
  write("mine/body/torso.txt", text);
  const Outcome check = snug("check mine");
  EXPECT_EQ(check.status, 2);
  EXPECT_TRUE(holds(check, "nothing acts on the body")) << check.text;
}

}  // namespace
}  // namespace snug
