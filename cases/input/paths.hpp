// Files that a case names.
#pragma once

#include <filesystem>
#include <string>

#include "cases/input/diagnostics.hpp"
#include "cases/input/reader.hpp"

namespace snug::input {

/// The file `text` relative to rules.directory. Reports an absolute path, one that leaves the directory (unless
/// rules.allow_outside) and one that is not there; gives an empty path then.
std::filesystem::path resolve_path(const std::string& text, const Location& where, const ReadRules& rules,
                                   Diagnostics& diagnostics);

}  // namespace snug::input
