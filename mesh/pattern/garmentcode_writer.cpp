#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "mesh/pattern/garmentcode.hpp"

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using Json = nlohmann::ordered_json;

constexpr double units = 100.0;  // to the metre

Json pair(const Vector2d& p) { return Json::array({p.x(), p.y()}); }

/// A control point against the chord: along it and to its left, in lengths of the chord.
Json relative_point(const Vector2d& from, const Vector2d& to, const Vector2d& control) {
  const Vector2d edge = to - from, left(-edge.y(), edge.x()), off = control - from;
  return pair(Vector2d(off.dot(edge), off.dot(left)) / edge.squaredNorm());
}

bool is_circle(const Arc& arc) {
  return std::abs(arc.u.norm() - arc.v.norm()) < 1e-12 * arc.u.norm() &&
         std::abs(arc.u.dot(arc.v)) < 1e-12 * arc.u.squaredNorm() &&
         std::abs(arc.to - arc.from) < 1.9 * std::numbers::pi;
}

/// Null for a line.
Json curvature(const Span& span) {
  const Vector2d from = at(span, 0.0), to = at(span, 1.0);
  if (const auto* q = std::get_if<Quadratic>(&span))
    return {{"type", "quadratic"}, {"params", Json::array({relative_point(from, to, q->control)})}};
  if (const auto* c = std::get_if<Cubic>(&span))
    return {{"type", "cubic"}, {"params", Json::array({relative_point(from, to, c->first), relative_point(from, to, c->second)})}};
  if (const auto* arc = std::get_if<Arc>(&span)) {
    const bool left = (arc->u.x() * arc->v.y() - arc->u.y() * arc->v.x()) * (arc->to - arc->from) > 0.0;
    const bool large = std::abs(arc->to - arc->from) > std::numbers::pi;
    return {{"type", "circle"}, {"params", Json::array({units * arc->u.norm(), large ? 1 : 0, left ? 1 : 0})}};
  }
  return nullptr;
}

/// Circles stay what they are.
std::vector<Span> spans_of(const Curve& curve) {
  std::vector<Span> result;
  for (const Span& span : curve.spans) {
    const Arc* arc = std::get_if<Arc>(&span);
    if (!arc || is_circle(*arc))
      result.push_back(span);
    else
      for (const Span& one : without_arcs({{span}})) result.push_back(one);
  }
  return result;
}

class Writer {
 public:
  explicit Writer(const CheckedPattern& checked) : checked_(checked) {}

  std::string text() {
    Json panels = Json::object(), order = Json::array();
    for (std::size_t p = 0; p < checked_.pattern.pieces.size(); ++p) {
      panels[checked_.pattern.pieces[p].name] = panel(static_cast<int>(p));
      order.push_back(checked_.pattern.pieces[p].name);
    }
    Json file;
    file["title"] = checked_.pattern.title;
    file["pattern"] = {{"panels", panels}, {"stitches", stitches()}, {"panel_order", order}};
    file["parameters"] = Json::object();
    file["parameter_order"] = Json::array();
    file["properties"] = {{"curvature_coords", "relative"},
                          {"normalize_panel_translation", false},
                          {"normalized_edge_loops", true},
                          {"units_in_meter", units},
                          {"seen_from_outside", true}};
    return file.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  }

 private:
  Json panel(int p) {
    const Piece& piece = checked_.pattern.pieces[p];
    Json vertices = Json::array(), edges = Json::array();
    for (std::size_t s = 0; s < checked_.sewing.stretches.size(); ++s) {
      const EdgePart& part = checked_.sewing.stretches[s].part;
      if (part.piece != p || part.edge >= piece.loops[0].end) continue;
      const std::vector<Span> spans = spans_of(ArcLength(piece.edges[part.edge].curve).between(part.from, part.to));
      for (std::size_t n = 0; n < spans.size(); ++n) {
        numbers_[static_cast<int>(s)].push_back(static_cast<int>(edges.size()));
        vertices.push_back(pair(units * at(spans[n], 0.0)));
        Json edge = {{"endpoints", Json::array({edges.size(), edges.size() + 1})}};
        if (const Json bend = curvature(spans[n]); !bend.is_null()) edge["curvature"] = bend;
        const bool whole = spans.size() == 1 && part.from == 0.0 && part.to == 1.0;
        edge["label"] =
            whole ? piece.edges[part.edge].name : fmt::format("{} {}", piece.edges[part.edge].name, edges.size());
        edges.push_back(edge);
      }
    }
    if (!edges.empty()) edges.back()["endpoints"][1] = 0;
    Json result;
    if (piece.place) {
      result["translation"] = Json::array({units * piece.place->translation.x(), units * piece.place->translation.y(),
                                           units * piece.place->translation.z()});
      result["rotation"] = angles(piece.place->rotation);
    }
    result["vertices"] = vertices;
    result["edges"] = edges;
    return result;
  }

  /// Degrees about x, then y, then z of the frame.
  static Json angles(const Eigen::Matrix3d& R) {
    constexpr double degrees = 180.0 / std::numbers::pi;
    const double y = std::asin(std::clamp(-R(2, 0), -1.0, 1.0));
    if (std::abs(R(2, 0)) > 1.0 - 1e-12)
      return Json::array({0.0, y * degrees, std::atan2(-R(0, 1), R(1, 1)) * degrees});
    return Json::array({std::atan2(R(2, 1), R(2, 2)) * degrees, y * degrees, std::atan2(R(1, 0), R(0, 0)) * degrees});
  }

  Json stitches() const {
    Json result = Json::array();
    for (std::size_t s = 0; s < checked_.sewing.stretches.size(); ++s) {
      const Stretch& one = checked_.sewing.stretches[s];
      if (one.partner < static_cast<int>(s) || !numbers_.contains(static_cast<int>(s)) ||
          !numbers_.contains(one.partner))
        continue;
      const std::vector<int>&a = numbers_.at(static_cast<int>(s)), &b = numbers_.at(one.partner);
      const std::string &of_a = checked_.pattern.pieces[one.part.piece].name,
                        &of_b = checked_.pattern.pieces[checked_.sewing.stretches[one.partner].part.piece].name;
      if (a.size() == 1 && b.size() == 1)
        result.push_back(Json::array({{{"panel", of_a}, {"edge", a[0]}}, {{"panel", of_b}, {"edge", b[0]}}}));
      else
        result.push_back({{"label", checked_.pattern.seams[one.seam].name},
                          {"a", {{"panel", of_a}, {"edges", a}}},
                          {"b", {{"panel", of_b}, {"edges", b}}}});
    }
    return result;
  }

  const CheckedPattern& checked_;
  std::map<int, std::vector<int>> numbers_;  // edges of each stretch in its panel
};

}  // namespace

std::string garmentcode_text(const CheckedPattern& checked) { return Writer(checked).text(); }

}  // namespace snug::mesh
