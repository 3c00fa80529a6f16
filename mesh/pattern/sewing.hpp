// How the border of the pieces comes together: which stretch of an edge meets which, and what stays open.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesh/pattern/garment_pattern.hpp"

namespace snug::mesh {

/// A stretch of an edge between two corners; at corners stretches begin and end, of their own piece or of what is sewn
/// to it.
struct Stretch {
  EdgePart part;
  int begin = 0, end = 0;  ///< corners, numbered over all pieces
  int next = 0;            ///< the stretch after it on the border of its piece
  int partner = -1;        ///< the stretch it is sewn to, which runs the other way; -1: open
  int seam = -1;
  double length = 0.0;  ///< m
};

/// A closed way along open stretches of the sewn garment, the cloth on its left.
struct OpenLoop {
  std::string
      name;  ///< of the hem that names it; else of its edges, where they share one; else "edge 1", "edge 2", ...
  std::vector<int> stretches;
  /// rad, angle inside the sewn cloth where each of its stretches begins; pi where a hem goes smoothly over a seam.
  std::vector<double> angles;
};

struct Sewing {
  std::vector<Stretch> stretches;  ///< piece by piece, loop by loop, in their order along it
  std::vector<int> corners;        ///< representative of each corner after sewing
  std::vector<OpenLoop> open;
};

/// Two places, one on each side of a seam, that meet: shares of the sides' lengths, of `b` counted from its end.
using Station = std::array<double, 2>;

/// The places of a seam that meet: its ends, notches of one name on both sides, and the ends of every part on either
/// side. The lengths between two of them meet evenly, and so ease is spread. Ends of parts that are less than 5 mm
/// apart (and less than a fiftieth of the seam) meet each other. Throws input::InputError when notches or ends cross.
std::vector<Station> stations(const Pattern& pattern, const Seam& seam);

/// Sews the pattern. Throws input::InputError when a part of an edge is sewn twice or `stations` throws.
Sewing sew(const Pattern& pattern);

/// rad, of the piece of a stretch where it begins.
double cloth_angle(const Pattern& pattern, const Stretch& stretch);

/// What follows a stretch round the corner where it ends, over the seams there: an open stretch. Adds the angles of the
/// cloth that is passed to `angle` (rad).
int next_open(const Pattern& pattern, const Sewing& sewing, int stretch, double& angle);

}  // namespace snug::mesh
