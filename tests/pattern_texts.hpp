// Patterns as texts, for tests of every room.
#pragma once

#include <fmt/format.h>

#include <string>

namespace snug::tests {

/// A tube of `pieces` equal parts ("part 0", ...), `girth` by `length` mm, whose seams lean by `lean` mm over the length. Its hems are called
/// "lower" and "upper".
inline std::string tube_text(int pieces, double girth, double length, double lean = 0.0) {
  std::string text = "unit = \"1 mm\"\n", lower, upper;
  const double width = girth / pieces;
  for (int p = 0; p < pieces; ++p) {
    text += fmt::format("[[piece]]\nname = \"part {}\"\nedges = [\n  {{ name = \"hem\", from = [0, 0] }},\n  {{ name = \"right\", from = [{:.17g}, 0] }},\n"
                        "  {{ name = \"top\", from = [{:.17g}, {:.17g}] }},\n  {{ name = \"left\", from = [{:.17g}, {:.17g}] }},\n]\n",
                        p, width, width + lean, length, lean, length);
    lower += fmt::format("{}part {}.hem", p ? " + " : "", p), upper += fmt::format("{}part {}.top", p ? " + " : "", p);
  }
  for (int p = 0; p < pieces; ++p)
    text += fmt::format("[[seam]]\nname = \"seam {}\"\na = \"part {}.right\"\nb = \"part {}.left\"\n", p, p, (p + 1) % pieces);
  return text + fmt::format("[[hem]]\nname = \"lower\"\nedges = \"{}\"\n[[hem]]\nname = \"upper\"\nedges = \"{}\"\n", lower, upper);
}

}  // namespace snug::tests
