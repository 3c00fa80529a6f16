// Where the files are that ship beside the program: cases/, bodies/ and scripts/.
#pragma once

#include <filesystem>

namespace snug::app {

/// share/snug in the folder of the program, where a build puts it, or where an installation has it (../share/snug from there, unless
/// CMake was told another layout). The program's own place decides, not where it was built. Not there: where it was looked for last.
std::filesystem::path data_directory();

/// The folder of the standard bodies (cases/input/standard_body.hpp).
std::filesystem::path bodies_folder();

}  // namespace snug::app
