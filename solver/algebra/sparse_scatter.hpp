// Element matrices into a compressed-row matrix by precomputed positions (MatSetValues costs more than the kernels).
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "solver/algebra/numbering.hpp"
#include "solver/algebra/own_rows.hpp"

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
  bool touches(int group, int element) const { return groups_[group].size[element] != 0; }
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
  /// Good until the next `build`.
  OwnRows own_rows() const {
    return {{first_row_, rows(), unknowns_, row_offset_.data(), column_.data()}, value_.data(), like_before_.data()};
  }
  const Eigen::VectorXd& residual() const { return residual_; }
  const Eigen::VectorXd& condensed() const { return condensed_; }

 private:
  /// A local entry of an element that is bound: what acts on it goes to another local entry, times the weight.
  struct Fold { int from, to; double weight; };
  /// Local entries of an element whose unknowns follow one another, as those of a node do: they stand side by side in every row
  /// of the element. Where their rows are ours these have the same columns, so that one place a run tells those of all.
  struct Run {
    int local, length;
    int row;      ///< local row of the first, -1: not ours
    int unknown;  ///< of the first, -1: none
  };
  struct Group {
    std::vector<std::size_t> run_offset;    ///< of the element's runs
    std::vector<Run> runs;
    std::vector<std::size_t> place_offset;  ///< of the element's places
    std::vector<int> places;                ///< (own runs) x (runs): where a run begins in a row, -1: it has no columns
    std::vector<int> size;                  ///< entries of an element; 0: none of its rows is ours
    std::vector<std::size_t> fold_offset;   ///< of the element's folds; empty where the numbering binds nothing
    std::vector<Fold> folds;

    std::span<const Run> runs_of(int element) const { return {runs.data() + run_offset[element], run_offset[element + 1] - run_offset[element]}; }
  };
  struct Touch {
    int group, element;
    bool operator==(const Touch&) const = default;
  };
  /// The elements of each row, as a jagged array.
  struct Touches {
    std::vector<int> offset;
    std::vector<Touch> list;
    std::span<const Touch> of(int row) const { return {list.data() + offset[row], static_cast<std::size_t>(offset[row + 1] - offset[row])}; }
  };
  void collect_folds(const Numbering& numbering, const ElementEntries& entries, Group& group);
  Touches collect_touches(const Numbering& numbering, const std::vector<const ElementEntries*>& groups) const;
  /// Columns of all rows.
  void fill_columns(const Numbering& numbering, const std::vector<const ElementEntries*>& groups);
  void place(const Numbering& numbering, const ElementEntries& entries, Group& group) const;
  void place_runs(std::size_t first, Group& group) const;
  void add_unfolded(const Group& group, int element, std::span<const double> residual, std::span<const double> matrix);
  void add_row(int row, std::span<const Run> runs, const int* places, const double* given);
  void add_three_rows(int row, std::span<const Run> runs, const int* places, const double* given, int n);

  int first_row_ = 0, end_row_ = 0, unknowns_ = 0;
  std::vector<int> row_offset_, column_;
  std::vector<char> like_before_;  ///< rows that have the columns of the one before them
  std::vector<double> value_;
  Eigen::VectorXd residual_, condensed_;
  std::vector<int> diagonal_;
  std::vector<Group> groups_;
};

}  // namespace snug::solver
