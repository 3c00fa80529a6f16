// From entries of the state vector to unknowns of the linear system.
#pragma once

#include <Eigen/Core>

#include <utility>
#include <vector>

#include "solver/fem/constraints.hpp"

namespace snug::solver {

using fem::Follow;
/// Entries that are bound to others: their step is the weighted sum of those others' steps, which have unknowns or none.
using Bound = fem::Lines;

/// Prescribed entries have no unknown; sewn entries share one; bound entries have none of their own. Each rank owns a
/// contiguous range of unknowns.
class Numbering {
 public:
  Numbering() = default;
  /// `master[i]` is the entry that entry i follows (itself when free), or -1 when it is prescribed
  /// or bound.
  /// `bound` is resolved (see scene/constraint_table). `owner[i]` is the rank of entry i (that of its master counts); without owners all unknowns are those of rank 0.
  explicit Numbering(std::vector<int> master, const std::vector<int>& owner = {}, int ranks = 1, Bound bound = {});

  int unknown(int entry) const { return unknown_[entry]; }   ///< -1: prescribed or bound
  const Bound& bound() const { return bound_; }
  int unknowns() const { return unknowns_; }
  int entries() const { return static_cast<int>(unknown_.size()); }
  /// First and end unknown of a rank.
  std::pair<int, int> owned(int rank) const { return {first_[rank], first_[rank + 1]}; }

  /// Adds what acts on bound entries to those that they follow (C^T f), and sets it to zero there.
  void fold(Eigen::VectorXd& forces) const;
  /// Adds what they follow to the bound entries of a step (C u), which have there what they go by themselves.
  void spread(Eigen::VectorXd& step) const;

 private:
  std::vector<int> unknown_, first_ = {0, 0};
  Bound bound_;
  int unknowns_ = 0;
};

}  // namespace snug::solver
