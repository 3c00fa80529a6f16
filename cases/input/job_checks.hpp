// What a case wants to know beside its answer must fit the rest of it.
#pragma once

#include "cases/input/job_spec.hpp"

namespace snug::input {

/// rad, where the middle of a sector is; none of one that goes more than half way round, whose middle is inside the body.
std::optional<double> middle_angle(const LocationSpec& sector);

/// Reports targets, sensors and variants that name nothing, too much, or something that is not there, and a [comfort] that says nothing.
void check_jobs(const Jobs& jobs, const Case& description, const Table& root, Diagnostics& diagnostics);

}  // namespace snug::input
