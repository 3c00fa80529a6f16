#include "postproc/hem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "postproc/evaluate.hpp"
#include "postproc/skin_pressure.hpp"

namespace snug::postproc {
namespace {

constexpr double radius = 0.08, low = 0.05, high = 0.21;  ///< m; the sleeve covers low to high of a tube of 0.26 m
constexpr double slope = 2000.0, bottom = 100.0;            ///< Pa/m, Pa: the pressure rises along the tube

double pressure_at(double z) { return bottom + slope * (z - low); }

Eigen::Vector3d on_tube(double turn, double z) {
  const double angle = 2.0 * std::numbers::pi * turn;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// A tube of `around` x `along` biquadratic facets.
BodyResult tube(int around, int along) {
  constexpr double height = 0.26;
  BodyResult body;
  for (int j = 0; j <= 2 * along; ++j)
    for (int i = 0; i < 2 * around; ++i) body.nodes.push_back(on_tube(0.5 * i / around, height * j / (2 * along)));
  for (int b = 0; b < along; ++b)
    for (int a = 0; a < around; ++a) {
      std::array<int, 9> facet;
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) facet[3 * j + i] = (2 * b + j) * 2 * around + (2 * a + i) % (2 * around);
      body.skin_facets.push_back(facet);
    }
  body.fields.set(field::displacement, std::vector<Eigen::Vector3d>(body.nodes.size(), Eigen::Vector3d::Zero()));
  body.locations = {"all", "the top"};
  for (const auto& x : body.nodes) body.node_location.push_back(x.z() > high - 0.012 ? 1 : 0);
  return body;
}

/// The sleeve on it: pressure everywhere and, at its upper edge, a line load (N/m) on the last row of points. The points are
/// `fine` to a facet each way.
RunResult worn(int around, int along, int fine, double line_load) {
  RunResult run;
  run.body = tube(around, along);
  constexpr double height = 0.26;
  const double cell = height / along;
  for (int f = 0; f < around * along; ++f)
    for (int c = 0; c < fine * fine; ++c) {
      ContactSample s;
      s.xi = -1.0 + (2.0 * (c % fine) + 1.0) / fine, s.eta = -1.0 + (2.0 * (c / fine) + 1.0) / fine;
      const double z = (f / around + 0.5 * (s.eta + 1.0)) * cell;
      if (z < low || z > high) continue;
      s.facet = f, s.at = on_tube((f % around + 0.5 * (s.xi + 1.0)) / around, z);
      const double width = 2.0 * std::numbers::pi * radius / (around * fine);  // of a point round the tube
      s.area = width * cell / fine;
      s.force = pressure_at(z) * s.area;
      if (z > high - cell / fine) s.force += line_load * width;
      s.touching = true;
      run.samples.push_back(s);
    }
  auto& garment = run.garment;
  const auto edge = [&](const char* name, double z) {
    GarmentEdge edge{name, {}};
    const int first = static_cast<int>(garment.current.size()), n = 8 * around;
    for (int i = 0; i < n; ++i) garment.current.push_back(on_tube(double(i) / n, z));
    for (int i = 0; i < n; i += 2) edge.sides.push_back({first + i, first + i + 1, first + (i + 2) % n});
    garment.edges.push_back(edge);
  };
  edge("lower", low), edge("upper", high);
  garment.current.push_back(on_tube(0.0, 0.5 * (low + high)));  // farthest from both
  const SkinPressure all = transfer(run.body.skin_facets, run.body.nodes.size(), run.body.nodes, run.samples);
  run.body.fields.set(field::contact_pressure, all.pressure), run.body.fields.set(field::coverage, all.coverage);
  return run;
}

double cell_of(int around, int along) { return 0.5 * (2.0 * std::numbers::pi * radius / around + 0.26 / along); }

// A line load of 5 N/m at one edge is told apart from a pressure that rises towards it: 5 N/m there and none at the other edge,
// to a hundredth, whatever the mesh; the force within reach is both together.
TEST(Hems, TheLineLoadIsWhatThePressureDoesNotExplain) {
  for (const int around : {16, 24, 36, 48}) {
    RunResult run = worn(around, around / 2, 8, 5.0);
    keep_hems_apart(cell_of(around, around / 2), run);
    ASSERT_EQ(run.hems.size(), 2u);
    EXPECT_NEAR(run.hems[0].line_load, 0.0, 0.05) << around;
    EXPECT_NEAR(run.hems[1].line_load, 5.0, 0.05) << around;
    EXPECT_NEAR(run.hems[1].length, 2.0 * std::numbers::pi * radius, 1e-3) << around;
    const double reach = run.hems[1].reach, mean = pressure_at(high - 0.5 * reach);
    EXPECT_NEAR(run.hems[1].force / run.hems[1].length, 5.0 + mean * reach, 0.15 * mean * reach) << around;
  }
}

// Other cloth goes on beyond an edge that lies on it, with less pressure: a step is no line load.
TEST(Hems, AnEdgeOnOtherClothHasPressureOnBothSides) {
  for (const double line_load : {0.0, 4.0}) {
    RunResult run = worn(36, 18, 8, 0.0);
    constexpr double middle = 0.26 * 9 / 18;  // between two rows of facets
    auto& garment = run.garment;
    GarmentEdge band{"band, upper", {}};
    const int first = static_cast<int>(garment.current.size()), n = 2 * 36;
    for (int i = 0; i < n; ++i) garment.current.push_back(on_tube(double(i) / n, middle));
    garment.current.push_back(on_tube(0.0, middle - 0.06));
    for (int i = 0; i < n; i += 2) {
      band.sides.push_back({first + i, first + i + 1, first + (i + 2) % n});
      garment.current.push_back(on_tube(double(i + 1) / n, middle - 0.01));
      garment.triangles.push_back({first + i, first + (i + 2) % n, static_cast<int>(garment.current.size()) - 1, first + i + 1, first, first});
    }
    garment.edges.push_back(band);
    const double row = 0.26 / 18 / 8;
    for (ContactSample& s : run.samples)
      if (s.at.z() < middle) s.force += 700.0 * s.area + (s.at.z() > middle - row ? line_load / row * s.area : 0.0);
    keep_hems_apart(cell_of(36, 18), run);
    EXPECT_NEAR(run.hems[2].line_load, line_load, 0.1);
  }
}

// The largest pressure beside the hems does not know of a line load, whose peak in the complete field is what the mesh makes of
// it; it is the pressure at the strip's border, which stands still from 24 cells round on.
TEST(Hems, TheLargestPressureBesideThemDoesNotFollowTheMesh) {
  double low_peak = 1e9, high_peak = 0.0;
  for (const int around : {24, 36, 48}) {
    RunResult run = worn(around, around / 2, 8, 2.0);
    const double inside = keep_hems_apart(cell_of(around, around / 2), run);
    const double largest = *std::max_element(run.body.fields[field::contact_pressure].begin(), run.body.fields[field::contact_pressure].end());
    EXPECT_GT(largest, 1.5 * pressure_at(high)) << around;
    low_peak = std::min(low_peak, largest), high_peak = std::max(high_peak, largest);
    const double border = pressure_at(high - 2.0 * std::numbers::pi * radius / 24.0);
    EXPECT_NEAR(inside, border, 0.04 * border) << around;
  }
  EXPECT_GT(high_peak, 1.5 * low_peak);
}

// A strip is one cell wide where cells are coarse, a 24th of the edge's length where they are fine, and leaves half of the depth of a
// garment that is narrower than that.
TEST(Hems, TheStripIsACellOrAFixedShareOfTheEdge) {
  const double girth = 2.0 * std::numbers::pi * radius;
  for (const auto& [cell, strip] : {std::pair{0.030, 0.030}, {0.005, girth / 24.0}, {0.100, 0.25 * (high - low)}}) {
    RunResult run = worn(24, 12, 4, 0.0);
    keep_hems_apart(cell, run);
    EXPECT_NEAR(run.hems[0].strip, strip, 1e-3 * strip) << cell;
  }
}

// Every point within the strip is the edge's, also where the strip is wider than a cell, and none beside it.
TEST(Hems, PointsWithinTheStripAreTheEdges) {
  RunResult run = worn(24, 12, 4, 0.0);
  keep_hems_apart(0.005, run);
  ASSERT_GT(run.hems[0].strip, 2.0 * run.hems[0].reach);
  int in_strip = 0;
  for (const ContactSample& sample : run.samples) {
    const double from_lower = sample.at.z() - low, from_upper = high - sample.at.z();
    EXPECT_EQ(sample.hem, from_lower < run.hems[0].strip ? 0 : from_upper < run.hems[1].strip ? 1 : -1);
    in_strip += sample.hem >= 0;
  }
  EXPECT_GT(in_strip, 0);
}

// Pressures of a location are those beside the hems, and say so; where all of its cover is a hem they are the hem's, and say that.
TEST(Hems, LocationsLeaveThemOut) {
  RunResult run = worn(24, 12, 8, 50.0);
  keep_hems_apart(cell_of(24, 12), run);
  run.body.fields[field::coverage].assign(run.body.nodes.size(), 0.0);
  for (std::size_t n = 0; n < run.body.nodes.size(); ++n) {
    const double z = run.body.nodes[n].z();
    if (z < low || z > high) continue;
    run.body.fields[field::coverage][n] = 1.0;
    run.body.fields[field::contact_pressure][n] = z > high - 0.02 ? 5000.0 : pressure_at(z);
    run.body.fields[field::pressure_inside][n] = run.body.fields[field::hem][n] == 1.0 ? 0.0 : run.body.fields[field::contact_pressure][n];
  }
  run.body.fields[field::largest_inside] = run.body.fields[field::pressure_inside];
  const Evaluation evaluation = evaluate(run, std::nullopt);
  EXPECT_EQ(evaluation.locations[0].pressures_of, "cover beside hems");
  EXPECT_LT(evaluation.locations[0].max_pressure, pressure_at(high));
  EXPECT_NEAR(evaluation.locations[0].mean_pressure, pressure_at(0.5 * (low + high)), 10.0);
  EXPECT_EQ(evaluation.locations[1].pressures_of, "hem");
  double row = high, force = 0.0, area = 0.0;  // the second location: all of its nodes from this height on, and less and less of the row of cells below
  for (const auto& x : run.body.nodes)
    if (x.z() > high - 0.012) row = std::min(row, x.z());
  constexpr double between = 0.26 / 24;  // two nodes to a cell
  for (const ContactSample& sample : run.samples) {
    const double share = std::clamp((sample.at.z() - row) / between + 1.0, 0.0, 1.0);
    force += share * sample.force, area += share * sample.area;
  }
  EXPECT_GT(force / area, 2.0 * pressure_at(high));
  EXPECT_NEAR(evaluation.locations[1].mean_pressure, force / area, 1e-3 * force / area);
}

// The largest pressure of a run is that of one of its locations, where these cover it: one rule for both.
TEST(Hems, TheLargestPressureIsThatOfALocation) {
  RunResult run = worn(24, 12, 8, 50.0);
  const double largest = keep_hems_apart(cell_of(24, 12), run);
  run.body.fields[field::coverage].assign(run.body.nodes.size(), 1.0);
  double of_locations = 0.0;
  for (const LocationRow& row : evaluate(run, std::nullopt).locations)
    if (row.pressures_of != "hem") of_locations = std::max(of_locations, row.max_pressure);
  EXPECT_GT(largest, *std::max_element(run.body.fields[field::pressure_inside].begin(), run.body.fields[field::pressure_inside].end()));
  EXPECT_EQ(of_locations, largest);
  run.body.fields[field::coverage].assign(run.body.nodes.size(), 0.0);  // a location that the garment does not cover bears nothing
  for (const LocationRow& row : evaluate(run, std::nullopt).locations) EXPECT_EQ(row.max_pressure, 0.0) << row.name;
}

// Without contact nothing is marked, and a garment without named edges keeps all of its pressure.
TEST(Hems, WithoutContactOrEdgesNothingIsLeftOut) {
  RunResult run = worn(24, 12, 4, 5.0);
  RunResult bare = run;
  bare.samples.clear();
  keep_hems_apart(0.01, bare);
  EXPECT_TRUE(bare.hems.empty() && !bare.body.fields.has(field::hem) && !bare.body.fields.has(field::pressure_inside));
  run.garment.edges.clear();
  keep_hems_apart(0.01, run);
  EXPECT_TRUE(run.hems.empty());
  EXPECT_EQ(*std::max_element(run.body.fields[field::hem].begin(), run.body.fields[field::hem].end()), 0.0);
  EXPECT_EQ(run.body.fields[field::pressure_inside], run.body.fields[field::contact_pressure]);
}

}  // namespace
}  // namespace snug::postproc
