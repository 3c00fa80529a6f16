// What snug score --json holds, as a value.
#pragma once

#include "postproc/documents.hpp"

namespace snug::postproc {

/// "locations", "thresholds" and "comfort", null where nothing is judged; as its text reads.
Json evaluation_document(const Evaluation& evaluation);

}  // namespace snug::postproc
