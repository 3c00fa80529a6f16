// Stretched sleeves on a rigid cylinder and sphere: the tension is known, so the pressure is (T/R and 2T/R).
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "solver/scene/result.hpp"
#include "solver/stepping/load_path.hpp"
#include "tests/verification/skin_grid.hpp"
#include "tests/scenes.hpp"

namespace snug::tests {

enum class Surface { cylinder, sphere };

/// What varies from row to row; lengths in radii.
struct RigidCase {
  Surface surface = Surface::cylinder;
  double h = 0.1;     ///< garment edge when placed
  int order = 2;      ///< of the garment's triangles
  bool flat = false;  ///< straight skin facets in place of biquadratic ones
  input::GapTests basis = input::GapTests::hat;
  double skin_cell = 1.5;  ///< skin facet over garment edge: the meshes never match
};

struct Spread {
  double rms = 0.0, max = 0.0, mean = 0.0;
};  ///< of the nodal pressure, relative to the exact one

struct RigidAnswer {
  bool converged = false;
  double edge = 0.0;     ///< mean garment edge when placed, over the radius
  Spread skin, garment;  ///< transferred to the skin's nodes; raw multipliers of garment vertices
  double seconds = 0.0;
  postproc::RunResult result;
};

constexpr double radius = 0.05, stretch = 1.25, stiffness = 800.0;  // m, -, N/m

/// Point at an angle and an arc length z from the equator (m).
inline Eigen::Vector3d on_surface(Surface surface, double angle, double z) {
  const double latitude = z / radius, r = surface == Surface::sphere ? radius * std::cos(latitude) : radius;
  return {r * std::cos(angle), r * std::sin(angle), surface == Surface::sphere ? radius * std::sin(latitude) : z};
}

/// From the equator to the garment's ends: four edges, so that as many lie inside as off the ends.
inline double half_length(const RigidCase& rigid) { return 4.0 * rigid.h * radius; }

/// Hoop tension from S = k E on a stretched strip that keeps its length (cylinder) or is stretched alike both ways
/// (sphere, where l^2 / J = 1); one curvature presses on the cylinder, two on the sphere.
inline double exact_pressure(Surface surface) {
  const double force = stiffness * 0.5 * (stretch * stretch - 1.0);
  return surface == Surface::sphere ? 2.0 * force / radius : force * stretch / radius;
}

/// The cylinder as a limb, for the mesher of garments.
class CircularOutline final : public mesh::Outline {
 public:
  Eigen::Vector3d at(double turn, double z) const override {
    return on_surface(Surface::cylinder, 2.0 * std::numbers::pi * turn, z);
  }
};

/// Skin facets in a regular grid, a facet longer than the garment on either side.
inline mesh::BodyMesh grid_skin(const RigidCase& rigid) {
  const double cell = rigid.skin_cell * rigid.h * radius, half = half_length(rigid) + cell;
  const int around = static_cast<int>(std::lround(2.0 * std::numbers::pi * radius / cell));
  const int along = static_cast<int>(std::lround(2.0 * half / cell));
  return skin_grid(around, along, half, cell, 0.0, [&](double angle, double z) { return on_surface(rigid.surface, angle, z); });
}

/// Straightens the facets: mid-edge nodes go to the middle of their edge, centres to the mean of the corners.
inline void flatten_skin(mesh::BodyMesh& body) {
  const std::vector<Eigen::Vector3d> curved = body.nodes;
  for (const auto& facet : body.skin_facets) {
    const auto corner = [&](int n) { return curved[facet[n]]; };
    body.nodes[facet[1]] = 0.5 * (corner(0) + corner(2)), body.nodes[facet[7]] = 0.5 * (corner(6) + corner(8));
    body.nodes[facet[3]] = 0.5 * (corner(0) + corner(6)), body.nodes[facet[5]] = 0.5 * (corner(2) + corner(8));
    body.nodes[facet[4]] = 0.25 * (corner(0) + corner(2) + corner(6) + corner(8));
  }
}

/// The cylinder's sleeve is cut narrower than the cylinder and slides with its ends held along the axis; the sphere's
/// band has its placed shape shrunk for rest shape and is held at both edges.
inline input::Case describe(const RigidCase& rigid) {
  const bool sphere = rigid.surface == Surface::sphere;
  const std::string k = std::to_string(stiffness) + " N/m", g = std::to_string(0.5 * stiffness) + " N/m";
  input::Case c;
  c.garments.emplace_back();
  c.garments.front().position = -half_length(rigid);
  c.garments.front().pattern.length = 2.0 * half_length(rigid);
  c.garments.front().pattern.flat_circumference = 2.0 * std::numbers::pi * radius / (sphere ? 1.0 : stretch);
  c.garments.front().fabric.table = input::table_of("law = 'linear'\nwarp = '" + k + "'\nweft = '" + k + "'\nshear = '" + g + "'\npoisson = 0");
  const input::HeldDirection held = sphere ? input::HeldDirection::all : input::HeldDirection::axis;
  c.garments.front().held = {{.edge = "upper", .held = held}, {.edge = "lower", .held = held}};
  c.contacts.emplace_back();
  c.contacts.front().friction = 0.0;
  c.contacts.front().basis = rigid.basis;
  return c;
}

inline double placed_edge(const mesh::GarmentMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) sum += (mesh.placed[t[k]] - mesh.placed[t[(k + 1) % 3]]).norm();
  return sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

inline mesh::GarmentMesh wrap(const RigidCase& rigid, const input::Case& c, double cell) {
  mesh::Limb limb;
  limb.skin = std::make_unique<CircularOutline>();
  limb.upper = half_length(rigid), limb.lower = -limb.upper;
  mesh::GarmentMesh mesh = mesh::make_tube_mesh(c.garments.front(), limb, cell, 0.0);
  mesh.order = rigid.order;
  if (rigid.surface == Surface::sphere)
    for (Eigen::Vector3d& x : mesh.placed) x = on_surface(Surface::sphere, std::atan2(x.y(), x.x()), x.z());
  return mesh;
}

/// Over the nodes that lie two garment edges away from the garment's ends (arc length from the equator: z(node)).
template <class Position>
Spread spread(const RigidCase& rigid, const std::vector<int>& nodes, const std::vector<double>& pressure,
              const Position& position) {
  const double inner = half_length(rigid) - 2.0 * rigid.h * radius, exact = exact_pressure(rigid.surface);
  Spread s;
  int count = 0;
  for (const int node : nodes) {
    const double height = position(node).z();
    const double z = rigid.surface == Surface::sphere ? radius * std::asin(height / position(node).norm()) : height;
    if (std::abs(z) > inner) continue;
    const double error = pressure[node] / exact - 1.0;
    s.rms += error * error, s.mean += error, s.max = std::max(s.max, std::abs(error));
    ++count;
  }
  s.rms = std::sqrt(s.rms / count), s.mean /= count;
  return s;
}

inline std::vector<int> garment_vertices(const mesh::GarmentMesh& mesh) {
  std::vector<char> seen(mesh.pattern.size(), 0);
  std::vector<int> vertices;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      if (const int node = mesh.merged[t[k]]; !seen[node]) seen[node] = 1, vertices.push_back(node);
  return vertices;
}

inline void measure(const RigidCase& rigid, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment,
                    RigidAnswer& answer) {
  std::vector<int> skin(body.nodes.size());
  std::iota(skin.begin(), skin.end(), 0);
  answer.edge = placed_edge(garment) / radius;
  answer.skin = spread(rigid, skin, answer.result.body.fields[postproc::field::contact_pressure], [&](int n) { return body.nodes[n]; });
  answer.garment = spread(rigid, garment_vertices(garment), answer.result.garment.fields[postproc::field::contact_pressure],
                          [&](int n) { return garment.placed[n]; });
}

inline RigidAnswer run(const RigidCase& rigid) {
  const auto start = std::chrono::steady_clock::now();
  const input::Case c = describe(rigid);
  mesh::BodyMesh body = grid_skin(rigid);
  if (rigid.flat) flatten_skin(body);
  const double cell = rigid.h * radius;
  const mesh::GarmentMesh garment = wrap(rigid, c, cell * cell / placed_edge(wrap(rigid, c, cell)));
  std::optional<double> prestretch;
  if (rigid.surface == Surface::sphere) prestretch = stretch;
  solver::Scene scene = tests::make_scene(c, body, garment, solver::Skin::rigid, prestretch);
  solver::PathSettings settings;
  settings.first_step = 1.0;  // the placed shape is near the answer
  settings.newton.penetration = 1e-6 * garment.mean_edge;
  solver::State state = tests::placed_state(scene.layout(), body, garment);
  const auto path =
      solver::follow_path(scene, state, solver::tightening(), settings, [](const postproc::Iteration&) {});
  RigidAnswer answer;
  answer.converged = path.complete;
  answer.result.body = solver::body_result(body, false);
  tests::fill_result(scene, path.state, body, garment, answer.result);
  measure(rigid, body, garment, answer);
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return answer;
}

}  // namespace snug::tests
