#include "postproc/vtu_file.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <charconv>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "cases/input/files.hpp"

namespace snug::postproc {

namespace {

/// Keeps what VTK would print.
class Listener : public vtkCommand {
 public:
  static Listener* New() { return new Listener; }
  void Execute(vtkObject*, unsigned long, void*) override { heard = true; }
  bool heard = false;
};

[[noreturn]] void refuse(const std::filesystem::path& vtu, const std::string& found) {
  throw input::InputError({vtu.string(), 0, 0}, found, "name a grid that snug wrote, or run the case again");
}

/// VTK makes room for as many entries as the head announces; zlib makes a byte of at most 1032.
void check_counts(const std::string& text, const std::filesystem::path& vtu) {
  for (const std::string_view name : {"NumberOfPoints=\"", "NumberOfCells=\"", "NumberOfTuples=\"", "NumberOfComponents=\""})
    for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos;) {
      at += name.size();
      const char* begin = text.data() + at;
      const char* end = text.data() + text.size();
      long long count = -1;
      const auto [rest, fault] = std::from_chars(begin, end, count);
      if (fault != std::errc{} || rest == end || *rest != '"' || count < 0 || count > 1032 * static_cast<long long>(text.size()))
        refuse(vtu, fmt::format("{}{} is no count that the file could hold", name, text.substr(at, 20)));
    }
}

void check_fields(vtkFieldData& data, vtkIdType entries, const std::filesystem::path& vtu) {
  for (int i = 0; i < data.GetNumberOfArrays(); ++i)
    if (const vtkAbstractArray* array = data.GetAbstractArray(i); array && const_cast<vtkAbstractArray*>(array)->GetNumberOfTuples() != entries)
      refuse(vtu, fmt::format("field {} does not have a value an entry", data.GetArrayName(i) ? data.GetArrayName(i) : "without a name"));
}

/// Nodes of the kinds of cells that are read; a cell with fewer is a step beyond its list.
bool right_size(int type, vtkIdType nodes) {
  static const std::map<int, vtkIdType> sizes = {
      {VTK_VERTEX, 1},          {VTK_LINE, 2},           {VTK_TRIANGLE, 3},      {VTK_QUAD, 4},
      {VTK_TETRA, 4},           {VTK_HEXAHEDRON, 8},     {VTK_WEDGE, 6},         {VTK_QUADRATIC_TRIANGLE, 6},
      {VTK_QUADRATIC_QUAD, 8},  {VTK_BIQUADRATIC_QUAD, 9}, {VTK_QUADRATIC_TETRA, 10}, {VTK_QUADRATIC_HEXAHEDRON, 20},
      {VTK_TRIQUADRATIC_HEXAHEDRON, 27}};
  const auto found = sizes.find(type);
  return found != sizes.end() && found->second == nodes;
}

void check_cells(vtkUnstructuredGrid& grid, const std::filesystem::path& vtu) {
  const vtkIdType points = grid.GetNumberOfPoints();
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) {
    vtkIdType count = 0;
    const vtkIdType* nodes = nullptr;
    grid.GetCellPoints(c, count, nodes);
    if (!right_size(grid.GetCellType(c), count))
      refuse(vtu, fmt::format("cell {} of type {} has {} nodes", c, grid.GetCellType(c), count));
    for (vtkIdType n = 0; n < count; ++n)
      if (nodes[n] < 0 || nodes[n] >= points) refuse(vtu, fmt::format("cell {} names node {} of {}", c, nodes[n], points));
  }
}

void check_points(vtkUnstructuredGrid& grid, const std::filesystem::path& vtu) {
  for (vtkIdType n = 0; n < grid.GetNumberOfPoints(); ++n) {
    const double* x = grid.GetPoint(n);
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
      refuse(vtu, fmt::format("the place of node {} is no number", n));
  }
}

}  // namespace

void write_vtu(vtkUnstructuredGrid& grid, const std::filesystem::path& vtu) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(&grid);
  writer->SetDataModeToAppended();
  writer->SetCompressorTypeToZLib();
  writer->WriteToOutputStringOn();
  if (writer->Write() != 1) throw std::runtime_error("cannot write " + vtu.string());
  input::write_file(vtu, writer->GetOutputString());
}

vtkSmartPointer<vtkUnstructuredGrid> read_vtu(const std::filesystem::path& vtu) {
  const std::string text = input::read_file(vtu, {.missing = "run the case again, or name another file"});
  if (text.substr(0, 4096).find("type=\"UnstructuredGrid\"") == std::string::npos)
    refuse(vtu, "this is no VTU file");
  check_counts(text, vtu);
  vtkNew<Listener> listener;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->AddObserver(vtkCommand::ErrorEvent, listener);
  reader->AddObserver(vtkCommand::WarningEvent, listener);
  reader->ReadFromInputStringOn();
  reader->SetInputString(text);
  try {
    reader->Update();
  } catch (const std::exception& error) {
    refuse(vtu, fmt::format("the grid cannot be read: {}", error.what()));
  }
  vtkSmartPointer<vtkUnstructuredGrid> grid = reader->GetOutput();
  if (listener->heard || reader->GetErrorCode() != 0 || !grid || grid->GetNumberOfPoints() == 0)
    refuse(vtu, "the grid is damaged or cut short");
  check_cells(*grid, vtu);
  check_points(*grid, vtu);
  check_fields(*grid->GetPointData(), grid->GetNumberOfPoints(), vtu);
  check_fields(*grid->GetCellData(), grid->GetNumberOfCells(), vtu);
  return grid;
}

}  // namespace snug::postproc
