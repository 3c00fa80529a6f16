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

// Over the slave's mean edge: a third of the penetration that an answer may have.
constexpr double slack_gap = 3e-7;

}  // namespace

Contact::Contact(std::string name, Interface interface, double stiffness, GapBasis basis)
    : name_(std::move(name)), interface_(std::move(interface)), basis_(basis), stiffness_(stiffness),
      fallback_parts_(parts(interface_.slave.mean_edge, interface_.master.shortest_mean_edge())),
      reach_(5.0 * interface_.master.longest_mean_edge()),
      step_limit_(0.5 * interface_.slave.mean_edge), share_(vertices(), 0.0) {
  for (const auto& triangle : interface_.slave.triangles)
    for (const int vertex : triangle.vertices) share_[vertex] += 1.0;
  for (double& share : share_) share = 1.0 / share;
}

Eigen::Vector3d Contact::basis(const Eigen::Vector3d& L) const {
  return basis_ == GapBasis::hat ? L : Eigen::Vector3d(4.0 * L.array() - 1.0);  // 3 L_i - L_j - L_k
}

TriangleNodes Contact::positions(const State& state, int triangle) const {
  TriangleNodes x;
  for (int a = 0; a < 6; ++a) x.col(a) = state.values.segment<3>(interface_.slave.triangles[triangle].entries[a]);
  return x;
}

Contact::Gap Contact::gap(const State& state, const TriangleNodes& x, const ContactPoint& point) const {
  Gap gap;
  gap.x = x * point.N;
  if (point.site.facet < 0) return gap;
  gap.shape = facet_shape(interface_.master.kind(point.site.facet), point.site.xi);
  gap.at = facet_point(interface_.master.positions(state, point.site.facet), gap.shape);
  gap.value = (gap.x - gap.at.y).dot(gap.at.n);
  gap.facing = std::abs(gap.value) < reach_;
  return gap;
}

double Contact::multiplier(const State& state, int triangle, const Eigen::Vector3d& L) const {
  const Eigen::Vector3d phi = basis(L);
  double p = 0.0;
  for (int v = 0; v < 3; ++v) p += phi[v] * multiplier(state, vertices_of(triangle)[v]);
  return p;
}

double Contact::pressure(const State& state, int triangle, const Eigen::Vector3d& L) const {
  const Eigen::Vector3d phi = basis(L);
  double p = 0.0;
  for (int v = 0; v < 3; ++v) p += phi[v] * pressure(state, vertices_of(triangle)[v]);
  return p;
}

void Contact::weigh(const State& state, ContactHistory& history) const {
  history.weighted_gap.assign(vertices(), 0.0);
  history.facing_area.assign(vertices(), 0.0);
  for (int e = 0; e < triangles(); ++e) {
    const TriangleNodes x = positions(state, e);
    const auto& triangle = interface_.slave.triangles[e];
    for (const ContactPoint& point : history.elements[e].points) {
      const Gap g = gap(state, x, point);
      if (!g.facing) continue;
      const Eigen::Vector3d phi = basis(point.L);
      for (int v = 0; v < 3; ++v) {
        history.weighted_gap[triangle.vertices[v]] += point.weight * triangle.area * phi[v] * g.value;
        history.facing_area[triangle.vertices[v]] += point.weight * triangle.area * point.L[v];
      }
    }
  }
}

bool Contact::faces(const ContactHistory& history, int vertex) const {
  return history.facing_area[vertex] > 0.05 * rest_area(vertex);
}

void Contact::decide(const State& state, ContactHistory& history) const {
  std::vector<double> trials(vertices());
  for (int i = 0; i < vertices(); ++i) {
    const double trial = multiplier(state, i) - stiffness_ * history.weighted_gap[i] / rest_area(i);
    trials[i] = faces(history, i) ? trial : -std::abs(trial);
  }
  history.active.follow(trials, stiffness_ * slack_gap * interface_.slave.mean_edge);
}

void Contact::yield(State& state, ContactHistory& history) const {
  std::vector<char> flags(vertices());
  for (int i = 0; i < vertices(); ++i) {
    const double trial = history.reference[i] - stiffness_ / state.yielding * history.weighted_gap[i] / rest_area(i);
    const double p = faces(history, i) ? std::max(0.0, trial) : 0.0;
    state.values[interface_.pressures(i)] = p;
    flags[i] = p > 0.0;
  }
  history.active = ActiveSet({.flags = std::move(flags)});
}

void Contact::update(State& state) const {
  if (!state.history.has(name_)) renew(state);
  ContactHistory& history = edit(state);
  locate(state, history);
  weigh(state, history);
  state.yielding > 0.0 ? yield(state, history) : decide(state, history);
}

void Contact::measure(const State& state, Measure& measure) const {
  const ContactHistory& now = history(state);
  double sum = 0.0;
  for (int i = 0; i < vertices(); ++i) {
    const double p = multiplier(state, i), g = now.weighted_gap[i] / rest_area(i);
    if (now.active[i]) {
      sum += p;
      ++measure.active;
      if (state.yielding == 0.0) measure.penetration = std::max(measure.penetration, std::abs(g));
      measure.complementarity = std::max(measure.complementarity, -p);
    } else {
      measure.complementarity = std::max(measure.complementarity, std::abs(p));
      if (state.yielding == 0.0 && faces(now, i)) measure.penetration = std::max(measure.penetration, -g);
    }
  }
  measure.changed += now.active.changed();
  if (measure.active > 0) measure.pressure_scale = std::max(measure.pressure_scale, sum / measure.active);
  for (const PointForce& force : point_forces(state)) measure.contact_force += force.force.norm();
}

}  // namespace snug::solver
