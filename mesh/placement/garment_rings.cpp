#include "mesh/placement/garment_rings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using input::InputError;

constexpr double chord_tolerance = 2e-4;  // m
constexpr const char* give_places = "give every piece a place of its own (GarmentCode's translation and rotation)";

/// One side of a seam on one piece.
struct SeamSide {
  int seam = 0, piece = 0, partner = 0;
  std::vector<Vector2d> points;  // in the direction of the outline
  bool dart = false;
  bool goes_on = false;  // from the upper end of an upright one

  Vector2d chord() const { return points.back() - points.front(); }
  bool upright() const { return goes_on || std::abs(chord().y()) > std::abs(chord().x()); }
  bool on_right() const { return chord().y() > 0.0; }  // the cloth is on the left of its outline
  double bottom() const { return std::min(points.front().y(), points.back().y()); }
  double top() const { return std::max(points.front().y(), points.back().y()); }
  Vector2d lower_end() const { return on_right() ? points.front() : points.back(); }
  Vector2d upper_end() const { return on_right() ? points.back() : points.front(); }
};

std::set<int> pieces_of(const EdgeChain& chain) {
  std::set<int> result;
  for (const EdgePart& part : chain) result.insert(part.piece);
  return result;
}

std::vector<Vector2d> points_of(const Pattern& pattern, const EdgeChain& chain) {
  std::vector<Vector2d> points;
  for (const EdgePart& part : chain) {
    const ArcLength along(pattern.pieces[part.piece].edges[part.edge].curve);
    const std::vector<Vector2d> more = flattened(along.between(part.from, part.to), chord_tolerance);
    points.insert(points.end(), more.begin() + (points.empty() ? 0 : 1), more.end());
  }
  return points;
}

/// Both sides of every seam. Throws where a side goes over several pieces.
std::vector<SeamSide> seam_sides(const Pattern& pattern) {
  std::vector<SeamSide> sides;
  for (std::size_t s = 0; s < pattern.seams.size(); ++s) {
    const Seam& seam = pattern.seams[s];
    const std::set<int> a = pieces_of(seam.a), b = pieces_of(seam.b);
    if (a.size() != 1 || b.size() != 1)
      throw InputError(
          seam.where,
          fmt::format("the seam {} joins more than two pieces, which cannot be laid round the body", seam.name),
          give_places);
    SeamSide one{static_cast<int>(s), *a.begin(), *b.begin(), points_of(pattern, seam.a)};
    SeamSide other{static_cast<int>(s), *b.begin(), *a.begin(), points_of(pattern, seam.b)};
    const double reach = 1e-6 * one.chord().norm();
    one.dart = other.dart = one.piece == other.piece && ((one.points.back() - other.points.front()).norm() < reach ||
                                                         (one.points.front() - other.points.back()).norm() < reach);
    sides.push_back(std::move(one)), sides.push_back(std::move(other));
  }
  return sides;
}

/// What goes on upwards where an upright seam of the same border ends parts neighbours, too, however flat it lies: the centre seam of shorts with
/// a low waist. A seam on top of a shoulder begins and ends at open edges.
void find_flat_neighbours(std::vector<SeamSide>& sides) {
  for (SeamSide& side : sides) {
    if (side.dart || side.upright()) continue;
    side.goes_on = std::any_of(sides.begin(), sides.end(), [&](const SeamSide& below) {
      return below.piece == side.piece && !below.dart && !below.goes_on && below.upright() && below.on_right() == side.on_right() &&
             (below.upper_end() - side.lower_end()).norm() < 1e-6 * side.chord().norm();
    });
  }
}

/// A seam between neighbours stands upright on both, on the right of one and on the left of the other.
void check_upright(const Pattern& pattern, const std::vector<SeamSide>& sides) {
  for (std::size_t s = 0; s < sides.size(); s += 2) {
    const SeamSide &a = sides[s], &b = sides[s + 1];
    if (a.dart || (a.upright() == b.upright() && a.on_right() != b.on_right())) continue;
    if (!a.upright() && !b.upright()) continue;
    throw InputError(
        pattern.seams[a.seam].where,
        fmt::format("the seam {} stands upright on one of the pieces {} and {} and not on the other",
                    pattern.seams[a.seam].name, pattern.pieces[a.piece].name, pattern.pieces[b.piece].name),
        fmt::format("draw both pieces upright, as they are worn, or {}", give_places));
  }
}

/// The seams round the body.
class Neighbours {
 public:
  Neighbours(const Pattern& pattern, const std::vector<SeamSide>& sides)
      : pattern_(pattern), left_(pattern.pieces.size()), right_(pattern.pieces.size()) {
    for (const SeamSide& side : sides)
      if (side.upright() && !side.dart) (side.on_right() ? right_ : left_)[side.piece].push_back(&side);
    const auto lower = [](const SeamSide* a, const SeamSide* b) {
      return a->bottom() + a->top() < b->bottom() + b->top();
    };
    for (auto* borders : {&left_, &right_})
      for (auto& border : *borders) std::sort(border.begin(), border.end(), lower);
    for (std::size_t p = 0; p < pattern.pieces.size(); ++p)
      if (left_[p].empty() || right_[p].empty())
        throw InputError(
            pattern.pieces[p].where,
            fmt::format("the piece {} is not sewn to a neighbour at its {} border and does not go round the body",
                        pattern.pieces[p].name, left_[p].empty() ? "left" : "right"),
            give_places);
  }

  const std::vector<const SeamSide*>& left(int piece) const { return left_[piece]; }
  const std::vector<const SeamSide*>& right(int piece) const { return right_[piece]; }
  /// Where two seams to different neighbours meet on the right border.
  bool forks(int piece) const {
    const auto& seams = right_[piece];
    return seams.size() > 1 && seams.front()->partner != seams.back()->partner;
  }
  /// The pieces one after the other, by the uppermost seam of each.
  std::vector<int> ring() const {
    std::vector<int> result{0};
    for (int next = right_[0].back()->partner; next != 0; next = right_[next].back()->partner) {
      result.push_back(next);
      if (result.size() > right_.size()) refuse(next);
    }
    if (result.size() != right_.size()) {
      for (std::size_t p = 0; p < right_.size(); ++p)
        if (std::find(result.begin(), result.end(), p) == result.end()) refuse(static_cast<int>(p));
    }
    return result;
  }

 private:
  [[noreturn]] void refuse(int piece) const {
    throw InputError(
        pattern_.pieces[piece].where,
        fmt::format("the piece {} stands beside the ring of pieces that goes round the body: sleeves, hoods and "
                    "pockets cannot be laid out without places",
                    pattern_.pieces[piece].name),
        give_places);
  }

  const Pattern& pattern_;
  std::vector<std::vector<const SeamSide*>> left_, right_;  // by piece, from the lowest
};

Border border_of(const std::vector<const SeamSide*>& seams) {
  Border border;
  for (const SeamSide* side : seams) {
    std::vector<Vector2d> points = side->points;
    if (!side->on_right()) std::reverse(points.begin(), points.end());
    for (const Vector2d& p : points)  // a border that turns back is cut where it does
      if (border.empty() || p.y() > border.top()) border.points.push_back(p);
  }
  return border;
}

/// Shifts of the heights by which neighbours' seams meet, from the first piece on.
void set_shifts(const Neighbours& neighbours, std::vector<RingPiece>& pieces) {
  std::vector<char> known(pieces.size(), 0);
  std::vector<int> waiting{0};
  known[0] = 1;
  const auto middle = [](const SeamSide& side) { return 0.5 * (side.bottom() + side.top()); };
  while (!waiting.empty()) {
    const int piece = waiting.back();
    waiting.pop_back();
    for (const SeamSide* side : neighbours.right(piece)) {
      if (known[side->partner]) continue;
      for (const SeamSide* other : neighbours.left(side->partner))
        if (other->seam == side->seam)
          pieces[side->partner].shift = pieces[piece].shift + middle(*side) - middle(*other);
      known[side->partner] = 1;
      waiting.push_back(side->partner);
    }
  }
}

bool named(const Piece& piece, const char* word) { return piece.name.find(word) != std::string::npos; }

/// Turns the ring so that it begins with the front.
std::vector<int> from_front(std::vector<int> ring, const std::vector<RingPiece>& pieces) {
  for (std::size_t n = 0; n < ring.size(); ++n) {
    if (pieces[ring.front()].front && !pieces[ring.back()].front) break;
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());
  }
  return ring;
}

/// By names. Without names the first piece is in front, and on the way round the front goes over into the back where
/// neighbours are joined on top, too; without such seams half way.
void set_fronts(const Pattern& pattern, const std::vector<int>& ring, const std::vector<SeamSide>& sides,
                std::vector<RingPiece>& pieces) {
  const bool names = std::any_of(pattern.pieces.begin(), pattern.pieces.end(),
                                 [](const Piece& piece) { return named(piece, "front") || named(piece, "back"); });
  std::set<std::pair<int, int>> strapped;
  for (const SeamSide& side : sides)
    if (!side.upright() && !side.dart) strapped.insert({side.piece, side.partner});
  bool front = true;
  for (std::size_t n = 0; n < ring.size(); ++n) {
    if (n > 0 && strapped.contains({ring[n - 1], ring[n]})) front = !front;
    pieces[ring[n]].front = names              ? !named(pattern.pieces[ring[n]], "back")
                            : strapped.empty() ? 2 * n < ring.size()
                                               : front;
  }
}

/// A run of pieces from its beginning to its middle, or from its middle to its end.
void add_half(const std::vector<int>& run, bool first, Track& track) {
  const std::size_t half = run.size() / 2;
  const bool odd = run.size() % 2 == 1;
  if (first) {
    for (std::size_t n = 0; n < half; ++n) track.push_back({run[n]});
    if (odd) track.push_back({run[half], 0.0, 0.5});
    return;
  }
  if (odd) track.push_back({run[half], 0.5, 1.0});
  for (std::size_t n = half + (odd ? 1 : 0); n < run.size(); ++n) track.push_back({run[n]});
}

/// The way round seen from above counter-clockwise: front, wearer's left, back, right.
void split_at_middles(const Pattern& pattern, const std::vector<int>& ring, GarmentRings& rings) {
  std::vector<int> front, back;
  for (const int piece : ring) {
    if (rings.pieces[piece].front && !back.empty())
      throw InputError(pattern.pieces[piece].where,
                       fmt::format("the pieces of the front do not lie side by side: {} is beyond the back",
                                   pattern.pieces[piece].name),
                       "name the pieces of the front \"front...\", those of the back \"back...\"");
    (rings.pieces[piece].front ? front : back).push_back(piece);
  }
  Track &right = rings.tracks[0], &left = rings.tracks[1];
  add_half(front, false, left), add_half(back, true, left);
  add_half(back, false, right), add_half(front, true, right);
}

/// Legs: the two forking seams are the middles; between them lie the pieces of one leg.
void split_at_forks(const Pattern& pattern, const Neighbours& neighbours, const std::vector<int>& ring,
                    GarmentRings& rings) {
  std::vector<std::size_t> forks;
  for (std::size_t n = 0; n < ring.size(); ++n)
    if (neighbours.forks(ring[n])) forks.push_back(n);
  if (forks.size() != 2)
    throw InputError(pattern.pieces[ring[0]].where,
                     fmt::format("{} centre seams fork into an inseam, not two", forks.size()), give_places);
  const auto run = [&](std::size_t after, std::size_t last) {
    Track track;
    for (std::size_t n = (after + 1) % ring.size();; n = (n + 1) % ring.size()) {
      track.push_back({ring[n]});
      if (n == last) return track;
    }
  };
  const auto centre = [&](std::size_t n) { return neighbours.right(ring[n]).back(); };
  const auto rise = [&](std::size_t n) { return centre(n)->chord().norm(); };
  const auto votes = [&](std::size_t n) {  // that the seam is in front
    const Piece &one = pattern.pieces[ring[n]], &other = pattern.pieces[centre(n)->partner];
    return named(one, "front") + named(other, "front") - named(one, "back") - named(other, "back");
  };
  std::size_t front = forks[0], back = forks[1];
  if (votes(front) < votes(back) || (votes(front) == votes(back) && rise(front) > rise(back))) std::swap(front, back);
  rings.tracks[1] = run(front, back);
  rings.tracks[0] = run(back, front);
  const RingPiece& piece = rings.pieces[ring[front]];
  rings.fork = centre(front)->lower_end().y() + piece.shift;
  for (const auto& [side, toward] : {std::pair(&rings.tracks[1], true), std::pair(&rings.tracks[0], false)})
    for (std::size_t n = 0; n < side->size(); ++n)
      rings.pieces[(*side)[n].piece].front = (2 * n < side->size()) == toward;
}

/// Where the front meets the back in the armholes, and the seams on top.
void set_shoulders(const Neighbours& neighbours, const std::vector<SeamSide>& sides, GarmentRings& rings) {
  rings.yoke = std::numeric_limits<double>::max();
  for (std::size_t p = 0; p < rings.pieces.size(); ++p)
    for (const SeamSide* side : neighbours.right(static_cast<int>(p)))
      if (rings.pieces[side->partner].front != rings.pieces[p].front)
        rings.yoke = std::min(rings.yoke, side->top() + rings.pieces[p].shift);
  for (const SeamSide& side : sides) {
    if (side.upright() || side.dart || rings.pieces[side.piece].front == rings.pieces[side.partner].front) continue;
    rings.straps.push_back({side.piece, 0.5 * (side.points.front() + side.points.back())});
  }
}

void set_extent(const Pattern& pattern, GarmentRings& rings) {
  rings.hem = std::numeric_limits<double>::max(), rings.top = std::numeric_limits<double>::lowest();
  for (std::size_t p = 0; p < rings.pieces.size(); ++p) {
    const Eigen::AlignedBox2d extent = box(pattern.pieces[p]);
    rings.hem = std::min(rings.hem, extent.min().y() + rings.pieces[p].shift);
    rings.top = std::max(rings.top, extent.max().y() + rings.pieces[p].shift);
  }
}

}  // namespace

double Border::at(double y) const {
  if (y <= bottom()) return points.front().x();
  if (y >= top()) return points.back().x();
  const auto above =
      std::upper_bound(points.begin(), points.end(), y, [](double value, const Vector2d& p) { return value < p.y(); });
  const Vector2d &a = *(above - 1), &b = *above;
  return a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

GarmentRings find_rings(const CheckedPattern& checked) {
  const Pattern& pattern = checked.pattern;
  std::vector<SeamSide> sides = seam_sides(pattern);
  find_flat_neighbours(sides);
  check_upright(pattern, sides);
  const Neighbours neighbours(pattern, sides);
  std::vector<int> ring = neighbours.ring();
  GarmentRings rings;
  for (std::size_t p = 0; p < pattern.pieces.size(); ++p)
    rings.pieces.push_back(
        {border_of(neighbours.left(static_cast<int>(p))), border_of(neighbours.right(static_cast<int>(p)))});
  set_shifts(neighbours, rings.pieces);
  set_extent(pattern, rings);
  if (std::any_of(ring.begin(), ring.end(), [&](int piece) { return neighbours.forks(piece); })) {
    rings.kind = GarmentKind::legs;
    split_at_forks(pattern, neighbours, ring, rings);
    return rings;
  }
  set_fronts(pattern, ring, sides, rings.pieces);
  ring = from_front(std::move(ring), rings.pieces);
  split_at_middles(pattern, ring, rings);
  set_shoulders(neighbours, sides, rings);
  rings.kind = rings.straps.empty() ? GarmentKind::tube : GarmentKind::shoulders;
  return rings;
}

}  // namespace snug::mesh
