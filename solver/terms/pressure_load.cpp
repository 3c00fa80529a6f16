#include "solver/terms/pressure_load.hpp"

#include <Eigen/Dense>

#include "solver/terms/facet_kind.hpp"
#include "solver/terms/garment_shape.hpp"

namespace snug::solver {

namespace {

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

PressureLoad::PressureLoad(const Layout& layout, const mesh::BodyMesh& mesh, std::string name,
                           const std::vector<mesh::FacetNodeNumbers>& facets, double pressure)
    : name_(std::move(name)), pressure_(pressure) {
  const mesh::FacetKind kind = facet_kind(mesh.kind);
  for (const FacetRulePoint& q : facet_rule(kind)) points_.push_back({facet_shape(kind, q.xi), q.weight});
  for (const auto& facet : facets) {
    const std::array<int, 27> slots = facet_entries(layout, facet);
    entries_.push(std::span(slots).first(3 * node_count(kind)));
  }
}

PressureLoad::PressureLoad(const Layout& layout, const mesh::GarmentMesh& mesh, double pressure)
    : name_("garment"), pressure_(pressure) {
  for (const TrianglePoint& q : triangle_rule()) {
    FacetShape shape;
    shape.N.setZero(), shape.dN.setZero(), shape.ddN.setZero();
    shape.N.head<6>() = garment_values(mesh.order, q.L);
    shape.dN.topRows<6>() = garment_derivatives(mesh.order, q.L) * area_coordinate_derivatives();
    points_.push_back({shape, 0.5 * q.weight});
  }
  for (const auto& triangle : mesh.triangles) {
    std::array<int, 18> entries{};
    for (int a = 0; a < 6; ++a)
      for (int c = 0; c < 3; ++c) entries[3 * a + c] = layout.garment(mesh.merged[triangle[a]], c);
    entries_.push(entries);
  }
}

FacetNodes PressureLoad::positions(const State& state, int facet) const {
  FacetNodes x = FacetNodes::Zero();
  const auto entries = entries_.of(facet);
  for (std::size_t a = 0; 3 * a < entries.size(); ++a) x.col(a) = state.values.segment<3>(entries[3 * a]);
  return x;
}

bool PressureLoad::assemble(const State& state, Tangent tangent, Sink& sink) const {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, 27, 27>;
  for (int f = 0; f < entries_.elements(); ++f) {
    const FacetNodes x = positions(state, f);
    const int size = static_cast<int>(entries_.of(f).size()), nodes = size / 3;
    Eigen::Matrix<double, 27, 1> residual = Eigen::Matrix<double, 27, 1>::Zero();
    Matrix matrix = Matrix::Zero(size, size);
    for (const auto& [shape, weight] : points_) {
      const double p = state.load * pressure_ * weight;
      const Eigen::Matrix<double, 3, 2> t = x * shape.dN;
      const Eigen::Vector3d n = t.col(0).cross(t.col(1));
      // d n = dt1 x t2 + t1 x dt2 = sum_b (-dN_b1 [t2]x + dN_b2 [t1]x) dx_b
      const Eigen::Matrix3d t1 = cross_matrix(t.col(0)), t2 = cross_matrix(t.col(1));
      for (int a = 0; a < nodes; ++a) {
        residual.segment<3>(3 * a) += p * shape.N[a] * n;
        for (int b = 0; b < nodes && tangent == Tangent::full; ++b)
          matrix.block<3, 3>(3 * a, 3 * b) += p * shape.N[a] * (shape.dN(b, 1) * t1 - shape.dN(b, 0) * t2);
      }
    }
    const Matrix symmetric = 0.5 * (matrix + matrix.transpose());
    const auto length = static_cast<std::size_t>(size);
    sink.add(f, {residual.data(), length},
             wanted(tangent) ? std::span<const double>(symmetric.data(), length * length) : std::span<const double>());
  }
  return true;
}

void PressureLoad::measure(const State& state, Measure& measure) const {
  for (int f = 0; f < entries_.elements(); ++f) {
    const FacetNodes x = positions(state, f);
    for (const auto& [shape, weight] : points_)
      measure.contact_force += weight * std::abs(state.load * pressure_) * facet_point(x, shape).area;
  }
  measure.reference_pressure = std::max(measure.reference_pressure, std::abs(pressure_));
}

}  // namespace snug::solver
