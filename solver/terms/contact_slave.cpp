#include "solver/terms/contact_slave.hpp"

#include <Eigen/Dense>

#include <stdexcept>

namespace snug::solver {

namespace {

double area_element(const TriangleNodes& x, const Eigen::Vector3d& L) {
  const Eigen::Matrix<double, 3, 2> tangents = x * garment_slopes(2, L);
  return 0.5 * tangents.col(0).cross(tangents.col(1)).norm();
}

// Numbers the vertices of the last triangle, which are these nodes of the mesh.
void number_vertices(const std::array<int, 6>& nodes, ContactSlave& slave) {
  for (int v = 0; v < 3; ++v) {
    int& vertex = slave.vertex_of_node[nodes[v]];
    if (vertex < 0) vertex = slave.vertices(), slave.area.push_back(0.0);
    slave.triangles.back().vertices[v] = vertex;
  }
}

}  // namespace

double ContactSlave::area_ratio(int triangle, const Eigen::Vector3d& L) const {
  return curved.empty() ? 1.0 : area_element(curved[triangle], L) / triangles[triangle].area;
}

ContactSlave garment_slave(const Field& positions, const mesh::GarmentMesh& garment) {
  ContactSlave slave;
  slave.part = garment.name, slave.mesh_nodes = static_cast<int>(garment.pattern.size());
  slave.order = garment.order, slave.mean_edge = garment.mean_edge;
  slave.vertex_of_node.assign(garment.pattern.size(), -1);
  for (const auto& nodes : garment.triangles) {
    auto& triangle = slave.triangles.emplace_back();
    triangle.nodes = nodes;
    std::array<int, 6> merged;
    for (int a = 0; a < 6; ++a) merged[a] = garment.merged[nodes[a]], triangle.entries[a] = positions(merged[a]);
    triangle.area = flat_triangle(garment.pattern[nodes[0]], garment.pattern[nodes[1]], garment.pattern[nodes[2]]).area;
    number_vertices(merged, slave);
    for (const int vertex : triangle.vertices) slave.area[vertex] += triangle.area / 3.0;
  }
  return slave;
}

ContactSlave surface_slave(const Field& positions, const mesh::BodyMesh& body,
                           const std::vector<mesh::FacetNodeNumbers>& facets) {
  if (mesh::facet_kind(body.kind) != mesh::FacetKind::tri6)
    throw std::invalid_argument("the slave surface of a contact is made of quadratic tetrahedra");
  ContactSlave slave;
  slave.part = "body", slave.mesh_nodes = static_cast<int>(body.nodes.size());
  slave.mean_edge = mesh::mean_edge(body, facets);
  slave.vertex_of_node.assign(body.nodes.size(), -1);
  for (const auto& facet : facets) {
    auto& triangle = slave.triangles.emplace_back();
    // its own outward normal is opposed to that of the surface it meets
    const std::array<int, 6> nodes = {facet[0], facet[2], facet[1], facet[5], facet[4], facet[3]};
    triangle.nodes = nodes;
    TriangleNodes& rest = slave.curved.emplace_back();
    for (int a = 0; a < 6; ++a) triangle.entries[a] = positions(nodes[a]), rest.col(a) = body.nodes[nodes[a]];
    number_vertices(nodes, slave);
    for (const TrianglePoint& q : triangle_rule()) {
      const double part = q.weight * area_element(rest, q.L);
      triangle.area += part;
      for (int v = 0; v < 3; ++v) slave.area[triangle.vertices[v]] += part * q.L[v];
    }
  }
  return slave;
}

}  // namespace snug::solver
