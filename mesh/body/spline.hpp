// Cubics through points: the interpolation of stations along a limb, and of widths along a tube.
#pragma once

#include <array>
#include <memory>
#include <vector>

namespace snug::mesh {

/// Interpolation of (z, value) by cubics; a straight line through two points. Beyond the ends it goes on straight.
class Spline {
 public:
  enum class Kind {
    natural,   ///< twice differentiable, beyond its ends, too, because it ends without curvature
    monotone,  ///< once differentiable, with no extremes between points (Steffen, Astron. Astrophys. 239 (1990) 443-450)
  };
  /// `z` strictly increasing, at least two points, as many values; checked by the caller.
  Spline(const std::vector<double>& z, const std::vector<double>& values, Kind kind = Kind::natural);
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
