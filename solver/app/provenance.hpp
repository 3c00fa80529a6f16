// What produced a result: versions, hashes of the input files, mesh quality.
#pragma once

#include "postproc/summary.hpp"
#include "solver/app/prepared_case.hpp"

namespace snug::app {

postproc::Provenance provenance_of(const PreparedCase& prepared);

}  // namespace snug::app
