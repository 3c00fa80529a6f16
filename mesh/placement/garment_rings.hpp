// How the pieces of a pattern go round a standing body, told by their seams alone.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mesh/pattern/checks.hpp"
#include "mesh/placement/body_sections.hpp"

namespace snug::mesh {

/// legs: leggings, trousers, where two seams fork into the inseam; shoulders: vest, T-shirt, held by seams that run
/// across on top; tube: neither, skirts and the bodies of vests.
enum class GarmentKind { legs, shoulders, tube };
constexpr auto texts_of(GarmentKind) { return std::array{"legs", "shoulders", "tube"}; }

/// One border of a piece as far as it is sewn to a neighbour round the body: x by y in the drawing.
struct Border {
  std::vector<Eigen::Vector2d> points;  ///< by y, upwards

  bool empty() const { return points.empty(); }
  double bottom() const { return points.front().y(); }
  double top() const { return points.back().y(); }
  /// At a height, m; the value at the nearest end beyond them.
  double at(double y) const;
};

struct RingPiece {
  Border left, right;  ///< as it is drawn, seen from the outside: left comes first on the way round, seen from above
                       ///< counter-clockwise
  double shift =
      0.0;  ///< m, height on the body = y + shift, so that neighbours' seams meet; that of the first piece is 0
  bool front = true;
};

/// A piece, or a half of one, on one half of the body.
struct TrackPiece {
  int piece = 0;
  double from = 0.0, to = 1.0;  ///< shares of its width
};

/// The pieces on the way round one half of the body, in order: on the left from the middle of the front to that of the
/// back, on the right from the back to the front; below the fork once round the leg, from the inseam to the inseam.
using Track = std::vector<TrackPiece>;

struct Strap {
  int piece = 0;
  Eigen::Vector2d middle;  ///< of its side of the seam, in the drawing
};

struct GarmentRings {
  GarmentKind kind = GarmentKind::tube;
  std::vector<RingPiece> pieces;
  std::array<Track, 2> tracks;  ///< by Side
  double fork = 0.0;            ///< legs: height of the fork (y + shift), m
  double hem = 0.0, top = 0.0;  ///< lowest and highest y + shift, m
  double yoke = 0.0;            ///< shoulders: where the sides end in the armholes (y + shift), m
  std::vector<Strap> straps;    ///< shoulders: the seams on top
};

/// Drawings must stand upright. Which half is the front: names with "front" or "back" in them; else, of legs, that with
/// the shorter centre seam, and the half with the first piece. Darts stand in nobody's way. Throws input::InputError
/// with piece and seam where the pieces do not go round the body: a seam that runs up on one side and down on the
/// other, a piece that is not sewn at both sides, sleeves, hoods and others that would need a place of their own.
GarmentRings find_rings(const CheckedPattern& checked);

}  // namespace snug::mesh
