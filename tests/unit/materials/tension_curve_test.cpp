#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "materials/fabric/fabric.hpp"
#include "tests/unit/materials/fabrics_under_test.hpp"
#include "tests/unit/materials/rates.hpp"

namespace snug::testing {
namespace {

using materials::TensionCurve;

constexpr double gf_per_cm = 0.980665;  // N/m; also J/m2 of one gf cm/cm2

double green(double e) { return e + 0.5 * e * e; }
double nominal(const TensionCurve& curve, double e) { return (1 + e) * curve.at(green(e)).force; }

struct Worked {
  double LT, WT, Fm;            // 1, gf cm/cm2, gf/cm
  double a, initial_stiffness;  // 1, N/m
  std::array<double, 4> force;  // N/m at a quarter, half, three quarters and the whole of EMT
  double end_slope;             // N/m
};
const std::vector<Worked> worked = {
    {0.70, 12, 500, 27.80019296, 2379.713952, {52.26333, 136.43594, 272.00001, 490.33250}, 16011.0521},
    {0.90, 5, 500, 27.16354343, 16071.336829, {96.37423, 208.44688, 338.77509, 490.33250}, 29390.5050},
    {0.60, 20, 500, 20.04077891, 729.500182, {34.59471, 102.06765, 233.66575, 490.33250}, 10556.1454},
    {0.55, 30, 500, 14.24243146, 326.887360, {26.95977, 85.58737, 213.08089, 490.33250}, 7310.4144}};

TEST(TensionCurve, KesWorkedExamples) {
  // The exponential curve of a KES test has the printed force at the quarters of EMT, the printed initial and final
  // stiffness, and its integral is WT: reference book section 6.
  for (const Worked& w : worked) {
    const TensionCurve curve = TensionCurve::kes(w.LT, w.WT * gf_per_cm, w.Fm * gf_per_cm);
    const double em = 2 * w.WT / (w.LT * w.Fm);
    for (int q = 1; q <= 4; ++q)
      EXPECT_NEAR(nominal(curve, q * em / 4), w.force[q - 1], 6e-6) << w.LT << " quarter " << q;
    EXPECT_NEAR(curve.at(0.0).stiffness, w.initial_stiffness, 6e-7);
    EXPECT_NEAR(curve.at(green(em)).energy, w.WT * gf_per_cm, 1e-10);
    const auto end = curve.at(green(em));
    EXPECT_NEAR(end.stiffness * (1 + em) * (1 + em) + end.force, w.end_slope, 1e-4);  // back to dF/de
    const double ratio = nominal(curve, em) / nominal(curve, em / 2) - 1;             // exp(a em / 2)
    EXPECT_NEAR(2 * std::log(ratio) / em, w.a, 1e-8 * w.a);
  }
}

TEST(TensionCurve, AllLinearitiesKeepWorkAndForce) {
  // Below, at and above LT = 1 the curve ends at (EMT, Fm) with area WT, continuously in LT.
  for (double LT : {0.5, 0.9, 0.999999, 1.0, 1.000001, 1.05, 1.14}) {
    const double WT = 8.0, Fm = 49.0, em = 2 * WT / (LT * Fm);
    const TensionCurve curve = TensionCurve::kes(LT, WT, Fm);
    EXPECT_NEAR(nominal(curve, em), Fm, 1e-9) << LT;
    EXPECT_NEAR(curve.at(green(em)).energy, WT, 1e-9) << LT;
  }
  const double below = TensionCurve::kes(1 - 1e-7, 8, 49).at(0.1).force, at = TensionCurve::kes(1, 8, 49).at(0.1).force;
  EXPECT_NEAR(below, at, 1e-5);
}

TEST(TensionCurve, RisesEverywhere) {
  // S(E) is continuous with a continuous slope that nowhere falls below the smallest stiffness it states, not even for
  // a strongly concave test (LT = 1.6) that would soften to nothing inside its own data.
  auto fabrics = all_fabrics();
  const TensionCurve concave = TensionCurve::kes(1.6, 20.0, 49.0);
  fabrics.emplace_back("strongly concave", fabric(concave, concave, 0.2, 40));
  for (const auto& [name, f] : fabrics) {
    const double smallest = f.warp.smallest_stiffness();
    EXPECT_GT(smallest, 0.0) << name;
    auto last = f.warp.at(-0.4995);
    const double step = 5e-4;
    for (double E = -0.499; E < 4.0; E += step) {
      const auto next = f.warp.at(E);
      ASSERT_GE(next.stiffness, smallest * (1 - 1e-9)) << name << " E = " << E;
      ASSERT_NEAR((next.force - last.force) / step, 0.5 * (next.stiffness + last.stiffness), 2e-3 * next.stiffness)
          << name << E;
      last = next;
    }
  }
}

TEST(TensionCurve, ValuesByRate) {
  // Force and stiffness are the derivatives of the energy, in compression, inside the data and beyond it.
  for (const auto& [name, f] : all_fabrics())
    for (double E : {-0.2, 0.03, 0.9}) {
      SCOPED_TRACE(name);
      const auto r = f.warp.at(E);
      const auto energy = [&](const Eigen::VectorXd& x) {
        return Eigen::VectorXd::Constant(1, f.warp.at(x[0]).energy);
      };
      const auto force = [&](const Eigen::VectorXd& x) { return Eigen::VectorXd::Constant(1, f.warp.at(x[0]).force); };
      expect_derivative_by_rate(energy, Eigen::VectorXd::Constant(1, E), Eigen::MatrixXd::Constant(1, 1, r.force),
                                2e-3);
      expect_derivative_by_rate(force, Eigen::VectorXd::Constant(1, E), Eigen::MatrixXd::Constant(1, 1, r.stiffness),
                                2e-3);
    }
}

TEST(TensionCurve, LinearIsStVenantKirchhoff) {
  // A linear S means the nominal force K l (l^2 - 1)/2 and the energy K E^2/2.
  const TensionCurve curve = TensionCurve::linear(1000);
  EXPECT_DOUBLE_EQ(nominal(curve, 0.2), 1000 * 1.2 * (1.44 - 1) / 2);
  EXPECT_DOUBLE_EQ(curve.at(0.3).energy, 45.0);
  EXPECT_DOUBLE_EQ(curve.at(-0.3).force, -300.0);
}

TEST(TensionCurve, CubicHasItsNominalForce) {
  // F(e) = k1 e + k3 e^3 inside the data.
  const TensionCurve curve = TensionCurve::cubic(100, 2000, 0.5);
  for (double e : {0.01, 0.1, 0.3, 0.5}) EXPECT_NEAR(nominal(curve, e), 100 * e + 2000 * e * e * e, 1e-10);
}

TEST(TensionCurve, RefusesWhatIsNoTest) {
  // LT of 2 and more, or no work, is no tensile curve.
  EXPECT_THROW(TensionCurve::kes(2.0, 8, 49), std::invalid_argument);
  EXPECT_THROW(TensionCurve::kes(0.9, 0, 49), std::invalid_argument);
  EXPECT_THROW(TensionCurve::cubic(0, 1, 1), std::invalid_argument);
}

}  // namespace
}  // namespace snug::testing
