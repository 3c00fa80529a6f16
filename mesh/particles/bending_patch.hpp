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

/// The corner of a neighbouring triangle, unfolded into the plane of this one, across the side that begins at corner
/// `side`.
struct Neighbour {
  int particle = 0, side = 0;
  Eigen::Vector2d flat;
};
/// One list a triangle: the corners across its sides, whatever piece they are of; sides of three triangles and more
/// have none.
std::vector<std::vector<Neighbour>> neighbours_of(const std::vector<FlatTriangle>& triangles);

/// A sum of places and its stiffness (N/m): stiffness |sum w x|^2/2 is a part of a triangle's energy of bending.
struct BendingPart {
  std::vector<Weight> weights;
  double stiffness = 0.0;
};
/// The energy A/2 (B_warp |k11|^2 + B_weft |k22|^2 + 4 Bt |k12|^2), Bt = sqrt(B_warp B_weft)/2, of the mean second
/// derivatives of the places, k = 1/(2 A) sum over sides of length times the jump of the slope across it times n n^T
/// with the side's normal n: the rotation-free shell triangle of Onate & Cervera (Eng. Comput. 10 (1993) 543). A free
/// side has no jump, and bears no moment. For cloth that hardly stretches |k11| is its curvature.
std::vector<BendingPart> bending_parts(const FlatTriangle& triangle, const std::vector<Neighbour>& neighbours,
                                       double bending_warp, double bending_weft);

}  // namespace snug::mesh
