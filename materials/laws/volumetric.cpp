#include "materials/laws/volumetric.hpp"

#include <cmath>

namespace snug::materials {

// Energies are written in d = J - 1 to keep digits near J = 1.
VolumetricResponse Volumetric::at(double J) const {
  const double kappa = bulk_modulus, d = J - 1.0;
  switch (form) {
    case VolumetricForm::logarithmic: {
      const double log = std::log1p(d);
      return {.energy = 0.5 * kappa * log * log, .pressure = kappa * log / J, .modulus = kappa * (1.0 - log) / (J * J)};
    }
    case VolumetricForm::quadratic:
      return {.energy = 0.5 * kappa * d * d, .pressure = kappa * d, .modulus = kappa};
    case VolumetricForm::barrier:
      break;
  }
  return {.energy = 0.25 * kappa * (d * (2.0 + d) - 2.0 * std::log1p(d)),
          .pressure = 0.5 * kappa * (d * (2.0 + d) / J),
          .modulus = 0.5 * kappa * (1.0 + 1.0 / (J * J))};
}

}  // namespace snug::materials
