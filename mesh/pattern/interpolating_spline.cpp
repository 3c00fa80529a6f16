#include "mesh/pattern/interpolating_spline.hpp"

#include <Eigen/Dense>

#include "mesh/body/spline.hpp"

namespace snug::mesh {

namespace {

using Eigen::Vector2d;

/// Length of the chords up to each point.
std::vector<double> parameters(const std::vector<Vector2d>& points) {
  std::vector<double> t{0.0};
  for (std::size_t i = 1; i < points.size(); ++i) t.push_back(t.back() + (points[i] - points[i - 1]).norm());
  return t;
}

/// The slopes m_i of (4.1): mu_i m_{i-1} + 3 m_i + lambda_i m_{i+1} = 4 (mu_i dP_i / l_i + lambda_i dP_{i+1} / l_{i+1})
/// with l_i = t_i - t_{i-1}, mu_i = l_{i+1} / (l_i + l_{i+1}), lambda_i = 1 - mu_i; M = 0 at the ends: 3 m_0 + m_1 = 4
/// dP_1 / l_1.
std::vector<Vector2d> slopes(const std::vector<Vector2d>& points, const std::vector<double>& t) {
  const int n = static_cast<int>(points.size()) - 1;
  const auto secant = [&](int i) -> Vector2d { return (points[i] - points[i - 1]) / (t[i] - t[i - 1]); };
  std::vector<double> diagonal(n + 1, 3.0), below(n + 1, 0.0), above(n + 1, 0.0);
  std::vector<Vector2d> right(n + 1);
  above[0] = below[n] = 1.0;
  right[0] = 4.0 * secant(1), right[n] = 4.0 * secant(n);
  for (int i = 1; i < n; ++i) {
    below[i] = (t[i + 1] - t[i]) / (t[i + 1] - t[i - 1]);
    above[i] = 1.0 - below[i];
    right[i] = 4.0 * (below[i] * secant(i) + above[i] * secant(i + 1));
  }
  for (int i = 1; i <= n; ++i) {  // diagonally dominant: no pivots
    const double factor = below[i] / diagonal[i - 1];
    diagonal[i] -= factor * above[i - 1];
    right[i] -= factor * right[i - 1];
  }
  for (int i = n; i >= 0; --i)
    right[i] = (i < n ? Vector2d(right[i] - above[i] * right[i + 1]) : right[i]) / diagonal[i];
  return right;
}

}  // namespace

Curve cubic_spline(const std::vector<Vector2d>& points) {
  const std::vector<double> t = parameters(points);
  std::vector<double> x, y;
  for (const Vector2d& p : points) x.push_back(p.x()), y.push_back(p.y());
  const Spline along_x(t, x), along_y(t, y);
  const auto slope = [&](double at) { return Vector2d(along_x.derivatives(at)[1], along_y.derivatives(at)[1]); };
  Curve curve;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double third = (t[i] - t[i - 1]) / 3.0;
    curve.spans.push_back(
        Cubic{points[i - 1], points[i - 1] + third * slope(t[i - 1]), points[i] - third * slope(t[i]), points[i]});
  }
  return curve;
}

Curve quadratic_spline(const std::vector<Vector2d>& points) {
  const std::vector<double> t = parameters(points);
  const std::vector<Vector2d> m = slopes(points, t);
  const int n = static_cast<int>(points.size()) - 1;
  Curve curve;
  for (int i = 0; i <= n; ++i) {
    // M_i by the chord after P_i, at the last point by the one before it.
    const double length = i < n ? t[i + 1] - t[i] : t[n] - t[n - 1];
    const Vector2d rise = (i < n ? points[i + 1] - points[i] : points[n] - points[n - 1]) / length;
    const Vector2d bend = i < n ? Vector2d((4.0 * rise - 3.0 * m[i] - m[i + 1]) / length)
                                : Vector2d((3.0 * m[n] + m[n - 1] - 4.0 * rise) / length);
    const auto place = [&](double s) -> Vector2d { return points[i] + s * m[i] + 0.5 * s * s * bend; };
    const double from = i > 0 ? -0.5 * (t[i] - t[i - 1]) : 0.0, to = i < n ? 0.5 * (t[i + 1] - t[i]) : 0.0;
    curve.spans.push_back(Quadratic{place(from), place(from) + 0.5 * (to - from) * (m[i] + from * bend), place(to)});
  }
  return curve;
}

}  // namespace snug::mesh
