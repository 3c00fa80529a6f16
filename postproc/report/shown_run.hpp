// A stored run with its surfaces as the pages draw them.
#pragma once

#include <optional>

#include "postproc/report/surfaces.hpp"
#include "postproc/store.hpp"

namespace snug::postproc::report {

struct ShownRun : StoredRun {
  std::optional<Skin> skin;        ///< none: the scene has no body
  std::optional<Garment> garment;  ///< none: the scene has no garment
};

/// Whether the run tells what presses on the skin; particles give the shape of cloth alone.
bool knows_pressure(const ShownRun& run);

/// Throws std::runtime_error where a grid has cells that cannot be drawn.
ShownRun shown(StoredRun run);

/// The same of a directory; that it cannot be drawn is an input::InputError, as all else that read_run finds.
ShownRun read_shown(const std::filesystem::path& directory);

}  // namespace snug::postproc::report
