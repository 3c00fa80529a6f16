#include "mesh/curves/convexity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace snug::mesh::curves {

bool is_convex(const Eigen::MatrixXd& polygon, double tolerance) {
  if (polygon.rows() != 2 || polygon.cols() < 3)
    throw std::invalid_argument("a polygon has three points of two coordinates at least");
  std::vector<Eigen::Vector2d> edges;
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    const Eigen::Vector2d edge = polygon.col((i + 1) % polygon.cols()) - polygon.col(i);
    if (edge.norm() > 0.0) edges.push_back(edge);  // a point that is there twice turns nowhere
  }
  double turn = 0.0, most_left = 0.0, most_right = 0.0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Eigen::Vector2d &a = edges[i], &b = edges[(i + 1) % edges.size()];
    const double angle = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    if (std::abs(angle) > std::numbers::pi - 1e-9) return false;  // it turns back on itself
    turn += angle;
    most_left = std::max(most_left, angle);
    most_right = std::max(most_right, -angle);
  }
  // One whole turn: a polygon that turns one way only may still go round twice.
  return std::min(most_left, most_right) <= tolerance && std::abs(std::abs(turn) - 2.0 * std::numbers::pi) < 1e-6;
}

Convexity convexity(const WCurve& curve) {
  if (curve.degree() < 2) throw std::invalid_argument("a line is not asked for its convexity");
  if (is_convex(curve.points())) return Convexity::by_polygon;
  return is_convex(curve.bezier().points()) ? Convexity::by_bezier : Convexity::not_shown;
}

}  // namespace snug::mesh::curves
