#include "solver/terms/drag.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace snug::solver {

Drag::Drag(const Eigen::VectorXd& weights) {
  for (Eigen::Index entry = 0; entry < weights.size(); ++entry) {
    if (weights[entry] == 0.0) continue;
    weights_.push_back(weights[entry]);
    entries_.push(std::array{static_cast<int>(entry)});
  }
}

void Drag::hold_back(State& state, double drag) {
  DragHistory& history = state.history.edit<DragHistory>(own_name);
  history.drag = drag;
  history.from = drag > 0.0 ? state.values : Eigen::VectorXd();
}

// Positions stand before all other fields (Layout), three entries a node; a direction that is bound to others, on a tilted cut, has no weight.
double Drag::way(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const {
  double largest = 0.0, of_node = 0.0;
  int node = -1;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    const int entry = entries_.of(static_cast<int>(i))[0];
    if (entry / 3 != node) node = entry / 3, of_node = 0.0;
    of_node += std::pow(to[entry] - from[entry], 2);
    largest = std::max(largest, of_node);
  }
  return std::sqrt(largest);
}

// No state that is stored is held back.
void Drag::restore(State& state) const {
  if (state.history.has(own_name)) hold_back(state, 0.0);
}

double Drag::energy(const State& state) const {
  const auto* held = state.history.find<DragHistory>(own_name);
  double sum = 0.0;
  for (std::size_t i = 0; i < weights_.size() && held && held->drag > 0.0; ++i) {
    const int entry = entries_.of(static_cast<int>(i))[0];
    const double gone = state.values[entry] - held->from[entry];
    sum += 0.5 * held->drag * weights_[i] * gone * gone;
  }
  return sum;
}

bool Drag::assemble(const State& state, Tangent tangent, Sink& sink) const {
  const auto* held = state.history.find<DragHistory>(own_name);
  for (std::size_t i = 0; i < weights_.size() && held && held->drag > 0.0; ++i) {
    const int entry = entries_.of(static_cast<int>(i))[0];
    const double stiffness = held->drag * weights_[i], force = stiffness * (state.values[entry] - held->from[entry]);
    sink.add(static_cast<int>(i), {&force, 1}, {&stiffness, wanted(tangent) ? 1u : 0u});
  }
  return true;
}

}  // namespace snug::solver
