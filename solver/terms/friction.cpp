#include "solver/terms/friction.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/terms/parallel.hpp"

namespace snug::solver {

namespace {

// Column of a node of the facet among the entries of the triangle.
int column_of(const std::vector<int>& skin_nodes, int node) {
  const auto it = std::find(skin_nodes.begin(), skin_nodes.end(), node);
  return 18 + 3 * static_cast<int>(it - skin_nodes.begin());
}

// Turned into the plane normal to n with its length kept: the traction of a point that has moved on along the skin.
Eigen::Vector3d transported(const Eigen::Vector3d& t, const Eigen::Vector3d& n) {
  const Eigen::Vector3d flat = t - t.dot(n) * n;
  const double length = flat.norm();
  return length > 0.0 ? Eigen::Vector3d(t.norm() / length * flat) : Eigen::Vector3d::Zero();
}

}  // namespace

struct Friction::Slot {
  Eigen::VectorXd residual;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> matrix;
};

Friction::Friction(const Layout& layout, const Contact& contact, double coefficient, double elastic_slip, double sticking)
    : layout_(layout), contact_(contact), coefficient_(coefficient), elastic_slip_(elastic_slip), sticking_(sticking),
      elements_(contact.triangles()) {}

double Friction::vertex_pressure(const State& state, int vertex) const {
  return std::max(0.0, state.values[layout_.multiplier(vertex)]);
}

void Friction::set_stiffness(const State& state) {
  if (state.release == 0.0) {
    stiffness_ = sticking_;
    return;
  }
  double force = 0.0, area = 0.0;
  for (int i = 0; i < contact_.vertices(); ++i)
    if (const double p = vertex_pressure(state, i); p > 0.0) force += p * contact_.rest_area(i), area += contact_.rest_area(i);
  stiffness_ = area > 0.0 ? coefficient_ * force / area / elastic_slip_ : 0.0;
}

void Friction::renew(const State& state) { set_stiffness(state); }

void Friction::place(const State& state, int triangle) {
  Element& element = elements_[triangle];
  std::vector<Contact::Meeting> points;
  contact_.meetings(state, triangle, points);
  const auto& vertices = contact_.vertices_of(triangle);
  const auto& skin_nodes = contact_.skin_nodes_of(triangle);
  const int columns = 18 + 3 * static_cast<int>(skin_nodes.size());
  for (int v = 0; v < 3; ++v) {
    Corner& corner = element[v];
    corner = {};
    if (state.release == 0.0)
      corner.bound = std::numeric_limits<double>::infinity();
    else if (contact_.active()[vertices[v]])
      corner.bound = coefficient_ * vertex_pressure(state, vertices[v]) / state.release;
    if (corner.bound > 0.0) corner.slip.setZero(3, columns);
  }
  for (const Contact::Meeting& q : points) {
    const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - q.at.n * q.at.n.transpose();
    const Eigen::Matrix<double, 3, 9> c = q.at.tangent * q.at.metric.inverse() * q.shape.dN.transpose();
    for (int v = 0; v < 3; ++v) {
      Corner& corner = element[v];
      if (corner.bound == 0.0) continue;
      const double weight = q.weight * q.L[v];
      corner.area += weight;
      corner.normal += weight * q.at.n;
      for (int a = 0; a < 6; ++a) corner.slip.middleCols<3>(3 * a) += weight * q.N[a] * P;
      for (int b = 0; b < 9 && contact_.skin().deformable(); ++b)
        if (const int node = contact_.skin().nodes_of(q.facet)[b]; node >= 0)
          corner.slip.middleCols<3>(column_of(skin_nodes, node)) +=
              weight * (q.gap * c.col(b) * q.at.n.transpose() - q.shape.N[b] * P);
    }
  }
  for (Corner& corner : element) {  // in the corner's own plane, so that the tractions stay as they are when history takes them over
    corner.normal.normalize();
    if (corner.bound > 0.0) corner.slip -= corner.normal * (corner.normal.transpose() * corner.slip).eval();
  }
}

bool Friction::update(const State& state) {
  if (stiffness_ == 0.0) set_stiffness(state);
  tbb::parallel_for(0, contact_.triangles(), [&](int triangle) { place(state, triangle); });
  return false;
}

Eigen::VectorXd Friction::change(const State& state, int triangle) const {
  const auto entries = contact_.entries().of(triangle);
  Eigen::VectorXd change(entries.size() - 3);
  for (Eigen::Index i = 0; i < change.size(); ++i) change[i] = state.values[entries[i]] - state.reference[entries[i]];
  return change;
}

Friction::Return Friction::traction(const State& state, const Eigen::VectorXd& change, int triangle, int v) const {
  const Corner& corner = elements_[triangle][v];
  Return r;
  r.trial = transported(state.traction.segment<3>(9 * triangle + 3 * v), corner.normal) +
            stiffness_ / corner.area * (corner.slip * change);
  const double length = r.trial.norm();
  r.slips = length > corner.bound;
  r.traction = r.slips ? Eigen::Vector3d(corner.bound / length * r.trial) : r.trial;
  return r;
}

double Friction::energy(const State& state) const {
  double sum = 0.0;
  for (int e = 0; e < contact_.triangles() && stiffness_ > 0.0; ++e) {
    const Eigen::VectorXd d = change(state, e);
    for (int v = 0; v < 3; ++v) {
      const Corner& corner = elements_[e][v];
      if (corner.area <= 0.0) continue;
      const double trial = traction(state, d, e, v).trial.norm(), held = std::min(trial, corner.bound);
      sum += corner.area * held * (trial - 0.5 * held) / stiffness_;
    }
  }
  return sum;
}

bool Friction::assemble(const State& state, Tangent tangent, Sink& sink) const {
  if (stiffness_ == 0.0) return true;
  std::vector<Slot> slots(64);
  const auto compute = [&](int e, Slot& slot) {
    const Eigen::VectorXd d = change(state, e);
    const Eigen::Index columns = d.size(), n = columns + 3;
    slot.residual.setZero(n);
    if (wanted(tangent)) slot.matrix.setZero(n, n);
    for (int v = 0; v < 3; ++v) {
      const Corner& corner = elements_[e][v];
      if (corner.area <= 0.0) continue;
      const Return r = traction(state, d, e, v);
      slot.residual.head(columns) += corner.slip.transpose() * r.traction;
      if (!wanted(tangent)) continue;
      Eigen::Matrix3d H = Eigen::Matrix3d::Identity();
      if (r.slips) {
        const Eigen::Vector3d m = r.trial.normalized();
        H = corner.bound / r.trial.norm() * (H - m * m.transpose());
      }
      slot.matrix.topLeftCorner(columns, columns).noalias() +=
          corner.slip.transpose() * (stiffness_ / corner.area * H * corner.slip);
    }
    return slot.residual.allFinite();
  };
  return for_elements(sink, contact_.triangles(), slots, compute, [&](int e, Slot& slot) {
    const auto n = static_cast<std::size_t>(slot.residual.size());
    sink.add(e, {slot.residual.data(), n},
             wanted(tangent) ? std::span<const double>(slot.matrix.data(), n * n) : std::span<const double>());
  });
}

void Friction::commit(State& state) const {
  Eigen::VectorXd tractions = Eigen::VectorXd::Zero(9 * contact_.triangles());
  for (int e = 0; e < contact_.triangles() && state.reference.size() > 0 && stiffness_ > 0.0; ++e) {
    const Eigen::VectorXd d = change(state, e);
    for (int v = 0; v < 3; ++v)
      if (elements_[e][v].area > 0.0) tractions.segment<3>(9 * e + 3 * v) = traction(state, d, e, v).traction;
  }
  state.traction = std::move(tractions);
  state.reference = state.values;
}

std::vector<Friction::PointForce> Friction::point_forces(const State& state) const {
  std::vector<PointForce> forces;
  std::vector<Contact::Meeting> points;
  for (int e = 0; e < contact_.triangles() && stiffness_ > 0.0; ++e) {
    const Eigen::VectorXd d = change(state, e);
    Eigen::Matrix3d t = Eigen::Matrix3d::Zero();
    for (int v = 0; v < 3; ++v)
      if (elements_[e][v].area > 0.0) t.col(v) = traction(state, d, e, v).traction;
    contact_.meetings(state, e, points);
    for (const Contact::Meeting& q : points) {
      const Eigen::Vector3d f = t * q.L;
      forces.push_back({e, q.L, q.x, -q.weight * (f - f.dot(q.at.n) * q.at.n)});
    }
  }
  return forces;
}

std::vector<Friction::VertexTraction> Friction::vertex_tractions(const State& state) const {
  std::vector<VertexTraction> vertices(contact_.vertices());
  std::vector<double> area(vertices.size(), 0.0), slipping(vertices.size(), 0.0);
  for (int e = 0; e < contact_.triangles() && stiffness_ > 0.0; ++e) {
    const Eigen::VectorXd d = change(state, e);
    for (int v = 0; v < 3; ++v) {
      const Corner& corner = elements_[e][v];
      if (corner.area <= 0.0) continue;
      const int vertex = contact_.vertices_of(e)[v];
      const Return r = traction(state, d, e, v);
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

}  // namespace snug::solver
