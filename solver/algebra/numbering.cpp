#include "solver/algebra/numbering.hpp"

namespace snug::solver {

Numbering::Numbering(std::vector<int> master, const std::vector<int>& owner, int ranks)
    : unknown_(master.size(), -1), first_(1, 0) {
  for (int rank = 0; rank < ranks; ++rank) {
    for (std::size_t i = 0; i < master.size(); ++i)
      if (master[i] == static_cast<int>(i) && (owner.empty() || owner[i] == rank)) unknown_[i] = unknowns_++;
    first_.push_back(unknowns_);
  }
  for (std::size_t i = 0; i < master.size(); ++i)
    if (master[i] >= 0) unknown_[i] = unknown_[master[i]];
}

}  // namespace snug::solver
