// The side of contact that carries the multipliers: quadratic triangles of a garment or of a body's surface.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "mesh/garment/garment_mesh.hpp"
#include "solver/algebra/layout.hpp"
#include "solver/algebra/state.hpp"
#include "solver/terms/facet_cut.hpp"

namespace snug::solver {

/// A value. Triangles are counter-clockwise about the outward normal of the surface they meet; their vertices carry the
/// multipliers, numbered from 0 in the order in which the triangles name them.
struct ContactSlave {
  struct Triangle {
    std::array<int, 6> nodes;     ///< of the part's mesh, of a garment before sewing
    std::array<int, 6> entries;   ///< of the x components of the nodes: vertices 0 1 2, mid-edges 01 12 20
    std::array<int, 3> vertices;  ///< multipliers
    double area = 0.0;            ///< at rest, m2
  };
  std::string part;                    ///< of the scene: "body", or a garment
  int mesh_nodes = 0;                  ///< of its mesh, before sewing
  std::vector<Triangle> triangles;
  std::vector<TriangleNodes> curved;   ///< rest shapes (m), one a triangle; empty: all are flat at rest
  /// A point of a line along which a strip bears that is sewn on: its weight is the strip's rest area over the triangle's.
  struct LinePoint {
    Eigen::Vector3d L;
    double weight = 0.0;
  };
  std::map<int, std::vector<LinePoint>> lines;  ///< of triangles along such a line
  std::vector<int> vertex_of_node;     ///< multiplier of a node of the mesh, -1 where it is no vertex
  std::vector<double> area;            ///< A_i = int L_i dA of a vertex, m2
  int order = 2;                       ///< 1: mid-edge nodes take no part
  double mean_edge = 0.0;              ///< m

  int vertices() const { return static_cast<int>(area.size()); }
  /// Nodes of the mesh at the vertices.
  std::vector<int> node_of_vertex() const {
    std::vector<int> node(area.size());
    for (std::size_t n = 0; n < vertex_of_node.size(); ++n)
      if (vertex_of_node[n] >= 0) node[vertex_of_node[n]] = static_cast<int>(n);
    return node;
  }
  /// Rest area element at L over the triangle's mean one: 1 where it is flat.
  double area_ratio(int triangle, const Eigen::Vector3d& L) const;
  /// A field of the part's mesh from the vertices' values: a mid-edge node has what `middle` makes of its edge's two, the rest what it had.
  template <class Value, class Middle>
  void spread(const std::vector<Value>& of_vertices, Middle middle, std::vector<Value>& field) const {
    for (const Triangle& t : triangles)
      for (int k = 0; k < 3; ++k) {
        const Value &here = of_vertices[t.vertices[k]], &next = of_vertices[t.vertices[(k + 1) % 3]];
        field[t.nodes[k]] = here, field[t.nodes[3 + k]] = middle(here, next);
      }
  }
};

/// The garment with its pattern as rest shape; sewn nodes are one. The field of the interface has `vertices()` pressures.
ContactSlave garment_slave(const Field& positions, const mesh::GarmentMesh& garment);

/// Quadratic triangles (tri6) of the body's boundary, at rest where the mesh puts them. Throws std::invalid_argument for others.
ContactSlave surface_slave(const Field& positions, const mesh::BodyMesh& body,
                           const std::vector<mesh::FacetNodeNumbers>& facets);

}  // namespace snug::solver
