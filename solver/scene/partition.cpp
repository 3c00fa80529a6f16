#include "solver/scene/partition.hpp"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <limits>
#include <map>

#include "solver/terms/pressure_unknowns.hpp"

namespace snug::solver {

namespace {

// Elements that share a node are neighbours; METIS cuts as few of the pairs as it can.
template <class Elements>
std::vector<int> share_out(const Elements& elements, int nodes, int ranks) {
  std::vector<std::vector<int>> at(nodes);
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const int node : elements[e]) at[node].push_back(static_cast<int>(e));
  if (elements.empty()) return {};
  dealii::DynamicSparsityPattern pairs(elements.size(), elements.size());
  for (const auto& around : at)
    for (const int e : around)
      for (const int f : around) pairs.add(e, f);
  dealii::SparsityPattern pattern;
  pattern.copy_from(pairs);
  std::vector<unsigned int> part(elements.size());
  dealii::SparsityTools::partition(pattern, ranks, part, dealii::SparsityTools::Partitioner::metis);
  return {part.begin(), part.end()};
}

// The rank of a cell at the facet.
std::vector<int> facet_ranks(const mesh::BodyMesh& body, const std::vector<int>& cell_rank) {
  std::map<int, int> rank_of_node;
  for (std::size_t c = 0; c < body.cells.size(); ++c)
    for (const int node : body.cells[c]) rank_of_node.try_emplace(node, cell_rank[c]);
  std::vector<int> rank;
  for (const auto& facet : body.skin_facets) rank.push_back(rank_of_node.at(facet[0]));
  return rank;
}

std::vector<int> triangle_ranks_by_facet(const mesh::BodyMesh& body, const mesh::GarmentMesh& garment,
                                         const std::vector<int>& facet_rank) {
  std::vector<int> rank;
  for (const auto& triangle : garment.triangles) {
    const Eigen::Vector3d centre =
        (garment.placed[triangle[3]] + garment.placed[triangle[4]] + garment.placed[triangle[5]]) / 3.0;
    double nearest = std::numeric_limits<double>::max();
    int found = 0;
    for (std::size_t f = 0; f < body.skin_facets.size(); ++f)
      if (const double d = (body.nodes[body.skin_facets[f][0]] - centre).squaredNorm(); d < nearest)
        nearest = d, found = facet_rank[f];
    rank.push_back(found);
  }
  return rank;
}

std::vector<std::array<int, 6>> sewn(const mesh::GarmentMesh& garment) {
  auto triangles = garment.triangles;
  for (auto& triangle : triangles)
    for (int& node : triangle) node = garment.merged[node];
  return triangles;
}

template <class Elements>
void lowest(const Elements& elements, const std::vector<int>& rank, std::vector<int>& owner) {
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const int node : elements[e]) owner[node] = std::min(owner[node], rank[e]);
}

}  // namespace

std::vector<int> entry_owners(const Layout& layout, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment,
                              const std::vector<int>& node_of_multiplier, int ranks) {
  std::vector<int> owner(layout.size(), 0);
  if (ranks == 1) return owner;
  const auto triangles = sewn(garment);
  std::vector<int> body_owner(layout["body"].count, ranks - 1), garment_owner(layout["garment"].count, ranks - 1);
  std::vector<int> triangle_rank;
  if (layout["body"].count > 0) {
    if (!body.shell.empty()) {
      std::vector<std::array<int, 6>> shell(body.shell.size());
      for (std::size_t t = 0; t < shell.size(); ++t) std::copy_n(body.shell[t].nodes.begin(), 6, shell[t].begin());
      lowest(shell, share_out(shell, layout["body"].count, ranks), body_owner);
    }
    const std::vector<int> cell_rank = share_out(body.cells, layout["body"].count, ranks);
    lowest(body.cells, cell_rank, body_owner);
    std::vector<int> pressure_owner(layout["body pressure"].count, ranks - 1);
    lowest(pressure_unknowns(body).of_cell, cell_rank, pressure_owner);
    for (int i = 0; i < layout["body pressure"].count; ++i) owner[layout["body pressure"](i)] = pressure_owner[i];
    if (!garment.triangles.empty()) triangle_rank = triangle_ranks_by_facet(body, garment, facet_ranks(body, cell_rank));
  } else {
    triangle_rank = share_out(triangles, layout["garment"].count, ranks);
  }
  lowest(triangles, triangle_rank, garment_owner);
  for (int node = 0; node < layout["body"].count; ++node)
    for (int c = 0; c < 3; ++c) owner[layout["body"](node, c)] = body_owner[node];
  for (int node = 0; node < layout["garment"].count; ++node)
    for (int c = 0; c < 3; ++c) owner[layout["garment"](node, c)] = garment_owner[node];
  for (int i = 0; i < layout["contact"].count; ++i) owner[layout["contact"](i)] = garment_owner[node_of_multiplier[i]];
  return owner;
}

}  // namespace snug::solver
