#include "postproc/report/surfaces.hpp"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>

#include <stdexcept>

#include "cases/input/csv.hpp"
#include "postproc/vtu_file.hpp"

namespace snug::postproc::report {

namespace fs = std::filesystem;

namespace {

/// Component c of every entry of a field; `entries` zeros where the file does not have it.
std::vector<double> field(vtkFieldData& data, const char* name, vtkIdType entries, int component = 0) {
  std::vector<double> values(static_cast<std::size_t>(entries), 0.0);
  if (vtkDataArray* array = data.GetArray(name))
    if (component < array->GetNumberOfComponents())
      for (vtkIdType n = 0; n < entries; ++n) values[n] = array->GetComponent(n, component);
  return values;
}

std::vector<Eigen::Vector3d> vectors(vtkFieldData& data, const char* name, vtkIdType entries) {
  const auto x = field(data, name, entries, 0), y = field(data, name, entries, 1), z = field(data, name, entries, 2);
  std::vector<Eigen::Vector3d> result;
  for (std::size_t n = 0; n < x.size(); ++n) result.emplace_back(x[n], y[n], z[n]);
  return result;
}

std::vector<Eigen::Vector3d> points(vtkUnstructuredGrid& grid) {
  std::vector<Eigen::Vector3d> result;
  for (vtkIdType n = 0; n < grid.GetNumberOfPoints(); ++n) result.emplace_back(grid.GetPoint(n));
  return result;
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

/// The column `node`, every number one of the grid's.
std::vector<int> skin_numbers(const fs::path& file, vtkIdType count) {
  input::Diagnostics diagnostics;
  const input::Csv csv = input::read_csv(file, diagnostics);
  const std::vector<double> numbers = input::numbers(csv, "node", "", diagnostics);
  for (std::size_t r = 0; r < numbers.size(); ++r)
    if (!(numbers[r] >= 1.0 && numbers[r] <= static_cast<double>(count)))
      diagnostics.error({file.string(), csv.rows[r].line, 1}, "node " + csv.rows[r].cells[csv.find("node")] + " is none of the grid's " + std::to_string(count),
                        "run the case again");
  diagnostics.throw_if_any();
  return {numbers.begin(), numbers.end()};
}

std::vector<std::string> names(vtkFieldData& data, const char* name) {
  std::vector<std::string> result;
  if (auto* array = vtkStringArray::SafeDownCast(data.GetAbstractArray(name)))
    for (vtkIdType n = 0; n < array->GetNumberOfValues(); ++n) result.push_back(array->GetValue(n));
  return result;
}

template <class Value>
std::vector<Value> chosen(const std::vector<Value>& all, const std::vector<int>& numbers) {
  std::vector<Value> result;
  for (const int number : numbers) result.push_back(all.at(number - 1));
  return result;
}

}  // namespace

Skin read_skin(const fs::path& vtu, const fs::path& skin_csv) {
  const auto grid = read_vtu(vtu);
  const vtkIdType count = grid->GetNumberOfPoints();
  vtkPointData& data = *grid->GetPointData();
  Skin skin;
  skin.numbers = skin_numbers(skin_csv, count);
  std::vector<int> local(static_cast<std::size_t>(count), -1);
  for (std::size_t n = 0; n < skin.numbers.size(); ++n) local.at(skin.numbers[n] - 1) = static_cast<int>(n);
  skin.nodes = chosen(points(*grid), skin.numbers);
  skin.displacement = chosen(vectors(data, "displacement", count), skin.numbers);
  skin.pressure = chosen(field(data, "contact_pressure", count), skin.numbers);
  if (data.GetArray("pressure_inside")) skin.beside = chosen(field(data, "pressure_inside", count), skin.numbers);
  skin.coverage = chosen(field(data, "coverage", count), skin.numbers);
  skin.locations = names(*grid->GetFieldData(), "location_names");
  const auto location = field(data, "location", count);
  const auto known = [&](double l) { return l >= 0.0 && l < static_cast<double>(skin.locations.size()); };
  for (const int number : skin.numbers)
    skin.location.push_back(known(location[number - 1]) ? static_cast<int>(location[number - 1]) : -1);
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    vtkCell& cell = *grid->GetCell(c);
    if (cell.GetCellDimension() == 2) add_facet(cell, local, skin.triangles);
    for (int f = 0; f < cell.GetNumberOfFaces(); ++f)
      if (all_on_skin(*cell.GetFace(f), local)) add_facet(*cell.GetFace(f), local, skin.triangles);
  }
  return skin;
}

Garment read_garment(const fs::path& vtu) {
  const auto grid = read_vtu(vtu);
  const vtkIdType count = grid->GetNumberOfPoints(), cells = grid->GetNumberOfCells();
  Garment garment;
  garment.nodes = points(*grid);
  garment.displacement = vectors(*grid->GetPointData(), "displacement", count);
  garment.pressure = field(*grid->GetPointData(), "contact_pressure", count);
  std::vector<int> same(static_cast<std::size_t>(count));
  for (std::size_t n = 0; n < same.size(); ++n) same[n] = static_cast<int>(n);
  const auto warp = field(*grid->GetCellData(), "tension_warp", cells),
             weft = field(*grid->GetCellData(), "tension_weft", cells),
             wrinkled = field(*grid->GetCellData(), "wrinkled", cells);
  for (vtkIdType c = 0; c < cells; ++c) {
    add_facet(*grid->GetCell(c), same, garment.triangles);
    garment.tension_warp.resize(garment.triangles.size(), warp[c]);
    garment.tension_weft.resize(garment.triangles.size(), weft[c]);
    garment.wrinkled.resize(garment.triangles.size(), wrinkled[c]);
  }
  return garment;
}

}  // namespace snug::postproc::report
