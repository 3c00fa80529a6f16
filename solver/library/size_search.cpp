#include "solver/library/size_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/scene/laplace.hpp"

namespace snug::solver {

namespace {

constexpr double largest_stretch = 2.9;  // the rest metric is reached from 3 (FabricMembrane)
constexpr int rows = 49;                 // of the table; between them pressures are nearly straight

mesh::GarmentFit scaled(mesh::GarmentFit fit, double size) {
  for (mesh::FitRow& row : fit.rows) row.girth *= size;
  return fit;
}

/// The mesh with the facets alone that have a node of weight: the curvature of no other is needed.
mesh::BodyMesh about(const mesh::BodyMesh& body, const std::vector<std::vector<double>>& weights) {
  mesh::BodyMesh part;
  part.nodes = body.nodes;
  for (const auto& facet : body.skin_facets)
    if (std::any_of(facet.begin(), facet.end(), [&](int n) { return n >= 0 && std::any_of(weights.begin(), weights.end(), [&](const auto& w) { return w[n] > 0.0; }); }))
      part.skin_facets.push_back(facet);
  return part;
}

double weighted_mean(const std::vector<double>& weight, const std::vector<double>& value, const std::vector<char>& counts) {
  double sum = 0.0, all = 0.0;
  for (std::size_t n = 0; n < weight.size(); ++n)
    if (counts[n] && weight[n] > 0.0) sum += weight[n] * value[n], all += weight[n];
  return all > 0.0 ? sum / all : 0.0;
}

/// Sizes from the fabric's largest stretch to a garment that is slack everywhere, in equal ratios.
std::vector<double> sizes_for(const mesh::GarmentFit& fit, const mesh::Limb& limb) {
  double smallest = 0.0, largest = 0.0;
  for (int i = 0; i <= 20; ++i) {
    const double z = std::clamp(fit.lower + fit.length() * i / 20.0, limb.lower, limb.upper), ratio = limb.girth(z) / fit.at(z).girth;
    smallest = std::max(smallest, ratio / largest_stretch), largest = std::max(largest, 1.02 * ratio);
  }
  std::vector<double> sizes;
  for (int i = 0; i < rows; ++i) sizes.push_back(smallest * std::pow(largest / smallest, i / (rows - 1.0)));
  return sizes;
}

}  // namespace

LaplaceTable::LaplaceTable(const PreparedCase& prepared, int garment, const input::TargetSpec& target) {
  const Meshes& meshes = prepared.meshes;
  if (meshes.form || !meshes.limb.skin)
    throw input::InputError(prepared.description.body->where, "the cut is looked for by the law of Laplace round a limb, and this body is none",
                            "try sizes one by one: snug run CASE --sweep garment.pattern.girth_scale=0.9:1.0:3");
  postproc::BodyResult skin;
  skin.nodes = meshes.body.nodes, skin.skin_facets = meshes.body.skin_facets;
  skin.locations = meshes.body.locations, skin.node_location = meshes.body.node_location, skin.location_shares = meshes.body.location_shares;
  std::vector<std::vector<double>> weights;
  for (const input::WantedPressure& wanted : target.pressures) {
    weights.push_back(postproc::counted_areas(skin, wanted));
    std::vector<double> heights;
    for (const Eigen::Vector3d& x : skin.nodes) heights.push_back(x.z());
    height_.push_back(weighted_mean(weights.back(), heights, std::vector<char>(heights.size(), 1)));
  }
  const mesh::BodyMesh part = about(meshes.body, weights);
  LaplacePressure others;
  others.pressure.assign(part.nodes.size(), 0.0);
  for (std::size_t g = 0; g < meshes.garments.size(); ++g) {
    if (static_cast<int>(g) == garment) continue;
    const LaplacePressure one = laplace_pressure(meshes.garments[g].fit, prepared.model.garments[g], meshes.limb, part);
    for (std::size_t n = 0; n < one.pressure.size(); ++n) others.pressure[n] += one.pressure[n];
  }
  const mesh::GarmentFit& fit = meshes.garments[garment].fit;
  size_ = sizes_for(fit, meshes.limb);
  pressure_.resize(weights.size());
  for (const double size : size_) {
    LaplacePressure own = laplace_pressure(scaled(fit, size), prepared.model.garments[garment], meshes.limb, part);
    for (std::size_t n = 0; n < own.pressure.size(); ++n) own.pressure[n] += others.pressure[n];
    for (std::size_t i = 0; i < weights.size(); ++i) pressure_[i].push_back(weighted_mean(weights[i], own.pressure, own.covered));
  }
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (pressure_[i].front() <= 0.0)
      throw input::InputError(target.pressures[i].where, fmt::format("the garment does not cover {}", target.pressures[i].location.empty() ? fmt::format("a height of {:.4g} mm", 1e3 * *target.pressures[i].height) : target.pressures[i].location),
                              "want a pressure where it lies");
}

double LaplaceTable::at(std::size_t place, double size) const {
  const auto above = std::upper_bound(size_.begin() + 1, size_.end() - 1, size);
  const std::size_t i = static_cast<std::size_t>(above - size_.begin());
  const double share = std::clamp((size - size_[i - 1]) / (size_[i] - size_[i - 1]), 0.0, 1.0);
  return pressure_[place][i - 1] + share * (pressure_[place][i] - pressure_[place][i - 1]);
}

SizeSearch::SizeSearch(std::vector<double> wanted, Pressure cheap, double smallest, double largest)
    : wanted_(std::move(wanted)), cheap_(std::move(cheap)), smallest_(smallest), largest_(largest) {}

void SizeSearch::found(double size, const std::vector<double>& pressures) {
  Solution solution{size, {}};
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    const double nothing = 1e-3 * wanted_[i];
    solution.factor.push_back(std::max(pressures[i], nothing) / std::max(cheap_(i, size), nothing));
  }
  solutions_.push_back(std::move(solution));
}

double SizeSearch::predicted(std::size_t place, double size) const {
  const double cheap = cheap_(place, size);
  if (solutions_.empty()) return cheap;
  const Solution& last = solutions_.back();
  if (solutions_.size() == 1) return last.factor[place] * cheap;
  const Solution& before = solutions_[solutions_.size() - 2];
  const double apart = std::log(last.size / before.size);
  if (std::abs(apart) < 1e-5) return last.factor[place] * cheap;
  // A power of at most 4: two sizes that nearly agree tell nothing about a third one far away.
  const double power = std::clamp(std::log(last.factor[place] / before.factor[place]) / apart, -4.0, 4.0);
  return last.factor[place] * std::pow(size / last.size, power) * cheap;
}

double SizeSearch::misfit(double size) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < wanted_.size(); ++i) sum += std::pow(predicted(i, size) / wanted_[i] - 1.0, 2);
  return sum;
}

double SizeSearch::next() const {
  return least([this](double size) { return misfit(size); }, smallest_, largest_);
}

double least(const std::function<double(double)>& f, double low, double high) {
  constexpr int scan = 400;
  const double ratio = std::pow(high / low, 1.0 / scan);
  double best = low, value = f(low);
  for (int i = 1; i <= scan; ++i)
    if (const double x = low * std::pow(ratio, i), y = f(x); y < value) best = x, value = y;
  double a = std::max(low, best / ratio), b = std::min(high, best * ratio);
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  while (b - a > 1e-9 * b) {
    const double x = b - golden * (b - a), y = a + golden * (b - a);
    (f(x) < f(y) ? b : a) = f(x) < f(y) ? y : x;
  }
  return 0.5 * (a + b);
}

}  // namespace snug::solver
