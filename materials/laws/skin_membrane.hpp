// Skin as an incompressible membrane of rest thickness t without bending stiffness, of any law with split:
//   W(C) = t W_iso(C11, C22, C12, C33 = 1/det C)  per rest area,
// C the metric of the deformed surface in an orthonormal frame of the rest surface; C33 is the squared stretch through
// the thickness, whose stress is then free. Source: Adkins & Rivlin, Phil. Trans. R. Soc. A 244 (1952) 505-531.
#pragma once

#include "materials/laws/solid_law.hpp"

namespace snug::materials {

struct SkinMembrane {
  SolidLaw law;            ///< with split: is_split(law); its volumetric part is not used
  double thickness = 0.0;  ///< m

  /// `metric`: C11, C22, C12 with det C > 0. Force and tangent are derivatives by E11, E22, 2 E12 where C = 1 + 2 E.
  MembraneResponse at(const Eigen::Vector3d& metric) const;
};

}  // namespace snug::materials
