// From entries of the state vector to unknowns of the linear system.
#pragma once

#include <utility>
#include <vector>

namespace snug::solver {

/// Prescribed entries have no unknown; sewn entries share one. Rows are owned by ranks in contiguous ranges.
class Numbering {
 public:
  Numbering() = default;
  /// `master[i]` is the entry that entry i follows (itself when free), or -1 when it is prescribed.
  /// The constraints are those of a deal.II AffineConstraints (see scene/constraints).
  explicit Numbering(std::vector<int> master);

  int unknown(int entry) const { return unknown_[entry]; }   ///< -1: prescribed
  int unknowns() const { return unknowns_; }
  int entries() const { return static_cast<int>(unknown_.size()); }

 private:
  std::vector<int> unknown_;
  int unknowns_ = 0;
};

}  // namespace snug::solver
