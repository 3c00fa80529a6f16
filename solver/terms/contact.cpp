#include "solver/terms/contact.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "solver/terms/parallel.hpp"

namespace snug::solver {

namespace {

// Parts of a garment edge for a triangle that could not be cut along the facets: a quarter of a facet.
int parts(double garment_edge, double skin_cell) {
  return std::clamp(static_cast<int>(std::ceil(4.0 * garment_edge / skin_cell - 0.25)), 1, 8);
}

// A facet counts as coupled to a triangle when a point is this near to its edge (a facet measures 2), so that the pattern
// of the matrix lasts.
constexpr double coupling_margin = 0.15;
// Iterations in which the number of vertices on the wrong side of contact need not fall.
constexpr int most_patience = 5;
// Rows are this much stiffer than the active-set decision: a decision on a stiff scale would turn gaps of second order
// in the step into releases, a row on a soft scale would converge linearly.
constexpr double row_stiffening = 1e4;

}  // namespace

struct Contact::Slot {
  Eigen::VectorXd residual;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> matrix;
};

Contact::Contact(const Layout& layout, const mesh::GarmentMesh& garment, const mesh::BodyMesh& body, bool deformable,
                 double stiffness, GapBasis basis)
    : layout_(layout), skin_(layout, body, deformable),
      order_(garment.order), fallback_parts_(parts(garment.mean_edge, body.mean_skin_cell)),
      skin_nodes_(static_cast<int>(body.nodes.size())), basis_(basis), stiffness_(stiffness),
      reach_(5.0 * body.mean_skin_cell), step_limit_(0.5 * garment.mean_edge),
      vertex_of_node_(garment.pattern.size(), -1) {
  for (const auto& triangle : garment.triangles) {
    Element element;
    for (int a = 0; a < 6; ++a) element.nodes[a] = garment.merged[triangle[a]];
    element.area = flat_triangle(garment.pattern[triangle[0]], garment.pattern[triangle[1]],
                                 garment.pattern[triangle[2]]).area;
    for (int v = 0; v < 3; ++v) {
      int& vertex = vertex_of_node_[element.nodes[v]];
      if (vertex < 0) {
        vertex = vertices();
        area_.push_back(0.0);
        share_.push_back(0.0);
      }
      element.vertices[v] = vertex;
      area_[vertex] += element.area / 3.0;
      share_[vertex] += 1.0;
    }
    elements_.push_back(element);
  }
  for (double& share : share_) share = 1.0 / share;
  weighted_gap_.assign(vertices(), 0.0);
  facing_area_.assign(vertices(), 0.0);
  active_.assign(vertices(), 0);
  rebuild_entries();
}

Eigen::Vector3d Contact::basis(const Eigen::Vector3d& L) const {
  return basis_ == GapBasis::hat ? L : Eigen::Vector3d(4.0 * L.array() - 1.0);  // 3 L_i - L_j - L_k
}

TriangleNodes Contact::positions(const State& state, const Element& element) const {
  TriangleNodes x;
  for (int a = 0; a < 6; ++a) x.col(a) = state.values.segment<3>(layout_.garment(element.nodes[a]));
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

double Contact::pressure(const State& state, const Element& element, const ContactPoint& point) const {
  const Eigen::Vector3d phi = basis(point.L);
  double p = 0.0;
  for (int v = 0; v < 3; ++v) p += phi[v] * state.values[layout_.multiplier(element.vertices[v])];
  return p;
}

void Contact::couple(Element& element) {
  const auto add = [&](int facet) {
    if (facet < 0 || std::find(element.facets.begin(), element.facets.end(), facet) != element.facets.end()) return;
    element.facets.push_back(facet);
    for (const int node : skin_.nodes_of(facet))
      if (node >= 0 && std::find(element.skin_nodes.begin(), element.skin_nodes.end(), node) == element.skin_nodes.end())
        element.skin_nodes.push_back(node);
  };
  element.facets.clear();
  element.skin_nodes.clear();
  for (const ContactPoint& point : element.points) {
    const Site& site = point.site;
    if (site.facet < 0) continue;
    add(site.facet);
    const auto& next = skin_.neighbours(site.facet);
    for (std::size_t edge = 0; edge < next.size(); ++edge)
      if (beyond(skin_.domain(), static_cast<int>(edge), site.xi) > -coupling_margin) add(next[edge]);
  }
}

void Contact::rebuild_entries() {
  entries_ = {};
  std::vector<int> entries;
  for (const Element& element : elements_) {
    entries.clear();
    for (const int node : element.nodes)
      for (int c = 0; c < 3; ++c) entries.push_back(layout_.garment(node, c));
    for (const int node : element.skin_nodes)
      for (int c = 0; c < 3; ++c) entries.push_back(layout_.body(node, c));
    for (const int vertex : element.vertices) entries.push_back(layout_.multiplier(vertex));
    entries_.push(entries);
  }
}

void Contact::renew(const State& state) {
  fewest_wrong_ = vertices() + 1, patience_ = most_patience;
  const SkinNodes nodes = skin_nodes(skin_, state, skin_nodes_);
  tbb::parallel_for(0, static_cast<int>(elements_.size()), [&](int e) {
    Element& element = elements_[e];
    const TriangleNodes x = positions(state, element);
    const Eigen::Vector3d centre = x * garment_values(order_, Eigen::Vector3d::Constant(1.0 / 3.0));
    const Site site = skin_.find(state, centre);
    element.points.clear();
    if (site.facet >= 0) element.points = cut_by_facets(skin_, nodes, x, order_, site.facet);
    if (element.points.empty()) element.points = uncut_rule(fallback_parts_, order_);
  });
}

bool Contact::locate(const State& state) {
  tbb::parallel_for(0, static_cast<int>(elements_.size()), [&](int e) {
    const TriangleNodes x = positions(state, elements_[e]);
    for (ContactPoint& point : elements_[e].points) point.site = skin_.follow(state, x * point.N, point.site);
  });
  if (!skin_.deformable()) return false;
  bool changed = false;
  for (Element& element : elements_)
    for (const auto& [L, weight, N, site] : element.points)
      if (site.facet >= 0 && std::find(element.facets.begin(), element.facets.end(), site.facet) == element.facets.end()) {
        couple(element);
        changed = true;
        break;
      }
  if (changed) rebuild_entries();
  return changed;
}

void Contact::weigh(const State& state) {
  std::fill(weighted_gap_.begin(), weighted_gap_.end(), 0.0);
  std::fill(facing_area_.begin(), facing_area_.end(), 0.0);
  for (const Element& element : elements_) {
    const TriangleNodes x = positions(state, element);
    for (const ContactPoint& point : element.points) {
      const Gap g = gap(state, x, point);
      if (!g.facing) continue;
      const Eigen::Vector3d phi = basis(point.L);
      for (int v = 0; v < 3; ++v) {
        weighted_gap_[element.vertices[v]] += point.weight * element.area * phi[v] * g.value;
        facing_area_[element.vertices[v]] += point.weight * element.area * point.L[v];
      }
    }
  }
}

bool Contact::update(const State& state) {
  if (points() == 0) renew(state);
  const bool moved = locate(state);
  weigh(state);
  change_active_set(state);
  return moved;
}

// Block principal pivoting (Judice & Pires, Computers & Operations Research 21 (1994)): all vertices on the wrong side
// change at once as long as their number falls. When it has not for some iterations the sets go in circles, which the
// hats' full coupling allows; then only the last of them changes, which ends for every positive definite problem
// (Murty, Linear Algebra and its Applications 7 (1974)), until the number has fallen.
void Contact::change_active_set(const State& state) {
  std::vector<int> wrong;
  for (int i = 0; i < vertices(); ++i) {
    const double trial = state.values[layout_.multiplier(i)] - stiffness_ * weighted_gap_[i] / area_[i];
    const char now = trial > 0.0 && facing_area_[i] > 0.05 * area_[i];
    if (now != active_[i]) wrong.push_back(i);
  }
  changed_ = static_cast<int>(wrong.size());
  if (changed_ == 0 || changed_ < fewest_wrong_) {
    fewest_wrong_ = changed_ == 0 ? vertices() + 1 : changed_;
    patience_ = most_patience;
  } else if (patience_ > 0) {
    --patience_;
  } else {
    wrong = {wrong.back()};
  }
  for (const int i : wrong) active_[i] = !active_[i];
}

// What the points of one triangle on one facet add: 6 garment nodes, 9 facet nodes (three entries each), 3 multipliers.
// Fixed size, so that a point costs no allocation and its products are vectorised.
struct Contact::Patch {
  static constexpr int skin = 18, rows = 45, size = 48;
  using Columns = Eigen::Matrix<double, size, 2>;
  Eigen::Matrix<double, size, 1> residual = Eigen::Matrix<double, size, 1>::Zero();
  Eigen::Matrix<double, size, size> matrix = Eigen::Matrix<double, size, size>::Zero();
};

void Contact::add_curvature(const ContactPoint& point, const Gap& gap, double force, bool skin_moves, Patch& patch) const {
  // Second derivative of the gap for a frozen facet (Laursen, Computational Contact and Impact Mechanics, ch. 5):
  //   d2g = -(B_a D_a + D_a B_a) - k_ab D_a D_b + g m^ab (B_a + k_ac D_c)(B_b + k_bd D_d),
  // D_a = A^ab [ (dx - dy) . y_b + g n . dy_b ], A = m - g k, B_a = n . dy_a, as linear forms of the entries.
  Patch::Columns T = Patch::Columns::Zero(), B = Patch::Columns::Zero();
  for (int a = 0; a < 6; ++a) T.middleRows<3>(3 * a) = point.N[a] * gap.at.tangent;
  for (int b = 0; b < 9 && skin_moves; ++b) {
    const int row = Patch::skin + 3 * b;
    B.middleRows<3>(row) = gap.at.n * gap.shape.dN.row(b);
    T.middleRows<3>(row) = -gap.shape.N[b] * gap.at.tangent + gap.value * B.middleRows<3>(row);
  }
  const Eigen::Matrix2d A = gap.at.metric - gap.value * gap.at.curvature;
  const Patch::Columns D = T * A.inverse(), E = B + D * gap.at.curvature;
  Eigen::Matrix<double, Patch::size, 6> left, right;
  left << -E, -D, E * (gap.value * gap.at.metric.inverse());
  right << D, B, E;
  patch.matrix.noalias() -= (force * left) * right.transpose();
}

void Contact::add_point(const State& state, const Element& element, const TriangleNodes& x, const ContactPoint& point,
                        Tangent tangent, Patch& patch) const {
  const Gap g = gap(state, x, point);
  if (!g.facing) return;
  const double weight = point.weight * element.area, p = pressure(state, element, point);
  Eigen::Matrix<double, Patch::size, 1> G = Eigen::Matrix<double, Patch::size, 1>::Zero();  // dg
  for (int a = 0; a < 6; ++a) G.segment<3>(3 * a) = point.N[a] * g.at.n;
  for (int b = 0; b < 9 && skin_.deformable(); ++b) G.segment<3>(Patch::skin + 3 * b) = -g.shape.N[b] * g.at.n;
  patch.residual -= weight * p * G;
  const Eigen::Vector3d phi = basis(point.L);
  for (int v = 0; v < 3; ++v) {
    if (!active_[element.vertices[v]]) continue;
    patch.residual[Patch::rows + v] -= weight * phi[v] * g.value;
    if (!wanted(tangent)) continue;
    patch.matrix.col(Patch::rows + v) -= weight * phi[v] * G;
    patch.matrix.row(Patch::rows + v) -= weight * phi[v] * G.transpose();
  }
  if (wanted(tangent) && p != 0.0)
    add_curvature(point, g, weight * p, skin_.deformable() && tangent == Tangent::full, patch);
}

void Contact::scatter(const Patch& patch, const Element& element, int facet, bool tangent, Slot& slot) const {
  std::array<int, Patch::size> to{};  // entry of the element, -1: none (the nodes of a rigid skin)
  const int skin_nodes = static_cast<int>(element.skin_nodes.size());
  for (int i = 0; i < Patch::skin; ++i) to[i] = i;
  for (int b = 0; b < 9; ++b) {
    const auto& nodes = element.skin_nodes;
    const auto it = facet < 0 ? nodes.end() : std::find(nodes.begin(), nodes.end(), skin_.nodes_of(facet)[b]);
    for (int c = 0; c < 3; ++c)
      to[Patch::skin + 3 * b + c] = it == nodes.end() ? -1 : 18 + 3 * static_cast<int>(it - nodes.begin()) + c;
  }
  for (int v = 0; v < 3; ++v) to[Patch::rows + v] = 18 + 3 * skin_nodes + v;
  for (int i = 0; i < Patch::size; ++i) {
    if (to[i] < 0) continue;
    slot.residual[to[i]] += patch.residual[i];
    for (int j = 0; j < Patch::size && tangent; ++j)
      if (to[j] >= 0) slot.matrix(to[i], to[j]) += patch.matrix(j, i);
  }
}

void Contact::add_points(const State& state, const Element& element, Tangent tangent, Slot& slot) const {
  const TriangleNodes x = positions(state, element);
  if (!skin_.deformable()) {  // one patch does: the facets' nodes are no entries
    Patch patch;
    for (const ContactPoint& point : element.points) add_point(state, element, x, point, tangent, patch);
    return scatter(patch, element, -1, wanted(tangent), slot);
  }
  for (const int facet : element.facets) {
    Patch patch;
    bool any = false;
    for (const ContactPoint& point : element.points)
      if (point.site.facet == facet) add_point(state, element, x, point, tangent, patch), any = true;
    if (any) scatter(patch, element, facet, wanted(tangent), slot);
  }
}

void Contact::add_rows(const State& state, const Element& element, bool tangent, Slot& slot) const {
  const int rows = static_cast<int>(slot.residual.size()) - 3;
  for (int v = 0; v < 3; ++v) {
    const int vertex = element.vertices[v];
    const double epsilon = share_[vertex] * area_[vertex] / (row_stiffening * stiffness_);
    if (!active_[vertex]) slot.residual[rows + v] -= epsilon * state.values[layout_.multiplier(vertex)];
    if (tangent) slot.matrix(rows + v, rows + v) -= epsilon;
  }
}

bool Contact::assemble(const State& state, Tangent tangent, Sink& sink) const {
  std::vector<Slot> slots(64);
  const auto compute = [&](int e, Slot& slot) {
    const Element& element = elements_[e];
    const int n = 21 + 3 * static_cast<int>(element.skin_nodes.size());
    slot.residual.setZero(n);
    if (wanted(tangent)) slot.matrix.setZero(n, n);
    add_points(state, element, tangent, slot);
    add_rows(state, element, wanted(tangent), slot);
    return slot.residual.allFinite();
  };
  return for_elements(sink, static_cast<int>(elements_.size()), slots, compute, [&](int e, Slot& slot) {
    const auto n = static_cast<std::size_t>(slot.residual.size());
    sink.add(e, {slot.residual.data(), n},
             wanted(tangent) ? std::span<const double>(slot.matrix.data(), n * n) : std::span<const double>());
  });
}

double Contact::step_bound(const State&, const Eigen::VectorXd& direction, double limit) const {
  // A point may not move farther than half a garment edge, so that it stays near the facets it was found on.
  double longest = 0.0;
  for (const Element& element : elements_)
    for (const int node : element.nodes)
      longest = std::max(longest, direction.segment<3>(layout_.garment(node)).norm());
  return longest * limit > step_limit_ ? step_limit_ / longest : limit;
}

void Contact::measure(const State& state, Measure& measure) const {
  double sum = 0.0;
  for (int i = 0; i < vertices(); ++i) {
    const double p = state.values[layout_.multiplier(i)], g = weighted_gap_[i] / area_[i];
    if (active_[i]) {
      sum += p;
      ++measure.active;
      measure.penetration = std::max(measure.penetration, std::abs(g));
      measure.complementarity = std::max(measure.complementarity, -p);
    } else {
      measure.complementarity = std::max(measure.complementarity, std::abs(p));
      if (facing_area_[i] > 0.05 * area_[i]) measure.penetration = std::max(measure.penetration, -g);
    }
  }
  measure.changed += changed_;
  if (measure.active > 0) measure.reference_pressure = std::max(measure.reference_pressure, sum / measure.active);
  for (const PointForce& force : point_forces(state)) measure.contact_force += force.force.norm();
}

}  // namespace snug::solver
