// What the contact term tells others: its quadrature points, and the pressure as a field.
#include <Eigen/Dense>

#include "solver/terms/contact.hpp"

namespace snug::solver {

void Contact::meetings(const State& state, int triangle, std::vector<Meeting>& list) const {
  list.clear();
  const TriangleNodes x = positions(state, triangle);
  const double area = interface_.slave.triangles[triangle].area;
  for (const ContactPoint& point : history(state).elements[triangle].points) {
    const Gap g = gap(state, x, point);
    if (g.facing) list.push_back({point.weight * area, point.L, point.N, point.site.facet, g.x, g.value, g.shape, g.at});
  }
}

std::vector<Contact::PointForce> Contact::point_forces(const State& state) const {
  std::vector<PointForce> forces;
  const auto& elements = history(state).elements;
  for (int e = 0; e < triangles(); ++e) {
    const TriangleNodes x = positions(state, e);
    for (const ContactPoint& point : elements[e].points) {
      const Gap g = gap(state, x, point);
      PointForce force{.x = g.x, .y = g.x, .triangle = e, .L = point.L, .weight = point.line ? 0.0 : point.weight};
      if (g.facing) {
        force.facet = point.site.facet;
        force.xi = clamped(interface_.master.kind(force.facet), point.site.xi);  // it may stay with its facet a little over the edge
        force.pressing = point.weight * interface_.slave.triangles[e].area * pressure(state, e, point.L);
        force.y = g.at.y, force.force = force.pressing * g.at.n;
      }
      forces.push_back(force);
    }
  }
  return forces;
}

std::vector<double> Contact::current_areas(const State& state) const {
  std::vector<double> areas(vertices(), 0.0);
  for (int t = 0; t < triangles(); ++t) {
    const TriangleNodes x = positions(state, t);
    for (const TrianglePoint& q : triangle_rule()) {
      const Eigen::Matrix<double, 3, 2> tangents = x * garment_slopes(interface_.slave.order, q.L);
      const double part = 0.5 * q.weight * tangents.col(0).cross(tangents.col(1)).norm();
      for (int v = 0; v < 3; ++v) areas[vertices_of(t)[v]] += part * q.L[v];
    }
  }
  return areas;
}

void Contact::publish(const State& state, PublishedFields& fields) const {
  const ContactSlave& slave = interface_.slave;
  std::vector<double> pressures = current_areas(state);
  for (int i = 0; i < vertices(); ++i) pressures[i] = pressure(state, i) * slave.area[i] / pressures[i];
  slave.spread(pressures, [](double a, double b) { return 0.5 * (a + b); },
               fields[slave.part].ensure(postproc::field::contact_pressure, slave.mesh_nodes));
}

}  // namespace snug::solver
