#include "mesh/pattern/svg_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <pugixml.hpp>

#include "mesh/pattern/svg_path.hpp"

namespace snug::mesh {

namespace {

using Eigen::Affine2d;
using Eigen::Vector2d;
using input::Diagnostics;
using input::Location;

/// Numbers of a text with spaces and commas between them; empty when something else stands there.
std::vector<double> numbers(std::string_view text) {
  std::vector<double> result;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n,"), text.size()));
    if (text.empty()) return result;
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || !(std::abs(value) < 1e9)) return {};
    result.push_back(value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
}

/// m; nothing where the text has no length as its unit.
std::optional<double> physical(const std::string& text) {
  const std::map<std::string, double> units = {
      {"mm", 1e-3}, {"cm", 1e-2}, {"in", 0.0254}, {"pt", 0.0254 / 72.0}, {"pc", 0.0254 / 6.0}};
  if (text.size() < 3) return std::nullopt;
  const auto unit = units.find(text.substr(text.size() - 2));
  const auto value = numbers(std::string_view(text).substr(0, text.size() - 2));
  if (unit == units.end() || value.size() != 1 || !(value[0] > 0.0)) return std::nullopt;
  return value[0] * unit->second;
}

/// One of "translate", "scale", "rotate", "skewX", "skewY", "matrix"; false when it is none or its numbers do not fit.
bool apply(const std::string& name, const std::vector<double>& n, Affine2d& map) {
  const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180.0; };
  Eigen::Matrix3d m = Eigen::Matrix3d::Identity();
  if (name == "translate" && (n.size() == 1 || n.size() == 2)) {
    m(0, 2) = n[0], m(1, 2) = n.size() == 2 ? n[1] : 0.0;
  } else if (name == "scale" && (n.size() == 1 || n.size() == 2)) {
    m(0, 0) = n[0], m(1, 1) = n.back();
  } else if (name == "rotate" && (n.size() == 1 || n.size() == 3)) {
    const Vector2d centre = n.size() == 3 ? Vector2d(n[1], n[2]) : Vector2d(0.0, 0.0);
    m.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(radians(n[0])).toRotationMatrix();
    m.topRightCorner<2, 1>() = centre - m.topLeftCorner<2, 2>() * centre;
  } else if (name == "skewX" && n.size() == 1) {
    m(0, 1) = std::tan(radians(n[0]));
  } else if (name == "skewY" && n.size() == 1) {
    m(1, 0) = std::tan(radians(n[0]));
  } else if (name == "matrix" && n.size() == 6) {
    m.topRows<2>() << n[0], n[2], n[4], n[1], n[3], n[5];
  } else {
    return false;
  }
  map = map * Affine2d(m);
  return true;
}

/// Places of a text by offset.
Location place(const std::string& text, std::ptrdiff_t offset, const std::string& file) {
  const std::size_t at = std::min(offset < 0 ? 0 : static_cast<std::size_t>(offset), text.size());
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  const auto begin = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  return {file, static_cast<int>(line) + 1, static_cast<int>(at - (begin == std::string::npos ? 0 : begin + 1)) + 1};
}

constexpr std::size_t most_pieces = 1000;

class Drawing {
 public:
  Drawing(const std::string& text, const std::string& file, Diagnostics& diagnostics)
      : text_(text), diagnostics_(diagnostics) {
    pattern_.file = file;
  }

  Pattern pattern() {
    pugi::xml_document document;
    const pugi::xml_parse_result result = document.load_buffer(text_.data(), text_.size());
    if (!result)
      throw input::InputError(place(text_, result.offset, pattern_.file),
                              std::string("no SVG: ") + result.description(),
                              "take a drawing that a program has saved as SVG");
    const pugi::xml_node root = document.child("svg");
    if (!root)
      throw input::InputError({.file = pattern_.file}, "there is no <svg>",
                              "take a drawing that a program has saved as SVG");
    pattern_.title = root.child("title").text().as_string();
    const Affine2d map = scale(root);
    only_outlines_ = has_outline(root, 0);
    walk(root, map, 0);
    if (pattern_.pieces.empty())
      diagnostics_.error({.file = pattern_.file}, "there is no closed path",
                         "draw each piece as one closed path or polygon");
    diagnostics_.throw_if_any();
    return std::move(pattern_);
  }

 private:
  Location where(const pugi::xml_node& node) const { return place(text_, node.offset_debug() - 1, pattern_.file); }

  /// From units of the drawing, y down, to m, y up.
  Affine2d scale(const pugi::xml_node& root) const {
    const auto width = physical(root.attribute("width").as_string()),
               height = physical(root.attribute("height").as_string());
    const std::vector<double> view = numbers(root.attribute("viewBox").as_string());
    if (!width || !height)
      throw input::InputError(
          where(root), "the drawing does not say how large it is",
          "give the <svg> width and height with a length as unit: width=\"600mm\" height=\"900mm\"");
    double unit = 0.0254 / 96.0;  // without a view box: of CSS
    if (view.size() == 4 && view[2] > 0.0 && view[3] > 0.0) {
      unit = *width / view[2];
      if (std::abs(*height / view[3] - unit) > 0.01 * unit)
        throw input::InputError(where(root), "width and height ask for two scales of the viewBox",
                                "let both have the viewBox's proportions");
    }
    Affine2d map = Affine2d::Identity();
    map.linear() = Vector2d(unit, -unit).asDiagonal();
    return map;
  }

  static bool is_outline(const pugi::xml_node& node) {
    return std::string_view(node.attribute("class").as_string()) == "outline";
  }
  bool has_outline(const pugi::xml_node& node, int depth) const {
    for (const pugi::xml_node& child : node.children())
      if (is_outline(child) || (depth < 50 && has_outline(child, depth + 1))) return true;
    return false;
  }

  void walk(const pugi::xml_node& node, const Affine2d& map, int depth) {
    for (const pugi::xml_node& child : node.children()) {
      const std::string_view name = child.name();
      if (name == "defs" || name == "clipPath" || name == "mask" || name == "symbol" || name == "pattern" ||
          name == "marker")
        continue;
      Affine2d inner = map;
      if (!transform(child, inner)) continue;
      if (name == "g" || name == "svg" || name == "a") {
        if (depth < 50)
          walk(child, inner, depth + 1);
        else
          diagnostics_.error(where(child), "groups nested more than 50 deep", "take them apart");
      }
      if (only_outlines_ && !is_outline(child)) continue;
      if (name == "path") add(child, child.attribute("d").as_string(), inner);
      if (name == "polygon") add(child, "M" + std::string(child.attribute("points").as_string()) + "Z", inner);
    }
  }

  bool transform(const pugi::xml_node& node, Affine2d& map) {
    const std::string text = node.attribute("transform").as_string();
    for (std::size_t at = text.find_first_not_of(" \t\r\n,"); at < text.size();
         at = text.find_first_not_of(" \t\r\n,", at)) {
      const auto open = text.find('(', at), close = text.find(')', at);
      const bool whole = open != std::string::npos && close != std::string::npos && open < close;
      const std::string name = whole ? text.substr(at, text.find_first_of(" (", at) - at) : std::string();
      if (!whole || !apply(name, numbers(std::string_view(text).substr(open + 1, close - open - 1)), map)) {
        diagnostics_.error(where(node), "the transform \"" + text + "\"",
                           "write translate, scale, rotate, skewX, skewY or matrix with their numbers");
        return false;
      }
      at = close + 1;
    }
    return true;
  }

  void add(const pugi::xml_node& node, const std::string& data, const Affine2d& map) {
    std::string fault;
    std::vector<Curve> closed;
    for (const Curve& path : parse_svg_path(data, fault)) {
      Curve curve = mapped(path, map);
      std::erase_if(curve.spans, [](const Span& span) { return ArcLength({{span}}).length() < 1e-7; });
      if (!curve.spans.empty() && (curve.begin() - curve.end()).norm() < 1e-5) closed.push_back(std::move(curve));
    }
    if (!fault.empty())
      return diagnostics_.error(where(node), "the path stops at what cannot be read: " + fault,
                                "write path data of SVG");
    if (pattern_.pieces.size() >= most_pieces)
      throw input::InputError(where(node), "more than 1000 closed paths",
                              "give those that are pieces the class \"outline\"");
    if (closed.empty()) return;  // a line in the drawing
    std::stable_sort(closed.begin(), closed.end(),
                     [](const Curve& a, const Curve& b) { return std::abs(swept_area(a)) > std::abs(swept_area(b)); });
    Piece piece;
    piece.name = name_of(node), piece.where = where(node);
    for (std::size_t n = 0; n < closed.size(); ++n) {
      const bool left = swept_area(closed[n]) > 0.0;
      add_loop(left == (n == 0) ? closed[n] : reversed(closed[n]), n, piece);
    }
    pattern_.pieces.push_back(std::move(piece));
  }

  /// Edges from corner to corner; a border without corners is one edge.
  void add_loop(const Curve& border, std::size_t number, Piece& piece) const {
    const std::string hole = number > 0 ? fmt::format("hole{}", number) : std::string();
    const std::size_t count = border.spans.size();
    std::vector<std::size_t> corners;
    for (std::size_t n = 0; n < count; ++n) {
      const Curve before{{border.spans[(n + count - 1) % count]}}, after{{border.spans[n]}};
      if (before.last_direction().dot(after.first_direction()) < std::sqrt(0.75)) corners.push_back(n);
    }
    if (corners.empty()) corners.push_back(0);
    Loop loop{static_cast<int>(piece.edges.size()), 0, hole};
    for (std::size_t c = 0; c < corners.size(); ++c) {
      Curve edge;
      const std::size_t from = corners[c], spans = (corners[(c + 1) % corners.size()] + count - from - 1) % count + 1;
      for (std::size_t n = 0; n < spans; ++n) edge.spans.push_back(border.spans[(from + n) % count]);
      piece.edges.push_back({fmt::format("{}edge{}", hole.empty() ? "" : hole + " ", c + 1), edge, piece.where});
    }
    loop.end = static_cast<int>(piece.edges.size());
    piece.loops.push_back(loop);
  }

  std::string name_of(const pugi::xml_node& node) const {
    std::string name = node.attribute("inkscape:label").as_string();
    if (name.empty()) name = node.attribute("id").as_string();
    if (name.empty()) name = fmt::format("piece{}", pattern_.pieces.size() + 1);
    return piece_name(name, pattern_);
  }

  const std::string& text_;
  Diagnostics& diagnostics_;
  Pattern pattern_;
  bool only_outlines_ = false;
};

}  // namespace

Pattern parse_svg(const std::string& text, const std::string& shown_as) {
  Diagnostics diagnostics;
  return Drawing(text, shown_as, diagnostics).pattern();
}

}  // namespace snug::mesh
