#include "postproc/tables.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cmath>
#include <span>

#include "postproc/units.hpp"

namespace snug::postproc {

std::string csv_cell(const std::string& given) {
  // A spreadsheet takes a cell that begins so for a formula and runs it.
  const bool formula = !given.empty() && std::string("=+-@\t\r").find(given[0]) != std::string::npos;
  const std::string text = formula ? "'" + given : given;
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
    else
      out << ",,,,,";
    fmt::print(out, ",{}\n", row.pressures_of);
  }
}

void write_skin(std::ostream& out, const BodyResult& body) {
  std::vector<char> skin(body.nodes.size(), 0);
  for (const auto& facet : body.skin_facets)
    for (const int node : std::span(facet).first(body.facet_nodes)) skin[node] = 1;
  const bool friction = !body.shear_traction.empty(), contact = !body.hem.empty();
  out << "node,x [m],y [m],z [m],ux [m],uy [m],uz [m],pressure [Pa],coverage"
      << (friction ? ",shear x [Pa],shear y [Pa],shear z [Pa],slip" : "") << (contact ? ",hem\n" : "\n");
  for (std::size_t n = 0; n < body.nodes.size(); ++n) {
    if (!skin[n]) continue;
    const Eigen::Vector3d &x = body.nodes[n], &u = body.displacement[n];
    fmt::print(out, "{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.4f}", body.node_number(n), x.x(), x.y(), x.z(), u.x(),
               u.y(), u.z(), body.contact_pressure[n], body.coverage[n]);
    if (friction) {
      const Eigen::Vector3d& t = body.shear_traction[n];
      fmt::print(out, ",{:.9g},{:.9g},{:.9g},{:.0f}", t.x(), t.y(), t.z(), body.slip[n]);
    }
    if (contact) fmt::print(out, ",{:.0f}", body.hem[n]);
    out << "\n";
  }
}

void write_history(std::ostream& out, const RunResult& run) {
  out << "increment,load,iteration,residual,complementarity,step,contact_nodes,changed,energy_J,event\n";
  for (const Iteration& row : run.history)
    fmt::print(out, "{},{:.9g},{},{:.6e},{:.6e},{:.6g},{},{},{},{}\n", row.increment, row.load,
               row.iteration, row.residual, row.complementarity, row.step, row.contact_nodes, row.changed, std::isfinite(row.energy) ? fmt::format("{:.9g}", row.energy) : "",
               csv_cell(row.event));
}

}  // namespace snug::postproc
