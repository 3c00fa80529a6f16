#include "postproc/field_cells.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkStaticCellLocator.h>
#include <vtkStaticPointLocator.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "postproc/vtu_file.hpp"

namespace snug::postproc {

struct FieldCells::Grid {
  vtkSmartPointer<vtkUnstructuredGrid> cells;
  vtkNew<vtkStaticCellLocator> locator;
  vtkNew<vtkGenericCell> cell;
};

FieldCells::FieldCells(std::unique_ptr<Grid> grid) : grid_(std::move(grid)) {
  grid_->locator->SetDataSet(grid_->cells);
  grid_->locator->BuildLocator();
}

FieldCells::~FieldCells() = default;

CellPlace FieldCells::place_of(const Eigen::Vector3d& point) const {
  vtkGenericCell& cell = *grid_->cell;
  std::array<double, 3> x = {point.x(), point.y(), point.z()}, parametric, closest;
  std::vector<double> weights(grid_->cells->GetMaxCellSize(), 0.0);
  int sub = 0;
  double distance2 = 0.0;
  vtkIdType id = grid_->locator->FindCell(x.data(), 0.0, &cell, parametric.data(), weights.data());
  if (id < 0) {  // beside the grid: the nearest place in it
    grid_->locator->FindClosestPoint(x.data(), closest.data(), &cell, id, sub, distance2);
    if (id < 0) return {};
    grid_->cells->GetCell(id, &cell);
    cell.EvaluatePosition(x.data(), closest.data(), sub, parametric.data(), distance2, weights.data());
    for (double& r : parametric) r = std::clamp(r, 0.0, 1.0);
    cell.EvaluateLocation(sub, parametric.data(), closest.data(), weights.data());
  } else {
    grid_->cells->GetCell(id, &cell);
  }
  CellPlace place;
  place.cell_size = std::sqrt(cell.GetLength2());
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  for (int n = 0; n < cell.GetNumberOfPoints(); ++n) {
    place.nodes.push_back(static_cast<int>(cell.GetPointId(n)));
    place.weights.push_back(weights[n]);
    at += weights[n] * Eigen::Vector3d(grid_->cells->GetPoint(cell.GetPointId(n)));
  }
  place.gap = (at - point).norm();
  return place;
}

namespace {

void add_components(NodalField& field, vtkPointData& data, const char* name, const std::vector<const char*>& labels) {
  vtkDataArray* array = data.GetArray(name);
  if (!array || array->GetNumberOfComponents() != static_cast<int>(labels.size())) return;
  for (std::size_t c = 0; c < labels.size(); ++c) {
    NodalColumn& column = field.columns.emplace_back(NodalColumn{labels[c], {}});
    for (vtkIdType n = 0; n < array->GetNumberOfTuples(); ++n)
      column.values.push_back(array->GetComponent(n, static_cast<int>(c)));
  }
}

}  // namespace

NodalField read_grid(const std::filesystem::path& vtu, std::optional<ShellSurface> surface) {
  const input::Location where{vtu.string(), 0, 0};
  auto grid = std::make_unique<FieldCells::Grid>();
  grid->cells = read_vtu(vtu);
  NodalField field;
  field.name = vtu.string();
  field.nodes.resize(grid->cells->GetNumberOfPoints());
  std::iota(field.nodes.begin(), field.nodes.end(), 1);
  if (vtkDataArray* numbers = grid->cells->GetPointData()->GetArray("node_number"))
    for (vtkIdType n = 0; n < numbers->GetNumberOfTuples(); ++n) field.nodes[n] = static_cast<int>(numbers->GetComponent(n, 0));
  for (vtkIdType n = 0; n < grid->cells->GetNumberOfPoints(); ++n) field.places.emplace_back(grid->cells->GetPoint(n));
  add_components(field, *grid->cells->GetPointData(), "displacement", {"UX", "UY", "UZ"});
  vtkPointData& points = *grid->cells->GetPointData();
  const bool shell = points.GetArray("stress_top") != nullptr;
  if (shell && !surface) {
    add_components(field, points, "stress_top", {"SX TOP", "SY TOP", "SZ TOP", "SXY TOP", "SYZ TOP", "SXZ TOP"});
    add_components(field, points, "stress_bottom",
                   {"SX BOTTOM", "SY BOTTOM", "SZ BOTTOM", "SXY BOTTOM", "SYZ BOTTOM", "SXZ BOTTOM"});
  } else {
    const bool middle = !shell || surface == ShellSurface::middle;
    add_components(field, points, middle ? "cauchy_stress" : surface == ShellSurface::top ? "stress_top" : "stress_bottom",
                   {"SX", "SY", "SZ", "SXY", "SYZ", "SXZ"});
  }
  if (field.columns.empty())
    throw input::InputError(where, "its points have neither displacement nor cauchy_stress",
                            "name the grid of a body, body_0000.vtu");
  set_invariants(field);
  if (grid->cells->GetNumberOfCells() > 0) field.cells = std::make_shared<const FieldCells>(std::move(grid));
  return field;
}

std::vector<CellPlace> nearest_nodes(const NodalField& from, const std::vector<Eigen::Vector3d>& points) {
  vtkNew<vtkPoints> nodes;
  nodes->SetDataTypeToDouble();
  std::vector<int> known;  // a node may have values and no place
  for (std::size_t n = 0; n < from.places.size(); ++n) {
    if (!from.places[n].allFinite()) continue;
    nodes->InsertNextPoint(from.places[n].data());
    known.push_back(static_cast<int>(n));
  }
  std::vector<CellPlace> places(points.size());
  if (known.empty()) return places;
  vtkNew<vtkUnstructuredGrid> cloud;
  cloud->SetPoints(nodes);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(cloud);
  locator->BuildLocator();
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (!points[p].allFinite()) continue;
    const int node = known[locator->FindClosestPoint(points[p].data())];
    places[p] = {{node}, {1.0}, (from.places[node] - points[p]).norm(), 0.0};
  }
  return places;
}

void write_columns(const NodalField& field, const std::filesystem::path& vtu) {
  vtkNew<vtkUnstructuredGrid> grid;
  if (field.cells) {
    grid->CopyStructure(field.cells->grid().cells);
  } else {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const Eigen::Vector3d& x : field.places) {
      const vtkIdType id = points->InsertNextPoint(x.data());
      grid->InsertNextCell(VTK_VERTEX, 1, &id);
    }
    grid->SetPoints(points);
  }
  for (const NodalColumn& column : field.columns) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(column.label.c_str());
    for (const double value : column.values) array->InsertNextValue(value);
    grid->GetPointData()->AddArray(array);
  }
  write_vtu(*grid, vtu);
}

}  // namespace snug::postproc
