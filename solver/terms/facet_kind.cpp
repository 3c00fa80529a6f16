#include "solver/terms/facet_kind.hpp"

#include <Eigen/Dense>

#include <cmath>

namespace snug::solver {

using mesh::FacetKind;

namespace {

FacetShape zero_shape() {
  FacetShape s;
  s.N.setZero(), s.dN.setZero(), s.ddN.setZero();
  return s;
}

FacetShape bilinear(const Eigen::Vector2d& xi) {
  FacetShape s = zero_shape();
  for (int a = 0; a < 4; ++a) {
    const double u = a % 2 == 0 ? -1.0 : 1.0, v = a / 2 == 0 ? -1.0 : 1.0;
    s.N[a] = 0.25 * (1.0 + u * xi[0]) * (1.0 + v * xi[1]);
    s.dN.row(a) << 0.25 * u * (1.0 + v * xi[1]), 0.25 * v * (1.0 + u * xi[0]);
    s.ddN(a, 2) = 0.25 * u * v;
  }
  return s;
}

// L (2 L - 1) at the vertices, 4 L_a L_b on the edges, L = (1 - xi - eta, xi, eta).
FacetShape quadratic_triangle(const Eigen::Vector2d& xi) {
  FacetShape s = zero_shape();
  const std::array<double, 3> L = {1.0 - xi.sum(), xi[0], xi[1]};
  const std::array<Eigen::RowVector2d, 3> d = {Eigen::RowVector2d(-1, -1), Eigen::RowVector2d(1, 0), Eigen::RowVector2d(0, 1)};
  const auto second = [](const Eigen::RowVector2d& a, const Eigen::RowVector2d& b) {
    return Eigen::RowVector3d(2.0 * a[0] * b[0], 2.0 * a[1] * b[1], a[0] * b[1] + a[1] * b[0]);
  };
  for (int v = 0; v < 3; ++v) {
    const int w = (v + 1) % 3;
    s.N[v] = L[v] * (2.0 * L[v] - 1.0);
    s.dN.row(v) = (4.0 * L[v] - 1.0) * d[v];
    s.ddN.row(v) = 2.0 * second(d[v], d[v]);
    s.N[3 + v] = 4.0 * L[v] * L[w];
    s.dN.row(3 + v) = 4.0 * (L[v] * d[w] + L[w] * d[v]);
    s.ddN.row(3 + v) = 4.0 * second(d[v], d[w]);
  }
  return s;
}

std::vector<FacetRulePoint> square_rule(int n) {
  const double g = n == 3 ? std::sqrt(0.6) : 1.0 / std::sqrt(3.0);
  std::vector<FacetRulePoint> rule;
  for (int q = 0; q < n * n; ++q) {
    const auto at = [&](int i) { return n == 3 ? g * (i - 1) : g * (2 * i - 1); };
    const auto weight = [&](int i) { return n == 2 ? 1.0 : i == 1 ? 8.0 / 9.0 : 5.0 / 9.0; };
    rule.push_back({{at(q % n), at(q / n)}, weight(q % n) * weight(q / n)});
  }
  return rule;
}

std::vector<FacetRulePoint> triangle_rule() {
  std::vector<FacetRulePoint> rule = {{{1.0 / 3.0, 1.0 / 3.0}, 9.0 / 80.0}};
  for (const double sign : {-1.0, 1.0}) {
    const double a = (6.0 + sign * std::sqrt(15.0)) / 21.0, weight = (155.0 + sign * std::sqrt(15.0)) / 2400.0;
    for (const Eigen::Vector2d& xi : {Eigen::Vector2d(a, a), {1.0 - 2.0 * a, a}, {a, 1.0 - 2.0 * a}})
      rule.push_back({xi, weight});
  }
  return rule;
}

FacetDomain square(int n) {
  FacetDomain domain{Eigen::Vector2d::Zero(), 0.0, 1.0, {}, {}, {}, {{0, -1, -1}, {1, 0, -1}, {0, 1, -1}, {-1, 0, -1}}};
  for (int a = 0; a < n * n; ++a) domain.nodes.emplace_back(2.0 * (a % n) / (n - 1) - 1.0, 2.0 * (a / n) / (n - 1) - 1.0);
  if (n == 3) domain.outline = {0, 1, 2, 5, 8, 7, 6, 3}, domain.edge_corners = {{0, 2}, {2, 8}, {8, 6}, {6, 0}};
  if (n == 2) domain.outline = {0, 1, 3, 2}, domain.edge_corners = {{0, 1}, {1, 3}, {3, 2}, {2, 0}};
  return domain;
}

FacetDomain triangle() {
  return {{1.0 / 3.0, 1.0 / 3.0}, 0.5, 0.5, {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}},
          {0, 3, 1, 4, 2, 5}, {{0, 1}, {1, 2}, {2, 0}}, {{0, -2, 0}, {2, 2, -2}, {-2, 0, 0}}};
}

}  // namespace

const FacetDomain& facet_domain(FacetKind kind) {
  static const std::array domains = {square(3), square(2), triangle()};
  return domains[static_cast<int>(kind)];
}

double beyond(const FacetDomain& domain, int edge, const Eigen::Vector2d& xi) {
  return domain.edges[edge].head<2>().dot(xi) + domain.edges[edge][2];
}

Eigen::Vector2d clamped(FacetKind kind, const Eigen::Vector2d& xi) {
  if (kind != FacetKind::tri6) return xi.cwiseMax(-1.0).cwiseMin(1.0);
  const Eigen::Vector3d L = Eigen::Vector3d(1.0 - xi.sum(), xi[0], xi[1]).cwiseMax(0.0);
  return L.tail<2>() / L.sum();
}

FacetShape facet_shape(FacetKind kind, const Eigen::Vector2d& xi) {
  return kind == FacetKind::quad9 ? facet_shape(xi) : kind == FacetKind::quad4 ? bilinear(xi) : quadratic_triangle(xi);
}

const std::vector<FacetRulePoint>& facet_rule(FacetKind kind) {
  static const std::array rules = {square_rule(3), square_rule(2), triangle_rule()};
  return rules[static_cast<int>(kind)];
}

bool project(FacetKind kind, const FacetNodes& nodes, const Eigen::Vector3d& x, double reach, Eigen::Vector2d& xi) {
  const FacetDomain& domain = facet_domain(kind);
  const double low = domain.middle - reach * domain.half_width, high = domain.middle + reach * domain.half_width;
  for (int iteration = 0; iteration < 25; ++iteration) {
    const FacetShape shape = facet_shape(kind, xi);
    const Eigen::Vector3d r = x - nodes * shape.N;
    const Eigen::Matrix<double, 3, 2> t = nodes * shape.dN;
    const Eigen::Matrix<double, 3, 3> second = nodes * shape.ddN;
    Eigen::Matrix2d A = t.transpose() * t;
    const Eigen::Vector3d k = second.transpose() * r;
    Eigen::Matrix2d full = A;
    full(0, 0) -= k[0], full(1, 1) -= k[1], full(0, 1) -= k[2], full(1, 0) -= k[2];
    if (full.determinant() > 0.1 * A.determinant() && full(0, 0) > 0.0) A = full;  // else Gauss-Newton
    Eigen::Vector2d step = A.inverse() * (t.transpose() * r);
    const double longest = step.cwiseAbs().maxCoeff();
    if (longest > 1.0) step /= longest;
    xi += step;
    if (!xi.allFinite()) return false;
    xi = xi.cwiseMax(low).cwiseMin(high);
    if (step.cwiseAbs().maxCoeff() < 1e-13) return true;
    if ((xi.minCoeff() <= low || xi.maxCoeff() >= high) && iteration > 6) return true;
  }
  return true;
}

std::array<int, 27> facet_entries(const Field& positions, const mesh::FacetNodeNumbers& facet) {
  std::array<int, 27> entries{};
  for (int a = 0; a < 9; ++a)
    for (int c = 0; c < 3; ++c) entries[3 * a + c] = positions(facet[a] < 0 ? facet[0] : facet[a], c);
  return entries;
}

FacetNodes facet_positions(const State& state, const Field& positions, const mesh::FacetNodeNumbers& facet) {
  FacetNodes x = FacetNodes::Zero();
  for (int a = 0; a < 9 && facet[a] >= 0; ++a) x.col(a) = state.values.segment<3>(positions(facet[a]));
  return x;
}

FacetNodes facet_positions(const mesh::BodyMesh& mesh, const mesh::FacetNodeNumbers& facet) {
  FacetNodes x = FacetNodes::Zero();
  for (int a = 0; a < 9 && facet[a] >= 0; ++a) x.col(a) = mesh.nodes[facet[a]];
  return x;
}

}  // namespace snug::solver
