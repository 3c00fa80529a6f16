#include "postproc/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace snug::postproc
