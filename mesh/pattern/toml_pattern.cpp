#include "mesh/pattern/toml_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/input/reader.hpp"
#include "mesh/pattern/checks.hpp"
#include "mesh/pattern/interpolating_spline.hpp"
#include "mesh/pattern/pattern_input.hpp"

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using input::Diagnostics;

std::string kind_text(const EdgeInput& edge) { return input::text_of(edge.kind); }

/// Reports where an edge has not the points that its kind needs.
bool check_points(const EdgeInput& edge, Diagnostics& diagnostics) {
  const std::size_t controls = edge.kind == EdgeKind::quadratic ? 1 : edge.kind == EdgeKind::cubic ? 2 : 0;
  const std::size_t least = edge.kind == EdgeKind::arc || edge.kind == EdgeKind::spline ? 1 : 0;
  const bool through = edge.kind == EdgeKind::spline ? edge.through.size() >= least : edge.through.size() == least;
  if (edge.control.size() != controls)
    diagnostics.error(
        edge.where,
        fmt::format("the edge {} is a {} with {} control points", edge.name, kind_text(edge), edge.control.size()),
        "give a line, an arc and a spline none, a quadratic one, a cubic two: control = [[x, y], ...]");
  if (!through)
    diagnostics.error(
        edge.where,
        fmt::format("the edge {} is a {} through {} points", edge.name, kind_text(edge), edge.through.size()),
        "give an arc one, a spline one or more, other kinds none: through = [[x, y], ...]");
  return edge.control.size() == controls && through;
}

/// Makes curves of edges: lengths in the unit of the file become m.
class Drawing {
 public:
  Drawing(double unit, Diagnostics& diagnostics) : unit_(unit), diagnostics_(diagnostics) {}

  Vector2d point(const PointInput& p) const { return unit_ * Vector2d(p[0], p[1]); }

  Curve curve(const EdgeInput& edge, const PointInput& end) const {
    const Vector2d from = point(edge.from), to = point(edge.to.value_or(end));
    if (!check_points(edge, diagnostics_)) return {{Line{from, to}}};
    switch (edge.kind) {
      case EdgeKind::arc:
        return {{arc_through(from, point(edge.through[0]), to)}};
      case EdgeKind::quadratic:
        return {{Quadratic{from, point(edge.control[0]), to}}};
      case EdgeKind::cubic:
        return {{Cubic{from, point(edge.control[0]), point(edge.control[1]), to}}};
      case EdgeKind::spline:
        return spline(edge, from, to);
      default:
        return {{Line{from, to}}};
    }
  }

  /// A closed border; edges without a name are called after their number.
  void add_loop(const std::vector<EdgeInput>& edges, const std::string& prefix, Piece& piece) const {
    Loop loop;
    loop.begin = static_cast<int>(piece.edges.size()), loop.name = prefix;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const EdgeInput& edge = edges[e];
      const std::string name =
          !edge.name.empty() ? edge.name : fmt::format("{}{}", prefix.empty() ? "edge" : prefix + " edge", e + 1);
      if (name.find_first_of(".[]+\"\n") != std::string::npos)
        diagnostics_.error(edge.where,
                           "the name of the edge " + name + " has a mark that parts of edges are written with",
                           "leave . [ ] + and quotes out of it");
      piece.edges.push_back({name, curve(edge, edges[(e + 1) % edges.size()].from), edge.where});
    }
    loop.end = static_cast<int>(piece.edges.size());
    piece.loops.push_back(loop);
  }

 private:
  Curve spline(const EdgeInput& edge, const Vector2d& from, const Vector2d& to) const {
    std::vector<Vector2d> points{from};
    for (const PointInput& p : edge.through) points.push_back(point(p));
    points.push_back(to);
    for (std::size_t n = 1; n < points.size(); ++n)
      if (const double apart = (points[n] - points[n - 1]).norm(); !(apart > 1e-6 && apart < 1e3)) {
        diagnostics_.error(
            edge.where,
            "the spline " + edge.name + (apart < 1e3 ? " has a point twice" : " has a point a kilometre away"),
            "give points that lie apart, in the unit of the file");
        return {{Line{from, to}}};
      }
    return edge.order == 2 ? quadratic_spline(points) : cubic_spline(points);
  }

  double unit_;
  Diagnostics& diagnostics_;
};

double signed_area(const Piece& piece, const Loop& loop) {
  double sum = 0.0;
  for (int e = loop.begin; e < loop.end; ++e) sum += swept_area(piece.edges[e].curve);
  return sum;
}

/// Holes run clockwise as seen from the outside, whichever way they are drawn; shares of their edges count along that.
void turn_holes(bool from_inside, Piece& piece) {
  for (std::size_t l = 1; l < piece.loops.size(); ++l) {
    const Loop& loop = piece.loops[l];
    if ((signed_area(piece, loop) <= 0.0) != from_inside) continue;
    std::reverse(piece.edges.begin() + loop.begin, piece.edges.begin() + loop.end);
    for (int e = loop.begin; e < loop.end; ++e) piece.edges[e].curve = reversed(piece.edges[e].curve);
  }
}

/// Both as drawn: before the piece is turned over.
void add_notches(const PieceInput& input, const Drawing& drawing, Piece& piece, Diagnostics& diagnostics) {
  for (const NotchInput& notch : input.notches) {
    const int edge = piece.find(notch.edge);
    if (edge < 0) {
      diagnostics.error(
          notch.where,
          fmt::format("the notch {} stands on \"{}\", which is no edge of {}", notch.name, notch.edge, piece.name),
          "name one of its edges");
      continue;
    }
    if (notch.at.has_value() == notch.point.has_value()) {
      diagnostics.error(notch.where,
                        fmt::format("the notch {} has {} place", notch.name, notch.at ? "more than one" : "no"),
                        "write at = 0.5 or point = [x, y]");
      continue;
    }
    const ArcLength along(piece.edges[edge].curve);
    const double share = notch.at ? *notch.at : along.nearest(drawing.point(*notch.point));
    if (notch.point) {
      const double off = (along.at(share) - drawing.point(*notch.point)).norm();
      if (off > 1e-3)
        diagnostics.error(notch.where,
                          fmt::format("the notch {} of {} stands {:.1f} mm off the edge {}", notch.name, piece.name,
                                      1e3 * off, notch.edge),
                          "a notch is at most 1 mm off its edge");
    }
    piece.notches.push_back({notch.name, edge, share, notch.where});
  }
}

void set_grain(const PieceInput& input, const Drawing& drawing, Piece& piece, Diagnostics& diagnostics) {
  if (!input.grain) return;
  const Vector2d along = drawing.point((*input.grain)[1]) - drawing.point((*input.grain)[0]);
  if (along.norm() > 1e-6)
    piece.grain = along.normalized();
  else
    diagnostics.error(input.where, "the grain line of " + piece.name + " has no length",
                      "give two points that lie apart: grain = [[0, 0], [0, 100]]");
}

void add_lines(const PieceInput& input, const Drawing& drawing, Piece& piece, Diagnostics& diagnostics) {
  for (const EdgeInput& line : input.lines) {
    if (!line.to)
      diagnostics.error(line.where, "the inner line " + line.name + " does not say where it ends", "add to = [x, y]");
    else
      piece.lines.push_back({line.name, drawing.curve(line, *line.to), line.where});
  }
}

Piece drawn_piece(const PieceInput& input, const Drawing& drawing, Diagnostics& diagnostics) {
  Piece piece;
  piece.name = input.name, piece.where = input.where;
  if (input.edges.size() < 2)
    diagnostics.error(input.where, fmt::format("the piece {} has {} edges", input.name, input.edges.size()),
                      "give its outline at least two: edges = [{ name = \"hem\", from = [0, 0] }, ...]");
  drawing.add_loop(input.edges, {}, piece);
  for (const HoleInput& hole : input.holes) {
    if (hole.edges.size() < 2)
      diagnostics.error(hole.where, "the hole " + hole.name + " has less than two edges", "give two or more");
    else
      drawing.add_loop(hole.edges, hole.name, piece);
  }
  turn_holes(input.seen_from == SeenFrom::inside, piece);
  set_grain(input, drawing, piece, diagnostics);
  add_lines(input, drawing, piece, diagnostics);
  add_notches(input, drawing, piece, diagnostics);
  return input.seen_from == SeenFrom::inside ? flipped(piece) : piece;
}

/// An image of a piece that stands before it.
Piece mirror_image(const PieceInput& input, const Pattern& pattern, Diagnostics& diagnostics) {
  Piece piece;
  piece.name = input.name, piece.where = input.where;
  const int of = pattern.find(input.mirror_of);
  const bool drawn = !input.edges.empty() || !input.holes.empty() || !input.notches.empty() || !input.darts.empty() ||
                     !input.lines.empty();
  if (of < 0)
    diagnostics.error(input.where, "there is no piece \"" + input.mirror_of + "\" above " + input.name,
                      "mirror_of names a piece that stands before it");
  if (drawn)
    diagnostics.error(input.where, input.name + " is a mirror image and is drawn, too", "leave out one of them");
  if (of < 0 || drawn) return piece;
  piece = turned_round(flipped(pattern.pieces[of]));
  piece.name = input.name, piece.where = input.where, piece.from_inside = false;
  return piece;
}

void add_piece(const PieceInput& input, const Drawing& drawing, Pattern& pattern, Diagnostics& diagnostics) {
  if (input.name.empty() || input.name.find_first_of(".[]+\"\n") != std::string::npos)
    diagnostics.error(input.where, "\"" + input.name + "\" is no name for a piece",
                      "write a name without . [ ] + and quotes");
  Piece piece =
      input.mirror_of.empty() ? drawn_piece(input, drawing, diagnostics) : mirror_image(input, pattern, diagnostics);
  if (input.fabric) piece.fabric = input.fabric;
  pattern.pieces.push_back(std::move(piece));
}

/// Darts are seams; a mirror image has those of its piece.
void add_darts(const std::vector<PieceInput>& pieces, const PieceInput& drawn, const std::string& name,
               Pattern& pattern, Diagnostics& diagnostics) {
  for (std::size_t n = 0; n < drawn.darts.size(); ++n) {
    const DartInput& dart = drawn.darts[n];
    Seam seam;
    seam.name = name + "." + (dart.name.empty() ? fmt::format("dart {}", n + 1) : dart.name);
    seam.where = dart.where;
    seam.a = edge_chain(name + "." + dart.sides[0], pattern, dart.where, diagnostics);
    seam.b = edge_chain(name + "." + dart.sides[1], pattern, dart.where, diagnostics);
    pattern.seams.push_back(seam);
  }
  if (drawn.mirror_of.empty()) return;
  const auto of =
      std::find_if(pieces.begin(), pieces.end(), [&](const PieceInput& p) { return p.name == drawn.mirror_of; });
  if (of != pieces.end() && of->name != drawn.name) add_darts(pieces, *of, name, pattern, diagnostics);
}

void add_seams(const PatternInput& input, Pattern& pattern, Diagnostics& diagnostics) {
  for (const SeamInput& one : input.seams) {
    Seam seam;
    seam.name = one.name.empty() ? one.a + " to " + one.b : one.name;
    seam.a = edge_chain(one.a, pattern, one.where, diagnostics);
    seam.b = edge_chain(one.b, pattern, one.where, diagnostics);
    seam.ease = one.ease, seam.where = one.where;
    pattern.seams.push_back(seam);
  }
  for (const HemInput& one : input.hems)
    pattern.hems.push_back({one.name, edge_chain(one.edges, pattern, one.where, diagnostics), one.where});
}

}  // namespace

Pattern parse_toml_pattern(const std::string& text, const std::string& shown_as,
                           const std::function<Pattern(const std::string&)>& read_drawing) {
  Diagnostics diagnostics;
  const input::Table table = input::parse_text(text, {shown_as, 1, 1}, diagnostics);
  const auto read = diagnostics.any() ? PatternInput{} : input::read<PatternInput>(table, diagnostics);
  diagnostics.throw_if_any();
  Pattern pattern;
  if (!read.drawing.empty()) {
    if (!read_drawing)
      throw input::InputError(table.where_is("drawing"), "a drawing cannot be read here",
                              "name the pieces in this file");
    pattern.pieces = read_drawing(read.drawing).pieces;
  }
  pattern.title = read.title, pattern.file = shown_as, pattern.fabric = read.fabric;
  const Drawing drawing(read.unit, diagnostics);
  for (const PieceInput& piece : read.pieces) add_piece(piece, drawing, pattern, diagnostics);
  check_names(pattern, diagnostics);
  diagnostics.throw_if_any();
  for (const PieceInput& piece : read.pieces) add_darts(read.pieces, piece, piece.name, pattern, diagnostics);
  add_seams(read, pattern, diagnostics);
  diagnostics.throw_if_any();
  return pattern;
}

}  // namespace snug::mesh
