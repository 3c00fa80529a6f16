// Fields: named blocks of the state vector.
#include <gtest/gtest.h>

#include <stdexcept>

#include "solver/algebra/layout.hpp"

namespace snug::solver {
namespace {

TEST(Layout, FieldsFollowOneAnother) {
  // Each field begins where the one before ends, an item has its components side by side, and positions come first.
  Layout layout;
  layout.add({.name = "body", .count = 5, .components = 3});
  layout.add({.name = "band", .count = 2, .components = 3});
  layout.add({.name = "contact", .rows = Rows::constraint, .count = 4});
  EXPECT_EQ(layout["band"](1, 2), 3 * 5 + 3 + 2);
  EXPECT_EQ(layout["contact"](3), 21 + 3);
  EXPECT_EQ(layout.positions(), 21);
  EXPECT_EQ(layout.size(), 25);
}

TEST(Layout, WhatASceneLacksIsEmpty) {
  // A name that the scene does not have gives a field without items.
  EXPECT_EQ(Layout()["garment"].count, 0);
  EXPECT_EQ(Layout().size(), 0);
}

TEST(Layout, NamesAreUniqueAndPositionsComeFirst) {
  // A second field of one name, or positions behind pressures, is a fault of the program.
  Layout layout;
  layout.add({.name = "body", .count = 5, .components = 3});
  EXPECT_THROW(layout.add({.name = "body", .count = 1}), std::logic_error);
  layout.add({.name = "contact", .rows = Rows::constraint, .count = 4});
  EXPECT_THROW(layout.add({.name = "band", .count = 2, .components = 3}), std::logic_error);
}

}  // namespace
}  // namespace snug::solver
