#include "solver/algebra/numbering.hpp"

namespace snug::solver {

Numbering::Numbering(std::vector<int> master, const std::vector<int>& owner, int ranks, Bound bound)
    : unknown_(master.size(), -1), first_(1, 0), bound_(std::move(bound)) {
  for (int rank = 0; rank < ranks; ++rank) {
    for (std::size_t i = 0; i < master.size(); ++i)
      if (master[i] == static_cast<int>(i) && (owner.empty() || owner[i] == rank)) unknown_[i] = unknowns_++;
    first_.push_back(unknowns_);
  }
  for (std::size_t i = 0; i < master.size(); ++i)
    if (master[i] >= 0) unknown_[i] = unknown_[master[i]];
}

void Numbering::fold(Eigen::VectorXd& forces) const {
  for (const auto& [entry, follows] : bound_) {
    for (const Follow& to : follows) forces[to.entry] += to.weight * forces[entry];
    forces[entry] = 0.0;
  }
}

void Numbering::spread(Eigen::VectorXd& step) const {
  for (const auto& [entry, follows] : bound_) {
    for (const Follow& of : follows) step[entry] += of.weight * step[of.entry];
  }
}

}  // namespace snug::solver
