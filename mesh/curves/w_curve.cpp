#include "mesh/curves/w_curve.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "mesh/curves/binomial.hpp"

namespace snug::mesh::curves {

WCurve::WCurve(SegmentKnots knots, const Eigen::MatrixXd& points, const Eigen::VectorXd& weights)
    : knots_(std::move(knots)) {
  if (points.cols() != degree() + 1 || weights.size() != degree() + 1 || points.rows() < 1)
    throw std::invalid_argument(fmt::format("a curve of degree {} has {} points and as many weights, not {} and {}",
                                            degree(), degree() + 1, points.cols(), weights.size()));
  if (!(weights.array() > 0.0).all() || !weights.allFinite() || !points.allFinite())
    throw std::invalid_argument("points must be finite and weights positive");
  homogeneous_.resize(points.rows() + 1, points.cols());
  homogeneous_.topRows(points.rows()) = points * weights.asDiagonal();
  homogeneous_.bottomRows(1) = weights.transpose();
}

WCurve::WCurve(SegmentKnots knots, const Eigen::MatrixXd& points)
    : WCurve(std::move(knots), points, Eigen::VectorXd::Ones(points.cols())) {}

Eigen::MatrixXd WCurve::points() const {
  return homogeneous_.topRows(dimension()) * weights().cwiseInverse().asDiagonal();
}

Eigen::VectorXd WCurve::point(double t) const {
  const Eigen::VectorXd h = homogeneous_ * knots_.bases(t);
  return h.head(dimension()) / h[dimension()];
}

Eigen::MatrixXd WCurve::derivatives(double t, int order) const {
  Eigen::MatrixXd h(dimension() + 1, order + 1), q(dimension(), order + 1);
  for (int k = 0; k <= order; ++k) h.col(k) = homogeneous_ * knots_.bases(t, k);
  const auto w = h.row(dimension());
  for (int k = 0; k <= order; ++k) {  // Leibniz: (w Q)^(k) = sum C(k, j) w^(j) Q^(k-j)
    q.col(k) = h.col(k).head(dimension());
    for (int j = 1; j <= k; ++j) q.col(k) -= binomial(k, j) * w[j] * q.col(k - j);
    q.col(k) /= w[0];
  }
  return q;
}

WCurve WCurve::stepped(int steps, double tau) const {
  const SegmentKnots remaining = knots_.remaining(steps);
  const int n = degree();
  Eigen::MatrixXd h = homogeneous_;
  for (int l = 1; l <= steps; ++l)
    for (int i = 0; i <= n - l; ++i) {
      const double lambda = knots_.lambda(i, l, tau);
      h.col(i) = lambda * h.col(i) + (1.0 - lambda) * h.col(i + 1);
    }
  const Eigen::VectorXd w = h.row(dimension()).head(n - steps + 1);
  return {remaining, h.topLeftCorner(dimension(), n - steps + 1) * w.cwiseInverse().asDiagonal(), w};
}

WCurve WCurve::with_knots(const SegmentKnots& knots) const {
  const int n = degree();
  if (knots.degree() != n)
    throw std::invalid_argument(fmt::format("knots of degree {} for a curve of degree {}", knots.degree(), n));
  Eigen::MatrixXd h(dimension() + 1, n + 1);
  for (int i = 0; i <= n; ++i) {
    Eigen::MatrixXd d = homogeneous_;
    for (int l = 1; l <= n; ++l) {
      const double argument = l <= n - i ? knots.u()[i + l - 1] : knots.r()[l - (n - i) - 1];
      for (int k = 0; k <= n - l; ++k) {
        const double lambda = knots_.lambda(k, l, argument);
        d.col(k) = lambda * d.col(k) + (1.0 - lambda) * d.col(k + 1);
      }
    }
    h.col(i) = d.col(0);
  }
  const Eigen::VectorXd w = h.row(dimension());
  return {knots, h.topRows(dimension()) * w.cwiseInverse().asDiagonal(), w};
}

WCurve WCurve::bezier(double from, double to) const {
  if (!(knots_.start() <= from && from < to && to <= knots_.end()))
    throw std::invalid_argument(
        fmt::format("[{}, {}] is no part of the curve's [{}, {}]", from, to, knots_.start(), knots_.end()));
  return with_knots(SegmentKnots::bezier(degree(), from, to));
}

}  // namespace snug::mesh::curves
