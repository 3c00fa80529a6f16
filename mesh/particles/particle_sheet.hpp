// Cloth as a grid of particles with physical forces: falling, hanging and draping sheets. A grid of springs is no
// continuum: it has no lateral contraction, and shear is that of cells as a whole. It shows how cloth falls, not
// pressures.
#pragma once

#include <Eigen/Core>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace snug::mesh {

/// Of a strip at a stretch (current over flat length): energy per flat area (N/m), tension (N/m), its derivative by the
/// stretch (N/m).
struct Tensile {
  double energy = 0.0, tension = 0.0, tangent = 0.0;
};
using TensileCurve = std::function<Tensile(double stretch)>;

struct SheetLaws {
  TensileCurve warp, weft;
  double shear = 0.0;  ///< N/m: energy per area shear phi^2/2 with the angle phi (rad) off the right one
  double bending_warp = 0.0,
         bending_weft = 0.0;  ///< N m: energy per area B k^2/2 with the curvature k along warp, weft
  double density = 0.0;       ///< kg/m2
  double drag = 0.0;          ///< N s/m3: force per area against the velocity
  double gravity = 9.80665;   ///< m/s2, along -z
};

/// How far a point is from a body and which way off it (unit), m.
struct Nearness {
  double distance = 0.0;
  Eigen::Vector3d away = Eigen::Vector3d::Zero();
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

class ParticleSheet {
 public:
  /// Places of the particles (m), warp running fastest; they begin at rest. Throws std::invalid_argument where numbers
  /// do not fit or something is not positive.
  ParticleSheet(const SheetGrid& grid, SheetLaws laws, std::vector<Eigen::Vector3d> places, std::vector<bool> held,
                std::optional<Repulsion> repulsion = {});

  /// A step of implicit Euler (s): the minimum over x of |x - x0 - dt v0|^2 m/(2 dt^2) + |x - x0|^2 c/(2 dt) + U(x), by
  /// Newton's method with a line search; in parts where that does not converge for the whole. Potential and kinetic
  /// energy together never grow. Throws std::runtime_error where the smallest parts do not converge.
  void step(double dt);

  const std::vector<Eigen::Vector3d>& places() const { return places_; }
  const std::vector<Eigen::Vector3d>& velocities() const { return velocities_; }
  double mass(int particle) const { return laws_.density * area_[particle]; }  ///< kg
  double drag(int particle) const { return laws_.drag * area_[particle]; }     ///< N s/m
  double potential_energy() const { return potential(places_); }               ///< J
  double kinetic_energy() const;                                               ///< J
  /// N, of one kind on every particle (table 4.3 of the source).
  std::vector<Eigen::Vector3d> forces(SheetForce kind) const;
  /// N, a constant force on a particle, besides the laws'.
  void pull(int particle, const Eigen::Vector3d& force) { pulls_[particle] = force; }

 private:
  using Places = std::vector<Eigen::Vector3d>;
  struct Assembly;  // energy, gradient and second derivatives
  double potential(const Places& x) const;
  double objective(const Places& x, double dt) const;
  Assembly derivatives(const Places& x, double dt) const;
  std::optional<Places> minimum(double dt) const;
  Places searched(const Places& x, const Eigen::VectorXd& way, double slope, double dt) const;
  void add(SheetForce kind, const Places& x, Assembly& into) const;
  void add_stretch(const Places& x, Assembly& into) const;
  void add_trellis(const Places& x, Assembly& into) const;
  void add_differences(bool twist, Assembly& into, const Places& x) const;
  void add_repulsion(const Places& x, Assembly& into) const;
  void add_gravity(const Places& x, Assembly& into) const;
  int number(int warp, int weft) const { return weft * grid_.along_warp + warp; }
  double share(int n, int count) const { return count == 1 || (n > 0 && n + 1 < count) ? 1.0 : 0.5; }

  SheetGrid grid_;
  SheetLaws laws_;
  std::optional<Repulsion> repulsion_;
  Places places_, velocities_, pulls_;
  std::vector<bool> held_;
  std::vector<double> area_;  // m2, of each particle
};

}  // namespace snug::mesh
