// What a pattern holds, as text.
#pragma once

#include <string>

#include "mesh/pattern/checks.hpp"
#include "mesh/pattern/sewn_mesh.hpp"

namespace snug::app {

/// Pieces with areas and edges, seams with both lengths and their ease, what stays open.
std::string pattern_table(const mesh::CheckedPattern& checked);
/// Triangles, nodes, and how well they keep areas and lengths.
std::string mesh_table(const mesh::SewnMesh& mesh);

}  // namespace snug::app
