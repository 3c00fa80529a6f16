// Whether a placed garment may go to the solver.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mesh/placement/cloth_particles.hpp"
#include "mesh/placement/dress_form.hpp"
#include "mesh/placement/garment_rings.hpp"

namespace snug::mesh {

/// Principal stretches of each triangle against its flat piece, larger first.
std::vector<std::array<double, 2>> principal_stretches(const ClothTriangles& cloth,
                                                       const std::vector<Eigen::Vector3d>& places);

/// Figures of all triangles, shares by flat area.
struct StretchFigures {
  double median = 0.0, percentile_99 = 0.0, largest = 0.0;  ///< of the larger principal stretch
  double smallest = 0.0;                                    ///< of the smaller one
};
StretchFigures stretch_figures(const ClothTriangles& cloth, const std::vector<std::array<double, 2>>& stretches);

/// Numbers of the triangles that cross the body's surface.
std::vector<int> crossing_triangles(const ClothTriangles& cloth, const std::vector<Eigen::Vector3d>& places,
                                    const DressForm& form);
/// Pairs of triangles without a common node that cross each other.
std::vector<std::array<int, 2>> self_crossings(const ClothTriangles& cloth, const std::vector<Eigen::Vector3d>& places);
/// Pairs of neighbours whose normals are more than `angle` (rad) apart.
std::vector<std::array<int, 2>> folds(const ClothTriangles& cloth, const std::vector<Eigen::Vector3d>& places,
                                      double angle);

struct Criterion {
  std::string what;   ///< what is asked for
  std::string found;  ///< what the garment has
  bool met = false;
};

/// Open edges by name: places in order along each, closed.
using OpenLoops = std::map<std::string, std::vector<Eigen::Vector3d>>;

/// The tests of a placed, sewn garment, one after the other: no triangle crosses the body and none is inside; stretches
/// from 0.3 to 3; no edge folded by more than 150 degrees; the cloth goes once round each limb at every height where
/// its section is closed, its outside out; each open edge goes round the limb that it should; on a body that is cut, each lies over skin. `kind` left out: garments
/// whose pieces were given places; their open edges go round some limb each, no arm, leg or neck twice.
std::vector<Criterion> acceptance(const ClothTriangles& cloth, const std::vector<Eigen::Vector3d>& places,
                                  const OpenLoops& open, const DressForm& form, std::optional<GarmentKind> kind);

}  // namespace snug::mesh
