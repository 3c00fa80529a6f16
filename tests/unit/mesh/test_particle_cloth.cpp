#include "mesh/particles/particle_cloth.hpp"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

TensileCurve linear(double stiffness) {
  return [=](double stretch) {
    return Tensile{0.5 * stiffness * (stretch - 1.0) * (stretch - 1.0), stiffness * (stretch - 1.0), stiffness};
  };
}

/// T = Tm (exp(a e / em) - 1) / (exp(a) - 1), the kind of curve that a tensile test of KES has.
constexpr double most_tension = 490.0, most_strain = 0.3, curvature = 3.0;
TensileCurve exponential() {
  return [](double stretch) {
    const double rate = curvature / most_strain, factor = most_tension / std::expm1(curvature), strain = stretch - 1.0;
    return Tensile{factor * (std::expm1(rate * strain) / rate - strain), factor * std::expm1(rate * strain), factor * rate * std::exp(rate * strain)};
  };
}

ClothLaws cloth_laws() {
  return {.warp = linear(500.0), .weft = linear(350.0), .shear = 30.0, .bending_warp = 1e-4, .bending_weft = 5e-5, .density = 0.2};
}

/// A rectangle of nx by ny cells, vertices inside moved off their grid.
struct Rectangle {
  int nx, ny;
  double length, width;
  std::vector<Vector2d> flat;
  ClothSheet sheet;

  Rectangle(int columns, int rows, double l, double w, const ClothLaws& laws, double moved = 0.1) : nx(columns), ny(rows), length(l), width(w) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> off(-moved, moved);
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) {
        const bool inside_x = i > 0 && i < nx, inside_y = j > 0 && j < ny;
        flat.emplace_back(length / nx * (i + (inside_x ? off(random) : 0.0)), width / ny * (j + (inside_y ? off(random) : 0.0)));
      }
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
        add(a, b, d), add(b, c, d);
      }
    sheet.laws = {laws};
  }
  int node(int i, int j) const { return j * (nx + 1) + i; }
  void add(int a, int b, int c) { sheet.triangles.push_back({{a, b, c}, {flat[a], flat[b], flat[c]}}); }
  Places laid(auto place) const {
    Places places;
    for (const Vector2d& x : flat) places.push_back(place(x));
    return places;
  }
  Places level(double z = 0.0) const {
    return laid([=](const Vector2d& x) { return Vector3d(x.x(), x.y(), z); });
  }
  std::vector<HeldComponents> free() const { return std::vector<HeldComponents>(flat.size(), 0); }
};

Vector3d sum(const Places& forces) {
  Vector3d total = Vector3d::Zero();
  for (const Vector3d& force : forces) total += force;
  return total;
}

/// Random ones, normally distributed about 0.
Places directions(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  Places all(count);
  for (Vector3d& one : all)
    for (double& component : one) component = normal(random);
  return all;
}

/// Long steps until hardly anything is out of balance.
void settle(ParticleCloth& cloth, int steps = 120) {
  double dt = 0.002;
  for (int n = 0; n < steps; ++n) {
    cloth.step(dt);
    double fastest = 1e-9;
    for (const Vector3d& v : cloth.velocities()) fastest = std::max(fastest, v.norm());
    dt = std::clamp(std::min(1.5 * dt, 0.003 / fastest), 1e-5, 2.0);
  }
}

}  // namespace

TEST(ParticleCloth, ForcesAreTheSlopeOfTheEnergy) {
  // Central differences approach the forces of all kinds together with the square of the step; every kind takes part.
  Rectangle patch(4, 3, 0.08, 0.07, cloth_laws());
  patch.sheet.bands = {{0, 1, 0.015, 40.0}, {1, 2, 0.015, 40.0}};
  patch.sheet.body = BodyContact{[](const Vector3d& p) { return Nearness{p.z() + 0.05, Vector3d::UnitZ()}; }, 2e4, 0.06, 0.4};
  Places places = patch.level();
  const Places off = directions(places.size(), 7), direction = directions(places.size(), 8);
  // Friction is anchored where a particle first touched; its bound and the planes are those of the last arrival.
  ParticleCloth cloth(patch.sheet, places, patch.free());
  for (std::size_t n = 0; n < places.size(); ++n) places[n] += 0.002 * off[n];
  cloth.move_to(places);
  EXPECT_EQ(cloth.kinds().size(), texts_of(ClothForce{}).size() - 1);  // all but air, which has no energy
  double force = 0.0;
  for (const ClothForce kind : cloth.kinds()) {
    const Places forces = cloth.forces(kind);
    double largest = 0.0;
    for (std::size_t n = 0; n < places.size(); ++n) force += forces[n].dot(direction[n]), largest = std::max(largest, forces[n].norm());
    EXPECT_GT(largest, 0.0) << static_cast<int>(kind);
  }
  const auto slope = [&](double step) { return cloth.energy_of(direction, step); };
  const auto error = [&](double step) { return std::abs((slope(step) - slope(-step)) / (2.0 * step) + force); };
  EXPECT_NEAR(error(2e-4) / error(1e-4), 4.0, 0.3);
  EXPECT_LT(error(1e-5), 1e-4 * std::abs(force));
}

TEST(ParticleCloth, APulledStripLiesOnItsTensileCurve) {
  // Pulled along warp or weft by a force per width: stretch where the curve has that tension, whatever the triangles.
  for (const bool along_warp : {true, false}) {
    ClothLaws laws = cloth_laws();
    (along_warp ? laws.warp : laws.weft) = exponential();
    Rectangle strip(8, 3, 0.1, 0.03, laws);
    if (!along_warp)
      for (FlatTriangle& t : strip.sheet.triangles)
        for (Vector2d& x : t.flat) x = Vector2d(-x.y(), x.x());
    strip.sheet.gravity = 0.0, strip.sheet.drag = 1.0;
    for (const double tension : {20.0, 150.0, 450.0}) {
      std::vector<HeldComponents> held = strip.free();
      for (int j = 0; j <= strip.ny; ++j) held[strip.node(0, j)] = held_all;
      ParticleCloth cloth(strip.sheet, strip.level(), held, MinimumSearch{});
      for (int j = 0; j <= strip.ny; ++j) {
        const double below = j > 0 ? strip.flat[strip.node(8, j)].y() - strip.flat[strip.node(8, j - 1)].y() : 0.0,
                     above = j < strip.ny ? strip.flat[strip.node(8, j + 1)].y() - strip.flat[strip.node(8, j)].y() : 0.0;
        cloth.pull(strip.node(8, j), {tension * 0.5 * (below + above), 0, 0});
      }
      for (const double dt : {0.01, 1.0, 100.0, 1e4, 1e6, 1e8, 1e10}) cloth.step(dt);
      const double strain = most_strain / curvature * std::log1p(tension / most_tension * std::expm1(curvature));
      for (int j = 0; j <= strip.ny; ++j) EXPECT_NEAR(cloth.places()[strip.node(8, j)].x() / 0.1 - 1.0, strain, 1e-6) << tension;
      EXPECT_NEAR(cloth.strained(5).tension[along_warp ? 0 : 1], tension, 1e-4 * tension);
    }
  }
}

TEST(ParticleCloth, AirResistsByADragTimesTheVelocityAndIsNotThereUnlessGiven) {
  // The derivative of its force by the velocities is -c A of a particle's own and nothing of others', at any places; and a
  // step answers to it: m (v - v0)/dt is the sum of all other forces and the drag that it ends with.
  Rectangle patch(4, 3, 0.08, 0.07, cloth_laws());
  const std::size_t count = patch.flat.size();
  Places places = patch.level();
  const Places off = directions(count, 3), velocities = directions(count, 4), direction = directions(count, 5);
  for (std::size_t n = 0; n < count; ++n) places[n] += 0.002 * off[n];
  ParticleCloth still(patch.sheet, places, patch.free());
  still.step(0.01);
  EXPECT_THAT(still.kinds(), testing::Not(testing::Contains(ClothForce::drag)));
  for (const Vector3d& force : still.forces(ClothForce::drag)) EXPECT_EQ(force.norm(), 0.0);

  patch.sheet.drag = 0.6;
  ParticleCloth cloth(patch.sheet, places, patch.free(), MinimumSearch{});
  EXPECT_THAT(cloth.kinds(), testing::Contains(ClothForce::drag));
  EXPECT_EQ(sum(cloth.forces(ClothForce::drag)).norm(), 0.0);  // at rest
  const auto forces_at = [&](double step) {
    Places moved = velocities;
    for (std::size_t n = 0; n < count; ++n) moved[n] += step * direction[n];
    cloth.move_to(places, moved);
    return cloth.forces(ClothForce::drag);
  };
  constexpr double step = 1e-3;
  const Places after = forces_at(step), before = forces_at(-step);
  for (int n = 0; n < static_cast<int>(count); ++n) {
    const Vector3d slope = (after[n] - before[n]) / (2.0 * step), expected = -0.6 * cloth.area(n) * direction[n];
    EXPECT_LT((slope - expected).norm(), 1e-10 * expected.norm()) << n;
  }

  forces_at(0.0);
  constexpr double dt = 0.001;
  cloth.step(dt);
  const Places total = cloth.total_forces(), drag = cloth.forces(ClothForce::drag);
  for (int n = 0; n < static_cast<int>(count); ++n) {
    const Vector3d inertia = cloth.mass(n) / dt * (cloth.velocities()[n] - velocities[n]);
    EXPECT_LT((inertia - total[n] - drag[n]).norm(), 1e-6 * drag[n].norm()) << n;
  }
}

TEST(ParticleCloth, FallingClothComesToItsTerminalVelocity) {
  // m a + c v = m g from rest: v = m g/c (1 - exp(-c t/m)), every particle alike. Implicit Euler is of first order.
  Rectangle sheet(3, 2, 0.06, 0.04, cloth_laws());
  sheet.sheet.drag = 0.6;
  const double density = cloth_laws().density, terminal = density * sheet.sheet.gravity / 0.6, time = 0.4;
  const auto error_at = [&](double dt) {
    ParticleCloth cloth(sheet.sheet, sheet.level(), sheet.free(), MinimumSearch{});
    for (int n = 0; n < std::lround(time / dt); ++n) cloth.step(dt);
    return std::abs(-cloth.velocities()[5].z() - terminal * (1.0 - std::exp(-0.6 * time / density)));
  };
  EXPECT_NEAR(error_at(0.02) / error_at(0.01), 2.0, 0.1);
  EXPECT_LT(error_at(0.001), 2e-3);
  ParticleCloth cloth(sheet.sheet, sheet.level(), sheet.free(), MinimumSearch{});
  for (int n = 0; n < 200; ++n) cloth.step(0.1);
  for (const Vector3d& v : cloth.velocities()) EXPECT_LT((v + terminal * Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_LT((sum(cloth.forces(ClothForce::drag)) + sum(cloth.forces(ClothForce::weight))).norm(), 1e-9);
}

TEST(ParticleCloth, AHangingChainIsACatenary) {
  // Ends as high as each other and `apart`, length L: 2 a sinh(apart/(2 a)) = L, sag a (cosh(apart/(2 a)) - 1).
  constexpr double length = 1.0, apart = 0.7;
  ClothLaws laws = cloth_laws();
  laws.warp = laws.weft = linear(2e4);
  laws.bending_warp = laws.bending_weft = 0.0;
  Rectangle chain(80, 1, length, 0.01, laws);
  chain.sheet.drag = 2.0;
  const double deep = std::sqrt(0.25 * length * length - 0.25 * apart * apart);  // let go from a V of its own length
  const Places places = chain.laid([&](const Vector2d& x) {
    const double t = 2.0 * x.x() / length - 1.0;
    return Vector3d(0.5 * apart * t, x.y(), -deep * (1.0 - std::abs(t)));
  });
  std::vector<HeldComponents> held = chain.free();
  for (const int end : {0, chain.nx})
    for (int j = 0; j <= 1; ++j) held[chain.node(end, j)] = held_all;
  ParticleCloth cloth(chain.sheet, places, held, MinimumSearch{});
  for (const double dt : {0.01, 0.02, 0.05, 0.1, 0.5, 1.0, 10.0, 100.0, 1000.0, 1e4})
    for (int n = 0; n < 4; ++n) cloth.step(dt);
  double low = 0.1, high = 10.0;
  for (int n = 0; n < 100; ++n) {
    const double a = 0.5 * (low + high);
    (2.0 * a * std::sinh(apart / (2.0 * a)) > length ? low : high) = a;
  }
  const double sag = low * (std::cosh(apart / (2.0 * low)) - 1.0);
  double lowest = 0.0;
  for (const Vector3d& p : cloth.places()) {
    lowest = std::min(lowest, p.z());
    EXPECT_NEAR(p.z(), low * (std::cosh(p.x() / low) - 1.0) - sag, 1e-3 * sag) << p.x();
  }
  EXPECT_NEAR(-lowest, sag, 1e-3 * sag);
}

TEST(ParticleCloth, EnergyNeverGrows) {
  // Potential and kinetic energy together, of a cloth that falls from level, held at two corners, without air.
  Rectangle sheet(8, 6, 0.16, 0.12, cloth_laws());
  std::vector<HeldComponents> held = sheet.free();
  held[sheet.node(0, 0)] = held[sheet.node(8, 0)] = held_all;
  ParticleCloth cloth(sheet.sheet, sheet.level(), held);
  double before = cloth.potential_energy() + cloth.kinetic_energy();
  const double first = before;
  for (int n = 0; n < 40; ++n) {
    cloth.step(0.01);
    const double now = cloth.potential_energy() + cloth.kinetic_energy();
    EXPECT_LE(now, before + 1e-9 * std::abs(first - now) + 1e-12) << n;
    before = now;
  }
  EXPECT_LT(before, first - 1e-3);
}

TEST(ParticleCloth, OnAFloorItSinksByItsWeight) {
  // By its weight per area over the stiffness of the floor, below where that begins to press.
  Rectangle sheet(4, 4, 0.08, 0.08, cloth_laws());
  sheet.sheet.drag = 5.0;
  sheet.sheet.body = BodyContact{[](const Vector3d& p) { return Nearness{p.z(), Vector3d::UnitZ()}; }, 1e3, 0.005};
  ParticleCloth cloth(sheet.sheet, sheet.level(0.01), sheet.free(), MinimumSearch{});
  for (const double dt : {0.01, 0.02, 0.1, 1.0, 10.0, 1e3, 1e5}) cloth.step(dt);
  for (const Vector3d& p : cloth.places()) EXPECT_NEAR(p.z(), 0.005 - cloth_laws().density * sheet.sheet.gravity / 1e3, 1e-8);
}

TEST(ParticleCloth, BentToACylinderItHasTheEnergyOfAPlateAcrossASeamToo) {
  // B/(2 r^2) per area, B of warp or weft as it is bent, but for half a cell (1.7 %) at each free edge, which bears no moment; a saddle
  // k x y has B k^2, to what triangles moved by a tenth of their cell make of it. Turned as a whole it has the same. Cut
  // in two whose flat pieces lie elsewhere, and sewn, it has what it has in one.
  ClothLaws laws = cloth_laws();
  laws.shear = 0.0, laws.warp = laws.weft = linear(0.0);
  constexpr double r = 0.1;
  const auto energy = [&](const ClothLaws& of, auto place, bool cut) {
    Rectangle sheet(30, 30, 0.08, 0.08, of);
    sheet.sheet.gravity = 0.0;
    if (cut)
      for (FlatTriangle& t : sheet.sheet.triangles)
        if ((t.flat[0] + t.flat[1] + t.flat[2]).x() > 0.12)
          for (Vector2d& x : t.flat) x += Vector2d(0.3, -0.2);
    return ParticleCloth(sheet.sheet, sheet.laid(place), sheet.free()).potential_energy();
  };
  const auto about_y = [](const Vector2d& x) { return Vector3d(r * std::sin(x.x() / r), x.y(), r * std::cos(x.x() / r)); };
  const auto about_x = [](const Vector2d& x) { return Vector3d(x.x(), r * std::sin(x.y() / r), r * std::cos(x.y() / r)); };
  const double area = 0.08 * 0.08, plate = 0.5 / (r * r) * area;
  EXPECT_NEAR(energy(laws, about_y, false), laws.bending_warp * plate, 0.04 * laws.bending_warp * plate);
  EXPECT_NEAR(energy(laws, about_x, false), laws.bending_weft * plate, 0.04 * laws.bending_weft * plate);
  EXPECT_NEAR(energy(laws, about_y, true), energy(laws, about_y, false), 1e-8 * laws.bending_warp * plate);
  laws.bending_weft = laws.bending_warp;
  const auto saddle = [](const Vector2d& x) { return Vector3d(x.x(), x.y(), 3.0 * x.x() * x.y()); };
  EXPECT_NEAR(energy(laws, saddle, false), laws.bending_warp * 9.0 * area, 0.06 * laws.bending_warp * 9.0 * area);
  const auto rigid = [](const Vector2d& x) { return Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()) * Vector3d(x.x(), x.y(), 0.3); };
  EXPECT_LT(energy(laws, rigid, false), 1e-8 * laws.bending_warp * plate);
}

TEST(ParticleCloth, OnASlopeItSticksBelowTheAngleOfFrictionAndSlidesAbove) {
  // tan(angle) below the coefficient: it stays. Above: it is g (sin - mu cos) t fast after a time t.
  constexpr double mu = 0.4;
  for (const double slope : {0.9 * mu, 1.25 * mu}) {
    const double angle = std::atan(slope);
    const Vector3d up(-std::sin(angle), 0.0, std::cos(angle)), down(-std::cos(angle), 0.0, -std::sin(angle));
    Rectangle sheet(4, 4, 0.08, 0.08, cloth_laws());
    sheet.sheet.body = BodyContact{[&](const Vector3d& p) { return Nearness{p.dot(up), up}; }, 2e6, 1e-3, mu};
    const double sunk = 0.2 * 9.80665 * std::cos(angle) / 2e6;
    ParticleCloth cloth(sheet.sheet, sheet.laid([&](const Vector2d& x) { return Vector3d(-x.x() * down + Vector3d(0, x.y(), 0) + (1e-3 - sunk) * up); }), sheet.free());
    const Vector3d before = cloth.places()[12];
    constexpr double dt = 0.001;
    for (int n = 0; n < 200; ++n) cloth.step(dt);
    const double gone = (cloth.places()[12] - before).dot(down), fast = cloth.velocities()[12].dot(down);
    if (slope < mu) {
      EXPECT_LT(gone, 1e-4);
      const Vector3d held = sum(cloth.forces(ClothForce::friction));
      EXPECT_NEAR(held.norm(), 0.2 * 0.0064 * 9.80665 * std::sin(angle), 1e-3 * 0.2 * 0.0064 * 9.80665);
    } else {
      EXPECT_NEAR(fast, 9.80665 * (std::sin(angle) - mu * std::cos(angle)) * 0.2, 0.03 * fast);
    }
  }
}

TEST(ParticleCloth, AHeldStripHangsAsTheHeavyElastica) {
  // w L^3/B = 8: the end falls by 0.6406 L and lies 0.7244 L out (Peirce: 41.5 degrees).
  constexpr double L = 0.06, weight = 0.2 * 9.80665;
  ClothLaws laws = cloth_laws();
  laws.bending_warp = laws.bending_weft = weight * L * L * L / 8.0;
  laws.warp = laws.weft = linear(2e4);
  Rectangle strip(16, 4, L * 17 / 16, L / 6, laws);  // one column more, held with the first
  std::vector<HeldComponents> held = strip.free();
  for (std::size_t n = 0; n < held.size(); ++n)
    if (strip.flat[n].x() < 1.3 * L / 16) held[n] = held_all;
  strip.sheet.drag = 0.5;
  ParticleCloth cloth(strip.sheet, strip.level(), held);
  settle(cloth);
  double root = 0.0;  // the clamp is where the held triangles end
  for (int j = 0; j <= strip.ny; ++j) root += strip.flat[strip.node(1, j)].x() / (strip.ny + 1);
  const Vector3d tip = cloth.places()[strip.node(16, 2)];
  EXPECT_NEAR(-tip.z() / L, 0.6406, 0.05 * 0.6406);
  EXPECT_NEAR((tip.x() - root) / L, 0.7244, 0.03);
}

TEST(ParticleCloth, WhatDoesNotFitIsRefused) {
  Rectangle sheet(2, 2, 0.02, 0.02, cloth_laws());
  ClothSheet turned = sheet.sheet;
  std::swap(turned.triangles[0].flat[0], turned.triangles[0].flat[1]);
  EXPECT_THROW(ParticleCloth(turned, sheet.level(), sheet.free()), std::invalid_argument);
  Places more = sheet.level();
  more.emplace_back(0, 0, 0);  // in no triangle
  EXPECT_THROW(ParticleCloth(sheet.sheet, more, std::vector<HeldComponents>(more.size(), 0)), std::invalid_argument);
}

}  // namespace snug::mesh
