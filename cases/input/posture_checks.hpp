// What is wrong with the bones and postures of a case before its body is known.
#pragma once

#include "cases/input/case.hpp"

namespace snug::input {

/// Reports bones and postures that share a name, move what is no bone or has no joint, or stand beside what they cannot stand beside.
void check_postures(const Case& description, Diagnostics& diagnostics);

}  // namespace snug::input
