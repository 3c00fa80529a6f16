// From entries of the state vector to unknowns of the linear system.
#pragma once

#include <utility>
#include <vector>

namespace snug::solver {

/// Prescribed entries have no unknown; sewn entries share one. Each rank owns a contiguous range of unknowns.
class Numbering {
 public:
  Numbering() = default;
  /// `master[i]` is the entry that entry i follows (itself when free), or -1 when it is prescribed.
  /// The constraints are those of a deal.II AffineConstraints (see scene/constraints). `owner[i]` is the rank of entry
  /// i (that of its master counts); without owners all unknowns are those of rank 0.
  explicit Numbering(std::vector<int> master, const std::vector<int>& owner = {}, int ranks = 1);

  int unknown(int entry) const { return unknown_[entry]; }   ///< -1: prescribed
  int unknowns() const { return unknowns_; }
  int entries() const { return static_cast<int>(unknown_.size()); }
  /// First and end unknown of a rank.
  std::pair<int, int> owned(int rank) const { return {first_[rank], first_[rank + 1]}; }

 private:
  std::vector<int> unknown_, first_ = {0, 0};
  int unknowns_ = 0;
};

}  // namespace snug::solver
