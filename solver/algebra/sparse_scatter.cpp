#include "solver/algebra/sparse_scatter.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace snug::solver {

void SparseScatter::collect_touches(const Numbering& numbering, const std::vector<const ElementEntries*>& groups) {
  groups_.assign(groups.size(), {});
  touch_offset_.assign(rows() + 1, 0);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    Group& group = groups_[g];
    group.row_offset = groups[g]->offset;
    group.row.resize(groups[g]->entry.size());
    group.offset.assign(1, 0);
    group.touched.assign(groups[g]->elements(), 0);
    for (int e = 0; e < groups[g]->elements(); ++e) {
      const auto entries = groups[g]->of(e);
      for (std::size_t i = 0; i < entries.size(); ++i) {
        const int unknown = numbering.unknown(entries[i]);
        const bool ours = unknown >= first_row_ && unknown < end_row_;
        group.row[group.row_offset[e] + i] = ours ? unknown - first_row_ : -1;
        if (!ours) continue;
        ++touch_offset_[unknown - first_row_ + 1];
        group.touched[e] = 1;
      }
      group.offset.push_back(group.offset.back() + (group.touched[e] ? entries.size() * entries.size() : 0));
    }
    group.position.assign(group.offset.back(), -1);
  }
  for (int r = 0; r < rows(); ++r) touch_offset_[r + 1] += touch_offset_[r];
  touch_.resize(touch_offset_.back());
  std::vector<int> next(touch_offset_.begin(), touch_offset_.end() - 1);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (int e = 0; e < groups[g]->elements(); ++e)
      for (int i = groups_[g].row_offset[e]; i < groups_[g].row_offset[e + 1]; ++i)
        if (const int row = groups_[g].row[i]; row >= 0)
          touch_[next[row]++] = {static_cast<int>(g), e, i - groups_[g].row_offset[e]};
}

void SparseScatter::collect_folds(const Numbering& numbering, const ElementEntries& entries, Group& group) {
  group.folds.clear(), group.fold_offset.clear();
  if (numbering.bound().empty()) return;
  group.fold_offset.assign(1, 0);
  for (int e = 0; e < entries.elements(); ++e) {
    const auto own = entries.of(e);
    for (std::size_t i = 0; i < own.size(); ++i) {
      const auto bound = numbering.bound().find(own[i]);
      if (bound == numbering.bound().end()) continue;
      for (const Follow& follow : bound->second) {
        const auto to = std::find(own.begin(), own.end(), follow.entry);
        if (to == own.end()) throw std::logic_error("an entry is bound to one that its element does not have");
        group.folds.push_back({static_cast<int>(i), static_cast<int>(to - own.begin()), follow.weight});
      }
    }
    group.fold_offset.push_back(group.folds.size());
  }
}

void SparseScatter::fill_row(int row, const std::vector<const ElementEntries*>& groups, const Numbering& numbering,
                             std::vector<int>& where) {
  const std::size_t begin = column_.size();
  for (int t = touch_offset_[row]; t < touch_offset_[row + 1]; ++t)
    for (const int entry : groups[touch_[t].group]->of(touch_[t].element))
      if (const int column = numbering.unknown(entry); column >= 0 && where[column] < static_cast<int>(begin)) {
        where[column] = static_cast<int>(begin);
        column_.push_back(column);
      }
  std::sort(column_.begin() + begin, column_.end());
  for (std::size_t k = begin; k < column_.size(); ++k) where[column_[k]] = static_cast<int>(k);
  diagonal_[row] = where[row + first_row_];
  for (int t = touch_offset_[row]; t < touch_offset_[row + 1]; ++t) {
    const auto entries = groups[touch_[t].group]->of(touch_[t].element);
    Group& group = groups_[touch_[t].group];
    int* position = group.position.data() + group.offset[touch_[t].element] + touch_[t].local * entries.size();
    for (std::size_t j = 0; j < entries.size(); ++j) {
      const int column = numbering.unknown(entries[j]);
      position[j] = column < 0 ? -1 : where[column];
    }
  }
  row_offset_.push_back(static_cast<int>(column_.size()));
}

void SparseScatter::build(const Numbering& numbering, const std::vector<const ElementEntries*>& groups, int first_row,
                          int end_row) {
  first_row_ = first_row;
  end_row_ = end_row;
  collect_touches(numbering, groups);
  for (std::size_t g = 0; g < groups.size(); ++g) collect_folds(numbering, *groups[g], groups_[g]);
  row_offset_.assign(1, 0);
  column_.clear();
  diagonal_.assign(rows(), -1);
  std::vector<int> where(numbering.unknowns(), -1);  // position of a column in the row being filled
  for (int row = 0; row < rows(); ++row) fill_row(row, groups, numbering, where);
  value_.assign(column_.size(), 0.0);
  residual_ = condensed_ = Eigen::VectorXd::Zero(rows());
}

void SparseScatter::zero() {
  std::fill(value_.begin(), value_.end(), 0.0);
  residual_.setZero();
  condensed_.setZero();
}

void SparseScatter::add(int group_index, int element, std::span<const double> residual, std::span<const double> matrix) {
  const Group& group = groups_[group_index];
  if (!group.touched[element]) return;
  const bool bound = !group.fold_offset.empty() && group.fold_offset[element] != group.fold_offset[element + 1];
  if (!bound) return add_unfolded(group, element, residual, matrix);
  std::vector<double> force(residual.begin(), residual.end()), stiffness(matrix.begin(), matrix.end());
  const std::size_t n = residual.size();
  for (std::size_t f = group.fold_offset[element]; f < group.fold_offset[element + 1]; ++f) {
    const auto& [from, to, weight] = group.folds[f];
    force[to] += weight * force[from];
    if (matrix.empty()) continue;
    for (std::size_t k = 0; k < n; ++k) stiffness[to * n + k] += weight * stiffness[from * n + k];
    for (std::size_t k = 0; k < n; ++k) stiffness[k * n + to] += weight * stiffness[k * n + from];
  }
  add_unfolded(group, element, force, stiffness);
}

void SparseScatter::add_unfolded(const Group& group, int element, std::span<const double> residual,
                                 std::span<const double> matrix) {
  const int* row = group.row.data() + group.row_offset[element];
  const int n = group.row_offset[element + 1] - group.row_offset[element];
  for (int i = 0; i < n; ++i)
    if (row[i] >= 0) residual_[row[i]] += residual[i];
  if (matrix.empty()) return;
  const int* position = group.position.data() + group.offset[element];
  for (std::size_t k = 0; k < matrix.size(); ++k)
    if (position[k] >= 0) value_[position[k]] += matrix[k];
}

void SparseScatter::add_condensed(int group_index, int element, std::span<const double> values) {
  const Group& group = groups_[group_index];
  if (!group.touched[element]) return;
  const int* row = group.row.data() + group.row_offset[element];
  for (std::size_t i = 0; i < values.size(); ++i)
    if (row[i] >= 0) condensed_[row[i]] += values[i];
}

void SparseScatter::add_diagonal(const Eigen::VectorXd& values) {
  for (int row = 0; row < rows(); ++row)
    if (diagonal_[row] >= 0) value_[diagonal_[row]] += values[row];
}

double SparseScatter::squared_diagonal() const {
  double sum = 0.0;
  for (const int position : diagonal_)
    if (position >= 0) sum += value_[position] * value_[position];
  return sum;
}

Eigen::VectorXd SparseScatter::diagonal() const {
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(rows());
  for (int row = 0; row < rows(); ++row)
    if (diagonal_[row] >= 0) diagonal[row] = value_[diagonal_[row]];
  return diagonal;
}

Eigen::VectorXd SparseScatter::largest_in_rows(const Eigen::VectorXd& D) const {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(rows());
  for (int row = 0; row < rows(); ++row)
    for (int k = row_offset_[row]; k < row_offset_[row + 1]; ++k)
      largest[row] = std::max(largest[row], std::abs(value_[k] * D[column_[k]]));
  return largest;
}

void SparseScatter::scale(const Eigen::VectorXd& D) {
  for (int row = 0; row < rows(); ++row) {
    const double d = D[first_row_ + row];
    for (int k = row_offset_[row]; k < row_offset_[row + 1]; ++k) value_[k] *= d * D[column_[k]];
  }
}

}  // namespace snug::solver
