// What the templates of the pages are filled with: texts and numbers as shown, paths of the drawings.
#pragma once

#include "postproc/report/shown_run.hpp"
#include "postproc/report/scale.hpp"

namespace snug::postproc::report {

/// Title, status, key figures, plan, balance, time and memory, provenance of a run.
Json run_view(const ShownRun& run);

/// Rows of the location table; empty without locations.
Json locations_view(const ShownRun& run);

/// Where the pressures of locations lie among the chosen thresholds and classes.
Json thresholds_view(const ShownRun& run);
/// Pressures that are wanted and found: of a graduated tube, and of the case's [target].
Json profile_view(const ShownRun& run);
/// What sensors would read.
Json sensors_view(const ShownRun& run);

/// Gauge, memberships and rules; null without comfort.
Json comfort_view(const ShownRun& run);

/// Postures and pressures over the movement; null without one.
Json movement_view(const ShownRun& run);

/// The unrolled pressure map with its colour bar, `width` pixels wide; null without a skin.
Json map_view(const ShownRun& run, const PressureScale& scale, double width);

/// The flat pieces of the garments, once a quantity, at most `width` pixels wide; null without any.
Json pieces_view(const ShownRun& run, double width);

/// Residuals over the iterations; null without a history.
Json convergence_view(const ShownRun& run, double width);

/// Surfaces for the three-dimensional view, as JSON in which arrays are little-endian 32-bit values in base64.
std::string scene_json(const ShownRun& run, const PressureScale& scale);

/// The number at `key`, NaN where there is none.
double value_at(const Json& json, const char* key);

}  // namespace snug::postproc::report
