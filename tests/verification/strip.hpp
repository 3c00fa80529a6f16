// An elastic band on a rigid cylinder, its ends led round the cylinder: the scene of the capstan.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "solver/stepping/load_path.hpp"
#include "tests/verification/skin_grid.hpp"
#include "tests/verification/straight_fabric.hpp"
#include "tests/scenes.hpp"

namespace snug::tests {

/// The band has the nominal tension k (l - 1) per rest width at the stretch l and cannot change its width. It starts
/// evenly stretched between the angles 0 and `span`.
struct Strip {
  double radius = 0.055, span = std::numbers::pi;  ///< m, rad
  double k = 1000.0;                               ///< N/m
  double rest_length = 0.0;                        ///< m
  double friction = 0.3;
  double elastic_slip = solver::Friction::usual_elastic_slip;  ///< over the rest edge
  int cells = 90;                                  ///< along the band, two across
  double lead_start = 0.0, lead_end = 0.0;         ///< rad, how far the ends go round
  double skin_cell = 1.37;                         ///< skin facet over garment edge: the meshes never match
};

/// What acts at a vertex of the band's middle line; pressures per current area.
struct StripPoint {
  double angle = 0.0, pressure = 0.0, shear = 0.0;  ///< rad, Pa
};

struct StripAnswer {
  bool converged = false;
  int increments = 0, iterations = 0;
  double start_tension = 0.0, end_tension = 0.0;   ///< N per rest width, reactions of the ends
  double slip_arc = 0.0;                           ///< rad, from the end back to the first vertex row that sticks
  std::vector<StripPoint> middle;
  std::string message;
};

inline double strip_width(const Strip& s) { return 2.0 * s.rest_length / s.cells; }

inline Eigen::Vector3d on_cylinder(double radius, double angle, double z) {
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// Biquadratic facets all round a cylinder.
inline mesh::BodyMesh cylinder_skin(double radius, double half_height, double cell) {
  const int around = static_cast<int>(std::lround(2.0 * std::numbers::pi * radius / cell));
  const int along = std::max(1, static_cast<int>(std::lround(2.0 * half_height / cell)));
  return skin_grid(around, along, half_height, cell, 0.3, [&](double angle, double z) { return on_cylinder(radius, angle, z); });
}

/// Nodes in a grid of half cells: node (i, j) is i (2 * cells + 1 columns) along the band and j (5 rows) across.
inline mesh::GarmentMesh strip_mesh(const Strip& s) {
  mesh::GarmentMesh mesh;
  const int columns = 2 * s.cells + 1, rows = 5;
  const double width = strip_width(s);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const double x = static_cast<double>(i) / (columns - 1), y = static_cast<double>(j) / (rows - 1) - 0.5;
      mesh.pattern.emplace_back(x * s.rest_length, y * width);
      mesh.placed.push_back(on_cylinder(s.radius, x * s.span, y * width));
      mesh.merged.push_back(static_cast<int>(mesh.merged.size()));
    }
  const auto node = [&](int i, int j) { return j * columns + i; };
  for (int j = 0; j + 2 < rows; j += 2)
    for (int i = 0; i + 2 < columns; i += 2) {
      mesh.triangles.push_back({node(i, j), node(i + 2, j), node(i + 2, j + 2), node(i + 1, j), node(i + 2, j + 1), node(i + 1, j + 1)});
      mesh.triangles.push_back({node(i, j), node(i + 2, j + 2), node(i, j + 2), node(i + 1, j + 1), node(i + 1, j + 2), node(i, j + 1)});
    }
  mesh.warp.assign(mesh.triangles.size(), Eigen::Vector2d::UnitX());
  for (int j = 0; j < rows; ++j) {
    mesh.edges["start"].push_back(node(0, j));
    mesh.edges["end"].push_back(node(columns - 1, j));
  }
  mesh.mean_edge = s.rest_length / s.cells;
  return mesh;
}

/// Ends are led in all directions, and no node moves along the cylinder's axis.
inline solver::Numbering strip_numbering(const solver::Layout& layout, const mesh::GarmentMesh& mesh) {
  std::vector<int> master(layout.size());
  for (int i = 0; i < layout.size(); ++i) master[i] = i;
  for (int node = 0; node < layout["garment"].count; ++node) master[layout["garment"](node, 2)] = -1;
  for (const auto& [name, nodes] : mesh.edges)
    for (const int node : nodes)
      for (int c = 0; c < 3; ++c) master[layout["garment"](node, c)] = -1;
  return solver::Numbering(std::move(master));
}

inline solver::Scene strip_scene(const Strip& s, const mesh::GarmentMesh& mesh, const mesh::BodyMesh& body) {
  const solver::Layout layout = tests::make_layout(body, mesh, false, true);
  solver::Scene scene(layout, strip_numbering(layout, mesh));
  scene.add(std::make_unique<solver::FabricMembrane>("garment", layout["garment"], mesh, std::vector{straight_fabric(s.k, 0.3 * s.k)}));
  const double stiffness = s.k / (mesh.mean_edge * mesh.mean_edge);
  scene.add(std::make_unique<solver::Contact>("contact", solver::Interface{layout["contact"], solver::garment_slave(layout["garment"], mesh), solver::MasterSurface(layout["body"], body, body.skin_facets)}, stiffness,
                                              solver::GapBasis::hat));
  if (s.friction > 0.0)
    scene.add(std::make_unique<solver::Friction>("friction", *scene.find<solver::Contact>(), s.friction,
                                                 s.elastic_slip * mesh.mean_edge));
  return scene;
}

/// Tangential force (N per rest width) of the support at an edge, against the pull.
inline double edge_tension(const Strip& s, const solver::Scene& scene, const solver::State& state,
                           const std::vector<int>& nodes) {
  const Eigen::VectorXd residual = scene.full_residual(state);
  double sum = 0.0;
  for (const int node : nodes) {
    const int entry = scene.layout()["garment"](node);
    const Eigen::Vector3d x = state.values.segment<3>(entry), f = residual.segment<3>(entry);
    sum += f.dot(Eigen::Vector3d(-x.y(), x.x(), 0.0).normalized());
  }
  return std::abs(sum) / strip_width(s);
}

inline double slip_arc(const Strip& s, const solver::Scene& scene, const solver::State& state) {
  const auto* friction = scene.find<solver::Friction>();
  const auto* contact = scene.find<solver::Contact>();
  if (!friction) return 0.0;
  const auto tractions = friction->vertex_tractions(state);
  double stuck = 0.0;  // angle of the last vertex that sticks
  for (int node = 0; node < scene.layout()["garment"].count; ++node) {
    const int i = contact->multiplier_of(node);
    if (i < 0 || tractions[i].slip == solver::Friction::Slip::slip) continue;
    const Eigen::Vector3d x = state.values.segment<3>(scene.layout()["garment"](node));
    stuck = std::max(stuck, std::atan2(x.y(), x.x()));
  }
  return s.span + s.lead_end - stuck;
}

/// Vertices of the middle line in order along the band. Its width does not change, so that the stretch along it turns rest
/// areas into current ones.
inline std::vector<StripPoint> middle_line(const Strip& s, const mesh::GarmentMesh& mesh, const solver::Scene& scene,
                                           const solver::State& state) {
  const auto& contact = *scene.find<solver::Contact>();
  const auto tractions = scene.find<solver::Friction>()->vertex_tractions(state);
  const int columns = 2 * s.cells + 1, first = 2 * columns;
  const auto angle = [&](int column) {
    const Eigen::Vector3d x = state.values.segment<3>(scene.layout()["garment"](first + column));
    return std::atan2(x.y(), x.x());
  };
  std::vector<StripPoint> points;
  for (int column = 2; column + 2 < columns; column += 2) {
    const int i = contact.multiplier_of(first + column);
    const double rest = mesh.pattern[first + column + 1].x() - mesh.pattern[first + column - 1].x();
    const double stretch = s.radius * std::remainder(angle(column + 1) - angle(column - 1), 2.0 * std::numbers::pi) / rest;
    points.push_back({angle(column), state.values[scene.layout()["contact"](i)] / stretch, tractions[i].traction.norm() / stretch});
  }
  return points;
}

inline StripAnswer run(const Strip& s, double first_step = 0.1, const solver::IterationSink& sink = [](const auto&) {}) {
  const mesh::GarmentMesh mesh = strip_mesh(s);
  const mesh::BodyMesh body = cylinder_skin(s.radius, strip_width(s), s.skin_cell * mesh.mean_edge);
  solver::Scene scene = strip_scene(s, mesh, body);
  const solver::Layout& layout = scene.layout();
  solver::State start = tests::placed_state(layout, body, mesh);
  const double stretch = s.radius * s.span / s.rest_length;
  start.load = 1.0;
  start.values.tail(layout["contact"].count).setConstant(s.k * (stretch - 1.0) * stretch / s.radius);
  const auto lead = [&](solver::State& state, double t) {
    for (const auto& [name, angle] : {std::pair{"start", t * s.lead_start}, std::pair{"end", t * s.lead_end}})
      for (const int node : mesh.edges.at(name)) {
        const double from = std::string(name) == "start" ? 0.0 : s.span;
        state.values.segment<3>(layout["garment"](node)) = on_cylinder(s.radius, from + angle, mesh.placed[node].z());
      }
  };
  solver::PathSettings settings;
  settings.first_step = first_step;
  settings.newton.penetration = 1e-6 * mesh.mean_edge;
  StripAnswer answer;
  const auto path = solver::follow_path(scene, start, lead, settings, [&](const postproc::Iteration& row) {
    ++answer.iterations;
    sink(row);
  });
  answer.converged = path.complete, answer.increments = path.increments, answer.message = path.message;
  answer.start_tension = edge_tension(s, scene, path.state, mesh.edges.at("start"));
  answer.end_tension = edge_tension(s, scene, path.state, mesh.edges.at("end"));
  if (s.friction > 0.0) answer.middle = middle_line(s, mesh, scene, path.state);
  answer.slip_arc = slip_arc(s, scene, path.state);
  return answer;
}

}  // namespace snug::tests
