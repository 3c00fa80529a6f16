#include "postproc/skin_pressure.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>

#include "solver/fem/plane_shape.hpp"

namespace snug::postproc {
namespace {

constexpr double least_coverage = 0.05;

using Facets = std::vector<std::array<int, 9>>;
using Points = std::vector<Eigen::Vector3d>;
using Basis = std::array<double, 3>;

/// Products of hats, in tensor order.
std::array<double, 9> tensor(const Basis& a, const Basis& b) {
  std::array<double, 9> values;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) values[3 * j + i] = a[i] * b[j];
  return values;
}

/// Linear hats on the nodes -1, 0, 1.
Basis hat(double x) { return {std::max(0.0, -x), 1 - std::abs(x), std::max(0.0, x)}; }

/// Area of the facet per unit of d(xi) d(eta).
double area_density(const std::array<int, 9>& facet, const Points& positions, double xi, double eta) {
  const auto slopes = fem::plane_shape<fem::Element::quad9>({xi, eta}).dN;
  Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
  for (int n = 0; n < 9; ++n) tangents += positions.at(facet[n]) * slopes.row(n);
  return tangents.col(0).cross(tangents.col(1)).norm();
}

/// What a sample gives to the nodes of its facet: `shape` carries force and pressure, `hat` >= 0 the cover.
struct Shares {
  int nodes = 9;
  std::array<double, 9> shape{}, hat{};
};

Shares both(int nodes, const std::array<double, 9>& values) { return {nodes, values, values}; }

template <fem::Element element>
std::array<double, 9> shape_values(double xi, double eta) {
  const auto N = fem::plane_values<element>({xi, eta});
  std::array<double, 9> values{};
  std::copy(N.begin(), N.end(), values.begin());
  return values;
}

/// Hats on the triangle cut into four between its nodes: the quadratic functions of its corners have no mass to lump.
Shares on_triangle(double xi, double eta) {
  const std::array<double, 3> L = {1 - xi - eta, xi, eta};
  std::array<double, 9> values{};
  for (int v = 0; v < 3; ++v) {
    const int w = (v + 1) % 3, u = (v + 2) % 3;  // mid-edge 3 + v is between v and w, 3 + u between u and v
    if (L[v] > 0.5) {
      values[v] = 2 * L[v] - 1, values[3 + v] = 2 * L[w], values[3 + u] = 2 * L[u];
      return both(6, values);
    }
  }
  for (int v = 0; v < 3; ++v) values[3 + v] = 1 - 2 * L[(v + 2) % 3];
  return both(6, values);
}

Shares shares(const std::array<int, 9>& facet, double xi, double eta) {
  if (facet[8] >= 0) return {9, shape_values<fem::Element::quad9>(xi, eta), tensor(hat(xi), hat(eta))};
  if (facet[4] >= 0) return on_triangle(xi, eta);
  return both(4, shape_values<fem::Element::quad4>(xi, eta));
}

/// Sums over the samples: what the transfer needs of them.
struct Sums {
  explicit Sums(std::size_t nodes)
      : force(Eigen::VectorXd::Zero(nodes)),
        lumped(force),
        covered(force),
        near_force(force),
        near_area(force),
        mass(nodes, nodes) {}
  Eigen::VectorXd force;                              ///< sum of force N_j
  Eigen::VectorXd lumped;                             ///< sum of area N_j; may be negative on a hem
  Eigen::VectorXd covered;                            ///< sum of area hat_j >= 0
  Eigen::VectorXd near_force, near_area;              ///< sums of force |N_j| and area |N_j| over samples with an area
  Eigen::SparseMatrix<double, Eigen::RowMajor> mass;  ///< sum of area N_i N_j
  double total_force = 0.0;
};

Sums sum_samples(const Facets& facets, std::size_t nodes, const std::vector<ContactSample>& samples) {
  Sums sums(nodes);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(81 * samples.size());
  for (const ContactSample& sample : samples) {
    sums.total_force += sample.force;
    if (sample.facet < 0) continue;
    const auto& facet = facets.at(sample.facet);
    const auto& [count, shape, hats] = shares(facet, sample.xi, sample.eta);
    for (int i = 0; i < count; ++i) {
      sums.force[facet[i]] += sample.force * shape[i];
      sums.lumped[facet[i]] += sample.area * shape[i];
      sums.covered[facet[i]] += sample.area * hats[i];
      if (sample.area > 0) sums.near_force[facet[i]] += sample.force * std::abs(shape[i]);
      sums.near_area[facet[i]] += sample.area * std::abs(shape[i]);
      for (int j = 0; j < count; ++j) entries.emplace_back(facet[i], facet[j], sample.area * shape[i] * shape[j]);
    }
  }
  sums.mass.setFromTriplets(entries.begin(), entries.end());
  return sums;
}

/// D of the sweeps. Inside the cover this is the lumped mass (there the absolute row sum is just under twice as large).
/// On a hem half the absolute row sum takes over: no eigenvalue of D^-1 M exceeds 2 then (Gershgorin), so no sweep
/// amplifies an error.
Eigen::VectorXd sweep_diagonal(const Sums& sums) {
  Eigen::VectorXd diagonal = sums.lumped;
  for (int i = 0; i < sums.mass.outerSize(); ++i) {
    double row = 0.0;
    for (decltype(sums.mass)::InnerIterator entry(sums.mass, i); entry; ++entry) row += std::abs(entry.value());
    diagonal[i] = std::max(diagonal[i], 0.5 * row);
  }
  return diagonal;
}

/// Pressure of the first step. Where the lumped mass is too small a divisor, the mean over the facets of the node with
/// the positive weights |N_j| stands in: it lies between the pressures of the samples. Every node of a facet with
/// samples gets a value, also beyond the hem, because the rows of M reach there.
Eigen::VectorXd first_pressure(const Sums& sums, const Eigen::VectorXd& diagonal) {
  Eigen::VectorXd pressure = Eigen::VectorXd::Zero(sums.force.size());
  for (Eigen::Index j = 0; j < pressure.size(); ++j) {
    if (sums.lumped[j] > 0 && sums.lumped[j] >= diagonal[j])
      pressure[j] = sums.force[j] / sums.lumped[j];
    else if (sums.near_area[j] > 0)
      pressure[j] = sums.near_force[j] / sums.near_area[j];
  }
  return pressure;
}

void sweep(const Sums& sums, const Eigen::VectorXd& diagonal, int sweeps, Eigen::VectorXd& pressure) {
  for (int s = 0; s < sweeps; ++s) {
    const Eigen::VectorXd defect = sums.force - sums.mass * pressure;
    for (Eigen::Index j = 0; j < pressure.size(); ++j)
      if (diagonal[j] > 0) pressure[j] += defect[j] / diagonal[j];
  }
}

std::vector<double> to_vector(const Eigen::VectorXd& values) { return {values.begin(), values.end()}; }

/// A facet of 4 or 6 nodes cut into triangles between its nodes: each gives a third of its area to its corners.
void add_triangle_areas(const std::array<int, 9>& facet, const Points& positions, std::vector<double>& areas) {
  using Triangles = std::vector<std::array<int, 3>>;
  static const Triangles of_four = {{0, 1, 3}, {0, 3, 2}}, of_six = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
  for (const auto& [a, b, c] : facet[4] < 0 ? of_four : of_six) {
    const Eigen::Vector3d& x = positions.at(facet[a]);
    const double area = 0.5 * (positions.at(facet[b]) - x).cross(positions.at(facet[c]) - x).norm();
    for (const int n : {a, b, c}) areas.at(facet[n]) += area / 3.0;
  }
}

}  // namespace

std::vector<Eigen::Vector3d> nodes_now(const BodyResult& body) {
  std::vector<Eigen::Vector3d> positions = body.nodes;
  if (const auto* displacement = body.fields.find(field::displacement))
    for (std::size_t n = 0; n < std::min(positions.size(), displacement->size()); ++n) positions[n] += (*displacement)[n];
  return positions;
}

std::vector<double> nodal_areas(const Facets& facets, std::size_t nodes, const Points& positions) {
  // The hats have kinks at 0: two Gauss points on either side, in each direction.
  static const fem::Rule rule = fem::quadrature(fem::Domain::line, 3);
  const std::array<double, 4> points = {-0.5 + 0.5 * rule.points(0, 0), -0.5 + 0.5 * rule.points(0, 1),
                                        0.5 + 0.5 * rule.points(0, 0), 0.5 + 0.5 * rule.points(0, 1)};
  const double weight = std::pow(0.5 * rule.weights[0], 2);  // both alike
  std::vector<double> areas(nodes, 0.0);
  for (const auto& facet : facets) {
    if (facet[8] < 0) {
      add_triangle_areas(facet, positions, areas);
      continue;
    }
    for (double eta : points)
      for (double xi : points) {
        const double area = weight * area_density(facet, positions, xi, eta);
        const auto hats = tensor(hat(xi), hat(eta));
        for (int n = 0; n < 9; ++n) areas.at(facet[n]) += area * hats[n];
      }
  }
  return areas;
}

SkinPressure transfer(const Facets& facets, std::size_t nodes, const Points& positions,
                      const std::vector<ContactSample>& samples, int sweeps) {
  const Sums sums = sum_samples(facets, nodes, samples);
  const Eigen::VectorXd diagonal = sweep_diagonal(sums);
  Eigen::VectorXd pressure = first_pressure(sums, diagonal);
  sweep(sums, diagonal, sweeps, pressure);

  const std::vector<double> areas = nodal_areas(facets, nodes, positions);
  SkinPressure result;
  result.coverage.assign(nodes, 0.0);
  for (std::size_t j = 0; j < nodes; ++j) {
    if (areas[j] > 0) result.coverage[j] = std::clamp(sums.covered[j] / areas[j], 0.0, 1.0);
    // The sweeps need the values of barely covered nodes; only the answer leaves them out.
    if (result.coverage[j] < least_coverage || pressure[j] < 0) pressure[j] = 0.0;
  }
  result.lost_force = sums.total_force - sums.lumped.dot(pressure);
  result.pressure = to_vector(pressure);
  result.area = to_vector(sums.covered);
  result.node_area = areas;
  result.force = to_vector(sums.force);
  return result;
}

double field_at(const Facets& facets, const ContactSample& sample, const std::vector<double>& field) {
  const auto& facet = facets.at(sample.facet);
  const Shares share = shares(facet, sample.xi, sample.eta);
  double value = 0.0;
  for (int i = 0; i < share.nodes; ++i) value += share.shape[i] * field[facet[i]];
  return value;
}

std::array<double, 9> hats_at(const std::array<int, 9>& facet, double xi, double eta) { return shares(facet, xi, eta).hat; }

std::array<double, 9> shape_at(const std::array<int, 9>& facet, double xi, double eta) { return shares(facet, xi, eta).shape; }

SkinShear transfer_shear(const Facets& facets, const SkinPressure& normal, const std::vector<ContactSample>& samples) {
  const std::size_t nodes = normal.pressure.size();
  SkinShear result{Points(nodes, Eigen::Vector3d::Zero()), std::vector<double>(nodes, 0.0)};
  std::vector<double> force(nodes, 0.0), sticking(nodes, 0.0), slipping(nodes, 0.0);
  for (const ContactSample& sample : samples) {
    if (sample.facet < 0 || !sample.touching) continue;
    const auto& facet = facets.at(sample.facet);
    const auto& [count, shape, hats] = shares(facet, sample.xi, sample.eta);
    for (int i = 0; i < count; ++i) {
      const int node = facet[i];
      result.traction[node] += hats[i] * sample.shear;
      force[node] += hats[i] * sample.force;
      (sample.slips ? slipping : sticking)[node] += sample.area * hats[i];
    }
  }
  for (std::size_t j = 0; j < nodes; ++j) {
    result.traction[j] *= force[j] > 0.0 ? normal.pressure[j] / force[j] : 0.0;
    if (normal.pressure[j] > 0.0) result.slip[j] = slipping[j] > sticking[j] ? 2.0 : 1.0;
  }
  return result;
}

}  // namespace snug::postproc
