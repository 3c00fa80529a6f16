// Entries that are fixed or follow others, resolved.
#pragma once

#include <map>
#include <vector>

namespace snug::fem {

/// An entry that another follows, with its weight in the sum.
struct Follow {
  int entry;
  double weight;
};
/// What each constrained entry follows: nothing where it is fixed.
using Lines = std::map<int, std::vector<Follow>>;

/// The lines with every followed entry that is constrained itself put in place: what is left follows free entries only.
/// deal.II's AffineConstraints; entries that follow each other in a circle are the caller's mistake.
Lines closed(const Lines& lines);

}  // namespace snug::fem
