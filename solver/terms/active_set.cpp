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
  memory_.fewest_wrong = static_cast<int>(memory_.flags.size()) + 1;
  memory_.waited = 0;
}

void ActiveSet::follow(const std::vector<double>& trials) {
  std::vector<int> wrong;
  double worst = 0.0;
  for (std::size_t i = 0; i < memory_.flags.size(); ++i) {
    if ((trials[i] > 0.0) == (memory_.flags[i] != 0)) continue;
    wrong.push_back(static_cast<int>(i));
    worst = std::max(worst, std::abs(trials[i]));
  }
  memory_.changed = static_cast<int>(wrong.size());
  if (memory_.changed == 0) begin();
  if (memory_.changed < memory_.fewest_wrong) {
    memory_.fewest_wrong = memory_.changed;
    memory_.waited = 0;
  } else {
    ++memory_.waited;
  }
  if (memory_.waited > most_patience_with_worst)
    wrong = {wrong.back()};
  else if (memory_.waited > most_patience)
    std::erase_if(wrong, [&](int i) { return std::abs(trials[i]) < share_of_worst * worst; });
  for (const int i : wrong) memory_.flags[i] = !memory_.flags[i];
}

}  // namespace snug::solver
