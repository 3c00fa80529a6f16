// Which runs a study makes: the meshes of the ladder in each of its series.
#pragma once

#include <string>
#include <vector>

#include "cases/input/case.hpp"

namespace snug::app {

/// All mesh sizes of a case divided by a common factor: cells round and along the body and through its solid layers
/// (rounded, at least one; eight round the body) and, where it is given, the cell size of the garment.
input::StudyVariant scaled(const input::Case& description, double factor);

/// The case as it is; tier L1 of a case that is solved with its body; straight-sided elements where there is contact.
std::vector<input::StudyVariant> default_series(const input::Case& description);

/// "KEY=A,B" of --vary gives a series for A and one for B; several give all combinations. Throws input::InputError.
std::vector<input::StudyVariant> varied(const std::vector<std::string>& vary);

/// Seconds that a run is expected to take: from the last two of its series by a power of the unknowns between 1 and 2,
/// from one of them with the power 1.5.
struct TimedRun {
  long unknowns = 0;
  double seconds = 0.0;
};
double expected_seconds(const std::vector<TimedRun>& earlier, long unknowns);

}  // namespace snug::app
