// The part of a distributed sparse matrix that one rank has: a view of compressed rows.
#pragma once

#include <cstddef>
#include <span>

namespace snug::solver {

/// Rows [first, first + count) of a square matrix of a symmetric pattern in compressed rows, sorted, columns of the whole matrix.
struct RowPattern {
  int first = 0, count = 0, unknowns = 0;
  const int* offsets = nullptr;
  const int* columns = nullptr;
  std::span<const int> row(int i) const { return {columns + offsets[i], static_cast<std::size_t>(offsets[i + 1] - offsets[i])}; }
};

struct OwnRows {
  RowPattern pattern;
  const double* values = nullptr;
  const char* like_before = nullptr;  ///< one a row: it has the columns of the one before it
};

/// Own rows times `x` of all unknowns, on all cores; a row's sum does not depend on their number.
void multiply(const OwnRows& rows, const double* x, double* product);

}  // namespace snug::solver
