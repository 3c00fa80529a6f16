#include "materials/laws/one_point.hpp"

#include <algorithm>
#include <cmath>

namespace snug::materials {
namespace {

Eigen::Matrix3d gradient(Loading loading, double stretch, double free) {
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  if (loading == Loading::shear) {
    F(0, 1) = stretch;
    return F;
  }
  F(0, 0) = stretch;
  if (loading == Loading::equibiaxial) F(1, 1) = stretch;
  if (loading == Loading::uniaxial) F(1, 1) = free;
  if (loading != Loading::confined) F(2, 2) = free;
  return F;
}

double incompressible_side(Loading loading, double stretch) {
  if (loading == Loading::uniaxial) return 1.0 / std::sqrt(stretch);
  if (loading == Loading::equibiaxial) return 1.0 / (stretch * stretch);
  return 1.0 / stretch;
}

// The free stretch x = exp(y) from P33(x) = 0: Newton in y from the incompressible state. P33 and dP33/dx, which in
// uniaxial loading takes the second direction along.
std::optional<double> free_stretch(const SolidLaw& law, Loading loading, double stretch) {
  double y = std::log(incompressible_side(loading, stretch));
  for (int i = 0; i < 60; ++i) {
    const double x = std::exp(y);
    const SolidResponse r = coupled(law, gradient(loading, stretch, x));
    const double slope = r.tangent(8, 8) + (loading == Loading::uniaxial ? r.tangent(8, 4) : 0.0);
    if (!(slope > 0.0) || !std::isfinite(r.stress(2, 2))) return std::nullopt;
    const double step = std::clamp(-r.stress(2, 2) / (slope * x), -0.5, 0.5);
    y += step;
    if (std::abs(step) < 1e-12) return std::exp(y);
  }
  return std::nullopt;
}

}  // namespace

std::optional<PointState> one_point(const SolidLaw& law, Loading loading, double stretch) {
  PointState state;
  if (loading != Loading::shear && loading != Loading::confined) {
    const auto free = free_stretch(law, loading, stretch);
    if (!free) return std::nullopt;
    state.lateral = *free;
  }
  state.F = gradient(loading, stretch, state.lateral);
  state.J = state.F.determinant();
  state.first_piola = coupled(law, state.F).stress;
  state.cauchy = state.first_piola * state.F.transpose() / state.J;
  const int column = loading == Loading::shear ? 1 : 0;
  state.nominal_stress = state.first_piola(0, column);
  state.cauchy_stress = state.cauchy(0, column);
  return state;
}

}  // namespace snug::materials
