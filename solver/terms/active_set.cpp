#include "solver/terms/active_set.hpp"

#include <algorithm>
#include <cmath>

namespace snug::solver {

namespace {

// Iterations in which the number of vertices on the wrong side need not fall: with all of them changing, then with the worst, then with one in turn.
constexpr int most_patience = 5, most_patience_with_worst = 12, most_patience_in_turn = 24;
constexpr double share_of_worst = 0.3;

}  // namespace

void ActiveSet::begin() {
  count_anew();
  memory_.circled = 0;
  memory_.turns.clear();
}

void ActiveSet::count_anew() {
  memory_.fewest_wrong = static_cast<int>(memory_.flags.size()) + 1;
  memory_.waited = 0;
}

int ActiveSet::next_alone(const std::vector<int>& wrong) {
  std::vector<int>& turns = memory_.turns;
  turns.resize(memory_.flags.size(), 0);
  const int next = *std::min_element(wrong.rbegin(), wrong.rend(), [&](int a, int b) { return turns[a] < turns[b]; });
  ++turns[next];
  return next;
}

void ActiveSet::follow(const std::vector<double>& trials, double slack) {
  const double tolerated = memory_.circled ? slack : 0.0;
  std::vector<int> wrong;
  double worst = 0.0;
  for (std::size_t i = 0; i < memory_.flags.size(); ++i) {
    const bool touches = memory_.flags[i] != 0;
    if ((trials[i] > (touches ? 0.0 : tolerated)) == touches) continue;
    wrong.push_back(static_cast<int>(i));
    worst = std::max(worst, std::abs(trials[i]));
  }
  memory_.changed = static_cast<int>(wrong.size());
  if (memory_.changed == 0) count_anew();
  if (memory_.changed < memory_.fewest_wrong) {
    memory_.fewest_wrong = memory_.changed;
    memory_.waited = 0;
  } else {
    ++memory_.waited;
  }
  if (memory_.waited > most_patience) memory_.circled = 1;
  if (memory_.waited > most_patience_in_turn)
    wrong = {wrong.back()};
  else if (memory_.waited > most_patience_with_worst)
    wrong = {next_alone(wrong)};
  else if (memory_.waited > most_patience)
    std::erase_if(wrong, [&](int i) { return std::abs(trials[i]) < share_of_worst * worst; });
  for (const int i : wrong) memory_.flags[i] = !memory_.flags[i];
}

}  // namespace snug::solver
