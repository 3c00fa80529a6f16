#include "materials/laws/solid_law.hpp"

#include <stdexcept>

#include "materials/laws/tensor.hpp"

namespace snug::materials {
namespace {

// P = P_iso + U' cof F,  A = A_iso + U'' cof (x) cof + U' dcof/dF,  dcof_iJ/dF_kL = (cof_iJ cof_kL - cof_iL cof_kJ)/J.
template <Split Law>
SolidResponse with_volume(const Law& law, const Eigen::Matrix3d& F) {
  const Eigen::Matrix3d cof = cofactor(F);
  const double J = determinant(F, cof);
  const VolumetricResponse v = law.volumetric(J);
  SolidResponse r = law.isochoric(F);
  r.energy += v.energy;
  r.stress += v.pressure * cof;
  const Eigen::Matrix<double, 9, 1> n = components(cof);
  r.tangent += (v.modulus + v.pressure / J) * n * n.transpose();
  add_swapped(r.tangent, -v.pressure / J, cof);
  return r;
}

}  // namespace

bool is_split(const SolidLaw& law) {
  return std::visit([]<class Law>(const Law&) { return Split<Law>; }, law);
}

SolidResponse isochoric(const SolidLaw& law, const Eigen::Matrix3d& F) {
  return std::visit(
      [&]<class Law>(const Law& l) -> SolidResponse {
        if constexpr (Split<Law>) return l.isochoric(F);
        throw std::logic_error("a law without split has no isochoric part");
      },
      law);
}
VolumetricResponse volumetric(const SolidLaw& law, double J) {
  return std::visit(
      [&]<class Law>(const Law& l) -> VolumetricResponse {
        if constexpr (Split<Law>) return l.volumetric(J);
        throw std::logic_error("a law without split has no volumetric part");
      },
      law);
}

SolidResponse coupled(const SolidLaw& law, const Eigen::Matrix3d& F) {
  return std::visit(
      [&]<class Law>(const Law& l) {
        if constexpr (Split<Law>)
          return with_volume(l, F);
        else
          return l.coupled(F);
      },
      law);
}

double initial_shear_modulus(const SolidLaw& law) {
  return std::visit([](const auto& l) { return l.initial_shear_modulus(); }, law);
}
double initial_bulk_modulus(const SolidLaw& law) {
  return std::visit([](const auto& l) { return l.initial_bulk_modulus(); }, law);
}
double initial_youngs_modulus(const SolidLaw& law) {
  const double mu = initial_shear_modulus(law), kappa = initial_bulk_modulus(law);
  return 9.0 * kappa * mu / (3.0 * kappa + mu);
}

}  // namespace snug::materials

