#include "mesh/pattern/stitch_direction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// That the outlines of two pieces run alike (1) or against each other (-1), and how sure that is.
struct Hint {
  int a = 0, b = 0, alike = 0;
  double weight = 0.0;  ///< 2 and more: by places in space; 1 and more: by lengths; below: by the drawings
  int stitch = 0;
};

const PieceEdge& edge_of(const Pattern& pattern, const EdgePart& part) {
  return pattern.pieces[part.piece].edges[part.edge];
}

Vector3d in_space(const Piece& piece, const Vector2d& p) {
  return piece.place->rotation * Vector3d(p.x(), p.y(), 0.0) + piece.place->translation;
}

/// 1: the sides run together, -1: against each other; by the distances of their ends in space.
std::optional<Hint> by_places(const Pattern& pattern, const Stitch& stitch) {
  const Piece &a = pattern.pieces[stitch.a[0].piece], &b = pattern.pieces[stitch.b[0].piece];
  if (!a.place || !b.place) return std::nullopt;
  const Vector3d a0 = in_space(a, edge_of(pattern, stitch.a.front()).curve.begin()),
                 a1 = in_space(a, edge_of(pattern, stitch.a.back()).curve.end());
  const Vector3d b0 = in_space(b, edge_of(pattern, stitch.b.front()).curve.begin()),
                 b1 = in_space(b, edge_of(pattern, stitch.b.back()).curve.end());
  const double together = (a0 - b0).norm() + (a1 - b1).norm(), against = (a0 - b1).norm() + (a1 - b0).norm();
  const double clear = std::abs(together - against) / (together + against + 1e-9);
  if (clear < 0.05) return std::nullopt;
  return Hint{.alike = together < against ? 1 : -1, .weight = 2.0 + clear};
}

std::optional<Hint> by_lengths(const Pattern& pattern, const Stitch& stitch) {
  const std::size_t count = stitch.a.size();
  if (count < 2 || stitch.b.size() != count) return std::nullopt;
  double together = 0.0, against = 0.0;
  for (std::size_t n = 0; n < count; ++n) {
    const double one = length(pattern, stitch.a[n]);
    together += std::abs(one - length(pattern, stitch.b[n]));
    against += std::abs(one - length(pattern, stitch.b[count - 1 - n]));
  }
  const double whole = length(pattern, stitch.a), less = std::min(together, against),
               more = std::max(together, against);
  if (more < 0.05 * whole || less > 0.3 * more) return std::nullopt;
  return Hint{.alike = together < against ? 1 : -1, .weight = 1.0 + std::min(0.9, more / whole)};
}

std::optional<Hint> by_drawing(const Pattern& pattern, const Stitch& stitch) {
  const auto rise = [&](const EdgeChain& side) {
    const Vector2d chord = edge_of(pattern, side.back()).curve.end() - edge_of(pattern, side.front()).curve.begin();
    return chord.norm() > 0.0 ? chord.normalized().y() : 0.0;
  };
  const double a = rise(stitch.a), b = rise(stitch.b);
  if (std::min(std::abs(a), std::abs(b)) < 0.35) return std::nullopt;
  return Hint{.alike = a * b > 0.0 ? 1 : -1, .weight = 0.9 * std::abs(a * b)};
}

std::vector<Hint> hints(const Pattern& pattern, const std::vector<Stitch>& stitches) {
  std::vector<Hint> result;
  for (std::size_t s = 0; s < stitches.size(); ++s) {
    if (stitches[s].a[0].piece == stitches[s].b[0].piece) continue;  // of one piece: one side runs against the other
    for (const auto& found :
         {by_places(pattern, stitches[s]), by_lengths(pattern, stitches[s]), by_drawing(pattern, stitches[s])}) {
      if (!found) continue;
      Hint hint = *found;
      hint.alike = -hint.alike;  // sides that run together: outlines that run unlike
      hint.a = stitches[s].a[0].piece, hint.b = stitches[s].b[0].piece, hint.stitch = static_cast<int>(s);
      result.push_back(hint);
      break;  // the surest
    }
  }
  std::stable_sort(result.begin(), result.end(), [](const Hint& x, const Hint& y) { return x.weight > y.weight; });
  return result;
}

/// Groups of pieces whose outlines are known against each other.
class Groups {
 public:
  explicit Groups(std::size_t pieces) : group_(pieces), sign_(pieces, 1) {
    for (std::size_t p = 0; p < pieces; ++p) group_[p] = static_cast<int>(p);
  }
  bool same(int a, int b) const { return group_[a] == group_[b]; }
  int alike(int a, int b) const { return sign_[a] * sign_[b]; }
  int group(int piece) const { return group_[piece]; }
  int sign(int piece) const { return sign_[piece]; }
  void join(int a, int b, int alike) {
    const int gone = group_[b], turn = sign_[a] * sign_[b] * alike;
    for (std::size_t p = 0; p < group_.size(); ++p)
      if (group_[p] == gone) group_[p] = group_[a], sign_[p] *= turn;
  }

 private:
  std::vector<int> group_, sign_;
};

bool runs_left(const Piece& piece) { return area(piece) > 0.0; }

/// Whether the side of a placed piece from which its outline runs counter-clockwise looks away from the middle of the
/// garment.
bool looks_out(const Pattern& pattern, const Piece& piece) {
  Vector3d middle = Vector3d::Zero();
  int placed = 0;
  for (const Piece& one : pattern.pieces)
    if (one.place) middle += in_space(one, box(one).center()), ++placed;
  const Vector3d normal = (runs_left(piece) ? 1.0 : -1.0) * piece.place->rotation.col(2);
  return normal.dot(in_space(piece, box(piece).center()) - middle / placed) > 0.0;
}

/// The sign of a whole group: most placed outlines run counter-clockwise seen from the outside, most drawings show the
/// outside. Where as many say the one as the other: outsides look away from the middle, and the first drawing shows it.
int sign_of(const Pattern& pattern, const Groups& groups, int group) {
  int votes = 0, first = 0;
  for (std::size_t p = 0; p < pattern.pieces.size(); ++p) {
    if (groups.group(static_cast<int>(p)) != group) continue;
    const Piece& piece = pattern.pieces[p];
    const int vote = groups.sign(static_cast<int>(p)) * (piece.place || runs_left(piece) ? 1 : -1);
    votes += vote;
    if (first == 0) first = piece.place && !looks_out(pattern, piece) ? -groups.sign(static_cast<int>(p)) : vote;
  }
  return votes > 0 || (votes == 0 && first > 0) ? 1 : -1;
}

[[noreturn]] void refuse_inside_out(const Pattern& pattern, const Stitch& stitch, int piece, int other) {
  throw input::InputError(
      pattern.pieces[piece].where,
      fmt::format("the piece {} is inside out: the stitch {} to {} twists, as its outline runs and as it is placed",
                  pattern.pieces[piece].name, stitch.name, pattern.pieces[other].name),
      "let the edges of every panel run counter-clockwise as seen from the outside of the garment");
}

}  // namespace

std::vector<int> outline_directions(const Pattern& pattern, const std::vector<Stitch>& stitches) {
  Groups groups(pattern.pieces.size());
  const std::vector<Hint> all = hints(pattern, stitches);
  for (const Hint& hint : all)
    if (!groups.same(hint.a, hint.b)) groups.join(hint.a, hint.b, hint.alike);
  std::vector<int> result;
  for (std::size_t p = 0; p < pattern.pieces.size(); ++p) {
    const int piece = static_cast<int>(p);
    result.push_back(groups.sign(piece) * sign_of(pattern, groups, groups.group(piece)));
  }
  for (const Hint& hint : all) {  // a place in space says which way the outline runs
    if (hint.weight < 2.0) continue;
    if (groups.alike(hint.a, hint.b) != hint.alike || result[hint.a] < 0)
      refuse_inside_out(pattern, stitches[hint.stitch], hint.a, hint.b);
    if (result[hint.b] < 0) refuse_inside_out(pattern, stitches[hint.stitch], hint.b, hint.a);
  }
  return result;
}

}  // namespace snug::mesh
