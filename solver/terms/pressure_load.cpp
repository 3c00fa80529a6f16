#include "solver/terms/pressure_load.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

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

PressureLoad::PressureLoad(const Field& body, const mesh::BodyMesh& mesh, std::string name,
                           const std::vector<mesh::FacetNodeNumbers>& facets, double pressure)
    : name_(std::move(name)), pressure_(pressure) {
  const mesh::FacetKind kind = facet_kind(mesh.kind);
  for (const FacetRulePoint& q : facet_rule(kind)) points_.push_back({q.shape, q.weight});
  for (const auto& facet : facets) {
    const std::array<int, 27> slots = facet_entries(body, facet);
    entries_.push(std::span(slots).first(3 * node_count(kind)));
  }
  const std::vector<int>& outline = facet_domain(kind).outline;
  const int nodes_an_edge = static_cast<int>(outline.size() / facet_domain(kind).edge_corners.size());
  find_border(outline, nodes_an_edge, [&](int facet, int a) { return mesh.nodes[facets[facet][a]]; });
}

PressureLoad::PressureLoad(const Field& garment, const mesh::GarmentMesh& mesh, double pressure)
    : name_("garment"), pressure_(pressure) {
  for (const TrianglePoint& q : triangle_rule()) {
    FacetShape shape;
    shape.N.setZero(), shape.dN.setZero(), shape.ddN.setZero();
    shape.N.head<6>() = garment_values(mesh.order, q.L);
    shape.dN.topRows<6>() = garment_slopes(mesh.order, q.L);
    points_.push_back({shape, 0.5 * q.weight});
  }
  for (const auto& triangle : mesh.triangles) {
    std::array<int, 18> entries{};
    for (int a = 0; a < 6; ++a)
      for (int c = 0; c < 3; ++c) entries[3 * a + c] = garment(mesh.merged[triangle[a]], c);
    entries_.push(entries);
  }
  find_border({0, 3, 1, 4, 2, 5}, 2, [&](int triangle, int a) { return mesh.placed[mesh.triangles[triangle][a]]; });
}

/// `place`: of a facet's node at rest, m.
void PressureLoad::find_border(const std::vector<int>& outline, int nodes_an_edge,
                               const std::function<Eigen::Vector3d(int, int)>& place) {
  const auto edge_of = [&](std::size_t first) {
    std::vector<int> edge;
    for (int k = 0; k <= nodes_an_edge; ++k) edge.push_back(outline[(first + k) % outline.size()]);
    return edge;
  };
  std::map<std::pair<int, int>, int> facets_at;  // corners of an edge
  const auto key = [&](int facet, const std::vector<int>& edge) {
    const auto entries = entries_.of(facet);
    return std::minmax({entries[3 * edge.front()], entries[3 * edge.back()]});
  };
  for (int f = 0; f < entries_.elements(); ++f)
    for (std::size_t k = 0; k < outline.size(); k += nodes_an_edge) ++facets_at[key(f, edge_of(k))];
  for (int f = 0; f < entries_.elements(); ++f)
    for (std::size_t k = 0; k < outline.size(); k += nodes_an_edge) {
      const std::vector<int> edge = edge_of(k);
      if (facets_at.at(key(f, edge)) != 1) continue;
      Border border{{}, {true, true, true}};
      const Eigen::Vector3d start = place(f, edge.front());
      const double level = 1e-9 * (place(f, edge.back()) - start).norm();
      for (const int a : edge) {
        border.nodes.push_back(entries_.of(f)[3 * a]);
        for (int c = 0; c < 3; ++c) border.level[c] = border.level[c] && std::abs(place(f, a)[c] - start[c]) <= level;
      }
      border_.push_back(std::move(border));
    }
}

void PressureLoad::hold_border(const Numbering& numbering) {
  symmetric_ = std::all_of(border_.begin(), border_.end(), [&](const Border& border) {
    int held = 0;
    bool in_plane = false;
    for (int c = 0; c < 3; ++c) {
      const bool all = std::all_of(border.nodes.begin(), border.nodes.end(),
                                   [&](int entry) { return numbering.unknown(entry + c) < 0; });
      held += all, in_plane = in_plane || (all && border.level[c]);
    }
    return held >= 2 || in_plane;  // two held: du and dv are parallel
  });
}

FacetNodes PressureLoad::positions(const State& state, int facet) const {
  FacetNodes x = FacetNodes::Zero();
  const auto entries = entries_.of(facet);
  for (std::size_t a = 0; 3 * a < entries.size(); ++a) x.col(a) = state.values.segment<3>(entries[3 * a]);
  return x;
}

// Where the tangent is not symmetric, no energy is at stake and the convex one keeps it whole: the bar that it pulls along takes
// 5 iterations at twice the shear modulus instead of 7 to 8.
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
        for (int b = 0; b < nodes && (tangent == Tangent::full || (!symmetric_ && wanted(tangent))); ++b)
          matrix.block<3, 3>(3 * a, 3 * b) += p * shape.N[a] * (shape.dN(b, 1) * t1 - shape.dN(b, 0) * t2);
      }
    }
    if (symmetric_) matrix = (0.5 * (matrix + matrix.transpose())).eval();
    const auto length = static_cast<std::size_t>(size);
    sink.add(f, {residual.data(), length},
             wanted(tangent) ? std::span<const double>(matrix.data(), length * length) : std::span<const double>());
  }
  return true;
}

void PressureLoad::measure(const State& state, Measure& measure) const {
  for (int f = 0; f < entries_.elements(); ++f) {
    const FacetNodes x = positions(state, f);
    for (const auto& [shape, weight] : points_)
      measure.contact_force += weight * std::abs(state.load * pressure_) * facet_point(x, shape).area;
  }
  measure.pressure_scale = std::max(measure.pressure_scale, std::abs(pressure_));
}

}  // namespace snug::solver
