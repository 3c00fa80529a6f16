#include "solver/terms/facet_kind.hpp"

#include <Eigen/Dense>

namespace snug::solver {

using mesh::FacetKind, mesh::max_facet_nodes;

namespace {

std::vector<FacetRulePoint> rule_of(FacetKind kind) {
  const fem::Rule rule = fem::quadrature(fem::domain(element(kind)), kind == FacetKind::quad4 ? 3 : 5);
  std::vector<FacetRulePoint> points;
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
    points.push_back({rule.points.col(q), rule.weights[q], facet_shape(kind, rule.points.col(q))});
  return points;
}

std::vector<Eigen::Vector2d> nodes_of(FacetKind kind) {
  const fem::Points nodes = fem::reference_nodes(element(kind));
  return {nodes.colwise().begin(), nodes.colwise().end()};
}

FacetDomain square(FacetKind kind) {
  FacetDomain domain{Eigen::Vector2d::Zero(), 0.0, 1.0, nodes_of(kind), {}, {}, {{0, -1, -1}, {1, 0, -1}, {0, 1, -1}, {-1, 0, -1}}};
  if (kind == FacetKind::quad9) domain.outline = {0, 1, 2, 5, 8, 7, 6, 3}, domain.edge_corners = {{0, 2}, {2, 8}, {8, 6}, {6, 0}};
  if (kind == FacetKind::quad4) domain.outline = {0, 1, 3, 2}, domain.edge_corners = {{0, 1}, {1, 3}, {3, 2}, {2, 0}};
  return domain;
}

FacetDomain triangle() {
  return {{1.0 / 3.0, 1.0 / 3.0}, 0.5, 0.5, nodes_of(FacetKind::tri6), {0, 3, 1, 4, 2, 5}, {{0, 1}, {1, 2}, {2, 0}},
          {{0, -2, 0}, {2, 2, -2}, {-2, 0, 0}}};
}

}  // namespace

const FacetDomain& facet_domain(FacetKind kind) {
  static const std::array domains = {square(FacetKind::quad9), square(FacetKind::quad4), triangle()};
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
  return kind == FacetKind::quad9   ? fem::plane_shape<fem::Element::quad9>(xi)
         : kind == FacetKind::quad4 ? fem::plane_shape<fem::Element::quad4, max_facet_nodes>(xi)
                                    : fem::plane_shape<fem::Element::tri6, max_facet_nodes>(xi);
}

const std::vector<FacetRulePoint>& facet_rule(FacetKind kind) {
  static const std::array rules = {rule_of(FacetKind::quad9), rule_of(FacetKind::quad4), rule_of(FacetKind::tri6)};
  return rules[static_cast<int>(kind)];
}

namespace {

template <fem::Element element>
bool project_on(const FacetDomain& domain, const FacetNodes& slots, const Eigen::Vector3d& x, double reach, Eigen::Vector2d& xi) {
  const Eigen::Matrix<double, 3, fem::node_count(element)> nodes = slots.leftCols<fem::node_count(element)>();
  const double low = domain.middle - reach * domain.half_width, high = domain.middle + reach * domain.half_width;
  for (int iteration = 0; iteration < 25; ++iteration) {
    const auto shape = fem::plane_shape<element>(xi);
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

}  // namespace

bool project(FacetKind kind, const FacetNodes& nodes, const Eigen::Vector3d& x, double reach, Eigen::Vector2d& xi) {
  const FacetDomain& domain = facet_domain(kind);
  switch (kind) {
    case FacetKind::quad9: return project_on<fem::Element::quad9>(domain, nodes, x, reach, xi);
    case FacetKind::quad4: return project_on<fem::Element::quad4>(domain, nodes, x, reach, xi);
    case FacetKind::tri6: return project_on<fem::Element::tri6>(domain, nodes, x, reach, xi);
  }
  return false;
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
