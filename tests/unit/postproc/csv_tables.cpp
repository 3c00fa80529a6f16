// The tables that a run writes for people: angle and height of the skin's nodes, and every style of separators read back.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/input/csv.hpp"
#include "postproc/csv_writer.hpp"
#include "postproc/recorders.hpp"
#include "postproc/skin_map.hpp"
#include "postproc/store.hpp"
#include "tests/unit/postproc/scene.hpp"

namespace snug::postproc {
namespace {

using test::fresh_folder;
using test::run_scene;
using test::text_of;

constexpr double degree = std::numbers::pi / 180.0;

using Ring = std::vector<Eigen::Vector2d>;

Ring circle(double radius, const Eigen::Vector2d& centre) {
  Ring ring;
  for (int i = 0; i < 36; ++i) ring.push_back(centre + radius * Eigen::Vector2d(std::cos(10 * degree * i), std::sin(10 * degree * i)));
  return ring;
}

/// Six places along each side of a triangle, whose area has its centroid in the mean of the corners, and whose border has it elsewhere.
Ring triangle(const std::array<Eigen::Vector2d, 3>& corners) {
  Ring ring;
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < 6; ++i) ring.push_back(corners[c] + i / 6.0 * (corners[(c + 1) % 3] - corners[c]));
  return ring;
}

/// Adds a skin of 4-node facets along a ring that moves by `lean` a metre of height.
void add_tube(const Ring& ring, const Eigen::Vector2d& lean, double from, double to, BodyResult& body) {
  constexpr int rows = 10;
  const int first = static_cast<int>(body.nodes.size()), around = static_cast<int>(ring.size());
  body.cell_nodes = 8, body.facet_nodes = 4;
  for (int j = 0; j <= rows; ++j)
    for (const Eigen::Vector2d& x : ring) {
      const double z = from + (to - from) * j / rows;
      body.nodes.emplace_back(x.x() + lean.x() * z, x.y() + lean.y() * z, z);
    }
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = first + j * around + i, b = first + j * around + (i + 1) % around;
      std::array<int, 9> facet;
      facet.fill(-1);
      facet[0] = a, facet[1] = b, facet[2] = a + around, facet[3] = b + around;
      body.skin_facets.push_back(facet);
    }
  body.node_location.assign(body.nodes.size(), -1);
  body.fields.set(field::displacement, std::vector<Eigen::Vector3d>(body.nodes.size(), Eigen::Vector3d::Zero()));
}

/// Angle (rad) and height (m) of the nodes in the table that a run with this body writes.
struct Places {
  std::vector<double> angle, height;
};
Places places_of(const BodyResult& body) {
  const auto out = fresh_folder("places");
  RunResult run = run_scene();
  run.body = body, run.garment = {};
  write_results(run, {}, out);
  input::Diagnostics diagnostics;
  const input::Csv csv = input::read_csv(out / "skin.csv", diagnostics);
  Places places{input::numbers(csv, "angle", "rad", diagnostics), input::numbers(csv, "height", "m", diagnostics)};
  EXPECT_FALSE(diagnostics.any());
  return places;
}

double apart(double a, double b) { return std::abs(std::remainder(a - b, 2.0 * std::numbers::pi)); }

TEST(SkinTable, AnglesCountRoundTheMiddleOfALeaningLimbsSectionAsThoseOfLocations) {
  // A limb of triangular section that leans and stands off the axis: every node's angle is that about the centroid of the section's area at its height (mean of
  // the corners), from +x over +y, 0 to 360 deg; the height is z. About the axis, the middle of the border or that of all the limb it would be degrees away.
  const std::array<Eigen::Vector2d, 3> corners = {{{0.10, 0.02}, {0.22, 0.02}, {0.10, 0.10}}};
  const Eigen::Vector2d lean(0.3, -0.1), middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  BodyResult body;
  add_tube(triangle(corners), lean, 0.40, 0.70, body);
  const Places places = places_of(body);
  ASSERT_EQ(places.angle.size(), body.nodes.size());
  for (std::size_t n = 0; n < body.nodes.size(); ++n) {
    const Eigen::Vector3d& x = body.nodes[n];
    const Eigen::Vector2d arm = x.head<2>() - middle - x.z() * lean;
    EXPECT_LT(apart(places.angle[n], std::atan2(arm.y(), arm.x())), 1e-3 * degree) << n;
    EXPECT_NEAR(places.height[n], x.z(), 1e-9) << n;
    EXPECT_GE(places.angle[n], 0.0);
    EXPECT_LT(places.angle[n], 360.0 * degree);
  }
}

TEST(SkinTable, ANodeOfALegHasTheAngleRoundItsLeg) {
  // Two legs under a trunk: nodes at every angle of each leg have that angle, below the slice in which the legs meet the trunk; above it nodes have that of the trunk.
  BodyResult body;
  add_tube(circle(0.06, {-0.09, 0.01}), {-0.05, 0.0}, 0.0, 0.4, body);
  add_tube(circle(0.07, {0.09, 0.0}), {0.05, 0.02}, 0.0, 0.4, body);
  add_tube(circle(0.16, {0.0, 0.03}), {0.0, 0.0}, 0.4, 0.8, body);
  const Places places = places_of(body);
  ASSERT_EQ(places.angle.size(), body.nodes.size());
  for (std::size_t n = 0; n < body.nodes.size(); ++n)
    if (std::abs(places.height[n] - 0.4) > 0.03) EXPECT_LT(apart(places.angle[n], 10 * degree * (n % 36)), 1e-2 * degree) << n;
}

TEST(SkinTable, AFlatSkinHasNoAngle) {
  // A sector of a limb and a limb that lies along y: nothing goes round z, and no angle or height is made up.
  BodyResult lying;
  add_tube(circle(0.05, {0.0, 0.0}), {0.0, 0.0}, 0.0, 0.4, lying);
  for (Eigen::Vector3d& x : lying.nodes) x = Eigen::Vector3d(x.x(), x.z(), x.y());
  for (const BodyResult& body : {lying, test::body_scene()}) {
    const auto out = fresh_folder("flat");
    RunResult run = run_scene();
    run.body = body;
    write_results(run, {}, out);
    const std::string text = text_of(out / "skin.csv");
    EXPECT_EQ(text.substr(0, text.find('\n')).find("angle"), std::string::npos) << text.substr(0, 200);
  }
}

/// A run with all tables and names that hold separators, decimal commas and quotes.
RunResult awkward() {
  RunResult run = run_scene();
  run.body.locations = {"Front; \"upper\", left", "1,5"};
  run.tools = {{.name = "a\tb;c", .surface = "skin", .shape = "ball of radius 5 mm", .history = {{.travel = 1.5e-3, .depth = 1e-7, .force = 1234.567}, {.travel = 4e-3, .force = -2.5}}}};
  run.movement = {{.posture = "dressed, 1;2", .bones = {{"shank", 0.5, {}}, {"thigh", 0.1, {}}}, .contact_area = 0.02, .mean_pressure = 900.25, .max_pressure = 1200.0}};
  return run;
}

TEST(CsvStyles, EveryTableReadsBackAlike) {
  // Each table for people, in each style, gives our reader the texts and, to the last digit, the numbers of the default; head and separators are those asked for.
  const RunResult run = awkward();
  const Evaluation evaluation = evaluate(run, std::nullopt);
  const auto plain = fresh_folder("csv-comma"), other = fresh_folder("csv-other");
  write_results(run, evaluation, stored_run(run, evaluation, {}, plain), plain);
  for (const auto& [style, separator] : {std::pair{CsvStyle::semicolon, ';'}, std::pair{CsvStyle::tab, '\t'}}) {
    write_results(run, evaluation, stored_run(run, evaluation, {}, other), other, style);
    for (const std::string file : {"skin.csv", "locations.csv", "comfort.csv", "tool.csv"}) {
      SCOPED_TRACE(file + " " + input::text_of(style));
      input::Diagnostics diagnostics;
      const input::Csv expected = input::read_csv(plain / file, diagnostics), read = input::read_csv(other / file, diagnostics);
      EXPECT_EQ(read.separator, separator);
      if (style == CsvStyle::semicolon) EXPECT_TRUE(read.decimal_comma);
      ASSERT_EQ(read.columns.size(), expected.columns.size());
      ASSERT_EQ(read.rows.size(), expected.rows.size());
      for (std::size_t c = 0; c < read.columns.size(); ++c) {
        EXPECT_EQ(read.columns[c].name, expected.columns[c].name);
        EXPECT_EQ(read.columns[c].unit, expected.columns[c].unit);
        input::Diagnostics texts;
        const std::vector<double> numbers = input::column_numbers(expected, c, texts);
        if (!texts.any())
          EXPECT_EQ(input::column_numbers(read, c, diagnostics), numbers) << read.columns[c].name;
        else
          for (std::size_t r = 0; r < read.rows.size(); ++r) EXPECT_EQ(read.rows[r].cells[c], expected.rows[r].cells[c]);
      }
      EXPECT_FALSE(diagnostics.any());
    }
    EXPECT_EQ(text_of(other / "history.csv"), text_of(plain / "history.csv"));  // for programs
  }
}

TEST(CsvStyles, SemicolonsHaveDecimalCommasAndTabsHavePoints) {
  // The rows of a tool, written by hand.
  const auto out = fresh_folder("csv-rows");
  const RunResult run = awkward();
  const StoredRun stored = stored_run(run, {}, {}, out);
  write_results(run, {}, stored, out, CsvStyle::semicolon);
  EXPECT_THAT(text_of(out / "tool.csv"), testing::HasSubstr("\n\"a\tb;c\";0,0015;1e-07;1234,567;0;0;0;0\n"));
  write_results(run, {}, stored, out, CsvStyle::tab);
  EXPECT_THAT(text_of(out / "tool.csv"), testing::HasSubstr("\n\"a\tb;c\"\t0.0015\t1e-07\t1234.567\t0\t0\t0\t0\n"));
}

TEST(CsvStyles, WhatReadsADirectoryReadsEveryStyle) {
  // The skin's nodes and the map that a study measures are the same of each style.
  const RunResult run = run_scene();
  const Evaluation evaluation = evaluate(run, std::nullopt);
  for (const CsvStyle style : {CsvStyle::comma, CsvStyle::semicolon, CsvStyle::tab}) {
    SCOPED_TRACE(input::text_of(style));
    const auto out = fresh_folder("csv-read");
    const StoredRun stored = stored_run(run, evaluation, {}, out);
    write_results(run, evaluation, stored, out, style);
    EXPECT_EQ(read_run(out).skin_nodes, stored.skin_nodes);
    EXPECT_EQ(read_run(out).history.size(), 2u);
    const SkinMap map = read_skin_map(out / "skin.csv");
    ASSERT_EQ(map.pressure.size(), 15u);
    EXPECT_EQ(map.pressure[0], 300.0);
    EXPECT_NEAR(map.displacement[2].x(), 0.032, 1e-12);
  }
}

}  // namespace
}  // namespace snug::postproc
