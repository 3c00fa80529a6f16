// Materials that a case names and that stand in the engineering database.
#pragma once

#include <filesystem>

#include "cases/input/case.hpp"

namespace snug::solver {

/// Puts in place of every such name the entry's own values, so that nothing below knows of the database. A name that a
/// run has by itself (materials/data/fabrics.toml, tissues.toml) stays as it is, and where a case names only such ones
/// the file is not opened. Throws input::InputError with every name that is nowhere.
void resolve_materials(input::Case& description, const std::filesystem::path& library);

}  // namespace snug::solver
