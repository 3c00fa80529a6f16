#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <array>
#include <cmath>
#include <random>

#include "materials/fabric/fabric.hpp"
#include "tests/unit/materials/fabrics_under_test.hpp"
#include "tests/unit/materials/rates.hpp"

namespace snug::testing {
namespace {

using Eigen::Matrix2d, Eigen::Vector2d, Eigen::Vector3d;
using materials::Fabric, materials::MembraneResponse, materials::TensionCurve;
using State = MembraneResponse::State;

Matrix2d tensor(const Vector3d& force) {
  Matrix2d N;
  N << force[0], force[2], force[2], force[1];
  return N;
}
double largest_stiffness(const Fabric& f) { return f.unrelaxed({0.0, 0.0, 0.0}).tangent.maxCoeff(); }
const std::array<double, 5> sizes = {1e-8, 1e-4, 1e-2, 0.1, 0.8};

TEST(RelaxedFabric, TautIsUnrelaxed) {
  // Where both principal forces pull, the relaxed law is the law itself, whatever eta.
  for (const auto& [name, f] : all_fabrics()) {
    const Vector3d E(0.05, 0.03, 0.01);
    const auto plain = f.unrelaxed(E), relaxed = f.relaxed(E, 0.01);
    EXPECT_EQ(relaxed.state, State::taut) << name;
    EXPECT_EQ(plain.energy, relaxed.energy) << name;
    EXPECT_EQ(plain.force, relaxed.force) << name;
    EXPECT_EQ(plain.tangent, relaxed.tangent) << name;
  }
}

TEST(RelaxedFabric, SlackCarriesNothing) {
  // A sheet shortened in all directions has no energy, no force and no stiffness but eta times those of the law.
  for (const auto& [name, f] : all_fabrics()) {
    const Vector3d E(-0.05, -0.03, 0.01);
    const auto none = f.relaxed(E, 0.0);
    EXPECT_EQ(none.state, State::slack) << name;
    EXPECT_EQ(none.energy, 0.0) << name;
    EXPECT_EQ(none.force.norm(), 0.0) << name;
    EXPECT_EQ(none.tangent.norm(), 0.0) << name;
    EXPECT_NEAR((f.relaxed(E, 0.01).force - 0.01 * f.unrelaxed(E).force).norm(), 0.0, 1e-13) << name;
  }
}

TEST(RelaxedFabric, UniaxialOffAxis) {
  // Stretched along m and free to shorten across it, the sheet carries N = sigma m m exactly as a strip whose own
  // lateral strain and shear are free: for a linear law sigma = (m.E m)/(M:S:M), S the compliance.
  const Fabric f = fabric(TensionCurve::linear(1000), TensionCurve::linear(300), 0.3, 50);
  const Eigen::Matrix3d S = f.unrelaxed(Vector3d::Zero()).tangent.inverse();
  for (double degrees : {0.0, 10.0, 30.0, 45.0, 77.0, 90.0}) {
    const double angle = degrees * M_PI / 180.0;
    const Vector2d m(std::cos(angle), std::sin(angle)), n(-m[1], m[0]);
    const Vector3d M(m[0] * m[0], m[1] * m[1], m[0] * m[1]);
    const Vector3d free_strain = 0.1 / M.dot(S * M) * (S * M);
    const Vector3d wrinkle(n[0] * n[0], n[1] * n[1], 2 * n[0] * n[1]);
    const auto r = f.relaxed(free_strain - 0.07 * wrinkle, 0.0);
    EXPECT_EQ(r.state, State::wrinkled) << degrees;
    EXPECT_LT((r.force - 0.1 / M.dot(S * M) * M).norm(), 1e-11 * r.force.norm()) << degrees;
    EXPECT_NEAR((tensor(r.force) * n).norm(), 0.0, 1e-11 * r.force.norm()) << degrees;
    EXPECT_NEAR(r.energy, 0.5 * 0.1 * 0.1 / M.dot(S * M), 1e-12 * r.energy) << degrees;
  }
}

TEST(RelaxedFabric, ShearOfAnInfiniteStrip) {
  // Simple shear of an isotropic strip: line force along the larger principal strain, reference book 2.5
  // (relaxed St Venant-Kirchhoff, Eh = 1): P12 and P22.
  const Fabric f = fabric(TensionCurve::linear(1), TensionCurve::linear(1), 0.0, 0.5);
  struct Row {
    double shear, p12, p22;
  };
  for (const Row row : {Row{0.01, .002537750781, .002525093749},
                        {0.1, .029007805675, .027593652514},
                        {0.5, .254780097671, .198926289083}}) {
    const double g = row.shear;
    const auto r = f.relaxed({0.0, 0.5 * g * g, g}, 0.0);
    EXPECT_NEAR(r.force[2] + g * r.force[1], row.p12, 1e-12);
    EXPECT_NEAR(r.force[1], row.p22, 1e-12);
  }
}

TEST(RelaxedFabric, OnlyPulls) {
  // The relaxed force is positive semidefinite and its energy lies between nothing and the law's, for every strain.
  std::mt19937 random(1);
  for (const auto& [name, f] : all_fabrics())
    for (double size : sizes)
      for (int k = 0; k < 2000; ++k) {
        const Vector3d E = random_strain(random, size);
        const auto r = f.relaxed(E, 0.0);
        const double K = largest_stiffness(f);
        const Eigen::SelfAdjointEigenSolver<Matrix2d> eigen(tensor(r.force));
        ASSERT_GE(eigen.eigenvalues()[0], -1e-11 * K * size) << name << " " << E.transpose();
        ASSERT_GE(r.energy, -1e-22 * K) << name;
        ASSERT_LE(r.energy, f.unrelaxed(E).energy * (1 + 1e-12) + 1e-22 * K) << name << " " << E.transpose();
      }
}

TEST(RelaxedFabric, IsTheMinimum) {
  // No wrinkle strain A >= 0 gives less energy than the relaxed one: random trials around and far from the solution.
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (const auto& [name, f] : all_fabrics())
    for (double size : {1e-2, 0.3})
      for (int k = 0; k < 200; ++k) {
        const Vector3d E = random_strain(random, size);
        const auto r = f.relaxed(E, 0.0);
        for (int trial = 0; trial < 50; ++trial) {
          const double s = size * std::pow(10.0, -trial % 4);
          const Vector2d v = std::sqrt(s) * Vector2d(normal(random), normal(random));
          const Vector2d w =
              trial % 2 == 0 ? Vector2d::Zero() : Vector2d(std::sqrt(s) * Vector2d(normal(random), normal(random)));
          const Vector3d A(v[0] * v[0] + w[0] * w[0], v[1] * v[1] + w[1] * w[1], 2 * (v[0] * v[1] + w[0] * w[1]));
          ASSERT_GE(f.unrelaxed(E + A).energy, r.energy * (1 - 1e-11)) << name << " " << E.transpose();
        }
      }
}

TEST(RelaxedFabric, Convex) {
  // W_r at the middle of two strains is at most the mean of its values there; its tangent has no negative eigenvalue.
  std::mt19937 random(3);
  for (const auto& [name, f] : all_fabrics())
    for (double size : sizes)
      for (int k = 0; k < 1000; ++k) {
        const Vector3d a = random_strain(random, size), b = random_strain(random, size);
        const auto ra = f.relaxed(a, 0.0), rb = f.relaxed(b, 0.0);
        const double mean = 0.5 * (ra.energy + rb.energy);
        ASSERT_LE(f.relaxed(0.5 * (a + b), 0.0).energy, mean * (1 + 1e-12) + 1e-22) << name;
        ASSERT_LT((ra.tangent - ra.tangent.transpose()).cwiseAbs().maxCoeff(), 1e-13 * largest_stiffness(f) * 100);
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(ra.tangent);
        ASSERT_GE(eigen.eigenvalues()[0], -1e-12 * eigen.eigenvalues()[2] - 1e-12 * largest_stiffness(f))
            << name << a.transpose();
      }
}

TEST(RelaxedFabric, ForceIsContinuous) {
  // Along straight paths through taut, wrinkled and slack states the force never jumps: its change over a step is at
  // most stiffness times step.
  std::mt19937 random(4);
  for (const auto& [name, f] : all_fabrics())
    for (int path = 0; path < 50; ++path) {
      const Vector3d a = random_strain(random, 0.3), b = random_strain(random, 0.3);
      constexpr int steps = 2000;
      auto last = f.relaxed(a, 0.0);
      for (int k = 1; k <= steps; ++k) {
        const auto next = f.relaxed(a + (b - a) * k / steps, 0.0);
        const double bound = 1.1 * std::max(last.tangent.norm(), next.tangent.norm()) + 1.5 * largest_stiffness(f);
        ASSERT_LE((next.force - last.force).norm(), bound * (b - a).norm() / steps) << name;
        last = next;
      }
    }
}

/// True when the stretched strain E + A stays away from the kinks of the curves' stiffness (zero and the data's end)
/// and E from a change of state, so that a difference quotient over `step` has its asymptotic rate.
bool smooth_around(const Fabric& f, const Vector3d& E, double eta, double step) {
  const auto r = f.relaxed(E, 0.0);
  Vector3d stretched = E;
  for (int k = 0; k < 50; ++k) {
    const auto at = f.unrelaxed(stretched);
    stretched -= at.tangent.inverse() * (at.force - r.force);
  }
  bool clear = true;
  for (const Vector3d& e : {E, stretched})
    for (const double kink : {e[0], e[1], e[0] - f.warp.data_end(), e[1] - f.weft.data_end()})
      clear = clear && (std::abs(kink) > 20 * step || r.state == State::slack);
  for (int k = 0; k < 3; ++k)
    for (const double s : {-2 * step, 2 * step})
      clear = clear && f.relaxed(E + s * Vector3d::Unit(k), eta).state == r.state;
  return clear;
}

TEST(RelaxedFabric, TangentByRate) {
  // Force and tangent are the first and second derivative of the used energy in taut, wrinkled and slack states.
  std::mt19937 random(5);
  for (const auto& [name, f] : all_fabrics())
    for (double eta : {0.0, 0.01}) {
      int tested = 0;
      while (tested < 30) {
        const Vector3d E = random_strain(random, 0.2);
        const double step = 5e-4;
        if (!smooth_around(f, E, eta, step)) continue;
        ++tested;
        SCOPED_TRACE(std::string(name) + ", state " + std::to_string(int(f.relaxed(E, eta).state)));
        const auto r = f.relaxed(E, eta);
        const auto energy = [&](const Eigen::VectorXd& x) {
          return Eigen::VectorXd::Constant(1, f.relaxed(x, eta).energy);
        };
        const auto force = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return f.relaxed(x, eta).force; };
        expect_derivative_by_rate(energy, E, r.force.transpose(), step);
        expect_derivative_by_rate(force, E, r.tangent, step);
      }
    }
}

}  // namespace
}  // namespace snug::testing
