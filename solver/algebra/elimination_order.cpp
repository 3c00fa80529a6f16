#include "solver/algebra/elimination_order.hpp"

#include <metis.h>
#include <mpi.h>

#include <algorithm>
#include <numeric>

#include "solver/algebra/communicator.hpp"

namespace snug::solver {

namespace {

/// A graph in METIS' form; of the rows of one rank, or of all.
struct Graph {
  std::vector<idx_t> offsets = {0}, neighbours, weights;
};

/// Vertex of each unknown: `vertex_of` of all unknowns, the first row of each own vertex.
struct Vertices {
  std::vector<int> vertex_of, first_row;
};

std::vector<int> gathered(const std::vector<int>& mine, int root) {
  const int size = static_cast<int>(mine.size());
  std::vector<int> count(ranks()), offset(ranks());
  MPI_Allgather(&size, 1, MPI_INT, count.data(), 1, MPI_INT, MPI_COMM_WORLD);
  std::exclusive_scan(count.begin(), count.end(), offset.begin(), 0);
  std::vector<int> all(root < 0 || root == rank() ? offset.back() + count.back() : 0);
  if (root < 0)
    MPI_Allgatherv(mine.data(), size, MPI_INT, all.data(), count.data(), offset.data(), MPI_INT, MPI_COMM_WORLD);
  else
    MPI_Gatherv(mine.data(), size, MPI_INT, all.data(), count.data(), offset.data(), MPI_INT, root, MPI_COMM_WORLD);
  return all;
}

Vertices vertices_of(const RowPattern& rows) {
  Vertices v;
  std::vector<int> mine(rows.count);
  for (int i = 0; i < rows.count; ++i) {
    if (i == 0 || !std::ranges::equal(rows.row(i), rows.row(i - 1))) v.first_row.push_back(i);
    mine[i] = static_cast<int>(v.first_row.size()) - 1;
  }
  if (ranks() == 1) {
    v.vertex_of = std::move(mine);
    return v;
  }
  const int count = static_cast<int>(v.first_row.size());
  int before = 0;
  MPI_Exscan(&count, &before, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  for (int& vertex : mine) vertex += rank() == 0 ? 0 : before;
  v.vertex_of = gathered(mine, -1);
  return v;
}

Graph graph_of(const RowPattern& rows, const Vertices& vertices) {
  Graph graph;
  for (std::size_t g = 0; g < vertices.first_row.size(); ++g) {
    const int first = vertices.first_row[g];
    const int end = g + 1 < vertices.first_row.size() ? vertices.first_row[g + 1] : rows.count;
    const int self = vertices.vertex_of[rows.first + first];
    // columns are sorted and vertices numbered along them: the same one comes in a row
    int last = -1;
    for (const int column : rows.row(first)) {
      const int vertex = vertices.vertex_of[column];
      if (vertex != self && vertex != last) graph.neighbours.push_back(vertex);
      last = vertex;
    }
    graph.offsets.push_back(static_cast<idx_t>(graph.neighbours.size()));
    graph.weights.push_back(end - first);
  }
  return graph;
}

/// The whole graph on the first rank.
Graph gathered(const Graph& mine) {
  if (ranks() == 1) return mine;
  std::vector<int> degrees(mine.weights.size());
  for (std::size_t v = 0; v < degrees.size(); ++v) degrees[v] = mine.offsets[v + 1] - mine.offsets[v];
  Graph all;
  all.weights = gathered(mine.weights, 0);
  all.neighbours = gathered(mine.neighbours, 0);
  degrees = gathered(degrees, 0);
  all.offsets.resize(degrees.size() + 1);
  std::inclusive_scan(degrees.begin(), degrees.end(), all.offsets.begin() + 1);
  return all;
}

bool is_permutation_of_all(const std::vector<idx_t>& order) {
  std::vector<char> seen(order.size(), 0);
  return std::ranges::all_of(order, [&](idx_t v) {
    return v >= 0 && static_cast<std::size_t>(v) < seen.size() && !std::exchange(seen[v], 1);
  });
}

/// Vertices in the order of elimination; empty where METIS fails.
std::vector<idx_t> dissect(Graph& graph) {
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_COMPRESS] = 0;  // done
  options[METIS_OPTION_SEED] = 7;      // the same order every time
  idx_t count = static_cast<idx_t>(graph.weights.size());
  std::vector<idx_t> order(count), place(count);
  const int status = METIS_NodeND(&count, graph.offsets.data(), graph.neighbours.data(), graph.weights.data(), options,
                                  order.data(), place.data());
  // with several tries a separator, 5.1.0 has returned what is no permutation, with a good status
  return status == METIS_OK && is_permutation_of_all(order) ? order : std::vector<idx_t>{};
}

}  // namespace

std::vector<int> nested_dissection(const RowPattern& rows) {
  const Vertices vertices = vertices_of(rows);
  Graph graph = gathered(graph_of(rows, vertices));
  if (rank() != 0) return {};
  const std::vector<idx_t> order = dissect(graph);
  if (order.empty()) return {};
  std::vector<int> start(graph.weights.size());  // place of a vertex' first unknown
  int next = 1;
  for (const idx_t vertex : order) {
    start[vertex] = next;
    next += graph.weights[vertex];
  }
  std::vector<int> place(rows.unknowns);
  for (int u = 0; u < rows.unknowns; ++u) place[u] = start[vertices.vertex_of[u]]++;
  return place;
}

std::vector<int> vertex_starts(const RowPattern& rows) {
  const std::vector<int> vertex_of = vertices_of(rows).vertex_of;
  std::vector<int> starts;
  for (int u = 0; u < rows.unknowns; ++u)
    if (u == 0 || vertex_of[u] != vertex_of[u - 1]) starts.push_back(u);
  starts.push_back(rows.unknowns);
  return starts;
}

}  // namespace snug::solver
