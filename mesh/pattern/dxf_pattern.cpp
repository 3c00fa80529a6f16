#include "mesh/pattern/dxf_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "mesh/pattern/dxf_entities.hpp"
#include "mesh/pattern/interpolating_spline.hpp"

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using input::Diagnostics;
using input::Location;

constexpr double same = 1e-5;  // m
constexpr std::size_t most_marks = 20'000, most_blocks = 1000;
constexpr double near_mark = 1e-4;  // m, turn and curve points beside a vertex

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// The text after "KEY:", if a text begins like that.
std::optional<std::string> value_of(const std::vector<std::string>& texts, const std::string& key) {
  for (const std::string& text : texts) {
    const auto at = upper(text).find(key + ":");
    if (at == std::string::npos) continue;
    std::string value = text.substr(at + key.size() + 1);
    value.erase(0, value.find_first_not_of(" \t"));
    value.erase(value.find_last_not_of(" \t\r") + 1);
    if (!value.empty()) return value;
  }
  return std::nullopt;
}

/// m a unit of the file.
double unit_of(const DxfFile& file, const std::string& name) {
  const std::map<int, double> known = {{1, 0.0254}, {2, 0.3048}, {4, 1e-3}, {5, 1e-2}, {6, 1.0}};
  std::optional<double> by_header, by_text;
  if (const auto found = known.find(file.insert_units); found != known.end()) by_header = found->second;
  std::vector<std::string> texts = file.texts;
  for (const DxfBlock& block : file.blocks) texts.insert(texts.end(), block.texts.begin(), block.texts.end());
  if (const auto units = value_of(texts, "UNITS")) {
    if (upper(*units).starts_with("METRIC")) by_text = 1e-3;
    if (upper(*units).starts_with("ENGLISH") || upper(*units).starts_with("IMPERIAL")) by_text = 0.0254;
  }
  const std::string remedy =
      "write $INSUNITS (1 inches, 4 millimetres, 5 centimetres) or a text \"UNITS: METRIC\" (millimetres) or \"UNITS: "
      "ENGLISH\" (inches)";
  if (!by_header && !by_text) throw input::InputError({.file = name}, "the file does not say its unit", remedy);
  if (by_header && by_text && *by_header != *by_text)
    throw input::InputError({.file = name}, "$INSUNITS and the text UNITS say two units", remedy);
  return by_header ? *by_header : *by_text;
}

DxfPath turned(const DxfPath& path) {
  DxfPath result = path;
  std::reverse(result.points.begin(), result.points.end());
  const std::size_t count = path.points.size();
  for (std::size_t n = 0; n < count; ++n) result.bulges[n] = -path.bulges[(2 * count - 2 - n) % count];
  return result;
}

Span segment(const Vector2d& a, const Vector2d& b, double bulge) {
  if (std::abs(bulge) < 1e-9) return Line{a, b};
  const Vector2d chord = b - a;
  return arc_through(a, 0.5 * (a + b) + 0.5 * bulge * Vector2d(chord.y(), -chord.x()), b);
}

Curve closed_curve(const DxfPath& path) {
  Curve curve;
  for (std::size_t n = 0; n < path.points.size(); ++n)
    curve.spans.push_back(segment(path.points[n], path.points[(n + 1) % path.points.size()], path.bulges[n]));
  return curve;
}

/// One block.
class BlockReading {
 public:
  BlockReading(const DxfBlock& block, double unit, std::string file, Diagnostics& diagnostics)
      : block_(block), unit_(unit), file_(std::move(file)), diagnostics_(diagnostics) {}

  /// Nothing where the block draws no outline. Its name is none of `others`.
  std::optional<Piece> piece(const Pattern& others) {
    const DxfPath* drawn = outline();
    if (!drawn) return std::nullopt;
    piece_.name = piece_name(value_of(block_.texts, "PIECE NAME").value_or(block_.name), others);
    piece_.where = at(block_.line);
    for (const DxfPath& path : block_.paths)
      if (path.layer == "6")
        fault(path.line, "the piece " + piece_.name + " is drawn as a half with a mirror line (layer 6)",
              "unfold it before it is written");
    const auto path = closed(*drawn, "the outline of " + piece_.name);
    if (path) add_outline(swept_area(closed_curve(*path)) < 0.0 ? turned(*path) : *path);
    for (const DxfPath& one : block_.paths) add_path(one);
    add_notches(drawn->layer == "14");
    return std::move(piece_);
  }

 private:
  Location at(int line) const { return {file_, line, 1}; }
  void fault(int line, const std::string& found, const std::string& remedy) {
    diagnostics_.error(at(line), found, remedy);
  }

  std::vector<Vector2d> scaled(const std::vector<Vector2d>& points) const {
    std::vector<Vector2d> result;
    for (const Vector2d& p : points) result.push_back(unit_ * p);
    return result;
  }

  /// The longest polyline on layer 14, else on layer 1.
  const DxfPath* outline() const {
    for (const char* layer : {"14", "1"}) {
      const DxfPath* longest = nullptr;
      for (const DxfPath& path : block_.paths)
        if (path.layer == layer && path.points.size() > 2 && (!longest || path.points.size() > longest->points.size()))
          longest = &path;
      if (longest) return longest;
    }
    return nullptr;
  }

  /// In m, no point twice, its end joined to its beginning; reports a gap.
  std::optional<DxfPath> closed(const DxfPath& drawn, const std::string& what) {
    DxfPath path = drawn;
    path.points.clear(), path.bulges.clear();
    const std::vector<Vector2d> points = scaled(drawn.points);
    for (const Vector2d& p : points)
      if (!(p.cwiseAbs().maxCoeff() < 1e3)) {
        fault(drawn.line, what + " has a point a kilometre away", "see its coordinates and the unit of the file");
        return std::nullopt;
      }
    for (std::size_t n = 0; n < points.size(); ++n)
      if (path.points.empty() || (points[n] - path.points.back()).norm() > same)
        path.points.push_back(points[n]), path.bulges.push_back(drawn.bulges[n]);
      else
        path.bulges.back() = drawn.bulges[n];
    const double gap = (path.points.front() - path.points.back()).norm();
    if (gap <= same) path.points.pop_back(), path.bulges.pop_back();
    if (gap > same && !drawn.closed) {
      fault(drawn.line, fmt::format("{} is open: its ends are {:.1f} mm apart", what, 1e3 * gap),
            "let the polyline end where it begins");
      return std::nullopt;
    }
    if (path.points.size() < 3) {
      fault(drawn.line, what + " has less than three points", "draw it");
      return std::nullopt;
    }
    return path;
  }

  bool marked(const Vector2d& p, const char* layer) const {
    return std::any_of(block_.points.begin(), block_.points.end(), [&](const DxfMark& mark) {
      return mark.layer == layer && (unit_ * mark.place - p).norm() < near_mark;
    });
  }

  /// Vertices at which an edge ends and the next begins.
  std::vector<std::size_t> turns(const DxfPath& path) const {
    const std::size_t count = path.points.size();
    std::vector<std::size_t> by_mark, by_corner;
    for (std::size_t n = 0; n < count; ++n) {
      if (marked(path.points[n], "2")) by_mark.push_back(n);
      const Vector2d in = (path.points[n] - path.points[(n + count - 1) % count]).normalized(),
                     out = (path.points[(n + 1) % count] - path.points[n]).normalized();
      if (in.dot(out) < std::sqrt(0.75)) by_corner.push_back(n);
    }
    if (by_mark.size() >= 2) return by_mark;
    return by_corner.size() >= 2 ? by_corner : std::vector<std::size_t>{0, count / 2};
  }

  void add_outline(const DxfPath& path) {
    const std::vector<std::size_t> ends = turns(path);
    const std::size_t count = path.points.size();
    for (std::size_t e = 0; e < ends.size(); ++e) {
      const std::size_t from = ends[e], length = (ends[(e + 1) % ends.size()] + count - from - 1) % count + 1;
      std::vector<Vector2d> points;
      bool curved = false, bulges = false;
      Curve straight;
      for (std::size_t n = 0; n <= length; ++n) {
        points.push_back(path.points[(from + n) % count]);
        if (n > 0 && n < length) curved = curved || marked(points.back(), "3");
        if (n > 0) straight.spans.push_back(segment(points[n - 1], points[n], path.bulges[(from + n - 1) % count]));
        if (n > 0) bulges = bulges || path.bulges[(from + n - 1) % count] != 0.0;
      }
      piece_.edges.push_back(
          {fmt::format("edge{}", e + 1), curved && !bulges ? cubic_spline(points) : straight, at(path.line)});
    }
    piece_.loops.push_back({0, static_cast<int>(piece_.edges.size())});
  }

  /// Cut-outs, grain, inner lines.
  void add_path(const DxfPath& path) {
    if (piece_.edges.empty() || path.points.size() < 2) return;
    const std::vector<Vector2d> points = scaled(path.points);
    if (path.layer == "7" && (points.back() - points.front()).norm() > same)
      piece_.grain = (points.back() - points.front()).normalized();
    if (path.layer == "8") {
      Curve curve;
      for (std::size_t n = 1; n < points.size(); ++n)
        curve.spans.push_back(segment(points[n - 1], points[n], path.bulges[n - 1]));
      piece_.lines.push_back({fmt::format("line{}", piece_.lines.size() + 1), curve, at(path.line)});
    }
    if (path.layer != "11") return;
    const std::string name = fmt::format("cut-out{}", piece_.loops.size());
    const auto hole = closed(path, "the cut-out of " + piece_.name);
    if (!hole) return;
    const auto begin = static_cast<int>(piece_.edges.size());
    piece_.edges.push_back(
        {name, closed_curve(swept_area(closed_curve(*hole)) > 0.0 ? turned(*hole) : *hole), at(path.line)});
    piece_.loops.push_back({begin, begin + 1, name});
  }

  /// They stand on the cut line: where the sew line is taken they may be as far from it as the allowance.
  void add_notches(bool sew_line) {
    if (piece_.edges.empty()) return;
    const double most = sew_line ? 0.03 : 1e-3;
    for (const DxfMark& mark : block_.points) {
      if (mark.layer != "4") continue;
      const Vector2d place = unit_ * mark.place;
      Notch best{fmt::format("{} notch {}", piece_.name, piece_.notches.size() + 1), 0, 0.0, at(mark.line)};
      double off = 1e9;
      for (int e = 0; e < piece_.loops[0].end; ++e) {
        const ArcLength along(piece_.edges[e].curve);
        const double share = along.nearest(place), one = (along.at(share) - place).norm();
        if (one < off) off = one, best.edge = e, best.share = share;
      }
      if (off > most)
        fault(mark.line, fmt::format("{} stands {:.1f} mm off the outline", best.name, 1e3 * off),
              fmt::format("a notch is at most {:g} mm off", 1e3 * most));
      piece_.notches.push_back(best);
    }
  }

  const DxfBlock& block_;
  double unit_;
  std::string file_;
  Diagnostics& diagnostics_;
  Piece piece_;
};

}  // namespace

Pattern parse_dxf(const std::string& text, const std::string& shown_as) {
  const DxfFile file = read_dxf(text, shown_as);
  const double unit = unit_of(file, shown_as);
  Diagnostics diagnostics;
  Pattern pattern;
  pattern.file = shown_as;
  const auto large = [](const DxfBlock& block) {
    return block.points.size() > most_marks ||
           std::any_of(block.paths.begin(), block.paths.end(),
                       [](const DxfPath& path) { return path.points.size() > most_marks; });
  };
  if (file.blocks.size() > most_blocks || std::any_of(file.blocks.begin(), file.blocks.end(), large))
    throw input::InputError({.file = shown_as}, "more than 1000 blocks, or 20 000 points in one",
                            "write less into one file");
  if (file.scaled_insert > 0)
    diagnostics.error({shown_as, file.scaled_insert, 1}, "a block is inserted in another size",
                      "write blocks in their own size");
  for (const DxfBlock& block : file.blocks)
    if (auto piece = BlockReading(block, unit, shown_as, diagnostics).piece(pattern))
      pattern.pieces.push_back(std::move(*piece));
  if (pattern.pieces.empty())
    diagnostics.error({.file = shown_as}, "no block has an outline",
                      "draw each piece as a block with a polyline on layer 1 (or 14, its sew line)");
  diagnostics.throw_if_any();
  return pattern;
}

}  // namespace snug::mesh
