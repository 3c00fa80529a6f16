// report.html beside the results, and its pictures.
#pragma once

#include <filesystem>
#include <string>

#include "postproc/report/page.hpp"

namespace snug::app {

/// Writes report.html into `out`, aside and renamed. Throws input::InputError when `out` holds no results.
void write_report(const std::filesystem::path& out, const postproc::report::Pictures& pictures);

/// The same of a run that stands in memory: nothing is read.
void write_report(const postproc::StoredRun& run, const std::filesystem::path& out, const postproc::report::Pictures& pictures);

/// Writes a page, aside and renamed. Throws std::runtime_error when it cannot be written, and
/// input::InputError when it lies among results and is not snug's.
void write_page(const std::string& page, const std::filesystem::path& file);

/// Pressure and tension from four sides, drawn by VTK in a process of its own under a virtual display (Debian's VTK
/// aborts without one). Where that cannot be done, says why.
postproc::report::Pictures draw_pictures(const std::filesystem::path& out);

}  // namespace snug::app
