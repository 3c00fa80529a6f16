// summary.json and comfort.json. A value that is not finite is written as null.
#pragma once

#include <map>
#include <ostream>
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

void write_summary(std::ostream& out, const RunResult& run, const Evaluation& evaluation, const Provenance& provenance);
/// Needs evaluation.comfort. Throws std::logic_error without.
void write_comfort(std::ostream& out, const Evaluation& evaluation);
/// {"locations": [{location, rating, term, ...}], "comfort": {...} or null}, as `snug score --json` prints.
std::string evaluation_json(const Evaluation& evaluation);

}  // namespace snug::postproc
