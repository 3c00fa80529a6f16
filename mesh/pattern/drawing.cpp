#include "mesh/pattern/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/pattern/svg_text.hpp"

namespace snug::mesh {

namespace {

using Eigen::Vector2d;

/// Of seam s: hues a golden angle apart, dark enough on white.
std::string colour(int s) {
  return fmt::format("hsl({:.0f},75%,{}%)", std::fmod(205.0 + 137.508 * s, 360.0), s % 2 == 0 ? 42 : 34);
}

std::string whole_millimetres(double length) { return fmt::format("{:.0f} mm", 1e3 * length); }

double distance(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const double share =
      (b - a).squaredNorm() > 0.0 ? std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0) : 0.0;
  return (p - a - share * (b - a)).norm();
}

/// Where a piece has much room around, rather in its middle, and how much (m): on a lattice over its box.
std::pair<Vector2d, double> roomiest(const std::vector<std::vector<Vector2d>>& loops, const Eigen::AlignedBox2d& box) {
  const auto inside = [&](const Vector2d& p) {
    bool in = false;
    for (const auto& loop : loops)
      for (std::size_t n = 0; n < loop.size(); ++n) {
        const Vector2d &a = loop[n], &b = loop[(n + 1) % loop.size()];
        if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
          in = !in;
      }
    return in;
  };
  Vector2d best = box.center();
  double most = -1e9, room_there = 0.0;
  constexpr int cells = 25;
  for (int i = 1; i < cells; ++i)
    for (int j = 1; j < cells; ++j) {
      const Vector2d p = box.min() + box.sizes().cwiseProduct(Vector2d(i, j)) / cells;
      if (!inside(p)) continue;
      double room = 1e9;
      for (const auto& loop : loops)
        for (std::size_t n = 0; n < loop.size(); ++n)
          room = std::min(room, distance(p, loop[n], loop[(n + 1) % loop.size()]));
      const double score = room - 0.25 * (p - box.center()).norm();
      if (score > most) most = score, room_there = room, best = p;
    }
  return {best, room_there};
}

class Drawing {
 public:
  Drawing(const CheckedPattern& checked, const SewnMesh* mesh)
      : checked_(checked), pattern_(checked.pattern), mesh_(mesh) {
    place_pieces();
    text_ = std::clamp(0.016 * std::max(width_, bottom_), 3.0, 18.0);
    margin_ = 3.0 * text_;
  }

  std::string svg() {
    for (std::size_t p = 0; p < pattern_.pieces.size(); ++p) draw_piece(static_cast<int>(p));
    const double list = bottom_ + margin_;
    const double height = draw_list(list);
    const double wide = std::max(width_, 62.0 * text_) + 2.0 * margin_, high = height + 2.0 * margin_;
    const std::string title = pattern_.title.empty() ? "Pattern" : pattern_.title;
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.3f}mm\" height=\"{1:.3f}mm\" viewBox=\"{2:.3f} {2:.3f} "
        "{0:.3f} {1:.3f}\" font-family=\"sans-serif\" "
        "font-size=\"{3:.3f}\">\n<title>{4}</title>\n<rect class=\"paper\" x=\"{2:.3f}\" y=\"{2:.3f}\" "
        "width=\"{0:.3f}\" height=\"{1:.3f}\" fill=\"white\"/>\n{5}</svg>\n",
        wide, high, -margin_, text_, xml_text(title), body_);
  }

 private:
  /// Rows of at most about the shape of a page; (0, 0) is the upper left corner, mm.
  void place_pieces() {
    double total = 0.0, widest = 0.0;
    for (const Piece& piece : pattern_.pieces) {
      boxes_.push_back(box(piece));
      total += 1e6 * (boxes_.back().sizes().x() + 0.04) * (boxes_.back().sizes().y() + 0.04);
      widest = std::max(widest, 1e3 * boxes_.back().sizes().x());
    }
    const double row = std::max(widest, 1.5 * std::sqrt(total));
    double x = 0.0, y = 0.0, high = 0.0;
    for (const Eigen::AlignedBox2d& one : boxes_) {
      const Vector2d size = 1e3 * one.sizes();
      if (x > 0.0 && x + size.x() > row) x = 0.0, y += high + gap, high = 0.0;
      shifts_.emplace_back(x - 1e3 * one.min().x(), y + 1e3 * one.max().y());
      x += size.x() + gap;
      high = std::max(high, size.y());
      width_ = std::max(width_, x - gap);
      bottom_ = std::max(bottom_, y + size.y());
    }
  }

  Vector2d paper(int piece, const Vector2d& p) const {
    return {1e3 * p.x() + shifts_[piece].x(), shifts_[piece].y() - 1e3 * p.y()};
  }

  void draw_piece(int p) {
    const Piece& piece = pattern_.pieces[p];
    body_ += fmt::format(
        "<g class=\"piece\">\n<title>{}</title>\n<path class=\"outline\" id=\"{}\" fill=\"#f7f3ea\" "
        "fill-rule=\"evenodd\" d=\"{}\"/>\n",
        xml_text(piece.name), xml_text(piece.name), outline(p));
    if (mesh_) draw_mesh(p);
    for (const PieceEdge& line : piece.lines)
      body_ += fmt::format(
          "<path class=\"inner\" d=\"M{}{}\" fill=\"none\" stroke=\"#888\" stroke-width=\"{:.3f}\" "
          "stroke-dasharray=\"{:.2f}\"/>\n",
          point(paper(p, line.curve.begin())), path_on(line.curve, shifts_[p]), 0.06 * text_, 0.5 * text_);
    draw_middle(p);
    for (std::size_t s = 0; s < checked_.sewing.stretches.size(); ++s)
      if (checked_.sewing.stretches[s].part.piece == p) draw_stretch(checked_.sewing.stretches[s]);
    for (const Notch& notch : piece.notches) draw_notch(p, notch);
    for (std::size_t e = 0; e < piece.edges.size(); ++e) draw_edge_name(p, static_cast<int>(e));
    for (const Stretch& stretch : checked_.sewing.stretches)
      if (stretch.part.piece == p && stretch.seam >= 0) draw_number(stretch);
    body_ += "</g>\n";
  }

  static std::string point(const Vector2d& p) { return fmt::format(" {:.6f} {:.6f}", p.x(), p.y()); }

  std::string outline(int p) const {
    const Piece& piece = pattern_.pieces[p];
    std::string path;
    for (const Loop& loop : piece.loops) {
      path += (path.empty() ? "M" : " M") + point(paper(p, piece.edges[loop.begin].curve.begin()));
      for (int e = loop.begin; e < loop.end; ++e) path += path_on(piece.edges[e].curve, shifts_[p]);
      path += " Z";
    }
    return path;
  }

  void draw_mesh(int p) {
    std::string path;
    for (std::size_t t = 0; t < mesh_->triangles.size(); ++t) {
      if (mesh_->triangle_piece[t] != p) continue;
      const auto corner = [&](int n) {
        const Vector2d at = paper(p, mesh_->flat[mesh_->triangles[t][n]]);
        return fmt::format("{:.2f} {:.2f}", at.x(), at.y());
      };
      path += fmt::format("M{}L{}L{}Z", corner(0), corner(1), corner(2));
    }
    body_ += fmt::format("<path class=\"mesh\" d=\"{}\" fill=\"none\" stroke=\"#c4b99f\" stroke-width=\"{:.3f}\"/>\n",
                         path, 0.03 * text_);
  }

  /// Name, area and grain where there is room for them.
  void draw_middle(int p) {
    const Piece& piece = pattern_.pieces[p];
    std::vector<std::vector<Vector2d>> loops;
    for (const Loop& loop : piece.loops) {
      loops.emplace_back();
      for (int e = loop.begin; e < loop.end; ++e)
        for (const Vector2d& q : flattened(piece.edges[e].curve, 1e-3)) loops.back().push_back(q);
    }
    const auto [place, space] = roomiest(loops, boxes_[p]);
    const Vector2d middle = paper(p, place);
    if (narrow(p)) {
      body_ += text(middle, xml_text(piece.name), 0.9 * text_, "#222", true);
      return;
    }
    draw_grain(piece, middle, std::min(5.0 * text_, 0.6e3 * space));
    std::string about = fmt::format("{:.0f} cm²", 1e4 * area(piece));
    if (piece.fabric)
      about += ", " + (piece.fabric->name.empty() ? std::string("fabric of its own") : piece.fabric->name);
    const double room = 1.1 * text_;
    body_ += text(middle + Vector2d(0.0, -0.6 * room), xml_text(piece.name), 1.25 * text_, "#222", true);
    body_ += text(middle + Vector2d(0.0, 0.8 * room), xml_text(about), 0.8 * text_, "#555", true);
    if (piece.from_inside)
      body_ += text(middle + Vector2d(0.0, 1.8 * room), "drawn from its inside", 0.7 * text_, "#555", true);
  }

  /// Bands and straps: no room inside for more than the name.
  bool narrow(int p) const { return 1e3 * boxes_[p].sizes().minCoeff() < 5.0 * text_; }

  void draw_grain(const Piece& piece, const Vector2d& middle, double half) {
    const Vector2d along(piece.grain.x(), -piece.grain.y()), across(-along.y(), along.x());
    const Vector2d a = middle - half * along, b = middle + half * along;
    const auto head = [&](const Vector2d& tip, double sign) {
      return fmt::format("M{} L{} L{}", point(tip - sign * 0.7 * text_ * along + 0.3 * text_ * across), point(tip),
                         point(tip - sign * 0.7 * text_ * along - 0.3 * text_ * across));
    };
    body_ += fmt::format(
        "<path class=\"grain\" d=\"M{} L{} {} {}\" fill=\"none\" stroke=\"#999\" stroke-width=\"{:.3f}\"/>\n", point(a),
        point(b), head(a, -1.0), head(b, 1.0), 0.08 * text_);
  }

  std::string text(const Vector2d& at, const std::string& what, double size, const std::string& fill, bool halo,
                   double turn = 0.0) const {
    return fmt::format(
        "<text x=\"{0:.2f}\" y=\"{1:.2f}\" font-size=\"{2:.2f}\" fill=\"{3}\" text-anchor=\"middle\" "
        "dominant-baseline=\"central\"{4}{5}>{6}</text>\n",
        at.x(), at.y(), size, fill,
        halo ? fmt::format(" stroke=\"#f7f3ea\" stroke-width=\"{:.2f}\" paint-order=\"stroke\"", 0.35 * size) : "",
        turn != 0.0 ? fmt::format(" transform=\"rotate({:.2f} {:.2f} {:.2f})\"", turn, at.x(), at.y()) : "", what);
  }

  /// Seams in their colour, open edges in black.
  void draw_stretch(const Stretch& stretch) {
    const EdgePart& part = stretch.part;
    const Curve curve = ArcLength(pattern_.pieces[part.piece].edges[part.edge].curve).between(part.from, part.to);
    const std::string path =
        fmt::format("M{}{}", point(paper(part.piece, curve.begin())), path_on(curve, shifts_[part.piece]));
    body_ += fmt::format(
        "<path class=\"{}\" d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.3f}\" stroke-linecap=\"round\"/>\n",
        stretch.seam < 0 ? "open" : "seam", path, stretch.seam < 0 ? "#222" : colour(stretch.seam),
        (stretch.seam < 0 ? 0.12 : 0.28) * text_);
  }

  /// A place on an edge and the direction into the cloth there, both on paper.
  std::pair<Vector2d, Vector2d> on_edge(int p, int edge, double share) const {
    const ArcLength along(pattern_.pieces[p].edges[edge].curve);
    const Vector2d before = paper(p, along.at(std::max(0.0, share - 0.01))),
                   after = paper(p, along.at(std::min(1.0, share + 0.01)));
    const Vector2d direction =
        (after - before).norm() > 0.0 ? Vector2d((after - before).normalized()) : Vector2d(1.0, 0.0);
    return {paper(p, along.at(share)),
            Vector2d(direction.y(), -direction.x())};  // on the left of the way; y points down
  }

  void draw_notch(int p, const Notch& notch) {
    const auto [at, inwards] = on_edge(p, notch.edge, notch.share);
    body_ +=
        fmt::format("<path class=\"notch\" d=\"M{} L{}\" fill=\"none\" stroke=\"#222\" stroke-width=\"{:.3f}\"/>\n",
                    point(at - 0.2 * text_ * inwards), point(at + 0.8 * text_ * inwards), 0.15 * text_);
  }

  /// Along the edge, inside, of narrow pieces outside; with the length alone where there is no room for the name, and
  /// not at all where there is none for that.
  void draw_edge_name(int p, int edge) {
    const double length = ArcLength(pattern_.pieces[p].edges[edge].curve).length();
    const std::string name = pattern_.pieces[p].edges[edge].name, long_text = name + "  " + whole_millimetres(length),
                      short_text = whole_millimetres(length);
    const double size = 0.8 * text_, room = 1e3 * length - 1.5 * text_;
    const auto fits = [&](const std::string& what) { return 0.55 * size * static_cast<double>(what.size()) < room; };
    if (!fits(short_text)) return;
    const auto [at, inwards] = on_edge(p, edge, 0.5);
    double turn = std::atan2(inwards.x(), -inwards.y()) * 180.0 / std::numbers::pi;
    if (turn > 90.0) turn -= 180.0;
    if (turn < -90.0) turn += 180.0;
    body_ += text(at + (narrow(p) ? -1.0 : 1.0) * text_ * inwards, xml_text(fits(long_text) ? long_text : short_text),
                  size, "#333", true, turn);
  }

  /// The number of the seam, on a disc on a quarter of the stretch, outside.
  void draw_number(const Stretch& stretch) {
    const bool first = stretch.partner < 0 || &stretch < &checked_.sewing.stretches[stretch.partner];
    const double share =
        stretch.part.from + (first ? 0.25 : 0.75) * (stretch.part.to - stretch.part.from);  // they meet
    const Vector2d at = on_edge(stretch.part.piece, stretch.part.edge, share).first;
    if (stretch.length < 1.5e-3 * text_) return;
    body_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\"/>\n", at.x(), at.y(),
                         0.62 * text_, colour(stretch.seam));
    body_ += text(at, std::to_string(stretch.seam + 1), 0.7 * text_, "white", false);
  }

  std::string row(double y, double x, const std::string& what, bool bold = false) const {
    return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.2f}\"{}>{}</text>\n", x, y, 0.85 * text_,
                       bold ? " font-weight=\"bold\"" : "", xml_text(what));
  }

  /// What fits into the list beside the other columns.
  std::string shortened(const std::string& what) const {
    const auto most =
        static_cast<std::size_t>(std::max(40.0, (std::max(width_, 62.0 * text_) - 29.0 * text_) / (0.46 * text_)));
    return what.size() <= most ? what : what.substr(0, most - 2) + " …";
  }

  /// Seams and open edges below the pieces; gives where the list ends.
  double draw_list(double y) {
    const double step = 1.5 * text_;
    for (std::size_t s = 0; s < pattern_.seams.size(); ++s, y += step) {
      const Seam& seam = pattern_.seams[s];
      const double a = length(pattern_, seam.a), b = length(pattern_, seam.b);
      body_ += fmt::format("<circle cx=\"{0:.2f}\" cy=\"{1:.2f}\" r=\"{2:.2f}\" fill=\"{3}\"/>\n", 0.6 * text_,
                           y - 0.3 * text_, 0.62 * text_, colour(static_cast<int>(s)));
      body_ += text({0.6 * text_, y - 0.3 * text_}, std::to_string(s + 1), 0.7 * text_, "white", false);
      body_ += row(y, 1.8 * text_, seam.name, true);
      body_ += row(y, 13.0 * text_,
                   fmt::format("{:.1f} and {:.1f} mm, ease {:.1f} %", 1e3 * a, 1e3 * b, 100.0 * ease(a, b)));
      body_ += row(y, 30.0 * text_, shortened(name_of(pattern_, seam.a) + "  to  " + name_of(pattern_, seam.b)));
    }
    for (const OpenLoop& loop : checked_.sewing.open) {
      double sum = 0.0;
      EdgeChain chain;
      for (const int s : loop.stretches)
        sum += checked_.sewing.stretches[s].length, chain.push_back(checked_.sewing.stretches[s].part);
      body_ += fmt::format("<path d=\"M 0 {0:.2f} h {1:.2f}\" stroke=\"#222\" stroke-width=\"{2:.2f}\"/>\n",
                           y - 0.3 * text_, 1.2 * text_, 0.12 * text_);
      body_ += row(y, 1.8 * text_, loop.name, true) + row(y, 13.0 * text_, fmt::format("{:.1f} mm, open", 1e3 * sum)) +
               row(y, 30.0 * text_, shortened(name_of(pattern_, chain)));
      y += step;
    }
    body_ += fmt::format(
        "<path d=\"M 0 {0:.2f} v {1:.2f} h 100 v -{1:.2f}\" fill=\"none\" stroke=\"#222\" stroke-width=\"{2:.2f}\"/>\n",
        y, 0.4 * text_, 0.08 * text_);
    body_ += row(y + 0.6 * text_, 100.0 + text_, "100 mm");
    return y + step;
  }

  static constexpr double gap = 40.0;  // mm, between pieces
  const CheckedPattern& checked_;
  const Pattern& pattern_;
  const SewnMesh* mesh_;
  std::vector<Eigen::AlignedBox2d> boxes_;
  std::vector<Vector2d> shifts_;  // mm on paper, y down
  double width_ = 0.0, bottom_ = 0.0, text_ = 10.0, margin_ = 0.0;
  std::string body_;
};

}  // namespace

std::string drawing_svg(const CheckedPattern& checked, const SewnMesh* mesh) { return Drawing(checked, mesh).svg(); }

}  // namespace snug::mesh
