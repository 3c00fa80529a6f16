#include "solver/terms/skin_membrane_term.hpp"

#include <Eigen/Dense>

#include <cmath>

#include "solver/terms/facet.hpp"
#include "solver/terms/parallel.hpp"

namespace snug::solver {

const std::array<FacetRulePoint, 9>& facet_rule() {
  static const std::array<FacetRulePoint, 9> rule = [] {
    const double g = std::sqrt(0.6), at[3] = {-g, 0.0, g}, weight[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    std::array<FacetRulePoint, 9> points;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) points[3 * j + i] = {{at[i], at[j]}, weight[i] * weight[j]};
    return points;
  }();
  return rule;
}

SkinMembraneTerm::SkinMembraneTerm(const Layout& layout, const mesh::BodyMesh& mesh, const materials::SkinMembrane& law)
    : layout_(layout), law_(law) {
  for (const auto& nodes : mesh.skin_facets) {
    Element element{nodes, {}};
    FacetNodes rest;
    std::array<int, 27> entries{};
    for (int a = 0; a < 9; ++a) {
      rest.col(a) = mesh.nodes[nodes[a]];
      for (int c = 0; c < 3; ++c) entries[3 * a + c] = layout.body(nodes[a], c);
    }
    for (int q = 0; q < 9; ++q) {
      const FacetShape shape = facet_shape(facet_rule()[q].xi);
      const FacetPoint p = facet_point(rest, shape);
      // Orthonormal frame e1 along the first tangent; grad N along e_i = dN (t . e)^-1.
      Eigen::Matrix<double, 3, 2> e;
      e.col(0) = p.tangent.col(0).normalized();
      e.col(1) = p.n.cross(e.col(0));
      const Eigen::Matrix2d T = e.transpose() * p.tangent;
      element.points[q].d = (shape.dN * T.inverse()).transpose();
      element.points[q].weight = facet_rule()[q].weight * p.area;
    }
    entries_.push(entries);
    elements_.push_back(element);
  }
}

NodeVectors<9> SkinMembraneTerm::positions(const State& state, const Element& element) const {
  NodeVectors<9> x;
  for (int a = 0; a < 9; ++a) x.col(a) = state.values.segment<3>(layout_.body(element.nodes[a]));
  return x;
}

materials::MembraneResponse SkinMembraneTerm::response(const NodeVectors<9>& x, const Point& point) const {
  const Eigen::Vector3d E = membrane_strain<9>(x, point.d);
  return law_.at({1.0 + 2.0 * E[0], 1.0 + 2.0 * E[1], E[2]});
}

double SkinMembraneTerm::energy(const State& state) const {
  double sum = 0.0;
  for (const Element& element : elements_) {
    const NodeVectors<9> x = positions(state, element);
    for (const Point& point : element.points) sum += state.stiffening * point.weight * response(x, point).energy;
  }
  return sum;
}

bool SkinMembraneTerm::assemble(const State& state, Tangent tangent, Sink& sink) const {
  std::vector<MembraneElement<9>> slots(128);
  const auto compute = [&](int e, MembraneElement<9>& slot) {
    const NodeVectors<9> x = positions(state, elements_[e]);
    slot.zero();
    for (const Point& point : elements_[e].points)
      add_membrane_point<9>(x, point.d, state.stiffening * point.weight, response(x, point), wanted(tangent), slot);
    return slot.residual.allFinite();
  };
  return for_elements(static_cast<int>(elements_.size()), slots, compute, [&](int e, MembraneElement<9>& slot) {
    sink.add(e, {slot.residual.data(), 27},
             wanted(tangent) ? std::span<const double>(slot.matrix.data(), 27 * 27) : std::span<const double>());
  });
}

}  // namespace snug::solver
