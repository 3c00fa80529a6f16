#include "postproc/grid.hpp"

#include <fmt/format.h>
#include <vtkBiQuadraticQuad.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkHexahedron.h>
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
#include <initializer_list>
#include <limits>
#include <stdexcept>

#include "cases/input/files.hpp"
#include "postproc/stress.hpp"
#include "postproc/vtu_file.hpp"

namespace snug::postproc {
namespace {

using Names = std::initializer_list<const char*>;

/// A field with one tuple an entry; `value(n, c)` is component c of entry n.
template <class Value>
void add_field(vtkFieldData& data, const char* name, std::size_t entries, Names components, Value value) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  const int count = std::max<int>(1, static_cast<int>(components.size()));
  array->SetNumberOfComponents(count);
  int c = 0;
  for (const char* component : components) array->SetComponentName(c++, component);
  array->SetNumberOfTuples(static_cast<vtkIdType>(entries));
  for (std::size_t n = 0; n < entries; ++n)
    for (int k = 0; k < count; ++k) array->SetComponent(static_cast<vtkIdType>(n), k, value(n, k));
  data.AddArray(array);
}

/// A scalar field; left out when the result does not have it.
void add_scalars(vtkFieldData& data, const char* name, const std::vector<double>& values) {
  if (!values.empty()) add_field(data, name, values.size(), {}, [&](std::size_t n, int) { return values[n]; });
}

void add_vectors(vtkFieldData& data, const char* name, const std::vector<Eigen::Vector3d>& values) {
  if (!values.empty())
    add_field(data, name, values.size(), {"X", "Y", "Z"}, [&](std::size_t n, int c) { return values[n][c]; });
}

void add_integers(vtkFieldData& data, const char* name, const std::vector<int>& values) {
  if (values.empty()) return;
  vtkNew<vtkIntArray> array;
  array->SetName(name);
  for (int value : values) array->InsertNextValue(value);
  data.AddArray(array);
}

/// The names that the integers of a field stand for.
void add_names(vtkUnstructuredGrid& grid, const char* name, const std::vector<std::string>& names) {
  if (names.empty()) return;
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& text : names) array->InsertNextValue(text);
  grid.GetFieldData()->AddArray(array);
}

void set_points(vtkUnstructuredGrid& grid, const std::vector<Eigen::Vector3d>& positions) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Eigen::Vector3d& x : positions) points->InsertNextPoint(x.data());
  grid.SetPoints(points);
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
void add_cells(vtkUnstructuredGrid& grid, const GridCell& kind, const std::vector<std::array<int, count>>& cells) {
  grid.Allocate(static_cast<vtkIdType>(cells.size()));
  std::vector<vtkIdType> ids(kind.order.size());
  for (const auto& cell : cells) {
    for (std::size_t n = 0; n < ids.size(); ++n) ids[n] = cell[kind.order[n]];
    grid.InsertNextCell(kind.type, static_cast<vtkIdType>(ids.size()), ids.data());
  }
}

void add_body_cells(vtkUnstructuredGrid& grid, const BodyResult& body) {
  if (body.cells.empty())  // a rigid body is its skin
    return add_cells(grid, surface_cell(body.facet_nodes), body.skin_facets);
  add_cells(grid, volume_cell(body.cell_nodes), body.cells);
  add_integers(*grid.GetCellData(), "layer", body.cell_layer);
  add_names(grid, "layer_names", body.layers);
}

void add_tensor(vtkFieldData& data, const char* name, const std::vector<Stress>& stress) {
  if (stress.empty()) return;
  add_field(data, name, stress.size(), {"XX", "YY", "ZZ", "XY", "YZ", "XZ"},
            [&](std::size_t n, int c) { return stress[n][c]; });
}

void add_stress(vtkFieldData& data, const std::vector<Stress>& stress) {
  if (stress.empty()) return;
  add_tensor(data, "cauchy_stress", stress);
  add_field(data, "von_mises", stress.size(), {}, [&](std::size_t n, int) { return von_mises(stress[n]); });
  std::vector<Eigen::Vector3d> principal;
  for (const Stress& s : stress) principal.push_back(principal_stresses(s));
  add_field(data, "principal_stress", stress.size(), {"S1", "S2", "S3"},
            [&](std::size_t n, int c) { return principal[n][c]; });
}

/// Rating of the node's location where the node is covered; NaN elsewhere. One value a location, because the curves
/// were fitted to pressures of whole locations.
void add_sensation_field(vtkFieldData& data, const BodyResult& body, const Evaluation& evaluation) {
  if (!evaluation.comfort) return;
  const double none = std::numeric_limits<double>::quiet_NaN();
  add_field(data, "sensation", body.nodes.size(), {}, [&](std::size_t n, int) {
    const int location = n < body.node_location.size() ? body.node_location[n] : -1;
    const bool covered = n < body.coverage.size() && body.coverage[n] > 0;
    return location < 0 || !covered ? none : evaluation.locations.at(location).rating.value_or(none);
  });
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

void write(vtkUnstructuredGrid& grid, const std::filesystem::path& vtu) {
  check_sizes(grid, vtu);
  write_vtu(grid, vtu);
}

}  // namespace

void write_body(const BodyResult& body, const Evaluation& evaluation, const std::filesystem::path& vtu) {
  vtkNew<vtkUnstructuredGrid> grid;
  set_points(*grid, body.nodes);
  add_body_cells(*grid, body);
  vtkPointData& points = *grid->GetPointData();
  if (!body.displacement.empty()) add_vectors(points, "displacement", body.displacement);
  add_integers(points, "node_number", body.node_numbers);
  add_scalars(points, "contact_pressure", body.contact_pressure);
  add_scalars(points, "coverage", body.coverage);
  add_scalars(points, "hem", body.hem);
  add_scalars(points, "pressure_inside", body.pressure_inside);
  add_scalars(points, "laplace_pressure", body.laplace_pressure);
  add_vectors(points, "shear_traction", body.shear_traction);
  add_scalars(points, "slip", body.slip);
  add_stress(points, body.cauchy_stress);
  add_tensor(points, "stress_top", body.stress_top);
  add_tensor(points, "stress_bottom", body.stress_bottom);
  add_integers(points, "location", body.node_location);
  add_names(*grid, "location_names", body.locations);
  add_sensation_field(points, body, evaluation);
  write(*grid, vtu);
}

void write_garment(const GarmentResult& garment, const std::filesystem::path& vtu) {
  vtkNew<vtkUnstructuredGrid> grid;
  set_points(*grid, garment.current);
  add_cells(*grid, surface_cell(6), garment.triangles);
  vtkPointData& points = *grid->GetPointData();
  if (garment.placed.size() == garment.current.size())
    add_field(points, "displacement", garment.current.size(), {"X", "Y", "Z"},
              [&](std::size_t n, int c) { return garment.current[n][c] - garment.placed[n][c]; });
  add_scalars(points, "contact_pressure", garment.contact_pressure);
  add_vectors(points, "shear_traction", garment.shear_traction);
  add_scalars(points, "slip", garment.slip);
  vtkCellData& cells = *grid->GetCellData();
  add_scalars(cells, "tension_warp", garment.tension_warp);
  add_scalars(cells, "tension_weft", garment.tension_weft);
  add_scalars(cells, "shear", garment.shear);
  if (!garment.stretch_warp.empty())
    add_field(cells, "stretch", garment.stretch_warp.size(), {"warp", "weft"},
              [&](std::size_t n, int c) { return c == 0 ? garment.stretch_warp[n] : garment.stretch_weft.at(n); });
  add_scalars(cells, "wrinkled", garment.wrinkled);
  if (garment.parts.size() > 1) {  // which of the garments, in the order of the case
    std::vector<double> part(garment.triangles.size(), 0.0);
    for (std::size_t g = 0; g < garment.parts.size(); ++g)
      for (int t = garment.parts[g].first_triangle; t < garment.parts[g].end_triangle; ++t) part[t] = static_cast<double>(g);
    add_scalars(cells, "garment", part);
  }
  write(*grid, vtu);
}

void write_surface(const SurfaceGrid& surface, const std::filesystem::path& vtu) {
  vtkNew<vtkUnstructuredGrid> grid;
  set_points(*grid, surface.points);
  add_cells(*grid, {VTK_TRIANGLE, {0, 1, 2}}, surface.triangles);
  if (!surface.displacement.empty())
    add_field(*grid->GetPointData(), "displacement", surface.displacement.size(), {"X", "Y", "Z"},
              [&](std::size_t n, int c) { return surface.displacement[n][c]; });
  for (const auto& [name, values] : surface.point_fields) add_scalars(*grid->GetPointData(), name.c_str(), values);
  for (const auto& [name, values] : surface.cell_fields) add_scalars(*grid->GetCellData(), name.c_str(), values);
  write(*grid, vtu);
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
