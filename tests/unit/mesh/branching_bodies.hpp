// Bodies that branch, for the tests: what a function says is inside, in quadratic tetrahedra with curved faces, both sides mirror images.
#pragma once

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "tests/unit/mesh/placement_patterns.hpp"
#include "tests/unit/mesh/standing_bodies.hpp"

namespace snug::mesh {

/// Cubes of a lattice between two heights, each in six tetrahedra round its diagonal; vertices near the surface are moved onto it, tetrahedra
/// that reach out of the body are cut there (after Labelle & Shewchuk, ACM Trans. Graph. 26 (2007) 57, without their bounds on angles), and
/// the nodes of the surface's edges put on it. The half at x > 0 is meshed and mirrored.
class ImplicitBody {
 public:
  using Function = std::function<double(const Eigen::Vector3d&)>;  ///< negative inside; about a distance, m

  /// The lattice covers |x| < reach.x, |y| < reach.y, lower < z < upper in cubes of about `size` (m). Nodes deeper than `core` (m) are a
  /// rigid bone.
  ImplicitBody(Function inside, Eigen::Vector2d reach, double lower, double upper, double size, double core)
      : f_(std::move(inside)), lower_(lower), upper_(upper) {
    count_ = {static_cast<int>(std::ceil(reach.x() / size)), 2 * static_cast<int>(std::ceil(reach.y() / size)),
              static_cast<int>(std::lround((upper - lower) / size))};
    step_ = {reach.x() / count_[0], 2.0 * reach.y() / count_[1], (upper - lower) / count_[2]};
    lay_points(reach.y());
    for (int k = 0; k < count_[2]; ++k)
      for (int j = 0; j < count_[1]; ++j)
        for (int i = 0; i < count_[0]; ++i) add_cube(i, j, k);
    mirror();
    make_quadratic();
    name_surfaces(core);
  }
  BodyMesh take() { return std::move(mesh_); }

 private:
  using Tet = std::array<int, 4>;

  int number(int i, int j, int k) const { return (k * (count_[1] + 1) + j) * (count_[0] + 1) + i; }

  void lay_points(double reach_y) {
    for (int k = 0; k <= count_[2]; ++k)
      for (int j = 0; j <= count_[1]; ++j)
        for (int i = 0; i <= count_[0]; ++i) {
          Eigen::Vector3d x(i * step_.x(), j * step_.y() - reach_y, k == count_[2] ? upper_ : lower_ + k * step_.z());
          double value = f_(x);
          const Eigen::Vector3d on = projected(x, fixed_planes(x));
          if ((on - x).norm() < 0.3 * step_.minCoeff() && std::abs(f_(on)) < 1e-9) x = on, value = 0.0;
          points_.push_back(x), value_.push_back(value);
        }
  }

  /// Planes that a point has to stay on: the middle, and the two cuts.
  Eigen::Vector3d fixed_planes(const Eigen::Vector3d& x) const {
    constexpr double on = 1e-12;
    return {std::abs(x.x()) < on ? 0.0 : 1.0, 1.0, std::abs(x.z() - lower_) < on || std::abs(x.z() - upper_) < on ? 0.0 : 1.0};
  }

  /// Onto the surface along its gradient, as far as `free` (1 a coordinate that may change) lets it.
  Eigen::Vector3d projected(Eigen::Vector3d x, const Eigen::Vector3d& free) const {
    constexpr double h = 1e-6;
    for (int n = 0; n < 20; ++n) {
      const double value = f_(x);
      if (std::abs(value) < 1e-13) break;
      Eigen::Vector3d g;
      for (int a = 0; a < 3; ++a) g[a] = free[a] * (f_(x + h * Eigen::Vector3d::Unit(a)) - f_(x - h * Eigen::Vector3d::Unit(a))) / (2.0 * h);
      if (g.squaredNorm() < 1e-6) break;
      x -= value / g.squaredNorm() * g;
    }
    return x;
  }

  void add_cube(int i, int j, int k) {
    static constexpr std::array<std::array<int, 3>, 6> orders = {{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (const auto& order : orders) {
      std::array<int, 3> at = {i, j, k};
      Tet tet{number(i, j, k), 0, 0, 0};
      for (int n = 0; n < 3; ++n) ++at[order[n]], tet[n + 1] = number(at[0], at[1], at[2]);
      cut(tet);
    }
  }

  /// What of a tetrahedron is inside.
  void cut(const Tet& tet) {
    std::vector<int> in, zero, out;
    for (const int v : tet) (value_[v] < 0.0 ? in : value_[v] > 0.0 ? out : zero).push_back(v);
    if (in.empty()) return;
    if (out.empty()) return add(tet);
    const auto to = [&](int a, int b) { return crossing(in[a], out[b]); };
    if (in.size() == 1) {
      Tet part{in[0], 0, 0, 0};
      int n = 1;
      for (const int z : zero) part[n++] = z;
      for (std::size_t b = 0; b < out.size(); ++b) part[n++] = to(0, static_cast<int>(b));
      return add(part);
    }
    if (in.size() == 3) return add_prism({in[0], in[1], in[2], to(0, 0), to(1, 0), to(2, 0)});
    if (out.size() == 2) return add_prism({in[0], to(0, 0), to(0, 1), in[1], to(1, 0), to(1, 1)});
    const std::array<int, 4> base = {in[0], in[1], to(1, 0), to(0, 0)};  // of a pyramid
    const auto first = std::min_element(base.begin(), base.end()) - base.begin();
    add({base[first], base[(first + 1) % 4], base[(first + 2) % 4], zero[0]}), add({base[first], base[(first + 2) % 4], base[(first + 3) % 4], zero[0]});
  }

  int crossing(int in, int out) {
    const auto [found, fresh] = crossings_.emplace(std::minmax(in, out), static_cast<int>(points_.size()));
    if (!fresh) return found->second;
    Eigen::Vector3d a = points_[in], b = points_[out];
    for (int n = 0; n < 60; ++n) {
      const Eigen::Vector3d middle = 0.5 * (a + b);
      (f_(middle) < 0.0 ? a : b) = middle;
    }
    points_.push_back(0.5 * (a + b)), value_.push_back(0.0);
    return found->second;
  }

  /// Every side is cut from its lowest number, so that neighbours cut it alike (Dompierre et al., 8th Meshing Roundtable (1999)).
  void add_prism(const std::array<int, 6>& nodes) {
    static constexpr std::array<std::array<int, 6>, 6> turned = {
        {{0, 1, 2, 3, 4, 5}, {1, 2, 0, 4, 5, 3}, {2, 0, 1, 5, 3, 4}, {3, 5, 4, 0, 2, 1}, {4, 3, 5, 1, 0, 2}, {5, 4, 3, 2, 1, 0}}};
    const auto& turn = turned[std::min_element(nodes.begin(), nodes.end()) - nodes.begin()];
    std::array<int, 6> v{};
    for (int n = 0; n < 6; ++n) v[n] = nodes[turn[n]];
    if (std::min(v[1], v[5]) < std::min(v[2], v[4]))
      add({v[0], v[1], v[2], v[5]}), add({v[0], v[1], v[5], v[4]}), add({v[0], v[4], v[5], v[3]});
    else
      add({v[0], v[1], v[2], v[4]}), add({v[0], v[4], v[2], v[5]}), add({v[0], v[4], v[5], v[3]});
  }

  double volume(const Tet& t) const {
    return (points_[t[1]] - points_[t[0]]).cross(points_[t[2]] - points_[t[0]]).dot(points_[t[3]] - points_[t[0]]) / 6.0;
  }

  void add(Tet tet) {
    const double v = volume(tet);
    if (v < 0.0) std::swap(tet[2], tet[3]);
    if (std::abs(v) > 0.0) tets_.push_back(tet);
  }

  void mirror() {
    std::vector<int> image(points_.size());
    const std::size_t points = points_.size(), tets = tets_.size();
    for (std::size_t n = 0; n < points; ++n) {
      image[n] = static_cast<int>(n);
      if (points_[n].x() == 0.0) continue;
      image[n] = static_cast<int>(points_.size());
      points_.push_back({-points_[n].x(), points_[n].y(), points_[n].z()}), value_.push_back(value_[n]);
    }
    for (std::size_t t = 0; t < tets; ++t) tets_.push_back({image[tets_[t][0]], image[tets_[t][1]], image[tets_[t][3]], image[tets_[t][2]]});
  }

  int node_of(int point) {
    const auto [found, fresh] = node_.emplace(point, static_cast<int>(mesh_.nodes.size()));
    if (fresh) mesh_.nodes.push_back(points_[point]);
    return found->second;
  }

  void make_quadratic() {
    mesh_.kind = CellKind::tet10;
    mesh_.layers = {{"tissue", {}}};
    std::map<std::pair<int, int>, int> middles;
    for (const Tet& tet : tets_) {
      CellNodes cell;
      cell.fill(-1);
      for (int a = 0; a < 10; ++a) {
        const Eigen::Vector3d r = reference_nodes(CellKind::tet10)[a];
        const std::array<double, 4> L = {1.0 - r.sum(), r[0], r[1], r[2]};
        std::vector<int> ends;
        for (int v = 0; v < 4; ++v)
          if (L[v] > 0.25) ends.push_back(node_of(tet[v]));
        if (ends.size() == 1) {
          cell[a] = ends[0];
          continue;
        }
        const auto [found, fresh] = middles.emplace(std::minmax(ends[0], ends[1]), static_cast<int>(mesh_.nodes.size()));
        if (fresh) mesh_.nodes.push_back(0.5 * (mesh_.nodes[ends[0]] + mesh_.nodes[ends[1]]));
        cell[a] = found->second;
      }
      mesh_.cells.push_back(cell), mesh_.cell_layer.push_back(0);
    }
    curve_surface();
  }

  bool on_plane(const FacetNodeNumbers& facet, double z) const {
    return std::all_of(facet.begin(), facet.begin() + 6, [&](int n) { return std::abs(mesh_.nodes[n].z() - z) < 1e-12; });
  }

  std::vector<FacetNodeNumbers> facets(bool skin, double plane) const {
    std::vector<FacetNodeNumbers> found;
    for (const auto& facet : boundary_facets(mesh_, std::vector<char>(mesh_.nodes.size(), 1)))
      if (skin ? !on_plane(facet, lower_) && !on_plane(facet, upper_) : on_plane(facet, plane)) found.push_back(facet);
    return found;
  }

  /// Nodes in the middles of the skin's edges go onto it; back by halves where a cell would be inverted.
  void curve_surface() {
    const std::vector<Eigen::Vector3d> flat = mesh_.nodes;
    std::map<int, Eigen::Vector3d> lift;
    for (const auto& facet : facets(true, 0.0))
      for (int a = 3; a < 6; ++a) lift[facet[a]] = projected(flat[facet[a]], fixed_planes(flat[facet[a]])) - flat[facet[a]];
    for (const auto& [node, by] : lift) mesh_.nodes[node] = flat[node] + by;
    for (bool sound = false; !sound;) {
      sound = true;
      for (const CellNodes& cell : mesh_.cells) {
        const CellPositions x = cell_positions(mesh_.kind, cell, mesh_.nodes);
        const auto& points = check_points(mesh_.kind);
        if (std::all_of(points.begin(), points.end(), [&](const auto& p) { return jacobian(x, p).determinant() > 0.0; })) continue;
        bool changed = false;
        for (int a = 0; a < 10; ++a)
          if (const auto found = lift.find(cell[a]); found != lift.end() && found->second.norm() > 1e-9)
            found->second *= 0.5, mesh_.nodes[cell[a]] = flat[cell[a]] + found->second, changed = true;
        if (!changed) throw std::logic_error("a cell of the implicit body is flat");
        sound = false;
      }
    }
  }

  void name_surfaces(double core) {
    const auto add = [&](const char* name, std::vector<FacetNodeNumbers> facets) {
      Surface surface{name, std::move(facets), {}};
      for (const auto& facet : surface.facets) surface.nodes.insert(surface.nodes.end(), facet.begin(), facet.begin() + 6);
      std::sort(surface.nodes.begin(), surface.nodes.end());
      surface.nodes.erase(std::unique(surface.nodes.begin(), surface.nodes.end()), surface.nodes.end());
      mesh_.surfaces.push_back(std::move(surface));
    };
    add("skin", facets(true, 0.0)), add("lower", facets(false, lower_)), add("upper", facets(false, upper_));
    mesh_.skin_facets = mesh_.surfaces[0].facets;
    mesh_.mean_skin_cell = mean_edge(mesh_, mesh_.skin_facets);
    mesh_.node_location.assign(mesh_.nodes.size(), -1);
    for (std::size_t n = 0; n < mesh_.nodes.size(); ++n)
      if (f_(mesh_.nodes[n]) < -core) mesh_.bone_nodes.push_back(static_cast<int>(n));
  }

  Function f_;
  double lower_, upper_;
  std::array<int, 3> count_{};
  Eigen::Vector3d step_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<double> value_;
  std::vector<Tet> tets_;
  std::map<std::pair<int, int>, int> crossings_;
  std::map<int, int> node_;
  BodyMesh mesh_;
};

/// Negative inside hips of a child and the upper parts of its thighs, 0.46 m high: x to its right, y to the front, z up.
inline double hips(const Eigen::Vector3d& p) {
  constexpr double blend = 0.04;  // m
  const Eigen::Vector3d q(std::abs(p.x()), p.y(), p.z()), flat(q.x() / 1.3, q.y(), q.z());
  const double trunk = round_cone(flat, {0, 0, 0.32}, {0, 0, 0.62}, 0.088, 0.08), leg = round_cone(q, {0.070, 0, -0.1}, {0.062, 0, 0.30}, 0.046, 0.056);
  const double h = std::max(blend - std::abs(trunk - leg), 0.0) / blend;
  return std::min(trunk, leg) - 0.25 * h * h * blend;
}

/// The hips in cells of about `size` (m), with a rigid core 30 mm below the skin.
inline BodyMesh hips_body(double size) { return ImplicitBody(hips, {0.14, 0.11}, 0.0, 0.46, size, 0.03).take(); }

/// Shorts for the hips, an eighth narrower; front and back alike.
inline const std::string shorts_outline = R"(  { name = "hem",    from = [0.5, 8] },
  { name = "inseam", from = [14, 8] },
  { name = "crotch", kind = "cubic", from = [15.8, 22], control = [[14.4, 22.3], [14.1, 24]] },
  { name = "rise",   from = [14, 27] },
  { name = "waist",  from = [13.2, 40] },
  { name = "side",   kind = "cubic", from = [0.5, 40], control = [[0, 30], [0, 20]] },
)";
inline const std::string test_shorts = legs_pattern(shorts_outline, shorts_outline) + R"([[hem]]
name = "waist"
edges = "front right.waist + front left.waist + back left.waist + back right.waist"
)";

}  // namespace snug::mesh
