// In which order unknowns are eliminated: nested dissection of the graph of nodes by METIS.
#pragma once

#include <vector>

#include "solver/algebra/own_rows.hpp"

namespace snug::solver {

/// The place of every unknown in the order of elimination, from 1 on, as MUMPS takes it; on the first rank, empty on others. Each
/// rank gives the rows that it owns, and all call it together. Neighbouring unknowns of one pattern (the components of a node) are
/// one vertex of the graph, of their number's weight. Empty as well where METIS does not give a permutation.
/// Source: Karypis & Kumar, SIAM J. Sci. Comput. 20 (1998) 359-392.
std::vector<int> nested_dissection(const RowPattern& rows);

/// The vertices of that graph: the first unknown of each, from 0 on, and the number of unknowns at the end; on all ranks.
std::vector<int> vertex_starts(const RowPattern& rows);

}  // namespace snug::solver
