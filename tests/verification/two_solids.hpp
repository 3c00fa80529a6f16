// Two solids that touch: scenes of contact between bodies that are put together in code.
#pragma once

#include <Eigen/Dense>

#include <map>
#include <set>

#include "solver/stepping/newton.hpp"
#include "solver/terms/contact.hpp"
#include "solver/terms/dead_load.hpp"
#include "tests/verification/press.hpp"

namespace snug::tests {

/// Places 0 .. length over the unit interval: `even` cells of `size`, then `growing` ones of which each is larger than the one
/// before by the same factor.
class Graded {
 public:
  Graded(double size, int even, int growing, double length) : size_(size), even_(even), growing_(growing) {
    double low = 1.0 + 1e-9, high = 3.0;
    while (high - low > 1e-14) (at_end(growth_ = 0.5 * (low + high)) < length ? low : high) = growth_;
  }
  int cells() const { return even_ + growing_; }
  double operator()(double u) const {
    const double k = u * cells() - even_;
    return size_ * (k <= 0.0 ? even_ + k : even_ + grown(growth_, k));
  }

 private:
  static double grown(double q, double k) { return q * (std::pow(q, k) - 1.0) / (q - 1.0); }  // q + q^2 + .. q^k
  double at_end(double q) const { return size_ * (even_ + grown(q, growing_)); }
  double size_, growth_ = 1.0;
  int even_, growing_;
};

inline materials::SolidLaw linear_elastic(double youngs_modulus, double poisson) {
  return materials::LinearElastic{youngs_modulus, poisson};
}

/// One of the two, with the surface on which it meets the other.
struct Solid {
  BodyMesh mesh;
  std::string surface;
  double youngs_modulus, poisson;  ///< Pa, -

  materials::SolidLaw law() const { return linear_elastic(youngs_modulus, poisson); }
};

/// Master, of any cells, and slave, of quadratic tetrahedra; both linear elastic. Each mesh has the nodes of both, the
/// master's first, and its own cells.
struct TwoSolids {
  Solid master, slave;
  Layout layout;
  Fixed fixed;
  solver::NodalForces forces;  ///< dead, N
  State state;

  TwoSolids(Solid m, Solid s)
      : master(std::move(m)), slave(std::move(s)), layout(number()), fixed(layout),
        forces(layout.body_nodes, Eigen::Vector3d::Zero()) {
    for (int i = 0; i < layout.pressures; ++i) fixed.fix(layout.pressure(i));  // the law has none
    std::set<int> used = nodes_of(master);
    used.merge(nodes_of(slave));
    for (int node = 0; node < layout.body_nodes; ++node)
      for (int c = 0; c < 3 && !used.contains(node); ++c) fixed.fix(layout.body(node, c));
    state = solver::placed_state(layout, master.mesh, {});
    state.load = 1.0;
  }

  /// A component of all nodes of a surface stays where the state has it.
  void hold(const Solid& solid, const std::string& surface, int component) {
    for (const int node : solid.mesh.surface(surface)->nodes) fixed.fix(layout.body(node, component));
  }

  /// A rigid plate on a surface of the slave, which moves along y under a force (N) along -y. What holds the slave up is
  /// contact: it starts `overlap` (m) deep in the master.
  void press(const std::string& surface, double force, double overlap) {
    const auto& plate = slave.mesh.surface(surface)->nodes;
    for (const int node : plate) fixed.master[layout.body(node, 1)] = layout.body(plate.front(), 1);
    forces[plate.front()].y() -= force;
    for (const int node : nodes_of(slave)) state.values[layout.body(node, 1)] -= overlap;
  }

  solver::Scene scene() const {
    solver::Scene scene(layout, solver::Numbering(fixed.master));
    scene.add(std::make_unique<solver::Tissue>(layout, master.mesh, std::vector<materials::SolidLaw>{master.law()}));
    scene.add(std::make_unique<solver::Tissue>(layout, slave.mesh, std::vector<materials::SolidLaw>{slave.law()}));
    const double shear = std::max(materials::initial_shear_modulus(master.law()), materials::initial_shear_modulus(slave.law()));
    scene.add(std::make_unique<solver::Contact>(layout, slave_surface(), master.mesh, true,
                                                3.0 * shear / master.mesh.mean_skin_cell, solver::GapBasis::hat));
    if (std::any_of(forces.begin(), forces.end(), [](const auto& f) { return !f.isZero(0.0); }))
      scene.add(std::make_unique<solver::DeadLoad>(layout, forces));
    return scene;
  }

  /// The path's last increment: contact is cut where the state has it. `small` (m): a gap that is none.
  solver::Outcome solve(solver::Scene& scene, double small) {
    solver::NewtonSettings settings;
    settings.residual = 1e-12, settings.penetration = small;
    return solver::newton(scene, state, settings, [](const postproc::Iteration&) {});
  }

  /// The slave's vertices with pressure (Pa) and area (m2) of their rest shape.
  struct Vertex {
    int node;
    double pressure, area;
  };
  std::vector<Vertex> vertices() const {
    std::vector<Vertex> list;
    const auto surface = slave_surface();
    for (int node = 0; node < layout.body_nodes; ++node)
      if (const int i = surface.vertex_of_node[node]; i >= 0)
        list.push_back({node, state.values[layout.multiplier(i)], surface.area[i]});
    return list;
  }
  double mean_pressure() const {
    double force = 0.0, area = 0.0;
    for (const Vertex& v : vertices()) force += v.pressure * v.area, area += v.area;
    return force / area;
  }
  /// Pressure by a coordinate of the rest shape: the mean over the vertices that share it to 1e-6 `length`.
  std::map<double, double> profile(double length, const std::function<double(const Eigen::Vector3d&)>& coordinate) const {
    std::map<long, std::pair<double, int>> rows;
    for (const Vertex& v : vertices()) {
      auto& [sum, count] = rows[std::lround(1e6 * coordinate(reference(v.node)) / length)];
      sum += v.pressure, ++count;
    }
    std::map<double, double> list;
    for (const auto& [x, row] : rows) list[1e-6 * length * static_cast<double>(x)] = row.first / row.second;
    return list;
  }
  /// Largest relative deviation of a vertex's pressure from p.
  double unevenness(double p) const {
    double worst = 0.0;
    for (const Vertex& v : vertices()) worst = std::max(worst, std::abs(v.pressure / p - 1.0));
    return worst;
  }

  static std::set<int> nodes_of(const Solid& solid) {
    std::set<int> nodes;
    for (const auto& cell : solid.mesh.cells)
      for (int a = 0; a < node_count(solid.mesh.kind); ++a) nodes.insert(cell[a]);
    return nodes;
  }
  Eigen::Vector3d reference(int node) const { return master.mesh.nodes[node]; }
  Eigen::Vector3d place(int node) const { return state.values.segment<3>(layout.body(node)); }

 private:
  solver::ContactSlave slave_surface() const {
    return solver::surface_slave(layout, slave.mesh, slave.mesh.surface(slave.surface)->facets);
  }

  Layout number() {
    BodyMesh &a = master.mesh, &b = slave.mesh;
    const int first = static_cast<int>(a.nodes.size());
    const auto shift = [&](auto& nodes) {
      for (int& node : nodes)
        if (node >= 0) node += first;
    };
    for (auto& cell : b.cells) shift(cell);
    for (auto& surface : b.surfaces) {
      shift(surface.nodes);
      for (auto& facet : surface.facets) shift(facet);
    }
    a.nodes.insert(a.nodes.end(), b.nodes.begin(), b.nodes.end());
    b.nodes = a.nodes;
    a.skin_facets = a.surface(master.surface)->facets;
    a.mean_skin_cell = mesh::mean_edge(a, a.skin_facets);
    Layout made = solver::make_layout(a, {}, true, false);
    made.pressures = std::max(made.pressures, solver::make_layout(b, {}, true, false).pressures);
    made.multipliers = solver::surface_slave(made, b, b.surface(slave.surface)->facets).vertices();
    return made;
  }
};

/// Cauchy stress (Pa) at the nodes of one solid, the mean over the cells of a node; by node.
inline std::map<int, Eigen::Matrix3d> nodal_stress(const TwoSolids& two, const Solid& solid) {
  const solver::Tissue tissue(two.layout, solid.mesh, {solid.law()});
  std::map<int, Eigen::Matrix3d> stress;
  std::map<int, int> cells;
  for (std::size_t c = 0; c < solid.mesh.cells.size(); ++c) {
    const auto s = tissue.nodal_stress(two.state, static_cast<int>(c));
    for (Eigen::Index a = 0; a < s.cols(); ++a) {
      const int node = solid.mesh.cells[c][a];
      Eigen::Matrix3d full;
      full << s(0, a), s(3, a), s(5, a), s(3, a), s(1, a), s(4, a), s(5, a), s(4, a), s(2, a);
      const auto it = stress.try_emplace(node, Eigen::Matrix3d::Zero()).first;
      it->second += full, ++cells[node];
    }
  }
  for (auto& [node, sum] : stress) sum /= cells[node];
  return stress;
}

/// Root mean square of profile / peak - sqrt(1 - (x/a)^2) over the vertices to 1.2 a.
inline double error_of_ellipse(const std::map<double, double>& profile, double a, double peak) {
  double squares = 0.0;
  int count = 0;
  for (const auto& [x, p] : profile) {
    if (x > 1.2 * a) continue;
    const double exact = x < a ? std::sqrt(1.0 - x * x / (a * a)) : 0.0;
    squares += (p / peak - exact) * (p / peak - exact), ++count;
  }
  return std::sqrt(squares / count);
}

}  // namespace snug::tests
