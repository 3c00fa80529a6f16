#include "mesh/body/quadratic_cells.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <map>
#include <set>

namespace snug::mesh {

namespace {

using Edge = std::pair<int, int>;
Edge edge_of(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// The corners that a node of the reference tetrahedron lies between (twice the same for a corner).
std::vector<std::pair<int, int>> corners_of_nodes() {
  std::vector<std::pair<int, int>> pairs;
  for (const Eigen::Vector3d& r : reference_nodes(CellKind::tet10)) {
    const Eigen::Vector4d share(1.0 - r.sum(), r[0], r[1], r[2]);
    std::vector<int> corner;
    for (int v = 0; v < 4; ++v)
      if (share[v] > 0.25) corner.push_back(v);
    pairs.emplace_back(corner.front(), corner.back());
  }
  return pairs;
}

class Quadratic {
 public:
  Quadratic(const Tetrahedra& cells, const std::vector<NestedSurface>& surfaces, const std::vector<int>& first, const std::vector<std::vector<std::array<int, 3>>>& caps,
            const std::vector<Cut>& cuts)
      : linear_(cells) {
    result_.nodes = cells.nodes;
    make_cells();
    for (std::size_t c = 0; c < caps.size(); ++c) result_.on_cut.push_back(nodes_on(caps[c]));
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      std::vector<std::array<int, 3>> triangles = surfaces[s].mesh.triangles;
      for (auto& t : triangles)
        for (int& v : t) v += first[s];
      result_.on_surface.push_back(nodes_on(triangles));
      curve(surfaces[s], first[s], triangles, cuts);
    }
    straighten_inverted();
  }
  QuadraticCells take() { return std::move(result_); }

 private:
  void make_cells() {
    const auto corner = corners_of_nodes();
    for (std::array<int, 4> t : linear_.cells) {
      const auto& x = linear_.nodes;
      Eigen::Matrix3d edges;
      edges << x[t[1]] - x[t[0]], x[t[2]] - x[t[0]], x[t[3]] - x[t[0]];
      if (edges.determinant() < 0.0) std::swap(t[2], t[3]);
      CellNodes cell;
      cell.fill(-1);
      for (std::size_t a = 0; a < corner.size(); ++a) cell[a] = node(t[corner[a].first], t[corner[a].second]);
      result_.cells.push_back(cell);
    }
  }

  int node(int a, int b) {
    if (a == b) return a;
    const auto [it, fresh] = middle_.try_emplace(edge_of(a, b), static_cast<int>(result_.nodes.size()));
    if (fresh) result_.nodes.push_back(0.5 * (linear_.nodes[a] + linear_.nodes[b]));
    return it->second;
  }

  std::vector<int> nodes_on(const std::vector<std::array<int, 3>>& triangles) {
    std::set<int> nodes;
    for (const auto& t : triangles)
      for (int n = 0; n < 3; ++n) {
        nodes.insert(t[n]);
        if (const auto it = middle_.find(edge_of(t[n], t[(n + 1) % 3])); it != middle_.end()) nodes.insert(it->second);
      }
    return {nodes.begin(), nodes.end()};
  }

  /// The middles of a surface's edges go onto its smooth shape, those of its rims in their planes. Where that is far from the edge, as over
  /// a crease that was left as it is, they stay.
  void curve(const NestedSurface& surface, int first, const std::vector<std::array<int, 3>>& triangles, const std::vector<Cut>& cuts) {
    constexpr double farthest = 0.15;  // of the edge's length
    std::map<Edge, int> rim;
    for (std::size_t c = 0; c < surface.rims.size(); ++c)
      for (const Rim& loop : surface.rims[c])
        for (std::size_t n = 0; n < loop.size(); ++n) rim[edge_of(loop[n] + first, loop[(n + 1) % loop.size()] + first)] = static_cast<int>(c);
    std::set<Edge> done;
    for (const auto& t : triangles)
      for (int n = 0; n < 3; ++n) {
        const Edge edge = edge_of(t[n], t[(n + 1) % 3]);
        const auto at = middle_.find(edge);
        if (at == middle_.end() || !done.insert(edge).second) continue;
        const Eigen::Vector3d straight = result_.nodes[at->second];
        const auto r = rim.find(edge);
        const Eigen::Vector3d x = r == rim.end() ? surface.smooth->onto(straight).x : surface.smooth->onto(straight, cuts[r->second].point, cuts[r->second].normal);
        if ((x - straight).norm() > farthest * (linear_.nodes[edge.first] - linear_.nodes[edge.second]).norm()) continue;
        result_.nodes[at->second] = x;
        curved_[at->second] = straight;
      }
  }

  /// Halves the bow of the edges of cells that turn inside out.
  void straighten_inverted() {
    std::set<int> touched;
    for (int round = 0; round < 12; ++round) {
      std::set<int> bad;
      for (const CellNodes& cell : result_.cells) {
        const CellPositions x = cell_positions(CellKind::tet10, cell, result_.nodes);
        double least = 1e300, most = 0.0;
        for (const SamplePoint& sample : check_points(CellKind::tet10)) {
          const double J = jacobian(x, sample).determinant();
          least = std::min(least, J), most = std::max(most, J);
        }
        if (least > 0.1 * most) continue;
        for (int a = 0; a < 10; ++a)
          if (curved_.count(cell[a])) bad.insert(cell[a]);
      }
      if (bad.empty()) break;
      for (const int n : bad) result_.nodes[n] = 0.5 * (result_.nodes[n] + curved_.at(n)), touched.insert(n);
    }
    result_.straightened = static_cast<int>(touched.size());
  }

  const Tetrahedra& linear_;
  QuadraticCells result_;
  std::map<Edge, int> middle_;
  std::map<int, Eigen::Vector3d> curved_;  // where they were
};

}  // namespace

QuadraticCells quadratic(const Tetrahedra& cells, const std::vector<NestedSurface>& surfaces, const std::vector<int>& first,
                         const std::vector<std::vector<std::array<int, 3>>>& caps, const std::vector<Cut>& cuts) {
  return Quadratic(cells, surfaces, first, caps, cuts).take();
}

}  // namespace snug::mesh
