// The last faults of a start shape, mended one by one.
#pragma once

#include "mesh/placement/cloth_particles.hpp"
#include "mesh/placement/dress_form.hpp"

namespace snug::mesh {

/// What was mended, over all rounds.
struct Mended {
  int rounds = 0;
  int pushed_out = 0;  ///< triangles that crossed the body
  int smoothed = 0;    ///< triangles that were folded
  int widened = 0;     ///< triangles that were squeezed
};

/// Triangles that cross the body are pushed away from it by 0.7 mm a round, the corners of those that are folded by
/// more than 140 degrees go to the middle of their neighbours, those that are squeezed below 0.33 are widened to 0.4,
/// until nothing is left or 20 rounds are over; the round with the fewest faults is kept. It cures single places; a
/// shape that is wrong as a whole stays wrong.
Mended mend(ClothParticles& cloth, double clearance, const DressForm& form);

}  // namespace snug::mesh
