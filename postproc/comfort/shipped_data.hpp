// Files of postproc/data that are part of the program (CMake copies their text into the library).
#pragma once

#include <string_view>
#include <vector>

namespace snug::postproc {

struct ShippedFile {
  std::string_view name;  ///< "wear_trial_2002.csv"
  std::string_view text;
};

const std::vector<ShippedFile>& shipped_files();

/// Text of the file `name`. Throws std::logic_error when there is none: the name is ours.
std::string_view shipped_text(std::string_view name);

}  // namespace snug::postproc
