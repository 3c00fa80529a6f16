// Patterns from files.
#pragma once

#include <filesystem>
#include <string>

#include "mesh/pattern/garment_pattern.hpp"

namespace snug::mesh {

/// Reads a pattern by the ending of its file: .toml (ours), .json (GarmentCode), .dxf (AAMA, ASTM), .svg. A drawing
/// that a .toml names must lie in its folder or below. Throws input::InputError:
/// a file that is not there or of another kind, and every error in it with its place. What it means is checked by
/// `checked` (mesh/pattern/checks.hpp).
Pattern read_pattern(const std::filesystem::path& file, const std::string& shown_as = {});

}  // namespace snug::mesh
