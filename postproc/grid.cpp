#include "postproc/grid.hpp"

#include <fmt/format.h>
#include <vtkBiQuadraticQuad.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkHexahedron.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkQuad.h>
#include <vtkStringArray.h>
#include <vtkTriQuadraticHexahedron.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "cases/input/files.hpp"
#include "postproc/vtu_file.hpp"

namespace snug::postproc {
namespace {

using Names = std::vector<std::string>;

/// A field as an array of VTK, with its unit where VTK's readers and ParaView look for it (UNITS_LABEL).
vtkSmartPointer<vtkDataArray> array_of(const NamedField& field) {
  vtkSmartPointer<vtkDataArray> array;
  if (std::holds_alternative<std::vector<int>>(field.values)) array = vtkSmartPointer<vtkIntArray>::New();
  else array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(field.name.c_str());
  if (!field.unit.empty()) array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), field.unit);
  const int count = std::max(1, static_cast<int>(field.components.size()));
  array->SetNumberOfComponents(count);
  for (std::size_t c = 0; c < field.components.size(); ++c) array->SetComponentName(static_cast<vtkIdType>(c), field.components[c].c_str());
  array->SetNumberOfTuples(static_cast<vtkIdType>(field.size()));
  for (std::size_t n = 0; n < field.size(); ++n)
    for (int c = 0; c < count; ++c) array->SetComponent(static_cast<vtkIdType>(n), c, field.at(n, c));
  return array;
}

template <class Value>
std::vector<Value> tuples(vtkDataArray& array) {
  std::vector<Value> values(static_cast<std::size_t>(array.GetNumberOfTuples()));
  for (std::size_t n = 0; n < values.size(); ++n)
    for (int c = 0; c < array.GetNumberOfComponents(); ++c) {
      const double value = array.GetComponent(static_cast<vtkIdType>(n), c);
      if constexpr (std::is_arithmetic_v<Value>) values[n] = static_cast<Value>(value);
      else values[n][c] = value;
    }
  return values;
}

/// The values of an array, where they are of a kind that fields have.
std::optional<NamedField::Values> values_of(vtkDataArray& array) {
  switch (array.GetNumberOfComponents()) {
    case 1:
      if (array.GetDataType() == VTK_INT) return tuples<int>(array);
      return tuples<double>(array);
    case 2: return tuples<Eigen::Vector2d>(array);
    case 3: return tuples<Eigen::Vector3d>(array);
    case 6: return tuples<Stress>(array);
    default: return {};
  }
}

void read_fields(vtkFieldData& data, Place place, Fields& fields) {
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    vtkDataArray* array = data.GetArray(i);
    if (!array || !array->GetName() || fields.find(std::string_view(array->GetName()))) continue;
    std::optional<NamedField::Values> values = values_of(*array);
    if (!values) continue;
    const FieldMeaning known = meaning_of(array->GetName());
    const char* unit = array->HasInformation() ? array->GetInformation()->Get(vtkDataArray::UNITS_LABEL()) : nullptr;
    NamedField field{array->GetName(), unit ? std::string(unit) : std::string(known.unit), std::string(known.description), place, std::move(*values), {}};
    for (int c = 0; array->GetNumberOfComponents() > 1 && c < array->GetNumberOfComponents(); ++c)
      field.components.emplace_back(array->GetComponentName(c) ? array->GetComponentName(c) : std::to_string(c + 1));
    fields.add(std::move(field));
  }
}

/// Where VTK's node n of a hexahedron or quadrilateral stands in our tensor order, read from the parametric coordinates
/// of VTK's own cell; `along` nodes along an edge.
template <class Cell>
std::vector<int> tensor_order(int along) {
  vtkNew<Cell> cell;
  const double* at = cell->GetParametricCoords();
  std::vector<int> order;
  for (int n = 0; n < cell->GetNumberOfPoints(); ++n) {
    const auto place = [&](int axis) { return static_cast<int>(std::lround((along - 1) * at[3 * n + axis])); };
    order.push_back(along * along * place(2) + along * place(1) + place(0));
  }
  return order;
}

/// A kind of cell in VTK: its type and where VTK's nodes stand in ours.
struct GridCell {
  int type;
  std::vector<int> order;
};

GridCell volume_cell(int nodes) {
  if (nodes == 27) return {VTK_TRIQUADRATIC_HEXAHEDRON, tensor_order<vtkTriQuadraticHexahedron>(3)};
  if (nodes == 8) return {VTK_HEXAHEDRON, tensor_order<vtkHexahedron>(2)};
  return {VTK_QUADRATIC_TETRA, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}};
}

GridCell surface_cell(int nodes) {
  if (nodes == 9) return {VTK_BIQUADRATIC_QUAD, tensor_order<vtkBiQuadraticQuad>(3)};
  if (nodes == 4) return {VTK_QUAD, tensor_order<vtkQuad>(2)};
  return {VTK_QUADRATIC_TRIANGLE, {0, 1, 2, 3, 4, 5}};
}

template <std::size_t count>
void add_cells(Grid& grid, const GridCell& kind, const std::vector<std::array<int, count>>& cells) {
  for (const auto& cell : cells) {
    for (const int place : kind.order) grid.nodes.push_back(cell[place]);
    grid.types.push_back(static_cast<unsigned char>(kind.type));
    grid.ends.push_back(static_cast<int>(grid.nodes.size()));
  }
}

void add_names(Grid& grid, const char* name, const Names& names) {
  if (!names.empty()) grid.names.emplace_back(name, names);
}

template <class Value>
void add_unless_empty(Grid& grid, const FieldName<Value>& name, const std::vector<Value>& values) {
  if (!values.empty()) grid.fields.add(named(name, values));
}

void add_body_cells(Grid& grid, const BodyResult& body) {
  if (body.cells.empty())  // a rigid body is its skin
    return add_cells(grid, surface_cell(body.facet_nodes), body.skin_facets);
  add_cells(grid, volume_cell(body.cell_nodes), body.cells);
  add_unless_empty(grid, field::layer, body.cell_layer);
  add_names(grid, "layer_names", body.layers);
}

/// Where the nodes lie on the flat pieces, of several garments one over the other; and which piece a triangle is of.
void add_pieces(Grid& grid, const GarmentResult& garment) {
  constexpr double apart = 0.1;  // m
  std::vector<Eigen::Vector2d> flat = garment.pattern;
  std::vector<int> piece = garment.piece;
  Names names;
  double top = 0.0;
  for (const GarmentPart& part : garment.parts) {
    double low = std::numeric_limits<double>::max(), high = -low;
    for (int n = part.first_node; n < part.end_node; ++n) low = std::min(low, flat[n].y()), high = std::max(high, flat[n].y());
    for (int n = part.first_node; n < part.end_node; ++n) flat[n].y() += top - low;
    top += high - low + apart;
    for (int t = part.first_triangle; t < part.end_triangle && !piece.empty(); ++t) piece[t] += static_cast<int>(names.size());
    for (const std::string& name : part.pieces) names.push_back(garment.parts.size() > 1 ? part.name + ", " + name : name);
  }
  add_unless_empty(grid, field::pattern, flat);
  add_unless_empty(grid, field::piece, piece);
  add_names(grid, "piece_names", names);
}

void add_recorded(Grid& grid, const Fields& fields) {
  for (const NamedField& field : fields)
    if (field.recorded) grid.fields.add(field);
}

/// Rating of the node's location where the node is covered; NaN elsewhere. One value a location, because the curves
/// were fitted to pressures of whole locations.
void add_sensation(Grid& grid, const BodyResult& body, const Evaluation& evaluation) {
  if (std::none_of(evaluation.locations.begin(), evaluation.locations.end(), [](const LocationRow& row) { return row.rating.has_value(); })) return;
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double>* coverage = body.fields.find(field::coverage);
  std::vector<double> rating(body.nodes.size(), none);
  for (std::size_t n = 0; n < rating.size(); ++n) {
    const int location = n < body.node_location.size() ? body.node_location[n] : -1;
    const bool covered = coverage && n < coverage->size() && (*coverage)[n] > 0;
    if (location >= 0 && covered) rating[n] = evaluation.locations.at(location).rating.value_or(none);
  }
  grid.fields.add(named(field::sensation, std::move(rating)));
}

/// Every field needs a value a point or cell; ParaView crashes on a shorter one.
void check_sizes(vtkUnstructuredGrid& grid, const std::filesystem::path& vtu) {
  const auto check = [&](vtkFieldData& data, vtkIdType entries) {
    for (int i = 0; i < data.GetNumberOfArrays(); ++i)
      if (data.GetAbstractArray(i)->GetNumberOfTuples() != entries)
        throw std::runtime_error(fmt::format("{}: field {} has {} values for {} entries", vtu.string(),
                                             data.GetArrayName(i), data.GetAbstractArray(i)->GetNumberOfTuples(),
                                             entries));
  };
  check(*grid.GetPointData(), grid.GetNumberOfPoints());
  check(*grid.GetCellData(), grid.GetNumberOfCells());
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> cells_to_vtk(const Grid& grid) {
  auto vtk = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Eigen::Vector3d& x : grid.points) points->InsertNextPoint(x.data());
  vtk->SetPoints(points);
  vtk->Allocate(static_cast<vtkIdType>(grid.cells()));
  std::vector<vtkIdType> ids;
  for (std::size_t c = 0; c < grid.cells(); ++c) {
    const std::span<const int> nodes = grid.nodes_of(c);
    ids.assign(nodes.begin(), nodes.end());
    vtk->InsertNextCell(grid.types[c], static_cast<vtkIdType>(ids.size()), ids.data());
  }
  return vtk;
}

namespace {

vtkSmartPointer<vtkUnstructuredGrid> to_vtk(const Grid& grid) {
  auto vtk = cells_to_vtk(grid);
  for (const NamedField& field : grid.fields)
    (field.place == Place::node ? static_cast<vtkFieldData*>(vtk->GetPointData()) : vtk->GetCellData())->AddArray(array_of(field));
  for (const auto& [name, texts] : grid.names) {
    vtkNew<vtkStringArray> array;
    array->SetName(name.c_str());
    for (const std::string& text : texts) array->InsertNextValue(text);
    vtk->GetFieldData()->AddArray(array);
  }
  return vtk;
}

}  // namespace

Grid read_grid(const std::filesystem::path& vtu) {
  const auto vtk = read_vtu(vtu);
  Grid grid;
  for (vtkIdType n = 0; n < vtk->GetNumberOfPoints(); ++n) grid.points.emplace_back(vtk->GetPoint(n));
  for (vtkIdType c = 0; c < vtk->GetNumberOfCells(); ++c) {
    vtkIdType count = 0;
    const vtkIdType* nodes = nullptr;
    vtk->GetCellPoints(c, count, nodes);
    grid.nodes.insert(grid.nodes.end(), nodes, nodes + count);
    grid.types.push_back(static_cast<unsigned char>(vtk->GetCellType(c)));
    grid.ends.push_back(static_cast<int>(grid.nodes.size()));
  }
  read_fields(*vtk->GetPointData(), Place::node, grid.fields);
  read_fields(*vtk->GetCellData(), Place::cell, grid.fields);
  for (int i = 0; i < vtk->GetFieldData()->GetNumberOfArrays(); ++i)
    if (auto* array = vtkStringArray::SafeDownCast(vtk->GetFieldData()->GetAbstractArray(i)); array && array->GetName()) {
      Names& texts = grid.names.emplace_back(array->GetName(), Names{}).second;
      for (vtkIdType n = 0; n < array->GetNumberOfValues(); ++n) texts.push_back(array->GetValue(n));
    }
  return grid;
}

void write_grid(const Grid& grid, const std::filesystem::path& vtu) {
  const auto vtk = to_vtk(grid);
  check_sizes(*vtk, vtu);
  write_vtu(*vtk, vtu);
}

const std::vector<std::string>* Grid::find_names(std::string_view name) const {
  const auto found = std::find_if(names.begin(), names.end(), [&](const auto& entry) { return entry.first == name; });
  return found == names.end() ? nullptr : &found->second;
}

Grid grid_of(const BodyResult& body, const Evaluation& evaluation) {
  Grid grid;
  grid.points = body.nodes;
  add_body_cells(grid, body);
  add_recorded(grid, body.fields);
  add_unless_empty(grid, field::node_number, body.node_numbers);
  add_unless_empty(grid, field::location, body.node_location);
  add_names(grid, "location_names", body.locations);
  add_sensation(grid, body, evaluation);
  return grid;
}

Grid grid_of(const GarmentResult& garment) {
  Grid grid;
  grid.points = garment.current;
  add_cells(grid, surface_cell(6), garment.triangles);
  if (garment.placed.size() == garment.current.size()) {
    std::vector<Eigen::Vector3d> displacement = garment.current;
    for (std::size_t n = 0; n < displacement.size(); ++n) displacement[n] -= garment.placed[n];
    grid.fields.add(named(field::displacement, std::move(displacement)));
  }
  add_recorded(grid, garment.fields);
  add_pieces(grid, garment);
  if (garment.parts.size() > 1) {
    std::vector<double> part(garment.triangles.size(), 0.0);
    for (std::size_t g = 0; g < garment.parts.size(); ++g)
      for (int t = garment.parts[g].first_triangle; t < garment.parts[g].end_triangle; ++t) part[t] = static_cast<double>(g);
    grid.fields.add(named(field::garment, std::move(part)));
  }
  return grid;
}

void write_body(const BodyResult& body, const Evaluation& evaluation, const std::filesystem::path& vtu) {
  write_grid(grid_of(body, evaluation), vtu);
}

void write_garment(const GarmentResult& garment, const std::filesystem::path& vtu) { write_grid(grid_of(garment), vtu); }

Grid surface_grid(std::vector<Eigen::Vector3d> points, const std::vector<std::array<int, 3>>& triangles) {
  Grid grid;
  grid.points = std::move(points);
  add_cells(grid, {VTK_TRIANGLE, {0, 1, 2}}, triangles);
  return grid;
}

void write_series(const std::vector<GridStep>& steps, const std::filesystem::path& pvd) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (const GridStep& step : steps)
    text += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", step.time,
                        step.file.generic_string());
  input::write_file(pvd, text + "  </Collection>\n</VTKFile>\n");
}

namespace {

/// The text in quotes after `name=`; empty where there is none.
std::string attribute(const std::string& element, const std::string& name) {
  const std::size_t at = element.find(" " + name + "=\"");
  if (at == std::string::npos) return {};
  const std::size_t begin = at + name.size() + 3;
  return element.substr(begin, element.find('"', begin) - begin);
}

/// A series names files of its own directory and below; what else it names is not opened.
GridStep step_of(const std::string& element, const input::Location& where) {
  const std::string time = attribute(element, "timestep"), file = attribute(element, "file");
  GridStep step{0.0, std::filesystem::path(file).lexically_normal()};
  const auto [rest, fault] = std::from_chars(time.data(), time.data() + time.size(), step.time);
  if (fault != std::errc{} || rest != time.data() + time.size() || !std::isfinite(step.time))
    throw input::InputError(where, "timestep=\"" + time + "\" is no number", "run the case again");
  if (file.empty() || file.size() > 1000 || step.file.is_absolute() || *step.file.begin() == "..")
    throw input::InputError(where, "file=\"" + file + "\" is no file beside the series", "run the case again");
  return step;
}

}  // namespace

std::vector<GridStep> read_series(const std::filesystem::path& pvd) {
  if (!std::filesystem::exists(pvd)) return {};
  const std::string text = input::read_file(pvd, {.most = std::uintmax_t{1} << 24});
  std::vector<GridStep> steps;
  int line = 1;
  for (std::size_t at = 0, seen = 0; (at = text.find("<DataSet ", at)) != std::string::npos; at = seen) {
    line += static_cast<int>(std::count(text.begin() + static_cast<long>(seen), text.begin() + static_cast<long>(at), '\n'));
    seen = std::min(text.find('>', at), text.size());
    steps.push_back(step_of(text.substr(at, seen - at), {pvd.string(), line, 1}));
  }
  return steps;
}

}  // namespace snug::postproc
