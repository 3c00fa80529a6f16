// A body of other girths: sections of a surface are scaled, what lies between them follows smoothly.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/formats/triangle_surface.hpp"

namespace snug::mesh {

/// Points x of the section go to c + factor (x - c) + shift, c its middle, within its plane.
struct Ring {
  std::string name;
  Eigen::Vector3d point = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::UnitZ();  ///< inside the section; `normal` outwards along the limb
  double factor = 1.0;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< m
  std::optional<double> asked;                      ///< m, girth; `factor` is corrected until it has that
  bool end = false;                                 ///< what lies beyond it keeps its shape
};

struct RingGirth {
  std::string name;
  double was = 0.0, is = 0.0;   ///< m
  std::optional<double> asked;  ///< m
};

/// Moves the vertices: those of triangles that a ring's plane crosses at its section as the ring says, those more than 3 cm beyond an end ring by its shift
/// alone, the others so that the integral of the squared Laplacian of the displacement is least, with cotangent weights (Botsch & Sorkine, IEEE
/// Trans. Vis. Comput. Graph. 14 (2008) 213, eq. 11). Three rounds correct the factors of girths that are asked for. Throws std::runtime_error
/// where a ring misses the surface.
std::vector<RingGirth> morph(TriangleSurface& surface, std::vector<Ring> rings);

}  // namespace snug::mesh
