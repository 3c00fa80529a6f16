#include "mesh/particles/particle_sheet.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/mesh/tensile_curves.hpp"

namespace snug::mesh {

namespace {

using tests::linear, tests::exponential, tests::most_tension, tests::most_strain, tests::curvature;
using Eigen::Vector3d;
using Places = std::vector<Vector3d>;

SheetLaws cloth(double stiffness = 500.0) {
  return {.warp = linear(stiffness),
          .weft = linear(0.7 * stiffness),
          .shear = 30.0,
          .bending_warp = 1e-4,
          .bending_weft = 5e-5,
          .density = 0.2,
          .drag = 0.0};
}

/// A flat sheet in the plane z = 0.
Places flat(const SheetGrid& grid) {
  Places places;
  for (int j = 0; j < grid.along_weft; ++j)
    for (int i = 0; i < grid.along_warp; ++i) places.emplace_back(i * grid.spacing_warp, j * grid.spacing_weft, 0.0);
  return places;
}

}  // namespace

TEST(ParticleSheet, AFallingParticleComesToItsTerminalVelocity) {
  // m a + c v = m g from rest: v = m g/c (1 - exp(-c t/m)). Implicit Euler is of first order.
  SheetLaws laws = cloth();
  laws.drag = 0.6;
  const SheetGrid grid{1, 1, 0.02, 0.02};
  const auto error_at = [&](double dt) {
    ParticleSheet sheet(grid, laws, {Vector3d::Zero()}, {false});
    const double m = sheet.mass(0), c = sheet.drag(0), time = 0.4;
    for (int n = 0; n < std::lround(time / dt); ++n) sheet.step(dt);
    return std::abs(-sheet.velocities()[0].z() - m * laws.gravity / c * (1.0 - std::exp(-c * time / m)));
  };
  EXPECT_NEAR(error_at(0.02) / error_at(0.01), 2.0, 0.1);
  EXPECT_LT(error_at(0.001), 2e-3);
  ParticleSheet sheet(grid, laws, {Vector3d::Zero()}, {false});
  for (int n = 0; n < 200; ++n) sheet.step(0.1);
  EXPECT_NEAR(-sheet.velocities()[0].z(), laws.density * laws.gravity / laws.drag, 1e-9);
}

TEST(ParticleSheet, AHangingChainIsACatenary) {
  // Ends as high as each other and `apart`, length L: 2 a sinh(apart/(2 a)) = L, sag a (cosh(apart/(2 a)) - 1).
  constexpr int count = 81;
  constexpr double length = 1.0, apart = 0.7;
  SheetLaws laws = cloth(2e4);
  laws.bending_warp = laws.bending_weft = 0.0;
  laws.drag = 2.0;
  const SheetGrid grid{count, 1, length / (count - 1), 0.01};
  Places places;  // let go from a V of its own length
  const double deep = std::sqrt(0.25 * length * length - 0.25 * apart * apart);
  for (int i = 0; i < count; ++i) {
    const double t = 2.0 * i / (count - 1) - 1.0;
    places.emplace_back(0.5 * apart * t, 0.0, -deep * (1.0 - std::abs(t)));
  }
  std::vector<bool> held(count, false);
  held.front() = held.back() = true;
  ParticleSheet chain(grid, laws, places, held);
  for (const double dt : {0.01, 0.02, 0.05, 0.1, 0.5, 1.0, 10.0, 100.0, 1000.0, 1e4})
    for (int n = 0; n < 4; ++n) chain.step(dt);
  double low = 0.1, high = 10.0;
  for (int n = 0; n < 100; ++n) {
    const double a = 0.5 * (low + high);
    (2.0 * a * std::sinh(apart / (2.0 * a)) > length ? low : high) = a;
  }
  const double sag = low * (std::cosh(apart / (2.0 * low)) - 1.0);
  EXPECT_NEAR(-chain.places()[count / 2].z(), sag, 1e-3 * sag);
  for (int i = 0; i < count; ++i) {
    const Vector3d& p = chain.places()[i];
    EXPECT_NEAR(p.z(), low * (std::cosh(p.x() / low) - 1.0) - sag, 1e-3 * sag) << i;
  }
}

TEST(ParticleSheet, APulledStripLiesOnItsTensileCurve) {
  // Pulled along warp by F: stretch where T = F/width, whatever the other laws.
  SheetLaws laws = cloth();
  laws.warp = exponential();
  laws.gravity = 0.0;
  laws.drag = 1.0;
  const SheetGrid grid{11, 4, 0.01, 0.01};
  for (const double tension : {20.0, 150.0, 450.0}) {
    std::vector<bool> held(44, false);
    for (int j = 0; j < 4; ++j) held[11 * j] = true;
    ParticleSheet strip(grid, laws, flat(grid), held);
    for (int j = 0; j < 4; ++j) strip.pull(11 * j + 10, {tension * (j == 0 || j == 3 ? 0.005 : 0.01), 0, 0});
    for (const double dt : {0.01, 1.0, 100.0, 1e4, 1e6, 1e8}) strip.step(dt);
    const double strain = most_strain / curvature * std::log1p(tension / most_tension * std::expm1(curvature));
    for (int j = 0; j < 4; ++j) EXPECT_NEAR(strip.places()[11 * j + 10].x() / 0.1 - 1.0, strain, 1e-6) << tension;
  }
}

TEST(ParticleSheet, EnergyNeverGrows) {
  const SheetGrid grid{9, 7, 0.02, 0.02};
  std::vector<bool> held(63, false);
  held[0] = held[8] = true;
  ParticleSheet sheet(grid, cloth(), flat(grid), held);
  double before = sheet.potential_energy() + sheet.kinetic_energy(), first = before;
  for (int n = 0; n < 40; ++n) {
    sheet.step(0.01);
    const double now = sheet.potential_energy() + sheet.kinetic_energy();
    EXPECT_LE(now, before + 1e-9 * std::abs(first - now) + 1e-12) << n;
    before = now;
  }
  EXPECT_LT(before, first - 1e-3);
}

TEST(ParticleSheet, ForcesAreTheSlopeOfTheEnergy) {
  // Central differences approach the forces of all kinds together with the square of the step.
  const SheetGrid grid{4, 3, 0.02, 0.03};
  const Repulsion floor{[](const Vector3d& p) { return Nearness{p.z() + 0.05, Vector3d::UnitZ()}; }, 2e4, 0.06};
  Places places = flat(grid), direction;
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (Vector3d& p : places) {
    p += 0.002 * Vector3d(normal(random), normal(random), normal(random));
    direction.emplace_back(normal(random), normal(random), normal(random));
  }
  const auto at = [&](double step) {
    Places moved = places;
    for (std::size_t n = 0; n < moved.size(); ++n) moved[n] += step * direction[n];
    return ParticleSheet(grid, cloth(), moved, std::vector<bool>(12, false), floor);
  };
  const auto slope = [&](double step) {
    return (at(step).potential_energy() - at(-step).potential_energy()) / (2.0 * step);
  };
  double force = 0.0;
  for (const SheetForce kind : {SheetForce::stretch, SheetForce::trellis, SheetForce::bend, SheetForce::twist,
                                SheetForce::repulsion, SheetForce::gravity}) {
    const Places forces = at(0.0).forces(kind);
    double largest = 0.0;
    for (std::size_t n = 0; n < places.size(); ++n)
      force += forces[n].dot(direction[n]), largest = std::max(largest, forces[n].norm());
    EXPECT_GT(largest, 0.0);  // every kind takes part
  }
  const double coarse = std::abs(slope(2e-4) + force), fine = std::abs(slope(1e-4) + force);
  EXPECT_NEAR(coarse / fine, 4.0, 0.3);
}

TEST(ParticleSheet, BentToACylinderItHasTheEnergyOfAPlate) {
  // B/(2 r^2) per area where the curvature is one of warp; of equal spacings and B a saddle k x y has B k^2 by its
  // twist.
  SheetLaws laws = cloth();
  laws.shear = laws.gravity = 0.0;
  laws.warp = laws.weft = linear(0.0);
  laws.bending_weft = laws.bending_warp;
  const SheetGrid grid{41, 41, 0.002, 0.002};
  Places cylinder = flat(grid), saddle = cylinder;
  for (Vector3d& p : cylinder) p = Vector3d(0.1 * std::sin(p.x() / 0.1), p.y(), 0.1 * std::cos(p.x() / 0.1));
  for (Vector3d& p : saddle) p.z() = 3.0 * p.x() * p.y();
  const std::vector<bool> free(41 * 41, false);
  const double area = 0.08 * 0.08, inner = 0.08 * 0.078;  // the rows at the ends have no neighbour
  EXPECT_NEAR(ParticleSheet(grid, laws, cylinder, free).potential_energy(), 0.5 * laws.bending_warp / 0.01 * inner,
              1e-3 * laws.bending_warp / 0.02 * area);
  EXPECT_NEAR(ParticleSheet(grid, laws, saddle, free).potential_energy(), laws.bending_warp * 9.0 * area,
              1e-9 * laws.bending_warp);
}

TEST(ParticleSheet, ASheetOnAFloorSinksByItsWeight) {
  SheetLaws laws = cloth();
  laws.drag = 5.0;
  const SheetGrid grid{5, 5, 0.02, 0.02};
  const Repulsion floor{[](const Vector3d& p) { return Nearness{p.z(), Vector3d::UnitZ()}; }, 1e3, 0.005};
  Places places = flat(grid);
  for (Vector3d& p : places) p.z() = 0.01;
  ParticleSheet sheet(grid, laws, places, std::vector<bool>(25, false), floor);
  for (const double dt : {0.01, 0.02, 0.1, 1.0, 10.0, 1e3, 1e5}) sheet.step(dt);
  for (const Vector3d& p : sheet.places()) EXPECT_NEAR(p.z(), 0.005 - laws.density * laws.gravity / 1e3, 1e-8);
}

}  // namespace snug::mesh
