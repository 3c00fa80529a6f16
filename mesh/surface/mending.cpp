#include "mesh/surface/mending.hpp"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "mesh/surface/cgal_mesh.hpp"
#include "mesh/surface/cutting.hpp"

namespace snug::mesh {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Halfedge = CgalMesh::Halfedge_index;
using Face = CgalMesh::Face_index;

constexpr double small_piece = 1e-3;  // share of the whole's area

/// Counts what goes and remembers the place of the first.
class Book {
 public:
  explicit Book(std::vector<Mending>& list) : list_(list) {}
  void note(long count, const std::string& one, const std::string& many, const Eigen::Vector3d& at) {
    if (count > 0) list_.push_back({fmt::format("{} {}", count, count == 1 ? one : many), at});
  }

 private:
  std::vector<Mending>& list_;
};

Eigen::Vector3d middle(const TriangleSurface& surface, const std::array<int, 3>& t) {
  return (surface.vertices[t[0]] + surface.vertices[t[1]] + surface.vertices[t[2]]) / 3.0;
}

/// Faces with the same corners, whatever way they turn, and those without area.
TriangleSurface without_doubles(const TriangleSurface& surface, Book& book) {
  std::map<std::array<int, 3>, int> seen;
  TriangleSurface kept{surface.vertices, {}};
  long twice = 0, flat = 0;
  Eigen::Vector3d first_twice, first_flat;
  for (const auto& t : surface.triangles) {
    std::array<int, 3> key = t;
    std::sort(key.begin(), key.end());
    if (key[0] == key[1] || key[1] == key[2]) {
      if (flat++ == 0) first_flat = middle(surface, t);
    } else if (!seen.emplace(key, 1).second) {
      if (twice++ == 0) first_twice = middle(surface, t);
    } else {
      kept.triangles.push_back(t);
    }
  }
  book.note(twice, "face given twice: one of them left out", "faces given twice: one of each left out", first_twice);
  book.note(flat, "face that is a line: left out", "faces that are lines: left out", first_flat);
  return compacted(kept);
}

/// Turns faces alike; where more than two share an edge, or fans meet in a point, vertices are doubled.
CgalMesh oriented(const TriangleSurface& surface, Book& book) {
  std::vector<CgalKernel::Point_3> points;
  for (const auto& x : surface.vertices) points.push_back(cgal_point(x));
  std::vector<std::vector<std::size_t>> faces;
  for (const auto& t : surface.triangles) faces.push_back({std::size_t(t[0]), std::size_t(t[1]), std::size_t(t[2])});
  const std::size_t before = points.size();
  pmp::orient_polygon_soup(points, faces);
  if (points.size() > before)
    book.note(static_cast<long>(points.size() - before), "vertex at an edge of more than two faces: parted", "vertices at edges of more than two faces: parted",
              eigen_point(points[before]));
  long turned = 0;
  Eigen::Vector3d first;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& t = surface.triangles[f];
    const auto from = [&](std::size_t v) { return (eigen_point(points[v]) - surface.vertices[t[1]]).squaredNorm() == 0.0; };
    const std::size_t next = (std::find_if(faces[f].begin(), faces[f].end(), [&](std::size_t v) { return (eigen_point(points[v]) - surface.vertices[t[0]]).squaredNorm() == 0.0; }) - faces[f].begin() + 1) % 3;
    if (!from(faces[f][next]) && turned++ == 0) first = middle(surface, t);
  }
  turned = std::min(turned, static_cast<long>(surface.triangles.size()) - turned);  // all together is no defect of single faces
  book.note(turned, "face that turned the other way: turned", "faces that turned the other way: turned", first);
  CgalMesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, faces, mesh);
  return mesh;
}

double diameter(const CgalMesh& mesh, Halfedge border, Eigen::Vector3d& centre) {
  std::vector<Eigen::Vector3d> rim;
  for (const Halfedge h : CGAL::halfedges_around_face(border, mesh)) rim.push_back(eigen_point(mesh.point(mesh.target(h))));
  centre.setZero();
  for (const auto& x : rim) centre += x / static_cast<double>(rim.size());
  double widest = 0.0;
  for (const auto& x : rim) widest = std::max(widest, 2.0 * (x - centre).norm());
  return widest;
}

void fill_holes(CgalMesh& mesh, double limit, Book& book, std::vector<WideHole>& wide) {
  std::vector<Halfedge> cycles;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(cycles));
  long filled = 0;
  Eigen::Vector3d first, centre;
  double widest = 0.0;
  for (const Halfedge border : cycles) {
    const double width = diameter(mesh, border, centre);
    std::vector<Face> patch;
    const Eigen::Vector3d rim = eigen_point(mesh.point(mesh.target(border)));
    pmp::triangulate_hole(mesh, border, std::back_inserter(patch));
    if (width > limit || patch.empty()) {
      wide.push_back({rim, width});
      continue;
    }
    widest = std::max(widest, width);
    if (filled++ == 0) first = centre;
  }
  const std::string size = fmt::format("up to {:.1f} mm wide: filled", 1e3 * widest);
  book.note(filled, "hole " + size, "holes " + size, first);
}

void drop_small_pieces(CgalMesh& mesh, Book& book) {
  auto piece = mesh.add_property_map<Face, std::size_t>("f:piece", 0).first;
  const std::size_t count = pmp::connected_components(mesh, piece);
  std::vector<double> area(count, 0.0);
  std::vector<Eigen::Vector3d> at(count);
  double whole = 0.0;
  for (const Face f : mesh.faces()) {
    const double one = CGAL::to_double(pmp::face_area(f, mesh));
    area[piece[f]] += one, whole += one;
    at[piece[f]] = eigen_point(mesh.point(mesh.target(mesh.halfedge(f))));
  }
  std::vector<std::size_t> small;
  for (std::size_t n = 0; n < count; ++n)
    if (area[n] < small_piece * whole) small.push_back(n);
  if (!small.empty()) {
    book.note(static_cast<long>(small.size()), "small piece apart: left out", "small pieces apart: left out", at[small[0]]);
    pmp::remove_connected_components(mesh, small, piece);
  }
  mesh.remove_property_map(piece);
}

}  // namespace

MendedSurface mend(const TriangleSurface& surface, const MendLimits& limits) {
  MendedSurface result;
  Book book(result.mendings);
  CgalMesh mesh = oriented(without_doubles(surface, book), book);
  const long stitched = static_cast<long>(pmp::stitch_borders(mesh));
  book.note(stitched, "pair of edges side by side: stitched", "pairs of edges side by side: stitched", Eigen::Vector3d::Zero());
  drop_small_pieces(mesh, book);
  const std::size_t faces = mesh.number_of_faces();
  pmp::remove_degenerate_faces(mesh);
  book.note(static_cast<long>(faces) - static_cast<long>(mesh.number_of_faces()), "face without area: taken out", "faces without area: taken out", Eigen::Vector3d::Zero());
  fill_holes(mesh, limits.hole, book, result.wide_holes);
  mesh.collect_garbage();
  if (CGAL::is_closed(mesh) && !pmp::is_outward_oriented(mesh)) {
    pmp::reverse_face_orientations(mesh);
    result.mendings.push_back({"the surface showed its inside: turned", Eigen::Vector3d::Zero()});
  }
  result.surface = triangle_surface(mesh);
  return result;
}

std::vector<std::array<int, 2>> self_intersections(const TriangleSurface& surface) {
  const CgalMesh mesh = cgal_mesh(surface);
  std::vector<std::pair<Face, Face>> pairs;
  pmp::self_intersections(mesh, std::back_inserter(pairs));
  std::vector<std::array<int, 2>> found;
  for (const auto& [a, b] : pairs) found.push_back({static_cast<int>(a), static_cast<int>(b)});
  return found;
}

TriangleSurface remeshed(const TriangleSurface& surface, double size) {
  CgalMesh mesh = cgal_mesh(surface);
  std::vector<CgalMesh::Edge_index> border;
  for (const auto edge : mesh.edges())
    if (mesh.is_border(edge)) border.push_back(edge);
  if (!border.empty()) pmp::split_long_edges(border, size, mesh);
  pmp::isotropic_remeshing(mesh.faces(), size, mesh, CGAL::parameters::number_of_iterations(4).number_of_relaxation_steps(3));
  mesh.collect_garbage();
  return triangle_surface(mesh);
}

double enclosed_volume(const TriangleSurface& surface) {
  double six = 0.0;
  for (const auto& t : surface.triangles)
    six += surface.vertices[t[0]].dot(surface.vertices[t[1]].cross(surface.vertices[t[2]]));
  return six / 6.0;
}

}  // namespace snug::mesh
