#include "solver/terms/skin_membrane_term.hpp"

#include <Eigen/Dense>

#include "solver/terms/parallel.hpp"

namespace snug::solver {

SkinMembraneTerm::SkinMembraneTerm(const Field& positions, const mesh::BodyMesh& mesh, const materials::SkinMembrane& law)
    : positions_(positions), law_(law) {
  const mesh::FacetKind kind = facet_kind(mesh.kind);
  for (const auto& nodes : mesh.skin_facets) {
    Element element{nodes, {}};
    const FacetNodes rest = facet_positions(mesh, nodes);
    for (const FacetRulePoint& q : facet_rule(kind)) {
      const FacetPoint p = facet_point(rest, q.shape);
      // Orthonormal frame e1 along the first tangent; grad N along e_i = dN (t . e)^-1.
      Eigen::Matrix<double, 3, 2> e;
      e.col(0) = p.tangent.col(0).normalized();
      e.col(1) = p.n.cross(e.col(0));
      const Eigen::Matrix2d T = e.transpose() * p.tangent;
      element.points.push_back({(q.shape.dN * T.inverse()).transpose(), q.weight * p.area});
    }
    entries_.push(facet_entries(positions, nodes));
    elements_.push_back(element);
  }
}

NodeVectors<9> SkinMembraneTerm::places(const State& state, const Element& element) const {
  return facet_positions(state, positions_, element.nodes);
}

materials::MembraneResponse SkinMembraneTerm::response(const NodeVectors<9>& x, const Point& point) const {
  const Eigen::Vector3d E = membrane_strain<9>(x, point.d);
  return law_.at({1.0 + 2.0 * E[0], 1.0 + 2.0 * E[1], E[2]});
}

double SkinMembraneTerm::energy(const State& state) const {
  double sum = 0.0;
  for (const Element& element : elements_) {
    const NodeVectors<9> x = places(state, element);
    for (const Point& point : element.points) sum += state.stiffening * point.weight * response(x, point).energy;
  }
  return sum;
}

bool SkinMembraneTerm::assemble(const State& state, Tangent tangent, Sink& sink) const {
  std::vector<MembraneElement<9>> slots(128);
  const auto compute = [&](int e, MembraneElement<9>& slot) {
    const NodeVectors<9> x = places(state, elements_[e]);
    slot.zero();
    for (const Point& point : elements_[e].points)
      add_membrane_point<9>(x, point.d, state.stiffening * point.weight, response(x, point), wanted(tangent), slot);
    return slot.residual.allFinite();
  };
  return for_elements(sink, static_cast<int>(elements_.size()), slots, compute, [&](int e, MembraneElement<9>& slot) {
    sink.add(e, {slot.residual.data(), 27},
             wanted(tangent) ? std::span<const double>(slot.matrix.data(), 27 * 27) : std::span<const double>());
  });
}

}  // namespace snug::solver
