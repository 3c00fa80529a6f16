// Tables on the terminal about what will be solved.
#pragma once

#include <string>

#include "solver/app/prepared_case.hpp"

namespace snug::app {

/// Parts in and out, unknowns, memory and time expected.
std::string plan_text(const std::string& title, const solver::Plan& plan);

/// Girths of a scan; cells, Jacobians and volumes by layer; the size of the garment mesh and its ease.
std::string quality_text(const PreparedCase& prepared);

/// "3.2 s", "4 min 10 s"
std::string duration_text(double seconds);
/// "310 MB", "1.2 GB"
std::string memory_text(double bytes);

}  // namespace snug::app
