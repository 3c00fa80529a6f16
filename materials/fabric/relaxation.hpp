// The minimum behind the relaxed energy: W_r(E) = min over A >= 0 of W(E + A).
#pragma once

#include "materials/fabric/fabric.hpp"

namespace snug::materials {

/// Response of W_r alone; `plain` is fabric.unrelaxed(strain), which the taut test needs anyway.
MembraneResponse relax(const Fabric& fabric, const Eigen::Vector3d& strain, const MembraneResponse& plain);

}  // namespace snug::materials
