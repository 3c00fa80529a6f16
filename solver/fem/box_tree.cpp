#include "solver/fem/box_tree.hpp"

#include <deal.II/numerics/rtree.h>

#include <iterator>
#include <utility>

namespace snug::fem {

namespace {

dealii::Point<3> to_point(const Eigen::Vector3d& x) { return {x.x(), x.y(), x.z()}; }

using Entry = std::pair<dealii::BoundingBox<3>, int>;

}  // namespace

struct BoxTree::Tree {
  dealii::RTree<Entry> boxes;
};

BoxTree::BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes) {
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    entries.emplace_back(dealii::BoundingBox<3>({to_point(boxes[i].min()), to_point(boxes[i].max())}), static_cast<int>(i));
  tree_ = std::make_unique<Tree>(Tree{dealii::pack_rtree(entries)});
}
BoxTree::~BoxTree() = default;
BoxTree::BoxTree(BoxTree&&) noexcept = default;

std::vector<int> BoxTree::nearest(const Eigen::Vector3d& x, int count) const {
  std::vector<Entry> near;
  tree_->boxes.query(boost::geometry::index::nearest(to_point(x), static_cast<unsigned int>(count)), std::back_inserter(near));
  std::vector<int> numbers;
  for (const Entry& entry : near) numbers.push_back(entry.second);
  return numbers;
}

}  // namespace snug::fem
