// summary.json and comfort.json as values.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "postproc/summary.hpp"

namespace snug::postproc {

using Json = nlohmann::ordered_json;

/// The documents as a file of them reads: numbers that are not finite are null. `comfort_document` throws
/// std::logic_error where the evaluation judges nothing.
Json summary_document(const RunResult& run, const Evaluation& evaluation, const Provenance& provenance);
Json comfort_document(const Evaluation& evaluation);

/// Adds to a summary what the wearer feels: "locations", "thresholds", "targets", "comfort".
void add_evaluation(Json& summary, const Evaluation& evaluation);

/// As its text reads: what a file cannot hold is not in a document either.
Json as_read(const Json& json);

/// The text of a file.
std::string text_of(const Json& document);

}  // namespace snug::postproc
