// Nodal listings in the Ansys style and tables for spreadsheets.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "postproc/csv_writer.hpp"
#include "postproc/evaluate.hpp"
#include "postproc/report/skin_chart.hpp"
#include "postproc/result.hpp"

namespace snug::postproc {

/// What a listing ends with.
enum class Extrema { none, range, range_and_absolute };

/// A nodal listing: one row a node, values by column.
struct Listing {
  std::vector<std::string> heading;  ///< lines above the labels
  std::vector<std::string> labels;
  std::vector<std::vector<double>> rows;
  std::vector<int> nodes;  ///< number of each row; empty: rows[n] belongs to node n + 1
  Extrema extrema = Extrema::range;

  int node(std::size_t row) const { return nodes.empty() ? static_cast<int>(row) + 1 : nodes[row]; }
};

Listing displacement_listing(const BodyResult& body);  ///< UX UY UZ USUM, m
Listing stress_listing(const BodyResult& body);        ///< S1 S2 S3 SINT SEQV, Pa; nodal averages; of a shell top, then bottom of each node
Listing node_listing(const BodyResult& body);          ///< X Y Z, m, reference positions

/// Fortran G13.5 as Ansys prints it: 0.1 <= |v| < 1e5 fixed with four trailing blanks, otherwise 0.12345E-03. Thirteen
/// characters with at least one blank in front, so that columns never run into each other. Below 1e-99 it is zero.
std::string ansys_number(double value);

/// Rows of node number (7 wide) and values (13 wide), then minima and maxima with their nodes.
void write_listing(std::ostream& out, const Listing& listing);

void write_locations(std::ostream& out, const Evaluation& evaluation, CsvStyle style = CsvStyle::comma);  ///< locations.csv: Pa, gf/cm2, mmHg
/// skin.csv: a row a node of the skin with its reference position, displacement, pressure and coverage; with friction also the traction of the garment on it and
/// the slip (0 no contact, 1 sticks, 2 slips). `chart`: of the same nodes in ascending order; where it is that of an upright tube, angle (0 to 360 deg) and height as locations count them.
void write_skin(std::ostream& out, const BodyResult& body, const report::SkinChart& chart, CsvStyle style = CsvStyle::comma);
/// The head of history.csv, of which a run without iterations writes nothing else.
inline constexpr const char* history_head = "increment,load,iteration,residual,complementarity,step,contact_nodes,changed,energy_J,event\n";
/// A row as history.csv holds it: numbers to the digits that are written, and none of what is not.
Iteration as_recorded(const Iteration& row);
void write_history(std::ostream& out, const RunResult& run);            ///< history.csv: one row a Newton iteration, without times: the same run gives the same bytes

void write_tools(std::ostream& out, const RunResult& run, CsvStyle style = CsvStyle::comma);  ///< tool.csv: one row a converged state of the way of a tool

/// comfort.csv: for each state of a movement a row of all the touched skin and one a location. `evaluation`: of the same run.
void write_movement(std::ostream& out, const RunResult& run, const Evaluation& evaluation, CsvStyle style = CsvStyle::comma);
/// "shank 60 deg; thigh 20 deg"
std::string bones_text(const MovementState& state);

}  // namespace snug::postproc
