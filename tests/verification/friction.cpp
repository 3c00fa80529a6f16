#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/verification/book.hpp"
#include "tests/verification/strip.hpp"

namespace {

using namespace snug;
using tests::Strip, tests::StripAnswer;

using std::numbers::pi;

StripAnswer print(const Strip& s) {
  const StripAnswer a = tests::run(s, 0.1, [](const postproc::Iteration& r) {
    if (getenv("SNUG_TRACE")) fmt::print("  {} {} res {:.2e} nodes {} changed {} step {:.2f}\n", r.increment, r.iteration, r.residual, r.contact_nodes, r.changed, r.step);
  });
  fmt::print("mu {:g} span {:3.0f} cells {:3} elastic slip {:.4f} h: T1 {:9.5f} T2 {:9.5f} ratio {:.7f} (exact {:.7f}, {:+.2e}) "
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

/// Reference book 3: k = 1000 N/m, held with 100 N/m, mu = 0.3, R = 55 mm, 180 degrees: this rest length lies on the arc.
TEST(Friction, ElasticBandOfTheBookIsHeldWithItsTension) {
  Strip s;
  s.rest_length = 0.14838117494;
  s.lead_start = s.lead_end = 0.1;
  const StripAnswer a = print(s);
  EXPECT_TRUE(a.converged);
  tests::book("elastic band round a drum", "tension of the held end, N/m", a.start_tension, 100.0, 5e-3, "closed form, reference book 3");
  tests::book("elastic band round a drum", "tension of the pulled end, N/m", a.end_tension, 256.63323952, 5e-3, "closed form, reference book 3");
  double pressure = 0.0, shear = 0.0;
  for (const tests::StripPoint& at : a.middle) {
    if (at.angle < 0.2 || at.angle > s.span) continue;  // three edges and more from where the ends leave
    const double tension = a.start_tension * std::exp(s.friction * (at.angle - s.lead_start));
    pressure = std::max(pressure, std::abs(at.pressure * s.radius / tension - 1.0));
    shear = std::max(shear, std::abs(at.shear / (s.friction * at.pressure) - 1.0));
  }
  tests::book("elastic band round a drum", "largest deviation of p from T/R along the arc", pressure, 0.0, 1e-2, "p = T/R, reference book 3");
  tests::book("elastic band round a drum", "largest deviation of tau from mu p along the arc", shear, 0.0, 1e-2, "tau = mu p, reference book 3");
}

/// The ratio comes nearer to the exact one with a shorter elastic slip on the same mesh: a stick that is too soft lowers it.
TEST(Friction, CapstanRatioConvergesWithTheElasticSlip) {
  double before = 1.0;
  for (const double elastic : {5.12, 2.56, 1.28, 0.005}) {
    Strip s;
    s.rest_length = s.radius * s.span / 1.2;
    s.lead_start = s.lead_end = 0.1;
    s.elastic_slip = elastic;
    const StripAnswer a = print(s);
    EXPECT_TRUE(a.converged);
    const double error = std::abs(a.end_tension / a.start_tension / std::exp(0.3 * pi) - 1.0);
    EXPECT_LE(error, before) << "elastic slip " << elastic;
    before = error;
  }
  EXPECT_LE(before, 5e-3);
}

/// T0 = 100 N/m everywhere; the end is pulled until its tension is 150 N/m: the band slips over ln(1.5)/mu = 77.4381
/// degrees, and 1.39174 mm of its rest length leave the arc on which it did (reference book 3).
TEST(Friction, StickSlipBandSlipsAsFarAsTheBookSays) {
  Strip s;
  s.rest_length = s.radius * s.span / 1.1;
  const double exact_rest = 1.3917380029e-3, advance = exact_rest * 1.1;  // of the end round the drum
  s.lead_end = advance / s.radius;
  const StripAnswer a = print(s);
  EXPECT_TRUE(a.converged);
  tests::book("stick-slip band", "tension of the pulled end, N/m", a.end_tension, 150.0, 2e-3, "closed form, reference book 3");
  tests::book("stick-slip band", "tension of the held end, N/m", a.start_tension, 100.0, 1e-3, "it does not feel the pull");
  // The slip grows with the square of the distance from its front, so that the elastic slip hides the front's last
  // sqrt(elastic slip): two elements with the usual one, less than one with a tenth of it.
  EXPECT_NEAR(a.slip_arc, std::log(1.5) / 0.3, 2.0 * s.span / s.cells);
  Strip sharp = s;
  sharp.elastic_slip = 0.1 * s.elastic_slip;
  const StripAnswer c = print(sharp);
  EXPECT_TRUE(c.converged);
  tests::book("stick-slip band", "slip arc, deg, elastic slip 0.05 % of h", c.slip_arc * 180 / pi, 77.4381, 2.0 / 77.4381, "ln(T2/T0)/mu, within an element");
  // The advance at which the end carries exactly 150 N/m, by the slope between two advances.
  Strip more = s;
  more.lead_end = 1.02 * s.lead_end;
  const StripAnswer b = print(more);
  const double share = 1.0 + 0.02 * (150.0 - a.end_tension) / (b.end_tension - a.end_tension);
  tests::book("stick-slip band", "rest length pulled out at T2 = 150 N/m, mm", share * exact_rest * 1e3, exact_rest * 1e3, 1e-2,
              "closed form, reference book 3");
}

/// With mu towards 0 the band's tensions tend to the frictionless, even one.
TEST(Friction, VanishingFrictionIsNoFriction) {
  Strip s;
  s.cells = 45;
  s.rest_length = s.radius * s.span / 1.2;
  s.lead_start = s.lead_end = 0.05;
  s.friction = 0.0;
  const StripAnswer smooth = print(s);
  EXPECT_TRUE(smooth.converged);
  for (const double mu : {1e-2, 1e-4, 1e-6}) {
    s.friction = mu;
    const StripAnswer a = print(s);
    EXPECT_TRUE(a.converged);
    EXPECT_NEAR(a.end_tension, smooth.end_tension, 1.2 * 0.5 * mu * pi * smooth.end_tension + 1e-6);
  }
}

}  // namespace
