#include "solver/library/graduated.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/scene/laplace.hpp"

namespace snug::solver {

namespace {

constexpr double largest_stretch = 3.0;   // from which the rest metric is reached (FabricMembrane)
constexpr double spacing = 0.02;          // m, of circumferences
constexpr double full_turn = 2.0 * std::numbers::pi;

/// Composition of a tube by height, whatever its circumferences.
mesh::GarmentFit composition(const input::GarmentSpec& garment) {
  input::GarmentSpec even = garment;
  even.pattern.kind = input::PatternKind::tube, even.pattern.flat_circumference = 1.0;
  return mesh::tube_fit(even);
}

/// Stretch at which the cloth of a row bears that tension (N/m) round the body, by bisection.
double stretch_for(const GarmentModel& garment, const mesh::FitRow& row, double tension, double height) {
  const auto tension_at = [&](double stretch) { return tensions(garment, row, true, stretch).x(); };
  if (tension_at(largest_stretch) < tension)
    throw input::InputError(garment.spec.pattern.where,
                            fmt::format("{:.4g} mm up the tube is to bear {:.3g} N/m, which its fabric does not at {:.3g} times its length", 1e3 * height, tension, largest_stretch),
                            "ask for less pressure there, or take a stiffer fabric");
  double low = 1.0, high = largest_stretch;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (tension_at(middle) < tension ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Heights over the lower edge, evenly, and on both sides of where the fabric changes.
std::vector<double> heights_of(const input::GarmentSpec& garment) {
  constexpr double beside = 5e-4;  // m
  const double length = garment.pattern.length;
  const int steps = std::clamp(static_cast<int>(std::lround(length / spacing)), 4, 60);
  std::vector<double> heights;
  for (int i = 0; i <= steps; ++i) heights.push_back(length * i / steps);
  for (const input::ZoneSpec& zone : garment.zone)
    for (const double border : {zone.from_height, zone.to_height.value_or(length)}) {
      if (border < 2.0 * beside || border > length - 2.0 * beside) continue;
      std::erase_if(heights, [&](double height) { return std::abs(height - border) < 0.25 * length / steps; });
      heights.push_back(border - beside), heights.push_back(border + beside);
    }
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end(), [&](double a, double b) { return b - a < beside; }), heights.end());
  return heights;
}

/// A stretch of heights over the lower edge of a tube, m.
struct Ring {
  double from, to;
  double middle() const { return 0.5 * (from + to); }
};

/// About a height, a cell of the skin to either side, moved away from the strips beside the hems.
Ring ring_about(double height, const input::GarmentSpec& garment, const mesh::BodyMesh& body, const std::vector<postproc::Hem>& hems) {
  double strip = 0.0;
  for (const postproc::Hem& hem : hems) strip = std::max(strip, hem.strip);
  const double length = garment.pattern.length, half = std::min(body.mean_skin_cell, 0.2 * length);
  const double middle = std::clamp(height, std::min(strip + half, 0.5 * length), std::max(length - strip - half, 0.5 * length));
  return {middle - half, middle + half};
}

/// Mean pressure on the skin that is touched in a ring; 0 where none is.
double pressure_in(const Ring& ring, double lower_edge, const postproc::RunResult& run) {
  double force = 0.0, area = 0.0;
  for (const postproc::ContactSample& sample : run.samples) {
    const double height = sample.at.z() - lower_edge;
    if (sample.facet >= 0 && sample.hem < 0 && height >= ring.from && height <= ring.to) force += sample.force, area += sample.area;
  }
  return area > 0.0 ? force / area : 0.0;
}

}  // namespace

double wanted_pressure(const input::PatternSpec& tube, double height) {
  const auto& rows = tube.pressures;
  const auto above = std::find_if(rows.begin(), rows.end(), [&](const input::PressureRow& row) { return row.height > height; });
  if (above == rows.begin()) return rows.front().pressure;
  if (above == rows.end()) return rows.back().pressure;
  const input::PressureRow &a = *(above - 1), &b = *above;
  return a.pressure + (height - a.height) / (b.height - a.height) * (b.pressure - a.pressure);
}

std::vector<input::GirthRow> laplace_girths(const GarmentModel& garment, const mesh::Limb& limb) {
  const mesh::GarmentFit cloth = composition(garment.spec);
  std::vector<input::GirthRow> rows;
  for (const double height : heights_of(garment.spec)) {
    const double z = std::clamp(input::lowest_point(garment.spec) + height, limb.lower, limb.upper), girth = limb.girth(z);
    const double tension = wanted_pressure(garment.spec.pattern, height) * girth / full_turn;
    rows.push_back({height, girth / stretch_for(garment, cloth.at(z), tension, height), garment.spec.pattern.where});
  }
  return rows;
}

std::vector<postproc::ProfileRow> pressure_profile(const Model& model, const Meshes& meshes, const postproc::RunResult& run) {
  std::vector<postproc::ProfileRow> profile;
  if (run.samples.empty()) return profile;
  for (const GarmentModel& garment : model.garments)
    for (const input::PressureRow& row : garment.spec.pattern.pressures) {
      const Ring ring = ring_about(row.height, garment.spec, meshes.body, run.hems);
      profile.push_back({.garment = garment.spec.name, .height = row.height, .from = ring.from, .to = ring.to,
                         .wanted = wanted_pressure(garment.spec.pattern, ring.middle()), .found = pressure_in(ring, input::lowest_point(garment.spec), run)});
    }
  return profile;
}

std::vector<input::GirthRow> corrected_girths(const Model& model, int g, const Meshes& meshes, const postproc::RunResult& run) {
  const GarmentModel& garment = model.garments[g];
  const mesh::GarmentFit cloth = composition(garment.spec);
  std::vector<input::GirthRow> rows = garment.spec.pattern.circumferences;
  for (input::GirthRow& row : rows) {
    const double z = std::clamp(input::lowest_point(garment.spec) + row.height, meshes.limb.lower, meshes.limb.upper), girth = meshes.limb.girth(z);
    const Ring ring = ring_about(row.height, garment.spec, meshes.body, run.hems);
    const double found = pressure_in(ring, input::lowest_point(garment.spec), run);
    // Where next to nothing is found the tension is doubled, no more.
    const double factor = std::clamp(wanted_pressure(garment.spec.pattern, ring.middle()) / std::max(found, 1e-3), 0.5, 2.0);
    const double tension = std::max(tensions(garment, cloth.at(z), true, girth / row.girth).x(), 1e-3);
    row.girth = girth / stretch_for(garment, cloth.at(z), factor * tension, row.height);
  }
  return rows;
}

}  // namespace snug::solver
