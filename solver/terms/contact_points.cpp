// What the contact term tells others of its quadrature points.
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
      PointForce force{.x = g.x, .y = g.x, .triangle = e, .L = point.L, .weight = point.weight};
      if (g.facing) {
        force.facet = point.site.facet;
        force.xi = clamped(interface_.master.kind(), point.site.xi);  // it may stay with its facet a little over the edge
        force.pressing = point.weight * interface_.slave.triangles[e].area * pressure(state, e, point);
        force.y = g.at.y, force.force = force.pressing * g.at.n;
      }
      forces.push_back(force);
    }
  }
  return forces;
}

}  // namespace snug::solver
