// Displacements as the log and the data files of FEBio have them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "postproc/febio_log.hpp"
#include "postproc/nodal_field.hpp"

namespace snug::postproc {
namespace {

using testing::ElementsAre, testing::HasSubstr, testing::SizeIs;

// The form that the manual prints: a log with a record of nodes and one of elements at two times, and a data file with commas.
const std::string log = "===== beginning time step 1 : 0.5 =====\n Nr of equations ........... : 24\n\nData Record #1\n===========================================================================\n"
                        "Step = 1\nTime = 0.5\nData = displacement\n3 0.25 0 -1.5e-05\n7 -2 1 1\n\nData Record #2\n===========================================================================\n"
                        "Step = 1\nTime = 0.5\nData = sx;sy;sz\n1 10 20 30\n\n===== beginning time step 2 : 1 =====\n\nData Record #1\n===========================================================================\n"
                        "Step = 2\nTime = 1\nData = displacement\n3 0.5 0 -3e-05\n7 -4 2 2\n N O R M A L   T E R M I N A T I O N\n";
const std::string data = "*Step  = 4\n*Time  = 0.1\n*Data  = uz;ux\n1,0.5,-1\n12,2,3\n";

std::string faults(const std::string& text) {
  input::Diagnostics diagnostics;
  febio_records(text, "leg.log", diagnostics);
  std::string all;
  for (const auto& one : diagnostics.errors()) all += std::to_string(one.where.line) + ": " + one.found + "\n";
  return all;
}

TEST(FebioLog, RecordsOfNodesAreReadAtAllTimes) {
  input::Diagnostics diagnostics;
  const auto tables = febio_records(log, "leg.log", diagnostics);
  ASSERT_TRUE(tables && !diagnostics.any());
  ASSERT_THAT(*tables, SizeIs(2));  // that of elements is passed over
  EXPECT_EQ((*tables)[0].value(0, 2), -1.5e-5);
  EXPECT_EQ((*tables)[1].rows[1].node, 7);
  EXPECT_EQ((*tables)[1].load_step, 2);
  const auto file = febio_records(data, "u.txt", diagnostics);
  ASSERT_TRUE(file && file->size() == 1);
  EXPECT_THAT((*file)[0].labels, ElementsAre("UZ", "UX"));
  EXPECT_EQ((*file)[0].value(1, 1), 3.0);
  EXPECT_FALSE(febio_records("NODE UX UY\n1 2 3\n", "x", diagnostics));
}

TEST(FebioLog, TheLastTimeIsComparedUnlessAnotherIsAskedFor) {
  const auto file = std::filesystem::temp_directory_path() / "snug_leg.log";
  std::ofstream(file) << log;
  const NodalField last = read_field(file, {.length_unit = 1e-2, .surface = {}}), first = read_field(file, {.length_unit = 1e-2, .surface = {}, .load_step = 1});
  std::filesystem::remove(file);
  EXPECT_THAT(last.nodes, ElementsAre(3, 7));
  EXPECT_NEAR(last.find("UX")->values[1], -0.04, 1e-15);
  EXPECT_NEAR(first.find("UX")->values[1], -0.02, 1e-15);
}

TEST(FebioLog, WrongRowsAreReportedAtTheirPlace) {
  EXPECT_EQ(faults("*Step  = 1\n*Time  = 1\n*Data  = ux;uy;uz\n1,2,3\n"), "4: node 1 has 2 values where the record has 3 variables\n");
  EXPECT_EQ(faults("*Step  = 1\n*Time  = 1\n*Data  = ux\n1 x\n"), "4: \"x\" is no number\n");
  EXPECT_EQ(faults("*Step  = 1\n*Time  = 1\n*Data  = ux\n0 1\n"), "4: \"0\" is no node number\n");
}

}  // namespace
}  // namespace snug::postproc
