// Runs of a study and their errors.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/input/case.hpp"
#include "solver/app/case_options.hpp"
#include "solver/app/study/study_row.hpp"

namespace snug::app {

/// `snug run` of a case as a process of its own, so that time and memory are its own; its files go to `work` and are
/// removed. `options` hold every value that is set; `ranks` processes share its work, 0: as many as the run takes by itself. A run that does not
/// converge gives a row with its status.
StudyRow measure(const std::filesystem::path& directory, const CaseOptions& options, int ranks, const std::filesystem::path& work);

/// What the runs are measured against.
struct Yardstick {
  std::string kind;                                       ///< exact | reference | finest
  std::string source;                                     ///< for the reader
  double pressure = not_known, displacement = not_known;  ///< exact and reference: Pa, m
};

/// `kind`: exact, reference, finest, or empty for the best that the case has. Throws input::InputError when the case
/// does not have it.
Yardstick yardstick_of(const input::Case& description, const std::string& kind);

/// Fills in the errors. With kind finest the finest converged run of the first series is the measure; it has none.
void compare(std::vector<StudyRow>& rows, Yardstick& yardstick, const postproc::Zone& zone);

}  // namespace snug::app
