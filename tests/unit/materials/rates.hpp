// Derivatives are tested by rate: the error of a central difference falls by four when the step is halved.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <functional>

namespace snug::testing {

/// Expects `derivative` (columns: derivative of `value` along each component of x) to be what central differences
/// converge to with second order. Steps where round-off shows are left out; an exact polynomial passes by being exact.
inline void expect_derivative_by_rate(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& value,
                                      const Eigen::VectorXd& x, const Eigen::MatrixXd& derivative, double first_step) {
  const double scale = std::max(derivative.cwiseAbs().maxCoeff(), 1e-300);
  const double value_size = value(x).cwiseAbs().maxCoeff();
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    double last_error = 0.0;
    int rates = 0;
    for (double h = first_step; h > first_step / 20.0; h *= 0.5) {
      Eigen::VectorXd plus = x, minus = x;
      plus[j] += h;
      minus[j] -= h;
      const Eigen::VectorXd difference = (value(plus) - value(minus)) / (2.0 * h);
      const double error = (difference - derivative.col(j)).cwiseAbs().maxCoeff();
      const double roundoff = 1e-13 * (value_size / h + scale);
      if (h < first_step && error > 20.0 * roundoff) {
        EXPECT_NEAR(last_error / error, 4.0, 0.4) << "component " << j << ", step " << h << ", error " << error;
        ++rates;
      }
      last_error = error;
    }
    if (rates == 0) {
      EXPECT_LE(last_error, 1e-9 * scale) << "component " << j << ": no rate and not exact";
    }
  }
}

}  // namespace snug::testing
