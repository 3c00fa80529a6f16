// Boxes, partitions and constraints against what a loop or a hand finds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "solver/fem/box_tree.hpp"
#include "solver/fem/constraints.hpp"
#include "solver/fem/partition.hpp"

namespace snug::tests {
namespace {

Eigen::Vector3d scattered(int seed) {
  return {std::sin(12.9898 * seed), std::sin(78.233 * seed + 1.0), std::sin(37.719 * seed + 2.0)};
}

TEST(BoxTree, FindsTheBoxesThatALoopFindsNearest) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d low = scattered(i);
    boxes.emplace_back(low, low + 0.05 * scattered(i + 1000).cwiseAbs());
  }
  const fem::BoxTree tree(boxes);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Vector3d x = 1.5 * scattered(trial + 5000);
    std::vector<double> all, found;
    for (const auto& box : boxes) all.push_back(box.exteriorDistance(x));
    for (const int i : tree.nearest(x, 6)) found.push_back(all[i]);
    std::ranges::sort(all), std::ranges::sort(found);
    ASSERT_EQ(found.size(), 6u);
    for (int k = 0; k < 6; ++k) EXPECT_DOUBLE_EQ(found[k], all[k]);
  }
}

TEST(BoxTree, GivesAllWhereThereAreFewerThanAskedForAndNoneTwice) {
  const fem::BoxTree tree({{Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()}, {Eigen::Vector3d::Constant(5.0), Eigen::Vector3d::Constant(6.0)}});
  const std::vector<int> near = tree.nearest({9.0, 9.0, 9.0}, 6);
  EXPECT_EQ(std::set<int>(near.begin(), near.end()), (std::set<int>{0, 1}));
  EXPECT_EQ(near.size(), 2u);
  EXPECT_EQ(tree.nearest({9.0, 9.0, 9.0}, 1), std::vector<int>{1});
}

/// Squares of a strip, `wide` to a row.
std::vector<std::vector<int>> strip(int wide, int long_) {
  std::vector<std::vector<int>> elements;
  for (int j = 0; j < long_; ++j)
    for (int i = 0; i < wide; ++i) {
      const int n = j * (wide + 1) + i;
      elements.push_back({n, n + 1, n + wide + 1, n + wide + 2});
    }
  return elements;
}

TEST(Partition, GivesEveryElementAPartOfAboutOneSize) {
  const auto elements = strip(4, 60);
  for (const int parts : {2, 3, 4}) {
    const std::vector<int> part = fem::partition(elements, parts);
    ASSERT_EQ(part.size(), elements.size());
    for (int p = 0; p < parts; ++p) {
      const auto mine = std::ranges::count(part, p);
      EXPECT_NEAR(static_cast<double>(mine), 240.0 / parts, 0.1 * 240.0 / parts) << p << " of " << parts;
    }
    EXPECT_LT(*std::ranges::max_element(part), parts);
    EXPECT_GE(*std::ranges::min_element(part), 0);
  }
}

TEST(Partition, CutsALongStripAcross) {
  // Between two halves of a strip four squares wide, 4 + 2 * 3 pairs of neighbours are cut; a cut along it would cut 178.
  const auto elements = strip(4, 60);
  const std::vector<int> part = fem::partition(elements, 2);
  int cut = 0;
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (std::size_t f = 0; f < e; ++f) {
      const auto meets = [&](int node) { return std::ranges::find(elements[f], node) != elements[f].end(); };
      if (part[e] != part[f] && std::ranges::any_of(elements[e], meets)) ++cut;
    }
  EXPECT_LE(cut, 20);
  EXPECT_GE(cut, 10);
}

TEST(Partition, OfNothingIsNothing) { EXPECT_TRUE(fem::partition({}, 3).empty()); }

TEST(Constraints, ChainsEndAtFreeEntriesWithTheProductsOfTheirWeights) {
  // 1 = 0.5 (2) + 0.25 (3), 2 = 3 (4) + 2 (3), 5 = 1: so 1 = 1.5 (4) + 1.25 (3).
  const fem::Lines lines = fem::closed({{1, {{2, 0.5}, {3, 0.25}}}, {2, {{4, 3.0}, {3, 2.0}}}, {5, {{1, 1.0}}}});
  ASSERT_EQ(lines.size(), 3u);
  for (const int entry : {1, 5}) {
    std::map<int, double> line;
    for (const auto& [other, weight] : lines.at(entry)) line[other] += weight;
    EXPECT_EQ(line, (std::map<int, double>{{3, 1.25}, {4, 1.5}})) << entry;
    EXPECT_EQ(lines.at(entry).size(), 2u);
  }
}

TEST(Constraints, WhatFollowsAFixedEntryIsFixed) {
  const fem::Lines lines = fem::closed({{0, {}}, {7, {{0, 1.0}}}, {8, {{0, 0.5}, {9, 0.5}}}});
  EXPECT_TRUE(lines.at(0).empty());
  EXPECT_TRUE(lines.at(7).empty());
  ASSERT_EQ(lines.at(8).size(), 1u);
  EXPECT_EQ(lines.at(8)[0].entry, 9);
  EXPECT_EQ(lines.at(8)[0].weight, 0.5);
}

}  // namespace
}  // namespace snug::tests
