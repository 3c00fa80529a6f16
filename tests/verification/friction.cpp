#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/verification/book.hpp"
#include "tests/verification/strip.hpp"

namespace {

using namespace snug;
using tests::Strip, tests::StripAnswer;

constexpr double pi = std::numbers::pi;

StripAnswer print(const Strip& s) {
  const StripAnswer a = tests::run(s, 0.1, [](const postproc::Iteration& r) {
    if (getenv("SNUG_TRACE")) fmt::print("  {} {} res {:.2e} nodes {} changed {} step {:.2f}\n", r.increment, r.iteration, r.residual, r.contact_nodes, r.changed, r.step);
  });
  fmt::print("mu {:.2f} span {:3.0f} cells {:3} elastic slip {:.4f} h: T1 {:9.5f} T2 {:9.5f} ratio {:.7f} (exact {:.7f}, {:+.2e}) "
             "slip arc {:.3f} deg; {} increments, {} iterations{}\n",
             s.friction, s.span * 180 / pi, s.cells, s.elastic_slip, a.start_tension, a.end_tension,
             a.end_tension / a.start_tension, std::exp(s.friction * s.span),
             a.end_tension / a.start_tension / std::exp(s.friction * s.span) - 1.0, a.slip_arc * 180 / pi, a.increments,
             a.iterations, a.converged ? "" : "  NOT CONVERGED: " + a.message);
  std::fflush(stdout);
  return a;
}

// A band that slides all round a rigid cylinder pulls with exp(mu theta) times the tension that it is held with.
TEST(Friction, CapstanRatioIsTheExponentialOfFrictionTimesAngle) {
  for (const double mu : {0.1, 0.3, 0.5})
    for (const double span : {0.5 * pi, pi}) {
      Strip s;
      s.friction = mu, s.span = span, s.cells = static_cast<int>(std::lround(90.0 * span / pi));
      s.rest_length = s.radius * span / 1.2;
      s.lead_start = s.lead_end = 0.1;
      const StripAnswer a = print(s);
      EXPECT_TRUE(a.converged);
      tests::book("capstan", fmt::format("T2/T1, mu = {}, {:.0f} deg", mu, span * 180 / pi),
                  a.end_tension / a.start_tension, std::exp(mu * span), 5e-3, "exp(mu theta), reference book 3");
    }
}

}  // namespace
