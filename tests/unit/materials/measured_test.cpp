// Fabrics from the sheets of tests: strip curves, FAST, stresses with a thickness, percentages.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "cases/input/reader.hpp"
#include "materials/fabric/fabric.hpp"
#include "materials/fabric/measured.hpp"
#include "tests/unit/materials/measured_fabrics.hpp"

namespace snug::testing {
namespace {

using input::InputError, input::MaterialEntry;
using materials::CurvePoint, materials::Fabric, materials::find_fabric, materials::TensionCurve;

TEST(MeasuredCurve, GoesThroughItsPointsRisesAndIsItsOwnIntegral) {
  // F and S = F/(1 + e) at the points; between them monotone; energy and stiffness are integral and slope of the force.
  const std::vector<double> strain = {0, 0.04, 0.15, 0.31, 0.6}, force = {0, 3, 14, 40, 120};
  const TensionCurve curve = TensionCurve::through(strain, force);
  for (std::size_t k = 0; k < strain.size(); ++k) EXPECT_NEAR(nominal(curve, strain[k]), force[k], 1e-12);
  double before = 0.0;
  for (double e = 0.002; e < 0.6; e += 0.002) {
    EXPECT_GT(nominal(curve, e), before) << e;
    before = nominal(curve, e);
    const double E = green(e), h = 1e-6;
    EXPECT_NEAR((curve.at(E + h).energy - curve.at(E - h).energy) / (2 * h), curve.at(E).force, 1e-6 * 120) << e;
    EXPECT_NEAR((curve.at(E + h).force - curve.at(E - h).force) / (2 * h), curve.at(E).stiffness, 3e-4 * 400) << e;
  }
  // A plateau, over which the force per current width falls, ends the data as with every curve (fabric.hpp).
  EXPECT_LT(TensionCurve::through({0, 0.1, 0.3, 0.5}, {0, 20, 20.5, 80}).data_end(), green(0.3));
  const TensionCurve straight = TensionCurve::through({0, 0.1, 0.2, 0.5}, {0, 8, 16, 40});
  EXPECT_NEAR(nominal(straight, 0.333), 80 * 0.333, 1e-12);
  EXPECT_THROW(TensionCurve::through({0, 0.1, 0.2}, {0, 8, 8}), std::invalid_argument);
  EXPECT_THROW(TensionCurve::through({0.1, 0.2}, {1, 8}), std::invalid_argument);
}

TEST(MeasuredCurve, NoiseUnloadingAndPretensionAreTakenOut) {
  // 800 samples of F = 60 e + 200 e^3 with noise of 1 %, loading to 0.5 and back again below: within 2 % of the law.
  std::vector<CurvePoint> points;
  unsigned state = 7;
  const auto noise = [&] { return (state = state * 1664525u + 1013904223u, static_cast<double>(state >> 8) / (1 << 24) - 0.5); };
  const auto law = [](double e) { return 60 * e + 200 * e * e * e; };
  for (int i = 0; i <= 800; ++i) points.push_back({0.5 * i / 800, std::max(0.0, law(0.5 * i / 800) + 1.1 * noise())});
  for (int i = 799; i > 400; --i) points.push_back({0.5 * i / 800, 0.6 * law(0.5 * i / 800)});
  const TensionCurve curve = materials::curve_through(points, {});
  for (const double e : {0.1, 0.2, 0.3, 0.4, 0.49}) EXPECT_NEAR(nominal(curve, e), law(e), 0.02 * law(0.5)) << e;
  // A machine that begins at a pretension of 2 N/m: the force counts from there.
  EXPECT_NEAR(nominal(materials::curve_through({{0, 2}, {0.1, 7}, {0.2, 12}}, {}), 0.1), 5.0, 1e-12);
  EXPECT_NE(fault([] { materials::curve_through({{0, 1}, {0.1, 1}}, {"strip.csv", 0, 0}); }).find("does not rise"), std::string::npos);
}

TEST(MeasuredCurve, ASecondCycleBehindTheFirstIsRefused) {
  // It would be left out without a word; one way back, with slack at its end, is none.
  const std::vector<CurvePoint> one = {{0, 0}, {0.2, 8}, {0.4, 30}, {0.3, 12}, {0.1, 1}, {0.02, 0}, {0, 0}};
  EXPECT_NO_THROW(materials::curve_through(one, {}));
  std::vector<CurvePoint> two = one;
  two.insert(two.end(), {{0.2, 7}, {0.4, 29}});
  EXPECT_NE(fault([&] { materials::curve_through(two, {"strip.csv", 0, 0}); }).find("strip.csv: error: behind the largest force the elongation falls to 0 % and rises to 20 % again"), std::string::npos)
      << fault([&] { materials::curve_through(two, {"strip.csv", 0, 0}); });
}

TEST(MeasuredFabric, WhatASheetContradictsIsRefusedAtItsPlace) {
  // The law itself knows no place.
  EXPECT_NE(fault([] { find_fabric(inline_table(R"({ law = "fast", E5 = 5, E20 = 3, E100 = 9, EB5 = 4 })")); }).find(".toml"), std::string::npos)
      << fault([] { find_fabric(inline_table(R"({ law = "fast", E5 = 5, E20 = 3, E100 = 9, EB5 = 4 })")); });
}

TEST(MeasuredFabric, AStripTestIsReadFromATableOfTheCase) {
  // Force of a strip of 25 mm over extension of 80 mm, and force per width over strain in percent with decimal commas: both curves.
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("snug-strip-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "a.csv") << "Time (s),Extension (mm),Load (N)\n0,0,0\n1,8,0.5\n2,16,1.5\n3,32,6\n";
  std::ofstream(folder / "b.csv") << "Elongation [%];Force [cN/cm]\n0;0\n10;15\n20;35,5\n";
  const std::string text = R"({ law = "curve", warp = "a.csv", weft = "b.csv", width = "25 mm", gauge_length = "80 mm", shear = "40 N/m", weight = "190 gsm" })";
  const Fabric fabric = find_fabric(inline_table(text, folder));
  EXPECT_NEAR(nominal(fabric.warp, 0.2), 60.0, 1e-12);
  EXPECT_NEAR(nominal(fabric.warp, 0.4), 240.0, 1e-11);
  EXPECT_NEAR(nominal(fabric.weft, 0.2), 35.5, 1e-12);
  EXPECT_NEAR(fabric.areal_density, 0.19, 1e-15);
  // Written out it needs its files no more.
  const input::Table written = materials::written_out_fabric(inline_table(text, folder));
  const Fabric again = find_fabric({.name = {}, .table = written, .where = {"echo.toml", 1, 1}});
  EXPECT_NEAR(nominal(again.warp, 0.3), nominal(fabric.warp, 0.3), 1e-12);
  std::string narrow = text;
  narrow.erase(narrow.find("width = \"25 mm\", "), 17);
  EXPECT_NE(fault([&] { find_fabric(inline_table(narrow, folder)); }).find("a.csv:1:25: error: Load is a force here; add width"), std::string::npos)
      << fault([&] { find_fabric(inline_table(narrow, folder)); });
  EXPECT_NE(fault([&] { find_fabric(inline_table(R"({ law = "curve", warp = "../a.csv", weft = "b.csv", shear = "40 N/m" })", folder)); }).find("outside"), std::string::npos);
  EXPECT_NE(fault([&] { find_fabric(inline_table(R"({ law = "curve", warp = "a.csv", width = "25 mm", gauge_length = "80 mm", shear = "40 N/m" })", folder)); }).find("the curve of the weft is missing"),
            std::string::npos);
  fs::remove_all(folder);
}

TEST(MeasuredFabric, AFastSheetIsAFabric) {
  // Extensions at 5, 20 and 100 gf/cm; G = 123/EB5 N/m (SiroFAST); B in micronewton metres.
  const Fabric fabric = find_fabric(inline_table(R"({ law = "fast", E5 = "0.4 %", E20 = 1.5, E100 = "4.2 %", weft = { E100 = "8 %" }, EB5 = "3 %", B = "7.5 uN m", weight = "210 g/m2" })"));
  EXPECT_NEAR(nominal(fabric.warp, 0.004), 5 * gf_per_cm, 1e-12);
  EXPECT_NEAR(nominal(fabric.warp, 0.015), 20 * gf_per_cm, 1e-12);
  EXPECT_NEAR(nominal(fabric.warp, 0.042), 100 * gf_per_cm, 1e-11);
  EXPECT_NEAR(nominal(fabric.weft, 0.04), 50 * gf_per_cm, 1e-11);
  EXPECT_NEAR(fabric.shear, 41.0, 1e-12);
  EXPECT_NEAR(fabric.bending.warp, 7.5e-6, 1e-18);
  EXPECT_NE(fault([] { find_fabric(inline_table(R"({ law = "fast", E100 = 4 })")); }).find("neither EB5 nor G"), std::string::npos);
}

TEST(MeasuredFabric, StressesTimesTheThicknessAreForcesPerWidth) {
  // 1.5 MPa of a cloth of 0.6 mm is 900 N/m; without its thickness a stress is none.
  const Fabric fabric = find_fabric(inline_table(R"({ law = "linear", warp = "1.5 MPa", weft = "400 N/m", shear = "0.2 N/mm2", thickness = "0.6 mm" })"));
  EXPECT_NEAR(fabric.warp.at(0.0).stiffness, 900.0, 1e-9);
  EXPECT_NEAR(fabric.weft.at(0.0).stiffness, 400.0, 1e-12);
  EXPECT_NEAR(fabric.shear, 120.0, 1e-9);
  EXPECT_NE(fault([] { find_fabric(inline_table(R"({ law = "linear", warp = "1.5 MPa", weft = "400 N/m", shear = "30 N/m" })")); }).find("is a stress; give the thickness"), std::string::npos);
}

TEST(MeasuredFabric, PercentagesHaveASignOrNone) {
  // EMT = 26 and EMT = "26 %" are the same; a shear stiffness without an angle is refused in a KES sheet.
  const auto kes = [](const std::string& emt, const std::string& G) {
    return find_fabric(inline_table("{ law = \"kes\", LT = 0.8, WT = \"9 gf.cm/cm^2\", EMT = " + emt + ", G = \"" + G + "\" }"));
  };
  EXPECT_EQ(kes("26", "0.5 gf/cm.deg").warp.at(0.2).force, kes("\"26 %\"", "0.5 gf/(cm degree)").warp.at(0.2).force);
  EXPECT_NEAR(kes("26", "0.5 gf/cm.deg").shear, 0.5 * 56.18796562, 1e-6);
  EXPECT_NE(fault([&] { kes("26", "28 N/m"); }).find("not a force per length and angle"), std::string::npos);
}

}  // namespace
}  // namespace snug::testing
