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

struct FieldCells::Locator {
  vtkSmartPointer<vtkUnstructuredGrid> cells;
  vtkNew<vtkStaticCellLocator> locator;
  vtkNew<vtkGenericCell> cell;
};

FieldCells::FieldCells(const Grid& grid) : locator_(std::make_unique<Locator>()) {
  locator_->cells = cells_to_vtk(grid);
  locator_->locator->SetDataSet(locator_->cells);
  locator_->locator->BuildLocator();
}

FieldCells::~FieldCells() = default;

CellPlace FieldCells::place_of(const Eigen::Vector3d& point) const {
  vtkGenericCell& cell = *locator_->cell;
  std::array<double, 3> x = {point.x(), point.y(), point.z()}, parametric, closest;
  std::vector<double> weights(locator_->cells->GetMaxCellSize(), 0.0);
  int sub = 0;
  double distance2 = 0.0;
  vtkIdType id = locator_->locator->FindCell(x.data(), 0.0, &cell, parametric.data(), weights.data());
  if (id < 0) {  // beside the grid: the nearest place in it
    locator_->locator->FindClosestPoint(x.data(), closest.data(), &cell, id, sub, distance2);
    if (id < 0) return {};
    locator_->cells->GetCell(id, &cell);
    cell.EvaluatePosition(x.data(), closest.data(), sub, parametric.data(), distance2, weights.data());
    for (double& r : parametric) r = std::clamp(r, 0.0, 1.0);
    cell.EvaluateLocation(sub, parametric.data(), closest.data(), weights.data());
  } else {
    locator_->cells->GetCell(id, &cell);
  }
  CellPlace place;
  place.cell_size = std::sqrt(cell.GetLength2());
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  for (int n = 0; n < cell.GetNumberOfPoints(); ++n) {
    place.nodes.push_back(static_cast<int>(cell.GetPointId(n)));
    place.weights.push_back(weights[n]);
    at += weights[n] * Eigen::Vector3d(locator_->cells->GetPoint(cell.GetPointId(n)));
  }
  place.gap = (at - point).norm();
  return place;
}

namespace {

using Labels = std::vector<std::string>;

std::string label_of(const NamedField& field, std::size_t component) {
  return field.components.empty() ? field.name : field.name + " " + field.components[component];
}

void add_column(NodalField& to, const NamedField& field, std::size_t component, NodalColumn column) {
  column.values.reserve(field.size());
  for (std::size_t n = 0; n < field.size(); ++n) column.values.push_back(field.at(n, component));
  to.columns.push_back(std::move(column));
}

template <class Value>
void add_components(NodalField& to, const Grid& grid, const FieldName<Value>& name, const Labels& labels) {
  const NamedField* field = grid.fields.find(std::string_view(name.name));
  if (!field || field->place != Place::node || field->components.size() != labels.size()) return;
  for (std::size_t c = 0; c < labels.size(); ++c) add_column(to, *field, c, {labels[c], {}});
}

void add_stresses(NodalField& to, const Grid& grid, std::optional<ShellSurface> surface) {
  const bool shell = grid.fields.has(field::stress_top);
  if (shell && !surface) {
    add_components(to, grid, field::stress_top, {"SX TOP", "SY TOP", "SZ TOP", "SXY TOP", "SYZ TOP", "SXZ TOP"});
    add_components(to, grid, field::stress_bottom, {"SX BOTTOM", "SY BOTTOM", "SZ BOTTOM", "SXY BOTTOM", "SYZ BOTTOM", "SXZ BOTTOM"});
    return;
  }
  const bool middle = !shell || surface == ShellSurface::middle;
  add_components(to, grid, middle ? field::cauchy_stress : surface == ShellSurface::top ? field::stress_top : field::stress_bottom,
                 {"SX", "SY", "SZ", "SXY", "SYZ", "SXZ"});
}

/// What is compared only where it is asked for.
void add_others(NodalField& to, const Grid& grid) {
  for (const NamedField& field : grid.fields)
    if (field.place == Place::node && !std::holds_alternative<std::vector<int>>(field.values))
      for (std::size_t c = 0; c < std::max<std::size_t>(1, field.components.size()); ++c)
        add_column(to, field, c, {label_of(field, c), {}, true});
}

}  // namespace

NodalField nodal_field(const Grid& grid, const std::string& name, std::optional<ShellSurface> surface) {
  NodalField field;
  field.name = name;
  field.nodes.resize(grid.points.size());
  std::iota(field.nodes.begin(), field.nodes.end(), 1);
  if (const NamedField* numbers = grid.fields.find(std::string_view(field::node_number.name)))
    for (std::size_t n = 0; n < field.nodes.size(); ++n) field.nodes[n] = static_cast<int>(numbers->at(n));
  field.places = grid.points;
  add_components(field, grid, field::displacement, {"UX", "UY", "UZ"});
  add_stresses(field, grid, surface);
  if (field.columns.empty())
    throw input::InputError({name, 0, 0}, "its points have neither displacement nor cauchy_stress",
                            "name the grid of a body, body_0000.vtu");
  set_invariants(field);
  add_others(field, grid);
  if (grid.cells() > 0) field.cells = std::make_shared<const FieldCells>(grid);
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
    grid->CopyStructure(field.cells->locator().cells);
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
