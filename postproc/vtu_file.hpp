// VTU files to and from the disk; what of VTK touches files is here.
#pragma once

#include <filesystem>

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

namespace snug::postproc {

/// Writes a grid whole (input::write_file). Throws std::runtime_error with the reason when it cannot be written.
void write_vtu(vtkUnstructuredGrid& grid, const std::filesystem::path& vtu);

struct Grid;
/// Points and cells of a grid as VTK has them.
vtkSmartPointer<vtkUnstructuredGrid> cells_to_vtk(const Grid& grid);

/// Reads a grid and looks at what VTK takes on trust: counts that the file could hold, fields with a value an entry, cells
/// with the nodes of their kind, all of them there, finite places. Throws input::InputError at the file.
vtkSmartPointer<vtkUnstructuredGrid> read_vtu(const std::filesystem::path& vtu);

}  // namespace snug::postproc
