#include "solver/fem/partition.hpp"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <map>

namespace snug::fem {

std::vector<int> partition(const std::vector<std::vector<int>>& nodes, int parts) {
  if (nodes.empty()) return {};
  std::map<int, std::vector<int>> elements_at;
  for (std::size_t e = 0; e < nodes.size(); ++e)
    for (const int node : nodes[e]) elements_at[node].push_back(static_cast<int>(e));
  dealii::DynamicSparsityPattern pairs(nodes.size(), nodes.size());
  for (const auto& [node, around] : elements_at)
    for (const int e : around)
      for (const int f : around) pairs.add(e, f);
  dealii::SparsityPattern pattern;
  pattern.copy_from(pairs);
  std::vector<unsigned int> part(nodes.size());
  dealii::SparsityTools::partition(pattern, parts, part, dealii::SparsityTools::Partitioner::metis);
  return {part.begin(), part.end()};
}

}  // namespace snug::fem
