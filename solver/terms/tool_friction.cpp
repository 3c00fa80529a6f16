#include "solver/terms/tool_friction.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <utility>

#include "solver/terms/coulomb.hpp"
#include "solver/terms/parallel.hpp"

namespace snug::solver {

namespace {

constexpr int corners = 4;

}  // namespace

ToolFriction::ToolFriction(std::string name, const ToolContact& contact, double coefficient, double elastic_slip)
    : name_(std::move(name)), contact_(contact), coefficient_(coefficient), elastic_slip_(elastic_slip) {}

double ToolFriction::slip_stiffness(const State& state) const {
  double force = 0.0, area = 0.0;
  for (int i = 0; i < contact_.vertices(); ++i)
    if (const double p = contact_.pressure(state, i); p > 0.0) force += p * contact_.rest_area(i), area += contact_.rest_area(i);
  return area > 0.0 ? coefficient_ * force / area / elastic_slip_ : 0.0;
}

/// The state's own history, which begins without traction where the state is.
ToolFrictionHistory& ToolFriction::edit(State& state) const {
  auto& history = state.history.edit<ToolFrictionHistory>(name_);
  if (history.anchor.size() > 0) return history;
  history.anchor = state.values;
  history.traction = Eigen::VectorXd::Zero(3 * corners * contact_.facets());
  return history;
}

void ToolFriction::renew(State& state) const { edit(state).stiffness = slip_stiffness(state); }

std::shared_ptr<std::vector<ToolFrictionHistory::Element>> ToolFriction::frames(const State& state) const {
  auto frames = std::make_shared<std::vector<ToolFrictionHistory::Element>>(contact_.facets());
  tbb::parallel_for(0, contact_.facets(), [&](int f) {
    ToolFrictionHistory::Element& element = (*frames)[f];
    bool any = false;
    for (int v = 0; v < contact_.corners(); ++v) {
      element[v].bound = coefficient_ * std::max(0.0, contact_.pressure(state, contact_.vertices_of(f)[v]));
      element[v].slip.setZero();
      any = any || element[v].bound > 0.0;
    }
    if (!any) return;
    contact_.for_points(state, f, [&](const ToolContact::Meeting& q) {
      const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - q.normal * q.normal.transpose();
      for (int v = 0; v < contact_.corners(); ++v) {
        Corner& corner = element[v];
        if (corner.bound == 0.0) continue;
        const double weight = q.weight * q.hat[v];
        corner.area += weight;
        corner.normal += weight * q.normal;
        for (int a = 0; a < 10; ++a) corner.slip.middleCols<3>(3 * a) += weight * q.part[a] * P;
      }
    });
    for (Corner& corner : element) {  // in the corner's own plane, so that the tractions stay as they are when history takes them over
      if (corner.area <= 0.0) continue;
      corner.normal.normalize();
      corner.slip -= corner.normal * (corner.normal.transpose() * corner.slip).eval();
    }
  });
  return frames;
}

void ToolFriction::update(State& state) const {
  ToolFrictionHistory& history = edit(state);
  if (history.stiffness == 0.0) history.stiffness = slip_stiffness(state);
  const auto before = std::exchange(history.fresh, false) ? nullptr : history.frames;
  const auto now = frames(state);
  history.frames = now;
  if (history.stiffness > 0.0) follow_slip(state, history, before.get(), *now);
}

void ToolFriction::follow_slip(const State& state, const ToolFrictionHistory& history, const std::vector<ToolFrictionHistory::Element>* before,
                               std::vector<ToolFrictionHistory::Element>& now) const {
  tbb::parallel_for(0, contact_.facets(), [&](int f) {
    const Change d = change(state, history, f);
    for (int v = 0; v < corners; ++v) {
      Corner& corner = now[f][v];
      if (corner.area <= 0.0) continue;
      const Return r = traction(history, d, f, v);
      if (r.slips) remember_slip(r.traction, before ? &(*before)[f][v] : nullptr, corner);
    }
  });
}

ToolFriction::Change ToolFriction::change(const State& state, const ToolFrictionHistory& history, int facet) const {
  const auto entries = contact_.entries(state).of(facet);
  Change change;
  for (int i = 0; i < 30; ++i) change[i] = state.values[entries[i]] - history.anchor[entries[i]];
  return change;
}

ToolFriction::Return ToolFriction::traction(const ToolFrictionHistory& history, const Change& change, int facet, int v) {
  const Corner& corner = (*history.frames)[facet][v];
  Return r;
  r.trial = transported(history.traction.segment<3>(3 * (corners * facet + v)), corner.normal) + history.stiffness / corner.area * (corner.slip * change);
  const Bounded held = bounded(r.trial, corner.bound);
  r.traction = held.traction, r.slips = held.slips;
  return r;
}

double ToolFriction::energy(const State& state) const {
  const ToolFrictionHistory& now = history(state);
  double sum = 0.0;
  for (int f = 0; f < contact_.facets() && now.stiffness > 0.0; ++f) {
    const Change d = change(state, now, f);
    for (int v = 0; v < corners; ++v) {
      const Corner& corner = (*now.frames)[f][v];
      if (corner.area <= 0.0) continue;
      sum += energy_of_slip(traction(now, d, f, v).trial.norm(), corner.bound, corner.area, now.stiffness);
    }
  }
  return sum;
}

bool ToolFriction::assemble(const State& state, Tangent tangent, Sink& sink) const {
  constexpr int size = ToolContact::size;
  struct Slot {
    Eigen::Matrix<double, size, 1> residual;
    Eigen::Matrix<double, size, size, Eigen::RowMajor> matrix;
  };
  const ToolFrictionHistory& now = history(state);
  if (now.stiffness == 0.0) return true;
  std::vector<Slot> slots(64);
  const auto compute = [&](int f, Slot& slot) {
    const Change d = change(state, now, f);
    slot.residual.setZero(), slot.matrix.setZero();
    for (int v = 0; v < corners; ++v) {
      const Corner& corner = (*now.frames)[f][v];
      if (corner.area <= 0.0) continue;
      const Return r = traction(now, d, f, v);
      slot.residual.head<30>() += corner.slip.transpose() * r.traction;
      if (!wanted(tangent)) continue;
      const Eigen::Matrix3d H = slope_of_return(r.trial, corner.bound, r.slips, corner.turned);
      slot.matrix.topLeftCorner<30, 30>().noalias() += corner.slip.transpose() * (now.stiffness / corner.area * H * corner.slip);
    }
    return slot.residual.allFinite();
  };
  return for_elements(sink, contact_.facets(), slots, compute, [&](int f, Slot& slot) {
    sink.add(f, {slot.residual.data(), size},
             wanted(tangent) ? std::span<const double>(slot.matrix.data(), size * size) : std::span<const double>());
  });
}

void ToolFriction::commit(State& state) const {
  ToolFrictionHistory& now = edit(state);
  Eigen::VectorXd tractions = Eigen::VectorXd::Zero(now.traction.size());
  for (int f = 0; f < contact_.facets() && now.frames && now.stiffness > 0.0; ++f) {
    const Change d = change(state, now, f);
    for (int v = 0; v < corners; ++v)
      if ((*now.frames)[f][v].area > 0.0) tractions.segment<3>(3 * (corners * f + v)) = traction(now, d, f, v).traction;
  }
  now.traction = std::move(tractions);
  now.anchor = state.values;
  now.fresh = true;
}

void ToolFriction::restore(State& state) const {
  const auto* stored = state.history.find<StoredHistory>(name_);
  if (!stored) return;
  auto history = std::make_shared<ToolFrictionHistory>();
  ByteReader reader(stored->bytes);
  reader(history->anchor), reader(history->traction), reader(history->stiffness), reader.finish();
  if (history->anchor.size() != state.values.size() || history->traction.size() != 3 * corners * contact_.facets())
    throw std::runtime_error("a stored state has another friction");
  history->frames = frames(state);
  state.history.put(name_, std::move(history));
}

ToolContact::Sums ToolFriction::sums(const State& state) const {
  const ToolFrictionHistory& now = history(state);
  ToolContact::Sums sums;
  for (int f = 0; f < contact_.facets() && now.stiffness > 0.0; ++f) {
    const Change d = change(state, now, f);
    Eigen::Matrix<double, 3, corners> t = Eigen::Matrix<double, 3, corners>::Zero();
    for (int v = 0; v < corners; ++v)
      if ((*now.frames)[f][v].area > 0.0) t.col(v) = traction(now, d, f, v).traction;
    if (t.isZero(0.0)) continue;
    contact_.for_points(state, f, [&](const ToolContact::Meeting& q) {
      Eigen::Vector3d force = q.weight * (t * q.hat);
      force -= force.dot(q.normal) * q.normal;
      sums.force += force, sums.moment += q.from_tip.cross(force), sums.pressing += force.norm();
    });
  }
  return sums;
}

}  // namespace snug::solver
