// Neo-Hookean tissue: W = mu/2 (J^(-2/3) I1 - 3) + kappa/4 (J^2 - 1 - 2 ln J), a barrier as J -> 0.
// Source: Simo & Miehe, Comput. Methods Appl. Mech. Engrg. 98 (1992) 41-104; reference book law V1.
#pragma once

#include "cases/input/field.hpp"
#include "materials/laws/response.hpp"

namespace snug::materials {

struct NeoHooke {
  double shear_modulus = 0.0;  ///< Pa
  double poisson_ratio = 0.49;

  double bulk_modulus() const { return 2.0 * shear_modulus * (1.0 + poisson_ratio) / (3.0 * (1.0 - 2.0 * poisson_ratio)); }
  IsochoricResponse isochoric(const Eigen::Matrix3d& F) const;
  VolumetricResponse volumetric(double J) const;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "shear_modulus", .unit = "Pa", .meaning = "initial shear modulus", .required = true, .bound = positive()},
          self.shear_modulus);
    field(Field{.key = "poisson_ratio", .meaning = "initial Poisson ratio", .bound = {.low = 0.0, .high = 0.5, .high_open = true}},
          self.poisson_ratio);
  }
};

}  // namespace snug::materials
