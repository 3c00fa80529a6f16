// Element matrices into a compressed-row matrix by precomputed positions (MatSetValues costs more than the kernels).
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "solver/algebra/numbering.hpp"

namespace snug::solver {

/// The entries of the state vector that each element of a term couples, as a jagged array.
struct ElementEntries {
  std::vector<int> offset = {0};
  std::vector<int> entry;
  int elements() const { return static_cast<int>(offset.size()) - 1; }
  std::span<const int> of(int element) const {
    return {entry.data() + offset[element], static_cast<std::size_t>(offset[element + 1] - offset[element])};
  }
  void push(std::span<const int> entries) {
    entry.insert(entry.end(), entries.begin(), entries.end());
    offset.push_back(static_cast<int>(entry.size()));
  }
};

/// Rows [first_row, end_row) of the matrix, which this rank owns; columns are global unknowns. Entries that the numbering
/// binds to others of the same element are eliminated there: C^T K C, so that a symmetric matrix stays symmetric.
class SparseScatter {
 public:
  /// Builds the pattern of all groups (one a term). Elements that touch no owned row are skipped.
  void build(const Numbering& numbering, const std::vector<const ElementEntries*>& groups, int first_row, int end_row);

  void zero();
  /// Adds a dense element residual (n) and, when not empty, its matrix (n x n, row-major).
  void add(int group, int element, std::span<const double> residual, std::span<const double> matrix);
  /// Adds an element's share (n) of the condensed right side.
  void add_condensed(int group, int element, std::span<const double> values);
  /// True where the element touches an owned row.
  bool touches(int group, int element) const { return groups_[group].touched[element] != 0; }
  /// Adds to the diagonal, one value an unknown of the owned rows.
  void add_diagonal(const Eigen::VectorXd& values);

  /// Sum of the squared diagonal entries of the owned rows.
  double squared_diagonal() const;
  /// The diagonal of the owned rows, 0 where there is none.
  Eigen::VectorXd diagonal() const;
  /// max_j |A_ij D_jj| of the owned rows.
  Eigen::VectorXd largest_in_rows(const Eigen::VectorXd& D) const;
  /// D A D with D of all unknowns.
  void scale(const Eigen::VectorXd& D);

  int rows() const { return end_row_ - first_row_; }
  int first_row() const { return first_row_; }
  const std::vector<int>& row_offsets() const { return row_offset_; }
  const std::vector<int>& columns() const { return column_; }
  const std::vector<double>& values() const { return value_; }
  std::vector<double>& values() { return value_; }
  const Eigen::VectorXd& residual() const { return residual_; }
  const Eigen::VectorXd& condensed() const { return condensed_; }

 private:
  /// A local entry of an element that is bound: what acts on it goes to another local entry, times the weight.
  struct Fold { int from, to; double weight; };
  struct Group {
    std::vector<std::size_t> offset;  ///< of the element's positions
    std::vector<int> position;        ///< n x n positions in `value_`, -1: not ours
    std::vector<int> row_offset;      ///< of the element's rows
    std::vector<int> row;             ///< n local rows, -1: not ours
    std::vector<char> touched;        ///< one an element: some row is ours
    std::vector<std::size_t> fold_offset;  ///< of the element's folds; empty where the numbering binds nothing
    std::vector<Fold> folds;
  };
  struct Touch { int group, element, local; };
  void collect_folds(const Numbering& numbering, const ElementEntries& entries, Group& group);
  void add_unfolded(const Group& group, int element, std::span<const double> residual, std::span<const double> matrix);
  void collect_touches(const Numbering& numbering, const std::vector<const ElementEntries*>& groups);
  void fill_row(int row, const std::vector<const ElementEntries*>& groups, const Numbering& numbering,
                std::vector<int>& where);

  int first_row_ = 0, end_row_ = 0;
  std::vector<int> row_offset_, column_;
  std::vector<double> value_;
  Eigen::VectorXd residual_, condensed_;
  std::vector<int> diagonal_;
  std::vector<Group> groups_;
  std::vector<int> touch_offset_;
  std::vector<Touch> touch_;
};

}  // namespace snug::solver
