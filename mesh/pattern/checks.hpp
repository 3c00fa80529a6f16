// What is wrong with a pattern before anything is made of it.
#pragma once

#include <vector>

#include "mesh/pattern/garment_pattern.hpp"
#include "mesh/pattern/sewing.hpp"

namespace snug::mesh {

/// Where a seam says nothing of its ease, one side may be longer than the other by this much of the shorter.
constexpr double largest_ease = 0.15;

/// Reports pieces of one name, and edges of one name in a piece: nothing could be said of them.
void check_names(const Pattern& pattern, input::Diagnostics& diagnostics);

/// Refuses the pieces one by one: an outline that is open, crosses or touches itself (both edges and the place), runs
/// clockwise (the piece is inside out), a hole outside or across the outline, an edge without length, names that stand
/// twice, a notch off its edge, a size that no garment has, a fabric that only some of the pieces have. Throws
/// input::InputError with all of it.
void check_pieces(const Pattern& pattern);

/// Refuses seams whose ease is not what they mean, or above `largest_ease`, and hems on sewn edges. Throws
/// input::InputError with all of it. Returns warnings: open edges that look like a seam, stretches of a seam that do
/// not fit, sides whose pieces no other seam joins, a sewn garment with handles, more cloth round a point than can lie
/// there.
std::vector<input::Diagnostic> check_seams(const Pattern& pattern, const Sewing& sewing);

struct CheckedPattern {
  Pattern pattern;
  Sewing sewing;
  std::vector<input::Diagnostic> warnings;
};
/// All of the above. Throws input::InputError.
CheckedPattern checked(Pattern pattern);

}  // namespace snug::mesh
