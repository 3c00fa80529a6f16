// One row of the verification book: an assertion that also lands in docs/verification.md.
#pragma once

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace snug::tests {

/// Asserts |ours - exact| <= tolerance |exact| (absolute where exact is 0) and prints the row that scripts/verification
/// collects: case | quantity | ours | exact | relative error | tolerance | source. `source`: where `exact` comes from.
inline void book(const std::string& scene, const std::string& quantity, double ours, double exact, double tolerance,
                 const std::string& source) {
  const double error = exact != 0.0 ? ours / exact - 1.0 : ours;
  fmt::print("book | {} | {} | {:.10g} | {:.10g} | {:.1e} | {:.0e} | {}\n", scene, quantity, ours, exact, error,
             tolerance, source);
  EXPECT_LE(std::abs(error), tolerance) << scene << ": " << quantity << " is " << ours << ", exact " << exact << " (" << source << ")";
}

}  // namespace snug::tests
