// A response of runs (a pressure, comfort) as a polynomial of properties, fitted by least squares.
#pragma once

#include <Eigen/Core>

namespace snug::materials {

enum class Degree { linear = 1, quadratic = 2 };

/// 1, z_i and of a quadratic one z_i z_j (i <= j), with z = (x - mean)/deviation.
struct ResponseSurface {
  Degree degree = Degree::linear;
  Eigen::VectorXd mean, deviation;  ///< of the properties
  Eigen::VectorXd coefficients;     ///< of the terms in that order
  double rms = 0.0;                 ///< of the residuals
  double cross_validated_rms = 0.0; ///< each response predicted from all others; NaN where one of them alone decides about a term
  double r_squared = 0.0, q_squared = 0.0;  ///< share of the variance that is told: by the fit, and cross-validated

  double at(const Eigen::VectorXd& properties) const;
  /// Sensitivities: change of the response over that of each property.
  Eigen::VectorXd gradient(const Eigen::VectorXd& properties) const;
};

/// Number of terms of so many properties.
Eigen::Index terms_of(Eigen::Index properties, Degree degree);

/// Least squares by Householder QR with column pivoting; the error without a row is its residual over 1 - h, h its leverage (the diagonal of Q Q^T), which is
/// exact for least squares (Allen, Technometrics 16 (1974) 125). Rows of `properties` are runs. Throws std::invalid_argument where there are not more rows
/// than terms, or where terms are not independent (a property that is the same everywhere, or follows from others).
ResponseSurface fit_response(const Eigen::MatrixXd& properties, const Eigen::VectorXd& response, Degree degree);

}  // namespace snug::materials
