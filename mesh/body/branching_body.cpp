#include "mesh/body/branching_body.hpp"

#include <fmt/format.h>

#include <cmath>

#include "mesh/body/filled_surfaces.hpp"
#include "mesh/body/scan_measures.hpp"
#include "mesh/body/scanned_surfaces.hpp"

namespace snug::mesh {

namespace {

using input::InputError;

/// The layers and a rigid core fill what skin and cuts enclose, once.
void check_filled(const ScannedBody& body, bool rigid_core, const input::Location& where) {
  constexpr double tolerance = 0.01;
  double cells = rigid_core ? volume_inside(body.mesh, "bone") : 0.0;
  for (const QualityRow& row : quality(body.mesh)) cells += row.volume;
  if (std::abs(cells - body.report.volume) <= tolerance * body.report.volume) return;
  throw NotMeshed(where, fmt::format("the cells and the core have {:.0f} ml, skin and cuts enclose {:.0f} ml", 1e6 * cells, 1e6 * body.report.volume),
                  "take another cell_size: gmsh has filled a layer wrongly");
}

/// The report is there as far as it got where this throws.
void make(const input::BodySpec& spec, ScannedBody& body) {
  const Layering layering(spec);
  const ScannedSurfaces surfaces = scanned_surfaces(spec, layering, body.report);
  body.mesh = filled_body(spec, layering, surfaces, body.report);
  measure_sections(body.mesh, surfaces.kept, body.report);
  for (const Cut& cut : surfaces.cuts) body.report.cuts.push_back(cut_row(body.mesh, surfaces.kept, cut));
  body.report.volume = volume_between(body.mesh);
  check_filled(body, !layering.bone(), spec.where);
}

}  // namespace

ScannedBody body_from_scan(const input::BodySpec& spec) {
  if (!spec.scan) throw InputError(spec.where, "body kind \"scan\" without a scan", "add the table [body.scan]");
  constexpr int smaller = 2;      // tries with smaller cells: facets of surfaces that lie close cut each other less
  constexpr double shrink = 0.8;
  input::BodySpec tried = spec;
  std::vector<std::string> in_vain;
  for (int attempt = 0;; ++attempt) {
    ScannedBody body;
    try {
      make(tried, body);
      body.report.said.insert(body.report.said.end(), in_vain.begin(), in_vain.end());
      return body;
    } catch (const NotMeshed& fault) {
      const double size = body.report.cell_size;
      if (attempt == smaller || !(size > 0.0)) throw;
      in_vain.push_back(fmt::format("cells of {:.1f} mm did not do: {}", 1e3 * size, fault.errors().front().found));
      tried.scan->cell_size = shrink * size;
    }
  }
}

}  // namespace snug::mesh
