#include "solver/app/print_plan.hpp"

#include <fmt/format.h>

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
  if (plan.seconds > 0.0) text += fmt::format("  time expected {}\n", duration_text(plan.seconds));
  return text;
}

std::string quality_text(const PreparedCase& prepared) {
  std::string text = fmt::format("meshes\n  {:<16} {:>8} {:>14} {:>14} {:>10} {:>12}\n", "layer", "cells",
                                 "min jacobian", "mean jacobian", "aspect", "volume [ml]");
  for (const mesh::QualityRow& row : prepared.quality)
    text += fmt::format("  {:<16} {:>8} {:>14.3f} {:>14.3f} {:>10.1f} {:>12.1f}\n", row.layer, row.cells,
                        row.min_scaled_jacobian, row.mean_scaled_jacobian, row.max_aspect, row.volume * 1e6);
  const mesh::GarmentMesh& garment = prepared.meshes.garment;
  if (!garment.triangles.empty())
    text += fmt::format("  garment: {} quadratic triangles, mean edge {:.1f} mm\n", garment.triangles.size(),
                        garment.mean_edge * 1e3);
  return text;
}

}  // namespace snug::app
