// summary.json and comfort.json as values.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "postproc/summary.hpp"

namespace snug::postproc {

using Json = nlohmann::ordered_json;

/// The documents as a file of them reads: numbers that are not finite are null. `comfort_document` needs evaluation.comfort and throws
/// std::logic_error without.
Json summary_document(const RunResult& run, const Evaluation& evaluation, const Provenance& provenance);
Json comfort_document(const Evaluation& evaluation);

/// The text of a file.
std::string text_of(const Json& document);

}  // namespace snug::postproc
