// A natural cubic spline: the interpolation of stations along a limb.
#pragma once

#include <array>
#include <memory>
#include <vector>

namespace snug::mesh {

/// Twice continuously differentiable interpolation of (z, value); a straight line through two points. Beyond the ends
/// it goes on straight, which keeps it twice differentiable because a natural spline ends without curvature.
class Spline {
 public:
  /// `z` strictly increasing, at least two points, as many values; checked by the caller.
  Spline(const std::vector<double>& z, const std::vector<double>& values);
  Spline(Spline&&) noexcept;
  Spline& operator=(Spline&&) noexcept;
  ~Spline();

  double operator()(double z) const { return derivatives(z)[0]; }
  /// {value, first, second derivative}.
  std::array<double, 3> derivatives(double z) const;

 private:
  struct Gsl;
  std::unique_ptr<Gsl> gsl_;
};

}  // namespace snug::mesh
