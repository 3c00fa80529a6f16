#include "solver/terms/tool_surface.hpp"

#include <map>

namespace snug::solver {

using mesh::FacetKind;

namespace {

constexpr int parts = 4;  // of a facet's edge

std::array<int, 4> corners_of(FacetKind kind) {
  return kind == FacetKind::quad9 ? std::array{0, 2, 6, 8} : kind == FacetKind::quad4 ? std::array{0, 1, 2, 3} : std::array{0, 1, 2, 0};
}

Eigen::Vector4d hats(FacetKind kind, const Eigen::Vector2d& xi) {
  if (kind == FacetKind::tri6) return {1.0 - xi.sum(), xi[0], xi[1], 0.0};
  return facet_shape(FacetKind::quad4, xi).N.head<4>();
}

void add_part(FacetKind kind, const Eigen::Vector2d& origin, double scale, double weight, std::vector<ToolPoint>& points) {
  for (const FacetRulePoint& q : facet_rule(kind)) {
    const Eigen::Vector2d xi = origin + scale * q.xi;
    points.push_back({weight * q.weight, facet_shape(kind, xi), hats(kind, xi)});
  }
}

std::vector<ToolPoint> points_of(FacetKind kind) {
  std::vector<ToolPoint> points;
  constexpr double h = 1.0 / parts;
  for (int i = 0; i < parts; ++i)
    for (int j = 0; j < parts; ++j) {
      if (kind != FacetKind::tri6) {
        add_part(kind, {(2 * i + 1) * h - 1.0, (2 * j + 1) * h - 1.0}, h, h * h, points);
      } else if (i + j < parts) {
        add_part(kind, {i * h, j * h}, h, h * h, points);
        if (i + j + 1 < parts) add_part(kind, {(i + 1) * h, (j + 1) * h}, -h, h * h, points);
      }
    }
  return points;
}

std::vector<Eigen::Vector4d> hats_of(FacetKind kind) {
  std::vector<Eigen::Vector4d> list;
  for (const Eigen::Vector2d& xi : facet_domain(kind).nodes) list.push_back(hats(kind, xi));
  return list;
}

}  // namespace

const std::vector<ToolPoint>& tool_points(FacetKind kind) {
  static const std::array lists = {points_of(FacetKind::quad9), points_of(FacetKind::quad4), points_of(FacetKind::tri6)};
  return lists[static_cast<int>(kind)];
}

const std::vector<Eigen::Vector4d>& hats_at_nodes(FacetKind kind) {
  static const std::array lists = {hats_of(FacetKind::quad9), hats_of(FacetKind::quad4), hats_of(FacetKind::tri6)};
  return lists[static_cast<int>(kind)];
}

ToolSurface tool_surface(const mesh::BodyMesh& body, std::vector<mesh::FacetNodeNumbers> facets) {
  ToolSurface surface{.kind = facet_kind(body.kind), .facets = std::move(facets), .vertices = {}, .node_of_vertex = {}};
  surface.mean_edge = surface.facets.empty() ? 0.0 : mesh::mean_edge(body, surface.facets);
  std::map<int, int> number;
  const std::array<int, 4> corner = corners_of(surface.kind);
  for (const auto& facet : surface.facets) {
    auto& vertices = surface.vertices.emplace_back();
    for (int v = 0; v < 4; ++v) {
      const auto [it, fresh] = number.emplace(facet[corner[v]], static_cast<int>(number.size()));
      if (fresh) surface.node_of_vertex.push_back(it->first);
      vertices[v] = it->second;
    }
  }
  return surface;
}

}  // namespace snug::solver
