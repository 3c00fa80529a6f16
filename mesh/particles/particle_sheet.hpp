// Cloth as a grid of particles with physical forces: falling, hanging and draping sheets. A grid of springs is no
// continuum: it has no lateral contraction, and shear is that of cells as a whole. It shows how cloth falls, not
// pressures.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "mesh/particles/implicit_particles.hpp"

namespace snug::mesh {

struct SheetLaws {
  TensileCurve warp, weft;
  double shear = 0.0;  ///< N/m: energy per area shear phi^2/2 with the angle phi (rad) off the right one
  double bending_warp = 0.0,
         bending_weft = 0.0;  ///< N m: energy per area B k^2/2 with the curvature k along warp, weft
  double density = 0.0;       ///< kg/m2
  double drag = 0.0;          ///< N s/m3: force per area against the velocity
  double gravity = 9.80665;   ///< m/s2, along -z
};

/// A body that repels: energy per area stiffness (reach - distance)^2/2 where that is nearer than `reach`.
struct Repulsion {
  std::function<Nearness(const Eigen::Vector3d&)> body;
  double stiffness = 0.0;  ///< N/m3
  double reach = 0.0;      ///< m
};

enum class SheetForce { stretch, trellis, bend, twist, repulsion, gravity };
constexpr auto texts_of(SheetForce) {
  return std::array{"stretch", "trellis", "bend", "twist", "repulsion", "gravity"};
}

/// Rows of particles along warp, columns along weft, all equally spaced. A chain has one column.
struct SheetGrid {
  int along_warp = 0, along_weft = 1;             ///< particles
  double spacing_warp = 0.0, spacing_weft = 0.0;  ///< m; the width of a chain is spacing_weft
};

class ParticleSheet : public ImplicitParticles {
 public:
  /// Places of the particles (m), warp running fastest; they begin at rest. Throws std::invalid_argument where numbers
  /// do not fit or something is not positive.
  ParticleSheet(const SheetGrid& grid, SheetLaws laws, std::vector<Eigen::Vector3d> places,
                const std::vector<bool>& held, std::optional<Repulsion> repulsion = {});

  /// N, of one kind on every particle (table 4.3 of the source).
  std::vector<Eigen::Vector3d> forces(SheetForce kind) const;

 private:
  void add_laws(const Places& x, ForceSum& into) const override;
  void add(SheetForce kind, const Places& x, ForceSum& into) const;
  void add_stretch(const Places& x, ForceSum& into) const;
  void add_trellis(const Places& x, ForceSum& into) const;
  void add_differences(bool twist, ForceSum& into, const Places& x) const;
  void add_repulsion(const Places& x, ForceSum& into) const;
  int number(int warp, int weft) const { return weft * grid_.along_warp + warp; }

  SheetGrid grid_;
  SheetLaws laws_;
  std::optional<Repulsion> repulsion_;
};

}  // namespace snug::mesh
