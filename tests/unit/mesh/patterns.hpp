// Patterns of the tests.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "mesh/pattern/checks.hpp"
#include "mesh/pattern/garmentcode.hpp"
#include "mesh/pattern/toml_pattern.hpp"

namespace snug::mesh {

inline CheckedPattern checked_toml(const std::string& text) { return checked(parse_toml_pattern(text, "test.toml")); }
inline CheckedPattern checked_json(const std::string& text) { return checked(parse_garmentcode(text, "test.json")); }

/// What a text is refused with; empty when it is not.
template <class Read>
std::string refusal(const Read& read) {
  try {
    read();
  } catch (const input::InputError& error) {
    return error.what();
  }
  return {};
}

/// A text with `what` replaced, which must stand in it once.
inline std::string with(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  EXPECT_EQ(text.find(what, at + 1), std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

/// Two halves of a tube of 200 mm by 300 mm.
inline const std::string two_halves = R"(title = "Tube of two halves"
unit = "1 mm"
[[piece]]
name = "front"
edges = [
  { name = "hem", from = [0, 0] },
  { name = "left", from = [200, 0] },
  { name = "top", from = [200, 300] },
  { name = "right", from = [0, 300] },
]
[[piece]]
name = "back"
edges = [
  { name = "hem", from = [0, 0] },
  { name = "right", from = [200, 0] },
  { name = "top", from = [200, 300] },
  { name = "left", from = [0, 300] },
]
[[seam]]
name = "left"
a = "front.left"
b = "back.left"
[[seam]]
name = "right"
a = "front.right"
b = "back.right"
)";

/// A sector of an annulus, 100 mm to 250 mm, of 120 degrees: the leg of a cone when its straight edges are sewn.
inline const std::string cone = R"(unit = "1 cm"
[[piece]]
name = "leg"
edges = [
  { name = "inner", kind = "arc", from = [5, 8.660254037844386], through = [[10, 0]], to = [5, -8.660254037844386] },
  { name = "one", from = [5, -8.660254037844386] },
  { name = "outer", kind = "arc", from = [12.5, -21.650635094610966], through = [[25, 0]] },
  { name = "other", from = [12.5, 21.650635094610966] },
]
[[seam]]
name = "seam"
a = "leg.one"
b = "leg.other"
)";

}  // namespace snug::mesh
