// The 2n knots of a W curve of degree n, and its bases.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

namespace snug::mesh::curves {

/// OpenCASCADE's limit, too; the bases stand on the stack.
constexpr int highest_degree = 25;
using Bases = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, highest_degree + 1, 1>;

/// The steps of a W curve: lambda_il(t) = (t - r_i) / (u_{i+l} - r_i), mu_il = 1 - lambda_il, i = 0…n-l, l = 1…n. They
/// are the linear steps that meet the source's (3.2), and the de Boor scheme of the segment [u_n, r_0] of a B-spline
/// with the knots u_1…u_n, r_0…r_{n-1}. All u = a and all r = b is a Bézier curve on [a, b]. The knots need not be
/// sorted (the steps do not depend on it; a B-spline has them sorted): every u must only lie below every r.
class SegmentKnots {
 public:
  /// u_1…u_n and r_0…r_{n-1}. Throws std::invalid_argument unless both have the same number from 1 to highest_degree of
  /// finite knots and every u lies below every r.
  SegmentKnots(std::vector<double> u, std::vector<double> r);
  static SegmentKnots bezier(int degree, double start = 0.0, double end = 1.0);

  int degree() const { return static_cast<int>(u_.size()); }
  /// The largest u and the smallest r: between them all steps are convex combinations.
  double start() const { return start_; }
  double end() const { return end_; }
  std::span<const double> u() const { return u_; }
  std::span<const double> r() const { return r_; }
  bool sorted() const;

  /// a_il of lambda_il(t) = a_il t + b_il.
  double slope(int i, int l) const { return slope_[table(i, l)]; }
  double lambda(int i, int l, double t) const { return slope(i, l) * (t - r_[i]); }

  /// The bases of the steps first+1…n at t, or their derivative of the given order: n - first + 1 of them. first = 0
  /// are the G_i,n of the whole curve. A derivative replaces a step by its slope, times the number of steps there are:
  /// G^(k) = (n-first)! / (n-first-k)! times the product with k steps a (D_i - D_{i+1}) (3.6).
  Bases bases(double t, int order = 0, int first = 0) const;

  /// Knots of what remains after `steps` steps: u_{steps+1}…u_n and r_0…r_{n-steps-1}. steps < n.
  SegmentKnots remaining(int steps) const;

  bool operator==(const SegmentKnots&) const = default;

 private:
  int table(int i, int l) const { return (l - 1) * degree() + i; }

  std::vector<double> u_, r_, slope_;
  double start_ = 0.0, end_ = 0.0;
};

}  // namespace snug::mesh::curves
