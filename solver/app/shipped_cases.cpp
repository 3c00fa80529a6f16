#include "solver/app/shipped_cases.hpp"

#include <algorithm>

#include "solver/app/data_directory.hpp"

namespace snug::app {

namespace fs = std::filesystem;

fs::path shipped_cases_folder() { return data_directory() / "cases"; }

std::vector<std::string> shipped_cases() {
  std::vector<std::string> names;
  std::error_code ignored;
  const fs::path folder = shipped_cases_folder();
  for (const auto& entry : fs::recursive_directory_iterator(folder, ignored))
    if (entry.path().filename() == "case.toml")
      names.push_back(entry.path().parent_path().lexically_relative(folder).generic_string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace snug::app
