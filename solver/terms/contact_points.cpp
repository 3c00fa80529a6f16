// What the contact term tells others of its quadrature points.
#include "solver/terms/contact.hpp"

namespace snug::solver {

void Contact::meetings(const State& state, int triangle, std::vector<Meeting>& list) const {
  list.clear();
  const TriangleNodes x = positions(state, triangle);
  const double area = slave_.triangles[triangle].area;
  for (const ContactPoint& point : elements_[triangle].points) {
    const Gap g = gap(state, x, point);
    if (g.facing) list.push_back({point.weight * area, point.L, point.N, point.site.facet, g.x, g.value, g.shape, g.at});
  }
}

std::vector<Contact::Place> Contact::places() const {
  std::vector<Place> places;
  places.reserve(points());
  for (std::size_t e = 0; e < elements_.size(); ++e)
    for (const ContactPoint& point : elements_[e].points) places.push_back({static_cast<int>(e), point.L, point.weight});
  return places;
}

std::vector<Contact::PointForce> Contact::point_forces(const State& state) const {
  std::vector<PointForce> forces;
  forces.reserve(points());
  for (int e = 0; e < triangles(); ++e) {
    const TriangleNodes x = positions(state, e);
    for (const ContactPoint& point : elements_[e].points) {
      const Gap g = gap(state, x, point);
      PointForce force{g.x, g.x, Eigen::Vector3d::Zero()};
      if (g.facing) {
        force.y = g.at.y;
        force.force = point.weight * slave_.triangles[e].area * pressure(state, e, point) * g.at.n;
      }
      forces.push_back(force);
    }
  }
  return forces;
}

std::vector<postproc::ContactSample> Contact::samples(const State& state) const {
  std::vector<postproc::ContactSample> samples;
  samples.reserve(points());
  for (int e = 0; e < triangles(); ++e) {
    const TriangleNodes x = positions(state, e);
    for (const ContactPoint& point : elements_[e].points) {
      postproc::ContactSample sample;
      const Gap g = gap(state, x, point);
      if (g.facing) {
        sample.facet = point.site.facet;
        const Eigen::Vector2d xi = clamped(skin_.kind(), point.site.xi);  // it may stay with its facet a little over the edge
        sample.xi = xi[0], sample.eta = xi[1];
        sample.force = point.weight * slave_.triangles[e].area * pressure(state, e, point);
        sample.touching = sample.force > 0.0;
      }
      samples.push_back(sample);
    }
  }
  return samples;
}

}  // namespace snug::solver
