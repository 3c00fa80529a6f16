// A sewn pattern on a standing body: the start shape of a garment.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/pattern/sewn_mesh.hpp"
#include "mesh/placement/acceptance.hpp"
#include "mesh/placement/mending.hpp"

namespace snug::mesh {

struct PlacementOptions {
  double raise = 0.0;       ///< m, higher on the body than it would be laid
  std::optional<double> lowest = {};  ///< m, height of the lowest point as it is laid, instead
  double clearance = 0.002;  ///< m, off the skin
  int sewing_steps = 100;   ///< at least; half of them close the seams, 3 mm a step at most
  int settling_steps = 80;  ///< of the sewn garment, its stiffness falling from 0.5 to 0.05
};

struct PlacedGarment {
  std::vector<Eigen::Vector3d>
      places;  ///< m, frame of the body, of every node of the SewnMesh; equal where nodes become one
  std::optional<GarmentKind> kind;  ///< left out: the pieces had places of their own
  ClothTriangles cloth;             ///< of vertices; nodes are those of the SewnMesh that stay after sewing
  std::vector<std::array<double, 2>> stretches;  ///< principal, larger first, of each triangle of the SewnMesh
  StretchFigures figures;
  double lift = 0.0;       ///< m, by which given places were raised
  double first_gap = 0.0;  ///< m, largest between nodes that become one before the seams close
  double last_gap = 0.0;   ///< m, the same before they are merged; 0 afterwards
  std::string widest_seam;
  Mended mended;
  int self_crossings =
      0;  ///< pairs of triangles, between thighs that touch; no criterion, as the solver has no self-contact
  std::vector<Criterion> acceptance;

  bool accepted() const;
};

/// Lays the pieces on the body, by the places that they bring (all of them or none; raised or lowered as a whole until
/// what is sewn on top of the shoulders is a little above this body's) or by `GarmentChart`, draws the seams together
/// with particles that stay `clearance` off the skin, merges, lets the cloth settle, and mends single places
/// (`mend`). Gravity has no part in it, and equilibrium is left to the solver. Mid-edge nodes lie on straight edges.
/// Throws input::InputError: everything that `find_rings` refuses, some pieces with places and some without, and a seam
/// that stays open by more than half an edge, with its pieces, gap and height. Whether the shape may be used is told by
/// `acceptance`.
PlacedGarment place_garment(const CheckedPattern& checked, const SewnMesh& sewn, const DressForm& form,
                            const PlacementOptions& options = {});

/// A garment that was placed as one mesh of its pattern, carried over to another: a vertex goes where its point of the flat piece lies in the triangles of
/// `from`, and off the skin, single places are mended and the whole is judged anew. So where cloth lies does not hang on the mesh that is solved on:
/// particles settle differently on every mesh, by up to a hundredth of the garment's length along a limb.
PlacedGarment carried_over(const PlacedGarment& placed, const SewnMesh& from, const CheckedPattern& checked, const SewnMesh& to, const DressForm& form,
                           const PlacementOptions& options = {});

/// Throws input::InputError with every criterion that is not met.
void check_accepted(const PlacedGarment& placed, const Pattern& pattern);

}  // namespace snug::mesh
