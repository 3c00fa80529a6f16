#include "postproc/comfort/least_squares.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace snug::postproc {
namespace {

struct Problem {
  const Residuals& residuals;
  std::vector<double> x, r;
};

int evaluate(const gsl_vector* x, void* data, gsl_vector* f) {
  auto& problem = *static_cast<Problem*>(data);
  for (std::size_t i = 0; i < problem.x.size(); ++i) problem.x[i] = gsl_vector_get(x, i);
  problem.residuals(problem.x, problem.r);
  for (std::size_t i = 0; i < problem.r.size(); ++i) {
    if (!std::isfinite(problem.r[i])) return GSL_EDOM;
    gsl_vector_set(f, i, problem.r[i]);
  }
  return GSL_SUCCESS;
}

/// GSL aborts the program at an error unless its handler is off; the former one is put back.
struct NoAbort {
  gsl_error_handler_t* former = gsl_set_error_handler_off();
  ~NoAbort() { gsl_set_error_handler(former); }
};

}  // namespace

std::optional<std::vector<double>> least_squares(const Residuals& residuals, const std::vector<double>& start,
                                                 std::size_t count) {
  if (count < start.size()) return std::nullopt;
  const NoAbort guard;
  Problem problem{residuals, start, std::vector<double>(count)};
  gsl_multifit_nlinear_fdf system{};
  system.f = evaluate;
  system.n = count;
  system.p = start.size();
  system.params = &problem;
  const gsl_multifit_nlinear_parameters parameters = gsl_multifit_nlinear_default_parameters();
  const std::unique_ptr<gsl_multifit_nlinear_workspace, decltype(&gsl_multifit_nlinear_free)> work(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, count, start.size()),
      gsl_multifit_nlinear_free);
  const gsl_vector_const_view first = gsl_vector_const_view_array(start.data(), start.size());
  if (gsl_multifit_nlinear_init(&first.vector, &system, work.get()) != GSL_SUCCESS) return std::nullopt;
  int info = 0;
  const int status = gsl_multifit_nlinear_driver(500, 1e-10, 1e-10, 0.0, nullptr, nullptr, &info, work.get());
  if (status != GSL_SUCCESS && status != GSL_ENOPROG) return std::nullopt;  // no progress: already at the minimum
  std::vector<double> answer(start.size());
  for (std::size_t i = 0; i < answer.size(); ++i)
    answer[i] = gsl_vector_get(gsl_multifit_nlinear_position(work.get()), i);
  return std::all_of(answer.begin(), answer.end(), [](double x) { return std::isfinite(x); }) ? std::optional(answer)
                                                                                              : std::nullopt;
}

}  // namespace snug::postproc
