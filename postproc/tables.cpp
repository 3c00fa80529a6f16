#include "postproc/tables.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "postproc/units.hpp"

namespace snug::postproc {

namespace {

/// A spreadsheet takes a cell that begins so for a formula and runs it.
std::string no_formula(const std::string& text) {
  const bool formula = !text.empty() && std::string("=+-@\t\r").find(text[0]) != std::string::npos;
  return formula ? "'" + text : text;
}

/// How history.csv writes a number.
std::string of_load(double value) { return fmt::format("{:.9g}", value); }
std::string of_residual(double value) { return fmt::format("{:.6e}", value); }
std::string of_step(double value) { return fmt::format("{:.6g}", value); }
std::string of_energy(double value) { return std::isfinite(value) ? fmt::format("{:.9g}", value) : ""; }

double number_of(const std::string& text) {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

std::string csv_cell(const std::string& given) {
  const std::string text = no_formula(given);
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

void write_locations(std::ostream& out, const Evaluation& evaluation) {
  out << "location,area_m2,coverage,mean_pressure_Pa,max_pressure_Pa,mean_pressure_gf_per_cm2,max_pressure_gf_per_cm2,"
         "mean_pressure_mmHg,max_pressure_mmHg,rating,term,significant,extrapolated,rating_error,pressures_of\n";
  for (const LocationRow& row : evaluation.locations) {
    fmt::print(out, "{},{:.6g},{:.4f}", csv_cell(row.name), row.area, row.coverage);
    fmt::print(out, ",{:.6g},{:.6g}", row.mean_pressure, row.max_pressure);
    fmt::print(out, ",{:.6g},{:.6g}", to_gf_cm2(row.mean_pressure), to_gf_cm2(row.max_pressure));
    fmt::print(out, ",{:.6g},{:.6g}", to_mmHg(row.mean_pressure), to_mmHg(row.max_pressure));
    if (row.rating)
      fmt::print(out, ",{:.4f},{},{},{},{:.4f}", *row.rating, row.term, row.significant, row.extrapolated,
                 row.rating_error);
    else if (row.trial_high > 0.0)
      fmt::print(out, ",,,{},{},", row.significant, row.extrapolated);
    else
      out << ",,,,,";
    fmt::print(out, ",{}\n", row.pressures_of);
  }
}

void write_skin(std::ostream& out, const BodyResult& body) {
  std::vector<char> skin(body.nodes.size(), 0);
  for (const auto& facet : body.skin_facets)
    for (const int node : std::span(facet).first(body.facet_nodes)) skin[node] = 1;
  const std::vector<Eigen::Vector3d>&displacement = body.fields[field::displacement], *shear = body.fields.find(field::shear_traction);
  const std::vector<double>*pressure = body.fields.find(field::contact_pressure), *coverage = body.fields.find(field::coverage);
  const std::vector<double>*slip = body.fields.find(field::slip), *hem = body.fields.find(field::hem);
  out << "node,x [m],y [m],z [m],ux [m],uy [m],uz [m]" << (pressure ? ",pressure [Pa],coverage" : "")
      << (shear ? ",shear x [Pa],shear y [Pa],shear z [Pa],slip" : "") << (hem ? ",hem" : "") << (pressure ? ",pressure_mmHg\n" : "\n");
  for (std::size_t n = 0; n < body.nodes.size(); ++n) {
    if (!skin[n]) continue;
    const Eigen::Vector3d &x = body.nodes[n], &u = displacement[n];
    fmt::print(out, "{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}", body.node_number(n), x.x(), x.y(), x.z(), u.x(), u.y(), u.z());
    if (pressure) fmt::print(out, ",{:.9g},{:.4f}", (*pressure)[n], (*coverage)[n]);
    if (shear) {
      const Eigen::Vector3d& t = (*shear)[n];
      fmt::print(out, ",{:.9g},{:.9g},{:.9g},{:.0f}", t.x(), t.y(), t.z(), (*slip)[n]);
    }
    if (hem) fmt::print(out, ",{:.0f}", (*hem)[n]);
    if (pressure) fmt::print(out, ",{:.6g}", to_mmHg((*pressure)[n]));
    out << "\n";
  }
}

void write_history(std::ostream& out, const RunResult& run) {
  out << history_head;
  for (const Iteration& row : run.history)
    fmt::print(out, "{},{},{},{},{},{},{},{},{},{}\n", row.increment, of_load(row.load), row.iteration, of_residual(row.residual),
               of_residual(row.complementarity), of_step(row.step), row.contact_nodes, row.changed, of_energy(row.energy),
               csv_cell(row.event));
}

void write_tools(std::ostream& out, const RunResult& run) {
  out << "tool,travel_m,depth_m,force_N,across_N,contact_area_m2,largest_pressure_Pa,friction_force_N\n";
  for (const ToolResult& tool : run.tools)
    for (const ToolRow& row : tool.history)
      fmt::print(out, "{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", csv_cell(tool.name), row.travel, row.depth, row.force, row.across, row.area,
                 row.largest_pressure, row.friction_force);
}

void write_movement(std::ostream& out, const RunResult& run, const Evaluation& evaluation) {
  out << "posture,progress,share,bones,location,area_m2,coverage,mean_pressure_Pa,max_pressure_Pa,mean_pressure_mmHg,rating,term,comfort\n";
  for (std::size_t n = 0; n < run.movement.size(); ++n) {
    const MovementState& state = run.movement[n];
    const MovementRating& rating = evaluation.movement.at(n);
    const std::string head = fmt::format("{},{:.6g},{:.6g},{}", csv_cell(state.posture), state.progress, state.share, csv_cell(bones_text(state)));
    const std::string comfort = rating.comfort ? fmt::format("{:.4f}", rating.comfort->score) : "";
    fmt::print(out, "{},(touched skin),{:.6g},1,{:.6g},{:.6g},{:.6g},,,{}\n", head, state.contact_area, state.mean_pressure, state.max_pressure, to_mmHg(state.mean_pressure), comfort);
    for (const LocationRow& row : rating.locations)
      fmt::print(out, "{},{},{:.6g},{:.4f},{:.6g},{:.6g},{:.6g},{},{},{}\n", head, csv_cell(row.name), row.area, row.coverage, row.mean_pressure, row.max_pressure, to_mmHg(row.mean_pressure),
                 row.rating ? fmt::format("{:.4f}", *row.rating) : "", row.term, comfort);
  }
}

std::string bones_text(const MovementState& state) {
  std::string text;
  for (const BoneRow& bone : state.bones) {
    const Eigen::Vector3d u = 1e3 * bone.shift;
    text += fmt::format("{}{} {:.4g} deg", text.empty() ? "" : "; ", bone.bone, bone.turn * 180.0 / std::numbers::pi);
    if (!u.isZero(0.0)) text += fmt::format(" ({:.4g} {:.4g} {:.4g}) mm", u.x(), u.y(), u.z());
  }
  return text;
}

Iteration as_recorded(const Iteration& row) {
  return {.increment = row.increment,
          .load = number_of(of_load(row.load)),
          .iteration = row.iteration,
          .residual = number_of(of_residual(row.residual)),
          .complementarity = number_of(of_residual(row.complementarity)),
          .step = number_of(of_step(row.step)),
          .contact_nodes = row.contact_nodes,
          .changed = row.changed,
          .energy = number_of(of_energy(row.energy)),
          .event = no_formula(row.event)};
}

}  // namespace snug::postproc
