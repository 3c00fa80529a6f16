// Between our surfaces and CGAL's; for the sources of this room alone.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <stdexcept>

#include "mesh/formats/triangle_surface.hpp"

namespace snug::mesh {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<CgalKernel::Point_3>;

inline CgalKernel::Point_3 cgal_point(const Eigen::Vector3d& x) { return {x.x(), x.y(), x.z()}; }
inline Eigen::Vector3d eigen_point(const CgalKernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

/// The same numbers of vertices and faces. Throws std::runtime_error where more than two faces share an edge.
inline CgalMesh cgal_mesh(const TriangleSurface& surface) {
  CgalMesh mesh;
  for (const auto& x : surface.vertices) mesh.add_vertex(cgal_point(x));
  for (const auto& t : surface.triangles)
    if (mesh.add_face(CgalMesh::Vertex_index(t[0]), CgalMesh::Vertex_index(t[1]), CgalMesh::Vertex_index(t[2])) == CgalMesh::null_face())
      throw std::runtime_error("more than two triangles share an edge");
  return mesh;
}

/// Of a mesh without garbage; vertices without a face stay behind.
inline TriangleSurface triangle_surface(const CgalMesh& mesh) {
  TriangleSurface surface;
  std::vector<int> number(mesh.number_of_vertices(), -1);
  for (const auto face : mesh.faces()) {
    std::array<int, 3> t;
    int n = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(face), mesh)) {
      int& at = number[v];
      if (at < 0) at = static_cast<int>(surface.vertices.size()), surface.vertices.push_back(eigen_point(mesh.point(v)));
      t[n++] = at;
    }
    surface.triangles.push_back(t);
  }
  return surface;
}

}  // namespace snug::mesh
