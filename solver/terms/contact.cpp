#include "solver/terms/contact.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <utility>

namespace snug::solver {

namespace {

// Parts of a slave edge for a triangle that could not be cut along the facets: a quarter of a facet.
int parts(double slave_edge, double skin_cell) {
  return std::clamp(static_cast<int>(std::ceil(4.0 * slave_edge / skin_cell - 0.25)), 1, 8);
}

}  // namespace

Contact::Contact(const Layout& layout, ContactSlave slave, const mesh::BodyMesh& body, bool deformable, double stiffness,
                 GapBasis basis)
    : layout_(layout), slave_(std::move(slave)), skin_(layout, body, deformable),
      fallback_parts_(parts(slave_.mean_edge, body.mean_skin_cell)), skin_nodes_(static_cast<int>(body.nodes.size())),
      basis_(basis), stiffness_(stiffness), reach_(5.0 * body.mean_skin_cell), step_limit_(0.5 * slave_.mean_edge),
      elements_(slave_.triangles.size()), share_(vertices(), 0.0), weighted_gap_(vertices(), 0.0),
      facing_area_(vertices(), 0.0), active_(vertices()) {
  for (const auto& triangle : slave_.triangles)
    for (const int vertex : triangle.vertices) share_[vertex] += 1.0;
  for (double& share : share_) share = 1.0 / share;
  rebuild_entries();
}

Eigen::Vector3d Contact::basis(const Eigen::Vector3d& L) const {
  return basis_ == GapBasis::hat ? L : Eigen::Vector3d(4.0 * L.array() - 1.0);  // 3 L_i - L_j - L_k
}

TriangleNodes Contact::positions(const State& state, int triangle) const {
  TriangleNodes x;
  for (int a = 0; a < 6; ++a) x.col(a) = state.values.segment<3>(slave_.triangles[triangle].entries[a]);
  return x;
}

int Contact::points() const {
  int sum = 0;
  for (const Element& element : elements_) sum += static_cast<int>(element.points.size());
  return sum;
}

Contact::Gap Contact::gap(const State& state, const TriangleNodes& x, const ContactPoint& point) const {
  Gap gap;
  gap.x = x * point.N;
  if (point.site.facet < 0) return gap;
  gap.shape = facet_shape(skin_.kind(), point.site.xi);
  gap.at = facet_point(skin_.positions(state, point.site.facet), gap.shape);
  gap.value = (gap.x - gap.at.y).dot(gap.at.n);
  gap.facing = std::abs(gap.value) < reach_;
  return gap;
}

double Contact::pressure(const State& state, int triangle, const ContactPoint& point) const {
  const Eigen::Vector3d phi = basis(point.L);
  double p = 0.0;
  for (int v = 0; v < 3; ++v) p += phi[v] * state.values[layout_.multiplier(slave_.triangles[triangle].vertices[v])];
  return p;
}

void Contact::weigh(const State& state) {
  std::fill(weighted_gap_.begin(), weighted_gap_.end(), 0.0);
  std::fill(facing_area_.begin(), facing_area_.end(), 0.0);
  for (int e = 0; e < triangles(); ++e) {
    const TriangleNodes x = positions(state, e);
    const auto& triangle = slave_.triangles[e];
    for (const ContactPoint& point : elements_[e].points) {
      const Gap g = gap(state, x, point);
      if (!g.facing) continue;
      const Eigen::Vector3d phi = basis(point.L);
      for (int v = 0; v < 3; ++v) {
        weighted_gap_[triangle.vertices[v]] += point.weight * triangle.area * phi[v] * g.value;
        facing_area_[triangle.vertices[v]] += point.weight * triangle.area * point.L[v];
      }
    }
  }
}

bool Contact::faces(int vertex) const { return facing_area_[vertex] > 0.05 * slave_.area[vertex]; }

void Contact::decide(const State& state) {
  std::vector<double> trials(vertices());
  for (int i = 0; i < vertices(); ++i) {
    const double trial = state.values[layout_.multiplier(i)] - stiffness_ * weighted_gap_[i] / slave_.area[i];
    trials[i] = faces(i) ? trial : -std::abs(trial);
  }
  active_.follow(trials);
}

bool Contact::update(const State& state) {
  if (points() == 0) renew(state);
  const bool moved = locate(state);
  weigh(state);
  decide(state);
  return moved;
}

void Contact::measure(const State& state, Measure& measure) const {
  double sum = 0.0;
  for (int i = 0; i < vertices(); ++i) {
    const double p = state.values[layout_.multiplier(i)], g = weighted_gap_[i] / slave_.area[i];
    if (active_[i]) {
      sum += p;
      ++measure.active;
      measure.penetration = std::max(measure.penetration, std::abs(g));
      measure.complementarity = std::max(measure.complementarity, -p);
    } else {
      measure.complementarity = std::max(measure.complementarity, std::abs(p));
      if (faces(i)) measure.penetration = std::max(measure.penetration, -g);
    }
  }
  measure.changed += active_.changed();
  if (measure.active > 0) measure.reference_pressure = std::max(measure.reference_pressure, sum / measure.active);
  for (const PointForce& force : point_forces(state)) measure.contact_force += force.force.norm();
}

}  // namespace snug::solver
