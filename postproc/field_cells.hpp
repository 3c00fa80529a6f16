// The cells of a grid, between whose nodes values are interpolated. VTK stays in the sources.
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "postproc/grid.hpp"
#include "postproc/nodal_field.hpp"

namespace snug::postproc {

/// A point in a grid: it lies in a cell, or beside the nearest one.
struct CellPlace {
  std::vector<int> nodes;       ///< indices into the field; empty: the grid has no cell
  std::vector<double> weights;  ///< of the nodes, sum 1
  double gap = 0.0;             ///< m, from the point to the place in the cell; 0 inside
  double cell_size = 0.0;       ///< m, diagonal of the cell's box
};

class FieldCells {
 public:
  struct Locator;
  explicit FieldCells(const Grid& grid);
  ~FieldCells();

  /// Where a point (m, undeformed) lies: VTK's cell locator and shape functions.
  CellPlace place_of(const Eigen::Vector3d& point) const;
  const Locator& locator() const { return *locator_; }

 private:
  std::unique_ptr<Locator> locator_;
};

/// A grid as snug writes it: UX UY UZ USUM of `displacement`, SX ... SXZ and S1 ... SEQV of `cauchy_stress`; node
/// numbers are `node_number`, or count from 1. Of a shell the stresses of `surface`, or "SX TOP", "SX BOTTOM", ... of both. Every other
/// field at the points is there to be asked for by its name ("contact_pressure", "shear_traction X").
/// Throws input::InputError where it has neither; `name` stands for it in messages.
NodalField nodal_field(const Grid& grid, const std::string& name, std::optional<ShellSurface> surface = {});

/// The place in `from` nearest to a point, for a field without cells: its nearest nodes, one a point.
std::vector<CellPlace> nearest_nodes(const NodalField& from, const std::vector<Eigen::Vector3d>& points);

/// One scalar a node; with the cells of `field` where it has them, otherwise as points. Written to `vtu`; throws
/// std::runtime_error when that fails.
void write_columns(const NodalField& field, const std::filesystem::path& vtu);

}  // namespace snug::postproc
