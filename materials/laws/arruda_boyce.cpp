#include "materials/laws/arruda_boyce.hpp"

#include <array>

#include "materials/laws/first_invariant.hpp"

namespace snug::materials {

namespace {

constexpr std::array<double, 5> series = {1.0 / 2.0, 1.0 / 20.0, 11.0 / 1050.0, 19.0 / 7000.0, 519.0 / 673750.0};

struct SeriesValues {
  double energy = 0.0, slope = 0.0, curvature = 0.0;  ///< sum of C_i y^(i-1) (I^i - 3^i) and its derivatives by I
};

/// At I = 3 + x with y = 1/lambda_m^2. I^i - 3^i = I (I^(i-1) - 3^(i-1)) + 3^(i-1) x cancels nothing where x is small.
SeriesValues values_of_series(double x, double y) {
  SeriesValues sum;
  const double I = 3.0 + x;
  double difference = 0.0, power_of_three = 1.0, power = 1.0, power_below = 0.0;  // I^i - 3^i, 3^(i-1), (y I)^(i-1), y (y I)^(i-2)
  double power_of_y = 1.0;
  for (std::size_t n = 0; n < series.size(); ++n) {
    const double i = static_cast<double>(n + 1);
    difference = I * difference + power_of_three * x;
    sum.energy += series[n] * power_of_y * difference;
    sum.slope += series[n] * i * power;
    sum.curvature += series[n] * i * (i - 1.0) * power_below;
    power_below = y * power, power *= y * I, power_of_y *= y, power_of_three *= 3.0;
  }
  return sum;
}

}  // namespace

// With q = (J^(-2/3) I1 - 3)/2 and the series s(I) at I = 3 + 2 q: W = mu s.
SolidResponse ArrudaBoyce::isochoric(const Eigen::Matrix3d& F) const {
  const SolidResponse q = first_invariant_energy(F, 1.0);
  const SeriesValues s = values_of_series(2.0 * q.energy, 1.0 / (locking_stretch * locking_stretch));
  return response_of({.energy = mu * s.energy, .slope = 2.0 * mu * s.slope, .curvature = 4.0 * mu * s.curvature}, q);
}

double ArrudaBoyce::initial_shear_modulus() const { return 2.0 * mu * values_of_series(0.0, 1.0 / (locking_stretch * locking_stretch)).slope; }

}  // namespace snug::materials
