// The way back of a fabric: RT, unloading rows of a test, the loops of shear, and thickness under pressure.
#include <gtest/gtest.h>

#include <cmath>

#include "cases/input/reader.hpp"
#include "materials/fabric/fabric_data.hpp"
#include "materials/fabric/measured.hpp"
#include "tests/unit/materials/measured_fabrics.hpp"

namespace snug::testing {
namespace {

using input::FabricBranch, input::InputError, input::MaterialEntry;
using materials::CurvePoint, materials::Fabric, materials::fabric_data, materials::FabricData, materials::find_fabric,
    materials::TensionCurve;

struct Printed {
  const char* name;
  double LT, WT, Fm, RT;  // 1, gf cm/cm2, gf/cm, percent
};
/// Table 5.2, with Fm = 2 WT/(LT EMT) where table 7.1 prints EMT, else 50 gf/cm.
const std::vector<Printed> wear_trial = {{"N88P", 1.09, 11.01, 50, 72.47},
                                         {"C98L2", 0.83, 3.76, 2 * 3.76 / (0.83 * 0.2456), 57.26},
                                         {"N85L15", 1.00, 10.02, 2 * 10.02 / (1.00 * 0.4326), 72.89},
                                         {"R95C", 0.96, 9.13, 50, 56.01},
                                         {"P98L2", 0.78, 6.28, 2 * 6.28 / (0.78 * 0.5639), 54.02},
                                         {"E95C", 1.05, 13.36, 50, 65.32},
                                         {"A92Np", 1.14, 8.79, 50, 60.10},
                                         {"N95C", 1.01, 8.18, 50, 51.31}};

TEST(Hysteresis, TheAreaBetweenTheBranchesIsWhatTheTestLost) {
  // Of all eight fabrics: both branches end at (EMT, Fm), the area between them is (1 - RT/100) WT; N85L15: 2.716 gf
  // cm/cm2 (B1).
  for (const Printed& f : wear_trial) {
    const FabricData data = fabric_data({.name = f.name});
    ASSERT_TRUE(data.unloading) << f.name;
    const double em = 2 * f.WT / (f.LT * f.Fm), E = green(em);
    EXPECT_NEAR(nominal(data.unloading->warp, em), f.Fm * gf_per_cm, 1e-10 * f.Fm) << f.name;
    EXPECT_NEAR(nominal(data.loading.warp, em), f.Fm * gf_per_cm, 1e-10 * f.Fm) << f.name;
    const double lost = data.loading.warp.at(E).energy - data.unloading->warp.at(E).energy, WT = f.WT * gf_per_cm;
    EXPECT_NEAR(lost, (1 - f.RT / 100) * WT, 1e-10 * WT) << f.name;
    for (const double share : {0.1, 0.5, 0.9})
      EXPECT_LT(nominal(data.unloading->weft, share * em), nominal(data.loading.weft, share * em)) << f.name;
    EXPECT_LE(data.unloading->coupling, data.unloading->warp.smallest_stiffness())
        << f.name << ": the energy is convex";
  }
  const FabricData n = fabric_data({.name = "N85L15"});
  EXPECT_NEAR((n.loading.warp.at(green(0.4326)).energy - n.unloading->warp.at(green(0.4326)).energy) / gf_per_cm, 2.716,
              5e-4);
}

TEST(Hysteresis, StretchedFurtherThanItsTestClothIsOnTheWayUpAgain) {
  // Beyond (EMT, Fm) the way back has the slope of the way up, and nowhere is it above it; force and energy go on
  // without a jump.
  for (const Printed& f : wear_trial) {
    const FabricData data = fabric_data({.name = f.name});
    const TensionCurve &up = data.loading.warp, &back = data.unloading->warp;
    const double end = green(2 * f.WT / (f.LT * f.Fm));
    for (const double E : {0.05, 0.1, 0.2, 0.9 * end, 1.1 * end, 2.0 * end, 3.0})
      EXPECT_LE(back.at(E).force, up.at(E).force * (1 + 1e-12)) << f.name << " E = " << E;
    EXPECT_NEAR(back.at(2 * end).force, up.at(2 * end).force, 1e-9 * f.Fm) << f.name;
    EXPECT_EQ(back.at(2 * end).stiffness, up.at(2 * end).stiffness) << f.name;
    for (const double E : {end - 1e-9, end + 1e-9}) {
      EXPECT_NEAR(back.at(E).force, back.at(end).force, 1e-6 * f.Fm) << f.name;
      EXPECT_NEAR(back.at(E).energy, back.at(end).energy, 1e-6 * f.Fm) << f.name;
    }
    EXPECT_GE(up.at(2 * end).stiffness, back.smallest_stiffness()) << f.name;
  }
}

TEST(Hysteresis, ABranchIsWhatIsAskedForAndNothingElseChanges) {
  // Loading is the fabric as it ever was, to the last bit; unloading has the same shear, bending and weight.
  const std::string plain =
      R"toml({ law = "kes", LT = 0.8, WT = "9 gf cm/cm2", EMT = 26, G = "0.5 gf/(cm degree)", B = "0.03 gf cm2/cm", weight = "200 g/m2")toml";
  const Fabric before = find_fabric(inline_table(plain + " }"));
  const MaterialEntry with = inline_table(
      plain +
      R"(, RT = "60 %", 2HG = "1.6 gf/cm", 2HG5 = "1.8 gf/cm", 2HB = "0.04 gf cm/cm", LC = 0.4, WC = "0.2 gf cm/cm2", RC = 50, MMD = 0.01, SMD = "3 um" })");
  const Fabric loading = find_fabric(with), unloading = find_fabric(with, FabricBranch::unloading);
  for (const double E : {-0.1, 0.0, 0.05, 0.2, 0.31, 0.8}) {
    EXPECT_EQ(loading.warp.at(E).force, before.warp.at(E).force);
    EXPECT_EQ(loading.warp.at(E).energy, before.warp.at(E).energy);
  }
  EXPECT_EQ(loading.coupling, before.coupling);
  EXPECT_EQ(unloading.shear, before.shear);
  EXPECT_EQ(unloading.bending.warp, before.bending.warp);
  EXPECT_EQ(unloading.areal_density, before.areal_density);
  EXPECT_LT(nominal(unloading.warp, 0.13), 0.8 * nominal(loading.warp, 0.13));
  // Written out it reads back with its data.
  const FabricData again =
      fabric_data({.name = {}, .table = materials::written_out_fabric(with), .where = {"echo.toml", 1, 1}});
  EXPECT_EQ(again.unloading->warp.at(0.1).force, unloading.warp.at(0.1).force);
  EXPECT_NEAR(*again.sheet.hysteresis.wide_shear, 1.8 * gf_per_cm, 1e-15);
  EXPECT_NEAR(*again.sheet.SMD, 3e-6, 1e-20);
}

TEST(Hysteresis, WhatWasNotMeasuredIsNoBranch) {
  // No RT, none of the weft, a law without one: refused where the fabric stands, with the way out.
  const auto error = [](const std::string& text) {
    return fault([&] { find_fabric(inline_table(text), FabricBranch::unloading); });
  };
  const std::string kes = R"toml(law = "kes", LT = 0.8, WT = "9 gf cm/cm2", EMT = 26, G = "0.5 gf/(cm degree)")toml";
  EXPECT_NE(
      error("{ " + kes + " }").find("case.toml:7:12: error: the fabric own values has no unloading curve; give its RT"),
      std::string::npos)
      << error("{ " + kes + " }");
  EXPECT_NE(error("{ " + kes + R"(, RT = 60, weft = { LT = 0.9, WT = "9 gf cm/cm2", EMT = 26 } })")
                .find("has no unloading curve"),
            std::string::npos);
  EXPECT_EQ(error("{ " + kes + R"(, RT = 60, weft = { LT = 0.9, WT = "9 gf cm/cm2", EMT = 26, RT = 55 } })"), "");
  EXPECT_NE(
      error(R"({ law = "linear", warp = "100 N/m", weft = "100 N/m", shear = "30 N/m" })").find("or leave branch out"),
      std::string::npos);
  EXPECT_NE(error("{ " + kes + ", RT = 5 }").find("LT RT/100, is 0.04; it must be at least 0.1"), std::string::npos)
      << error("{ " + kes + ", RT = 5 }");
  EXPECT_NE(error("{ " + kes + ", RT = 120 }").find("RT is 120 %"), std::string::npos);
}

/// e and F of a cycle to 20 % and back to a remaining elongation of 3 %.
std::vector<CurvePoint> cycle() {
  std::vector<CurvePoint> points;
  for (int k = 0; k <= 20; ++k) points.push_back({0.01 * k, 100 * (0.01 * k) + 1000 * std::pow(0.01 * k, 2)});
  for (int k = 16; k >= 0; --k) points.push_back({0.03 + 0.17 * k / 17, 60 * std::pow(k / 17.0, 3)});
  return points;
}

TEST(Hysteresis, TheRowsBackToRestAreTheUnloadingCurve) {
  // Through the rows of the way back, up to where the loading ended; below a hundredth of the force straight to 0.
  const std::vector<CurvePoint> points = cycle();
  const auto back = materials::unloading_curve_through(points);
  ASSERT_TRUE(back);
  EXPECT_NEAR(nominal(*back, 0.2), 60.0, 1e-10);
  for (int k = 5; k <= 16; ++k)
    EXPECT_NEAR(nominal(*back, 0.03 + 0.17 * k / 17), 60 * std::pow(k / 17.0, 3), 1e-10) << k;
  EXPECT_GT(back->smallest_stiffness(), 0.0);
  EXPECT_NEAR(nominal(materials::curve_through(points, {}), 0.12), 26.4, 1e-10)
      << "the way up is as without a way back";
  EXPECT_FALSE(materials::unloading_curve_through({points.begin(), points.begin() + 30}))
      << "stops at 13 % of the force";
  EXPECT_FALSE(materials::unloading_curve_through({points.begin(), points.begin() + 21}));
  // Its knots give the same curves.
  const std::vector<CurvePoint> knots = materials::knots_of(points, {});
  for (const double e : {0.01, 0.05, 0.117, 0.19}) {
    EXPECT_EQ(nominal(*materials::unloading_curve_through(knots), e), nominal(*back, e));
    EXPECT_EQ(nominal(materials::curve_through(knots, {}), e), nominal(materials::curve_through(points, {}), e));
  }
}

TEST(Hysteresis, SeveralCyclesAreNoCurve) {
  // Two cycles in one table: refused with the turn; noise of the elongation is none.
  std::vector<CurvePoint> points = cycle();
  const std::vector<CurvePoint> once = points;
  points.insert(points.end(), once.begin(), once.end());
  points[once.size() + 20].force += 1.0;
  EXPECT_NE(fault([&] {
              materials::curve_through(points, {"strip.csv", 0, 0});
            }).find("strip.csv: error: the elongation goes back from 20 % to"),
            std::string::npos);
  points = once;
  points[10].strain -= 0.008;
  EXPECT_EQ(fault([&] { materials::curve_through(points, {}); }), "");
}

TEST(Hysteresis, TheLoopOfShearIsAsWideAsPrinted) {
  // At 0.5 and 5 degrees, between them straight, outside constant: half of it each way.
  const auto sheet = fabric_data({.name = "N85L15"}).sheet;
  constexpr double degree = M_PI / 180;
  EXPECT_NEAR(2 * sheet.hysteresis.half_shear(0.5 * degree), 1.57 * gf_per_cm, 1e-12);
  EXPECT_NEAR(2 * sheet.hysteresis.half_shear(-5 * degree), 1.70 * gf_per_cm, 1e-12);
  EXPECT_NEAR(2 * sheet.hysteresis.half_shear(2.75 * degree), 1.635 * gf_per_cm, 1e-12);
  EXPECT_NEAR(2 * sheet.hysteresis.half_shear(0.0), 1.57 * gf_per_cm, 1e-12);
  EXPECT_EQ(materials::Hysteresis{}.half_shear(0.1), 0.0);
  EXPECT_NEAR(*sheet.hysteresis.bending, 0.04 * 9.80665e-3, 1e-15);
}

TEST(Compression, ThicknessUnderPressureHasTheWorkOfItsTest) {
  // N85L15 loses 2 * 0.12/(0.51 * 50) cm = 0.094 mm at 50 gf/cm2, R95C 0.36 mm with LC 0.32 (B3); WC is the area of the
  // curve.
  for (const auto& [name, decrease] : {std::pair{"N85L15", 0.0941}, std::pair{"R95C", 0.3625}}) {
    const auto sheet = fabric_data({.name = name}).sheet;
    const auto& c = sheet.compression;
    const double Pm = 50 * 98.0665, T0 = sheet.thickness;
    EXPECT_NEAR(*c.decrease(), 1e-3 * decrease, 1e-7) << name;
    EXPECT_NEAR(*materials::thickness_under(0.0, c, T0), T0, 1e-15);
    EXPECT_NEAR(*materials::thickness_under(Pm, c, T0), T0 - *c.decrease(), 1e-15);
    double work = 0.0;  // integral of P dT = integral of (T(P) - Tm) dP
    constexpr int n = 20000;
    for (int k = 0; k < n; ++k)
      work += (*materials::thickness_under((k + 0.5) / n * Pm, c, T0) - (T0 - *c.decrease())) * Pm / n;
    EXPECT_NEAR(work, *c.WC, 1e-6 * *c.WC) << name;
    EXPECT_FALSE(materials::thickness_under(1.01 * Pm, c, T0)) << "nothing was measured there";
  }
  materials::Compression misprint{.LC = 0.032, .WC = 0.29 * gf_per_cm};
  EXPECT_NEAR(*misprint.decrease(), 3.625e-3, 1e-7);
  EXPECT_FALSE(materials::thickness_under(1000.0, misprint, 1.10e-3));
  const materials::Compression measured{.LC = 1.0, .T0 = 1e-3, .Tm = 0.6e-3};
  EXPECT_NEAR(*materials::thickness_under(25 * 98.0665, measured, 0.0), 0.8e-3, 1e-15);
}

}  // namespace
}  // namespace snug::testing
