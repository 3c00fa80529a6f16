#include "mesh/curves/interpolation.hpp"

#include <Eigen/QR>

#include <cassert>
#include <vector>

namespace snug::mesh::curves {

namespace {

constexpr int cubic = 3;

/// The bases of these knots at t: a curve whose control points are the unit vectors.
Eigen::VectorXd bases_at(const std::vector<double>& knots, double t) {
  const auto count = static_cast<Eigen::Index>(knots.size()) - cubic - 1;
  return BSplineCurve{cubic, knots, Eigen::MatrixXd::Identity(count, count), Eigen::VectorXd::Ones(count)}.point(t);
}

/// What the control point i of the derivative takes of those of the curve: p (c_{i+1} - c_i) / (t_{i+p+1} - t_{i+1}).
Eigen::RowVectorXd derivative_point(const std::vector<double>& knots, Eigen::Index i) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(knots.size()) - cubic - 1);
  row[i + 1] = cubic / (knots[i + cubic + 1] - knots[i + 1]);
  row[i] = -row[i + 1];
  return row;
}

struct Solution {
  std::vector<double> knots;
  Eigen::MatrixXd to_points;  ///< control points = this times values
};

/// Straight before the first value and after the last: on those two spans the derivative is constant, so that its three control points
/// there are one.
Solution open(std::span<const double> at, double beyond) {
  std::vector<double> knots(cubic + 1, at.front() - beyond);
  knots.insert(knots.end(), at.begin(), at.end());
  knots.insert(knots.end(), cubic + 1, at.back() + beyond);
  const auto values = static_cast<Eigen::Index>(at.size()), points = values + 4;
  Eigen::MatrixXd conditions(points, points);
  for (Eigen::Index n = 0; n < values; ++n) conditions.row(n) = bases_at(knots, at[n]).transpose();
  for (Eigen::Index n = 0; n < 2; ++n) {
    conditions.row(values + n) = derivative_point(knots, n) - derivative_point(knots, n + 1);
    conditions.row(values + 2 + n) = derivative_point(knots, points - 2 - n) - derivative_point(knots, points - 3 - n);
  }
  return {std::move(knots), conditions.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(points, values))};
}

/// The knots go on round, and so do the control points: as many as values, the first three once more.
Solution closed(std::span<const double> at, double period) {
  const auto values = static_cast<Eigen::Index>(at.size());
  const auto knot = [&](Eigen::Index n) { return at[(n + values) % values] + (n < 0 ? -period : n >= values ? period : 0.0); };
  std::vector<double> knots;
  for (Eigen::Index n = -cubic; n <= values + cubic; ++n) knots.push_back(knot(n));
  Eigen::MatrixXd conditions = Eigen::MatrixXd::Zero(values, values);
  for (Eigen::Index n = 0; n < values; ++n) {
    const Eigen::VectorXd bases = bases_at(knots, at[n]);
    for (Eigen::Index k = 0; k < bases.size(); ++k) conditions(n, k % values) += bases[k];
  }
  const Eigen::MatrixXd once = conditions.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(values, values));
  Eigen::MatrixXd all(values + cubic, values);
  for (Eigen::Index k = 0; k < all.rows(); ++k) all.row(k) = once.row(k % values);
  return {std::move(knots), std::move(all)};
}

}  // namespace

BSplineSurface surface_through(const Net& net, std::span<const double> rows, std::span<const double> columns, double period, double beyond) {
  assert(net.points.rows() == 3 && rows.size() == static_cast<std::size_t>(net.rows) && columns.size() == static_cast<std::size_t>(net.columns));
  const Solution u = open(rows, beyond), v = closed(columns, period);
  BSplineSurface surface{.degrees = {cubic, cubic}, .knots = {u.knots, v.knots}, .points = {}, .weights = {}};
  surface.points.resize(3, u.to_points.rows() * v.to_points.rows());
  for (int axis = 0; axis < 3; ++axis) {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::VectorXd values = net.points.row(axis);
    const RowMajor points = u.to_points * Eigen::Map<const RowMajor>(values.data(), net.rows, net.columns) * v.to_points.transpose();
    surface.points.row(axis) = Eigen::Map<const Eigen::RowVectorXd>(points.data(), points.size());
  }
  surface.weights = Eigen::VectorXd::Ones(surface.points.cols());
  return surface;
}

}  // namespace snug::mesh::curves
