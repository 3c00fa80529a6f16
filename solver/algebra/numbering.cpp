#include "solver/algebra/numbering.hpp"

namespace snug::solver {

Numbering::Numbering(std::vector<int> master) : unknown_(master.size(), -1) {
  for (std::size_t i = 0; i < master.size(); ++i)
    if (master[i] == static_cast<int>(i)) unknown_[i] = unknowns_++;
  for (std::size_t i = 0; i < master.size(); ++i)
    if (master[i] >= 0) unknown_[i] = unknown_[master[i]];
}

}  // namespace snug::solver
