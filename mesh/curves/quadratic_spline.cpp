#include "mesh/curves/quadratic_spline.hpp"

#include <fmt/format.h>

#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace snug::mesh::curves {

namespace {

using Kind = SplineEnds::Kind;

void check(const std::vector<double>& t, const Eigen::MatrixXd& points, const SplineEnds& ends) {
  if (t.size() < 2 || static_cast<Eigen::Index>(t.size()) != points.cols() || points.rows() < 1 || !points.allFinite())
    throw std::invalid_argument(
        fmt::format("{} parameters for {} points; two at least, one each", t.size(), points.cols()));
  for (std::size_t i = 1; i < t.size(); ++i)
    if (!(t[i] > t[i - 1]) || !std::isfinite(t[i] - t[i - 1]))
      throw std::invalid_argument(fmt::format("parameter {} does not grow from {} to {}", i, t[i - 1], t[i]));
  if (ends.kind == Kind::tangents && (ends.first.size() != points.rows() || ends.last.size() != points.rows()))
    throw std::invalid_argument("tangents at the ends have as many components as the points");
  if (ends.kind == Kind::periodic && (points.cols() < 4 || points.col(0) != points.col(points.cols() - 1)))
    throw std::invalid_argument("a periodic spline has three different points at least and ends where it begins");
}

/// The equations of the tangents, one a row: mu_i m_{i-1} + 3 m_i + lambda_i m_{i+1} = 4 (mu_i dP_i / l_i + lambda_i
/// dP_{i+1} / l_{i+1}), dP_i = P_i - P_{i-1}, l_i = t_i - t_{i-1}, mu_i = l_{i+1} / (l_i + l_{i+1}), lambda_i = 1 -
/// mu_i: the derivatives meet in the middles.
class Equations {
 public:
  explicit Equations(const Eigen::MatrixXd& points)
      : points_(points), right_(Eigen::MatrixXd::Zero(points.cols(), points.rows())) {}

  void inner(int row, int before, int here, int after, double l, double next_l) {
    const double mu = next_l / (l + next_l), lambda = 1.0 - mu;
    add(row, before, mu), add(row, here, 3.0), add(row, after, lambda);
    right_.row(row) = 4.0 * (mu * slope(before, here, l) + lambda * slope(here, after, next_l));
  }
  void fixed(int row, const Eigen::VectorXd& value) {
    add(row, row, 1.0);
    right_.row(row) = value.transpose();
  }
  /// M = 0 at the end `row`: 3 m_row + m_other = 4 dP / l.
  void straight(int row, int other, double l) {
    add(row, row, 3.0), add(row, other, 1.0);
    right_.row(row) = 4.0 * (row < other ? slope(row, other, l) : slope(other, row, l));
  }
  void equal(int row, int other) { add(row, row, 1.0), add(row, other, -1.0); }

  Eigen::MatrixXd solve() const {
    Eigen::SparseMatrix<double> matrix(right_.rows(), right_.rows());
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    const Eigen::SparseLU<Eigen::SparseMatrix<double>> factor(matrix);
    if (factor.info() != Eigen::Success) throw std::invalid_argument("the points leave the tangents open");
    return Eigen::MatrixXd(factor.solve(right_)).transpose();
  }

 private:
  void add(int row, int column, double value) { entries_.emplace_back(row, column, value); }
  Eigen::RowVectorXd slope(int from, int to, double l) const {
    return (points_.col(to) - points_.col(from)).transpose() / l;
  }

  const Eigen::MatrixXd& points_;
  Eigen::MatrixXd right_;
  std::vector<Eigen::Triplet<double>> entries_;
};

Eigen::MatrixXd tangents_of(const std::vector<double>& t, const Eigen::MatrixXd& points, const SplineEnds& ends) {
  const int n = static_cast<int>(t.size()) - 1;
  const auto l = [&](int i) { return t[i] - t[i - 1]; };
  Equations equations(points);
  for (int i = 1; i < n; ++i) equations.inner(i, i - 1, i, i + 1, l(i), l(i + 1));
  switch (ends.kind) {
    case Kind::tangents:
      equations.fixed(0, ends.first), equations.fixed(n, ends.last);
      break;
    case Kind::natural:
      equations.straight(0, 1, l(1)), equations.straight(n, n - 1, l(n));
      break;
    case Kind::periodic:
      equations.inner(0, n - 1, 0, 1, l(n), l(1)), equations.equal(n, 0);
      break;
  }
  return equations.solve();
}

}  // namespace

QuadraticSpline::QuadraticSpline(std::vector<double> t, Eigen::MatrixXd points, const SplineEnds& ends)
    : t_(std::move(t)), points_(std::move(points)) {
  check(t_, points_, ends);
  m_ = tangents_of(t_, points_, ends);
  const int n = static_cast<int>(t_.size()) - 1;
  bend_.resize(points_.rows(), n + 1);
  for (int i = 0; i <= n; ++i) {  // (4.3), from the interval after it, the last from the one before
    const int j = std::min(i + 1, n);
    const double l = t_[j] - t_[j - 1];
    const Eigen::VectorXd step = 4.0 * (points_.col(j) - points_.col(j - 1)) / (l * l);
    bend_.col(i) = i < n ? Eigen::VectorXd(step - (3.0 * m_.col(i) + m_.col(j)) / l)
                         : Eigen::VectorXd((3.0 * m_.col(n) + m_.col(n - 1)) / l - step);
  }
}

QuadraticSpline QuadraticSpline::by_chords(Eigen::MatrixXd points, const SplineEnds& ends) {
  std::vector<double> t = {0.0};
  for (Eigen::Index i = 1; i < points.cols(); ++i) t.push_back(t.back() + (points.col(i) - points.col(i - 1)).norm());
  return {std::move(t), std::move(points), ends};
}

int QuadraticSpline::piece(double t) const {
  const auto after = std::upper_bound(t_.begin(), t_.end(), t);
  if (after == t_.begin()) return 0;
  const int i = static_cast<int>(after - t_.begin()) - 1;
  if (i + 1 == static_cast<int>(t_.size())) return i;
  return t < 0.5 * (t_[i] + t_[i + 1]) ? i : i + 1;
}

Eigen::VectorXd QuadraticSpline::point(double t) const {
  const int i = piece(t);
  const double s = t - t_[i];
  return points_.col(i) + s * m_.col(i) + 0.5 * s * s * bend_.col(i);
}

Eigen::VectorXd QuadraticSpline::derivative(double t) const {
  const int i = piece(t);
  return m_.col(i) + (t - t_[i]) * bend_.col(i);
}

BSplineCurve b_spline_of(const QuadraticSpline& spline) {
  const std::vector<double>& t = spline.parameters();
  const int n = static_cast<int>(t.size()) - 1;
  BSplineCurve curve{2, std::vector<double>(3, t.front()), Eigen::MatrixXd(spline.points().rows(), n + 3),
                     Eigen::VectorXd::Ones(n + 3)};
  for (int i = 1; i <= n; ++i) curve.knots.push_back(0.5 * (t[i - 1] + t[i]));
  curve.knots.insert(curve.knots.end(), 3, t.back());
  for (int k = 0; k < n + 3;
       ++k) {  // the polar form of a piece that reaches there, at the two knots inside the point's support
    const int i = std::clamp(k - 1, 0, n);
    const double a = curve.knots[k + 1] - t[i], b = curve.knots[k + 2] - t[i];
    curve.points.col(k) =
        spline.points().col(i) + 0.5 * (a + b) * spline.tangents().col(i) + 0.5 * a * b * spline.bends().col(i);
  }
  return curve;
}

}  // namespace snug::mesh::curves
