#include "solver/algebra/own_rows.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace snug::solver {

namespace {

void multiply_one(const OwnRows& rows, int row, const double* x, double* product) {
  double sum = 0.0;
  for (int k = rows.pattern.offsets[row]; k < rows.pattern.offsets[row + 1]; ++k) sum += rows.values[k] * x[rows.pattern.columns[k]];
  product[row] = sum;
}

// Of the same columns, as those of a node: a column is read once.
void multiply_three(const OwnRows& rows, int row, const double* x, double* product) {
  const auto columns = rows.pattern.row(row);
  const double *a = rows.values + rows.pattern.offsets[row], *b = a + columns.size(), *c = b + columns.size();
  double sums[3] = {0.0, 0.0, 0.0};
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const double factor = x[columns[k]];
    sums[0] += a[k] * factor, sums[1] += b[k] * factor, sums[2] += c[k] * factor;
  }
  for (int i = 0; i < 3; ++i) product[row + i] = sums[i];
}

}  // namespace

void multiply(const OwnRows& rows, const double* x, double* product) {
  tbb::parallel_for(tbb::blocked_range<int>(0, rows.pattern.count, 3000), [&](const tbb::blocked_range<int>& part) {
    for (int row = part.begin(); row < part.end();) {
      const bool three = row + 2 < part.end() && rows.like_before[row + 1] && rows.like_before[row + 2];
      if (three) multiply_three(rows, row, x, product);
      else multiply_one(rows, row, x, product);
      row += three ? 3 : 1;
    }
  });
}

}  // namespace snug::solver
