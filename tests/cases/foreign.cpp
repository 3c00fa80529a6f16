// Bodies of other programs from their file to the answer, where it is known by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "tests/cases/program.hpp"

namespace snug {
namespace {

const std::string head = "title = \"bar\"\n[body]\nkind = \"imported\"\nunit = \"1 mm\"\nforce_unit = \"1 N\"\n";

/// How a bar of FEBio's neo-Hooke narrows when it is stretched: mu (a^2 - 1) + lambda ln(a^2 stretch) = 0 (Bonet & Wood, 2008, eq. 6.28).
double narrowing(double E, double nu, double stretch) {
  const double mu = 0.5 * E / (1.0 + nu), lambda = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
  double low = 0.2, high = 1.0;
  for (int i = 0; i < 100; ++i) {
    const double a = 0.5 * (low + high);
    (mu * (a * a - 1.0) + lambda * std::log(a * a * stretch) > 0.0 ? high : low) = a;
  }
  return 0.5 * (low + high);
}

TEST_F(Program, ABarOfFebioNarrowsAsItsLawSays) {
  // 6 x 4 x 10 mm between planes of symmetry; step 1 ends at half of the 3 mm that step 2 comes to.
  std::filesystem::create_directories(folder_ / "bar");
  const std::string step = "<Control><time_steps>5</time_steps><step_size>0.2</step_size></Control><Boundary><bc type=\"prescribed displacement\" node_set=\"top\"><dof>z</dof><value lc=\"3\">3</value></bc></Boundary></step>";
  write("bar/bar.feb", "<?xml version=\"1.0\"?>\n<febio_spec version=\"4.0\"><Module type=\"solid\"/>\n"
                       "<Material><material id=\"1\" name=\"flesh\" type=\"neo-Hookean\"><E>0.09</E><v>0.3</v></material></Material>\n"
                       "<Mesh><Nodes><node id=\"11\">0,0,0</node><node id=\"12\">6,0,0</node><node id=\"13\">6,4,0</node><node id=\"14\">0,4,0</node>"
                       "<node id=\"21\">0,0,10</node><node id=\"22\">6,0,10</node><node id=\"23\">6,4,10</node><node id=\"24\">0,4,10</node></Nodes>\n"
                       "<Elements type=\"hex8\" name=\"P\"><elem id=\"1\">11,12,13,14,21,22,23,24</elem></Elements>\n"
                       "<NodeSet name=\"x\">11,14,21,24</NodeSet><NodeSet name=\"y\">11,12,21,22</NodeSet><NodeSet name=\"z\">11,12,13,14</NodeSet><NodeSet name=\"top\">21,22,23,24</NodeSet></Mesh>\n"
                       "<MeshDomains><SolidDomain name=\"P\" mat=\"flesh\"/></MeshDomains>\n"
                       "<Boundary><bc type=\"zero displacement\" node_set=\"x\"><x_dof>1</x_dof></bc><bc type=\"zero displacement\" node_set=\"y\"><y_dof>1</y_dof></bc>"
                       "<bc type=\"zero displacement\" node_set=\"z\"><z_dof>1</z_dof></bc></Boundary>\n"
                       "<LoadData><load_controller id=\"3\" type=\"loadcurve\"><points><pt>0,0</pt><pt>2,1</pt></points></load_controller></LoadData>\n"
                       "<Step><step id=\"1\">" + step + "<step id=\"2\">" + step + "</Step></febio_spec>\n");
  for (const int chosen : {1, 2}) {
    write("bar/case.toml", head + fmt::format("mesh = \"bar.feb\"\nload_step = {}\n", chosen));
    const Outcome run = snug("run bar --no-report");
    EXPECT_EQ(run.status, 0) << run.text;
    const double pulled = 1.5 * chosen, a = narrowing(0.09, 0.3, 1.0 + pulled / 10.0);
    write("bar/u.log", fmt::format("*Step  = 9\n*Time  = 2\n*Data  = ux;uy;uz\n23,{:.9g},{:.9g},{:.9g}\n12,{:.9g},0,0\n", 6.0 * (a - 1.0), 4.0 * (a - 1.0), pulled, 6.0 * (a - 1.0)));
    const Outcome alike = snug("compare bar/out bar/u.log --length-unit mm --relative 1e-5");
    EXPECT_EQ(alike.text.find("OUTSIDE"), std::string::npos) << alike.text;
    EXPECT_NE(alike.text.find("within"), std::string::npos) << alike.text;
  }
}

TEST_F(Program, ABarAlongAxesOfItsNodesStretchesAlongThem) {
  // 5 x 3 x 4 mm turned by 25 degrees about z, held along the axes of its nodes; its end goes 1 mm along its own x, which by nu = 0 narrows nothing.
  const double angle = 25.0 * std::acos(-1.0) / 180.0, c = std::cos(angle), s = std::sin(angle);
  std::filesystem::create_directories(folder_ / "turned");
  std::string text = "/prep7\net,1,185\nmp,ex,1,0.05\nmp,prxy,1,0\n", listing = "node,UX,UY,UZ\n", held;
  int number = 0;
  for (const double z : {0.0, 4.0})
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {5.0, 0.0}, {5.0, 3.0}, {0.0, 3.0}}) {
      text += fmt::format("n,{},{:.15g},{:.15g},{},25\n", ++number, c * x - s * y, s * x + c * y, z);
      held += fmt::format("d,{},ux,{}\n", number, x / 5.0);
      if (y == 0.0) held += fmt::format("d,{},uy,0\n", number);
      if (z == 0.0) held += fmt::format("d,{},uz,0\n", number);
      listing += fmt::format("{},{:.9g},{:.9g},0\n", number, c * x / 5.0, s * x / 5.0);
    }
  write("turned/bar.mac", text + "e,1,2,3,4,5,6,7,8\nnlgeom,on\n" + held);
  write("turned/case.toml", head + "mesh = \"bar.mac\"\n");
  write("turned/u.csv", listing);
  const Outcome run = snug("run turned --no-report");
  EXPECT_EQ(run.status, 0) << run.text;
  const Outcome alike = snug("compare turned/out turned/u.csv --length-unit mm --relative 1e-6");
  EXPECT_EQ(alike.text.find("OUTSIDE"), std::string::npos) << alike.text;
  const Outcome converted = snug("convert turned turned.inp");
  EXPECT_EQ(converted.status, 2);
  EXPECT_NE(converted.text.find("holds nodes along a direction that is none of x, y, z"), std::string::npos) << converted.text;
}

}  // namespace
}  // namespace snug
