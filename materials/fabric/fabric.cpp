#include "materials/fabric/fabric.hpp"

#include "materials/fabric/relaxation.hpp"

namespace snug::materials {

MembraneResponse Fabric::unrelaxed(const Eigen::Vector3d& strain) const {
  const TensionCurve::Value f1 = warp.at(strain[0]);
  const TensionCurve::Value f2 = weft.at(strain[1]);
  MembraneResponse r;
  r.energy = f1.energy + f2.energy + coupling * strain[0] * strain[1] + 0.5 * shear * strain[2] * strain[2];
  r.force = {f1.force + coupling * strain[1], f2.force + coupling * strain[0], shear * strain[2]};
  r.tangent << f1.stiffness, coupling, 0.0, coupling, f2.stiffness, 0.0, 0.0, 0.0, shear;
  return r;
}

MembraneResponse Fabric::relaxed(const Eigen::Vector3d& strain, double eta) const {
  const MembraneResponse plain = unrelaxed(strain);
  MembraneResponse r = relax(*this, strain, plain);
  if (r.state == MembraneResponse::State::taut) return r;
  r.energy += eta * (plain.energy - r.energy);
  r.force += eta * (plain.force - r.force);
  r.tangent += eta * (plain.tangent - r.tangent);
  return r;
}

Fabric with_usual_sheet(Fabric fabric) {
  constexpr double areal_density = 0.25, bending_length = 0.012, gravity = 9.80665;
  if (fabric.areal_density == 0.0) fabric.areal_density = areal_density;
  const double usual = fabric.areal_density * gravity * std::pow(bending_length, 3);
  if (fabric.bending.warp == 0.0) fabric.bending = {usual, usual};
  return fabric;
}

}  // namespace snug::materials
