// The active set finds the solution of linear complementarity problems in which changing every wrong vertex goes in circles.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "solver/terms/active_set.hpp"

namespace snug::tests {
namespace {

using solver::ActiveSet;

/// w = M z + q, z >= 0, w >= 0, z w = 0: the multipliers of an active set and the gaps of the others.
struct Complementarity {
  Eigen::MatrixXd M;
  Eigen::VectorXd q;

  /// Positive where a vertex should touch: its multiplier where it does, minus its gap where it does not.
  std::vector<double> trials(const ActiveSet& set) const {
    const Eigen::Index n = q.size();
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < n; ++i)
      if (set[static_cast<int>(i)]) A.row(i) = M.row(i), b[i] = -q[i];
    // not partialPivLu: libgmsh would take this program's, and frees memory otherwise than it allocates
    const Eigen::VectorXd z = A.householderQr().solve(b), w = M * z + q;
    std::vector<double> trials(n);
    for (Eigen::Index i = 0; i < n; ++i) trials[i] = set[static_cast<int>(i)] ? z[i] : -w[i];
    return trials;
  }
};

int steps_to_rest(const Complementarity& problem, ActiveSet& set, int most) {
  for (int step = 1; step <= most; ++step) {
    set.follow(problem.trials(set));
    if (set.changed() == 0) return step;
  }
  return most + 1;
}

TEST(ActiveSet, AllWrongVerticesChangeAtOnceWhileTheirNumberFalls) {
  const Complementarity springs{2.0 * Eigen::MatrixXd::Identity(6, 6), (Eigen::VectorXd(6) << -1, 2, -3, 4, -5, 6).finished()};
  ActiveSet set(6);
  set.begin();
  EXPECT_EQ(steps_to_rest(springs, set, 10), 2);
  EXPECT_EQ(set.flags(), (std::vector<char>{1, 0, 1, 0, 1, 0}));
}

/// Murty's example (Linear Complementarity, Linear and Nonlinear Programming (1988), ch. 4): from one vertex in contact, block
/// changes visit the three pairs for ever.
TEST(ActiveSet, ComesToRestWhereBlockChangesGoInCircles) {
  const Complementarity circle{(Eigen::MatrixXd(3, 3) << 1, 2, 0, 0, 1, 2, 2, 0, 1).finished(), Eigen::VectorXd::Constant(3, -1.0)};
  ActiveSet set(3);
  set.begin();
  set.follow({1.0, -1.0, -1.0});
  EXPECT_LE(steps_to_rest(circle, set, 60), 40);
  EXPECT_EQ(set.flags(), (std::vector<char>{1, 1, 1}));
}

/// Two vertices swing with their neighbours' help while one is far off: only the far one changes, and the others follow it.
TEST(ActiveSet, TheWorstAloneChangesWhenTheNumberHasNotFallenForLong) {
  ActiveSet set(3);
  set.begin();
  double side = 1.0;
  for (int step = 0; step < 6; ++step, side = -side) set.follow({0.01 * side, -0.01 * side, step % 2 ? -1.0 : 1.0});
  const std::vector<char> before = set.flags();
  set.follow({before[0] ? -0.01 : 0.01, before[1] ? -0.01 : 0.01, before[2] ? -1.0 : 1.0});
  EXPECT_EQ(set.changed(), 3);
  EXPECT_EQ(set.flags(), (std::vector<char>{before[0], before[1], static_cast<char>(!before[2])}));
}

/// A gap that closes by 1 for each unit of its multiplier and stands at -1e-9 without one has no solution: within the slack it does not touch.
TEST(ActiveSet, AVertexThatIsRightOnNeitherSideStaysOutOfContactWithinTheSlack) {
  const Complementarity none{-Eigen::MatrixXd::Identity(1, 1), Eigen::VectorXd::Constant(1, -1e-9)};
  const auto follow = [&](double slack) {
    ActiveSet set(1);
    set.begin();
    for (int step = 0; step < 40; ++step) {
      set.follow(none.trials(set), slack);
      if (set.changed() == 0) return std::pair(step, static_cast<bool>(set[0]));
    }
    return std::pair(40, static_cast<bool>(set[0]));
  };
  EXPECT_EQ(follow(0.9e-9).first, 40);
  const auto [steps, touches] = follow(1.1e-9);
  EXPECT_LT(steps, 12);
  EXPECT_FALSE(touches);
}

/// A set that has not gone in circles is decided to the last bit, whatever the slack.
TEST(ActiveSet, TheSlackDoesNotCountWhereSetsComeToRest) {
  const Complementarity near{Eigen::MatrixXd::Identity(1, 1), Eigen::VectorXd::Constant(1, -1e-9)};
  ActiveSet set(1);
  set.begin();
  EXPECT_LE(steps_to_rest(near, set, 5), 2);
  EXPECT_TRUE(set[0]);
}

}  // namespace
}  // namespace snug::tests
