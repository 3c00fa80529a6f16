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
  std::string part = {};           ///< "master" or "slave"
  solver::NodalForces forces = {}; ///< dead, N

  materials::SolidLaw law() const { return linear_elastic(youngs_modulus, poisson); }
};

/// Master, of any cells, and slave, of quadratic tetrahedra; both linear elastic.
struct TwoSolids {
  Solid master, slave;
  Layout layout;
  Fixed fixed;
  State state;

  TwoSolids(Solid m, Solid s) : master(std::move(m)), slave(std::move(s)), layout(number()), fixed(layout) {
    state.values = Eigen::VectorXd::Zero(layout.size());
    state.load = 1.0;
    for (Solid* solid : {&master, &slave}) {
      const auto pressures = solver::body_fields(layout, solid->part).pressures;
      for (int i = 0; i < pressures.count; ++i) fixed.fix(pressures(i));  // the law has none
      solid->forces.assign(solid->mesh.nodes.size(), Eigen::Vector3d::Zero());
      for (std::size_t node = 0; node < solid->mesh.nodes.size(); ++node)
        state.values.segment<3>(entry(*solid, static_cast<int>(node))) = solid->mesh.nodes[node];
      std::set<int> used;
      for (const auto& cell : solid->mesh.cells) used.insert(cell.begin(), cell.begin() + node_count(solid->mesh.kind));
      for (int node = 0; node < static_cast<int>(solid->mesh.nodes.size()); ++node)  // corners that were closed leave some
        for (int c = 0; c < 3 && !used.contains(node); ++c) fixed.fix(entry(*solid, node, c));
    }
  }

  int entry(const Solid& solid, int node, int component = 0) const { return layout[solid.part](node, component); }

  /// A component of all nodes of a surface stays where the state has it.
  void hold(const Solid& solid, const std::string& surface, int component) {
    for (const int node : solid.mesh.surface(surface)->nodes) fixed.fix(entry(solid, node, component));
  }

  /// A rigid plate on a surface of the slave, which moves along y under a force (N) along -y. What holds the slave up is
  /// contact: it starts `overlap` (m) deep in the master.
  void press(const std::string& surface, double force, double overlap) {
    const auto& plate = slave.mesh.surface(surface)->nodes;
    for (const int node : plate) fixed.master[entry(slave, node, 1)] = entry(slave, plate.front(), 1);
    slave.forces[plate.front()].y() -= force;
    for (std::size_t node = 0; node < slave.mesh.nodes.size(); ++node) state.values[entry(slave, static_cast<int>(node), 1)] -= overlap;
  }

  solver::Scene scene() const {
    solver::Scene scene(layout, solver::Numbering(fixed.master));
    for (const Solid* solid : {&master, &slave}) {
      scene.add(std::make_unique<solver::Tissue>("tissue of " + solid->part, solver::body_fields(layout, solid->part), solid->mesh,
                                                 std::vector<materials::SolidLaw>{solid->law()}));
      auto load = std::make_unique<solver::DeadLoad>("load on " + solid->part, layout[solid->part], solid->forces);
      if (!load->empty()) scene.add(std::move(load));
    }
    const double shear = std::max(materials::initial_shear_modulus(master.law()), materials::initial_shear_modulus(slave.law()));
    solver::MasterSurface below(layout["master"], master.mesh, master.mesh.surface(master.surface)->facets);
    const double stiffness = 3.0 * shear / below.mean_edge();
    scene.add(std::make_unique<solver::Contact>("contact", solver::Interface{layout["contact"], slave_surface(layout), std::move(below)},
                                                stiffness, solver::GapBasis::hat));
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
    const auto surface = slave_surface(layout);
    for (int node = 0; node < layout["slave"].count; ++node)
      if (const int i = surface.vertex_of_node[node]; i >= 0)
        list.push_back({node, state.values[layout["contact"](i)], surface.area[i]});
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
      auto& [sum, count] = rows[std::lround(1e6 * coordinate(slave.mesh.nodes[v.node]) / length)];
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

  Eigen::Vector3d place(const Solid& solid, int node) const { return state.values.segment<3>(entry(solid, node)); }

 private:
  solver::ContactSlave slave_surface(const Layout& fields) const {
    return solver::surface_slave(fields["slave"], slave.mesh, slave.mesh.surface(slave.surface)->facets);
  }

  Layout number() {
    Layout made;
    master.part = "master", slave.part = "slave";
    for (const Solid* solid : {&master, &slave}) solver::add_positions(made, solid->part, solid->mesh);
    for (const Solid* solid : {&master, &slave}) solver::add_pressures(made, solid->part, solid->mesh);
    solver::add_multipliers(made, "contact", slave_surface(made).vertices());
    return made;
  }
};

/// Cauchy stress (Pa) at the nodes of one solid, the mean over the cells of a node; by node.
inline std::map<int, Eigen::Matrix3d> nodal_stress(const TwoSolids& two, const Solid& solid) {
  const solver::Tissue tissue("tissue", solver::body_fields(two.layout, solid.part), solid.mesh, {solid.law()});
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
