#include "solver/terms/active_set.hpp"

namespace snug::solver {

namespace {

// Iterations in which the number of vertices on the wrong side of contact need not fall.
constexpr int most_patience = 5;

}  // namespace

void ActiveSet::begin() {
  fewest_wrong_ = static_cast<int>(flags_.size()) + 1;
  patience_ = most_patience;
}

void ActiveSet::follow(const std::vector<char>& decided) {
  std::vector<int> wrong;
  for (std::size_t i = 0; i < flags_.size(); ++i)
    if (decided[i] != flags_[i]) wrong.push_back(static_cast<int>(i));
  changed_ = static_cast<int>(wrong.size());
  if (changed_ == 0) {
    begin();
  } else if (changed_ < fewest_wrong_) {
    fewest_wrong_ = changed_;
    patience_ = most_patience;
  } else if (patience_ > 0) {
    --patience_;
  } else {
    wrong = {wrong.back()};
  }
  for (const int i : wrong) flags_[i] = !flags_[i];
}

}  // namespace snug::solver
