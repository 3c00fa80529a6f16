// The program as a user meets it: exit status, messages, and what is left on the disk.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cases/program.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;

TEST_F(Program, WrongInputIsStatus2AndWritesNothing) {
  // A wrong case ends with status 2, all errors located, and no directory out/.
  ASSERT_EQ(snug("new mine").status, 0);
  const Outcome outcome = snug("run mine --set garment.position=60 --set garment.fabrik=x");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.text.find("a unit is due here"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("did you mean fabric?"), std::string::npos) << outcome.text;
  EXPECT_FALSE(fs::exists(folder_ / "mine" / "out"));
  EXPECT_EQ(snug("run nowhere").status, 2);
  EXPECT_EQ(snug("run mine --ranks 0").status, 2);
  EXPECT_EQ(snug("run mine --ranks 2 --set garment.fabrik=x").status, 2);
  EXPECT_EQ(snug("walk").status, 2);
  EXPECT_EQ(snug("run mine --set garment.fabric=N85L51").status, 2);
}

// A limb without a rigid bone slides on its ends and floats: under loads that balance it is solved, under a pull along x
// `check` already refuses it, with the force.
TEST_F(Program, ABodyThatNothingHoldsFloatsOrIsRefused) {
  ASSERT_EQ(snug("new mine --like limb-alone").status, 0);
  const std::string tissue = "material = { law = \"neo-Hooke\", shear_modulus = \"10 kPa\", poisson_ratio = 0.45 }";
  const std::string floating = "title = \"floats\"\n[body]\nkind = \"stations\"\nstations = \"body/tube.csv\"\nlayers = [\n"
                               "{ name = \"core\", " + tissue + " },\n{ name = \"rest\", " + tissue + ", cells = 1 }]\n"
                               "cells_around = 16\ncells_along = 1\n[load]\nskin_pressure = \"5 kPa\"\n";
  write("mine/case.toml", floating);
  const std::string motions = "the body is free to move along x and y and to turn about z";
  EXPECT_NE(snug("check mine").text.find(motions + ": held without force"), std::string::npos);
  const Outcome run = snug("run mine --no-report");
  EXPECT_EQ(run.status, 0) << run.text;
  EXPECT_NE(run.text.find("free motions of the body"), std::string::npos) << run.text;
  write("mine/case.toml", floating + "[[load.force]]\non = \"skin\"\nvalue = [\"2 N\", \"0 N\", \"0 N\"]\n");
  const Outcome pulled = snug("check mine");
  EXPECT_EQ(pulled.status, 2) << pulled.text;
  EXPECT_NE(pulled.text.find(motions + ", and its loads do not balance: (2, "), std::string::npos) << pulled.text;
}

TEST_F(Program, CheckSolvesAndWritesNothing) {
  // check prints the plan with parts in and out, and leaves the case directory as it was.
  ASSERT_EQ(snug("new mine --like tube-sleeve").status, 0);
  const Outcome outcome = snug("check mine");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  for (const std::string part : {"  in   ", "  out  ", "unknowns", "memory expected", "time expected", "tissue"})
    EXPECT_NE(outcome.text.find(part), std::string::npos) << outcome.text;
  EXPECT_FALSE(fs::exists(folder_ / "mine" / "out"));
}

TEST_F(Program, ARunThatDoesNotConvergeIsStatus3) {
  // A sleeve that nothing holds on a thigh that tapers has no equilibrium without friction: the run says so, keeps it as failed and ends with 3.
  ASSERT_EQ(snug("new mine").status, 0);
  const Outcome outcome = snug("run mine --quiet --no-report --tier L1 --set body.cells_around=8 --set body.cells_along=2 --set contact.friction=0");
  EXPECT_EQ(outcome.status, 3) << outcome.text;
  EXPECT_NE(outcome.text.find("no equilibrium"), std::string::npos) << outcome.text;
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(folder_ / "mine/out/summary.json")).at("status"), "failed");
}

TEST_F(Program, RunReplacesItsOwnResultsOnly) {
  // Results are replaced by the next run, and nothing else beside them; a directory that holds something else is not touched.
  ASSERT_EQ(snug("new mine --like limb-alone").status, 0);
  const std::string coarse = "run mine --quiet --set body.cells_around=8 --set body.cells_along=1 ";
  ASSERT_EQ(snug(coarse).status, 0);
  EXPECT_TRUE(fs::exists(folder_ / "mine/out/summary.json"));
  EXPECT_TRUE(fs::exists(folder_ / "mine/out/case.echo.toml"));
  write("mine/out/note", "");
  ASSERT_EQ(snug(coarse).status, 0);
  EXPECT_TRUE(fs::exists(folder_ / "mine/out/note"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "mine"), fs::directory_iterator()), 4);
  fs::create_directories(folder_ / "precious");
  write("precious/thesis.tex", "");
  EXPECT_EQ(snug(coarse + "--out precious").status, 2);
  EXPECT_TRUE(fs::exists(folder_ / "precious/thesis.tex"));
  EXPECT_EQ(snug(coarse + "--out mine").status, 2);
}

TEST_F(Program, EveryKindOfCellRunsToItsFiles) {
  // The limb alone in quadratic hexahedra, linear ones and tetrahedra: all results are written and agree within 2 %.
  ASSERT_EQ(snug("new mine --like limb-alone").status, 0);
  for (const std::string elements : {"Q2/P1", "Q1/P0", "P2/P1"}) {
    const Outcome run = snug("run mine --quiet --set body.elements=" + elements);
    ASSERT_EQ(run.status, 0) << elements << run.text;
    const auto summary = nlohmann::json::parse(std::ifstream(folder_ / "mine/out/summary.json"));
    EXPECT_NEAR(summary["numbers"]["mean_skin_radial_displacement_m"].get<double>(), -2.373e-4, 5e-6) << elements;
    for (const char* file : {"body_0000.vtu", "displacement.lis", "stress.lis"})
      EXPECT_TRUE(fs::exists(folder_ / "mine/out" / file)) << elements << " " << file;
  }
}

TEST_F(Program, EchoRunsToTheSameResult) {
  // The echo of a run is a case of its own that gives the same answer.
  ASSERT_EQ(snug("new mine --like limb-alone").status, 0);
  ASSERT_EQ(snug("run mine --quiet --set body.cells_around=8 --set body.cells_along=1").status, 0);
  const auto answer = [&] {
    std::ifstream file(folder_ / "mine/out/summary.json");
    return nlohmann::json::parse(file).at("numbers");
  };
  const nlohmann::json first = answer();
  fs::copy_file(folder_ / "mine/out/case.echo.toml", folder_ / "mine/case.toml", fs::copy_options::overwrite_existing);
  ASSERT_EQ(snug("run mine --quiet").status, 0);
  EXPECT_EQ(answer().dump(), first.dump());
}

TEST_F(Program, MeshWritesGridsBesideTheResults) {
  // mesh writes VTU files and a quality table, and a later run accepts the directory.
  ASSERT_EQ(snug("new mine").status, 0);
  const Outcome outcome = snug("mesh mine");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_TRUE(fs::exists(folder_ / "mine/out/mesh/body.vtu"));
  EXPECT_TRUE(fs::exists(folder_ / "mine/out/mesh/garment.vtu"));
  EXPECT_EQ(snug("run mine --tier L0 --quiet").status, 0);
}

TEST_F(Program, ScoreRatesPressures) {
  // score turns pressures by location into ratings and comfort; a wrong table is status 2.
  write("worn.csv", "location,pressure_gf_per_cm2\nFront thigh,3.89\nSide thigh,4\n");
  const Outcome outcome = snug("score worn.csv --json");
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  const nlohmann::json answer = nlohmann::json::parse(outcome.text);
  EXPECT_NEAR(answer.at("locations").at(0).at("rating").get<double>(), 0.71, 0.005);
  EXPECT_TRUE(answer.at("comfort").is_object());
  write("wrong.csv", "place,pressure\nFront thigh,3\n");
  EXPECT_EQ(snug("score wrong.csv").status, 2);
  EXPECT_EQ(snug("score nowhere.csv").status, 2);
}

TEST_F(Program, ReferenceExplainsEveryKey) {
  // explain tells meaning, unit and default; an unknown key is status 2 with the nearest one.
  const Outcome outcome = snug("explain garment.position");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.text.find("height of the lowest point"), std::string::npos) << outcome.text;
  const Outcome unknown = snug("explain positon");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.text.find("position"), std::string::npos) << unknown.text;
  EXPECT_EQ(snug("list").status, 0);
  EXPECT_EQ(snug("materials list").status, 0);
  const Outcome law = snug("explain law.Ogden");
  for (const std::string part : {"sum mu_p/alpha_p", "Proc. R. Soc.", "Ogden.terms[].alpha"})
    EXPECT_NE(law.text.find(part), std::string::npos) << law.text;
  EXPECT_NE(snug("materials show N85L15").text.find("kes"), std::string::npos);
  const Outcome curve = snug("materials curve skin --mode equibiaxial --from 1 --to 1.5 --steps 2");
  EXPECT_EQ(curve.status, 0) << curve.text;
  EXPECT_NE(curve.text.find("stretch,nominal stress [Pa],Cauchy stress [Pa],J,lateral stretch\n1,0,0,1,1\n"), std::string::npos)
      << curve.text;
  EXPECT_EQ(snug("materials curve skin --mode twist").status, 2);
  EXPECT_EQ(snug("materials curve skin --from -1").status, 2);
  EXPECT_EQ(snug("materials show N85").status, 2);
}

// A pattern is drawn and told as a table; one that is wrong is refused with its place and leaves nothing.
TEST_F(Program, APatternIsDrawnCheckedAndGraded) {
  const std::string tube = "title = \"Tube\"\nunit = \"1 mm\"\n[[piece]]\nname = \"p\"\nedges = [{ name = \"low\", from = [0, 0] }, { name = \"right\", from = [200, 0] }, "
                           "{ name = \"up\", from = [200, 300] }, { name = \"left\", from = [0, 300] }]\n[[seam]]\nname = \"back\"\na = \"p.left\"\nb = \"p.right\"\n";
  write("tube.toml", tube);
  const Outcome drawn = snug("pattern tube.toml --out drawn --grade 1.1 0.9 --cells '20 mm' --write tube.json");
  EXPECT_EQ(drawn.status, 0) << drawn.text;
  for (const char* what : {"594.0     220.0     270.0", "back                         270.0     270.0    0.00  p.left to p.right", "low                          220.0 mm", "triangles (P2)"})
    EXPECT_NE(drawn.text.find(what), std::string::npos) << what << "\n" << drawn.text;
  EXPECT_TRUE(fs::exists(folder_ / "drawn/tube.svg"));
  EXPECT_EQ(snug("pattern tube.json --out again").status, 0);
  write("wrong.toml", tube + "[[seam]]\na = \"p.lfet\"\nb = \"p.up\"\n");
  const Outcome wrong = snug("pattern wrong.toml --out wrong");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.text.find("wrong.toml:10:1: error: the piece p has no edge \"lfet\"; did you mean left?"), std::string::npos) << wrong.text;
  EXPECT_FALSE(fs::exists(folder_ / "wrong"));
  EXPECT_EQ(snug("pattern tube.toml --write tube.pdf").status, 2);
}

}  // namespace
}  // namespace snug
