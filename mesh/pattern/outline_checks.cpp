#include "mesh/pattern/outline_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/surface/vectors.hpp"

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using input::Diagnostics;

constexpr double closed = 1e-5, shortest = 1e-5, largest = 20.0;  // m
constexpr double flat = 2e-5;                                     // m, curves against their chords
constexpr std::size_t most_segments = 30'000;                     // each may have to be held against each

/// A chord of an edge.
struct Segment {
  Vector2d a, b;
  int edge = 0, number = 0, loop = 0, of = 0;  ///< number-th of the `of` segments of its loop

  double left() const { return std::min(a.x(), b.x()); }
  double right() const { return std::max(a.x(), b.x()); }
};

std::string place(const Piece& piece, const Vector2d& p) {
  return fmt::format("({:.1f}, {:.1f}) mm", 1e3 * (piece.from_inside ? -p.x() : p.x()), 1e3 * p.y());
}

bool finite(const Piece& piece) {
  for (const PieceEdge& edge : piece.edges)
    for (const Vector2d& point : flattened(edge.curve, 1.0))
      if (!point.allFinite() || point.cwiseAbs().maxCoeff() > 1e3) return false;
  return true;
}

void check_gaps(const Piece& piece, Diagnostics& diagnostics) {
  for (std::size_t e = 0; e < piece.edges.size(); ++e) {
    const PieceEdge &edge = piece.edges[e], &next = piece.edges[piece.next(static_cast<int>(e))];
    const double gap = (edge.curve.end() - next.curve.begin()).norm();
    if (gap > closed)
      diagnostics.error(
          edge.where,
          fmt::format(
              "the outline of {} is open: the edge {} ends at {}, the next one, {}, begins at {}, {:.1f} mm from there",
              piece.name, edge.name, place(piece, edge.curve.end()), next.name, place(piece, next.curve.begin()),
              1e3 * gap),
          "let every edge begin where the one before it ends");
    if (!(ArcLength(edge.curve).length() > shortest))
      diagnostics.error(edge.where, fmt::format("the edge {} of {} has no length", edge.name, piece.name),
                        "leave it out");
  }
}

std::vector<Segment> segments(const Piece& piece) {
  std::vector<Segment> result;
  for (std::size_t l = 0; l < piece.loops.size(); ++l) {
    const std::size_t first = result.size();
    for (int e = piece.loops[l].begin; e < piece.loops[l].end; ++e) {
      std::vector<Vector2d> points = flattened(piece.edges[e].curve, flat);
      points.back() = piece.edges[piece.next(e)].curve.begin();  // a closed gap is none
      for (std::size_t n = 1; n < points.size(); ++n)
        if ((points[n] - points[n - 1]).norm() > 1e-9)
          result.push_back(
              {points[n - 1], points[n], e, static_cast<int>(result.size() - first), static_cast<int>(l), 0});
    }
    for (std::size_t s = first; s < result.size(); ++s) result[s].of = static_cast<int>(result.size() - first);
  }
  return result;
}

/// Where two segments meet, if they do.
std::optional<Vector2d> meeting(const Segment& s, const Segment& t) {
  const Vector2d u = s.b - s.a, v = t.b - t.a, w = t.a - s.a;
  const double det = cross(u, v), scale = u.norm() * v.norm();
  constexpr double off = 1e-9;  // m
  if (std::abs(det) > 1e-9 * scale) {
    const double x = cross(w, v) / det, y = cross(w, u) / det;
    const double ex = off / u.norm(), ey = off / v.norm();
    if (x < -ex || x > 1.0 + ex || y < -ey || y > 1.0 + ey) return std::nullopt;
    return s.a + x * u;
  }
  if (std::abs(cross(w, u)) > off * u.norm()) return std::nullopt;  // parallel
  const double from = std::min(w.dot(u), (t.b - s.a).dot(u)) / u.squaredNorm(),
               to = std::max(w.dot(u), (t.b - s.a).dot(u)) / u.squaredNorm();
  if (to < 0.0 || from > 1.0) return std::nullopt;
  return s.a + 0.5 * (std::max(0.0, from) + std::min(1.0, to)) * u;
}

/// Segments one after the other meet where the one ends; elsewhere only when the border folds back onto itself.
std::optional<Vector2d> crossing(const Segment& s, const Segment& t) {
  const bool neighbours = s.loop == t.loop && (t.number == (s.number + 1) % s.of || s.number == (t.number + 1) % t.of);
  if (!neighbours) {
    const auto at = meeting(s, t);
    // Two curves that leave a corner in one direction may cross as chords, within what chords are off.
    const bool at_corner = at && std::min({(s.a - *at).norm(), (s.b - *at).norm()}) < 5.0 * flat && s.loop == t.loop &&
                           std::min({(s.a - t.b).norm(), (s.b - t.a).norm()}) < 1e-3 && s.edge != t.edge;
    return at_corner ? std::nullopt : at;
  }
  const Vector2d u = (s.b - s.a).normalized(), v = (t.b - t.a).normalized();
  if (u.dot(v) < 0.0 && std::abs(cross(u, v)) < 1e-9 && s.of > 2)
    return (s.b - t.a).norm() < (s.a - t.b).norm() ? s.b : s.a;
  return std::nullopt;
}

void check_crossings(const Piece& piece, Diagnostics& diagnostics) {
  std::vector<Segment> all = segments(piece);
  if (all.size() > most_segments)
    return diagnostics.error(piece.where, fmt::format("the outline of {} has {} chords", piece.name, all.size()),
                             "draw it with fewer edges and points");
  std::sort(all.begin(), all.end(), [](const Segment& s, const Segment& t) { return s.left() < t.left(); });
  int found = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size() && all[j].left() <= all[i].right() + 1e-9 && found < 3; ++j) {
      const auto at = crossing(all[i], all[j]);
      if (!at) continue;
      ++found;
      const PieceEdge &one = piece.edges[std::min(all[i].edge, all[j].edge)],
                      &other = piece.edges[std::max(all[i].edge, all[j].edge)];
      const std::string whom = &one == &other ? "the edge " + one.name + " crosses or touches itself"
                                              : "the edges " + one.name + " and " + other.name + " cross or touch";
      diagnostics.error(other.where,
                        fmt::format("the outline of {} is not simple: {} at {}", piece.name, whom, place(piece, *at)),
                        "draw a border that meets itself nowhere; a dart is two edges that meet at its point");
    }
}

bool inside(const std::vector<Segment>& border, int loop, const Vector2d& point) {
  bool result = false;
  for (const Segment& s : border)
    if (s.loop == loop && (s.a.y() > point.y()) != (s.b.y() > point.y()) &&
        point.x() < s.a.x() + (point.y() - s.a.y()) / (s.b.y() - s.a.y()) * (s.b.x() - s.a.x()))
      result = !result;
  return result;
}

void check_holes(const Piece& piece, Diagnostics& diagnostics) {
  const std::vector<Segment> border = segments(piece);
  for (std::size_t hole = 1; hole < piece.loops.size(); ++hole) {
    const PieceEdge& edge = piece.edges[piece.loops[hole].begin];
    const Vector2d point = edge.curve.begin();
    if (!inside(border, 0, point))
      diagnostics.error(edge.where,
                        fmt::format("the hole {} of {} lies outside the piece, at {}", piece.loops[hole].name,
                                    piece.name, place(piece, point)),
                        "draw it inside the outline, or leave it out");
    for (std::size_t other = 1; other < piece.loops.size(); ++other)
      if (other != hole && inside(border, static_cast<int>(other), point))
        diagnostics.error(edge.where,
                          fmt::format("the hole {} of {} lies in another hole", piece.loops[hole].name, piece.name),
                          "leave it out");
  }
}

void check_direction(const Piece& piece, Diagnostics& diagnostics) {
  double sum = 0.0;
  for (int e = piece.loops[0].begin; e < piece.loops[0].end; ++e) sum += swept_area(piece.edges[e].curve);
  if (sum < 0.0)
    diagnostics.error(piece.where, fmt::format("the piece {} is inside out: its outline runs clockwise", piece.name),
                      "name the edges counter-clockwise as seen from the outside of the garment; a piece that is drawn "
                      "from its inside says seen_from = \"inside\"");
}

}  // namespace

void check_outline(const Piece& piece, Diagnostics& diagnostics) {
  if (!finite(piece))
    return diagnostics.error(piece.where,
                             "the piece " + piece.name + " has points that are no numbers or a kilometre away",
                             "see its coordinates and their unit");
  const std::size_t before = diagnostics.errors().size();
  check_gaps(piece, diagnostics);
  const Eigen::AlignedBox2d extent = box(piece);
  if (extent.sizes().maxCoeff() > largest || extent.sizes().minCoeff() < 1e-3)
    diagnostics.error(piece.where,
                      fmt::format("the piece {} measures {:.4g} mm by {:.4g} mm", piece.name, 1e3 * extent.sizes().x(),
                                  1e3 * extent.sizes().y()),
                      "pieces measure from 1 mm to 20 m; see the unit of the file");
  if (diagnostics.errors().size() > before) return;
  check_crossings(piece, diagnostics);
  if (diagnostics.errors().size() > before) return;
  check_direction(piece, diagnostics);
  check_holes(piece, diagnostics);
}

}  // namespace snug::mesh
