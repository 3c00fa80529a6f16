// Mixed steps end linear iterations that contract slowly or grow, in as many steps as there are slow motions and a few more.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "solver/stepping/acceleration.hpp"
#include "tests/unit/solver/terms.hpp"

namespace snug::tests {
namespace {

using solver::Acceleration;

/// x <- x + s with s = -(1 - r_i) (x_i - 1) in a turned basis: by itself the error of motion i is multiplied by r_i.
struct Iteration {
  Eigen::VectorXd rates;
  Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(rates.size(), rates.size());
  Eigen::VectorXd goal = Eigen::VectorXd::Ones(rates.size());

  Eigen::VectorXd step(const Eigen::VectorXd& x) const {
    return basis * ((rates.array() - 1.0) * (basis.transpose() * (x - goal)).array()).matrix();
  }
  int steps_to(double error, bool mixing, int most, Eigen::Index measured) const {
    Acceleration acceleration(measured);
    Eigen::VectorXd x = random_vector(rates.size(), 1.0, 3);
    const double start = (x - goal).norm();
    for (int n = 0; n < most; ++n) {
      if ((x - goal).norm() <= error * start) return n;
      const Eigen::VectorXd s = step(x);
      acceleration.see(x, s);
      x += mixing ? acceleration.mixed(s) : s;
    }
    return most;
  }
};

Eigen::MatrixXd turned(Eigen::Index n) {
  return Eigen::MatrixXd(Eigen::HouseholderQR<Eigen::MatrixXd>(Eigen::Map<const Eigen::MatrixXd>(random_vector(n * n, 1.0, 7).data(), n, n)).householderQ());
}

/// 0.786 an iteration is that of a bent knee with friction: some 90 steps to 1e-10.
TEST(Acceleration, OneSlowMotionTakesAFewSteps) {
  Eigen::VectorXd rates = Eigen::VectorXd::Constant(12, 1e-3);
  rates[4] = 0.786;
  const Iteration knee{rates, turned(12)};
  EXPECT_GE(knee.steps_to(1e-10, false, 200, 12), 70);
  EXPECT_LE(knee.steps_to(1e-10, true, 200, 12), 6);
}

TEST(Acceleration, MotionsThatSwingAndGrowComeToRestToo) {
  Eigen::VectorXd rates = Eigen::VectorXd::Constant(12, 1e-3);
  rates[2] = -1.4, rates[7] = 0.9, rates[9] = 1.1;
  const Iteration swings{rates, turned(12)};
  EXPECT_EQ(swings.steps_to(1e-8, false, 60, 12), 60);
  EXPECT_LE(swings.steps_to(1e-8, true, 60, 12), 12);
}

/// Multipliers follow the positions, in whose norm alone the share is found.
TEST(Acceleration, EntriesBeyondTheMeasuredOnesFollow) {
  Eigen::VectorXd rates = Eigen::VectorXd::Constant(12, 1e-3);
  rates[4] = 0.8;
  EXPECT_LE((Iteration{rates, turned(12)}.steps_to(1e-10, true, 200, 8)), 6);
}

TEST(Acceleration, WithoutAnEarlierStepItIsTheStep) {
  Acceleration acceleration(3);
  const Eigen::VectorXd x = Eigen::VectorXd::Ones(3), step = random_vector(3, 1.0, 5);
  acceleration.see(x, step);
  EXPECT_EQ(acceleration.mixed(step), step);
  acceleration.see(x + step, 0.5 * step);
  EXPECT_NE(acceleration.mixed(0.5 * step), 0.5 * step);
  acceleration.forget();
  acceleration.see(x, step);
  EXPECT_EQ(acceleration.mixed(step), step);
}

}  // namespace
}  // namespace snug::tests
