// report.html: one self-contained page about a run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace snug::postproc::report {

/// Pictures of the run in three dimensions, drawn by another program.
struct Pictures {
  std::string png;      ///< the bytes of the image; empty: none
  std::string missing;  ///< why there are none, and the remedy
};

/// The page about the results in `out`, without any request to elsewhere. Throws input::InputError when `out` holds no
/// result of a run.
std::string page(const std::filesystem::path& out, const Pictures& pictures);

}  // namespace snug::postproc::report
