// Sheets without a body: the meshes, supports and answers of the membrane rows.
#pragma once

#include <Eigen/Eigenvalues>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <vector>

#include "solver/stepping/load_path.hpp"
#include "solver/terms/dead_load.hpp"
#include "solver/terms/fabric_bending.hpp"
#include "solver/terms/garment_shape.hpp"
#include "solver/terms/pressure_load.hpp"
#include "tests/scenes.hpp"

namespace snug::tests {

using Plane = Eigen::Vector2d;
using Middle = std::function<Plane(const Plane&, const Plane&)>;

/// Where the edge between two points on a circle about the origin is bent to; other edges are straight.
inline Plane on_arc(const Plane& a, const Plane& b) {
  const Plane m = 0.5 * (a + b);
  return std::abs(a.norm() - b.norm()) < 1e-9 * a.norm() ? Plane(m * (a.norm() / m.norm())) : m;
}
inline Plane straight(const Plane& a, const Plane& b) { return 0.5 * (a + b); }

/// Quadratic triangles in the plane z = 0, as cut; mid-edge nodes stand where `middle` says.
inline mesh::GarmentMesh flat_sheet(const std::vector<Plane>& vertices, const std::vector<std::array<int, 3>>& triangles,
                                    const Middle& middle = straight) {
  mesh::GarmentMesh mesh;
  mesh.pattern = vertices;
  std::map<std::pair<int, int>, int> between;
  double edges = 0.0;
  for (const auto& t : triangles) {
    auto& nodes = mesh.triangles.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      const auto [it, fresh] = between.emplace(std::minmax(a, b), static_cast<int>(mesh.pattern.size()));
      if (fresh) mesh.pattern.push_back(middle(vertices[a], vertices[b])), edges += (vertices[a] - vertices[b]).norm();
      nodes[k] = a, nodes[3 + k] = it->second;
    }
  }
  for (std::size_t node = 0; node < mesh.pattern.size(); ++node) {
    mesh.placed.emplace_back(mesh.pattern[node].x(), mesh.pattern[node].y(), 0.0);
    mesh.merged.push_back(static_cast<int>(node));
  }
  mesh.warp.assign(mesh.triangles.size(), Plane::UnitX());
  mesh.mean_edge = edges / static_cast<double>(between.size());
  return mesh;
}

/// n x m cells of the unit square through `map`, each cut in two with alternating diagonals.
inline mesh::GarmentMesh mapped_sheet(int n, int m, const std::function<Plane(double, double)>& map,
                                      const Middle& middle = straight) {
  std::vector<Plane> vertices;
  std::vector<std::array<int, 3>> triangles;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i) vertices.push_back(map(double(i) / n, double(j) / m));
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
      if ((i + j) % 2 == 0)
        triangles.push_back({a, b, c}), triangles.push_back({a, c, d});
      else
        triangles.push_back({a, b, d}), triangles.push_back({b, c, d});
    }
  return flat_sheet(vertices, triangles, middle);
}

/// The k-th of n rings of a quarter_disc, in radii: closer together towards the pole, where the curvature of the tension is.
inline double ring_radius(int k, int n) { return std::pow(double(k) / n, 1.5); }

/// A quarter of a disc in n rings of triangles, its rim on the circle.
inline mesh::GarmentMesh quarter_disc(int n, double radius) {
  std::vector<Plane> vertices;
  std::vector<std::array<int, 3>> triangles;
  const auto number = [](int ring, int j) { return ring * (ring + 1) / 2 + j; };
  for (int ring = 0; ring <= n; ++ring)
    for (int j = 0; j <= ring; ++j) {
      const double angle = ring == 0 ? 0.0 : 0.5 * std::numbers::pi * j / ring, r = radius * ring_radius(ring, n);
      vertices.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
  for (int ring = 0; ring < n; ++ring)
    for (int j = 0; j <= ring; ++j) {
      triangles.push_back({number(ring, j), number(ring + 1, j), number(ring + 1, j + 1)});
      if (j < ring) triangles.push_back({number(ring, j), number(ring + 1, j + 1), number(ring, j + 1)});
    }
  return flat_sheet(vertices, triangles, [&](const Plane& a, const Plane& b) {
    return std::abs(a.norm() - radius) < 1e-9 * radius ? on_arc(a, b) : straight(a, b);
  });
}

/// St Venant-Kirchhoff in plane stress: W = K/2 (E11^2 + E22^2 + 2 nu E11 E22) + G/2 (2 E12)^2, K = Eh/(1 - nu^2),
/// G = Eh/(2 (1 + nu)). `youngs` is Eh, N/m.
inline materials::Fabric isotropic(double youngs, double nu) {
  materials::Fabric fabric;
  const double K = youngs / (1.0 - nu * nu);
  fabric.warp = fabric.weft = materials::TensionCurve::linear(K);
  fabric.coupling = nu * K;
  fabric.shear = youngs / (2.0 * (1.0 + nu));
  return fabric;
}

/// A garment alone: who is held, what pulls, and the answer.
struct Sheet {
  mesh::GarmentMesh mesh;
  materials::Fabric fabric;
  std::vector<materials::Fabric> zones;  ///< of mesh.triangle_zone
  solver::Layout layout;
  std::vector<int> master;
  solver::NodalForces forces;   ///< dead, at full load
  double pressure = 0.0;        ///< Pa, follower, along the normal (blows up)
  double eta = 1e-3;            ///< residual stiffness in compression
  solver::PathSettings settings;
  solver::PathResult answer;
  int iterations = 0;

  Sheet(mesh::GarmentMesh m, materials::Fabric f)
      : mesh(std::move(m)), fabric(std::move(f)), layout(tests::make_layout({}, mesh, false, false)), master(layout.size()),
        forces(mesh.pattern.size(), Eigen::Vector3d::Zero()) {
    for (int i = 0; i < layout.size(); ++i) master[i] = i;
  }
  int size() const { return static_cast<int>(mesh.pattern.size()); }
  /// Joins nodes whose places satisfy `left` to those of equal height that satisfy `right`.
  void sew(const std::function<bool(const Plane&)>& left, const std::function<bool(const Plane&)>& right) {
    for (int a = 0; a < size(); ++a)
      for (int b = 0; b < size(); ++b)
        if (left(mesh.pattern[a]) && right(mesh.pattern[b]) && std::abs(mesh.pattern[a].y() - mesh.pattern[b].y()) < 1e-9) {
          mesh.merged[b] = a;
          for (int c = 0; c < 3; ++c) master[layout["garment"](b, c)] = layout["garment"](a, c);
        }
  }
  /// Holds components of the nodes whose place in the pattern satisfies `where`.
  void hold(const std::vector<int>& components, const std::function<bool(const Plane&)>& where) {
    for (int node = 0; node < size(); ++node)
      if (where(mesh.pattern[node]))
        for (const int c : components) master[layout["garment"](node, c)] = -1;
  }
  std::vector<materials::Fabric> fabrics() const {
    std::vector<materials::Fabric> all{fabric};
    all.insert(all.end(), zones.begin(), zones.end());
    return all;
  }
  solver::Scene scene() const {
    solver::Scene scene(layout, solver::Numbering(master));
    auto membrane = std::make_unique<solver::FabricMembrane>("garment", layout["garment"], mesh, fabrics());
    membrane->set_final_eta(eta);
    scene.add(std::move(membrane));
    std::vector<materials::BendingStiffness> bending;
    for (const materials::Fabric& one : fabrics()) bending.push_back(one.bending);
    if (fabric.bending.warp != 0.0) scene.add(std::make_unique<solver::FabricBending>("garment", layout["garment"], mesh, bending));
    if (pressure != 0.0) {
      auto load = std::make_unique<solver::PressureLoad>(layout["garment"], mesh, -pressure);
      load->hold_border(scene.numbering());
      scene.add(std::move(load));
    }
    scene.add(std::make_unique<solver::DeadLoad>("weight of the garment", layout["garment"], forces));
    return scene;
  }
  /// From the places in `mesh.placed`; the load goes from nothing to full along `homotopy`.
  void solve(const solver::Homotopy& homotopy = solver::tightening(), const solver::IterationSink& sink = [](const auto&) {}) {
    solver::Scene parts = scene();
    answer = solver::follow_path(parts, tests::placed_state(layout, {}, mesh), homotopy, settings, [&](const auto& row) {
      ++iterations;
      sink(row);
    });
    EXPECT_TRUE(answer.complete) << answer.message << " at " << answer.reached;
  }
  Eigen::Vector3d at(int node) const { return answer.state.values.segment<3>(layout["garment"](mesh.merged[node])); }
  int node_at(const Plane& place) const {
    int best = 0;
    for (int node = 1; node < size(); ++node)
      if ((mesh.pattern[node] - place).norm() < (mesh.pattern[best] - place).norm()) best = node;
    EXPECT_LE((mesh.pattern[best] - place).norm(), 1e-9);
    return best;
  }
  /// Forces of the supports on the nodes that satisfy `where`.
  std::map<int, Eigen::Vector3d> reactions(const std::function<bool(const Plane&)>& where) const {
    const Eigen::VectorXd residual = scene().full_residual(answer.state);
    std::map<int, Eigen::Vector3d> forces;
    for (int node = 0; node < size(); ++node)
      if (where(mesh.pattern[node])) forces[node] = residual.segment<3>(layout["garment"](node));
    return forces;
  }
  /// Deformation gradient (3 x 2, along the pattern) at area coordinates of a triangle.
  Eigen::Matrix<double, 3, 2> gradient(int triangle, const Eigen::Vector3d& L) const {
    Eigen::Matrix<double, 2, 6> X;
    Eigen::Matrix<double, 3, 6> x;
    for (int a = 0; a < 6; ++a) X.col(a) = mesh.pattern[mesh.triangles[triangle][a]], x.col(a) = at(mesh.triangles[triangle][a]);
    return x * solver::pattern_point(mesh.order, X, L).gradient;
  }
};

/// Second Piola-Kirchhoff line forces (warp along x) of a deformation gradient.
inline Eigen::Matrix2d line_forces(const materials::Fabric& fabric, const Eigen::Matrix<double, 3, 2>& F, double eta) {
  const Eigen::Matrix2d C = F.transpose() * F;
  const Eigen::Vector3d N = fabric.relaxed({0.5 * (C(0, 0) - 1.0), 0.5 * (C(1, 1) - 1.0), C(0, 1)}, eta).force;
  return (Eigen::Matrix2d() << N[0], N[2], N[2], N[1]).finished();
}

}  // namespace snug::tests
