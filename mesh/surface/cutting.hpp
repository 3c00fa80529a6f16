// A surface cut off at planes, each where one limb passes through it.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

#include "cases/input/diagnostics.hpp"
#include "mesh/formats/triangle_surface.hpp"

namespace snug::mesh {

/// A plane with a name; `normal` points out of what is kept. Unlike a half space it cuts the limb at its point alone.
struct Cut {
  std::string name;
  Eigen::Vector3d point, normal;  ///< normal of length one
  input::Location where = {};
};

/// A closed polygon in the plane of a cut: its vertices in the surface, what is kept on the left as seen from outside the surface.
using Rim = std::vector<int>;

/// Two directions that with the normal make a right-handed frame.
struct PlaneFrame {
  explicit PlaneFrame(const Cut& cut);
  Eigen::Vector2d flat(const Eigen::Vector3d& x) const;
  Eigen::Vector3d lifted(const Eigen::Vector2d& p) const;
  Eigen::Vector3d origin, u, v;
};

double polygon_area(const std::vector<Eigen::Vector2d>& polygon);  ///< with sign, counter-clockwise positive
double distance_to_polygon(const Eigen::Vector2d& p, const std::vector<Eigen::Vector2d>& polygon);  ///< of its outline
bool inside_polygon(const Eigen::Vector2d& p, const std::vector<Eigen::Vector2d>& polygon);

/// Which of the sections (polygons in the frame of the plane) are cut through; indices.
using SectionChoice = std::function<std::vector<std::size_t>(const std::vector<std::vector<Eigen::Vector2d>>&)>;

/// The smallest section that holds the plane's point, or the one nearest to it; none where there is none.
std::vector<std::size_t> section_at_origin(const std::vector<std::vector<Eigen::Vector2d>>& sections);

/// Cuts at the chosen sections and drops what hangs on beyond them; vertices keep their numbers. Returns the rims. Throws
/// input::InputError at cut.where: the plane does not part the surface there, or an open chain is chosen from (a hole, another cut).
std::vector<Rim> cut_off(TriangleSurface& surface, const Cut& cut, const SectionChoice& choose);

/// Loops of edges that belong to one triangle only.
std::vector<Rim> border_loops(const TriangleSurface& surface);

/// Leaves out vertices that no triangle uses.
TriangleSurface compacted(const TriangleSurface& surface);

}  // namespace snug::mesh
