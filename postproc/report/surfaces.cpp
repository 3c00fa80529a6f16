#include "postproc/report/surfaces.hpp"

#include <vtkCell.h>
#include <vtkUnstructuredGrid.h>

#include <numeric>
#include <stdexcept>

#include "postproc/store.hpp"
#include "postproc/vtu_file.hpp"

namespace snug::postproc::report {

namespace fs = std::filesystem;

namespace {

/// The values of a field; `entries` zeros where the file does not have it.
template <class Value>
std::vector<Value> values_of(const Grid& grid, const FieldName<Value>& name, std::size_t entries, const Value& zero) {
  const std::vector<Value>* values = grid.fields.find(name);
  return values && values->size() == entries ? *values : std::vector<Value>(entries, zero);
}

/// Plane triangles of a facet with VTK's order of nodes: corners, then edges, then the middle.
const std::vector<Triangle>& cut(vtkIdType nodes) {
  static const std::vector<Triangle> quad = {{0, 1, 2}, {0, 2, 3}}, triangle = {{0, 1, 2}},
                                     quadratic = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}},
                                     biquadratic = {{0, 4, 8}, {0, 8, 7}, {4, 1, 5}, {4, 5, 8},
                                                    {8, 5, 2}, {8, 2, 6}, {7, 8, 6}, {7, 6, 3}};
  if (nodes == 9) return biquadratic;
  if (nodes == 6) return quadratic;
  if (nodes == 4) return quad;
  if (nodes == 3) return triangle;
  throw std::runtime_error("a facet of " + std::to_string(nodes) + " nodes is not known");
}

void add_facet(vtkCell& facet, const std::vector<int>& local, std::vector<Triangle>& triangles) {
  for (const Triangle& part : cut(facet.GetNumberOfPoints())) {
    Triangle triangle{};
    for (int n = 0; n < 3; ++n) triangle[n] = local[facet.GetPointId(part[n])];
    triangles.push_back(triangle);
  }
}

bool all_on_skin(vtkCell& facet, const std::vector<int>& local) {
  for (vtkIdType n = 0; n < facet.GetNumberOfPoints(); ++n)
    if (local[facet.GetPointId(n)] < 0) return false;
  return true;
}

template <class Value>
std::vector<Value> chosen(const std::vector<Value>& all, const std::vector<int>& nodes) {
  std::vector<Value> result;
  for (const int node : nodes) result.push_back(all.at(node));
  return result;
}

/// The skin's cells: faces of cells all of whose nodes are on it, or surface cells.
std::vector<Triangle> skin_triangles(const Grid& grid, const std::vector<int>& local) {
  const auto cells = cells_to_vtk(grid);
  std::vector<Triangle> triangles;
  for (vtkIdType c = 0; c < cells->GetNumberOfCells(); ++c) {
    vtkCell& cell = *cells->GetCell(c);
    if (cell.GetCellDimension() == 2) add_facet(cell, local, triangles);
    for (int f = 0; f < cell.GetNumberOfFaces(); ++f)
      if (all_on_skin(*cell.GetFace(f), local)) add_facet(*cell.GetFace(f), local, triangles);
  }
  return triangles;
}

/// Location of a node; -1 where it is none of the names.
int known(int location, std::size_t names) { return location >= 0 && location < static_cast<int>(names) ? location : -1; }

}  // namespace

Skin skin_of(const Grid& grid, const std::vector<int>& nodes) {
  const std::size_t count = grid.points.size();
  std::vector<int> local(count, -1);
  for (std::size_t n = 0; n < nodes.size(); ++n) local.at(nodes[n]) = static_cast<int>(n);
  Skin skin;
  const std::vector<int>* given = grid.fields.find(field::node_number);
  for (const int node : nodes) skin.numbers.push_back(given ? (*given)[node] : node + 1);
  skin.nodes = chosen(grid.points, nodes);
  skin.displacement = chosen(values_of<Eigen::Vector3d>(grid, field::displacement, count, Eigen::Vector3d::Zero()), nodes);
  skin.pressure = chosen(values_of(grid, field::contact_pressure, count, 0.0), nodes);
  if (grid.fields.has(field::pressure_inside)) skin.beside = chosen(values_of(grid, field::pressure_inside, count, 0.0), nodes);
  skin.coverage = chosen(values_of(grid, field::coverage, count, 0.0), nodes);
  if (const auto* names = grid.find_names("location_names")) skin.locations = *names;
  for (const int location : chosen(values_of(grid, field::location, count, 0), nodes))
    skin.location.push_back(known(location, skin.locations.size()));
  skin.triangles = skin_triangles(grid, local);
  return skin;
}

Skin read_skin(const fs::path& vtu, const fs::path& skin_csv) {
  const Grid grid = read_grid(vtu);
  return skin_of(grid, read_skin_nodes(skin_csv, grid));
}

Garment garment_of(const Grid& grid) {
  const std::size_t count = grid.points.size(), cells = grid.cells();
  Garment garment;
  garment.nodes = grid.points;
  garment.displacement = values_of<Eigen::Vector3d>(grid, field::displacement, count, Eigen::Vector3d::Zero());
  garment.pressure = values_of(grid, field::contact_pressure, count, 0.0);
  std::vector<int> same(count);
  std::iota(same.begin(), same.end(), 0);
  const auto warp = values_of(grid, field::tension_warp, cells, 0.0), weft = values_of(grid, field::tension_weft, cells, 0.0),
             wrinkled = values_of(grid, field::wrinkled, cells, 0.0);
  const auto vtk = cells_to_vtk(grid);
  for (std::size_t c = 0; c < cells; ++c) {
    add_facet(*vtk->GetCell(static_cast<vtkIdType>(c)), same, garment.triangles);
    garment.tension_warp.resize(garment.triangles.size(), warp[c]);
    garment.tension_weft.resize(garment.triangles.size(), weft[c]);
    garment.wrinkled.resize(garment.triangles.size(), wrinkled[c]);
  }
  return garment;
}

Garment read_garment(const fs::path& vtu) { return garment_of(read_grid(vtu)); }

}  // namespace snug::postproc::report
