// The curvature of a triangle of cloth, from it and its neighbours.
#pragma once

#include <array>
#include <vector>

#include "mesh/particles/particle_forces.hpp"

namespace snug::mesh {

/// A triangle of particles with its corners on the flat cloth: x along warp, y along weft, m; counter-clockwise.
struct FlatTriangle {
  std::array<int, 3> particles{};
  std::array<Eigen::Vector2d, 3> flat;

  double area() const;  ///< m2
  /// Of the three shape functions, 1/m.
  std::array<Eigen::Vector2d, 3> gradients() const;
};

/// A corner of a triangle near by, unfolded into the plane of this one.
struct Neighbour {
  int particle = 0, triangle = 0;
  Eigen::Vector2d flat;
  double weight = 1.0;  ///< in the fit of the curvature
};
/// One list a triangle: the corners across its sides, whatever piece they are of; sides of three triangles and more
/// have none. Where there are less than three, the corners across the sides of these neighbours, too, with a smaller
/// weight.
std::vector<std::vector<Neighbour>> neighbours_of(const std::vector<FlatTriangle>& triangles);

/// A sum of places and its stiffness (N/m): stiffness |sum w x|^2/2 is a part of a triangle's energy of bending.
struct BendingPart {
  std::vector<Weight> weights;
  double stiffness = 0.0;
};
/// The energy A/2 (B_warp |x,11|^2 + B_weft |x,22|^2 + 4 Bt |x,12|^2) of the second derivatives of the quadratic
/// through the corners and the neighbours (six points, as the rotation-free shell triangle of Onate & Cervera, Eng.
/// Comput. 10 (1993) 543 has them; of more the nearest quadratic), Bt = sqrt(B_warp B_weft)/2. Where there are too few
/// for one, what is not told takes the value of least energy. For cloth that hardly stretches |x,11| is its curvature.
std::vector<BendingPart> bending_parts(const FlatTriangle& triangle, const std::vector<Neighbour>& neighbours,
                                       double bending_warp, double bending_weft);

}  // namespace snug::mesh
