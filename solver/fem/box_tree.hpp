// Boxes in space that a point asks for its nearest.
#pragma once

#include <Eigen/Geometry>

#include <memory>
#include <vector>

namespace snug::fem {

/// An R-tree (deal.II's, packed).
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes);
  ~BoxTree();
  BoxTree(BoxTree&&) noexcept;

  /// Numbers of the `count` boxes that are nearest to x, or of all where they are fewer; in no order.
  std::vector<int> nearest(const Eigen::Vector3d& x, int count) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace snug::fem
