// Ogden: W = sum_p mu_p/alpha_p (l1^alpha_p + l2^alpha_p + l3^alpha_p - 3) + U(J), l_a = J^(-1/3) lambda_a the
// isochoric principal stretches; mu = sum_p mu_p alpha_p / 2. Fits rubber over its whole range and tissues in
// compression. Source: Ogden, Proc. R. Soc. A 326 (1972) 565-584. (Abaqus and FEBio write mu_p with other factors: see
// the reference.)
#pragma once

#include <vector>

#include "materials/laws/response.hpp"
#include "materials/laws/volumetric.hpp"

namespace snug::materials {

struct OgdenTerm {
  double mu = 0.0;     ///< Pa
  double alpha = 0.0;  ///< not zero; of the sign of mu in a stable set
};

struct Ogden {
  std::vector<OgdenTerm> terms;
  Volumetric volume;

  SolidResponse isochoric(const Eigen::Matrix3d& F) const;
  VolumetricResponse volumetric(double J) const { return volume.at(J); }
  double initial_shear_modulus() const {
    double sum = 0.0;
    for (const OgdenTerm& term : terms) sum += 0.5 * term.mu * term.alpha;
    return sum;
  }
  double initial_bulk_modulus() const { return volume.bulk_modulus; }
};

}  // namespace snug::materials
