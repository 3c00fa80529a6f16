#include "solver/terms/drag.hpp"

#include <array>

#include "solver/terms/garment_shape.hpp"

namespace snug::solver {

Drag::Drag(const std::string& garment, const Field& positions, const mesh::GarmentMesh& mesh, double stiffness)
    : name_("drag of " + garment), field_(positions) {
  for (const auto& triangle : mesh.triangles) {
    std::array<int, 18> entries{};
    for (int a = 0; a < 6; ++a)
      for (int c = 0; c < 3; ++c) entries[3 * a + c] = positions(mesh.merged[triangle[a]], c);
    entries_.push(entries);
    const double area = flat_triangle(mesh.pattern[triangle[0]], mesh.pattern[triangle[1]], mesh.pattern[triangle[2]]).area;
    weights_.push_back(stiffness / (mesh.mean_edge * mesh.mean_edge) * area / 6.0);
  }
}

void Drag::renew(State& state) const {
  if (!state.history.has(name_)) commit(state);
}

void Drag::commit(State& state) const {
  state.history.edit<DragHistory>(name_).anchor = state.values.segment(field_.first, field_.size());
}

void Drag::restore(State& state) const {
  const auto* stored = state.history.find<StoredHistory>(name_);
  if (!stored) return;
  auto history = std::make_shared<DragHistory>();
  ByteReader reader(stored->bytes);
  reader(history->anchor), reader.finish();
  if (history->anchor.size() != field_.size()) throw std::runtime_error("a stored state has another garment");
  state.history.put(name_, std::move(history));
}

Eigen::Matrix<double, 18, 1> Drag::moved(const State& state, std::size_t triangle) const {
  const Eigen::VectorXd& anchor = state.history.get<DragHistory>(name_).anchor;
  const auto entries = entries_.of(static_cast<int>(triangle));
  Eigen::Matrix<double, 18, 1> moved;
  for (int i = 0; i < 18; ++i) moved[i] = state.values[entries[i]] - anchor[entries[i] - field_.first];
  return moved;
}

double Drag::energy(const State& state) const {
  double sum = 0.0;
  for (std::size_t t = 0; t < weights_.size() && state.drag > 0.0; ++t) sum += 0.5 * weight(state, t) * moved(state, t).squaredNorm();
  return sum;
}

bool Drag::assemble(const State& state, Tangent tangent, Sink& sink) const {
  if (state.drag == 0.0) return true;
  for (std::size_t t = 0; t < weights_.size(); ++t) {
    const int element = static_cast<int>(t);
    if (!sink.wants(element)) continue;
    const Eigen::Matrix<double, 18, 1> residual = weight(state, t) * moved(state, t);
    const Eigen::Matrix<double, 18, 18> matrix = weight(state, t) * Eigen::Matrix<double, 18, 18>::Identity();
    sink.add(element, {residual.data(), 18}, wanted(tangent) ? std::span<const double>(matrix.data(), 324) : std::span<const double>());
  }
  return true;
}

}  // namespace snug::solver
