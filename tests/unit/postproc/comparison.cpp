#include "postproc/comparison.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "postproc/field_cells.hpp"
#include "postproc/grid.hpp"
#include "postproc/stress.hpp"
#include "tests/unit/postproc/scene.hpp"

namespace snug::postproc {
namespace {

/// A block of 27-node hexahedra with straight edges, 0.4 x 0.3 x 0.2 m, turned a little, with a linear displacement.
BodyResult block(int cells) {
  BodyResult body;
  std::vector<Eigen::Vector3d> displacement;
  std::vector<Stress> stresses;
  const int n = 2 * cells + 1;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Eigen::Vector3d at(0.4 * i / (n - 1), 0.3 * j / (n - 1), 0.2 * k / (n - 1));
        body.nodes.push_back(at);
        displacement.emplace_back(1e-3 + 0.02 * at.x() - 0.01 * at.z(), 0.03 * at.y(), -0.01 * at.x());
        Stress stress;
        stress << 100 + 1000 * at.x(), 50 * at.y(), -20, 10, 5 * at.z(), 1;
        stresses.push_back(stress);
      }
  body.fields.set(field::displacement, displacement);
  add_stress(body.fields, stresses);
  for (int c = 0; c < cells * cells * cells; ++c) {
    const int ci = c % cells, cj = c / cells % cells, ck = c / cells / cells;
    std::array<int, 27> cell;
    for (int m = 0; m < 27; ++m) cell[m] = ((2 * ck + m / 9) * n + 2 * cj + m / 3 % 3) * n + 2 * ci + m % 3;
    body.cells.push_back(cell);
    body.cell_layer.push_back(0);
  }
  return body;
}

NodalField field_of_body(const BodyResult& body, const std::string& name) {
  const auto file = test::fresh_folder("compare-" + name) / "body_0000.vtu";
  write_body(body, {}, file);
  return read_field(file.parent_path());
}

NodalField simple(std::vector<int> nodes, std::vector<double> ux) {
  NodalField field;
  field.name = "simple";
  field.nodes = std::move(nodes);
  field.columns = {{"UX", std::move(ux)}};
  return field;
}

TEST(Comparison, StatisticsOfAColumnAreTheirDefinitions) {
  // Differences 0, 3e-3 and -4e-3 m: RMS sqrt(25/3) mm, maximum 4 mm at node 9, extremes at their nodes.
  const auto comparison = compare(simple({4, 7, 9}, {1, 2.003, 2.996}), simple({4, 7, 9}, {1, 2, 3}));
  const ColumnComparison& column = comparison.columns.at(0);
  EXPECT_NEAR(column.rms, std::sqrt(25.0 / 3) * 1e-3, 1e-12);
  EXPECT_NEAR(column.maximum, 4e-3, 1e-12);
  ASSERT_EQ(column.worst.size(), 2u);
  EXPECT_EQ(column.worst[0].at.node, 9);
  EXPECT_EQ(column.worst[1].at.node, 7);
  EXPECT_EQ(column.result_minimum.node, 4);
  EXPECT_EQ(column.reference_maximum.node, 9);
  EXPECT_EQ(column.scale, 3.0);
  EXPECT_FALSE(comparison.within());
  ComparisonOptions loose;
  loose.displacement = {0.0, 4.1e-3};
  EXPECT_TRUE(compare(simple({4, 7, 9}, {1, 2.003, 2.996}), simple({4, 7, 9}, {1, 2, 3}), loose).within());
}

TEST(Comparison, WhatIsMissingOrNoNumberDoesNotPass) {
  // A reference node that the result lacks and a NaN of the result fail; an overflown field of the reference is counted
  // and not compared; a column that the result lacks and tables without a common node are wrong input.
  EXPECT_FALSE(compare(simple({1}, {1}), simple({1, 2}, {1, 1})).within());
  EXPECT_TRUE(compare(simple({1, 2}, {1, 1}), simple({1}, {1})).within());
  EXPECT_FALSE(compare(simple({1, 2}, {1, NAN}), simple({1, 2}, {1, 1})).within());
  const auto unknown = compare(simple({1, 2}, {1, 5}), simple({1, 2}, {1, NAN}));
  EXPECT_TRUE(unknown.within());
  EXPECT_EQ(unknown.columns[0].unknown, 1);
  EXPECT_FALSE(compare(simple({1}, {1}), simple({1}, {NAN})).within());
  NodalField stresses = simple({1}, {1});
  stresses.columns[0].label = "S1";
  EXPECT_THROW(compare(simple({1}, {1}), stresses), input::InputError);
  EXPECT_THROW(compare(simple({1}, {1}), simple({2}, {1})), input::InputError);
}

TEST(Comparison, MeshesOfTheSameBodyCompareByCoordinates) {
  // A linear displacement and a linear stress field are the same on two meshes that share no inner node, interpolated
  // with the cells' shape functions: to VTK's tolerance for the inverse of the shape functions, 1e-6 of the largest
  // value. A shift of 1 mm of a third of the nodes is found, at those nodes.
  const NodalField coarse = field_of_body(block(2), "coarse"), fine = field_of_body(block(3), "fine");
  ComparisonOptions options;
  options.displacement = options.stress = {1e-6, 0.0};
  for (const auto& [a, b] : {std::pair{coarse, fine}, std::pair{fine, coarse}}) {
    const Comparison comparison = compare(a, b, options);
    EXPECT_EQ(comparison.missing, 0);
    EXPECT_EQ(comparison.compared, static_cast<int>(b.nodes.size()));
    EXPECT_NE(comparison.matching.find("interpolated in the cells of the result"), std::string::npos);
    for (const ColumnComparison& column : comparison.columns)
      if (column.label[0] == 'U' || column.label.size() < 4)
        EXPECT_LE(column.maximum, column.tolerance) << column.label;
  }
  BodyResult moved = block(3);
  for (std::size_t n = 0; n < moved.nodes.size(); n += 3) moved.fields[field::displacement][n].z() += 1e-3;
  const Comparison comparison = compare(coarse, field_of_body(moved, "moved"), options);
  EXPECT_FALSE(comparison.within());
  EXPECT_NEAR(comparison.columns[2].maximum, 1e-3, 1e-8);
  EXPECT_EQ((comparison.columns[2].worst[0].at.node - 1) % 3, 0);
}

TEST(Comparison, NodesOfOneNumberAtTwoPlacesAreMatchedByPlace) {
  // Renumbered nodes of one mesh: automatic matching notices that the places differ and finds the nodes by them.
  NodalField a = simple({1, 2, 3}, {10, 20, 30}), b = simple({1, 2, 3}, {30, 20, 10});
  a.places = {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}};
  b.places = {{1, 0, 0}, {0.5, 0, 0}, {0, 0, 0}};
  EXPECT_TRUE(compare(a, b).within());
  ComparisonOptions by_number;
  by_number.matching = Matching::by_number;
  EXPECT_FALSE(compare(a, b, by_number).within());
  b.places[1].y() = 0.1;  // nowhere near a node of a
  EXPECT_EQ(compare(a, b).missing, 1);
}

TEST(Comparison, TheDifferenceIsAGridWithTheCellsOfTheResult) {
  // VTK reads the difference back, cells included, through this room's own reader of cells.
  const NodalField coarse = field_of_body(block(2), "cells");
  const Comparison comparison = compare(coarse, coarse);
  EXPECT_TRUE(comparison.within());
  const auto file = test::fresh_folder("difference") / "difference.vtu";
  write_columns(comparison.difference, file);
  const std::string text = test::text_of(file);
  EXPECT_NE(text.find("NumberOfCells=\"8\""), std::string::npos);
  EXPECT_NE(text.find("UX difference"), std::string::npos);
  EXPECT_NE(comparison_text(comparison).find("no node differs"), std::string::npos);
}

/// A listing of three nodes in the form of PRNSOL.
std::string listing(const std::string& frame, int step, double scale) {
  std::string text = fmt::format(" PRINT U    NODAL SOLUTION PER NODE\n\n  LOAD STEP=  {}  SUBSTEP=  4\n  THE FOLLOWING DEGREE OF FREEDOM RESULTS ARE IN {}\n\n    NODE  UX  UY  UZ  USUM\n", step, frame);
  for (const auto& [node, u] : {std::pair{3, 1.0}, std::pair{5, 2.0}, std::pair{8, -3.0}})
    text += fmt::format("  {}  {:.5E}  {:.5E}  {:.5E}  {:.5E}\n", node, scale * u, 0.0, 0.0, scale * std::abs(u));
  return text;
}

NodalField field_of_text(const std::string& text, const FieldOptions& options = {}) {
  input::Diagnostics diagnostics;
  NodalField field = field_of(parse_listing(text, "u.lis", diagnostics), options);
  diagnostics.throw_if_any();
  field.name = "u.lis";
  return field;
}

TEST(Comparison, ComponentsOfAnotherFrameAreNotTakenForCartesianOnes) {
  // RSYS,5 and the frame of the solution: USUM is compared, UX UY UZ are not, and that is said; the global frame has no note.
  for (const char* frame : {"COORDINATE SYSTEM     5", "ROTATED COORDINATE SYSTEM"}) {
    const NodalField field = field_of_text(listing(frame, 1, 1e-3));
    EXPECT_EQ(field.find("UX"), nullptr) << frame;
    ASSERT_NE(field.find("USUM"), nullptr);
    ASSERT_EQ(field.notes.size(), 1u);
    EXPECT_NE(field.notes[0].find("RSYS,0"), std::string::npos);
  }
  for (const char* frame : {"THE GLOBAL COORDINATE SYSTEM", "COORDINATE SYSTEM  0"}) EXPECT_TRUE(field_of_text(listing(frame, 1, 1e-3)).notes.empty()) << frame;
  const auto comparison = compare(field_of_text(listing("THE GLOBAL COORDINATE SYSTEM", 1, 1e-3)), field_of_text(listing("COORDINATE SYSTEM 1", 1, 1e-3)));
  ASSERT_EQ(comparison.columns.size(), 1u);
  EXPECT_NE(comparison_text(comparison).find("note       reference: its components are in COORDINATE SYSTEM 1"), std::string::npos);
  EXPECT_TRUE(field_of_text(" LIST ALL SELECTED NODES.   DSYS=      1\n\n    NODE  X  Y  Z\n  1  1.0  2.0  3.0\n").places.empty());
}

TEST(Comparison, WhichLoadStepIsComparedIsSaidAndCanBeChosen) {
  const std::string text = listing("THE GLOBAL COORDINATE SYSTEM", 1, 1e-3) + "\n" + listing("THE GLOBAL COORDINATE SYSTEM", 2, 5e-3);
  const NodalField last = field_of_text(text);
  EXPECT_DOUBLE_EQ(last.find("UX")->values[1], 1e-2);
  ASSERT_EQ(last.notes.size(), 1u);
  EXPECT_NE(last.notes[0].find("of 2 load steps and substeps, load step 2 substep 4 is taken"), std::string::npos);
  EXPECT_DOUBLE_EQ(field_of_text(text, {.load_step = 1}).find("UX")->values[1], 2e-3);
  EXPECT_THROW(field_of_text(text, {.load_step = 3}), input::InputError);
}

TEST(Comparison, ValuesAThousandTimesTooLargeAskForTheirUnit) {
  const auto metres = field_of_text(listing("THE GLOBAL COORDINATE SYSTEM", 1, 1.02e-3)), millimetres = field_of_text(listing("THE GLOBAL COORDINATE SYSTEM", 1, 1.0));
  EXPECT_NE(comparison_text(compare(metres, millimetres)).find("(--length-unit mm)"), std::string::npos);
  EXPECT_TRUE(compare(metres, metres).notes.empty());
}

TEST(Comparison, TablesOfOtherProgramsAreListings) {
  // A Workbench export with tabs and decimal commas, a table of PyMAPDL, a .dat file of CalculiX with two times: labels, units, values.
  const auto folder = test::fresh_folder("other-listings");
  const auto write = [&](const char* name, const std::string& text) { std::ofstream(folder / name) << text; return folder / name; };
  const NodalField stress = read_field(write("s.txt", "Node Number\tEquivalent (von-Mises) Stress (kPa)\tX Location (cm)\r\n2\t1,25\t0,5\r\n7\t10,5\t3\r\n"));
  EXPECT_EQ(stress.nodes, (std::vector<int>{2, 7}));
  EXPECT_DOUBLE_EQ(stress.find("SEQV")->values[1], 10500.0);
  EXPECT_DOUBLE_EQ(stress.find("X")->values[1], 0.03);
  const NodalField table = read_field(write("u.csv", "node,UX,UY,UZ\n1,0.5,0,-1\n2,1.5,0,2\n"), {.length_unit = 1e-3});
  EXPECT_DOUBLE_EQ(table.find("UZ")->values[0], -1e-3);
  const std::string head = " displacements (vx,vy,vz) for set NALL and time  ", row = "\n\n         4  1.000000E-01 -2.000000E-01  3.000000E+00\n";
  const NodalField dat = read_field(write("m.dat", "\n" + head + "0.5000000E+00" + row + "\n" + head + "0.1000000E+01\n\n         4  2.000000E-01 -2.000000E-01  4.000000E+00\n"));
  EXPECT_DOUBLE_EQ(dat.find("UZ")->values[0], 4.0);
  EXPECT_EQ(dat.notes.size(), 1u);
  EXPECT_THROW(read_field(write("bad.csv", "node,UX\n1.5,2\n")), input::InputError);
  EXPECT_THROW(read_field(write("unit.csv", "node,UX [kPa]\n1,2\n")), input::InputError);
}

}  // namespace
}  // namespace snug::postproc
