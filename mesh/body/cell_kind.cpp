#include "mesh/body/cell_kind.hpp"

#include <algorithm>
#include <iterator>

namespace snug::mesh {

namespace {

std::vector<Eigen::Vector3d> make_nodes(CellKind kind) {
  const fem::Points nodes = fem::reference_nodes(element(kind));
  return {nodes.colwise().begin(), nodes.colwise().end()};
}

std::vector<SamplePoint> samples(CellKind kind, const fem::Points& points, const Eigen::VectorXd& weights) {
  const fem::Table table = fem::tabulate(element(kind), points);
  std::vector<SamplePoint> samples;
  for (Eigen::Index q = 0; q < points.cols(); ++q)
    samples.push_back({points.col(q), weights[q], table.values.col(q), table.gradients[q]});
  return samples;
}

// Exact to degree 5 (to 3 on hex8), in each coordinate of hexahedra.
std::vector<SamplePoint> gauss(CellKind kind) {
  const fem::Rule rule = fem::quadrature(fem::domain(element(kind)), kind == CellKind::hex8 ? 3 : 5);
  return samples(kind, rule.points, rule.weights);
}

std::vector<SamplePoint> with_nodes(CellKind kind) {
  std::vector<SamplePoint> all = gauss_points(kind);
  const fem::Points nodes = fem::reference_nodes(element(kind));
  std::ranges::copy(samples(kind, nodes, Eigen::VectorXd::Zero(nodes.cols())), std::back_inserter(all));
  return all;
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
    const auto& edges = fem::simplex_edges;
    const auto edge = std::ranges::find_if(edges, [&](const auto& e) { return std::minmax(e[0], e[1]) == std::minmax(a, b); });
    return 4 + static_cast<int>(edge - edges.begin());
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
  static const auto rules = for_each_kind(gauss);
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

CellPositions cell_positions(CellKind kind, const CellNodes& cell, std::span<const Eigen::Vector3d> nodes) {
  CellPositions x(3, node_count(kind));
  for (int a = 0; a < x.cols(); ++a) x.col(a) = nodes[cell[a]];
  return x;
}

Eigen::Matrix3d jacobian(const CellPositions& nodes, const SamplePoint& at) { return nodes * at.gradients; }

}  // namespace snug::mesh
