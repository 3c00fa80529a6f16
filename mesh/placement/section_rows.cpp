#include "mesh/placement/section_rows.hpp"

#include <algorithm>
#include <cmath>

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Polyline = std::vector<Vector2d>;

/// Points equally spaced along a way.
template <int count>
Eigen::Matrix<double, 2, count> evenly(const Polyline& way) {
  std::vector<double> length{0.0};
  for (std::size_t n = 1; n < way.size(); ++n) length.push_back(length.back() + (way[n] - way[n - 1]).norm());
  Eigen::Matrix<double, 2, count> result;
  std::size_t piece = 1;
  for (int n = 0; n < count; ++n) {
    const double wanted = length.back() * n / (count - 1);
    while (piece + 1 < way.size() && length[piece] < wanted) ++piece;
    const double step = length[piece] - length[piece - 1];
    const double share = step > 0.0 ? std::clamp((wanted - length[piece - 1]) / step, 0.0, 1.0) : 0.0;
    result.col(n) = way[piece - 1] + share * (way[piece] - way[piece - 1]);
  }
  return result;
}

/// Once round a leg, counter-clockwise from where it is cut towards the other leg from its middle. (Its innermost point
/// would jump from height to height where the leg is flat, at the knee.)
Polyline round_leg(const SectionLoop& leg, Side side) {
  const Polyline& loop = leg.points;
  const std::size_t count = loop.size();
  std::size_t first = 0;
  Vector2d cut = leg.centroid;
  for (std::size_t n = 0; n < count; ++n) {
    const Vector2d &a = loop[n], &b = loop[(n + 1) % count];
    if ((a.y() > leg.centroid.y()) == (b.y() > leg.centroid.y())) continue;
    const Vector2d at = a + (leg.centroid.y() - a.y()) / (b.y() - a.y()) * (b - a);
    if (sign_of(side) * at.x() < sign_of(side) * cut.x()) cut = at, first = (n + 1) % count;
  }
  Polyline way{cut};
  for (std::size_t n = 0; n < count; ++n) way.push_back(loop[(first + n) % count]);
  way.push_back(cut);
  return way;
}

/// Where a counter-clockwise loop goes through the middle plane in front, farthest out: from the right to the left.
std::optional<std::size_t> front_passage(const Polyline& loop) {
  std::optional<std::size_t> front;
  for (std::size_t n = 0; n < loop.size(); ++n) {
    const Vector2d &a = loop[n], &b = loop[(n + 1) % loop.size()];
    if (a.x() > 0.0 && b.x() <= 0.0 && (!front || b.y() > loop[(*front + 1) % loop.size()].y())) front = n;
  }
  return front;
}

Vector2d on_middle(const Vector2d& a, const Vector2d& b) {
  return {0.0, a.y() + a.x() / (a.x() - b.x()) * (b.y() - a.y())};
}

/// The part of a loop on one side, from the front to the back on the left, from the back to the front on the right.
std::optional<Polyline> half_of(const Polyline& loop, Side side) {
  const auto front = front_passage(loop);
  if (!front) return std::nullopt;
  const std::size_t count = loop.size();
  Polyline way{on_middle(loop[*front], loop[(*front + 1) % count])};
  for (std::size_t n = 0; n < count; ++n) {  // counter-clockwise on the left, clockwise on the right
    const Vector2d& p = side == Side::left ? loop[(*front + 1 + n) % count] : loop[(*front + count - n) % count];
    if (n > 0 && sign_of(side) * p.x() <= 0.0) {
      const Vector2d& last = way.back();
      way.push_back(last.x() != p.x() ? on_middle(last, p) : p);
      break;
    }
    way.push_back(p);
  }
  if (side == Side::right) std::reverse(way.begin(), way.end());
  return way;
}

/// The hull of what lies within a distance of the middle plane; sides are cut into short pieces first.
Polyline clipped_hull(const Polyline& loop, double half_width) {
  constexpr double piece = 0.002;  // m
  Polyline inside;
  for (std::size_t n = 0; n < loop.size(); ++n) {
    const Vector2d &a = loop[n], &b = loop[(n + 1) % loop.size()];
    const int pieces = std::max(1, static_cast<int>((b - a).norm() / piece));
    for (int k = 0; k < pieces; ++k) {
      const Vector2d p = a + (b - a) * k / pieces;
      if (std::abs(p.x()) <= half_width) inside.push_back(p);
    }
  }
  return convex_hull(std::move(inside));
}

/// The sections that a garment hangs round: the trunk, or both legs.
Polyline hung_round(const BodySections& sections, const Landmarks& marks, double z) {
  Polyline points;
  if (z >= marks.crotch) {
    if (const auto trunk = sections.trunk(z)) points = trunk->points;
    return points;
  }
  for (const Side side : {Side::right, Side::left})
    if (const auto leg = sections.leg(side, z)) points.insert(points.end(), leg->points.begin(), leg->points.end());
  return convex_hull(std::move(points));
}

}  // namespace

void SectionRows::fill(const BodySections& sections, const Landmarks& marks, GarmentKind kind, double fork,
                       std::size_t row, double half_width) {
  const double z = spacing * static_cast<double>(row);
  const auto set = [&](Side side, const Polyline& way) { rows_[static_cast<int>(side)][row] = evenly<points>(way); };
  if (kind == GarmentKind::legs && z < fork) {
    for (const Side side : {Side::right, Side::left})
      if (const auto leg = sections.leg(side, z)) set(side, round_leg(*leg, side));
    return;
  }
  Polyline loop;
  if (kind == GarmentKind::legs && z >= marks.crotch) {
    if (const auto trunk = sections.trunk(z)) loop = trunk->points;
  } else {
    const bool with_arms = z > marks.armpit - 0.01;
    loop = clipped_hull(hung_round(sections, marks, z), with_arms ? half_width : sections.stature());
  }
  for (const Side side : {Side::right, Side::left})
    if (const auto way = half_of(loop, side)) set(side, *way);
}

/// Landmarks jump from row to row where the skin is flat; a few rounds of (1, 2, 1)/4 over the heights.
void SectionRows::smooth(std::vector<Row>& rows) {
  for (int round = 0; round < 6; ++round) {
    const std::vector<Row> old = rows;
    for (std::size_t n = 1; n + 1 < rows.size(); ++n)
      if (old[n - 1] && old[n] && old[n + 1]) *rows[n] = 0.25 * (*old[n - 1] + *old[n + 1]) + 0.5 * *old[n];
  }
}

std::pair<const SectionRows::Row*, const SectionRows::Row*> SectionRows::around(Side side, double z,
                                                                                double& share) const {
  const std::vector<Row>& rows = rows_[static_cast<int>(side)];
  const auto last = static_cast<int>(rows.size()) - 1;
  const double at = std::clamp(z / spacing, 0.0, static_cast<double>(last));
  int low = std::min(static_cast<int>(at), last - 1), high = low + 1;
  share = at - low;
  const auto found = [&](int n, int step) {
    while (n >= 0 && n <= last && !rows[n]) n += step;
    return n >= 0 && n <= last ? n : -1;
  };
  const int below = found(low, -1), above = found(high, 1);
  low = below >= 0 ? below : above, high = above >= 0 ? above : below;
  if (low < 0) return {nullptr, nullptr};
  return {&rows[low], &rows[high]};
}

Vector3d SectionRows::at(Side side, double z, double share) const {
  double up = 0.0;
  const auto [low, high] = around(side, z, up);
  if (!low) return {0.0, 0.0, z};
  const double at = std::clamp(share, 0.0, 1.0) * (points - 1);
  const int n = std::min(static_cast<int>(at), points - 2);
  const auto on = [&](const Row& row) -> Vector2d { return row->col(n) + (at - n) * (row->col(n + 1) - row->col(n)); };
  const Vector2d p = (1.0 - up) * on(*low) + up * on(*high);
  return {p.x(), p.y(), z};
}

Vector3d SectionRows::beside(Side side, bool front, double z, double distance) const {
  constexpr int samples = 2 * points;
  std::array<Vector3d, samples> way;
  for (int n = 0; n < samples; ++n) way[n] = at(side, z, static_cast<double>(n) / (samples - 1));
  const auto out = [&](const Vector3d& p) { return sign_of(side) * p.x(); };
  const auto outermost =
      std::max_element(way.begin(), way.end(), [&](const Vector3d& a, const Vector3d& b) { return out(a) < out(b); });
  const bool first_part = front == (side == Side::left);
  const auto begin = first_part ? way.begin() : outermost, end = first_part ? outermost + 1 : way.end();
  return *std::min_element(begin, end, [&](const Vector3d& a, const Vector3d& b) {
    return std::abs(out(a) - distance) < std::abs(out(b) - distance);
  });
}

}  // namespace snug::mesh
