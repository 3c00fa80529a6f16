// Reads nodal listings as Ansys prints them: PRNSOL, PRESOL and NLIST, and those that snug writes itself.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cases/input/diagnostics.hpp"

namespace snug::postproc {

/// Where in a shell a value stands.
enum class ShellSurface : unsigned char { none, top, middle, bottom };

/// Whose values a row holds. A node may have several rows: one an element (PRESOL), material or surface of a shell.
struct ListingRow {
  int node = 0;
  int element = 0, material = 0;  ///< 0: the listing names none
  ShellSurface surface = ShellSurface::none;
  int line = 0;
};

/// The line pair NODE / VALUE under MINIMUM VALUES, MAXIMUM VALUES or MAXIMUM ABSOLUTE VALUES.
struct ListingExtreme {
  std::string title;       ///< "MINIMUM", "MAXIMUM" or "MAXIMUM ABSOLUTE"
  std::vector<int> nodes;  ///< one a label
  std::vector<double> values;
};

/// One table, put together from all its pages. Values in the units of the listing.
struct ListingTable {
  std::string kind;                 ///< "NODAL DEGREE OF FREEDOM", "NODAL STRESS", "NODES", ...; may be empty
  std::vector<std::string> labels;  ///< UX UY UZ USUM
  std::vector<double> factors = {}; ///< size in SI of the unit that a label's head gives, 0 for none; empty: none gives one
  int load_step = 0, substep = 0;   ///< 0: the listing names none
  std::string frame;                ///< of components, where it is not the global Cartesian one: "COORDINATE SYSTEM 1"
  std::vector<ListingRow> rows;
  std::vector<double> values;  ///< labels.size() a row; NaN where the field overflew
  std::vector<ListingExtreme> extrema;
  bool rows_left_out = false;  ///< a line of dots stands for rows
  bool closed = false;         ///< by its minima and maxima, or by the next listing

  double value(std::size_t row, std::size_t column) const { return values[row * labels.size() + column]; }
};

/// Reads every table of a listing, also those of CalculiX' .dat files (*NODE PRINT, U), whose times count as load steps. Columns may run together, values continue on lines without a node number, page heads
/// repeat, exponents have two or three digits. Text between the tables is passed over; a row that is cut short, too
/// long or not a number is reported with its place (at most ten of them).
std::vector<ListingTable> parse_listing(std::string_view text, const std::string& shown_as,
                                        input::Diagnostics& diagnostics);

/// The tables of a file; also .frd files of CalculiX (frd_listing.hpp), records of FEBio (febio_log.hpp) and tables with a head line and separated columns (column_table.hpp). Throws input::InputError: no such file, no table in it, wrong rows.
std::vector<ListingTable> read_listing(const std::filesystem::path& file);

}  // namespace snug::postproc
