#include "solver/scene/laplace.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "postproc/skin_pressure.hpp"

namespace snug::solver {

namespace {

// Hoop and axial Cauchy tension (N/m) at hoop stretch l and axial stretch 1: N1 l and N2 / l.
Eigen::Vector2d tensions_of(const materials::Fabric& fabric, bool warp_along, double stretch) {
  const double hoop = 0.5 * (stretch * stretch - 1.0);
  const auto response = fabric.relaxed(warp_along ? Eigen::Vector3d(0.0, hoop, 0.0) : Eigen::Vector3d(hoop, 0.0, 0.0), 0.0);
  const double around = response.force[warp_along ? 1 : 0], along = response.force[warp_along ? 0 : 1];
  return {around * stretch, along / stretch};
}

double distance(const mesh::Limb& limb, double turn, const Eigen::Vector3d& x) {
  return (limb.skin->at(turn, x.z()) - x).squaredNorm();
}

// The turn of a point of the skin: the nearest of 64 samples, then golden-section search between its neighbours.
double turn_of(const mesh::Limb& limb, const Eigen::Vector3d& x) {
  constexpr int samples = 64;
  int best = 0;
  double least = distance(limb, 0.0, x);
  for (int i = 1; i < samples; ++i)
    if (const double d = distance(limb, i / double(samples), x); d < least) least = d, best = i;
  double low = (best - 1.0) / samples, high = (best + 1.0) / samples;
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  while (high - low > 1e-8) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (distance(limb, a - std::floor(a), x) < distance(limb, b - std::floor(b), x) ? high : low) =
        distance(limb, a - std::floor(a), x) < distance(limb, b - std::floor(b), x) ? b : a;
  }
  const double turn = 0.5 * (low + high);
  return turn - std::floor(turn);
}

// Over the covered skin.
double mean(const LaplacePressure& laplace, const mesh::BodyMesh& body) {
  double area = 0.0, sum = 0.0;
  const std::vector<double> areas = postproc::nodal_areas(body.skin_facets, body.nodes.size(), body.nodes);
  for (std::size_t node = 0; node < areas.size(); ++node)
    if (laplace.covered[node]) area += areas[node], sum += areas[node] * laplace.pressure[node];
  return area > 0.0 ? sum / area : 0.0;
}

// Stretch at which a fabric bears that tension round the body, by bisection; no more than `most`.
double stretch_at(const materials::Fabric& fabric, bool warp_along, double tension, double most) {
  double low = 0.0, high = most;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (tensions_of(fabric, warp_along, middle).x() < tension ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

struct Share {
  const materials::Fabric* fabric;
  double of_girth;
};

// Fabrics of a row that there is something of.
std::vector<Share> shares_of(const GarmentModel& garment, const mesh::FitRow& row) {
  constexpr double nothing = 1e-9;
  std::vector<Share> shares;
  double rest = 1.0;
  for (std::size_t z = 0; z < row.zones.size() && z < garment.zones.size(); ++z) {
    rest -= row.zones[z];
    if (row.zones[z] > nothing) shares.push_back({&garment.zones[z], row.zones[z]});
  }
  if (rest > nothing || shares.empty()) shares.push_back({&garment.fabric, rest});
  return shares;
}

}  // namespace

// The tension at which the stretches of all add up to the whole, by bisection between none and what the stiffest would bear at that stretch.
Eigen::Vector2d tensions(const GarmentModel& garment, const mesh::FitRow& row, bool warp_along, double stretch) {
  const std::vector<Share> shares = shares_of(garment, row);
  if (shares.size() == 1) return tensions_of(*shares.front().fabric, warp_along, stretch);
  if (stretch <= 1.0) return Eigen::Vector2d::Zero();
  const double most = 1.0 + (stretch - 1.0) / std::min_element(shares.begin(), shares.end(), [](const Share& a, const Share& b) { return a.of_girth < b.of_girth; })->of_girth;
  double low = 0.0, high = 0.0;
  for (const Share& share : shares) high = std::max(high, tensions_of(*share.fabric, warp_along, stretch).x());
  for (int halving = 0; halving < 50; ++halving) {
    const double middle = 0.5 * (low + high);
    double sum = 0.0;
    for (const Share& share : shares) sum += share.of_girth * stretch_at(*share.fabric, warp_along, middle, most);
    (sum < stretch ? low : high) = middle;
  }
  Eigen::Vector2d result(0.5 * (low + high), 0.0);
  for (const Share& share : shares) {
    const double own = stretch_at(*share.fabric, warp_along, result.x(), most);
    result.y() += share.of_girth * own / stretch * tensions_of(*share.fabric, warp_along, own).y();
  }
  return result;
}

LaplacePressure laplace_pressure(const mesh::GarmentFit& fit, const GarmentModel& garment, const mesh::Limb& limb,
                                 const mesh::BodyMesh& body, double give) {
  LaplacePressure result;
  result.pressure.assign(body.nodes.size(), 0.0);
  result.covered.assign(body.nodes.size(), 0);
  if (fit.rows.empty()) return result;
  std::map<double, Eigen::Vector2d> tension_at;  // of a height, which many nodes share
  for (const auto& facet : body.skin_facets)
    for (const int node : facet) {
      if (node < 0) continue;
      const Eigen::Vector3d& x = body.nodes[node];
      if (result.covered[node] || x.z() < fit.lower - 1e-9 || x.z() > fit.upper + 1e-9) continue;
      auto [it, fresh] = tension_at.try_emplace(x.z());
      if (fresh) {
        const mesh::FitRow row = fit.at(x.z());
        it->second = tensions(garment, row, fit.warp_along, (1.0 - give) * limb.girth(x.z()) / row.girth);
      }
      result.covered[node] = 1;
      result.pressure[node] = std::max(0.0, it->second.dot(Eigen::Vector2d(1.0 / (1.0 - give), 1.0).cwiseProduct(limb.skin_curvature(turn_of(limb, x), x.z()))));
    }
  result.mean = mean(result, body);
  return result;
}

LaplacePressure laplace_pressure(const std::vector<GarmentModel>& garments, const Meshes& meshes, double give) {
  const mesh::BodyMesh& body = meshes.body;
  LaplacePressure all;
  if (meshes.form) return all;  // its radius is that of a limb
  all.pressure.assign(body.nodes.size(), 0.0);
  all.covered.assign(body.nodes.size(), 0);
  for (std::size_t g = 0; g < garments.size(); ++g) {
    const LaplacePressure one = laplace_pressure(meshes.garments[g].fit, garments[g], meshes.limb, body, give);
    for (std::size_t n = 0; n < body.nodes.size(); ++n)
      if (one.covered[n]) all.covered[n] = 1, all.pressure[n] += one.pressure[n];
  }
  all.mean = mean(all, body);
  return all;
}

}  // namespace snug::solver
