// What a garment is cut from: a tube, or the pieces of a sewing pattern; and the mesh of it on a limb.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/garment/garment_mesh.hpp"
#include "mesh/garment/net_shape.hpp"
#include "mesh/pattern/checks.hpp"
#include "mesh/placement/dress_form.hpp"

namespace snug::mesh {

struct GarmentCut {
  input::GarmentSpec spec;
  std::optional<CheckedPattern> pattern;  ///< none of a tube
  std::optional<RingNet> shape = {};     ///< that it is placed on instead of the skin
};

/// Reads and checks the pattern that a garment names, in the size and with the pieces that it wants; settles which piece is of which fabric
/// (garment_zones.hpp); reads the net that it is placed on. Throws input::InputError.
GarmentCut read_cut(const input::GarmentSpec& spec);

struct CutSize {
  double area = 0.0, border = 0.0;  ///< m2, m: of all pieces
};
CutSize size_of(const GarmentCut& cut);

/// How many open edges it has when sewn.
std::size_t openings_of(const GarmentCut& cut);

/// How far up it reaches from its lowest point, m, along the cloth.
double rise_of(const GarmentCut& cut);

/// How wide it is by height where it is placed; of a pattern with coarse cells. Throws as make_garment_mesh does.
GarmentFit placed_fit(const GarmentCut& cut, const Limb& limb);
GarmentFit placed_fit(const GarmentCut& cut, const DressForm& form);

/// On a limb, and from there on the net of its shape if it has one (net_shape.hpp). A tube as make_tube_mesh has it; of a pattern the pieces meshed with edges of about `worn_size` as worn (`spec.cell_size` on
/// the pattern where the case gives one), sewn, and placed as place_on_limb does. Open edges have the pattern's names; edges of pieces that the
/// garment is held at ("front.waist") theirs. Throws input::InputError.
GarmentMesh make_garment_mesh(const GarmentCut& cut, const Limb& limb, double worn_size, double lift = 2e-4);
/// The same on a body that branches, placed as place_garment does: 2 mm off the skin, and farther by what `lift` is more than there. A tube is
/// the pattern of one piece that it is (tube_pattern). Its lowest point is laid at `spec.position` where that is given. Throws
/// input::InputError also where the placed shape is not accepted.
GarmentMesh make_garment_mesh(const GarmentCut& cut, const DressForm& form, double worn_size, double lift = 2e-4);

}  // namespace snug::mesh
