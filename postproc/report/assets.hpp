// Templates, style and scripts of the pages: the files of this folder and of three.js, copied into the program by
// CMake.
#pragma once

#include <string_view>

namespace snug::postproc::report {

std::string_view page_template();
std::string_view comparison_template();
std::string_view comparison_sections();  ///< a part of the pages that compare runs
std::string_view project_template();
std::string_view library_template();
std::string_view library_script();
std::string_view map_template();  ///< a part of the pages: the unrolled map
std::string_view lines_template();  ///< a part of the pages: lines over an axis
std::string_view style();
std::string_view view_script();
std::string_view three_script();  ///< three.js with its orbit controls (MIT licence)

}  // namespace snug::postproc::report
