#include "solver/app/print_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace snug::app {

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "unknown";
  if (seconds < 60.0) return fmt::format("{:.1f} s", seconds);
  const int whole = static_cast<int>(std::lround(seconds));
  return fmt::format("{} min {} s", whole / 60, whole % 60);
}

std::string memory_text(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

std::string plan_text(const std::string& title, const solver::Plan& plan) {
  std::string text = fmt::format("{}\n\nplan, tier {}\n", title, plan.tier);
  for (const std::string& part : plan.parts_in) text += fmt::format("  in   {}\n", part);
  for (const std::string& part : plan.parts_out) text += fmt::format("  out  {}\n", part);
  long total = 0;
  std::string parts;
  for (const auto& [part, count] : plan.unknowns) {
    total += count;
    parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", part, count);
  }
  text += fmt::format("  unknowns {}{}\n", total, parts.empty() ? "" : " (" + parts + ")");
  if (plan.memory_bytes > 0.0) text += fmt::format("  memory expected {}\n", memory_text(plan.memory_bytes));
  if (plan.disk_bytes > 0.0) text += fmt::format("  disk expected   {}\n", memory_text(plan.disk_bytes));
  if (plan.seconds > 0.0) text += fmt::format("  time expected {}\n", duration_text(plan.seconds));
  return text;
}

namespace {

/// Girths of a scan, which nobody has typed in, and how far the smooth skin is from the scan.
std::string girths_text(const mesh::Limb& limb) {
  std::string text =
      fmt::format("girths\n  {:>11} {:>11} {:>11} {:>11}\n", "height [mm]", "girth [mm]", "width [mm]", "depth [mm]");
  for (const mesh::GirthRow& row : mesh::girth_table(limb, 7))
    text += fmt::format("  {:>11.0f} {:>11.1f} {:>11.1f} {:>11.1f}\n", row.height * 1e3, row.girth * 1e3,
                        row.width * 1e3, row.depth * 1e3);
  return text + fmt::format("  smooth skin against the scan: {:.2f} mm rms, {:.2f} mm at most\n\n",
                            limb.residual.rms * 1e3, limb.residual.max * 1e3);
}

/// What was done with a scan of a body of tetrahedra.
std::string scan_text(const mesh::ScanReport& scan) {
  std::string text = "scan\n";
  for (const std::string& said : scan.said) text += "  " + said + "\n";
  if (scan.cuts.empty()) return text + "\n";
  text += fmt::format("  {:<20} {:>12} {:>12} {:>12}\n", "cut", "scan [mm]", "girth [mm]", "area [cm2]");
  for (const mesh::CutRow& cut : scan.cuts) text += fmt::format("  {:<20} {:>12.1f} {:>12.1f} {:>12.1f}\n", cut.name, cut.girth_of_scan * 1e3, cut.girth * 1e3, cut.area * 1e4);
  text += fmt::format("  {:<20} {:>12} {:>12} {:>12}\n", "height [mm]", "scan [mm]", "girth [mm]", "outlines");
  for (const mesh::SectionRow& row : scan.sections)
    text += fmt::format("  {:<20.0f} {:>12.1f} {:>12.1f} {:>12}\n", row.height * 1e3, row.girth_of_scan * 1e3, row.girth * 1e3, row.limbs);
  text += fmt::format("  volume between the cuts {:.1f} ml, of the scan {:.1f} ml ({:+.2f} %)\n", scan.volume * 1e6, scan.volume_of_scan * 1e6, 100.0 * (scan.volume / scan.volume_of_scan - 1.0));
  text += fmt::format("  skin: {} triangles of {:.1f} mm, smoothed over {:.1f} mm: {:.2f} mm rms from the scan, {:.2f} mm at most\n", scan.skin_triangles, scan.cell_size * 1e3,
                      scan.smoothing_radius * 1e3, scan.deviation_rms * 1e3, scan.deviation_max * 1e3);
  if (scan.skin_on_facets > 0) text += fmt::format("  {} nodes of it stayed on the scan's facets: smoothed they would cut each other\n", scan.skin_on_facets);
  return text + "\n";
}

/// The garment against the mean girth it covers, as placed.
std::string ease_text(const PreparedCase& prepared, const mesh::GarmentMesh& garment) {
  const mesh::MeanFit mean = prepared.meshes.form ? mesh::mean_fit(garment.fit) : mesh::mean_fit(garment.fit, prepared.meshes.limb);
  if (!(mean.body_girth > 0.0)) return {};
  const double ease = mean.garment_girth / mean.body_girth - 1.0;
  return fmt::format("  {}: {:.0f} mm round as cut on a mean girth of {:.0f} mm, {:.1f} % {}\n",
                     garment.name, mean.garment_girth * 1e3, mean.body_girth * 1e3, std::abs(ease) * 100.0,
                     ease < 0.0 ? "smaller" : "larger");
}

/// How wide a sewn garment is against the body, from below.
std::string fit_text(const mesh::GarmentFit& fit, const mesh::Limb& limb) {
  constexpr int rows = 9;
  std::string text = fmt::format("  {:>13} {:>11} {:>13} {:>8} {:>8}\n", "height [mm]", "body [mm]", "garment [mm]", "ease %", "cover %");
  for (int i = 0; i < rows; ++i) {
    const mesh::FitRow row = fit.at(fit.lower + fit.length() * (i + 0.5) / rows);
    const double girth = limb.girth(row.height);
    text += fmt::format("  {:>13.0f} {:>11.1f} {:>13.1f} {:>8.1f} {:>8.0f}\n", 1e3 * row.height, 1e3 * girth, 1e3 * row.girth, 100.0 * (row.girth / girth - 1.0),
                        100.0 * row.cover);
  }
  return text;
}

/// The same limb by limb.
std::string fit_text(const std::vector<mesh::LimbFit>& limbs) {
  std::string text = fmt::format("  {:<10} {:>11} {:>11} {:>13} {:>8} {:>8}\n", "limb", "height [mm]", "body [mm]", "garment [mm]", "ease %", "cover %");
  for (const mesh::LimbFit& limb : limbs)
    for (const mesh::FitRow& row : limb.some_rows(9))
      text += fmt::format("  {:<10} {:>11.0f} {:>11.1f} {:>13.1f} {:>8.1f} {:>8.0f}\n", limb.limb, 1e3 * row.height, 1e3 * row.body, 1e3 * row.girth,
                          100.0 * (row.girth / row.body - 1.0), 100.0 * row.cover);
  return text;
}

/// The named patches with their nodes of skin.
std::string locations_text(const mesh::BodyMesh& body) {
  if (body.locations.empty()) return {};
  std::vector<std::string> found;
  for (std::size_t l = 0; l < body.locations.size(); ++l)
    found.push_back(fmt::format("{} ({})", body.locations[l], std::count(body.node_location.begin(), body.node_location.end(), static_cast<int>(l))));
  return fmt::format("  locations (nodes of the skin): {}\n", fmt::join(found, ", "));
}

}  // namespace

std::string quality_text(const PreparedCase& prepared) {
  std::string text;
  if (!prepared.meshes.scan.empty()) text += scan_text(prepared.meshes.scan);
  if (prepared.description.body && prepared.description.body->kind == input::BodyKind::scan && prepared.meshes.limb.bone) text += girths_text(prepared.meshes.limb);
  text += fmt::format("meshes\n  {:<16} {:>8} {:>13} {:>13} {:>9} {:>12}\n", "layer", "cells", "min jacobian",
                      "mean jacobian", "aspect", "volume [ml]");
  for (const mesh::QualityRow& row : prepared.quality)
    text += fmt::format("  {:<16} {:>8} {:>13.3f} {:>13.3f} {:>9.1f} {:>12.1f}\n", row.layer, row.cells,
                        row.min_scaled_jacobian, row.mean_scaled_jacobian, row.max_aspect, row.volume * 1e6);
  text += locations_text(prepared.meshes.body);
  for (std::size_t g = 0; g < prepared.meshes.garments.size(); ++g) {
    const mesh::GarmentMesh& garment = prepared.meshes.garments[g];
    text += fmt::format("  {}: {} {} triangles, mean edge {:.1f} mm\n", garment.name, garment.triangles.size(),
                        garment.order == 2 ? "quadratic" : "linear", garment.mean_edge * 1e3) +
            ease_text(prepared, garment);
    if (!garment.fit.limbs.empty())
      text += fit_text(garment.fit.limbs);
    else if (prepared.description.garments[g].pattern.sewn()) text += fit_text(garment.fit, prepared.meshes.limb);
  }
  return text;
}

}  // namespace snug::app
