// The skin of a cut body, closed over its cuts, as placing takes it.
#pragma once

#include "mesh/body/body_mesh.hpp"
#include "mesh/placement/body_surface.hpp"

namespace snug::mesh {

/// Borders at which a skin ends: closed ways of vertices of `triangulated(body)`, the skin on their left.
std::vector<std::vector<int>> skin_borders(const TriangleSurface& skin);

/// Whether the skin of a body is more than one tube: it ends at three cuts or more, or some horizontal section of it has
/// several loops side by side. A loop that is small against the largest (a toe, a fold) does not count.
bool branches(const BodyMesh& body);
/// Whether every section of the skin between two heights (m) is one loop.
bool one_loop_between(const BodyMesh& body, double lower, double upper);

/// The skin of a body that stands as the case has it (z up, y to the front), closed by flat lids over its cuts. Nothing is turned; the
/// origin goes midway between the legs where the body has two at its lower end, else to the middle of the lowest section, and the lowest
/// point to z = 0. Its scale is 6.5 times the largest depth of its trunk or its height, whichever is more: what a standing body has at the
/// least. Throws input::InputError at `where` for a skin that is not turned one way.
BodySurface body_of_skin(const BodyMesh& body, const input::Location& where);

}  // namespace snug::mesh
