// A case made ready to be solved, with the options of a command.
#pragma once

#include "solver/app/case_options.hpp"
#include "solver/library/prepared_case.hpp"

namespace snug::app {

using solver::PreparedCase;

/// Reads and meshes a case and looks every material up. Throws input::InputError.
inline PreparedCase prepare(const std::filesystem::path& directory, const CaseOptions& options) {
  return solver::prepare(directory, options.preparation());
}

}  // namespace snug::app
