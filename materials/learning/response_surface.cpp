#include "materials/learning/response_surface.hpp"

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "materials/learning/standard_scale.hpp"

namespace snug::materials {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

namespace {

Eigen::RowVectorXd terms(const Eigen::RowVectorXd& z, Degree degree) {
  Eigen::RowVectorXd row(terms_of(z.size(), degree));
  row[0] = 1.0;
  row.segment(1, z.size()) = z;
  Index next = 1 + z.size();
  for (Index i = 0; degree == Degree::quadratic && i < z.size(); ++i)
    for (Index j = i; j < z.size(); ++j) row[next++] = z[i] * z[j];
  return row;
}

}  // namespace

Index terms_of(Index properties, Degree degree) { return 1 + properties + (degree == Degree::quadratic ? properties * (properties + 1) / 2 : 0); }

double ResponseSurface::at(const VectorXd& properties) const {
  return terms((properties - mean).cwiseQuotient(deviation).transpose(), degree).dot(coefficients);
}

VectorXd ResponseSurface::gradient(const VectorXd& properties) const {
  const VectorXd z = (properties - mean).cwiseQuotient(deviation);
  VectorXd slope = coefficients.segment(1, z.size());
  Index next = 1 + z.size();
  for (Index i = 0; degree == Degree::quadratic && i < z.size(); ++i)
    for (Index j = i; j < z.size(); ++j, ++next) slope[i] += coefficients[next] * z[j], slope[j] += coefficients[next] * z[i];
  return slope.cwiseQuotient(deviation);
}

ResponseSurface fit_response(const MatrixXd& properties, const VectorXd& response, Degree degree) {
  const Index rows = properties.rows(), columns = terms_of(properties.cols(), degree);
  if (rows <= columns) throw std::invalid_argument("not more runs than terms");
  const StandardScale scale(properties);
  if ((scale.deviation.array() <= 0.0).any()) throw std::invalid_argument("a property is the same in all runs");
  const MatrixXd z = scale.scaled(properties);
  MatrixXd matrix(rows, columns);
  for (Index r = 0; r < rows; ++r) matrix.row(r) = terms(z.row(r), degree);
  Eigen::ColPivHouseholderQR<MatrixXd> qr(matrix);
  qr.setThreshold(1e-10);
  if (qr.rank() < columns) throw std::invalid_argument("properties follow from one another in these runs");
  ResponseSurface fit{.degree = degree, .mean = scale.mean, .deviation = scale.deviation, .coefficients = qr.solve(response)};
  const VectorXd residuals = response - matrix * fit.coefficients;
  const MatrixXd q = qr.householderQ() * MatrixXd::Identity(rows, columns);
  const VectorXd leverage = q.rowwise().squaredNorm();
  VectorXd without(rows);
  for (Index r = 0; r < rows; ++r) without[r] = leverage[r] < 1.0 - 1e-9 ? residuals[r] / (1.0 - leverage[r]) : std::numeric_limits<double>::quiet_NaN();
  const double n = static_cast<double>(rows), variance = (response.array() - response.mean()).square().sum();
  fit.rms = std::sqrt(residuals.squaredNorm() / n), fit.cross_validated_rms = std::sqrt(without.squaredNorm() / n);
  fit.r_squared = variance > 0.0 ? 1.0 - residuals.squaredNorm() / variance : 1.0;
  fit.q_squared = variance > 0.0 ? 1.0 - without.squaredNorm() / variance : 1.0;
  return fit;
}

}  // namespace snug::materials
