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

/// How history.csv writes a number.
std::string of_load(double value) { return fmt::format("{:.9g}", value); }
std::string of_residual(double value) { return fmt::format("{:.6e}", value); }
std::string of_step(double value) { return fmt::format("{:.6g}", value); }
std::string of_energy(double value) { return std::isfinite(value) ? fmt::format("{:.9g}", value) : ""; }

/// deg, in [0, 360) as written.
double whole_turn(double angle) {
  const double written = std::round(1e4 * report::wrapped(angle, 0.0)) / 1e4;
  return written < 360.0 ? written : 0.0;
}

double number_of(const std::string& text) {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

void write_locations(std::ostream& out, const Evaluation& evaluation, CsvStyle style) {
  CsvWriter csv(out, style);
  csv.columns(
         "location,area_m2,coverage,mean_pressure_Pa,max_pressure_Pa,mean_pressure_gf_per_cm2,max_pressure_gf_per_cm2,"
         "mean_pressure_mmHg,max_pressure_mmHg,rating,term,significant,extrapolated,rating_error,pressures_of")
      .end_row();
  const auto said = [](bool yes) { return yes ? "true" : "false"; };
  for (const LocationRow& row : evaluation.locations) {
    csv.text(row.name).number(row.area).fixed(row.coverage, 4);
    csv.number(row.mean_pressure).number(row.max_pressure);
    csv.number(to_gf_cm2(row.mean_pressure)).number(to_gf_cm2(row.max_pressure));
    csv.number(to_mmHg(row.mean_pressure)).number(to_mmHg(row.max_pressure));
    if (row.rating)
      csv.fixed(*row.rating, 4).text(row.term).text(said(row.significant)).text(said(row.extrapolated)).fixed(row.rating_error, 4);
    else if (row.trial_high > 0.0)
      csv.empty(2).text(said(row.significant)).text(said(row.extrapolated)).empty();
    else
      csv.empty(5);
    csv.text(row.pressures_of).end_row();
  }
}

void write_skin(std::ostream& out, const BodyResult& body, const report::SkinChart& chart, CsvStyle style) {
  std::vector<char> skin(body.nodes.size(), 0);
  for (const auto& facet : body.skin_facets)
    for (const int node : std::span(facet).first(body.facet_nodes)) skin[node] = 1;
  const std::vector<Eigen::Vector3d>&displacement = body.fields[field::displacement], *shear = body.fields.find(field::shear_traction);
  const std::vector<double>*pressure = body.fields.find(field::contact_pressure), *coverage = body.fields.find(field::coverage);
  const std::vector<double>*slip = body.fields.find(field::slip), *hem = body.fields.find(field::hem);
  const bool round = !chart.angle.empty() && chart.upright;
  CsvWriter csv(out, style);
  const auto vector = [&](const Eigen::Vector3d& x) { csv.number(x.x(), 9).number(x.y(), 9).number(x.z(), 9); };
  csv.columns("node,x [m],y [m],z [m],ux [m],uy [m],uz [m]");
  if (pressure) csv.columns("pressure [Pa],coverage");
  if (shear) csv.columns("shear x [Pa],shear y [Pa],shear z [Pa],slip");
  if (hem) csv.columns("hem");
  if (pressure) csv.columns("pressure_mmHg");
  if (round) csv.columns("angle [deg],height [mm]");
  csv.end_row();
  for (std::size_t n = 0, row = 0; n < body.nodes.size(); ++n) {
    if (!skin[n]) continue;
    csv.text(std::to_string(body.node_number(n)));
    vector(body.nodes[n]), vector(displacement[n]);
    if (pressure) csv.number((*pressure)[n], 9).fixed((*coverage)[n], 4);
    if (shear) vector((*shear)[n]), csv.fixed((*slip)[n], 0);
    if (hem) csv.fixed((*hem)[n], 0);
    if (pressure) csv.number(to_mmHg((*pressure)[n]));
    if (round) csv.number(whole_turn(chart.angle.at(row)), 7).number(1e3 * body.nodes[n].z(), 9);
    csv.end_row();
    ++row;
  }
}

void write_history(std::ostream& out, const RunResult& run) {
  out << history_head;
  for (const Iteration& row : run.history)
    fmt::print(out, "{},{},{},{},{},{},{},{},{},{}\n", row.increment, of_load(row.load), row.iteration, of_residual(row.residual),
               of_residual(row.complementarity), of_step(row.step), row.contact_nodes, row.changed, of_energy(row.energy),
               csv_cell(row.event));
}

void write_tools(std::ostream& out, const RunResult& run, CsvStyle style) {
  CsvWriter csv(out, style);
  csv.columns("tool,travel_m,depth_m,force_N,across_N,contact_area_m2,largest_pressure_Pa,friction_force_N").end_row();
  for (const ToolResult& tool : run.tools)
    for (const ToolRow& row : tool.history) {
      csv.text(tool.name);
      for (const double value : {row.travel, row.depth, row.force, row.across, row.area, row.largest_pressure, row.friction_force}) csv.number(value, 9);
      csv.end_row();
    }
}

void write_movement(std::ostream& out, const RunResult& run, const Evaluation& evaluation, CsvStyle style) {
  CsvWriter csv(out, style);
  csv.columns("posture,progress,share,bones,location,area_m2,coverage,mean_pressure_Pa,max_pressure_Pa,mean_pressure_mmHg,rating,term,comfort").end_row();
  const auto optional = [&](bool there, double value) { there ? csv.fixed(value, 4) : csv.empty(); };
  for (std::size_t n = 0; n < run.movement.size(); ++n) {
    const MovementState& state = run.movement[n];
    const MovementRating& rating = evaluation.movement.at(n);
    const auto begin = [&](const std::string& name, double area) { csv.text(state.posture).number(state.progress).number(state.share).text(bones_text(state)).text(name).number(area); };
    const auto pressures = [&](double mean, double max) { csv.number(mean).number(max).number(to_mmHg(mean)); };
    const auto end = [&] { optional(rating.comfort.has_value(), rating.comfort ? rating.comfort->score : 0.0), csv.end_row(); };
    begin("(touched skin)", state.contact_area), csv.number(1.0);
    pressures(state.mean_pressure, state.max_pressure), csv.empty(2), end();
    for (const LocationRow& row : rating.locations) {
      begin(row.name, row.area), csv.fixed(row.coverage, 4);
      pressures(row.mean_pressure, row.max_pressure), optional(row.rating.has_value(), row.rating.value_or(0.0)), csv.text(row.term), end();
    }
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
          .event = without_formula(row.event)};
}

}  // namespace snug::postproc
