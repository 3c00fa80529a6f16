#include "mesh/garment/limb_placement.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "mesh/garment/garment_zones.hpp"
#include "mesh/garment/limb_sheet.hpp"
#include "mesh/garment/sliding.hpp"
#include "mesh/garment/start_stretch.hpp"
#include "mesh/garment/tube_chart.hpp"

namespace snug::mesh {

namespace {

using input::InputError;

constexpr double full_turn = 2.0 * std::numbers::pi;

constexpr double beyond_the_end = 0.25;  // of the mean edge: what a hem may pass the limb's end by, to be pushed back

/// A place on the chart and the angle of the limb where it comes to lie.
struct Facing {
  double round, angle;
};

double circular_mean(const std::vector<double>& turns) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const double t : turns) sum += Eigen::Vector2d(std::cos(full_turn * t), std::sin(full_turn * t));
  return std::atan2(sum.y(), sum.x()) / full_turn;
}

std::vector<double> rounds_of_pieces(const SewnMesh& sewn, const TubeChart& chart, const std::string& name) {
  std::vector<double> result;
  for (std::size_t t = 0; t < sewn.triangles.size(); ++t)
    if (sewn.pieces[sewn.triangle_piece[t]].find(name) != std::string::npos)
      for (int k = 0; k < 3; ++k) result.push_back(chart.round[sewn.merged[sewn.triangles[t][k]]]);
  return result;
}

Facing facing(const SewnMesh& sewn, const TubeChart& chart, const std::optional<double>& seam) {
  if (!seam)
    for (const auto& [name, angle] : {std::pair{"front", 0.25}, std::pair{"back", 0.75}})
      if (const std::vector<double> rounds = rounds_of_pieces(sewn, chart, name); !rounds.empty()) return {circular_mean(rounds), angle * full_turn};
  std::vector<double> along;
  if (!sewn.seams.empty())
    for (std::size_t n = 0; n < sewn.seams.front().pairs.size(); n += 2)  // a mid-edge node is between two vertices
      along.push_back(chart.round[sewn.merged[sewn.seams.front().pairs[n][0]]]);
  return {along.empty() ? 0.0 : circular_mean(along), seam.value_or(std::numbers::pi)};
}

/// Where a garment goes a part of the way round, at uneven hems, a part does not tell its width: it is as tight there as at the nearest row that
/// goes all the way round.
void widen_from_whole(const Limb& limb, double lower, double upper, std::vector<FitRow>& rows) {
  if (rows.empty()) return;
  rows.insert(rows.begin(), {.height = lower, .girth = rows.front().girth, .cover = 0.0, .zones = rows.front().zones});
  rows.push_back({.height = upper, .girth = rows.back().girth, .cover = 0.0, .zones = rows.back().zones});
  constexpr double all_round = 0.999;
  const auto whole = [](const FitRow& row) { return row.cover > all_round; };
  const auto first = std::find_if(rows.begin(), rows.end(), whole);
  if (first == rows.end()) return;
  const auto last = std::find_if(rows.rbegin(), rows.rend(), whole).base();
  const auto as_tight_as = [&](const FitRow& row, double height) { return row.girth * limb.girth(height) / limb.girth(row.height); };
  for (auto it = rows.begin(); it != first; ++it) it->girth = as_tight_as(*first, it->height);
  for (auto it = last; it != rows.end(); ++it) it->girth = as_tight_as(*(last - 1), it->height);
  rows.front().cover = rows[1].cover, rows.back().cover = rows[rows.size() - 2].cover;
}

/// The zone that a piece is in; -1: none.
std::vector<int> zones_of_pieces(const SewnMesh& sewn, const input::GarmentSpec& spec) {
  std::vector<int> zones;
  for (const std::string& piece : sewn.pieces) zones.push_back(zone_of_piece(spec, piece));
  return zones;
}

/// Widths by height: lengths on the flat pieces of the lines on which the vertices' heights are equal.
std::vector<FitRow> rows_of(const SewnMesh& sewn, const input::GarmentSpec& spec, const Limb& limb, const std::vector<ChartPlace>& places, double lower,
                            double upper) {
  constexpr int count = 48;
  const std::vector<int> zones = zones_of_pieces(sewn, spec);
  std::vector<FitRow> rows(count);
  std::vector<double> round(count, 0.0);
  for (int r = 0; r < count; ++r) rows[r] = {.height = lower + (upper - lower) * (r + 0.5) / count, .cover = 0.0, .zones = std::vector<double>(spec.zone.size(), 0.0)};
  for (std::size_t triangle = 0; triangle < sewn.triangles.size(); ++triangle) {
    const auto& t = sewn.triangles[triangle];
    const int zone = zones[sewn.triangle_piece[triangle]];
    const std::array<const ChartPlace*, 3> p = {&places[sewn.merged[t[0]]], &places[sewn.merged[t[1]]], &places[sewn.merged[t[2]]]};
    for (int r = 0; r < count; ++r) {
      std::vector<std::pair<Eigen::Vector2d, double>> ends;
      for (int e = 0; e < 3; ++e) {
        const int f = (e + 1) % 3;
        const double a = p[e]->height - rows[r].height, b = p[f]->height - rows[r].height;
        if ((a < 0.0) == (b < 0.0)) continue;
        const double s = a / (a - b);
        const double from = std::remainder(p[e]->share - p[0]->share, 1.0), to = std::remainder(p[f]->share - p[0]->share, 1.0);
        ends.emplace_back((1.0 - s) * sewn.flat[t[e]] + s * sewn.flat[t[f]], (1.0 - s) * from + s * to);
      }
      if (ends.size() != 2) continue;
      const double width = (ends[1].first - ends[0].first).norm();
      rows[r].girth += width;
      if (zone >= 0) rows[r].zones[zone] += width;
      round[r] += std::abs(ends[1].second - ends[0].second);
    }
  }
  std::vector<FitRow> there;
  for (int r = 0; r < count; ++r) {
    if (!(round[r] > 0.0)) continue;
    for (double& share : rows[r].zones) share /= rows[r].girth;
    there.push_back({.height = rows[r].height, .girth = rows[r].girth / round[r], .cover = std::min(1.0, round[r]), .zones = rows[r].zones});
  }
  widen_from_whole(limb, lower, upper, there);
  return there;
}

bool warp_runs_up(const SewnMesh& sewn, const std::vector<ChartPlace>& places) {
  double up = 0.0, all = 0.0;
  for (std::size_t t = 0; t < sewn.triangles.size(); ++t) {
    const auto& n = sewn.triangles[t];
    const Eigen::Vector2d a = sewn.flat[n[1]] - sewn.flat[n[0]], b = sewn.flat[n[2]] - sewn.flat[n[0]];
    const double area = a.x() * b.y() - a.y() * b.x();
    const double first = places[sewn.merged[n[1]]].height - places[sewn.merged[n[0]]].height,
                 second = places[sewn.merged[n[2]]].height - places[sewn.merged[n[0]]].height;
    const Eigen::Vector2d gradient = Eigen::Vector2d(first * b.y() - second * a.y(), second * a.x() - first * b.x()) / area;
    up += area * std::abs(gradient.normalized().dot(sewn.warp[t])), all += area;
  }
  return up > std::sqrt(0.5) * all;
}

class Placement {
 public:
  Placement(const SewnMesh& sewn, const input::GarmentSpec& spec, const Limb& limb, double lift)
      : sewn_(sewn), spec_(spec), limb_(limb), lift_(lift), position_(input::lowest_point(spec)), chart_(tube_chart(sewn, spec.bottom, spec.where)),
        facing_(facing(sewn, chart_, spec.seam)) {}

  LimbPlacement take() {
    lay();
    const LimbSheet sheet(limb_, fit(), lift_, facing_.angle);
    slide(sewn_, sheet, places_);
    settle();
    LimbPlacement result{.placed = positions(sheet), .fit = fit(), .stand_off = sheet.farthest()};
    measure(result);
    return result;
  }

 private:
  /// Lengths of the chart become heights on the limb.
  void lay() {
    const LimbSheet skin(limb_, GarmentFit{}, lift_, facing_.angle);
    const double first = skin.length_to(position_);
    double highest = position_;
    places_.resize(sewn_.flat.size());
    for (std::size_t n = 0; n < places_.size(); ++n) {
      places_[n] = {chart_.round[n] - facing_.round, skin.height_after(first + chart_.up[n])};
      if (is_vertex(n)) highest = std::max(highest, places_[n].height);
    }
    check_range(highest);
  }

  void check_range(double highest) const {
    const double tolerance = 1e-9 + beyond_the_end * sewn_.mean_edge;  // m
    if (position_ < limb_.lower - 1e-9 || highest > limb_.upper + tolerance)
      throw InputError(spec_.where,
                       fmt::format("the garment covers heights {:.1f} to {:.1f} mm, the body {:.1f} to {:.1f} mm", 1e3 * position_,
                                   1e3 * highest, 1e3 * limb_.lower, 1e3 * limb_.upper),
                       "move it (position), shorten it (pattern.length_scale), or let the body reach further");
  }

  /// The lowest point back to where the case has it, and nothing beyond the ends of the limb.
  void settle() {
    const double shift = position_ - lowest();
    double highest = position_;
    for (std::size_t n = 0; n < places_.size(); ++n) {
      places_[n].height += shift;
      if (is_vertex(n)) highest = std::max(highest, places_[n].height);
      places_[n].height = std::clamp(places_[n].height, limb_.lower, limb_.upper);
    }
    check_range(highest);
  }

  bool is_vertex(std::size_t node) {
    if (vertex_.empty()) {
      vertex_.assign(sewn_.flat.size(), 0);
      for (const auto& t : sewn_.triangles)
        for (int k = 0; k < 3; ++k) vertex_[sewn_.merged[t[k]]] = 1;
    }
    return vertex_[node];
  }

  double lowest() {
    double low = limb_.upper;
    for (std::size_t n = 0; n < places_.size(); ++n)
      if (is_vertex(n)) low = std::min(low, places_[n].height);
    return low;
  }

  GarmentFit fit() {
    GarmentFit result;
    result.lower = lowest(), result.upper = limb_.lower;
    for (std::size_t n = 0; n < places_.size(); ++n)
      if (is_vertex(n)) result.upper = std::max(result.upper, places_[n].height);
    result.rows = rows_of(sewn_, spec_, limb_, places_, result.lower, result.upper);
    result.warp_along = warp_runs_up(sewn_, places_);
    return result;
  }

  std::vector<Eigen::Vector3d> positions(const LimbSheet& sheet) {
    std::vector<Eigen::Vector3d> at(sewn_.flat.size());
    for (std::size_t n = 0; n < at.size(); ++n)
      if (is_vertex(n)) at[n] = sheet.at(places_[n].share, places_[n].height);
    for (const auto& t : sewn_.triangles)
      for (int e = 0; e < 3; ++e) {
        const ChartPlace &a = places_[sewn_.merged[t[e]]], &b = places_[sewn_.merged[t[(e + 1) % 3]]];
        const int middle = sewn_.merged[t[3 + e]];
        at[middle] = sheet.at(a.share + 0.5 * std::remainder(b.share - a.share, 1.0), 0.5 * (a.height + b.height));
      }
    for (std::size_t n = 0; n < at.size(); ++n) at[n] = at[sewn_.merged[n]];
    return at;
  }

  void measure(LimbPlacement& result) const {
    for (std::size_t t = 0; t < sewn_.triangles.size(); ++t) {
      const auto& n = sewn_.triangles[t];
      const Eigen::Vector2d stretch = principal_stretches(n, sewn_.flat, result.placed);
      result.least_stretch = std::min(result.least_stretch, stretch[1]), result.largest_stretch = std::max(result.largest_stretch, stretch[0]);
      if (can_start(stretch)) continue;
      throw InputError(spec_.where,
                       fmt::format("the piece {} would be stretched to {:.2f} times its size ({:.2f} across) at height {:.0f} mm", sewn_.pieces[sewn_.triangle_piece[t]],
                                   stretch[0], stretch[1], 1e3 * result.placed[n[0]].z()),
                       "look at the pattern's unit and size (pattern.girth_scale), the position, and which open edge lies lowest (bottom)");
    }
  }

  const SewnMesh& sewn_;
  const input::GarmentSpec& spec_;
  const Limb& limb_;
  double lift_, position_;
  TubeChart chart_;
  Facing facing_;
  std::vector<ChartPlace> places_;  // of the vertices, by representative
  std::vector<char> vertex_;
};

}  // namespace

LimbPlacement place_on_limb(const SewnMesh& sewn, const input::GarmentSpec& spec, const Limb& limb, double lift) {
  return Placement(sewn, spec, limb, lift).take();
}

}  // namespace snug::mesh
