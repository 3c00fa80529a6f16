// Values at nodes from whatever holds them: listings, the grids of a run, result directories.
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "postproc/listing_reader.hpp"

namespace snug::postproc {

/// What a label measures. Values of one quantity are judged by one scale.
enum class Quantity { displacement, stress, coordinate, other };
Quantity quantity_of(const std::string& label);
/// "m", "Pa" or nothing.
std::string unit_of(Quantity quantity);

struct NodalColumn {
  std::string label;           ///< UX, S1, ...; "S1 TOP" and "S1 BOTTOM" where a listing has both
  std::vector<double> values;  ///< SI, one a node; NaN where the node has none
  bool asked = false;          ///< compared only where it is asked for by its label
};

class FieldCells;

/// Values at nodes.
struct NodalField {
  std::string name;                     ///< as shown in messages
  std::vector<int> nodes;               ///< numbers, ascending
  std::vector<Eigen::Vector3d> places;  ///< m, undeformed, one a node; empty: not known
  std::vector<NodalColumn> columns;
  std::vector<std::string> notes;           ///< what its reader should know: which of several load steps it is, what is left out
  std::shared_ptr<const FieldCells> cells;  ///< null: values are known at the nodes only

  const NodalColumn* find(const std::string& label) const;
};

/// How a listing is to be understood.
struct FieldOptions {
  double length_unit = 1.0;             ///< m, of coordinates and displacements
  double stress_unit = 1.0;             ///< Pa
  std::optional<ShellSurface> surface;  ///< take this surface of shells only
  std::optional<int> load_step = {};    ///< of several in a listing; empty: the last one
  std::filesystem::path nodes;          ///< listing of the coordinates (NLIST); empty: none but those in the file
};

/// Reads a directory of results (body_0000.vtu, or else displacement.lis, stress.lis and nodes.lis), a VTU file with
/// `displacement` or `cauchy_stress` at its points, or a listing. Of several load steps in a listing the last counts,
/// and a note says so; components in another frame than the global Cartesian one are left out with a note. Values of a node in several elements or materials are averaged. Throws input::InputError.
NodalField read_field(const std::filesystem::path& source, const FieldOptions& options = {});

/// The field of tables that were read before.
NodalField field_of(const std::vector<ListingTable>& tables, const FieldOptions& options);

/// Where `field` has UX UY UZ, sets USUM; where it has the six components of stress, sets S1 S2 S3 SINT SEQV.
void set_invariants(NodalField& field);

}  // namespace snug::postproc
