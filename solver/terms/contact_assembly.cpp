// Forces and rows of contact, and their derivatives.
#include "solver/terms/contact.hpp"

#include <Eigen/Dense>

#include <algorithm>

#include "solver/terms/parallel.hpp"

namespace snug::solver {

namespace {

// Rows are this much stiffer than the active-set decision: a decision on a stiff scale would turn gaps of second order
// in the step into releases, a row on a soft scale would converge linearly.
constexpr double row_stiffening = 1e4;

}  // namespace

struct Contact::Slot {
  Eigen::VectorXd residual;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> matrix;
};

// What the points of one triangle on one facet add: 6 slave nodes, 9 facet nodes (three entries each), 3 multipliers.
// Fixed size, so that a point costs no allocation and its products are vectorised.
struct Contact::Patch {
  static constexpr int master = 18, rows = 45, size = 48;
  using Columns = Eigen::Matrix<double, size, 2>;
  Eigen::Matrix<double, size, 1> residual = Eigen::Matrix<double, size, 1>::Zero();
  Eigen::Matrix<double, size, size> matrix = Eigen::Matrix<double, size, size>::Zero();
};

void Contact::add_curvature(const ContactPoint& point, const Gap& gap, double force, bool master_moves, bool definite, Patch& patch) const {
  // Second derivative of the gap for a frozen facet (Laursen, Computational Contact and Impact Mechanics, ch. 5):
  //   d2g = -(B_a D_a + D_a B_a) - k_ab D_a D_b + g m^ab (B_a + k_ac D_c)(B_b + k_bd D_d),
  // `definite`: of a master that stands still it is -D_a (k - g k m^-1 k)_ab D_b, of which the positive part is kept; a sheet that nothing
  // holds slides down what bulges, and near a centre of curvature A is nearly singular, so that no shift of the diagonal would do.
  // D_a = A^ab [ (dx - dy) . y_b + g n . dy_b ], A = m - g k, B_a = n . dy_a, as linear forms of the entries.
  Patch::Columns T = Patch::Columns::Zero(), B = Patch::Columns::Zero();
  for (int a = 0; a < 6; ++a) T.middleRows<3>(3 * a) = point.N[a] * gap.at.tangent;
  for (int b = 0; b < 9 && master_moves; ++b) {
    const int row = Patch::master + 3 * b;
    B.middleRows<3>(row) = gap.at.n * gap.shape.dN.row(b);
    T.middleRows<3>(row) = -gap.shape.N[b] * gap.at.tangent + gap.value * B.middleRows<3>(row);
  }
  const Eigen::Matrix2d A = gap.at.metric - gap.value * gap.at.curvature;
  if (definite) {
    const Eigen::Matrix2d k = gap.at.curvature;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> core(force * (k - gap.value * k * gap.at.metric.inverse() * k));
    const Patch::Columns D = T * A.inverse() * core.eigenvectors();
    patch.matrix.noalias() += D * core.eigenvalues().cwiseMax(0.0).asDiagonal() * D.transpose();
    return;
  }
  const Patch::Columns D = T * A.inverse(), E = B + D * gap.at.curvature;
  Eigen::Matrix<double, Patch::size, 6> left, right;
  left << -E, -D, E * (gap.value * gap.at.metric.inverse());
  right << D, B, E;
  patch.matrix.noalias() -= (force * left) * right.transpose();
}

void Contact::add_point(const State& state, const ContactHistory& history, int triangle, const TriangleNodes& x,
                        const ContactPoint& point, Tangent tangent, Patch& patch) const {
  const Gap g = gap(state, x, point);
  if (!g.facing) return;
  const ContactSlave::Triangle& slave = interface_.slave.triangles[triangle];
  const double weight = point.weight * slave.area, p = multiplier(state, triangle, point.L);
  Eigen::Matrix<double, Patch::size, 1> G = Eigen::Matrix<double, Patch::size, 1>::Zero();  // dg
  for (int a = 0; a < 6; ++a) G.segment<3>(3 * a) = point.N[a] * g.at.n;
  const bool moves = master().moves(point.site.facet);
  for (int b = 0; b < 9 && moves; ++b) G.segment<3>(Patch::master + 3 * b) = -g.shape.N[b] * g.at.n;
  patch.residual -= weight * p * G;
  const Eigen::Vector3d phi = basis(point.L);
  for (int v = 0; v < 3; ++v) {
    if (!history.active[slave.vertices[v]]) continue;
    patch.residual[Patch::rows + v] -= weight * phi[v] * g.value;
    if (!wanted(tangent)) continue;
    patch.matrix.col(Patch::rows + v) -= weight * phi[v] * G;
    patch.matrix.row(Patch::rows + v) -= weight * phi[v] * G.transpose();
  }
  if (wanted(tangent) && p != 0.0)
    add_curvature(point, g, weight * p, moves && tangent == Tangent::full, state.yielding > 0.0 && tangent == Tangent::convex, patch);
}

void Contact::scatter(const Patch& patch, const Element& element, int facet, bool tangent, Slot& slot) const {
  std::array<int, Patch::size> to{};  // entry of the element, -1: none (the nodes of a rigid skin)
  const int master_nodes = static_cast<int>(element.master_nodes.size());
  for (int i = 0; i < Patch::master; ++i) to[i] = i;
  for (int b = 0; b < 9; ++b) {
    const auto& nodes = element.master_nodes;
    const auto it = facet < 0 ? nodes.end() : std::find(nodes.begin(), nodes.end(), master().nodes_of(facet)[b]);
    for (int c = 0; c < 3; ++c)
      to[Patch::master + 3 * b + c] = it == nodes.end() ? -1 : 18 + 3 * static_cast<int>(it - nodes.begin()) + c;
  }
  for (int v = 0; v < 3; ++v) to[Patch::rows + v] = 18 + 3 * master_nodes + v;
  for (int i = 0; i < Patch::size; ++i) {
    if (to[i] < 0) continue;
    slot.residual[to[i]] += patch.residual[i];
    for (int j = 0; j < Patch::size && tangent; ++j)
      if (to[j] >= 0) slot.matrix(to[i], to[j]) += patch.matrix(j, i);
  }
}

void Contact::add_points(const State& state, const ContactHistory& history, int triangle, Tangent tangent, Slot& slot) const {
  const TriangleNodes x = positions(state, triangle);
  const Element& element = history.elements[triangle];
  if (!master().deformable()) {  // one patch does: the facets' nodes are no entries
    Patch patch;
    for (const ContactPoint& point : element.points) add_point(state, history, triangle, x, point, tangent, patch);
    return scatter(patch, element, -1, wanted(tangent), slot);
  }
  for (const int facet : element.facets) {
    Patch patch;
    bool any = false;
    for (const ContactPoint& point : element.points)
      if (point.site.facet == facet) add_point(state, history, triangle, x, point, tangent, patch), any = true;
    if (any) scatter(patch, element, facet, wanted(tangent), slot);
  }
}

void Contact::add_rows(const State& state, const ContactHistory& history, int triangle, bool tangent, Slot& slot) const {
  const int rows = static_cast<int>(slot.residual.size()) - 3;
  const bool yields = state.yielding > 0.0;
  for (int v = 0; v < 3; ++v) {
    const int vertex = interface_.slave.triangles[triangle].vertices[v];
    const double epsilon = share_[vertex] * interface_.slave.area[vertex] / stiffness_ * (yields ? state.yielding : 1.0 / row_stiffening);
    if (!history.active[vertex]) slot.residual[rows + v] -= epsilon * multiplier(state, vertex);
    else if (yields) slot.residual[rows + v] -= epsilon * (multiplier(state, vertex) - history.reference[vertex]);
    if (tangent) slot.matrix(rows + v, rows + v) -= epsilon;
  }
}

bool Contact::assemble(const State& state, Tangent tangent, Sink& sink) const {
  const ContactHistory& now = history(state);
  std::vector<Slot> slots(64);
  const auto compute = [&](int e, Slot& slot) {
    const int n = 21 + 3 * static_cast<int>(now.elements[e].master_nodes.size());
    slot.residual.setZero(n);
    if (wanted(tangent)) slot.matrix.setZero(n, n);
    add_points(state, now, e, tangent, slot);
    add_rows(state, now, e, wanted(tangent), slot);
    return slot.residual.allFinite();
  };
  return for_elements(sink, triangles(), slots, compute, [&](int e, Slot& slot) {
    const auto n = static_cast<std::size_t>(slot.residual.size());
    sink.add(e, {slot.residual.data(), n},
             wanted(tangent) ? std::span<const double>(slot.matrix.data(), n * n) : std::span<const double>());
  });
}

}  // namespace snug::solver
