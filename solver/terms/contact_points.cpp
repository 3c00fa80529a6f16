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

std::vector<Contact::Place> Contact::places(const State& state) const {
  const auto& elements = history(state).elements;
  std::vector<Place> places;
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const ContactPoint& point : elements[e].points) places.push_back({static_cast<int>(e), point.L, point.weight});
  return places;
}

std::vector<Contact::PointForce> Contact::point_forces(const State& state) const {
  std::vector<PointForce> forces;
  const auto& elements = history(state).elements;
  for (int e = 0; e < triangles(); ++e) {
    const TriangleNodes x = positions(state, e);
    for (const ContactPoint& point : elements[e].points) {
      const Gap g = gap(state, x, point);
      PointForce force{g.x, g.x, Eigen::Vector3d::Zero()};
      if (g.facing) {
        force.y = g.at.y;
        force.force = point.weight * interface_.slave.triangles[e].area * pressure(state, e, point) * g.at.n;
      }
      forces.push_back(force);
    }
  }
  return forces;
}

std::vector<postproc::ContactSample> Contact::samples(const State& state) const {
  std::vector<postproc::ContactSample> samples;
  const auto& elements = history(state).elements;
  for (int e = 0; e < triangles(); ++e) {
    const TriangleNodes x = positions(state, e);
    for (const ContactPoint& point : elements[e].points) {
      postproc::ContactSample sample;
      const Gap g = gap(state, x, point);
      if (g.facing) {
        sample.facet = point.site.facet;
        const Eigen::Vector2d xi = clamped(interface_.master.kind(), point.site.xi);  // it may stay with its facet a little over the edge
        sample.xi = xi[0], sample.eta = xi[1];
        sample.force = point.weight * interface_.slave.triangles[e].area * pressure(state, e, point);
        sample.touching = sample.force > 0.0;
      }
      samples.push_back(sample);
    }
  }
  return samples;
}

}  // namespace snug::solver
