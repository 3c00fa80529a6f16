#include "solver/terms/active_set.hpp"

#include <algorithm>
#include <cmath>

namespace snug::solver {

namespace {

// Iterations in which the number of vertices on the wrong side need not fall: with all of them changing, then with the worst.
constexpr int most_patience = 5, most_patience_with_worst = 20;
constexpr double share_of_worst = 0.3;

}  // namespace

void ActiveSet::begin() {
  fewest_wrong_ = static_cast<int>(flags_.size()) + 1;
  waited_ = 0;
}

void ActiveSet::follow(const std::vector<double>& trials) {
  std::vector<int> wrong;
  double worst = 0.0;
  for (std::size_t i = 0; i < flags_.size(); ++i) {
    if ((trials[i] > 0.0) == (flags_[i] != 0)) continue;
    wrong.push_back(static_cast<int>(i));
    worst = std::max(worst, std::abs(trials[i]));
  }
  changed_ = static_cast<int>(wrong.size());
  if (changed_ == 0) begin();
  if (changed_ < fewest_wrong_) {
    fewest_wrong_ = changed_;
    waited_ = 0;
  } else {
    ++waited_;
  }
  if (waited_ > most_patience_with_worst)
    wrong = {wrong.back()};
  else if (waited_ > most_patience)
    std::erase_if(wrong, [&](int i) { return std::abs(trials[i]) < share_of_worst * worst; });
  for (const int i : wrong) flags_[i] = !flags_[i];
}

}  // namespace snug::solver
