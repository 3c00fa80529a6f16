#include "solver/scene/partition.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "solver/fem/partition.hpp"
#include "solver/scene/loads.hpp"
#include "solver/scene/tools.hpp"
#include "solver/terms/contact_slave.hpp"
#include "solver/terms/pressure_unknowns.hpp"

namespace snug::solver {

namespace {

template <class Elements>
std::vector<int> share_out(const Elements& elements, int ranks) {
  std::vector<std::vector<int>> nodes;
  for (const auto& element : elements) nodes.emplace_back(element.begin(), std::find(element.begin(), element.end(), -1));
  return fem::partition(nodes, ranks);
}

// The rank of a cell at the facet; of a shell that of its first node.
std::vector<int> facet_ranks(const mesh::BodyMesh& body, const std::vector<int>& cell_rank, const std::vector<int>& of_body) {
  std::map<int, int> rank_of_node;
  for (std::size_t n = 0; !body.shell.empty() && n < of_body.size(); ++n) rank_of_node[static_cast<int>(n)] = of_body[n];
  for (std::size_t c = 0; c < body.cells.size(); ++c)
    for (const int node : body.cells[c]) rank_of_node.try_emplace(node, cell_rank[c]);
  std::vector<int> rank;
  for (const auto& facet : body.skin_facets) rank.push_back(rank_of_node.at(facet[0]));
  return rank;
}

std::vector<int> triangle_ranks_by_facet(const mesh::BodyMesh& body, const mesh::GarmentMesh& garment,
                                         const std::vector<int>& facet_rank) {
  std::vector<int> rank;
  for (const auto& triangle : garment.triangles) {
    const Eigen::Vector3d centre =
        (garment.placed[triangle[3]] + garment.placed[triangle[4]] + garment.placed[triangle[5]]) / 3.0;
    double nearest = std::numeric_limits<double>::max();
    int found = 0;
    for (std::size_t f = 0; f < body.skin_facets.size(); ++f)
      if (const double d = (body.nodes[body.skin_facets[f][0]] - centre).squaredNorm(); d < nearest)
        nearest = d, found = facet_rank[f];
    rank.push_back(found);
  }
  return rank;
}

std::vector<std::array<int, 6>> sewn(const mesh::GarmentMesh& garment) {
  auto triangles = garment.triangles;
  for (auto& triangle : triangles)
    for (int& node : triangle) node = garment.merged[node];
  return triangles;
}

template <class Elements>
void lowest(const Elements& elements, const std::vector<int>& rank, std::vector<int>& owner) {
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const int node : elements[e])
      if (node >= 0) owner[node] = std::min(owner[node], rank[e]);
}

std::vector<int> body_owners(const mesh::BodyMesh& body, const std::vector<int>& cell_rank, int nodes, int ranks) {
  std::vector<int> owner(nodes, ranks - 1);
  if (!body.shell.empty()) {
    std::vector<std::array<int, 6>> shell(body.shell.size());
    for (std::size_t t = 0; t < shell.size(); ++t) std::copy_n(body.shell[t].nodes.begin(), 6, shell[t].begin());
    lowest(shell, share_out(shell, ranks), owner);
  }
  lowest(body.cells, cell_rank, owner);
  return owner;
}

void put(const Field& field, const std::vector<int>& of_item, std::vector<int>& owner) {
  for (int i = 0; i < field.count; ++i)
    for (int c = 0; c < field.components; ++c) owner[field(i, c)] = of_item[i];
}

}  // namespace

std::vector<int> entry_owners(const Model& model, const Meshes& meshes, const Layout& layout, int ranks) {
  std::vector<int> owner(layout.size(), 0);
  if (ranks == 1) return owner;
  const Field& position = layout["body"];
  std::vector<int> cell_rank, of_body;
  if (position.count > 0) {
    cell_rank = share_out(meshes.body.cells, ranks);
    of_body = body_owners(meshes.body, cell_rank, position.count, ranks);
    std::vector<int> of_pressure(layout["body pressure"].count, ranks - 1);
    lowest(pressure_unknowns(meshes.body).of_cell, cell_rank, of_pressure);
    put(position, of_body, owner), put(layout["body pressure"], of_pressure, owner);
  }
  std::vector<std::vector<int>> of_garment;
  for (const mesh::GarmentMesh& garment : meshes.garments) {
    const auto triangles = sewn(garment);
    const int nodes = static_cast<int>(garment.pattern.size());
    const std::vector<int> rank = position.count > 0 ? triangle_ranks_by_facet(meshes.body, garment, facet_ranks(meshes.body, cell_rank, of_body))
                                                     : share_out(triangles, ranks);
    lowest(triangles, rank, of_garment.emplace_back(nodes, ranks - 1));
    put(layout[garment.name], of_garment.back(), owner);
  }
  for (const ContactModel& contact : model.contacts) {
    const Field& pressures = layout[contact.name];
    std::vector<int> of_vertex;
    if (contact.garment >= 0)
      for (const int node : garment_slave({}, meshes.garments[contact.garment]).node_of_vertex()) of_vertex.push_back(of_garment[contact.garment][node]);
    else if (pressures.count > 0)
      for (const int node : surface_slave(position, meshes.body, slave_facets(meshes.body, contact)).node_of_vertex())
        of_vertex.push_back(of_body[node]);
    put(pressures, of_vertex, owner);
  }
  if (position.count > 0)
    for (const input::ToolSpec& tool : model.asked.tools) {
      std::vector<int> of_vertex;
      for (const int node : place_tool(meshes.body, tool).surface.node_of_vertex) of_vertex.push_back(of_body[node]);
      put(layout[tool_pressures(tool)], of_vertex, owner);
    }
  return owner;
}

}  // namespace snug::solver
