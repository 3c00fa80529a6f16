// Where the layers of the body stand between bone and skin.
#pragma once

#include <optional>
#include <vector>

#include "mesh/body/lattice.hpp"
#include "mesh/body/limb.hpp"

namespace snug::mesh {

/// The layers of a body sorted by form. Thicknesses are measured at right angles to the skin for the layers outside the
/// one that takes the rest, and at right angles to the bone for those inside it (to first order where the bone is
/// eccentric: the ray from bone to skin of equal turn is divided, corrected by its angle to the normal).
class Layering {
 public:
  /// Throws input::InputError: another rigid layer than the first, a membrane that is not the outermost layer,
  /// no or several solid layers without thickness, thickness or cells not positive.
  explicit Layering(const input::BodySpec& spec);

  /// Between bone and skin.
  const std::vector<input::LayerSpec>& solids() const { return solids_; }
  const std::vector<input::LayerSpec>& membranes() const { return membranes_; }
  /// The elastic bone, or null when it is rigid; its outline is that of the limb's bone.
  const input::LayerSpec* bone() const { return bone_ ? &*bone_ : nullptr; }
  /// Names and cells of the layers with cells, from the inside out.
  std::vector<LatticeLayer> lattice_layers() const;

  /// Point of the body at lattice height `k` (0 = bone, 2 x all cells = skin). Throws input::InputError naming layer,
  /// angle and height where the given thicknesses leave nothing for the rest.
  Eigen::Vector3d point(const Limb& limb, double turn, double z, int k) const;

 private:
  /// Fractions of the ray from bone to skin at the interfaces: solids + 1 values from 0 to 1.
  std::vector<double> interfaces(const Limb& limb, double turn, double z) const;

  std::optional<input::LayerSpec> bone_;
  std::vector<input::LayerSpec> solids_, membranes_;
  std::size_t rest_ = 0;  // the solid layer without thickness
};

}  // namespace snug::mesh
