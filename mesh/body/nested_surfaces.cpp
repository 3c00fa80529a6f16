#include "mesh/body/nested_surfaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/surface/mending.hpp"

namespace snug::mesh {

namespace {

constexpr double on_plane = 1e-6;  // m

/// The cut in whose plane a border loop lies, or -1.
int cut_of(const TriangleSurface& mesh, const Rim& loop, const std::vector<Cut>& cuts) {
  int best = -1;
  double nearest = 1e300;
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    double off = 0.0, away = 1e300;
    for (const int v : loop) {
      off = std::max(off, std::abs(cuts[c].normal.dot(mesh.vertices[v] - cuts[c].point)));
      away = std::min(away, (mesh.vertices[v] - cuts[c].point).norm());
    }
    if (off < on_plane && away < nearest) best = static_cast<int>(c), nearest = away;
  }
  return best;
}

[[noreturn]] void refuse_hole(const TriangleSurface& mesh, const Rim& loop, const input::Location& where) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const int v : loop) middle += mesh.vertices[v] / static_cast<double>(loop.size());
  double width = 0.0;
  for (const int v : loop) width = std::max(width, 2e3 * (mesh.vertices[v] - middle).norm());
  throw input::InputError(where, fmt::format("the surface has a hole of {:.0f} mm at ({:.0f}, {:.0f}, {:.0f}) mm of the body's frame", width, 1e3 * middle.x(), 1e3 * middle.y(), 1e3 * middle.z()),
                          "close it in the scanner's program, let a cut drop it, or allow it: fill_holes");
}

/// Vertices onto the smooth surface, except where triangles would cut each other: there they stay.
void lift(NestedSurface& surface, const std::vector<Cut>& cuts) {
  TriangleSurface& mesh = surface.mesh;
  const std::vector<Eigen::Vector3d> before = mesh.vertices;
  std::vector<int> cut_at(mesh.vertices.size(), -1);
  for (std::size_t c = 0; c < cuts.size(); ++c)
    for (const Rim& rim : surface.rims[c])
      for (const int v : rim) cut_at[v] = static_cast<int>(c);
  for (std::size_t v = 0; v < before.size(); ++v)
    mesh.vertices[v] = cut_at[v] < 0 ? surface.smooth->onto(before[v]).x : surface.smooth->onto(before[v], cuts[cut_at[v]].point, cuts[cut_at[v]].normal);
  std::vector<char> back(before.size(), 0);
  for (int round = 0; round < 10; ++round) {
    const auto crossings = self_intersections(mesh);
    surface.cuts_itself = !crossings.empty();
    if (crossings.empty()) return;
    for (const auto& pair : crossings)
      for (const int t : pair)
        for (const int v : mesh.triangles[t])
          if (!back[v]) back[v] = 1, ++surface.on_facets, mesh.vertices[v] = before[v];
  }
}

}  // namespace

std::vector<Eigen::Vector2d> flat_rim(const NestedSurface& surface, const Rim& rim, const PlaneFrame& frame) {
  std::vector<Eigen::Vector2d> polygon;
  for (const int v : rim) polygon.push_back(frame.flat(surface.mesh.vertices[v]));
  return polygon;
}

NestedSurface nested_surface(const std::string& name, TriangleSurface whole, const TriangleSurface& kept, const std::vector<Cut>& cuts, double size,
                             const Smoothing& smoothing, const input::Location& where) {
  NestedSurface surface;
  surface.name = name;
  surface.smooth = std::make_unique<SmoothSurface>(std::move(whole), smoothing.radius, smoothing.at_corners);
  surface.mesh = remeshed(kept, size);
  surface.rims.resize(cuts.size());
  for (Rim& loop : border_loops(surface.mesh)) {
    const int c = cut_of(surface.mesh, loop, cuts);
    if (c < 0) refuse_hole(surface.mesh, loop, where);
    if (polygon_area(flat_rim(surface, loop, PlaneFrame(cuts[c]))) < 0.0) std::reverse(loop.begin(), loop.end());
    surface.rims[c].push_back(std::move(loop));
  }
  lift(surface, cuts);
  return surface;
}

namespace {

/// A number for each triangle: of the piece that it belongs to.
std::vector<int> pieces(const TriangleSurface& surface) {
  std::vector<int> leader(surface.vertices.size());
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&](int v) {
    while (leader[v] != v) v = leader[v] = leader[leader[v]];
    return v;
  };
  for (const auto& t : surface.triangles) leader[find(t[1])] = find(t[0]), leader[find(t[2])] = find(t[0]);
  std::vector<int> piece;
  for (const auto& t : surface.triangles) piece.push_back(find(t[0]));
  return piece;
}

}  // namespace

TriangleSurface kept_inside(TriangleSurface whole, const std::vector<Cut>& cuts, const NestedSurface& skin, const SurfaceTree& inside) {
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    const PlaneFrame frame(cuts[c]);
    std::vector<std::vector<Eigen::Vector2d>> rims;
    for (const Rim& rim : skin.rims[c]) rims.push_back(flat_rim(skin, rim, frame));
    cut_off(whole, cuts[c], [&](const auto& sections) {
      std::vector<std::size_t> chosen;
      for (std::size_t n = 0; n < sections.size(); ++n)
        if (std::any_of(rims.begin(), rims.end(), [&](const auto& rim) { return inside_polygon(sections[n].front(), rim); })) chosen.push_back(n);
      return chosen;
    });
  }
  const std::vector<int> piece = pieces(whole);
  std::vector<signed char> verdict(whole.vertices.size(), -1);
  TriangleSurface kept{whole.vertices, {}};
  for (std::size_t t = 0; t < piece.size(); ++t) {
    signed char& in = verdict[piece[t]];
    if (in < 0) {
      const auto& x = whole.vertices;
      const auto& v = whole.triangles[t];
      in = inside.inside((x[v[0]] + x[v[1]] + x[v[2]]) / 3.0) ? 1 : 0;
    }
    if (in == 1) kept.triangles.push_back(whole.triangles[t]);
  }
  return compacted(kept);
}

TriangleSurface closed_flat(TriangleSurface surface) {
  for (const Rim& loop : border_loops(surface)) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int v : loop) middle += surface.vertices[v] / static_cast<double>(loop.size());
    const int centre = static_cast<int>(surface.vertices.size());
    surface.vertices.push_back(middle);
    for (std::size_t n = 0; n < loop.size(); ++n) surface.triangles.push_back({loop[(n + 1) % loop.size()], loop[n], centre});
  }
  return surface;
}

}  // namespace snug::mesh
