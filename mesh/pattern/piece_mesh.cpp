#include "mesh/pattern/piece_mesh.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <unordered_map>

#include "mesh/formats/gmsh_session.hpp"

namespace snug::mesh {

namespace {

using Eigen::Vector2d;

constexpr int gmsh_triangle3 = 2;

double rounded(double length) {
  return std::round(1e9 * length) / 1e9;
}  // the same piece in other units has the same mesh

/// Points and lines of the polygons, one line a side. Gives gmsh's numbers of the points.
std::vector<int> add_border(const std::vector<std::vector<Vector2d>>& loops, double cell_size) {
  namespace geo = gmsh::model::geo;
  std::vector<int> points, curves;
  for (const auto& loop : loops) {
    const std::size_t first = points.size();
    for (const Vector2d& p : loop) points.push_back(geo::addPoint(rounded(p.x()), rounded(p.y()), 0.0, cell_size));
    std::vector<int> lines;
    for (std::size_t n = 0; n < loop.size(); ++n) {
      lines.push_back(geo::addLine(points[first + n], points[first + (n + 1) % loop.size()]));
      geo::mesh::setTransfiniteCurve(lines.back(), 2);
    }
    curves.push_back(geo::addCurveLoop(lines));
  }
  geo::addPlaneSurface(curves);
  geo::synchronize();
  return points;
}

/// Our number of each of gmsh's nodes: the border's as given, then those inside.
std::unordered_map<std::size_t, int> read_vertices(const std::vector<int>& points,
                                                   const std::vector<std::vector<Vector2d>>& loops, PieceMesh& mesh) {
  std::unordered_map<std::size_t, int> number;
  for (const auto& loop : loops) mesh.vertices.insert(mesh.vertices.end(), loop.begin(), loop.end());
  std::vector<std::size_t> tags;
  std::vector<double> x, parameters;
  for (std::size_t n = 0; n < points.size(); ++n) {
    gmsh::model::mesh::getNodes(tags, x, parameters, 0, points[n]);
    if (tags.size() == 1) number[tags[0]] = static_cast<int>(n);
  }
  gmsh::model::mesh::getNodes(tags, x, parameters);
  for (std::size_t n = 0; n < tags.size(); ++n)
    if (number.emplace(tags[n], static_cast<int>(mesh.vertices.size())).second)
      mesh.vertices.emplace_back(x[3 * n], x[3 * n + 1]);
  return number;
}

double twice_area(const PieceMesh& mesh, const std::array<int, 3>& t) {
  const Vector2d u = mesh.vertices[t[1]] - mesh.vertices[t[0]], v = mesh.vertices[t[2]] - mesh.vertices[t[0]];
  return u.x() * v.y() - u.y() * v.x();
}

void read_triangles(const std::unordered_map<std::size_t, int>& number, PieceMesh& mesh) {
  std::vector<std::size_t> elements, tags;
  gmsh::model::mesh::getElementsByType(gmsh_triangle3, elements, tags);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    std::array<int, 3> t;
    for (int n = 0; n < 3; ++n) t[n] = number.at(tags[3 * e + n]);
    if (twice_area(mesh, t) < 0.0) std::swap(t[1], t[2]);
    mesh.triangles.push_back(t);
  }
}

double polygon_area(const std::vector<std::vector<Vector2d>>& loops) {
  double sum = 0.0;
  for (const auto& loop : loops)
    for (std::size_t n = 0; n < loop.size(); ++n) {
      const Vector2d &a = loop[n], &b = loop[(n + 1) % loop.size()];
      sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
  return sum;
}

/// What gmsh gives must cover the polygons, no more and no less, with triangles that all have an area.
void check(const PieceMesh& mesh, const std::vector<std::vector<Vector2d>>& loops) {
  double covered = 0.0;
  const double whole = polygon_area(loops);
  for (const auto& t : mesh.triangles) {
    const double one = 0.5 * twice_area(mesh, t);
    if (!(one > 1e-12 * whole)) throw std::runtime_error("a triangle has no area");
    covered += one;
  }
  if (!(std::abs(covered - whole) < 1e-6 * whole)) throw std::runtime_error("the triangles do not cover the piece");
}

using MeshEdge = std::pair<int, int>;
MeshEdge mesh_edge(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// Splits the inner sides whose ends become one vertex, in both triangles that have them.
void split_folding_sides(const std::vector<int>& same, PieceMesh& mesh) {
  std::map<MeshEdge, int> middle;
  std::map<MeshEdge, int> uses;
  for (const auto& t : mesh.triangles)
    for (int n = 0; n < 3; ++n) ++uses[mesh_edge(t[n], t[(n + 1) % 3])];
  const auto border = static_cast<int>(same.size());
  for (const auto& [ends, count] : uses)
    if (count == 2 && ends.second < border && same[ends.first] == same[ends.second]) {
      middle[ends] = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back(0.5 * (mesh.vertices[ends.first] + mesh.vertices[ends.second]));
    }
  for (const auto& [ends, vertex] : middle) {
    const std::size_t count = mesh.triangles.size();
    for (std::size_t t = 0; t < count; ++t)
      for (int n = 0; n < 3; ++n) {
        const std::array<int, 3> old = mesh.triangles[t];
        if (mesh_edge(old[n], old[(n + 1) % 3]) != ends) continue;
        mesh.triangles[t] = {old[n], vertex, old[(n + 2) % 3]};
        mesh.triangles.push_back({vertex, old[(n + 1) % 3], old[(n + 2) % 3]});
        break;
      }
  }
}

}  // namespace

PieceMesh mesh_piece(const std::vector<std::vector<Vector2d>>& loops, const std::vector<int>& same, double cell_size) {
  const GmshSession session;
  gmsh::option::setNumber("Mesh.Algorithm", 5);  // Delaunay
  gmsh::model::add("piece");
  PieceMesh mesh;
  const std::vector<int> points = add_border(loops, rounded(cell_size));
  gmsh::model::mesh::generate(2);
  const auto number = read_vertices(points, loops, mesh);
  read_triangles(number, mesh);
  check(mesh, loops);
  split_folding_sides(same, mesh);
  return mesh;
}

}  // namespace snug::mesh
