// In which order unknowns are eliminated: nested dissection of the graph of nodes by METIS.
#pragma once

#include <span>
#include <vector>

namespace snug::solver {

/// Rows [first, first + count) of a square matrix of a symmetric pattern in compressed rows, sorted, columns of the whole matrix.
struct RowPattern {
  int first = 0, count = 0, unknowns = 0;
  const int* offsets = nullptr;
  const int* columns = nullptr;
  std::span<const int> row(int i) const { return {columns + offsets[i], static_cast<std::size_t>(offsets[i + 1] - offsets[i])}; }
};

/// The place of every unknown in the order of elimination, from 1 on, as MUMPS takes it; on the first rank, empty on others. Each
/// rank gives the rows that it owns, and all call it together. Neighbouring unknowns of one pattern (the components of a node) are
/// one vertex of the graph, of their number's weight. Empty as well where METIS does not give a permutation.
/// Source: Karypis & Kumar, SIAM J. Sci. Comput. 20 (1998) 359-392.
std::vector<int> nested_dissection(const RowPattern& rows);

}  // namespace snug::solver
