// Nonlinear least squares by GSL (trust region, Levenberg-Marquardt) for the fits of comfort data.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace snug::postproc {

/// Fills the residuals r at the parameters x.
using Residuals = std::function<void(const std::vector<double>& x, std::vector<double>& r)>;

/// Parameters near `start` that make the sum of the squares of `count` residuals least; none when the iteration does
/// not converge or there are fewer residuals than parameters. Derivatives by forward differences.
std::optional<std::vector<double>> least_squares(const Residuals& residuals, const std::vector<double>& start,
                                                 std::size_t count);

}  // namespace snug::postproc
