// Results of CalculiX as its .frd files have them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "postproc/frd_listing.hpp"
#include "postproc/nodal_field.hpp"

namespace snug::postproc {
namespace {

using testing::ElementsAre, testing::HasSubstr, testing::SizeIs;

// Written by CalculiX 2.20 of a tetrahedron of 30 x 20 x 40 mm, shear modulus 4 MPa, in two steps; its ERROR block of the first step left in.
const std::string head = "    1C\n    1UPGM               CalculiX                                        \n"
                         "    2C                             4                                     1\n";
const std::string places = " -1         1 0.00000E+00 0.00000E+00 0.00000E+00\n -1         2 3.00000E+01 0.00000E+00 0.00000E+00\n"
                           " -1         3 0.00000E+00 2.00000E+01 0.00000E+00\n -1         4 0.00000E+00 0.00000E+00-4.00000E+01\n -3\n"
                           "    3C                             1                                     1\n -1         7    3    0    1\n -2         1         3         2         4\n -3\n";
const std::string disp = " -4  DISP        4    1\n -5  D1          1    2    1    0\n -5  D2          1    2    2    0\n -5  D3          1    2    3    0\n -5  ALL         1    2    0    0    1ALL\n";
const std::string stress = " -4  STRESS      6    1\n -5  SXX         1    4    1    1\n -5  SYY         1    4    2    2\n -5  SZZ         1    4    3    3\n"
                           " -5  SXY         1    4    1    2\n -5  SYZ         1    4    2    3\n -5  SZX         1    4    3    1\n";
const std::string first = "    1PSTEP                         1           1           1          \n  100CL  101 1.000000000           4                     0    1           1\n" + disp +
                          " -1         1 0.00000E+00 0.00000E+00 0.00000E+00\n -1         2-6.46343E-02 0.00000E+00 0.00000E+00\n -1         3 0.00000E+00-4.30895E-02 0.00000E+00\n"
                          " -1         4 0.00000E+00 0.00000E+00-6.77249E-01\n -3\n"
                          "    1PSTEP                         2           1           1          \n  100CL  101 1.000000000           4                     0    1           1\n" + stress +
                          " -1         1 2.43731E-14 2.43731E-14 1.50648E-01 0.00000E+00 0.00000E+00 0.00000E+00\n -1         2 2.43731E-14 2.43731E-14 1.50648E-01 1.00000E+00 0.00000E+00 0.00000E+00\n"
                          " -1         3 2.43731E-14 2.43731E-14 1.50648E-01 0.00000E+00 2.00000E+00 0.00000E+00\n -1         4 2.43731E-14 2.43731E-14 1.50648E-01 0.00000E+00 0.00000E+00 3.00000E+00\n -3\n"
                          "    1PSTEP                         3           1           1          \n  100CL  101 1.000000000           4                     0    1           1\n"
                          " -4  ERROR       1    1\n -5  STR(%)      1    1    0    0\n -1         1 0.00000E+00\n -3\n";
const std::string second = "    1PSTEP                         4           3           2          \n  100CL  102 2.000000000           4                     0    2           1\n" + disp +
                           " -1         1 0.00000E+00 0.00000E+00 0.00000E+00\n -1         2-2.83328E-01 0.00000E+00 0.00000E+00\n -1         3 0.00000E+00-1.88886E-01 0.00000E+00\n"
                           " -1         4-3.10111E-01 0.00000E+00-2.84451E+00\n -3\n 9999\n";

std::string frd_faults(const std::string& text) {
  input::Diagnostics diagnostics;
  frd_tables(text, "tet.frd", diagnostics);
  std::string all;
  for (const auto& one : diagnostics.errors()) all += std::to_string(one.where.line) + ": " + one.found + " | " + one.remedy + "\n";
  return all;
}

TEST(FrdListing, PlacesDisplacementsAndStressesOfAllStepsAreRead) {
  input::Diagnostics diagnostics;
  const auto tables = frd_tables(head + places + first + second, "tet.frd", diagnostics);
  ASSERT_TRUE(tables && !diagnostics.any());
  ASSERT_THAT(*tables, SizeIs(4));
  EXPECT_EQ((*tables)[0].value(3, 2), -40.0);
  EXPECT_EQ((*tables)[1].value(1, 0), -6.46343e-2);  // fields that touch
  EXPECT_THAT((*tables)[2].labels, ElementsAre("SX", "SY", "SZ", "SXY", "SYZ", "SXZ"));
  EXPECT_EQ((*tables)[2].value(3, 5), 3.0);
  EXPECT_EQ((*tables)[2].load_step, 1);
  EXPECT_EQ((*tables)[3].load_step, 2);
  EXPECT_EQ((*tables)[3].substep, 3);
  EXPECT_EQ((*tables)[3].value(3, 0), -0.310111);
  EXPECT_FALSE(frd_tables("NODE UX\n1 2\n", "x", diagnostics));
}

TEST(FrdListing, TheStepThatIsAskedForIsTaken) {
  const auto file = std::filesystem::temp_directory_path() / "snug_two_steps.frd";
  std::ofstream(file) << head << places << first << second;
  const NodalField last = read_field(file, {.length_unit = 1e-3, .surface = {}}), one = read_field(file, {.length_unit = 1e-3, .stress_unit = 1e6, .surface = {}, .load_step = 1});
  std::filesystem::remove(file);
  EXPECT_THAT(last.nodes, ElementsAre(1, 2, 3, 4));
  EXPECT_NEAR(last.places[2].y(), 0.02, 1e-15);
  EXPECT_NEAR(last.find("UZ")->values[3], -2.84451e-3, 1e-15);
  EXPECT_NEAR(one.find("UZ")->values[3], -6.77249e-4, 1e-15);
  EXPECT_NEAR(one.find("SZ")->values[0], 0.150648e6, 1e-6);
  EXPECT_THAT(last.notes, SizeIs(1));
}

TEST(FrdListing, ShortNodeNumbersAndSixColumnsARowAreRead) {
  // Format 0 has node numbers of five columns.
  std::string text = head;
  text.replace(text.rfind("1\n"), 1, "0");
  input::Diagnostics diagnostics;
  const auto tables = frd_tables(text + " -1   12 1.00000E+00-2.00000E+00 3.00000E+00\n -3\n", "tet.frd", diagnostics);
  ASSERT_TRUE(tables && tables->size() == 1);
  EXPECT_EQ((*tables)[0].rows[0].node, 12);
  EXPECT_EQ((*tables)[0].value(0, 1), -2.0);
}

TEST(FrdListing, WhatIsCutShortOrBinaryIsReported) {
  std::string binary = head;
  binary.replace(binary.rfind("1\n"), 1, "2");
  EXPECT_THAT(frd_faults(binary + "\x01\x02"), HasSubstr("the results are binary | write them as text: *NODE FILE"));
  const std::string whole = head + places + first;
  EXPECT_THAT(frd_faults(whole.substr(0, whole.find("-6.46343E-02") + 12)), HasSubstr("the file ends within a block"));
  std::string missing = whole, wrong = whole;
  missing.replace(missing.find("-6.46343E-02 0.00000E+00 0.00000E+00"), 36, "-6.46343E-02 0.00000E+00");
  EXPECT_THAT(frd_faults(missing), HasSubstr("node 2 has fewer values"));
  for (const char* next : {" -4  STRESS", "    3C", "    2C"})  // a block that does not end before the next one
    EXPECT_THAT(frd_faults(head + " -1         5 1.00000E+00\n" + next + "\n"), HasSubstr("node 5 has fewer values")) << next;
  wrong.replace(wrong.find("-6.46343E-02"), 12, "-6.46343X-02");
  EXPECT_THAT(frd_faults(wrong), HasSubstr("\"-6.46343X-02\" is no number"));
}

}  // namespace
}  // namespace snug::postproc
