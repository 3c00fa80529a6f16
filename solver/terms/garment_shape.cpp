#include "solver/terms/garment_shape.hpp"

#include <Eigen/Dense>

#include "solver/fem/plane_shape.hpp"

namespace snug::solver {

Eigen::Matrix<double, 6, 1> garment_values(int order, const Eigen::Vector3d& L) {
  const Eigen::Vector2d xi = L.tail<2>();
  if (order == 2) return fem::plane_values<fem::Element::tri6>(xi);
  Eigen::Matrix<double, 6, 1> N = Eigen::Matrix<double, 6, 1>::Zero();
  N.head<3>() = fem::plane_values<fem::Element::tri3>(xi);
  return N;
}

Eigen::Matrix<double, 6, 2> garment_slopes(int order, const Eigen::Vector3d& L) {
  const Eigen::Vector2d xi = L.tail<2>();
  if (order == 2) return fem::plane_shape<fem::Element::tri6>(xi).dN;
  Eigen::Matrix<double, 6, 2> dN = Eigen::Matrix<double, 6, 2>::Zero();
  dN.topRows<3>() = fem::plane_shape<fem::Element::tri3>(xi).dN;
  return dN;
}

PatternPoint pattern_point(int order, const Eigen::Matrix<double, 2, 6>& nodes, const Eigen::Vector3d& L) {
  const Eigen::Matrix<double, 6, 2> dN = garment_slopes(order, L);
  const Eigen::Matrix2d tangents = nodes * dN;
  return {dN * tangents.inverse(), 0.5 * tangents.determinant()};
}

double course_value(const Eigen::Matrix<double, 1, 6>& course, const Eigen::Matrix<double, 6, 1>& N) {
  return (course.array() == course[0]).all() ? course[0] : course.dot(N);
}

FlatTriangle flat_triangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  FlatTriangle t;
  const Eigen::Vector2d u = b - a, v = c - a;
  const double det = u.x() * v.y() - u.y() * v.x();
  t.area = 0.5 * det;
  t.gradient.row(1) = Eigen::RowVector2d(v.y(), -v.x()) / det;
  t.gradient.row(2) = Eigen::RowVector2d(-u.y(), u.x()) / det;
  t.gradient.row(0) = -t.gradient.row(1) - t.gradient.row(2);
  return t;
}

const std::vector<TrianglePoint>& triangle_rule() {
  static const std::vector<TrianglePoint> rule = [] {
    const fem::Rule gauss = fem::quadrature(fem::Domain::triangle, 5);
    std::vector<TrianglePoint> points;
    for (Eigen::Index q = 0; q < gauss.weights.size(); ++q) {
      const Eigen::Vector2d p = gauss.points.col(q);
      points.push_back({{1.0 - p[0] - p[1], p[0], p[1]}, 2.0 * gauss.weights[q]});
    }
    return points;
  }();
  return rule;
}

std::vector<TrianglePoint> composite_rule(int n) {
  std::vector<TrianglePoint> points;
  const auto part = [&](const Eigen::Vector2d& corner, double side) {
    for (const TrianglePoint& q : triangle_rule()) {
      const Eigen::Vector2d x = corner + side * Eigen::Vector2d(q.L[1], q.L[2]);
      points.push_back({{1.0 - x.sum(), x[0], x[1]}, q.weight * side * side});
    }
  };
  const double side = 1.0 / n;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i + j < n; ++i) {
      part({i * side, j * side}, side);
      if (i + j + 1 < n) part({(i + 1) * side, (j + 1) * side}, -side);  // the part upside down
    }
  return points;
}

}  // namespace snug::solver
