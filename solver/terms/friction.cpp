#include "solver/terms/friction.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/terms/coulomb.hpp"
#include "solver/terms/parallel.hpp"

namespace snug::solver {

namespace {

// Column of a node of the facet among the entries of the triangle.
int column_of(const std::vector<int>& master_nodes, int node) {
  const auto it = std::find(master_nodes.begin(), master_nodes.end(), node);
  return 18 + 3 * static_cast<int>(it - master_nodes.begin());
}

// The rotation that takes a triangle (a corner a column, m) nearest to another one: that of the polar decomposition of the map between them and their normals.
Eigen::Matrix3d turn_between(const Eigen::Matrix3d& before, const Eigen::Matrix3d& now) {
  const auto sides = [](const Eigen::Matrix3d& x) {
    Eigen::Matrix3d s;
    s << x.col(1) - x.col(0), x.col(2) - x.col(0), Eigen::Vector3d::Zero();
    const Eigen::Vector3d normal = s.col(0).cross(s.col(1));
    s.col(2) = std::sqrt(normal.norm()) * normal.normalized();  // as long as the sides
    return s;
  };
  const Eigen::Matrix3d from = sides(before), to = sides(now);
  if (!(std::abs(from.determinant()) > 0.0)) return Eigen::Matrix3d::Identity();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(to * from.inverse(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

}  // namespace

struct Friction::Slot {
  Eigen::VectorXd residual;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> matrix;
};

Friction::Friction(std::string name, const Contact& contact, double coefficient, double elastic_slip, double sticking)
    : name_(std::move(name)), contact_(contact), coefficient_(coefficient), elastic_slip_(elastic_slip), sticking_(sticking) {}

double Friction::vertex_pressure(const State& state, int vertex) const {
  return std::max(0.0, contact_.multiplier(state, vertex));
}

double Friction::slip_stiffness(const State& state) const {
  if (state.release == 0.0) return sticking_;
  double force = 0.0, area = 0.0;
  for (int i = 0; i < contact_.vertices(); ++i)
    if (const double p = vertex_pressure(state, i); p > 0.0) force += p * contact_.rest_area(i), area += contact_.rest_area(i);
  return area > 0.0 ? coefficient_ * force / area / elastic_slip_ : 0.0;
}

/// The state's own history, which begins without traction where the state is.
FrictionHistory& Friction::edit(State& state) const {
  FrictionHistory& history = state.history.edit<FrictionHistory>(name_);
  if (history.anchor.size() > 0) return history;
  history.anchor = state.values;
  history.traction = Eigen::VectorXd::Zero(9 * contact_.triangles());
  history.held = Eigen::VectorXd::Zero(3 * contact_.triangles());
  return history;
}

void Friction::renew(State& state) const { edit(state).stiffness = slip_stiffness(state); }

FrictionHistory::Element Friction::frame(const State& state, const Eigen::VectorXd& held, int triangle) const {
  FrictionHistory::Element element;
  std::vector<Contact::Meeting> points;
  contact_.meetings(state, triangle, points);
  const ContactHistory& contact = contact_.history(state);
  const auto& vertices = contact_.vertices_of(triangle);
  const auto& master_nodes = contact.elements[triangle].master_nodes;
  const int columns = 18 + 3 * static_cast<int>(master_nodes.size());
  for (int v = 0; v < 3; ++v) {
    Corner& corner = element[v];
    if (state.release == 0.0)
      corner.bound = std::numeric_limits<double>::infinity();
    else {
      if (contact.active[vertices[v]]) corner.bound = coefficient_ * vertex_pressure(state, vertices[v]) / state.release;
      if (state.release < 1.0) corner.bound += (1.0 - state.release) * held[3 * triangle + v];
    }
    if (corner.bound > 0.0) corner.slip.setZero(3, columns);
  }
  for (const Contact::Meeting& q : points) {
    const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - q.at.n * q.at.n.transpose();
    const Eigen::Matrix<double, 3, 9> c = q.at.tangent * q.at.metric.inverse() * q.shape.dN.transpose();
    const bool moves = contact_.master().moves(q.facet);
    for (int v = 0; v < 3; ++v) {
      Corner& corner = element[v];
      if (corner.bound == 0.0) continue;
      const double weight = q.weight * q.L[v];
      corner.area += weight;
      corner.normal += weight * q.at.n;
      for (int a = 0; a < 6; ++a) corner.slip.middleCols<3>(3 * a) += weight * q.N[a] * P;
      for (int b = 0; b < 9 && moves; ++b)
        if (const int node = contact_.master().nodes_of(q.facet)[b]; node >= 0)
          corner.slip.middleCols<3>(column_of(master_nodes, node)) +=
              weight * (q.gap * c.col(b) * q.at.n.transpose() - q.shape.N[b] * P);
    }
  }
  for (Corner& corner : element) {  // in the corner's own plane, so that the tractions stay as they are when history takes them over
    corner.normal.normalize();
    if (corner.bound > 0.0) corner.slip -= corner.normal * (corner.normal.transpose() * corner.slip).eval();
  }
  return element;
}

std::shared_ptr<std::vector<FrictionHistory::Element>> Friction::frames(const State& state, const Eigen::VectorXd& held) const {
  auto frames = std::make_shared<std::vector<FrictionHistory::Element>>(contact_.triangles());
  tbb::parallel_for(0, contact_.triangles(), [&](int triangle) { (*frames)[triangle] = frame(state, held, triangle); });
  return frames;
}

void Friction::update(State& state) const {
  FrictionHistory& history = edit(state);
  if (history.stiffness == 0.0) history.stiffness = slip_stiffness(state);
  const auto before = std::exchange(history.fresh, false) ? nullptr : history.frames;
  const auto now = frames(state, history.held);
  history.frames = now;
  if (history.stiffness > 0.0) follow_slip(state, history, before.get(), *now);
}

void Friction::follow_slip(const State& state, const FrictionHistory& history, const std::vector<FrictionHistory::Element>* before,
                           std::vector<FrictionHistory::Element>& now) const {
  tbb::parallel_for(0, contact_.triangles(), [&](int e) {
    const Change d = change(state, history, e);
    for (int v = 0; v < 3; ++v) {
      Corner& corner = now[e][v];
      if (corner.area <= 0.0) continue;
      const Return r = traction(history, d, e, v);
      if (r.slips) remember_slip(r.traction, before ? &(*before)[e][v] : nullptr, corner);
    }
  });
}

Friction::Change Friction::change(const State& state, const FrictionHistory& history, int triangle) const {
  const auto entries = contact_.entries(state).of(triangle);
  Change change{.by = Eigen::VectorXd(entries.size() - 3), .turn = {}};
  const Eigen::Index positions = change.by.size();
  for (Eigen::Index i = 0; i < positions; ++i) change.by[i] = state.values[entries[i]] - history.anchor[entries[i]];
  if (state.posture == 0.0) return change;
  const auto corners = [&](const Eigen::VectorXd& values) {
    Eigen::Matrix3d x;
    for (int i = 0; i < 9; ++i) x(i % 3, i / 3) = values[entries[i]];
    return x;
  };
  const Eigen::Matrix3d before = corners(history.anchor), now = corners(state.values);
  change.turn = turn_between(before, now);
  const Eigen::Vector3d middle = before.rowwise().mean(), middle_now = now.rowwise().mean();
  for (Eigen::Index i = 0; i < positions; i += 3) {
    Eigen::Vector3d anchor;
    for (int c = 0; c < 3; ++c) anchor[c] = history.anchor[entries[i + c]];
    const Eigen::Vector3d gone_along = middle_now + *change.turn * (anchor - middle);
    for (int c = 0; c < 3; ++c) change.by[i + c] = state.values[entries[i + c]] - gone_along[c];
  }
  return change;
}

Friction::Return Friction::traction(const FrictionHistory& history, const Change& change, int triangle, int v) {
  const Corner& corner = (*history.frames)[triangle][v];
  Eigen::Vector3d before = history.traction.segment<3>(9 * triangle + 3 * v);
  if (change.turn) before = *change.turn * before;
  Return r;
  r.trial = transported(before, corner.normal) + history.stiffness / corner.area * (corner.slip * change.by);
  const Bounded held = bounded(r.trial, corner.bound);
  r.traction = held.traction, r.slips = held.slips;
  return r;
}

double Friction::energy(const State& state) const {
  const FrictionHistory& now = history(state);
  double sum = 0.0;
  for (int e = 0; e < contact_.triangles() && now.stiffness > 0.0; ++e) {
    const Change d = change(state, now, e);
    for (int v = 0; v < 3; ++v) {
      const Corner& corner = (*now.frames)[e][v];
      if (corner.area <= 0.0) continue;
      sum += energy_of_slip(traction(now, d, e, v).trial.norm(), corner.bound, corner.area, now.stiffness);
    }
  }
  return sum;
}

bool Friction::assemble(const State& state, Tangent tangent, Sink& sink) const {
  const FrictionHistory& now = history(state);
  if (now.stiffness == 0.0) return true;
  std::vector<Slot> slots(64);
  const auto compute = [&](int e, Slot& slot) {
    const Change d = change(state, now, e);
    const Eigen::Index columns = d.by.size(), n = columns + 3;
    slot.residual.setZero(n);
    if (wanted(tangent)) slot.matrix.setZero(n, n);
    for (int v = 0; v < 3; ++v) {
      const Corner& corner = (*now.frames)[e][v];
      if (corner.area <= 0.0) continue;
      const Return r = traction(now, d, e, v);
      slot.residual.head(columns) += corner.slip.transpose() * r.traction;
      if (!wanted(tangent)) continue;
      const Eigen::Matrix3d H = slope_of_return(r.trial, corner.bound, r.slips, corner.turned);
      slot.matrix.topLeftCorner(columns, columns).noalias() +=
          corner.slip.transpose() * (now.stiffness / corner.area * H * corner.slip);
    }
    return slot.residual.allFinite();
  };
  return for_elements(sink, contact_.triangles(), slots, compute, [&](int e, Slot& slot) {
    const auto n = static_cast<std::size_t>(slot.residual.size());
    sink.add(e, {slot.residual.data(), n},
             wanted(tangent) ? std::span<const double>(slot.matrix.data(), n * n) : std::span<const double>());
  });
}

// A corner that slips bears t = b t* / |t*| with the bound b = mu p / release: dt = mu / release t* / |t*| dp, which its slip takes to the
// positions. The whole of the linearised law is not symmetric (Wriggers, sec. 9.4).
void Friction::add_one_way(const State& state, std::vector<Eigen::Triplet<double>>& derivative) const {
  const FrictionHistory& now = history(state);
  if (state.release == 0.0 || now.stiffness == 0.0) return;
  const auto& active = contact_.active(state);
  for (int e = 0; e < contact_.triangles(); ++e) {
    const auto entries = contact_.entries(state).of(e);
    const auto multipliers = entries.last(3);
    std::optional<Change> d;
    for (int v = 0; v < 3; ++v) {
      const Corner& corner = (*now.frames)[e][v];
      const int vertex = contact_.vertices_of(e)[v];
      if (corner.area <= 0.0 || !active[vertex] || contact_.multiplier(state, vertex) <= 0.0) continue;
      if (!d) d = change(state, now, e);
      const Return r = traction(now, *d, e, v);
      if (!r.slips) continue;
      const Eigen::VectorXd force = coefficient_ / state.release * (corner.slip.transpose() * r.trial.normalized());
      for (Eigen::Index i = 0; i < force.size(); ++i)
        if (force[i] != 0.0) derivative.emplace_back(entries[i], multipliers[v], force[i]);
    }
  }
}

void Friction::commit(State& state) const {
  FrictionHistory& now = edit(state);
  Eigen::VectorXd tractions = Eigen::VectorXd::Zero(9 * contact_.triangles());
  for (int e = 0; e < contact_.triangles() && now.frames && now.stiffness > 0.0; ++e) {
    const Change d = change(state, now, e);
    for (int v = 0; v < 3; ++v)
      if ((*now.frames)[e][v].area > 0.0) tractions.segment<3>(9 * e + 3 * v) = traction(now, d, e, v).traction;
  }
  now.traction = std::move(tractions);
  now.anchor = state.values;
  now.fresh = true;
  if (state.release == 0.0)
    for (Eigen::Index corner = 0; corner < now.held.size(); ++corner) now.held[corner] = now.traction.segment<3>(3 * corner).norm();
}

/// The tractions go on; slip counts from where the new state is.
void Friction::carry(const State& from, State& state) const {
  const auto* before = from.history.find<FrictionHistory>(name_);
  if (!before) return;
  edit(state).traction = before->traction;
  edit(state).held = before->held;
}

void Friction::restore(State& state) const {
  const auto* stored = state.history.find<StoredHistory>(name_);
  if (!stored) return;
  auto history = std::make_shared<FrictionHistory>();
  ByteReader reader(stored->bytes);
  reader(history->anchor), reader(history->traction), reader(history->held), reader(history->stiffness), reader.finish();
  if (history->anchor.size() != state.values.size() || history->traction.size() != 9 * contact_.triangles() ||
      history->held.size() != 3 * contact_.triangles())
    throw std::runtime_error("a stored state has another friction");
  history->frames = frames(state, history->held);
  state.history.put(name_, std::move(history));
}

std::vector<Friction::PointForce> Friction::point_forces(const State& state) const {
  const FrictionHistory& now = history(state);
  std::vector<PointForce> forces;
  std::vector<Contact::Meeting> points;
  for (int e = 0; e < contact_.triangles() && now.stiffness > 0.0; ++e) {
    const Change d = change(state, now, e);
    Eigen::Matrix3d t = Eigen::Matrix3d::Zero();
    for (int v = 0; v < 3; ++v)
      if ((*now.frames)[e][v].area > 0.0) t.col(v) = traction(now, d, e, v).traction;
    contact_.meetings(state, e, points);
    for (const Contact::Meeting& q : points) {
      const Eigen::Vector3d f = t * q.L;
      forces.push_back({e, q.facet, q.L, q.x, -q.weight * (f - f.dot(q.at.n) * q.at.n)});
    }
  }
  return forces;
}

std::vector<Friction::VertexTraction> Friction::vertex_tractions(const State& state) const {
  const FrictionHistory& now = history(state);
  std::vector<VertexTraction> vertices(contact_.vertices());
  std::vector<double> area(vertices.size(), 0.0), slipping(vertices.size(), 0.0);
  for (int e = 0; e < contact_.triangles() && now.stiffness > 0.0; ++e) {
    const Change d = change(state, now, e);
    for (int v = 0; v < 3; ++v) {
      const Corner& corner = (*now.frames)[e][v];
      if (corner.area <= 0.0) continue;
      const int vertex = contact_.vertices_of(e)[v];
      const Return r = traction(now, d, e, v);
      vertices[vertex].traction -= corner.area * r.traction;
      area[vertex] += corner.area;
      // a committed state stands at the bound itself
      if (r.traction.norm() >= (1.0 - 1e-6) * corner.bound) slipping[vertex] += corner.area;
    }
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (area[i] <= 0.0) continue;
    vertices[i].traction /= area[i];
    vertices[i].slip = slipping[i] > 0.5 * area[i] ? Slip::slip : Slip::stick;
  }
  return vertices;
}

void Friction::publish(const State& state, PublishedFields& fields) const {
  const std::vector<VertexTraction> vertices = vertex_tractions(state);
  const std::vector<double> areas = contact_.current_areas(state);
  const ContactSlave& slave = contact_.slave();
  std::vector<Eigen::Vector3d> traction(vertices.size(), Eigen::Vector3d::Zero());
  std::vector<double> slip(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (contact_.pressure(state, static_cast<int>(i)) != 0.0) traction[i] = slave.area[i] / areas[i] * vertices[i].traction;
    slip[i] = static_cast<double>(vertices[i].slip);
  }
  postproc::Fields& part = fields[slave.part];
  slave.spread(traction, [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) -> Eigen::Vector3d { return 0.5 * (a + b); },
               part.ensure(postproc::field::shear_traction, slave.mesh_nodes));
  slave.spread(slip, [](double a, double b) { return std::max(a, b); }, part.ensure(postproc::field::slip, slave.mesh_nodes));
}

}  // namespace snug::solver
