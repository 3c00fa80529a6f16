#include "materials/fabric/sheet.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace snug::materials {

double Hysteresis::half_shear(double angle) const {
  constexpr double degree = std::numbers::pi / 180.0, narrow = 0.5 * degree, wide = 5.0 * degree;
  if (!shear && !wide_shear) return 0.0;
  const double at_narrow = shear.value_or(wide_shear.value_or(0.0)), at_wide = wide_shear.value_or(at_narrow);
  const double share = std::clamp((std::abs(angle) - narrow) / (wide - narrow), 0.0, 1.0);
  return 0.5 * (at_narrow + share * (at_wide - at_narrow));
}

std::optional<double> Compression::decrease() const {
  if (T0 && Tm) return *T0 - *Tm;
  if (LC && WC) return 2.0 * *WC / (*LC * largest_pressure());
  return std::nullopt;
}

// P(x) = Pm (exp(a x) - 1)/(exp(a xm) - 1) over x = T0 - T (as TensionCurve::kes), solved for x.
std::optional<double> thickness_under(double pressure, const Compression& compression, double thickness) {
  const double unloaded = compression.T0.value_or(thickness), share = pressure / compression.largest_pressure();
  const auto decrease = compression.decrease();
  if (!decrease || !compression.LC || !(*compression.LC < 2.0) || !(*decrease > 0.0 && *decrease < unloaded))
    return std::nullopt;
  if (!(share >= 0.0 && share <= 1.0)) return std::nullopt;
  const double exponent = exponent_of_linearity(*compression.LC);  // a xm
  return unloaded - *decrease * (exponent == 0.0 ? share : std::log1p(share * std::expm1(exponent)) / exponent);
}

}  // namespace snug::materials
