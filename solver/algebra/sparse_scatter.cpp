#include "solver/algebra/sparse_scatter.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace snug::solver {

SparseScatter::Touches SparseScatter::collect_touches(const Numbering& numbering, const std::vector<const ElementEntries*>& groups) const {
  // each row once an element, however often the element names it
  std::vector<Touch> last(rows(), {-1, -1});
  const auto each = [&](const auto& take) {
    std::fill(last.begin(), last.end(), Touch{-1, -1});
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (int e = 0; e < groups[g]->elements(); ++e)
        for (const int entry : groups[g]->of(e)) {
          const int row = numbering.unknown(entry) - first_row_;
          const Touch touch{static_cast<int>(g), e};
          if (numbering.unknown(entry) < first_row_ || row >= rows() || last[row] == touch) continue;
          last[row] = touch;
          take(row, touch);
        }
  };
  Touches touches;
  touches.offset.assign(rows() + 1, 0);
  each([&](int row, Touch) { ++touches.offset[row + 1]; });
  for (int r = 0; r < rows(); ++r) touches.offset[r + 1] += touches.offset[r];
  touches.list.resize(touches.offset.back());
  std::vector<int> next(touches.offset.begin(), touches.offset.end() - 1);
  each([&](int row, Touch touch) { touches.list[next[row]++] = touch; });
  return touches;
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

void SparseScatter::fill_columns(const Numbering& numbering, const std::vector<const ElementEntries*>& groups) {
  const Touches touches = collect_touches(numbering, groups);
  like_before_.assign(rows(), 0);
  std::vector<int> seen(numbering.unknowns(), -1);  // the last row that has the column
  row_offset_.assign(1, 0);
  column_.clear();
  for (int row = 0; row < rows(); ++row) {
    const std::size_t begin = column_.size();
    if (row > 0 && std::ranges::equal(touches.of(row), touches.of(row - 1))) {
      like_before_[row] = 1;
      column_.resize(begin + (begin - row_offset_[row - 1]));
      std::copy(column_.begin() + row_offset_[row - 1], column_.begin() + begin, column_.begin() + begin);
    } else {
      for (const Touch& touch : touches.of(row))
        for (const int entry : groups[touch.group]->of(touch.element))
          if (const int column = numbering.unknown(entry); column >= 0 && seen[column] != row) seen[column] = row, column_.push_back(column);
      std::sort(column_.begin() + begin, column_.end());
    }
    row_offset_.push_back(static_cast<int>(column_.size()));
  }
  column_.shrink_to_fit();
}

void SparseScatter::place(const Numbering& numbering, const ElementEntries& entries, Group& group) const {
  group.run_offset.assign(1, 0), group.place_offset.assign(1, 0);
  group.size.assign(entries.elements(), 0);
  for (int e = 0; e < entries.elements(); ++e) {
    const auto own = entries.of(e);
    const std::size_t first = group.runs.size();
    for (std::size_t i = 0; i < own.size(); ++i) {
      const int unknown = numbering.unknown(own[i]), row = unknown - first_row_;
      const bool ours = unknown >= first_row_ && row < rows();
      if (ours) group.size[e] = static_cast<int>(own.size());
      const bool follows = group.runs.size() > first && [&] {
        const Run& run = group.runs.back();
        if ((run.row >= 0) != ours || (run.unknown >= 0) != (unknown >= 0)) return false;
        return unknown < 0 || (unknown == run.unknown + run.length && (!ours || like_before_[row]));
      }();
      if (follows) ++group.runs.back().length;
      else group.runs.push_back({static_cast<int>(i), 1, ours ? row : -1, unknown});
    }
    if (group.size[e] == 0) group.runs.resize(first);
    place_runs(first, group);
    group.run_offset.push_back(group.runs.size()), group.place_offset.push_back(group.places.size());
  }
  group.runs.shrink_to_fit(), group.places.shrink_to_fit();
}

void SparseScatter::place_runs(std::size_t first, Group& group) const {
  for (std::size_t r = first; r < group.runs.size(); ++r) {
    const int row = group.runs[r].row;
    if (row < 0) continue;
    const auto begin = column_.begin() + row_offset_[row], end = column_.begin() + row_offset_[row + 1];
    for (std::size_t c = first; c < group.runs.size(); ++c) {
      const int column = group.runs[c].unknown;
      group.places.push_back(column < 0 ? -1 : static_cast<int>(std::lower_bound(begin, end, column) - begin));
    }
  }
}

void SparseScatter::build(const Numbering& numbering, const std::vector<const ElementEntries*>& groups, int first_row,
                          int end_row) {
  first_row_ = first_row;
  end_row_ = end_row;
  unknowns_ = numbering.unknowns();
  value_ = {};  // before the new ones take their memory
  groups_.assign(groups.size(), {});
  fill_columns(numbering, groups);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    place(numbering, *groups[g], groups_[g]);
    collect_folds(numbering, *groups[g], groups_[g]);
  }
  diagonal_.assign(rows(), -1);
  for (int row = 0; row < rows(); ++row) {
    const auto begin = column_.begin() + row_offset_[row], end = column_.begin() + row_offset_[row + 1];
    const auto found = std::lower_bound(begin, end, first_row_ + row);
    if (found != end && *found == first_row_ + row) diagonal_[row] = static_cast<int>(found - column_.begin());
  }
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
  if (group.size[element] == 0) return;
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

// The places of an element lie all over the matrix, so that its time is that of memory: loops of fixed length leave the processor
// free to fetch many places at once.
void SparseScatter::add_unfolded(const Group& group, int element, std::span<const double> residual,
                                 std::span<const double> matrix) {
  const auto runs = group.runs_of(element);
  const int n = group.size[element];
  const int* places = group.places.data() + group.place_offset[element];
  for (const Run& to : runs) {
    if (to.row < 0) continue;
    for (int i = 0; i < to.length; ++i) residual_[to.row + i] += residual[to.local + i];
    if (!matrix.empty()) {
      const double* given = matrix.data() + static_cast<std::size_t>(to.local) * n;
      if (to.length == 3) add_three_rows(to.row, runs, places, given, n);
      else
        for (int i = 0; i < to.length; ++i) add_row(to.row + i, runs, places, given + static_cast<std::size_t>(i) * n);
    }
    places += runs.size();
  }
}

void SparseScatter::add_row(int row, std::span<const Run> runs, const int* places, const double* given) {
  double* values = value_.data() + row_offset_[row];
  for (std::size_t c = 0; c < runs.size(); ++c)
    if (places[c] >= 0)
      for (int k = 0; k < runs[c].length; ++k) values[places[c] + k] += given[runs[c].local + k];
}

// Of one run: they have the same columns.
void SparseScatter::add_three_rows(int row, std::span<const Run> runs, const int* places, const double* given, int n) {
  double* first = value_.data() + row_offset_[row];
  const int length = row_offset_[row + 1] - row_offset_[row];
  for (std::size_t c = 0; c < runs.size(); ++c) {
    if (places[c] < 0) continue;
    double *a = first + places[c], *b = a + length, *d = b + length;
    const double *x = given + runs[c].local, *y = x + n, *z = y + n;
    if (runs[c].length == 3)
      for (int k = 0; k < 3; ++k) a[k] += x[k], b[k] += y[k], d[k] += z[k];
    else
      for (int k = 0; k < runs[c].length; ++k) a[k] += x[k], b[k] += y[k], d[k] += z[k];
  }
}

void SparseScatter::add_condensed(int group_index, int element, std::span<const double> values) {
  const Group& group = groups_[group_index];
  if (group.size[element] == 0) return;
  std::vector<double> folded;
  if (!group.fold_offset.empty() && group.fold_offset[element] != group.fold_offset[element + 1]) {
    folded.assign(values.begin(), values.end());
    for (std::size_t f = group.fold_offset[element]; f < group.fold_offset[element + 1]; ++f) folded[group.folds[f].to] += group.folds[f].weight * folded[group.folds[f].from];
    values = folded;
  }
  for (const Run& to : group.runs_of(element))
    for (int i = 0; to.row >= 0 && i < to.length; ++i) condensed_[to.row + i] += values[to.local + i];
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
