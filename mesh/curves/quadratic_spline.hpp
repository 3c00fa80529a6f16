// The piecewise quadratic spline through points, (4.1) to (4.3) of the source.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "mesh/curves/b_spline.hpp"

namespace snug::mesh::curves {

/// What holds at the two ends; the print has no such condition, and two are missing without.
struct SplineEnds {
  enum class Kind {
    tangents,  ///< the derivatives `first` and `last`
    natural,   ///< no second derivative
    periodic   ///< first and last point are the same, and their tangents
  } kind = Kind::natural;
  Eigen::VectorXd first, last;
};

/// P(t) = P_i + m_i (t - t_i) + M_i (t - t_i)^2 / 2 on [t_{i-1/2}, t_{i+1/2}], the middles of the intervals, with the
/// ends t_{-1/2} = t_0 and t_{n+1/2} = t_n (4.1): through the points, with a continuous tangent; third order. Kept for
/// data that are made of it: a cubic spline is smoother.
class QuadraticSpline {
 public:
  /// `t` increasing, two at least; `points` one column each. Throws std::invalid_argument otherwise, and where periodic
  /// ends differ.
  QuadraticSpline(std::vector<double> t, Eigen::MatrixXd points, const SplineEnds& ends = {});
  /// With t by chord length from 0, so that the l_i of the source are distances. Throws where two points that follow
  /// coincide.
  static QuadraticSpline by_chords(Eigen::MatrixXd points, const SplineEnds& ends = {});

  const std::vector<double>& parameters() const { return t_; }
  const Eigen::MatrixXd& points() const { return points_; }  // P_i
  const Eigen::MatrixXd& tangents() const { return m_; }     // m_i
  const Eigen::MatrixXd& bends() const { return bend_; }     // M_i
  /// Goes on by the outermost parabolas beyond the ends.
  Eigen::VectorXd point(double t) const;
  Eigen::VectorXd derivative(double t) const;

 private:
  int piece(double t) const;

  std::vector<double> t_;
  Eigen::MatrixXd points_, m_, bend_;  // P_i, m_i, M_i
};

/// The same curve as a B-spline of degree 2, its inner knots the middles of the intervals, for the exchange with other
/// programs.
BSplineCurve b_spline_of(const QuadraticSpline& spline);

}  // namespace snug::mesh::curves
