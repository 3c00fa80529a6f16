// Where the files are that ship beside the program: cases/ and scripts/.
#pragma once

#include <filesystem>

namespace snug::app {

/// share/snug in the folder of the program, where a build puts it, or where an installation has it (../share/snug from there, unless
/// CMake was told another layout). The program's own place decides, not where it was built. Not there: where it was looked for last.
std::filesystem::path data_directory();

}  // namespace snug::app
