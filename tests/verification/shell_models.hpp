// Shells made in code as the models that a file would give.
#pragma once

#include <cmath>
#include <functional>
#include <map>

#include "mesh/body/foreign.hpp"
#include "tests/verification/blocks.hpp"

namespace snug::tests {

using SurfaceMap = std::function<Eigen::Vector3d(double, double)>;
using Holds = std::function<bool(const Eigen::Vector3d&)>;

inline mesh::Model empty_shell(double E, double nu, double thickness) {
  mesh::Model model;
  model.materials = {{"SHELL", mesh::ModelLaw::elastic, {E, nu}, 0.0}};
  model.sections = {{thickness, 0.0}};
  return model;
}

/// Nodes of quadratic triangles by their place on an integer lattice.
struct ShellLattice {
  mesh::Model& model;
  std::function<Eigen::Vector3d(int, int)> at;
  std::map<std::pair<int, int>, int> number = {};

  int node(int i, int j) {
    const auto [it, fresh] = number.emplace(std::pair{i, j}, static_cast<int>(model.nodes.size()) + 1);
    if (fresh) model.nodes.push_back({it->second, at(i, j)});
    return it->second;
  }
  /// Corners at even places.
  void triangle(std::array<int, 2> a, std::array<int, 2> b, std::array<int, 2> c) {
    const auto mid = [&](const std::array<int, 2>& p, const std::array<int, 2>& q) { return node((p[0] + q[0]) / 2, (p[1] + q[1]) / 2); };
    model.elements.push_back({static_cast<int>(model.elements.size()) + 1, mesh::ElementKind::tri6,
                              {node(a[0], a[1]), node(b[0], b[1]), node(c[0], c[1]), mid(a, b), mid(b, c), mid(c, a)}, 0, 0});
  }
};

/// n x m pairs of triangles on the unit square, taken to their place by `map`; diagonals alternate.
inline mesh::Model square_shell(int n, int m, const SurfaceMap& map, double E, double nu, double thickness) {
  mesh::Model model = empty_shell(E, nu, thickness);
  ShellLattice lattice{model, [&](int i, int j) { return map(0.5 * i / n, 0.5 * j / m); }};
  for (int j = 0; j < 2 * m; j += 2)
    for (int i = 0; i < 2 * n; i += 2)
      if ((i + j) % 4 == 0) {
        lattice.triangle({i, j}, {i + 2, j}, {i + 2, j + 2});
        lattice.triangle({i, j}, {i + 2, j + 2}, {i, j + 2});
      } else {
        lattice.triangle({i, j}, {i + 2, j}, {i, j + 2});
        lattice.triangle({i + 2, j}, {i + 2, j + 2}, {i, j + 2});
      }
  return model;
}

/// An eighth of a sphere, n x n triangles, normals outwards.
inline mesh::Model octant(int n, double radius, double E, double nu, double thickness) {
  mesh::Model model = empty_shell(E, nu, thickness);
  ShellLattice lattice{model, [&](int i, int j) {
                         return Eigen::Vector3d(radius * Eigen::Vector3d(2 * n - i - j, i, j).normalized());
                       }};
  for (int j = 0; j < 2 * n; j += 2)
    for (int i = 0; i + j < 2 * n; i += 2) {
      lattice.triangle({i, j}, {i + 2, j}, {i, j + 2});
      if (i + j + 2 < 2 * n) lattice.triangle({i + 2, j}, {i + 2, j + 2}, {i, j + 2});
    }
  return model;
}

/// A quarter of a flat disc, n x n triangles from the middle outwards.
inline mesh::Model quarter_disc(int n, double radius, double E, double nu, double thickness) {
  mesh::Model model = empty_shell(E, nu, thickness);
  ShellLattice lattice{model, [&](int i, int j) {
                         const double angle = i + j > 0 ? 0.5 * std::numbers::pi * j / (i + j) : 0.0;
                         const double r = radius * (i + j) / (2.0 * n);
                         return Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), 0.0);
                       }};
  for (int j = 0; j < 2 * n; j += 2)
    for (int i = 0; i + j < 2 * n; i += 2) {
      lattice.triangle({i, j}, {i + 2, j}, {i, j + 2});
      if (i + j + 2 < 2 * n) lattice.triangle({i + 2, j}, {i + 2, j + 2}, {i, j + 2});
    }
  return model;
}

/// Holds components (0 to 5: x, y, z and the rotations about them) of the nodes that `holds`.
inline void hold(mesh::Model& model, const Holds& holds, const std::vector<int>& components) {
  for (const mesh::ModelNode& node : model.nodes)
    if (holds(node.at))
      for (const int c : components) model.supports.push_back({node.number, c, 0.0});
}

/// Planes of symmetry of the octant of positive coordinates.
inline void hold_symmetry(mesh::Model& model, const std::vector<int>& axes) {
  for (const int axis : axes)
    hold(model, [axis](const Eigen::Vector3d& x) { return std::abs(x[axis]) < 1e-9; }, {axis, 3 + (axis + 1) % 3, 3 + (axis + 2) % 3});
}

inline BlockCase shell_case(const mesh::Model& model) {
  input::BodySpec spec;
  spec.kind = input::BodyKind::imported, spec.mesh = "shell.inp";
  BlockCase c(mesh::body_of(model, spec), {});
  *c.c.body = spec;
  return c;
}

}  // namespace snug::tests
