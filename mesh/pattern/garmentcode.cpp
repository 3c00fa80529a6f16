#include "mesh/pattern/garmentcode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "mesh/pattern/json_values.hpp"
#include "mesh/pattern/stitch_direction.hpp"

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using input::Diagnostics;
using input::Table;
using input::Value;

/// What a name may not hold, because parts of edges are written with it.
std::string plain(std::string name) {
  for (char& c : name)
    if (std::string(".[]+\"\n").find(c) != std::string::npos) c = '_';
  return name;
}

Vector2d relative(const Vector2d& from, const Vector2d& to, const Vector2d& control) {
  const Vector2d edge = to - from;
  return from + control.x() * edge + control.y() * Vector2d(-edge.y(), edge.x());
}

constexpr std::size_t most_panels = 1000, most_edges = 2000, most_stitches = 5000;

/// Reads one file; everything is reported and read on.
class Reading {
 public:
  Reading(const Table& root, std::string file, Diagnostics& diagnostics) : root_(root), diagnostics_(diagnostics) {
    pattern_.file = std::move(file);
  }

  Pattern pattern() {
    if (const Value* title = root_.find("title"); title && title->text()) pattern_.title = *title->text();
    const Table* pattern = root_.table("pattern");
    if (!pattern)
      fault(root_.where, "there is no \"pattern\"", "a pattern of GarmentCode has it with panels and stitches");
    read_properties(pattern);
    const Table* panels = pattern ? pattern->table("panels") : nullptr;
    if (pattern && !panels) fault(pattern->where, "there are no \"panels\"", "add them, each with vertices and edges");
    if (panels)
      for (const input::Entry& panel : panels->entries) read_panel(panel);
    if (pattern) read_stitches(*pattern);
    diagnostics_.throw_if_any();
    orient();
    return std::move(pattern_);
  }

 private:
  void fault(const input::Location& where, const std::string& found, const std::string& remedy) {
    diagnostics_.error(where, found, remedy);
  }

  void read_properties(const Table* pattern) {
    const Table* properties = root_.table("properties");
    if (!properties && pattern) properties = pattern->table("properties");
    const Value* units = root_.find("units_in_meter");
    if (!units && properties) units = properties->find("units_in_meter");
    double storage = 0.0;
    const double* number = units ? units->number(storage) : nullptr;
    if (number && *number > 0.0 && std::isfinite(*number))
      unit_ = 1.0 / *number;
    else
      fault(units ? units->where : root_.where, "the file does not say its unit",
            "add \"units_in_meter\": 100 to its properties (centimetres)");
    if (!properties) return;
    if (const Value* coords = properties->find("curvature_coords"); coords && coords->text())
      absolute_ = *coords->text() == "absolute";
    if (const Value* seen = properties->find("seen_from_outside"))
      if (const bool* flag = std::get_if<bool>(&seen->data)) seen_from_outside_ = *flag;
  }

  /// `count` numbers in a list.
  std::optional<std::vector<double>> numbers(const Value* value, const input::Location& where, const std::string& what,
                                             std::size_t count) {
    const auto* items = value ? value->array() : nullptr;
    std::vector<double> result;
    if (items)
      for (const Value& item : *items) {
        double storage = 0.0;
        if (const bool* flag = std::get_if<bool>(&item.data))
          result.push_back(*flag ? 1.0 : 0.0);
        else if (const double* number = item.number(storage); number && std::abs(*number) < 1e9)
          result.push_back(*number);
      }
    if (items && items->size() == count && result.size() == count) return result;
    fault(value ? value->where : where, what + " is no list of " + std::to_string(count) + " numbers",
          "give " + std::to_string(count) + " numbers in [brackets]");
    return std::nullopt;
  }

  void read_panel(const input::Entry& entry) {
    if (pattern_.pieces.size() == most_panels) fault(entry.where, "more than 1000 panels", "write less into one file");
    if (pattern_.pieces.size() >= most_panels) return;
    const Table* table = entry.value.table();
    if (!table)
      return fault(entry.where, "the panel " + entry.key + " is " + entry.value.description(),
                   "give it vertices and edges");
    Piece piece;
    piece.name = plain(entry.key), piece.where = entry.where;
    if (pattern_.find(piece.name) >= 0)
      fault(entry.where, "the panel " + piece.name + " stands twice", "give it a name of its own");
    const std::vector<Vector2d> vertices = read_vertices(*table, piece.name);
    const Value* edges = table->find("edges");
    if (!edges || !edges->array() || edges->array()->size() < 2 || edges->array()->size() > most_edges)
      fault(edges ? edges->where : entry.where, "the panel " + piece.name + " has no edges, or too many",
            "give it 2 to 2000");
    else
      read_edges(*edges->array(), vertices, piece);
    piece.loops.push_back({0, static_cast<int>(piece.edges.size())});
    read_place(*table, piece);
    pattern_.pieces.push_back(std::move(piece));
  }

  std::vector<Vector2d> read_vertices(const Table& table, const std::string& panel) {
    std::vector<Vector2d> result;
    const Value* vertices = table.find("vertices");
    if (!vertices || !vertices->array()) {
      fault(table.where, "the panel " + panel + " has no vertices", "give them as [[x, y], ...]");
      return result;
    }
    for (const Value& vertex : *vertices->array()) {
      const auto xy = numbers(&vertex, vertex.where, "a vertex of " + panel, 2);
      result.push_back(xy ? Vector2d(unit_ * (*xy)[0], unit_ * (*xy)[1]) : Vector2d(0.0, 0.0));
    }
    return result;
  }

  void read_edges(const std::vector<Value>& edges, const std::vector<Vector2d>& vertices, Piece& piece) {
    std::set<std::string> names;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const Table* table = edges[e].table();
      const Value* ends = table ? table->find("endpoints") : nullptr;
      const auto pair = numbers(ends, edges[e].where, "\"endpoints\" of an edge of " + piece.name, 2);
      if (!pair) continue;
      const auto exists = [&](double n) {
        return n >= 0.0 && n < static_cast<double>(vertices.size()) && n == std::floor(n);
      };
      if (!exists((*pair)[0]) || !exists((*pair)[1])) {
        fault(edges[e].where,
              fmt::format("an edge of {} goes from vertex {:g} to {:g}, of {}", piece.name, (*pair)[0], (*pair)[1],
                          vertices.size()),
              "vertices count from 0");
        continue;
      }
      std::string name = edge_name(*table, e);
      if (!names.insert(name).second) names.insert(name = fmt::format("{} {}", name, e));
      piece.edges.push_back({name,
                             curve(*table, vertices[static_cast<std::size_t>((*pair)[0])],
                                   vertices[static_cast<std::size_t>((*pair)[1])]),
                             edges[e].where});
    }
    if (piece.edges.size() != edges.size()) piece.edges.clear();  // has been reported
  }

  /// Its label, else the names of its ends, else its number.
  static std::string edge_name(const Table& edge, std::size_t number) {
    if (const Value* label = edge.find("label"); label && label->text() && !label->text()->empty())
      return plain(*label->text());
    if (const Value* ends = edge.find("names"); ends && ends->array() && ends->array()->size() == 2)
      if (const auto* a = (*ends->array())[0].text(), *b = (*ends->array())[1].text(); a && b)
        return plain(*a + "-" + *b);
    return fmt::format("edge{}", number);
  }

  Curve curve(const Table& edge, const Vector2d& from, const Vector2d& to) {
    const Value* curvature = edge.find("curvature");
    if (!curvature) return {{Line{from, to}}};
    if (curvature->array()) return {{quadratic(curvature, edge.where, from, to)}};  // the older way
    const Table* table = curvature->table();
    const Value *type = table ? table->find("type") : nullptr, *params = table ? table->find("params") : nullptr;
    const std::string kind = type && type->text() ? *type->text() : std::string();
    const std::vector<Value> none, &points = params && params->array() ? *params->array() : none;
    if (kind == "circle") return {{circle(params, curvature->where, from, to)}};
    if (kind == "quadratic" && points.size() == 1) return {{quadratic(&points[0], curvature->where, from, to)}};
    if (kind == "cubic" && points.size() == 2) {
      const auto first = control(&points[0], curvature->where, from, to),
                 second = control(&points[1], curvature->where, from, to);
      return {{Cubic{from, first, second, to}}};
    }
    fault(curvature->where, "a curvature of \"" + kind + fmt::format("\" with {} params", points.size()),
          "write \"quadratic\" with one control point, \"cubic\" with two, or \"circle\" with radius, large arc and "
          "right");
    return {{Line{from, to}}};
  }

  Vector2d control(const Value* value, const input::Location& where, const Vector2d& from, const Vector2d& to) {
    const auto xy = numbers(value, where, "a control point", 2);
    if (!xy) return from;
    return absolute_ ? Vector2d(unit_ * (*xy)[0], unit_ * (*xy)[1]) : relative(from, to, {(*xy)[0], (*xy)[1]});
  }
  Span quadratic(const Value* value, const input::Location& where, const Vector2d& from, const Vector2d& to) {
    return Quadratic{from, control(value, where, from, to), to};
  }

  /// Radius, large arc, right: the arc bulges to the right of the edge and so turns left on its way.
  Span circle(const Value* params, const input::Location& where, const Vector2d& from, const Vector2d& to) {
    const auto three = numbers(params, where, "\"params\" of a circle", 3);
    if (!three) return Line{from, to};
    const double radius = unit_ * (*three)[0], half = 0.5 * (to - from).norm();
    if (!(radius >= half * (1.0 - 1e-6)) || !(half > 0.0)) {
      fault(where, fmt::format("a circle of radius {:g} over a chord of {:g}", (*three)[0], 2.0 * half / unit_),
            "the radius is at least half the chord");
      return Line{from, to};
    }
    return arc_of_radius(from, to, radius, (*three)[1] != 0.0, (*three)[2] != 0.0);
  }

  void read_place(const Table& table, Piece& piece) {
    const Value *translation = table.find("translation"), *rotation = table.find("rotation");
    if (!translation && !rotation) return;
    const auto t = numbers(translation, table.where, "\"translation\" of " + piece.name, 3),
               r = numbers(rotation, table.where, "\"rotation\" of " + piece.name, 3);
    if (!t || !r) return;
    constexpr double degree = std::numbers::pi / 180.0;
    const auto about = [](double angle, const Vector3d& axis) {
      return Eigen::AngleAxisd(angle * degree, axis).toRotationMatrix();
    };
    piece.place = GivenPlace{
        about((*r)[2], Vector3d::UnitZ()) * about((*r)[1], Vector3d::UnitY()) * about((*r)[0], Vector3d::UnitX()),
        unit_ * Vector3d((*t)[0], (*t)[1], (*t)[2])};
  }

  void read_stitches(const Table& pattern) {
    const Value* stitches = pattern.find("stitches");
    if (!stitches) return;
    if (!stitches->array()) return fault(stitches->where, "\"stitches\" is " + stitches->description(), "give a list");
    if (stitches->array()->size() > most_stitches)
      return fault(stitches->where, "more than 5000 stitches", "write less into one file");
    for (const Value& stitch : *stitches->array()) read_stitch(stitch);
  }

  void read_stitch(const Value& value) {
    Stitch stitch;
    stitch.where = value.where, stitch.name = fmt::format("stitch{}", stitches_.size());
    const Value *a = nullptr, *b = nullptr;
    if (const auto* sides = value.array(); sides && sides->size() >= 2) {
      a = &(*sides)[0], b = &(*sides)[1];
      if (sides->size() > 2 && (*sides)[2].text() && *(*sides)[2].text() == "right_wrong")
        return fault(value.where, "a stitch of the outside to the inside",
                     "both outsides of a seam are those of the garment; turn one of the panels");
    } else if (const Table* table = value.table()) {
      a = table->find("a"), b = table->find("b");
      if (const Value* label = table->find("label"); label && label->text()) stitch.name = plain(*label->text());
    }
    if (!a || !b)
      return fault(value.where, "a stitch is " + value.description(),
                   "give two sides: [{ \"panel\": ..., \"edge\": ... }, { ... }]");
    if (read_side(*a, stitch.a) && read_side(*b, stitch.b)) stitches_.push_back(stitch);
  }

  bool read_side(const Value& value, EdgeChain& side) {
    const Table* table = value.table();
    const Value *panel = table ? table->find("panel") : nullptr, *edges = table ? table->find("edges") : nullptr,
                *edge = table ? table->find("edge") : nullptr;
    const int piece = panel && panel->text() ? pattern_.find(plain(*panel->text())) : -1;
    if (piece < 0) {
      fault(value.where,
            "a stitch names " + (panel && panel->text() ? "the panel \"" + *panel->text() + "\", which is not there"
                                                        : std::string("no panel")),
            "name one of the panels");
      return false;
    }
    std::vector<const Value*> numbers;
    if (edges && edges->array())
      for (const Value& one : *edges->array()) numbers.push_back(&one);
    else if (edge)
      numbers.push_back(edge);
    const auto count = static_cast<long long>(pattern_.pieces[piece].edges.size());
    for (const Value* number : numbers) {
      const auto* n = std::get_if<long long>(&number->data);
      if (!n || *n < 0 || *n >= count) {
        if (count > 0)
          fault(number->where,
                fmt::format("a stitch names {} as an edge of {}, which has {}", number->description(),
                            pattern_.pieces[piece].name, count),
                "edges count from 0");
        return false;
      }
      side.push_back({piece, static_cast<int>(*n)});
    }
    if (side.empty()) fault(value.where, "a stitch names no edge of " + pattern_.pieces[piece].name, "add \"edge\": 0");
    return !side.empty() && in_order(value, side);
  }

  /// The edges of a side in the order of the panel.
  bool in_order(const Value& value, EdgeChain& side) {
    const Piece& piece = pattern_.pieces[side[0].piece];
    const auto follow = [&] {
      for (std::size_t n = 1; n < side.size(); ++n)
        if (piece.next(side[n - 1].edge) != side[n].edge) return false;
      return true;
    };
    if (follow()) return true;
    std::reverse(side.begin(), side.end());
    if (follow()) return true;
    fault(value.where, "the edges of a stitch do not follow each other on " + piece.name,
          "name edges that do, or make several stitches");
    return false;
  }

  /// Every piece as seen from the outside, its outline counter-clockwise; then seams by the names of the edges.
  void orient() {
    for (const Piece& piece : pattern_.pieces)
      for (std::size_t e = 0; e < piece.edges.size(); ++e)
        if ((piece.edges[e].curve.end() - piece.edges[piece.next(static_cast<int>(e))].curve.begin()).norm() > 1e-9)
          fault(piece.edges[e].where,
                fmt::format("the outline of {} is open after {}", piece.name, piece.edges[e].name),
                "let each edge begin at the vertex where the one before it ends");
    diagnostics_.throw_if_any();
    std::vector<int> listed(pattern_.pieces.size(), 1);
    if (!seen_from_outside_) listed = outline_directions(pattern_, stitches_);
    std::vector<std::vector<std::string>> names;
    for (const Piece& piece : pattern_.pieces) {
      names.emplace_back();
      for (const PieceEdge& edge : piece.edges) names.back().push_back(edge.name);
    }
    for (std::size_t p = 0; p < pattern_.pieces.size(); ++p) {
      Piece& piece = pattern_.pieces[p];
      if ((area(piece) > 0.0 ? 1 : -1) != listed[p]) piece = flipped(piece);
      if (listed[p] < 0) piece = turned_round(piece);
    }
    const auto side = [&](EdgeChain chain) {
      const int piece = chain[0].piece;
      if (listed[piece] < 0) std::reverse(chain.begin(), chain.end());
      for (EdgePart& part : chain) part.edge = pattern_.pieces[piece].find(names[piece][part.edge]);
      return chain;
    };
    for (const Stitch& stitch : stitches_)
      pattern_.seams.push_back({stitch.name, side(stitch.a), side(stitch.b), std::nullopt, stitch.where});
  }

  const Table& root_;
  Diagnostics& diagnostics_;
  Pattern pattern_;
  std::vector<Stitch> stitches_;
  double unit_ = 1.0;
  bool absolute_ = false, seen_from_outside_ = false;
};

}  // namespace

Pattern parse_garmentcode(const std::string& text, const std::string& shown_as) {
  Diagnostics diagnostics;
  const Table root = parse_json(text, shown_as, diagnostics);
  diagnostics.throw_if_any();
  return Reading(root, shown_as, diagnostics).pattern();
}

}  // namespace snug::mesh
