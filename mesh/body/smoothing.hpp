// Gaussian low-pass filters without the shrinkage of a plain Gaussian.
#pragma once

#include <Eigen/Core>

namespace snug::mesh {

/// Share of a wave that passes: with G = exp(-(k sigma)^2 / 2) for wave number k, G + (1 - G) G. The second term
/// filters the remainder once more ("twicing"), so that an ellipse keeps its girth to fourth order in k sigma.
double gaussian_pass(double wave_number, double sigma);

/// The same filter along the columns of `values` (one column every dz): at each column a straight line is fitted with
/// Gaussian weights, which keeps linear trends up to the ends; the remainder is filtered once more.
Eigen::MatrixXd smooth_along(const Eigen::MatrixXd& values, double dz, double sigma);

}  // namespace snug::mesh
