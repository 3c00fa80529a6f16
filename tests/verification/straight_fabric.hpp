// The fabric of the book's engineering strains.
#pragma once

#include "materials/fabric/fabric.hpp"

namespace snug::tests {

/// Nominal tension k (l - 1) along warp and weft, which do not feel each other; N/m.
inline materials::Fabric straight_fabric(double k, double shear) {
  materials::Fabric fabric;
  fabric.warp = fabric.weft = materials::TensionCurve::cubic(k, 0.0, 2.0);
  fabric.shear = shear;
  return fabric;
}

}  // namespace snug::tests
