// Which vertices are in contact: the active set of a semismooth Newton method.
#pragma once

#include <vector>

namespace snug::solver {

/// Block principal pivoting (Judice & Pires, Computers & Operations Research 21 (1994)): all vertices on the wrong side
/// change at once as long as their number falls. When it has not for some iterations the sets go in circles, which the
/// hats' full coupling allows; then only the last of them changes, which ends for every positive definite problem
/// (Murty, Linear Algebra and its Applications 7 (1974)), until the number has fallen.
class ActiveSet {
 public:
  explicit ActiveSet(int vertices) : flags_(vertices, 0) {}

  /// Before an increment: the count of the vertices on the wrong side starts anew.
  void begin();
  /// Changes towards the decisions of an iterate, one flag a vertex.
  void follow(const std::vector<char>& decided);

  bool operator[](int vertex) const { return flags_[vertex]; }
  const std::vector<char>& flags() const { return flags_; }
  /// Vertices on the wrong side at the last decision.
  int changed() const { return changed_; }

 private:
  std::vector<char> flags_;
  int changed_ = 0, fewest_wrong_ = 0, patience_ = 0;
};

}  // namespace snug::solver
