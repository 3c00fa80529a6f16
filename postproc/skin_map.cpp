#include "postproc/skin_map.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "cases/input/csv.hpp"

namespace snug::postproc {

namespace {

constexpr std::size_t neighbours = 16;
constexpr double covered = 0.5;

std::vector<std::size_t> compared_nodes(const SkinMap& map, const Zone& zone) {
  constexpr double tolerance = 1e-9;  // m, so that nodes on the zone's border belong to it
  std::vector<std::size_t> nodes;
  for (std::size_t n = 0; n < map.nodes.size(); ++n) {
    const double z = map.nodes[n].z();
    if (map.coverage[n] >= covered && z >= zone.from - tolerance && z <= zone.to + tolerance) nodes.push_back(n);
  }
  return nodes;
}

/// Sums squares; what is asked for comes out relative to `scale`.
struct Squares {
  double sum = 0.0, max = 0.0;
  void add(double error) { sum += error * error, max = std::max(max, std::abs(error)); }
  double rms(std::size_t count) const { return std::sqrt(sum / static_cast<double>(count)); }
};

MapError relative(const Squares& pressure, double pressure_scale, const Squares& displacement,
                  double displacement_scale, std::size_t nodes) {
  MapError error;
  error.nodes = static_cast<long>(nodes);
  if (nodes == 0) return error;
  error.pressure_rms = pressure.rms(nodes) / std::abs(pressure_scale);
  error.pressure_max = pressure.max / std::abs(pressure_scale);
  error.displacement_rms = displacement.rms(nodes) / std::abs(displacement_scale);
  return error;
}

/// Indices of the nodes nearest to a position, nearest first.
std::vector<std::size_t> nearest(const SkinMap& map, const Eigen::Vector3d& position) {
  std::vector<std::pair<double, std::size_t>> distances;
  for (std::size_t n = 0; n < map.nodes.size(); ++n) distances.emplace_back((map.nodes[n] - position).squaredNorm(), n);
  const auto middle = distances.begin() + neighbours;
  std::partial_sort(distances.begin(), middle, distances.end());
  std::vector<std::size_t> nodes;
  for (auto it = distances.begin(); it != middle; ++it) nodes.push_back(it->second);
  return nodes;
}

/// Two unit vectors along the skin at its nodes: the directions in which they spread most.
Eigen::Matrix<double, 3, 2> tangent_plane(const SkinMap& map, const std::vector<std::size_t>& nodes) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const std::size_t n : nodes) centre += map.nodes[n] / static_cast<double>(nodes.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const std::size_t n : nodes) spread += (map.nodes[n] - centre) * (map.nodes[n] - centre).transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().rightCols<2>();
}

}  // namespace

SkinMap read_skin_map(const std::filesystem::path& file) {
  input::Diagnostics diagnostics;
  const input::Csv csv = input::read_csv(file, diagnostics);
  const auto column = [&](const char* name, const char* unit) { return input::numbers(csv, name, unit, diagnostics); };
  const auto x = column("x", "m"), y = column("y", "m"), z = column("z", "m");
  const auto ux = column("ux", "m"), uy = column("uy", "m"), uz = column("uz", "m");
  SkinMap map{{}, {}, column("pressure", "Pa"), column("coverage", "")};
  diagnostics.throw_if_any();
  for (std::size_t n = 0; n < x.size(); ++n) {
    map.nodes.emplace_back(x[n], y[n], z[n]);
    map.displacement.emplace_back(ux[n], uy[n], uz[n]);
  }
  return map;
}

MapError error_against(const SkinMap& map, const Zone& zone, double pressure, double radial_displacement) {
  const std::vector<std::size_t> nodes = compared_nodes(map, zone);
  Squares p, u;
  for (const std::size_t n : nodes) {
    p.add(map.pressure[n] - pressure);
    const Eigen::Vector2d radial = map.nodes[n].head<2>().normalized();
    u.add(radial.dot(map.displacement[n].head<2>()) - radial_displacement);
  }
  return relative(p, pressure, u, radial_displacement, nodes.size());
}

MapError error_against(const SkinMap& map, const Zone& zone, const SkinMap& finer) {
  if (finer.nodes.size() < neighbours) throw std::invalid_argument("the finer map has fewer than sixteen nodes");
  const std::vector<std::size_t> nodes = compared_nodes(map, zone);
  Squares p, u, displacements;
  double pressures = 0.0;
  for (const std::size_t n : nodes) {
    const Eigen::Vector4d there = interpolate(finer, map.nodes[n]);
    p.add(map.pressure[n] - there[0]);
    u.add((map.displacement[n] - there.tail<3>()).norm());
    pressures += there[0];
    displacements.add(there.tail<3>().norm());
  }
  const std::size_t count = std::max<std::size_t>(nodes.size(), 1);
  return relative(p, pressures / static_cast<double>(count), u, displacements.rms(count), nodes.size());
}

// Basis 1, a, b, a2, ab, b2 of the distances a, b from the position over that of the farthest neighbour: the value at
// the position is the first coefficient. The weight vanishes just beyond the farthest neighbour.
Eigen::Vector4d interpolate(const SkinMap& map, const Eigen::Vector3d& position) {
  const std::vector<std::size_t> nodes = nearest(map, position);
  const Eigen::Matrix<double, 3, 2> plane = tangent_plane(map, nodes);
  const double reach = 1.05 * (map.nodes[nodes.back()] - position).norm();
  Eigen::Matrix<double, neighbours, 6> basis;
  Eigen::Matrix<double, neighbours, 4> values;
  for (std::size_t i = 0; i < neighbours; ++i) {
    const Eigen::Vector3d offset = (map.nodes[nodes[i]] - position) / reach;
    const Eigen::Vector2d t = plane.transpose() * offset;
    const double weight = std::pow(1.0 - offset.norm(), 2);
    basis.row(i) << 1.0, t[0], t[1], t[0] * t[0], t[0] * t[1], t[1] * t[1];
    basis.row(i) *= weight;
    values.row(i) << map.pressure[nodes[i]], map.displacement[nodes[i]].transpose();
    values.row(i) *= weight;
  }
  return basis.completeOrthogonalDecomposition().solve(values).row(0).transpose();
}

}  // namespace snug::postproc
