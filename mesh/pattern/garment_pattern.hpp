// A sewing pattern: flat pieces, the seams between their edges, and names of what stays open. SI.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/input/diagnostics.hpp"
#include "mesh/pattern/piece.hpp"

namespace snug::mesh {

/// A part of an edge, in its direction.
struct EdgePart {
  int piece = 0, edge = 0;
  double from = 0.0, to = 1.0;  ///< shares of its length, from < to
};

/// One side of a seam or a hem: parts of edges one after the other, each in the direction of its edge. The parts may
/// stand on several pieces, which other seams then join where one part goes over into the next.
using EdgeChain = std::vector<EdgePart>;

/// Two sides become one. Since the outsides of both pieces are to be the garment's outside, one side is walked forwards
/// and the other backwards: the beginning of `a` meets the end of `b`.
struct Seam {
  std::string name;
  EdgeChain a, b;
  /// How much longer one side is meant to be than the other, of the shorter one; left out: whatever is below
  /// `largest_ease`.
  std::optional<double> ease;
  input::Location where = {};
};

/// A name for edges that stay open: a loop of the sewn garment, or a part of one.
struct Hem {
  std::string name;
  EdgeChain edges;
  input::Location where = {};
};

struct Pattern {
  std::string title;
  std::string file;  ///< as shown in messages
  std::optional<input::MaterialEntry> fabric;
  std::vector<Piece> pieces;
  std::vector<Seam> seams;  ///< darts are seams of two edges of one piece
  std::vector<Hem> hems;

  /// Index of a piece by its name, -1: none.
  int find(const std::string& piece) const;
};

/// A name from a file that knows nothing of ours: without the marks that parts of edges are written with, and with a number where
/// another piece has it already.
std::string piece_name(std::string wanted, const Pattern& pattern);

/// "front.side", "front.side[0.2..1]".
std::string name_of(const Pattern& pattern, const EdgePart& part);
/// The parts with " + " between them.
std::string name_of(const Pattern& pattern, const EdgeChain& chain);
/// The parts that a text names ("back.armhole + front.armhole[0..0.4]"). Reports a piece or an edge that is not there,
/// and a share outside [0, 1], at `where`; gives no parts then.
EdgeChain edge_chain(const std::string& text, const Pattern& pattern, const input::Location& where,
                     input::Diagnostics& diagnostics);

double length(const Pattern& pattern, const EdgePart& part);    ///< m
double length(const Pattern& pattern, const EdgeChain& chain);  ///< m
/// How much longer one side is than the other, of the shorter one.
double ease(double one_side, double other_side);

/// Graded by girth and length: every piece is stretched along the x of its drawing by `girth` and along its y by
/// `length`; a place that the file gives moves along. Seams may need other eases then: check again.
Pattern graded(const Pattern& pattern, double girth, double length);

/// The pieces of these names with the seams and hems between them: what the other pieces were sewn to stays open. Throws
/// input::InputError at `where` for a name that is none.
Pattern selected(const Pattern& pattern, const std::vector<std::string>& pieces, const input::Location& where);

}  // namespace snug::mesh
