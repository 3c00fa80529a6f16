#include "mesh/body/cell_kind.hpp"

#include <cmath>

namespace snug::mesh {

namespace {

constexpr std::array<std::array<int, 2>, 6> tet_edges = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

bool hexahedron(CellKind kind) { return kind != CellKind::tet10; }
int nodes_along(CellKind kind) { return kind == CellKind::hex27 ? 3 : 2; }

/// Value and slope of the Lagrange polynomials on [0, 1].
struct Line {
  std::array<double, 3> value, slope;
};
Line line(int nodes, double r) {
  if (nodes == 2) return {{1.0 - r, r}, {-1.0, 1.0}};
  return {{2.0 * (r - 0.5) * (r - 1.0), 4.0 * r * (1.0 - r), 2.0 * r * (r - 0.5)},
          {4.0 * r - 3.0, 4.0 - 8.0 * r, 4.0 * r - 1.0}};
}

/// Barycentric coordinates and their (constant) gradients.
Eigen::Vector4d barycentric(const Eigen::Vector3d& r) { return {1.0 - r.sum(), r[0], r[1], r[2]}; }
Eigen::Vector3d barycentric_gradient(int vertex) {
  return vertex == 0 ? Eigen::Vector3d::Constant(-1.0) : Eigen::Vector3d(Eigen::Vector3d::Unit(vertex - 1));
}

std::vector<Eigen::Vector3d> make_nodes(CellKind kind) {
  std::vector<Eigen::Vector3d> nodes;
  if (hexahedron(kind)) {
    const int n = nodes_along(kind);
    for (int a = 0; a < n * n * n; ++a)
      nodes.push_back(Eigen::Vector3d(a % n, a / n % n, a / (n * n)) / (n - 1.0));
    return nodes;
  }
  for (int v = 0; v < 4; ++v) nodes.push_back(v == 0 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(Eigen::Vector3d::Unit(v - 1)));
  for (const auto& [a, b] : tet_edges) nodes.push_back(0.5 * (nodes[a] + nodes[b]));
  return nodes;
}

std::vector<SamplePoint> hexahedron_rule(int n) {
  const double d = n == 3 ? std::sqrt(0.15) : 0.5 / std::sqrt(3.0);
  const std::array<double, 3> at = n == 3 ? std::array{0.5 - d, 0.5, 0.5 + d} : std::array{0.5 - d, 0.5 + d, 0.0};
  const std::array<double, 3> weight =
      n == 3 ? std::array{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0} : std::array{0.5, 0.5, 0.0};
  std::vector<SamplePoint> rule;
  for (int q = 0; q < n * n * n; ++q) {
    const int i = q % n, j = q / n % n, k = q / (n * n);
    rule.push_back({{at[i], at[j], at[k]}, weight[i] * weight[j] * weight[k]});
  }
  return rule;
}

std::vector<SamplePoint> tetrahedron_rule() {
  std::vector<SamplePoint> rule;
  const auto vertices = [&](double a, double weight) {  // (1 - 3 a, a, a, a) and its turns
    for (int v = 0; v < 4; ++v) {
      Eigen::Vector3d r = Eigen::Vector3d::Constant(a);
      if (v > 0) r[v - 1] = 1.0 - 3.0 * a;
      rule.push_back({r, weight / 6.0});
    }
  };
  vertices(0.31088591926330060980, 0.11268792571801585080);
  vertices(0.092735250310891226402, 0.073493043116361949544);
  const double near = 0.045503704125649649492, far = 0.5 - near;  // (near, near, far, far) and its turns
  for (const auto& [a, b] : tet_edges) {
    Eigen::Vector4d l = Eigen::Vector4d::Constant(near);
    l[a] = l[b] = far;
    rule.push_back({l.tail<3>(), 0.042546020777081466438 / 6.0});
  }
  return rule;
}

std::vector<SamplePoint> with_nodes(CellKind kind) {
  std::vector<SamplePoint> samples = gauss_points(kind);
  for (const Eigen::Vector3d& node : reference_nodes(kind)) samples.push_back({node, 0.0});
  return samples;
}

std::vector<std::vector<int>> hexahedron_faces(int n) {
  const std::array<int, 3> stride = {1, n, n * n};
  std::vector<std::vector<int>> list;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      int u = (axis + 1) % 3, v = (axis + 2) % 3;  // right-handed with the axis: outwards on the far side
      if (side == 0) std::swap(u, v);
      auto& face = list.emplace_back();
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) face.push_back(side * (n - 1) * stride[axis] + i * stride[u] + j * stride[v]);
    }
  return list;
}

std::vector<std::vector<int>> tetrahedron_faces() {
  const auto middle = [](int a, int b) {
    int e = 0;
    while (!(tet_edges[e][0] == a && tet_edges[e][1] == b) && !(tet_edges[e][0] == b && tet_edges[e][1] == a)) ++e;
    return 4 + e;
  };
  std::vector<std::vector<int>> list;
  for (const auto& [a, b, c] : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
    list.push_back({a, b, c, middle(a, b), middle(b, c), middle(c, a)});
  return list;
}

/// One list a kind, made once.
template <class Make>
auto for_each_kind(Make make) {
  return std::array{make(CellKind::hex27), make(CellKind::hex8), make(CellKind::tet10)};
}

}  // namespace

std::string to_string(CellKind kind) {
  return kind == CellKind::hex27  ? "Q2/P1 hexahedra"
         : kind == CellKind::hex8 ? "Q1/P0 hexahedra"
                                  : "P2/P1 tetrahedra";
}

const std::vector<Eigen::Vector3d>& reference_nodes(CellKind kind) {
  static const auto nodes = for_each_kind(make_nodes);
  return nodes[static_cast<int>(kind)];
}

const std::vector<SamplePoint>& gauss_points(CellKind kind) {
  static const std::array rules = {hexahedron_rule(3), hexahedron_rule(2), tetrahedron_rule()};
  return rules[static_cast<int>(kind)];
}

const std::vector<SamplePoint>& check_points(CellKind kind) {
  static const auto samples = for_each_kind(with_nodes);
  return samples[static_cast<int>(kind)];
}

const std::vector<std::vector<int>>& faces(CellKind kind) {
  static const std::array list = {hexahedron_faces(3), hexahedron_faces(2), tetrahedron_faces()};
  return list[static_cast<int>(kind)];
}

ShapeValues shape_values(CellKind kind, const Eigen::Vector3d& r) {
  ShapeValues N(node_count(kind));
  if (kind == CellKind::tet10) {  // L (2 L - 1) and 4 L_a L_b
    const Eigen::Vector4d L = barycentric(r);
    for (int v = 0; v < 4; ++v) N[v] = L[v] * (2.0 * L[v] - 1.0);
    for (int e = 0; e < 6; ++e) N[4 + e] = 4.0 * L[tet_edges[e][0]] * L[tet_edges[e][1]];
    return N;
  }
  const int n = nodes_along(kind);
  const std::array<Line, 3> l = {line(n, r[0]), line(n, r[1]), line(n, r[2])};
  for (int a = 0; a < n * n * n; ++a)
    N[a] = l[0].value[a % n] * l[1].value[a / n % n] * l[2].value[a / (n * n)];
  return N;
}

ShapeGradients shape_gradients(CellKind kind, const Eigen::Vector3d& r) {
  ShapeGradients d(node_count(kind), 3);
  if (kind == CellKind::tet10) {
    const Eigen::Vector4d L = barycentric(r);
    for (int v = 0; v < 4; ++v) d.row(v) = (4.0 * L[v] - 1.0) * barycentric_gradient(v);
    for (int e = 0; e < 6; ++e) {
      const auto [a, b] = tet_edges[e];
      d.row(4 + e) = 4.0 * (L[a] * barycentric_gradient(b) + L[b] * barycentric_gradient(a));
    }
    return d;
  }
  const int n = nodes_along(kind);
  const std::array<Line, 3> l = {line(n, r[0]), line(n, r[1]), line(n, r[2])};
  for (int a = 0; a < n * n * n; ++a) {
    const int i = a % n, j = a / n % n, k = a / (n * n);
    d.row(a) << l[0].slope[i] * l[1].value[j] * l[2].value[k], l[0].value[i] * l[1].slope[j] * l[2].value[k],
        l[0].value[i] * l[1].value[j] * l[2].slope[k];
  }
  return d;
}

CellPositions cell_positions(CellKind kind, const CellNodes& cell, std::span<const Eigen::Vector3d> nodes) {
  CellPositions x(3, node_count(kind));
  for (int a = 0; a < x.cols(); ++a) x.col(a) = nodes[cell[a]];
  return x;
}

Eigen::Matrix3d jacobian(CellKind kind, const CellPositions& nodes, const Eigen::Vector3d& reference) {
  return nodes * shape_gradients(kind, reference);
}

}  // namespace snug::mesh
