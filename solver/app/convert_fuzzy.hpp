// snug convert SYSTEM FILE.fll | FILE.fis: fuzzy systems from one format to the other.
#pragma once

#include <string>

namespace snug::app {

/// True when `file` ends in .fll or .fis.
bool is_fuzzy_file(const std::string& file);

/// Writes the system `from`, a shipped name or a file, to `to`. Throws input::InputError, also where FIS cannot hold
/// it.
void convert_fuzzy(const std::string& from, const std::string& to);

}  // namespace snug::app
