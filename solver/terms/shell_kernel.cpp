#include "solver/terms/shell_kernel.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "solver/fem/plane_shape.hpp"

namespace snug::solver {

TrianglePlace triangle_place(const Eigen::Vector2d& xi) {
  const auto shape = fem::plane_shape<fem::Element::tri6>(xi);
  return {shape.N, shape.dN, shape.ddN};
}

ShellPoint shell_point(const TriangleNodes& x, const TrianglePlace& place) {
  ShellPoint p;
  p.tangent = x * place.dN;
  const Eigen::Vector3d cross = p.tangent.col(0).cross(p.tangent.col(1));
  p.area = cross.norm();
  p.normal = cross / p.area;
  const Eigen::Matrix2d metric = p.tangent.transpose() * p.tangent;
  const Eigen::Matrix<double, 3, 2> dual = p.tangent * metric.inverse();
  p.gradient = dual * place.dN.transpose();
  const Eigen::Matrix3d second = x * place.ddN;
  p.b = second.transpose() * p.normal;
  const Eigen::Matrix<double, 2, 3> christoffel = dual.transpose() * second;
  p.c = place.ddN - place.dN * christoffel;
  return p;
}

// From  dn = -sum_c (n . dt_c) t^c  and  d(t^c) = -sum_s (t^c . dt_s) t^s + sum_s a^cs (n . dt_s) n.
void add_second_form_hessian(const ShellPoint& p, const Eigen::Vector3d& mu, const std::array<int, 6>& at,
                             Eigen::Ref<Eigen::MatrixXd> matrix) {
  const Eigen::Matrix<double, 6, 1> c = p.c * mu;
  const double b = mu.dot(p.b);
  const Eigen::Matrix3d nn = p.normal * p.normal.transpose();
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const Eigen::Vector3d gi = p.gradient.col(i), gj = p.gradient.col(j);
      matrix.block<3, 3>(3 * at[i], 3 * at[j]) -=
          c[i] * gj * p.normal.transpose() + c[j] * p.normal * gi.transpose() + b * gi.dot(gj) * nn;
    }
}

void add_bending_point(const ShellPoint& p, const Eigen::Vector3d& reference_b, const Eigen::Matrix3d& Q, double weight,
                       bool tangent, bool geometric, MembraneElement<6>& element) {
  const Eigen::Vector3d K = p.b - reference_b, mu = Q * K;
  element.energy += weight * 0.5 * K.dot(mu);
  const Eigen::Matrix<double, 6, 1> c = p.c * mu;
  for (int a = 0; a < 6; ++a) element.residual.segment<3>(3 * a) += weight * c[a] * p.normal;
  if (!tangent) return;
  const Eigen::Matrix<double, 6, 6> stiff = weight * p.c * Q * p.c.transpose();
  const Eigen::Matrix3d nn = p.normal * p.normal.transpose();
  Eigen::MatrixXd more = Eigen::MatrixXd::Zero(18, 18);
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) more.block<3, 3>(3 * a, 3 * b) = stiff(a, b) * nn;
  static constexpr std::array<int, 6> own = {0, 1, 2, 3, 4, 5};
  if (geometric) add_second_form_hessian(p, weight * mu, own, more);
  element.matrix += more;
}

// Exact to degree 2: as many membrane strains as a flat triangle has ways to deform in its plane. With the seven of degree 5
// a thin shell locks: its strain in bending, (curvature x edge)^2, cannot vanish at all of them. Measured on a strip of
// t/L = 1e-3 in 40 cells that hangs by its own weight (reference book 2.3, q = 8): tip 1.5e-2 off with seven, 2.6e-3 with
// three.
const std::vector<BendingRulePoint>& bending_rule() {
  static const std::vector<BendingRulePoint> rule = [] {
    const fem::Rule three = fem::quadrature(fem::Domain::triangle, 2);
    std::vector<BendingRulePoint> points;
    for (Eigen::Index q = 0; q < three.weights.size(); ++q) points.push_back({three.points.col(q), three.weights[q]});
    return points;
  }();
  return rule;
}

Eigen::Matrix3d plane_stress(double poisson_ratio, const Eigen::Matrix2d& A) {
  constexpr std::array<std::array<int, 2>, 3> pair = {{{0, 0}, {1, 1}, {0, 1}}};
  Eigen::Matrix3d C;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const auto [a, b] = pair[i];
      const auto [c, d] = pair[j];
      C(i, j) = 0.5 * (1.0 - poisson_ratio) * (A(a, c) * A(b, d) + A(a, d) * A(b, c)) + poisson_ratio * A(a, b) * A(c, d);
    }
  return C;
}

namespace {

/// A side at the current positions: its share of the angle's derivative is  dtheta_s(a) = -rho_a n.
struct Side {
  ShellPoint p;
  Eigen::Vector3d conormal;         ///< edge direction x normal
  Eigen::Matrix<double, 6, 1> rho;  ///< g_a . conormal
  Eigen::Matrix<double, 6, 1> lambda;  ///< derivative along the edge over |dx/ds|
  Eigen::Vector3d edge;             ///< unit
  double moment = 0.0;
};

Side side_at(const TriangleNodes& x, const EdgeSide& side) {
  Side s;
  s.p = shell_point(x, side.place);
  const Eigen::Vector3d T = s.p.tangent * side.along;
  s.edge = T.normalized();
  s.conormal = s.edge.cross(s.p.normal);
  s.rho = s.p.gradient.transpose() * s.conormal;
  s.lambda = side.place.dN * side.along / T.norm();
  s.moment = side.moment.dot(s.p.b - side.reference_b);
  return s;
}

double angle(const std::vector<Side>& sides, const EdgePoint& point) {
  const Eigen::Vector3d from = sides.size() == 2 ? sides[1].p.normal : point.fixed_normal;
  return std::atan2(from.cross(sides[0].p.normal).dot(sides[0].edge), from.dot(sides[0].p.normal));
}

std::vector<Side> sides_of(const std::vector<TriangleNodes>& x, const EdgePoint& point) {
  std::vector<Side> sides;
  for (std::size_t s = 0; s < x.size(); ++s) sides.push_back(side_at(x[s], point.side[s]));
  return sides;
}

// d2 theta_s(a, b) = rho_a g_b n' + rho_b n g_a' + lambda_a lambda_b (n nu' + nu n')/2. The last part is not symmetric for one
// side; the sum over both sides is (n nu' - nu n' is the same rotation on either), so that the symmetric part serves.
void add_angle_hessian(const Side& s, double factor, const std::array<int, 6>& at, Eigen::MatrixXd& matrix) {
  const Eigen::Vector3d& n = s.p.normal;
  const Eigen::Matrix3d turn = 0.5 * (n * s.conormal.transpose() + s.conormal * n.transpose());
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      matrix.block<3, 3>(3 * at[i], 3 * at[j]) +=
          factor * (s.rho[i] * s.p.gradient.col(j) * n.transpose() + s.rho[j] * n * s.p.gradient.col(i).transpose() +
                    s.lambda[i] * s.lambda[j] * turn);
}

}  // namespace

double edge_angle(const std::vector<TriangleNodes>& x, const EdgePoint& point) { return angle(sides_of(x, point), point); }

void add_edge_point(const std::vector<TriangleNodes>& x, const EdgePoint& point, const std::vector<std::array<int, 6>>& at,
                    bool tangent, bool geometric, EdgeElement& element) {
  const std::vector<Side> sides = sides_of(x, point);
  const double share = 1.0 / static_cast<double>(sides.size());
  double turn = angle(sides, point) - point.reference_angle;
  turn -= 2.0 * EIGEN_PI * std::round(turn / (2.0 * EIGEN_PI));
  double moment = 0.0;
  Eigen::VectorXd d_angle = Eigen::VectorXd::Zero(element.residual.size()), d_moment = d_angle;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const Side& side = sides[s];
    const double sign = s == 0 ? 1.0 : -1.0;
    moment += share * side.moment;
    const Eigen::Matrix<double, 6, 1> c = side.p.c * point.side[s].moment;
    for (int a = 0; a < 6; ++a) {
      d_angle.segment<3>(3 * at[s][a]) -= sign * side.rho[a] * side.p.normal;
      d_moment.segment<3>(3 * at[s][a]) += share * c[a] * side.p.normal;
    }
  }
  const double couple = moment + point.penalty * turn;  // what the angle's variation does work against
  element.energy += point.weight * (moment + 0.5 * point.penalty * turn) * turn;
  element.residual += point.weight * (turn * d_moment + couple * d_angle);
  if (!tangent) return;
  element.matrix += point.weight * (d_moment * d_angle.transpose() + d_angle * d_moment.transpose() +
                                    point.penalty * d_angle * d_angle.transpose());
  if (!geometric) return;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    add_second_form_hessian(sides[s].p, point.weight * share * turn * point.side[s].moment, at[s], element.matrix);
    add_angle_hessian(sides[s], point.weight * couple * (s == 0 ? 1.0 : -1.0), at[s], element.matrix);
  }
}

namespace {

const fem::Rule& edge_rule() {
  static const fem::Rule rule = fem::quadrature(fem::Domain::line, 5);
  return rule;
}

/// Of the penalty: with 1 the energy of flat triangles is just positive for every jump (see edge_penalty).
constexpr double safety = 1.5;

}  // namespace

Eigen::Vector2d triangle_node(int a) {
  static const fem::Points nodes = fem::reference_nodes(fem::Element::tri6);
  return nodes.col(a);
}

void EdgeSides::add(int triangle, const std::array<int, 6>& triangle_nodes) {
  triangles.push_back(triangle);
  std::array<int, 6>& places = at.emplace_back();
  for (int a = 0; a < 6; ++a) {
    const auto found = std::find(nodes.begin(), nodes.end(), triangle_nodes[a]);
    places[a] = static_cast<int>(found - nodes.begin());
    if (found == nodes.end()) nodes.push_back(triangle_nodes[a]);
  }
}

EdgePlace edge_place(int edge, int q, bool second) {
  const Eigen::Vector2d from = triangle_node(triangle_edges[edge][0]), to = triangle_node(triangle_edges[edge][1]);
  const double s = edge_rule().points(0, q), r = 0.5 * (second ? 1.0 - s : 1.0 + s);
  return {triangle_place(from + r * (to - from)), second ? Eigen::Vector2d(from - to) : Eigen::Vector2d(to - from)};
}

double edge_weight(int q) { return 0.5 * edge_rule().weights[q]; }

// The quadratic triangle's curvature is constant. A third of a triangle's bending energy, D k^2 |K|/6, bears the jumps of
// each of its edges: share D k |e| turn <= D k^2 |K|/6 + 3/2 share^2 D |e|^2/|K| turn^2, which p |e| turn^2/2 outweighs from
// p = 3 share^2 D |e|/|K| summed over the sides on (share 1/2 inside, 1 on a clamped edge). Where the stiffness has
// directions, D is that across the edge: (q.D k)^2 <= (q.D q)(k.D k).
double edge_penalty(double share, double stiffness, double length, double area) {
  return safety * 3.0 * share * share * stiffness * length / area;
}

}  // namespace snug::solver
