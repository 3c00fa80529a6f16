// A body pressed by a sheet: scenes of contact that are put together in code.
#pragma once

#include <cmath>
#include <random>

#include "solver/scene/constraints.hpp"
#include "solver/terms/tissue.hpp"
#include "tests/verification/blocks.hpp"

namespace snug::tests {

using solver::Layout, solver::State;

/// A sheet of n[0] x n[1] rectangles over [0, size[0]] x [0, size[1]], each cut in two triangles, inner nodes moved by up
/// to `shift` of a rectangle so that nothing matches; `height` (x, y) -> z is its placed shape.
inline mesh::GarmentMesh sheet(std::array<int, 2> n, const Eigen::Vector2d& size,
                               const std::function<double(const Eigen::Vector2d&)>& height, double shift = 0.2) {
  mesh::GarmentMesh mesh;
  const Eigen::Vector2d h(size[0] / n[0], size[1] / n[1]);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> moved(-shift, shift);
  const int row = 2 * n[0] + 1;
  const auto vertex = [&](int i, int j) { return (2 * j) * row + 2 * i; };
  mesh.pattern.assign(row * (2 * n[1] + 1), Eigen::Vector2d::Zero());
  for (int j = 0; j <= n[1]; ++j)
    for (int i = 0; i <= n[0]; ++i) {
      Eigen::Vector2d x(i * h[0], j * h[1]);
      if (i > 0 && i < n[0]) x.x() += moved(random) * h[0];
      if (j > 0 && j < n[1]) x.y() += moved(random) * h[1];
      mesh.pattern[vertex(i, j)] = x;
    }
  const auto middle = [&](int a, int b) {  // nodes stand in the grid of halves
    const int m = (a + b) / 2;
    mesh.pattern[m] = 0.5 * (mesh.pattern[a] + mesh.pattern[b]);
    return m;
  };
  for (int j = 0; j < n[1]; ++j)
    for (int i = 0; i < n[0]; ++i) {
      const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
      mesh.triangles.push_back({a, b, c, middle(a, b), middle(b, c), middle(c, a)});
      mesh.triangles.push_back({a, c, d, middle(a, c), middle(c, d), middle(d, a)});
    }
  for (std::size_t node = 0; node < mesh.pattern.size(); ++node) {
    const Eigen::Vector2d& x = mesh.pattern[node];
    mesh.placed.emplace_back(x.x(), x.y(), height(x));
    mesh.merged.push_back(static_cast<int>(node));
  }
  mesh.warp.assign(mesh.triangles.size(), Eigen::Vector2d::UnitX());
  mesh.mean_edge = h.mean();
  return mesh;
}

/// Entries that do not move, and those without unknowns: master -1.
struct Fixed {
  std::vector<int> master;
  explicit Fixed(const Layout& layout) : master(layout.size()) {
    for (int i = 0; i < layout.size(); ++i) master[i] = i;
    for (const solver::Field& field : layout.fields())
      for (int i = 0; i < field.size() && field.rows == solver::Rows::cell; ++i) fix(field.first + i);
  }
  void fix(int entry) { master[entry] = -1; }
};

inline materials::SolidLaw tissue(double shear, double poisson) {
  input::MaterialEntry reference;
  reference.table = input::table_of(fmt::format("law = 'neo-Hooke'\nshear_modulus = '{} Pa'\npoisson_ratio = {}", shear, poisson));
  return materials::find_tissue(reference).law;
}

/// Body under a sheet: its top is the skin, its sides slide, its bottom is held along z.
struct Press {
  mesh::BodyMesh body;
  mesh::GarmentMesh garment;
  Layout layout;
  Fixed fixed;

  Press(mesh::BodyMesh b, mesh::GarmentMesh g)
      : body(std::move(b)), garment(std::move(g)), layout(tests::make_layout(body, garment, true, true)), fixed(layout) {
    body.skin_facets = body.surface("top")->facets;
    body.mean_skin_cell = mesh::mean_edge(body, body.skin_facets);
    const auto slide = [&](const std::string& face, int component) {
      for (const int node : body.surface(face)->nodes) fixed.fix(layout["body"](node, component));
    };
    slide("left", 0), slide("right", 0), slide("front", 1), slide("back", 1), slide("bottom", 2);
  }
};

/// Block of the unit cube: u along x, v upwards, w against y, so that it is right-handed.
inline mesh::BodyMesh upright_block(std::array<int, 3> cells, const std::function<Eigen::Vector3d(double, double, double)>& at) {
  Block block;
  block.cells = cells;
  block.map = [at](const Eigen::Vector3d& u) { return at(u.x(), 1.0 - u.z(), u.y()); };
  return make_block(block);
}

}  // namespace snug::tests
