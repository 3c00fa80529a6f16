#include "mesh/body/spline.hpp"

#include <gsl/gsl_spline.h>

#include <algorithm>
#include <cassert>

namespace snug::mesh {

struct Spline::Gsl {
  Gsl(const std::vector<double>& z, const std::vector<double>& values, Kind kind)
      : low(z.front()),
        high(z.back()),
        spline(gsl_spline_alloc(z.size() < 3             ? gsl_interp_linear
                                : kind == Kind::monotone ? gsl_interp_steffen
                                                         : gsl_interp_cspline,
                                z.size())) {
    gsl_spline_init(spline, z.data(), values.data(), z.size());
  }
  ~Gsl() { gsl_spline_free(spline); }
  Gsl(const Gsl&) = delete;
  Gsl& operator=(const Gsl&) = delete;

  double low, high;
  gsl_spline* spline;
};

Spline::Spline(const std::vector<double>& z, const std::vector<double>& values, Kind kind) {
  assert(z.size() >= 2 && z.size() == values.size());
  gsl_ = std::make_unique<Gsl>(z, values, kind);
}
Spline::Spline(Spline&&) noexcept = default;
Spline& Spline::operator=(Spline&&) noexcept = default;
Spline::~Spline() = default;

std::array<double, 3> Spline::derivatives(double z) const {
  // GSL refuses points outside its range; the straight continuation starts from the nearest end. No accelerator is
  // passed: it would be shared state, and the stations are few.
  const double inside = std::clamp(z, gsl_->low, gsl_->high);
  const double value = gsl_spline_eval(gsl_->spline, inside, nullptr);
  const double slope = gsl_spline_eval_deriv(gsl_->spline, inside, nullptr);
  if (inside != z) return {value + slope * (z - inside), slope, 0.0};
  return {value, slope, gsl_spline_eval_deriv2(gsl_->spline, inside, nullptr)};
}

}  // namespace snug::mesh
