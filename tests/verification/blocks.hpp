// Blocks of body cells built in code: a grid of hexahedra through any map, in any kind, loaded as a case loads a body.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <string>

#include "cases/input/case.hpp"
#include "solver/scene/result.hpp"
#include "solver/stepping/load_path.hpp"
#include "tests/scenes.hpp"

namespace snug::tests {

using mesh::BodyMesh, mesh::CellKind;
using Map = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

/// Cells along the three coordinates of the unit cube, which `map` takes to its place (m). Faces are called left, right
/// (u = 0, 1), bottom, top (v), back, front (w). `closed`: u = 1 is u = 0 again.
struct Block {
  std::array<int, 3> cells = {1, 1, 1};
  Map map = [](const Eigen::Vector3d& u) { return u; };
  CellKind kind = CellKind::hex27;
  bool closed = false;
  std::vector<std::string> layers = {"tissue"};
  std::function<int(const Eigen::Vector3d&)> layer = [](const Eigen::Vector3d&) { return 0; };  ///< by the cell's middle
};

inline BodyMesh make_block(const Block& block) {
  const std::array<int, 3> n = {block.closed ? 2 * block.cells[0] : 2 * block.cells[0] + 1, 2 * block.cells[1] + 1,
                                2 * block.cells[2] + 1};
  const auto unit = [&](int i, int j, int k) {
    return Eigen::Vector3d(0.5 * i / block.cells[0], 0.5 * j / block.cells[1], 0.5 * k / block.cells[2]);
  };
  BodyMesh mesh;
  for (const auto& name : block.layers) mesh.layers.push_back({name, {}});
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) mesh.nodes.push_back(block.map(unit(i, j, k)));
  for (int k = 0; k < block.cells[2]; ++k)
    for (int j = 0; j < block.cells[1]; ++j)
      for (int i = 0; i < block.cells[0]; ++i) {
        auto& cell = mesh.cells.emplace_back();
        for (int a = 0; a < 27; ++a)
          cell[a] = (2 * k + a / 9) * n[0] * n[1] + (2 * j + a / 3 % 3) * n[0] + (2 * i + a % 3) % n[0];
        mesh.cell_layer.push_back(block.layer(unit(2 * i + 1, 2 * j + 1, 2 * k + 1)));
      }
  const auto add = [&](const std::string& name, int axis, int at) {
    mesh::Surface surface{name, {}, {}};
    std::vector<char> keep(mesh.nodes.size(), 0);
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
      const std::array<int, 3> key = {int(node) % n[0], int(node) / n[0] % n[1], int(node) / (n[0] * n[1])};
      if (key[axis] == at) keep[node] = 1, surface.nodes.push_back(int(node));
    }
    surface.facets = boundary_facets(mesh, keep);
    mesh.surfaces.push_back(std::move(surface));
  };
  const std::array<std::array<const char*, 2>, 3> names = {{{"left", "right"}, {"bottom", "top"}, {"back", "front"}}};
  for (int axis = block.closed ? 1 : 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) add(names[axis][side], axis, side * (n[axis] - 1));
  mesh.node_location.assign(mesh.nodes.size(), -1);
  return block.kind == CellKind::hex27 ? mesh : convert(mesh, block.kind);
}

/// All nodes that `holds` as a surface of its own, to support or load them.
inline void name_nodes(BodyMesh& mesh, const std::string& name, const std::function<bool(const Eigen::Vector3d&)>& holds) {
  mesh::Surface surface{name, {}, {}};
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    if (holds(mesh.nodes[node])) surface.nodes.push_back(int(node));
  mesh.surfaces.push_back(std::move(surface));
}

/// Facets of the surface `of` whose nodes all satisfy `holds`, as a surface of its own.
inline void name_part(BodyMesh& mesh, const std::string& name, const std::string& of,
                      const std::function<bool(const Eigen::Vector3d&)>& holds) {
  mesh::Surface surface{name, {}, {}};
  for (const auto& facet : mesh.surface(of)->facets)
    if (std::all_of(facet.begin(), facet.end(), [&](int a) { return a < 0 || holds(mesh.nodes[a]); }))
      surface.facets.push_back(facet);
  mesh.surfaces.push_back(std::move(surface));
}

inline std::string neo_hooke(double shear_kPa, double poisson_ratio) {
  return fmt::format("law = 'neo-Hooke'\nshear_modulus = '{:.17g} kPa'\npoisson_ratio = {:.17g}", shear_kPa, poisson_ratio);
}
/// From the bulk modulus, kPa.
inline std::string neo_hooke_bulk(double shear_kPa, double bulk_kPa) {
  return neo_hooke(shear_kPa, (3.0 * bulk_kPa - 2.0 * shear_kPa) / (2.0 * (3.0 * bulk_kPa + shear_kPa)));
}

/// A body made in code under the loads and supports of a case.
struct BlockCase {
  BodyMesh mesh;
  input::Case c;

  BlockCase(BodyMesh m, std::vector<std::string> materials) : mesh(std::move(m)) {
    c.body.emplace();
    c.body->kind = input::BodyKind::imported;
    c.load.emplace();
    for (std::size_t l = 0; l < materials.size(); ++l) mesh.layers[l].material.table = input::table_of(materials[l]);
  }
  void hold(const std::string& on, std::optional<double> x, std::optional<double> y, std::optional<double> z,
            double turn = 0.0) {
    input::SupportSpec& support = c.support.emplace_back();
    support.on = on, support.x = x, support.y = y, support.z = z, support.turn = turn;
  }
  void traction(const std::string& on, double x, double y, double z) {
    input::SurfaceTraction& t = c.load->traction.emplace_back();
    t.on = on, t.value = {x, y, z};
  }
  void pressure(const std::string& on, double value) {
    input::SurfacePressure& p = c.load->pressure.emplace_back();
    p.on = on, p.value = value;
  }
};

/// The answer with the rows of its Newton iterations.
struct BlockAnswer {
  solver::PathResult path;
  solver::Layout layout;
  postproc::RunResult result;
  std::vector<postproc::Iteration> history;

  Eigen::Vector3d displacement(const BodyMesh& mesh, const Eigen::Vector3d& at) const {
    std::size_t best = 0;
    for (std::size_t n = 1; n < mesh.nodes.size(); ++n)
      if ((mesh.nodes[n] - at).squaredNorm() < (mesh.nodes[best] - at).squaredNorm()) best = n;
    EXPECT_LE((mesh.nodes[best] - at).norm(), 1e-9);
    return result.body.fields[postproc::field::displacement][best];
  }
};

inline BlockAnswer solve(const BlockCase& block, double first_step = 0.25) {
  const mesh::GarmentMesh none;
  solver::Scene scene = tests::make_scene(block.c, block.mesh, none, solver::Skin::deformable);
  solver::PathSettings settings;
  settings.first_step = first_step;
  BlockAnswer answer;
  answer.layout = scene.layout();
  answer.path = solver::follow_path(scene, tests::placed_state(scene.layout(), block.mesh, none), solver::tightening(),
                                    settings, [&](const postproc::Iteration& row) { answer.history.push_back(row); });
  EXPECT_TRUE(answer.path.complete) << answer.path.message << " at " << answer.path.reached;
  answer.result.body = solver::body_result(block.mesh, true);
  tests::fill_result(scene, answer.path.state, block.mesh, none, answer.result);
  return answer;
}

/// Quarter turns of a ring: radius from `inner` to `outer`, u round, v outwards, w along the axis by `length`.
inline Map ring(double inner, double outer, double length) {
  return [=](const Eigen::Vector3d& u) {
    const double r = inner + (outer - inner) * u.y(), a = -2.0 * std::numbers::pi * u.x();
    return Eigen::Vector3d(r * std::cos(a), r * std::sin(a), length * u.z());
  };
}

}  // namespace snug::tests
