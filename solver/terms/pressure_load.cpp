#include "solver/terms/pressure_load.hpp"

#include <Eigen/Dense>

#include "solver/terms/facet_kind.hpp"

namespace snug::solver {

namespace {

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

PressureLoad::PressureLoad(const Layout& layout, const mesh::BodyMesh& mesh, std::string name,
                           std::vector<mesh::FacetNodeNumbers> facets, double pressure)
    : layout_(layout),
      name_(std::move(name)),
      kind_(facet_kind(mesh.kind)),
      facets_(std::move(facets)),
      pressure_(pressure) {
  for (const auto& facet : facets_) entries_.push(facet_entries(layout, facet));
}

bool PressureLoad::assemble(const State& state, Tangent tangent, Sink& sink) const {
  Eigen::Matrix<double, 27, 1> residual;
  Eigen::Matrix<double, 27, 27, Eigen::RowMajor> matrix;
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const FacetNodes x = facet_positions(state, layout_, facets_[f]);
    residual.setZero(), matrix.setZero();
    for (const FacetRulePoint& q : facet_rule(kind_)) {
      const FacetShape shape = facet_shape(kind_, q.xi);
      const double p = state.load * pressure_ * q.weight;
      const Eigen::Matrix<double, 3, 2> t = x * shape.dN;
      const Eigen::Vector3d n = t.col(0).cross(t.col(1));
      // d n = dt1 x t2 + t1 x dt2 = sum_b (-dN_b1 [t2]x + dN_b2 [t1]x) dx_b
      const Eigen::Matrix3d t1 = cross_matrix(t.col(0)), t2 = cross_matrix(t.col(1));
      for (int a = 0; a < 9; ++a) {
        residual.segment<3>(3 * a) += p * shape.N[a] * n;
        for (int b = 0; b < 9 && wanted(tangent); ++b)
          matrix.block<3, 3>(3 * a, 3 * b) += p * shape.N[a] * (shape.dN(b, 1) * t1 - shape.dN(b, 0) * t2);
      }
    }
    const Eigen::Matrix<double, 27, 27, Eigen::RowMajor> symmetric = 0.5 * (matrix + matrix.transpose());
    sink.add(static_cast<int>(f), {residual.data(), 27},
             wanted(tangent) ? std::span<const double>(symmetric.data(), 27 * 27) : std::span<const double>());
  }
  return true;
}

void PressureLoad::measure(const State& state, Measure& measure) const {
  for (const auto& nodes : facets_) {
    const FacetNodes x = facet_positions(state, layout_, nodes);
    for (const FacetRulePoint& q : facet_rule(kind_))
      measure.contact_force += q.weight * std::abs(state.load * pressure_) * facet_point(x, facet_shape(kind_, q.xi)).area;
  }
  measure.reference_pressure = std::max(measure.reference_pressure, std::abs(pressure_));
}

}  // namespace snug::solver
