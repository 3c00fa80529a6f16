#include "solver/terms/tool_contact.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/terms/parallel.hpp"

namespace snug::solver {

namespace {

// As in Contact: rows are stiffer than the decision of what touches.
constexpr double row_stiffening = 1e4;

}  // namespace

ToolContact::ToolContact(std::string name, Fields fields, const mesh::BodyMesh& mesh, ToolSurface surface, RigidTool tool, double stiffness)
    : name_(std::move(name)), fields_(std::move(fields)), surface_(std::move(surface)), tool_(tool), stiffness_(stiffness),
      area_(surface_.node_of_vertex.size(), 0.0), share_(area_.size(), 0.0), mesh_nodes_(static_cast<int>(mesh.nodes.size())) {
  for (int f = 0; f < facets(); ++f) {
    const FacetNodes rest = facet_positions(mesh, surface_.facets[f]);
    for (const ToolPoint& q : tool_points(surface_.kind)) {
      weights_.push_back(q.weight * facet_point(rest, q.shape).area);
      for (int v = 0; v < corners(); ++v) area_[surface_.vertices[f][v]] += weights_.back() * q.hat[v];
    }
    for (int v = 0; v < corners(); ++v) share_[surface_.vertices[f][v]] += 1.0;
    const auto nodes = facet_entries(fields_.body, surface_.facets[f]);
    std::vector<int> entries(nodes.begin(), nodes.end());
    for (int c = 0; c < 3; ++c) entries.push_back(fields_.tip(0, c));
    for (const int vertex : surface_.vertices[f]) entries.push_back(fields_.pressures(vertex));
    entries_.push(entries);
  }
  for (double& share : share_) share = 1.0 / share;
}

ToolHistory& ToolContact::edit(State& state) const {
  auto& history = state.history.edit<ToolHistory>(name_);
  if (history.active.flags().empty()) history.active = ActiveSet(vertices());
  return history;
}

Eigen::Vector4d ToolContact::pressures(const State& state, int facet) const {
  Eigen::Vector4d p = Eigen::Vector4d::Zero();
  for (int v = 0; v < corners(); ++v) p[v] = state.values[fields_.pressures(surface_.vertices[facet][v])];
  return p;
}

std::vector<double> ToolContact::weighted_gaps(const State& state) const {
  std::vector<double> gaps(vertices(), 0.0);
  const std::vector<ToolPoint>& points = tool_points(surface_.kind);
  const Eigen::Vector3d at = tip(state);
  for (int f = 0; f < facets(); ++f) {
    const FacetNodes x = facet_positions(state, fields_.body, surface_.facets[f]);
    for (std::size_t q = 0; q < points.size(); ++q) {
      const double weighted = weights_[f * points.size() + q] * tool_.gap(x * points[q].shape.N - at).value;
      for (int v = 0; v < corners(); ++v) gaps[surface_.vertices[f][v]] += points[q].hat[v] * weighted;
    }
  }
  return gaps;
}

double ToolContact::energy(const State& state) const {
  const std::vector<double> gaps = weighted_gaps(state);
  double sum = 0.0;
  for (int i = 0; i < vertices(); ++i) sum -= state.values[fields_.pressures(i)] * gaps[i];
  return sum;
}

void ToolContact::renew(State& state) const { edit(state).active.begin(); }

void ToolContact::update(State& state) const {
  if (!state.history.has(name_)) renew(state);
  ToolHistory& history = edit(state);
  history.weighted_gap = weighted_gaps(state);
  std::vector<double> trials(vertices());
  for (int i = 0; i < vertices(); ++i) trials[i] = state.values[fields_.pressures(i)] - stiffness_ * history.weighted_gap[i] / area_[i];
  history.active.follow(trials);
}

void ToolHistory::write(ByteWriter& writer) const {
  const ActiveSet::Memory& memory = active.memory();
  writer(memory.flags), writer(memory.changed), writer(memory.fewest_wrong), writer(memory.waited), writer(memory.circled), writer(memory.turns), writer(weighted_gap);
}

void ToolContact::restore(State& state) const {
  const auto* stored = state.history.find<StoredHistory>(name_);
  if (!stored) return;
  auto history = std::make_shared<ToolHistory>(vertices());
  ByteReader reader(stored->bytes);
  ActiveSet::Memory memory;
  reader(memory.flags), reader(memory.changed), reader(memory.fewest_wrong), reader(memory.waited), reader(memory.circled), reader(memory.turns), reader(history->weighted_gap), reader.finish();
  if (static_cast<int>(memory.flags.size()) != vertices()) throw std::runtime_error("a stored state has another tool");
  history->active = ActiveSet(std::move(memory));
  state.history.put(name_, std::move(history));
}

void ToolContact::add_points(const State& state, int facet, Tangent tangent, Slot& slot) const {
  const std::vector<ToolPoint>& points = tool_points(surface_.kind);
  const FacetNodes x = facet_positions(state, fields_.body, surface_.facets[facet]);
  const Eigen::Vector4d p = pressures(state, facet);
  const std::vector<char>& active = this->active(state);
  std::array<bool, 4> touches{};
  for (int v = 0; v < corners(); ++v) touches[v] = active[surface_.vertices[facet][v]];
  if (p.isZero(0.0) && std::none_of(touches.begin(), touches.end(), [](bool t) { return t; })) return;
  const Eigen::Vector3d at = tip(state);
  for (std::size_t q = 0; q < points.size(); ++q) {
    const ToolGap gap = tool_.gap(x * points[q].shape.N - at);
    Eigen::Matrix<double, 10, 1> part;  // of the nodes in x - tip
    part << points[q].shape.N, -1.0;
    Eigen::Matrix<double, size, 1> slope = Eigen::Matrix<double, size, 1>::Zero();
    for (int a = 0; a < 10; ++a) slope.segment<3>(3 * a) = part[a] * gap.normal;
    const double weight = weights_[facet * points.size() + q], pressing = weight * p.dot(points[q].hat);
    slot.residual -= pressing * slope;
    for (int v = 0; v < 4; ++v) {
      if (!touches[v]) continue;
      const double of_row = weight * points[q].hat[v];
      slot.residual[pressure_row + v] -= of_row * gap.value;
      if (!wanted(tangent)) continue;
      slot.matrix.col(pressure_row + v) -= of_row * slope;
      slot.matrix.row(pressure_row + v) -= of_row * slope.transpose();
    }
    if (tangent != Tangent::full || pressing == 0.0) continue;  // the distance from a convex tool is convex: under pressure this is negative
    for (int a = 0; a < 10; ++a)
      for (int b = 0; b < 10; ++b) slot.matrix.block<3, 3>(3 * a, 3 * b) -= pressing * part[a] * part[b] * gap.curvature;
  }
}

void ToolContact::add_rows(const State& state, int facet, Slot& slot) const {
  const std::vector<char>& active = this->active(state);
  for (int v = 0; v < corners(); ++v) {
    const int vertex = surface_.vertices[facet][v];
    const double epsilon = share_[vertex] * area_[vertex] / stiffness_ / row_stiffening;
    if (!active[vertex]) slot.residual[pressure_row + v] -= epsilon * state.values[fields_.pressures(vertex)];
    slot.matrix(pressure_row + v, pressure_row + v) -= epsilon;
  }
}

bool ToolContact::assemble(const State& state, Tangent tangent, Sink& sink) const {
  std::vector<Slot> slots(64);
  const auto compute = [&](int f, Slot& slot) {
    slot.residual.setZero(), slot.matrix.setZero();
    add_points(state, f, tangent, slot);
    add_rows(state, f, slot);
    return slot.residual.allFinite();
  };
  return for_elements(sink, facets(), slots, compute, [&](int f, Slot& slot) {
    sink.add(f, {slot.residual.data(), size},
             wanted(tangent) ? std::span<const double>(slot.matrix.data(), size * size) : std::span<const double>());
  });
}

double ToolContact::step_bound(const State&, const Eigen::VectorXd& direction, double limit) const {
  const Eigen::Vector3d moved = direction.segment<3>(fields_.tip(0));
  double longest = moved.norm();
  for (const int node : surface_.node_of_vertex) longest = std::max(longest, (direction.segment<3>(fields_.body(node)) - moved).norm());
  const double most = 0.5 * surface_.mean_edge;
  return longest * limit > most ? most / longest : limit;
}

void ToolContact::measure(const State& state, Measure& measure) const {
  const ToolHistory& now = history(state);
  double sum = 0.0;
  int touching = 0;
  for (int i = 0; i < vertices(); ++i) {
    const double p = state.values[fields_.pressures(i)], g = now.weighted_gap[i] / area_[i];
    if (now.active[i]) sum += p, ++touching;
    measure.complementarity = std::max(measure.complementarity, now.active[i] ? -p : std::abs(p));
    measure.penetration = std::max(measure.penetration, now.active[i] ? std::abs(g) : -g);
  }
  measure.active += touching, measure.changed += now.active.changed();
  if (touching > 0) measure.pressure_scale = std::max(measure.pressure_scale, sum / touching);
  measure.contact_force += sums(state).pressing;
}

std::vector<double> ToolContact::current_areas(const State& state) const {
  std::vector<double> areas(vertices(), 0.0);
  for (int f = 0; f < facets(); ++f) {
    const FacetNodes x = facet_positions(state, fields_.body, surface_.facets[f]);
    for (const ToolPoint& q : tool_points(surface_.kind)) {
      const double part = q.weight * facet_point(x, q.shape).area;
      for (int v = 0; v < corners(); ++v) areas[surface_.vertices[f][v]] += part * q.hat[v];
    }
  }
  return areas;
}

ToolContact::Sums ToolContact::sums(const State& state) const {
  Sums sums;
  for (int f = 0; f < facets(); ++f) {
    Eigen::Vector4d p = Eigen::Vector4d::Zero();
    for (int v = 0; v < corners(); ++v) p[v] = pressure(state, surface_.vertices[f][v]);
    for_points(state, f, [&](const Meeting& q) {
      sums.inside = std::max(sums.inside, -q.gap);
      const Eigen::Vector3d force = -q.weight * p.dot(q.hat) * q.normal;
      sums.force += force, sums.moment += q.from_tip.cross(force), sums.pressing += force.norm();
    });
  }
  const std::vector<double> areas = current_areas(state);
  for (int i = 0; i < vertices(); ++i) {
    const double p = pressure(state, i);
    if (p <= 0.0) continue;
    sums.area += areas[i];
    sums.largest_pressure = std::max(sums.largest_pressure, p * area_[i] / areas[i]);
  }
  return sums;
}

void ToolContact::publish(const State& state, PublishedFields& fields) const {
  std::vector<double> now = current_areas(state);
  for (int i = 0; i < vertices(); ++i) now[i] = pressure(state, i) * area_[i] / now[i];
  std::vector<double>& field = fields["body"].ensure(postproc::field::contact_pressure, mesh_nodes_);
  const std::vector<Eigen::Vector4d>& hats = hats_at_nodes(surface_.kind);
  for (int f = 0; f < facets(); ++f)
    for (std::size_t a = 0; a < hats.size(); ++a) {
      double p = 0.0;
      for (int v = 0; v < corners(); ++v) p += hats[a][v] * now[surface_.vertices[f][v]];
      field[surface_.facets[f][a]] = p;
    }
}

}  // namespace snug::solver
