#include "postproc/skin_pressure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <random>

namespace snug::postproc {
namespace {

struct Patch {
  std::vector<Eigen::Vector3d> nodes;
  std::vector<std::array<int, 9>> facets;
};

/// n x n facets over the unit square, bent into a shallow dome.
Patch patch(int n, double height = 0.0) {
  Patch result;
  const int side = 2 * n + 1;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const double x = double(i) / (side - 1), y = double(j) / (side - 1);
      result.nodes.emplace_back(x, y, height * x * (1 - x) * y * (1 - y));
    }
  for (int b = 0; b < n; ++b)
    for (int a = 0; a < n; ++a) {
      std::array<int, 9> facet;
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) facet[3 * j + i] = (2 * b + j) * side + 2 * a + i;
      result.facets.push_back(facet);
    }
  return result;
}

using Pressure = std::function<double(double, double)>;

/// Samples of a flat patch on an irregular garment: points at random places of the cells of an m x m grid over the
/// facet, pressure at each, for the part of the square with x < hem.
std::vector<ContactSample> samples_of(int n, int m, const Pressure& pressure, double hem = 2.0, double jitter = 1.0) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-0.5 * jitter, 0.5 * jitter);
  std::vector<ContactSample> samples;
  for (int f = 0; f < n * n; ++f)
    for (int c = 0; c < m * m; ++c) {
      ContactSample sample;
      sample.facet = f;
      sample.xi = -1 + 2 * (c % m + 0.5 + place(random)) / m;
      sample.eta = -1 + 2 * (c / m + 0.5 + place(random)) / m;
      const double x = (f % n + (sample.xi + 1) / 2) / n, y = (f / n + (sample.eta + 1) / 2) / n;
      if (x > hem) continue;
      sample.area = 1.0 / (n * n * m * m);
      sample.force = pressure(x, y) * sample.area;
      sample.touching = sample.force > 0;
      samples.push_back(sample);
    }
  return samples;
}

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

double total_force(const std::vector<ContactSample>& samples) {
  double sum = 0.0;
  for (const auto& sample : samples) sum += sample.force;
  return sum;
}

TEST(SkinPressure, NodalAreasSumToTheAreaOfTheDeformedSurface) {
  // A sheared and stretched flat patch has the area 2 * 3; corner, edge and centre shares are 1/16, 1/8 and 1/4 of a
  // facet.
  Patch one = patch(1);
  for (auto& x : one.nodes) x = {2 * x.x() + 0.7 * x.y(), 3 * x.y(), 0};
  const auto areas = nodal_areas(one.facets, one.nodes.size(), one.nodes);
  EXPECT_NEAR(total(areas), 6.0, 1e-12);
  EXPECT_NEAR(areas[0], 6.0 / 16, 1e-12);
  EXPECT_NEAR(areas[1], 6.0 / 8, 1e-12);
  EXPECT_NEAR(areas[4], 6.0 / 4, 1e-12);
}

TEST(SkinPressure, UniformPressureIsExactOnIrregularSamplesAndPartialCover) {
  // Whatever the samples and wherever the hem runs, 2000 Pa come back as 2000 Pa at every covered node.
  const Patch skin = patch(6);
  for (double hem : {2.0, 0.55, 0.34, 0.501})
    for (int sweeps : {0, 1, 2, 5}) {
      const auto samples = samples_of(
          6, 4, [](double, double) { return 2000.0; }, hem);
      const auto result = transfer(skin.facets, skin.nodes.size(), skin.nodes, samples, sweeps);
      for (std::size_t n = 0; n < skin.nodes.size(); ++n) {
        if (result.coverage[n] >= 0.05)
          EXPECT_NEAR(result.pressure[n], 2000.0, 1e-6);
        else
          EXPECT_EQ(result.pressure[n], 0.0);
      }
    }
}

TEST(SkinPressure, NodalForcesAndCoveredAreasConserveTheSamples) {
  // The sum of the nodal forces is the sum of the point forces, also where the hem cuts facets; so is the area.
  const Patch skin = patch(5, 0.2);
  const auto samples = samples_of(
      5, 4, [](double x, double y) { return 900 + 800 * std::sin(5 * x) * y; }, 0.47);
  const auto result = transfer(skin.facets, skin.nodes.size(), skin.nodes, samples);
  EXPECT_NEAR(total(result.force), total_force(samples), 1e-12 * total_force(samples));
  double area = 0.0;
  for (const auto& sample : samples) area += sample.area;
  EXPECT_NEAR(total(result.area), area, 1e-12);
  EXPECT_LT(std::abs(result.lost_force), 0.02 * total_force(samples));
}

TEST(SkinPressure, FullCoverLosesNoForceInTheSweeps) {
  // Inside full cover the returned pressure carries the whole force, with and without sweeps.
  const Patch skin = patch(6);
  const auto samples = samples_of(
      6, 4, [](double x, double y) { return 1000 + 300 * x + 200 * y; }, 2.0, 0.5);
  for (int sweeps : {0, 2}) {
    const auto result = transfer(skin.facets, skin.nodes.size(), skin.nodes, samples, sweeps);
    EXPECT_LT(std::abs(result.lost_force), 1e-3 * total_force(samples)) << sweeps;
  }
}

double rms_error(int n, int sweeps, double jitter) {
  const Pressure smooth = [](double x, double y) { return 2000 + 600 * std::sin(4 * x) * std::cos(3 * y); };
  const Patch skin = patch(n);
  const auto result =
      transfer(skin.facets, skin.nodes.size(), skin.nodes, samples_of(n, 4, smooth, 2.0, jitter), sweeps);
  double squares = 0.0;
  for (std::size_t k = 0; k < skin.nodes.size(); ++k)
    squares += std::pow(result.pressure[k] / smooth(skin.nodes[k].x(), skin.nodes[k].y()) - 1, 2);
  return std::sqrt(squares / skin.nodes.size());
}

TEST(SkinPressure, SweepsTowardsTheConsistentMassImproveASmoothField) {
  // Two sweeps halve the error of a smooth pressure, on regular and on irregular samples, and thirty reach the
  // consistent solution; the error falls with the square of the facet size.
  for (double jitter : {0.0, 0.7}) {
    EXPECT_LT(rms_error(6, 1, jitter), 0.7 * rms_error(6, 0, jitter));
    EXPECT_LT(rms_error(6, 2, jitter), 0.55 * rms_error(6, 0, jitter));
    EXPECT_LT(rms_error(6, 30, jitter), 0.05 * rms_error(6, 0, jitter));
    EXPECT_LT(rms_error(12, 2, jitter), 0.4 * rms_error(6, 2, jitter));
  }
}

TEST(SkinPressure, SweepsStayBoundedOnAHemThatCutsFacets) {
  // However the hem cuts, no nodal pressure leaves the neighbourhood of the applied 1000 to 1500 Pa, even after many
  // sweeps.
  const Patch skin = patch(6);
  for (double hem = 0.3; hem < 0.7; hem += 0.0137) {
    const auto samples = samples_of(
        6, 4, [](double x, double) { return 1000 + 500 * x; }, hem);
    const auto result = transfer(skin.facets, skin.nodes.size(), skin.nodes, samples, 20);
    for (std::size_t n = 0; n < skin.nodes.size(); ++n) {
      if (result.coverage[n] < 0.05) continue;
      EXPECT_GT(result.pressure[n], 800) << hem;
      EXPECT_LT(result.pressure[n], 1700) << hem;
    }
  }
}

TEST(SkinPressure, NoNodeIsPulled) {
  // Cloth pushes or does nothing: where a pressure that ends within its cover makes the sweeps swing below zero, the answer is zero,
  // and the force that goes with it is named.
  const Patch skin = patch(6);
  const auto samples = samples_of(6, 4, [](double x, double) { return x < 0.45 ? 3000.0 : 0.0; });
  const auto result = transfer(skin.facets, skin.nodes.size(), skin.nodes, samples, 5);
  for (const double pressure : result.pressure) EXPECT_GE(pressure, 0.0);
  EXPECT_LT(result.lost_force, -1e-3 * total_force(samples));
}

TEST(SkinShear, ObeysTheSamplesBoundAndIsExactWhereTheyMobiliseFrictionEvenly) {
  // Steep pressure, hem across the facets: where every sample slips one way, the nodes carry mu p that way; where samples
  // stick or slip differently, no node exceeds mu p.
  const Patch skin = patch(6);
  const double mu = 0.3;
  auto samples = samples_of(6, 4, [](double x, double y) { return 1e3 * std::exp(4.0 * x - 3.0 * y); }, 0.55);
  for (auto& sample : samples) sample.shear = {mu * sample.force, 0.0, 0.0}, sample.slips = true;
  const auto normal = transfer(skin.facets, skin.nodes.size(), skin.nodes, samples);
  const auto even = transfer_shear(skin.facets, normal, samples);
  for (std::size_t n = 0; n < skin.nodes.size(); ++n) {
    EXPECT_NEAR(even.traction[n].x(), mu * normal.pressure[n], 1e-12 * normal.pressure[n]);
    EXPECT_EQ(even.slip[n], normal.pressure[n] > 0.0 ? 2.0 : 0.0);
  }
  for (std::size_t s = 0; s < samples.size(); ++s)
    samples[s].shear = mu * samples[s].force * Eigen::Vector3d(std::sin(s), std::cos(s), 0.0) * (s % 3) / 2.0;
  const auto mixed = transfer_shear(skin.facets, normal, samples);
  for (std::size_t n = 0; n < skin.nodes.size(); ++n)
    EXPECT_LE(mixed.traction[n].norm(), (1.0 + 1e-12) * mu * normal.pressure[n]);
}

TEST(SkinShear, ANodeSlipsWithTheMajorityOfItsCover) {
  // On one facet whose points slip where x < 0.6: the nodes at x = 0 and in the middle, three fifths of whose cover slips, slip, and
  // those at x = 1 stick.
  const Patch skin = patch(1);
  auto samples = samples_of(1, 20, [](double, double) { return 1000.0; }, 2.0, 0.0);
  for (auto& sample : samples) sample.slips = sample.xi < 0.2;
  const auto shear = transfer_shear(skin.facets, transfer(skin.facets, skin.nodes.size(), skin.nodes, samples), samples);
  for (std::size_t n = 0; n < skin.nodes.size(); ++n) EXPECT_EQ(shear.slip[n], skin.nodes[n].x() < 0.75 ? 2.0 : 1.0) << n;
}

TEST(SkinPressure, ForceWithoutAFacetIsReportedAsLost) {
  // A sample that faces no skin gives nothing to the nodes, and its force is named.
  const Patch skin = patch(2);
  ContactSample stray;
  stray.force = 0.25;
  const auto result = transfer(skin.facets, skin.nodes.size(), skin.nodes, {stray});
  EXPECT_DOUBLE_EQ(result.lost_force, 0.25);
  EXPECT_DOUBLE_EQ(total(result.pressure), 0.0);
  EXPECT_DOUBLE_EQ(total(result.coverage), 0.0);
}

}  // namespace
}  // namespace snug::postproc
