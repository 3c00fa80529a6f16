#include "mesh/placement/fit_on_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/input/choice.hpp"

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int rows_by_height = 48;
constexpr double all_round = 0.999;
constexpr double full_turn = 2.0 * std::numbers::pi;

/// A limb at one height, and what of the cloth there is on it.
struct Covered {
  LimbSection limb;
  double length = 0.0, angle = 0.0;  // m, on the flat pieces; rad, round the middle of the section
};

/// Where a triangle is cut at a height: two places, and the length between them on the flat piece.
struct Crossing {
  Vector2d from, to;
  double length = 0.0;
};

std::optional<Crossing> crossing_at(const SewnMesh& sewn, const std::vector<Vector3d>& places, const std::array<int, 6>& t, double z) {
  std::array<Vector2d, 2> placed, flat;
  int ends = 0;
  for (int e = 0; e < 3; ++e) {
    const int a = t[e], b = t[(e + 1) % 3];
    if ((places[a].z() > z) == (places[b].z() > z)) continue;
    const double s = (z - places[a].z()) / (places[b].z() - places[a].z());
    placed[ends] = (places[a] + s * (places[b] - places[a])).head<2>();
    flat[ends++] = sewn.flat[a] + s * (sewn.flat[b] - sewn.flat[a]);
  }
  if (ends != 2) return std::nullopt;
  return Crossing{placed[0], placed[1], (flat[1] - flat[0]).norm()};
}

void lay_on(std::vector<Covered>& limbs, const Crossing& cloth) {
  const Vector2d middle = 0.5 * (cloth.from + cloth.to);
  const auto nearer = [&](const Covered& a, const Covered& b) { return a.limb.off(middle) < b.limb.off(middle); };
  Covered& at = *std::min_element(limbs.begin(), limbs.end(), nearer);
  const Vector2d u = cloth.from - at.limb.loop.centroid, v = cloth.to - at.limb.loop.centroid;
  at.length += cloth.length;
  at.angle += std::abs(std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v)));
}

bool is_arm(BodyPart part) { return part == BodyPart::right_arm || part == BodyPart::left_arm; }

std::vector<FitRow>& rows_of(GarmentFit& fit, BodyPart part) {
  const std::string name = input::text_of(part);
  for (LimbFit& limb : fit.limbs)
    if (limb.limb == name) return limb.rows;
  return fit.limbs.emplace_back(LimbFit{name, {}}).rows;
}

FitRow row_at(double height, const Covered& at) {
  const double cover = std::min(1.0, at.angle / full_turn);
  return {.height = height, .girth = at.length / cover, .cover = cover, .body = closed_length(convex_hull(at.limb.loop.points))};
}

std::string placing_text(const PlacedGarment& placed) {
  const StretchFigures& s = placed.figures;
  return fmt::format("{}; {}principal stretch against the pattern {:.2f} in the median, {:.2f} to {:.2f}",
                     placed.kind ? "on a body that branches, as a garment with " + input::text_of(*placed.kind) : std::string("on a body that branches, from the places of its pieces"),
                     placed.widest_seam.empty() ? "" : fmt::format("seams closed to {:.1f} mm before they were merged ({}), ", 1e3 * placed.last_gap, placed.widest_seam),
                     s.median, s.smallest, s.largest);
}

}  // namespace

GarmentFit fit_on_body(const SewnMesh& sewn, const PlacedGarment& placed, const DressForm& form) {
  const auto lower = [](const Vector3d& a, const Vector3d& b) { return a.z() < b.z(); };
  const auto [low, high] = std::minmax_element(placed.places.begin(), placed.places.end(), lower);
  const double floor = form.body.translation.z();
  GarmentFit fit{.rows = {}, .lower = low->z() - floor, .upper = high->z() - floor, .placing = placing_text(placed)};
  for (int r = 0; r < rows_by_height; ++r) {
    const double z = low->z() + (high->z() - low->z()) * (r + 0.5) / rows_by_height;
    if (z >= form.marks.armpit) continue;  // girths mean nothing there
    std::vector<Covered> limbs;
    for (LimbSection& limb : limbs_at(form, z)) limbs.push_back({std::move(limb)});
    if (limbs.empty()) continue;
    for (const auto& t : sewn.triangles)
      if (const auto cloth = crossing_at(sewn, placed.places, t, z)) lay_on(limbs, *cloth);
    for (const Covered& at : limbs)
      if (at.angle > 0.0 && !is_arm(at.limb.part)) rows_of(fit, at.limb.part).push_back(row_at(z - floor, at));
  }
  return fit;
}

double stand_off(const GarmentFit& fit) {
  double wider = 0.0;
  for (const LimbFit& limb : fit.limbs)
    for (const FitRow& row : limb.rows)
      if (row.cover > all_round) wider = std::max(wider, (row.girth - row.body) / full_turn);
  return wider;
}

double above_girths(const GarmentFit& fit) {
  constexpr double between_rows = 3.0 / rows_by_height;  // of the height: rows end half of one below the top
  double highest = fit.lower;
  for (const LimbFit& limb : fit.limbs)
    for (const FitRow& row : limb.rows) highest = std::max(highest, row.height);
  const double above = fit.upper - highest;
  return !fit.limbs.empty() && above > between_rows * (fit.upper - fit.lower) ? above : 0.0;
}

}  // namespace snug::mesh
