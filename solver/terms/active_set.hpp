// Which vertices are in contact: the active set of a semismooth Newton method.
#pragma once

#include <vector>

namespace snug::solver {

/// Block principal pivoting (Judice & Pires, Computers & Operations Research 21 (1994)): all vertices on the wrong side
/// change at once as long as their number falls. When it has not for some iterations the sets go in circles, which the
/// hats' full coupling allows; then only those change that are wrong by at least a share of the worst, so that small errors
/// beside it, which its change may mend, do not come and go with it. The worst one is always among them. Where that does
/// not help for long, the last one alone changes, which ends for every positive definite problem (Murty, Linear Algebra
/// and its Applications 7 (1974)).
class ActiveSet {
 public:
  explicit ActiveSet(int vertices) : flags_(vertices, 0) {}

  /// Before an increment: the count of the vertices on the wrong side starts anew.
  void begin();
  /// Changes towards the trials of an iterate, one a vertex: positive in contact; any unit, the same for all.
  void follow(const std::vector<double>& trials);

  /// As it was left by a `follow`; one flag a vertex.
  void set(const std::vector<char>& flags) { flags_ = flags; }

  bool operator[](int vertex) const { return flags_[vertex]; }
  const std::vector<char>& flags() const { return flags_; }
  /// Vertices on the wrong side at the last decision.
  int changed() const { return changed_; }

 private:
  std::vector<char> flags_;
  int changed_ = 0, fewest_wrong_ = 0, waited_ = 0;
};

}  // namespace snug::solver
