// What summary.json holds beside the result, and texts of it (documents.hpp has the files themselves).
#pragma once

#include <map>
#include <string>

#include "postproc/evaluate.hpp"
#include "postproc/result.hpp"

namespace snug::postproc {

/// What the result does not know itself and the summary records beside it.
struct Provenance {
  std::string command;                                                ///< as typed
  std::map<std::string, std::string> versions;                        ///< library or program -> version
  std::map<std::string, std::string> input_hashes;                    ///< input file -> hash
  std::map<std::string, std::map<std::string, double>> mesh_quality;  ///< layer or part -> measure -> value
};

/// "at 33 % of the stage rigid skin, the tissue 12 times as stiff as it is": what a state short of the answer is.
std::string state_text(const RunResult& run);

/// True where there is something for comfort.json: a score, why there is none, or thresholds.
bool judges(const Evaluation& evaluation);

/// {"locations": [{location, rating, term, ...}], "comfort": {...} or null}, as `snug score --json` prints.
std::string evaluation_json(const Evaluation& evaluation);

}  // namespace snug::postproc
