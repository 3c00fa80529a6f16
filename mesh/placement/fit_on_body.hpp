// How wide a garment is by height round trunk and legs of the body that it was placed on.
#pragma once

#include "mesh/garment/garment_fit.hpp"
#include "mesh/placement/place_garment.hpp"

namespace snug::mesh {

/// Lengths on the flat pieces of the lines on which the placed cloth is level, against the taped girth of the trunk below the armpits and of
/// each leg. Heights are those of the body's file.
GarmentFit fit_on_body(const SewnMesh& sewn, const PlacedGarment& placed, const DressForm& form);

/// m, by how much the widest part that goes all the way round stands off all round; 0: nowhere wider than the body.
double stand_off(const GarmentFit& fit);

/// m, height of what lies over all girths of a garment on a body that branches: cloth on the shoulders, of which no girth tells whether it is taut. 0: none.
double above_girths(const GarmentFit& fit);

}  // namespace snug::mesh
