#include "solver/fem/constraints.hpp"

#include <deal.II/lac/affine_constraints.h>

namespace snug::fem {

Lines closed(const Lines& lines) {
  dealii::AffineConstraints<double> theirs;
  for (const auto& [entry, followed] : lines) {
    theirs.add_line(entry);
    for (const Follow& other : followed) theirs.add_entry(entry, other.entry, other.weight);
  }
  theirs.close();
  Lines resolved;
  for (const auto& [entry, followed] : lines) {
    auto& line = resolved[entry];
    for (const auto& [other, weight] : *theirs.get_constraint_entries(entry)) line.push_back({static_cast<int>(other), weight});
  }
  return resolved;
}

}  // namespace snug::fem
