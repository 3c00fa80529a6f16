// Which of many are one: nodes after sewing, pieces that hang together.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace snug::fem {

/// Disjoint sets of nodes; the representative of a set is its smallest number.
class UnionFind {
 public:
  explicit UnionFind(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }

  int find(int node) {
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
  }
  void merge(int a, int b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  /// Representative of every node.
  std::vector<int> representatives() {
    std::vector<int> result(parent_.size());
    for (std::size_t n = 0; n < result.size(); ++n) result[n] = find(static_cast<int>(n));
    return result;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace snug::fem
