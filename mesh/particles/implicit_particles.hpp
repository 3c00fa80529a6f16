// Particles with masses that move by implicit steps.
#pragma once

#include <optional>
#include <vector>

#include "mesh/particles/particle_forces.hpp"

namespace snug::mesh {

/// Components of a particle's place that are held: 1 x, 2 y, 4 z, or a sum of these.
using HeldComponents = unsigned char;
constexpr HeldComponents held_all = 7, held_height = 4;

/// How well the minimum of a step is looked for.
struct MinimumSearch {
  double tolerance = 1e-10;  ///< of the gradient, over the largest weight or pull of a particle
  int iterations = 50;
  /// Where they do not get there: true takes the place as it is, since energy has not grown; false cuts the step.
  bool take_what_there_is = false;
};

class ImplicitParticles {
 public:
  virtual ~ImplicitParticles() = default;

  /// A step of implicit Euler (s): the minimum over x of |x - x0 - dt v0|^2 m/(2 dt^2) + |x - x0|^2 c/(2 dt) + U(x), by
  /// Newton's method with a line search; in parts where that does not converge for the whole. Potential and kinetic
  /// energy together never grow. Throws std::runtime_error where the smallest parts do not converge.
  void step(double dt);

  /// Puts the particles elsewhere, with velocities (m/s); left out: at rest.
  void move_to(Places places, Places velocities = {});
  const Places& places() const { return places_; }
  const Places& velocities() const { return velocities_; }
  double mass(int particle) const { return mass_[particle]; }  ///< kg
  double drag(int particle) const { return drag_[particle]; }  ///< N s/m
  /// A particle's vector without its held components.
  Eigen::Vector3d free_part(int particle, Eigen::Vector3d vector) const;
  double potential_energy() const { return potential(places_); }  ///< J
  /// J, the potential energy `step` along a way from where the particles are.
  double energy_of(const Places& way, double step) const;
  double kinetic_energy() const;  ///< J
  /// N, a constant force on a particle, besides the laws'.
  void pull(int particle, const Eigen::Vector3d& force) { pulls_[particle] = force; }
  /// N, the sum of all forces but drag on every particle: what holds it answers its held components, the rest is out of
  /// balance.
  Places total_forces() const;
  /// N, what air bears every particle with: -c v, as in m a + c v = m g ([Thesis] sec. 4.3.3).
  Places drag_forces() const;
  int iterations() const { return iterations_; }  ///< of Newton's method, of all steps so far

 protected:
  /// Masses kg, drags N s/m, `gravity` m/s2 along -z. They begin at rest. Throws std::invalid_argument where numbers do
  /// not fit, a mass is not positive or a drag negative.
  ImplicitParticles(Places places, std::vector<HeldComponents> held, std::vector<double> masses,
                    std::vector<double> drags, double gravity, MinimumSearch search = {});

  /// The energy of all laws but weight.
  virtual void add_laws(const Places& x, ForceSum& into) const = 0;
  /// Called at the end of every part of a step.
  virtual void arrive() {}
  void add_gravity(const Places& x, ForceSum& into) const;

 private:
  double potential(const Places& x) const;
  double objective(const Places& x, double dt) const;
  ForceSum derivatives(const Places& x, double dt) const;
  std::optional<Places> minimum(double dt);
  Places searched(const Places& x, const Eigen::VectorXd& way, double slope, double dt) const;

  Places places_, velocities_, pulls_;
  std::vector<HeldComponents> held_;
  std::vector<double> mass_, drag_;
  double gravity_;
  MinimumSearch search_;
  int iterations_ = 0;
};

}  // namespace snug::mesh
