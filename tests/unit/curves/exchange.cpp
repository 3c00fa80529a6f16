// Curves, surfaces and nets as JSON of ours, DXF, STEP and IGES: out and in again, and what is refused.
#include <gtest/gtest.h>

#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include "mesh/cad/cad_file.hpp"
#include "mesh/formats/json_values.hpp"
#include "tests/unit/curves/random_curves.hpp"
#include "tests/verification/book.hpp"

namespace snug::mesh {
namespace {

namespace fs = std::filesystem;
using curves::BForm;
using curves::BSplineCurve;
using curves::BSplineSurface;
using curves::MultiIndices;
using curves::Net;
using testing::Random;
using tests::book;

/// Curves of degree 2 to 6, clamped or not, surfaces, nets and a Bézier triangle.
CurveSet random_set(unsigned seed) {
  Random random(seed);
  CurveSet set;
  for (int degree = 2; degree <= 6; ++degree) {
    set.curves.push_back({fmt::format("curve {}", degree), curves::b_spline_of(random.curve(degree, degree % 2 + 2))});
    BSplineCurve spline{degree, {}, random.matrix(3, degree + 4), random.weights(degree + 4)};
    spline.knots.assign(degree + 1, 0.0);
    spline.knots.insert(spline.knots.end(), {0.3, 0.5, 0.9});
    spline.knots.resize(2 * degree + 5, 1.0);
    set.curves.push_back({"spline \"" + std::to_string(degree) + "\"", spline});
    const Eigen::Matrix3Xd points = random.matrix(3, (degree + 1) * 3);
    set.surfaces.push_back({"surface", curves::b_spline_of(curves::WSurface(random.knots(degree), random.knots(2),
                                                                            points, random.weights(3 * degree + 3)))});
  }
  set.nets.push_back({"net", Net{3, 4, false, true, random.matrix(3, 12)}});
  set.forms.push_back({"triangle", BForm(3, 3, random.matrix(3, 10))});
  return set;
}

double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const Eigen::Index rows = std::max(a.rows(), b.rows());
  Eigen::MatrixXd difference = Eigen::MatrixXd::Zero(rows, a.cols());  // a coordinate that is not there is 0
  if (a.cols() != b.cols()) return std::numeric_limits<double>::infinity();
  difference.topRows(a.rows()) += a;
  difference.topRows(b.rows()) -= b;
  return difference.cwiseAbs().maxCoeff();
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = a.size() == b.size() ? 0.0 : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; worst < 1.0 && i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst;
}

/// Largest difference of a control point, weight or knot.
double distance(const BSplineCurve& a, const BSplineCurve& b) {
  return std::max({a.degree == b.degree ? 0.0 : 1.0, distance(a.knots, b.knots), distance(a.points, b.points),
                   distance(a.weights, b.weights)});
}
double distance(const BSplineSurface& a, const BSplineSurface& b) {
  return std::max({a.degrees == b.degrees ? 0.0 : 1.0, distance(a.knots[0], b.knots[0]),
                   distance(a.knots[1], b.knots[1]), distance(a.points, b.points), distance(a.weights, b.weights)});
}

TEST(CurveJson, IsReadBackToTheLastBit) {
  const CurveSet set = random_set(71), back = parse_curve_json(curve_json(set), "text");
  ASSERT_EQ(back.curves.size(), set.curves.size());
  for (std::size_t i = 0; i < set.curves.size(); ++i) {
    EXPECT_EQ(back.curves[i].name, set.curves[i].name);
    EXPECT_EQ(distance(back.curves[i].shape, set.curves[i].shape), 0.0);
  }
  ASSERT_EQ(back.surfaces.size(), set.surfaces.size());
  for (std::size_t i = 0; i < set.surfaces.size(); ++i)
    EXPECT_EQ(distance(back.surfaces[i].shape, set.surfaces[i].shape), 0.0);
  ASSERT_EQ(back.nets.size(), 1u);
  EXPECT_EQ(back.nets[0].shape.points, set.nets[0].shape.points);
  EXPECT_EQ(back.nets[0].shape.rows, 3);
  EXPECT_FALSE(back.nets[0].shape.rows_closed);
  EXPECT_TRUE(back.nets[0].shape.columns_closed);
  ASSERT_EQ(back.forms.size(), 1u);
  EXPECT_EQ(back.forms[0].shape.coefficients(), set.forms[0].shape.coefficients());
}

TEST(CurveJson, NegativeZeroKeepsItsSign) {
  CurveSet set = random_set(75);
  set.curves[0].shape.points(0, 0) = -0.0;
  EXPECT_TRUE(std::signbit(parse_curve_json(curve_json(set), "text").curves[0].shape.points(0, 0)));
}

TEST(CurveJson, TakesUnitsAndWhatIsLeftOut) {
  const CurveSet set = parse_curve_json(R"({"format": "snug curves", "unit": "1 mm",
    "curves": [{"degree": 2, "points": [[0, 0], [10, 0], [10, 1e1]]}]})",
                                        "text");
  ASSERT_EQ(set.curves.size(), 1u);
  EXPECT_EQ(set.curves[0].name, "");
  EXPECT_DOUBLE_EQ(set.curves[0].shape.points(0, 1), 0.01);
  EXPECT_EQ(set.curves[0].shape.weights, Eigen::Vector3d::Ones());
  EXPECT_LE((set.curves[0].shape.point(0.5) - Eigen::Vector2d(0.0075, 0.0025)).norm(), 1e-17);
}

void refused(const std::string& text, const std::vector<std::string>& parts) {
  try {
    parse_curve_json(text, "a.json");
    ADD_FAILURE() << "taken: " << text;
  } catch (const input::InputError& error) {
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what() << "\nlacks " << part;
  }
}

TEST(CurveJson, WrongTextIsRefusedWithItsPlaceAndRemedy) {
  const std::string head = "{\"format\": \"snug curves\", \"unit\": \"1 m\",\n";
  refused("", {"a.json:1:1: error: no JSON"});
  refused("{\"format\": \"snug curves\",\n \"unit\" 3}", {"a.json:2:"});
  refused("[1, 2]", {"a.json:1:1: error: no file of curves; begin with"});
  refused("{\"format\": 3}", {"a.json:1:12: error: no file of curves"});
  refused("{\"format\": \"snug curves\"}", {"the unit of the lengths is missing"});
  refused("{\"format\": \"snug curves\", \"unit\": \"1 kg\"}", {"a.json:1:35: error: the unit \"1 kg\" is no length"});
  refused(head + "\"curvs\": []}", {"a.json:2:1: error: \"curvs\" is no key here; did you mean curves"});
  refused(head + "\"curves\": [{\"degree\": 2, \"degree\": 3}]}", {"a.json:2:26: error: \"degree\" is there twice"});
  refused(head + "\"curves\": 3}", {"a.json:2:11: error: \"curves\" is the bare number 3"});
  refused(head + "\"curves\": [3]}", {"a.json:2:12: error"});
  refused(head + "\"curves\": [{\"degree\": 2}]}", {"a.json:2:12: error: \"points\" is missing"});
  refused(head + "\"curves\": [{\"degree\": 2.5, \"points\": []}]}",
          {"a.json:2:23: error", "whole number from 1 to 25"});
  refused(head + "\"curves\": [{\"degree\": 1, \"points\": [[0, 0],\n  [1, \"x\"]]}]}",
          {"a.json:3:7: error: the text \"x\" where a number is due"});
  refused(head + "\"curves\": [{\"degree\": 1, \"points\": [[0, 0],\n  [1, 1, 1]]}]}",
          {"a.json:3:3: error: a point of 3 coordinates"});
  refused(head + "\"curves\": [{\"degree\": 3, \"points\": [[0, 0], [1, 1]]}]}",
          {"error: 2 points; the knots go with 4"});
  refused(head + "\"curves\": [{\"degree\": 1, \"points\": [[0, 0], [1, 1]],\n \"knots\": [0, 1, 0, 1]}]}",
          {"a.json:3:2: error: knot 2 is 0; knots never fall"});
  refused(head + "\"curves\": [{\"degree\": 1, \"points\": [[0, 0], [1, 1]], \"weights\": [1, 0]}]}",
          {"a weight is not positive"});
  refused(head + "\"surfaces\": [{\"degrees\": [1], \"points\": []}]}", {"1 degrees"});
  refused(head + "\"surfaces\": [{\"degrees\": [1, 1], \"points\": [[[0,0,0],[1,0,0]],\n [[0,0,0]]]}]}",
          {"a.json:3:2: error: a row of 1 after rows of 2"});
  refused(head +
              "\"surfaces\": [{\"degrees\": [1, 3], \"points\": [[[0,0,0],[1,0,0]],[[0,0,0],[1,0,0]], "
              "[[0,0,0],[1,0,0]],[[0,0,0],[1,0,0]]]}]}",
          {"rows of 2 points; the second knots go with 4"});
  refused(head + "\"nets\": [{\"points\": [[[0,0,0],[1,0,0]]]}]}", {"a net of 1 by 2"});
  refused(head + "\"nets\": [{\"points\": [[[0,0,0],[1,0,0]],[[0,0,0],[1,0,0]]], \"closed\": [true]}]}",
          {"two of true and false"});
  refused(head + "\"forms\": [{\"corners\": 3, \"degree\": 2, \"points\": [[0,0,0]]}]}", {"has 6 coefficients, not 1"});
  refused(std::string(100, '['), {"nested deeper than 32"});
  refused(head + "\"curves\": [{\"degree\": 1, \"points\": [[0, 1e999], [1, 1]]}]}", {"error"});
}

TEST(Dxf, SplinesAreReadBack) {
  const CurveSet set = random_set(72);
  std::string left_out;
  const CurveSet back = parse_dxf_splines(dxf_splines(set), "text", left_out);
  EXPECT_EQ(left_out, "");
  ASSERT_EQ(back.curves.size(), set.curves.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < set.curves.size(); ++i)
    worst = std::max(worst, distance(back.curves[i].shape, set.curves[i].shape));
  EXPECT_EQ(back.curves[0].name, "curve 2");
  EXPECT_EQ(back.curves[0].shape.points.rows(), 2);  // flat
  book("curves: round trips", "DXF SPLINE out and in: points (m), weights, knots", worst, 0.0, 1e-15, "itself");
}

std::string dxf(const std::string& entities, const std::string& unit = "5") {
  return "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n" + unit + "\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities +
         "0\nENDSEC\n0\nEOF\n";
}

TEST(Dxf, TakesTheUnitAndTellsWhatItLeavesOut) {
  const std::string line = "0\nLINE\n8\n0\n10\n0\n20\n0\n11\n1\n21\n1\n";
  std::string left_out;
  const std::string spline =
      "0\nSPLINE\n8\nhem\n70\n8\n71\n1\n72\n4\n73\n2\n40\n0\n40\n0\n40\n1\n40\n1\n10\n1\n20\n2\n30\n0\n10\n3\n20\n4\n30"
      "\n0\n";
  const CurveSet set = parse_dxf_splines(dxf(line + spline + line), "text", left_out);
  EXPECT_EQ(left_out, "2 LINE");
  ASSERT_EQ(set.curves.size(), 1u);
  EXPECT_EQ(set.curves[0].name, "hem");
  EXPECT_DOUBLE_EQ(set.curves[0].shape.points(1, 1), 0.04);
}

TEST(Dxf, WrongTextIsRefusedWithItsLine) {
  const auto refused_dxf = [](const std::string& text, const std::string& part) {
    std::string left_out;
    try {
      parse_dxf_splines(text, "a.dxf", left_out);
      ADD_FAILURE() << "taken: " << text;
    } catch (const input::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what() << "\nlacks " << part;
    }
  };
  refused_dxf("", "no entities");
  refused_dxf("AutoCAD Binary DXF", "a.dxf:1:1: error: \"AutoCAD Binary DXF\" is no group code");
  refused_dxf("0", "ends after a group code");
  refused_dxf(dxf("0\nLINE\n10\n0\n"), "no SPLINE among the entities (1 LINE)");
  refused_dxf(dxf("0\nSPLINE\n71\n3\n11\n0\n"), "fit points only");
  refused_dxf(dxf("0\nSPLINE\n71\n3\n20\n0\n"), "a coordinate before the point");
  refused_dxf(dxf("0\nSPLINE\n71\n3\n10\nx\n"), "a.dxf:20:1: error: \"x\" is no number");
  refused_dxf(dxf("0\nSPLINE\n71\n1\n10\n0\n"), "no curve: 0 knots");
  refused_dxf(dxf("0\nSPLINE\n71\n1.5\n"), "no whole number");
  refused_dxf(dxf("0\nLINE\n", "17"), "$INSUNITS is 17");
}

class CadFile : public ::testing::TestWithParam<std::string> {
 protected:
  ~CadFile() override { fs::remove(file_); }
  CurveSet through(const CurveSet& set) {
    std::ofstream(file_, std::ios::binary) << cad_text(set, file_);
    return read_cad_file(file_);
  }
  const fs::path file_ = fs::temp_directory_path() / ("snug-test-curves-" + std::to_string(::getpid()) + GetParam());
};

TEST_P(CadFile, IsReadBackWithItsControlPoints) {
  const CurveSet set = random_set(73), back = through(set);
  ASSERT_EQ(back.curves.size(), set.curves.size());
  ASSERT_EQ(back.surfaces.size(), set.surfaces.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < set.curves.size(); ++i)
    worst = std::max(worst, distance(back.curves[i].shape, set.curves[i].shape.clamped()));
  for (std::size_t i = 0; i < set.surfaces.size(); ++i)
    worst = std::max(worst, distance(back.surfaces[i].shape, set.surfaces[i].shape.clamped()));
  if (GetParam() == ".step") {
    EXPECT_EQ(back.curves[0].name, "curve 2");
  }
  book("curves: round trips",
       fmt::format("{} out and in by OpenCASCADE: points (m), weights, knots", GetParam().substr(1)), worst, 0.0, 1e-12,
       "itself");
}

TEST_P(CadFile, QuarterCylinderStaysExact) {
  const double h = std::numbers::sqrt2 / 2.0;
  CurveSet set;
  BSplineSurface cylinder{{2, 1}, {{{0, 0, 0, 1, 1, 1}, {0, 0, 1, 1}}}, Eigen::Matrix3Xd(3, 6), Eigen::VectorXd(6)};
  cylinder.points << 1, 1, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1, 0, 2, 0, 2, 0, 2;
  cylinder.points *= 0.05;
  cylinder.weights << 1, 1, h, h, 1, 1;
  set.surfaces.push_back({"cylinder", cylinder});
  const CurveSet back = through(set);
  ASSERT_EQ(back.surfaces.size(), 1u);
  for (int i = 0; i <= 10; ++i) EXPECT_NEAR(back.surfaces[0].shape.point(i / 10.0, 0.4).head<2>().norm(), 0.05, 1e-16);
}

TEST_P(CadFile, WhatIsNoneIsRefused) {
  std::ofstream(file_) << "no such thing\n";
  EXPECT_THROW(read_cad_file(file_), input::InputError);
  std::ofstream(file_).close();
  EXPECT_THROW(read_cad_file(file_), input::InputError);
  fs::remove(file_);
  EXPECT_THROW(read_cad_file(file_), input::InputError);
  EXPECT_THROW(cad_text(CurveSet{}, file_), input::InputError);
}

INSTANTIATE_TEST_SUITE_P(Formats, CadFile, ::testing::Values(".step", ".igs"),
                         [](const auto& one) { return one.param.substr(1); });

TEST(CurveSvg, DrawsEveryShapeInsideThePicture) {
  const std::string picture = curve_svg(random_set(74));
  for (const char* kind : {"class=\"net\"", "class=\"surface\"", "class=\"curve\""})
    EXPECT_NE(picture.find(kind), std::string::npos);
  EXPECT_EQ(picture.find("nan"), std::string::npos);
  EXPECT_NE(picture.find("</svg>"), std::string::npos);
  EXPECT_NO_THROW(curve_svg(CurveSet{}));
}

}  // namespace
}  // namespace snug::mesh
