// Readers of single formats of surfaces; read_surface tells by the content which one it is.
#pragma once

#include <string>

#include "mesh/formats/triangle_surface.hpp"

namespace snug::mesh {

/// PLY (Stanford), text or binary of either byte order: elements "vertex" with x, y, z and "face" with a list vertex_indices or vertex_index;
/// other elements and properties are passed over. Polygons are cut into fans. Throws input::InputError with file and line or element.
TriangleSurface parse_ply(const std::string& content, const std::string& file);
bool is_ply(const std::string& content);

/// OFF (Geomview) in text, with or without colours, normals or texture: OFF, COFF, NOFF, STOFF. Throws input::InputError with file and line.
TriangleSurface parse_off(const std::string& content, const std::string& file);
bool is_off(const std::string& content);

}  // namespace snug::mesh
