// Bodies of other girths.
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <filesystem>
#include <numbers>

#include "cases/input/standard_body.hpp"
#include "mesh/body/scan_surface.hpp"
#include "mesh/surface/morph.hpp"
#include "tests/unit/mesh/scanned_shapes.hpp"

namespace snug::mesh {
namespace {

using std::numbers::pi;

const std::filesystem::path bodies = std::filesystem::path(SNUG_SOURCE_DIR) / "mesh/data/bodies";

double radius_at(const TriangleSurface& tube, double z) {
  double sum = 0.0;
  int count = 0;
  for (const auto& x : tube.vertices)
    if (std::abs(x.z() - z) < 1e-3 && x.head<2>().norm() > 0.01) sum += x.head<2>().norm(), ++count;
  return sum / count;
}

// Two sections of a tube of 50 mm get girths that are 12 % larger and 6 % smaller; heights stay, and between them it goes over without a bump.
TEST(Morph, SectionsGetTheirGirthsAndWhatLiesBetweenFollows) {
  const TriangleSurface before = tests::tube({});
  TriangleSurface tube = before;
  const double girth = 2.0 * 120 * 0.05 * std::sin(pi / 120);
  std::vector<Ring> rings(2);
  rings[0].name = "low", rings[0].point = {0.004, 0.0, 0.1013}, rings[0].factor = rings[0].asked.emplace(1.12 * girth) / girth;
  rings[1].name = "high", rings[1].point = {0.0, -0.003, 0.3013}, rings[1].factor = rings[1].asked.emplace(0.94 * girth) / girth;
  const std::vector<RingGirth> girths = morph(tube, rings);
  ASSERT_EQ(girths.size(), 2u);
  for (const RingGirth& one : girths) {
    EXPECT_NEAR(one.was, girth, 1e-6);
    EXPECT_NEAR(one.is, *one.asked, 1e-5) << one.name;
  }
  for (std::size_t v = 0; v < tube.vertices.size(); ++v) EXPECT_NEAR(tube.vertices[v].z(), before.vertices[v].z(), 1e-9);
  double last = radius_at(tube, 0.11);
  EXPECT_NEAR(last, 0.056, 5e-4);
  for (double z = 0.12; z < 0.295; z += 0.005) {
    const double next = radius_at(tube, z);
    EXPECT_LT(next, last + 1e-6) << z;
    last = next;
  }
}

TEST(Morph, WhatLiesBeyondAnEndKeepsItsShape) {
  const TriangleSurface before = tests::tube({});
  TriangleSurface tube = before;
  Ring ring;
  ring.name = "wrist", ring.point = {0.0, 0.0, 0.3013}, ring.factor = 1.3, ring.shift = {0.02, 0.0, 0.0}, ring.end = true;
  Ring root = ring;
  root.name = "arm", root.point.z() = 0.1013, root.end = false;
  morph(tube, {ring, root});
  for (std::size_t v = 0; v < tube.vertices.size(); ++v)
    if (before.vertices[v].z() > 0.335) EXPECT_LT((tube.vertices[v] - before.vertices[v] - ring.shift).norm(), 1e-9);
}

input::BodySpec standard(const std::string& body, double stature, const std::vector<std::pair<std::string, double>>& girths) {
  const input::StandardBody read = input::read_standard_body(bodies, body);
  input::BodySpec spec;
  spec.scan.emplace();
  spec.scan->surface = read.surface, spec.scan->unit = 1.0;
  std::vector<input::GirthSpec> asked;
  for (const auto& [at, length] : girths) asked.push_back({at, length, {}});
  input::Diagnostics diagnostics;
  spec.scan->morph = input::body_morph(read, asked, stature, {}, diagnostics);
  diagnostics.throw_if_any();
  spec.locations = read.locations;
  for (auto& location : spec.locations) location.where_there = true;
  return spec;
}

double signed_volume(const TriangleSurface& s) {
  double volume = 0.0;
  for (const auto& t : s.triangles) volume += s.vertices[t[0]].dot(s.vertices[t[1]].cross(s.vertices[t[2]])) / 6.0;
  return volume;
}

/// Of how many triangles the normal turns by more than a right angle.
int turned(const TriangleSurface& a, const TriangleSurface& b) {
  const auto normal = [](const TriangleSurface& s, const std::array<int, 3>& t) -> Eigen::Vector3d {
    return (s.vertices[t[1]] - s.vertices[t[0]]).cross(s.vertices[t[2]] - s.vertices[t[0]]);
  };
  return static_cast<int>(std::count_if(a.triangles.begin(), a.triangles.end(), [&](const auto& t) { return normal(a, t).dot(normal(b, t)) < 0.0; }));
}

// A woman of larger, and one of smaller girths, and a tall man: what is asked comes out within half a millimetre, both sides stay mirror images, no part turns
// over, soles and crown keep their heights, and the locations go with the skin.
TEST(Morph, AStandardBodyGetsStatureAndGirths) {
  struct Person {
    std::string body;
    double stature;
    std::vector<std::pair<std::string, double>> girths;
  };
  for (const Person& person : {Person{"woman", 1.605, {{"bust", 0.98}, {"waist", 0.82}, {"hips", 1.08}, {"thigh", 0.62}, {"knee", 0.38}, {"calf", 0.39}, {"ankle", 0.23}, {"upper arm", 0.30}}},
                               Person{"woman", 1.55, {{"waist", 0.60}, {"seat", 0.86}}}, Person{"man", 1.90, {{"waist", 0.95}, {"calf", 0.40}}}}) {
    const input::BodySpec plain = standard(person.body, person.stature, {}), spec = standard(person.body, person.stature, person.girths);
    const ScanSurface before = read_scan_surface(*plain.scan, {}), after = read_scan_surface(*spec.scan, {});
    int asked = 0;
    for (const std::string& said : after.said) {
      double is = 0.0, wanted = 0.0;
      const auto at = said.find(": ");
      if (std::sscanf(said.c_str() + at, ": %lf mm, asked %lf", &is, &wanted) != 2) continue;
      ++asked;
      EXPECT_NEAR(is, wanted, 0.5) << said;
    }
    EXPECT_GE(asked, static_cast<int>(person.girths.size()));
    EXPECT_EQ(turned(before.surface, after.surface), 0);
    EXPECT_GT(signed_volume(after.surface), 0.02);
    const auto top = [](const TriangleSurface& s) { return std::max_element(s.vertices.begin(), s.vertices.end(), [](auto& a, auto& b) { return a.z() < b.z(); })->z(); };
    EXPECT_NEAR(top(after.surface), top(before.surface), 1e-6);
    Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = low;
    for (const auto& x : after.surface.vertices) low = low.cwiseMin(x), high = high.cwiseMax(x);
    EXPECT_NEAR(low.x(), -high.x(), 1e-3);
    const auto to_nearest = [](const input::LocationSpec& location, const TriangleSurface& surface) {
      const Eigen::Vector3d at((*location.at)[0], (*location.at)[1], (*location.at)[2]);
      double off = 1.0;
      for (const auto& x : surface.vertices) off = std::min(off, (x - at).norm());
      return off;
    };
    const auto own = on_skin(plain.locations, before), moved = on_skin(spec.locations, after);
    for (std::size_t l = 0; l < own.size(); ++l) EXPECT_LT(to_nearest(moved[l], after.surface), to_nearest(own[l], before.surface) + 0.002) << own[l].name;
  }
}

}  // namespace
}  // namespace snug::mesh
