// Curved facets, the skin as a surface to find points on, and the quadrature of the garment.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <numbers>

#include "solver/terms/garment_shape.hpp"
#include "solver/terms/master_surface.hpp"
#include "tests/unit/solver/terms.hpp"

namespace snug::tests {
namespace {

using solver::FacetNodes, solver::Site, solver::MasterSurface;

/// A facet with two curvatures and twist.
FacetNodes curved_facet() {
  FacetNodes nodes;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) {
      const double x = 0.01 * i, y = 0.012 * j;
      nodes.col(3 * (j + 1) + i + 1) << x + 0.001 * j, y, -10.0 * x * x - 6.0 * y * y + 4.0 * x * y;
    }
  return nodes;
}

TEST(Facet, TheClosestPointIsOrthogonalToTheCurvedFacet) {
  const FacetNodes nodes = curved_facet();
  for (unsigned trial = 0; trial < 50; ++trial) {
    const Eigen::VectorXd r = random_vector(3, 1.0, trial);
    const Eigen::Vector2d there(0.8 * r[0], 0.8 * r[1]);
    const auto at = solver::facet_point(nodes, solver::facet_shape(mesh::FacetKind::quad9, there));
    const double gap = 0.004 * r[2];
    Eigen::Vector2d xi(0.0, 0.0);
    ASSERT_TRUE(solver::project(mesh::FacetKind::quad9, nodes, at.y + gap * at.n, 1.5, xi));
    EXPECT_LE((xi - there).norm(), 1e-12);
    const auto found = solver::facet_point(nodes, solver::facet_shape(mesh::FacetKind::quad9, xi));
    const Eigen::Vector3d arm = at.y + gap * at.n - found.y;
    EXPECT_LE((found.tangent.transpose() * arm).norm(), 1e-14 * found.tangent.norm());
    EXPECT_NEAR(arm.dot(found.n), gap, 1e-14);
  }
}

/// The skin of a tube, at rest.
struct TubeSkin : testing::Test {
  TubeCase tube;
  input::Case description = describe_tube(tube);
  mesh::Limb limb = mesh::make_limb(*description.body);
  mesh::BodyMesh body = mesh::make_body_mesh(*description.body, limb);
  MasterSurface skin{{}, body, body.skin_facets};
  solver::State state;

  Eigen::Vector3d above(const Site& site, double height) const {
    const auto at = solver::facet_point(skin.positions(state, site.facet), solver::facet_shape(mesh::FacetKind::quad9, site.xi));
    return at.y + height * at.n;
  }
  Site random_site(unsigned seed, double inside) const {
    const Eigen::VectorXd r = random_vector(3, 1.0, seed);
    return {static_cast<int>(0.5 * (r[0] + 1.0) * skin.facets()), {inside * r[1], inside * r[2]}};
  }
};

TEST_F(TubeSkin, NeighboursAreMutualAndOnlyTheHemsAreOpen) {
  int open = 0;
  for (int f = 0; f < skin.facets(); ++f)
    for (const int g : skin.neighbours(f)) {
      if (g < 0) {
        ++open;
        continue;
      }
      const auto& back = skin.neighbours(g);
      EXPECT_EQ(std::count(back.begin(), back.end(), f), 1);
    }
  EXPECT_EQ(open, 2 * tube.around);
}

TEST_F(TubeSkin, FindReturnsThePointAboveWhichOneStands) {
  for (unsigned trial = 0; trial < 60; ++trial) {
    const Site truth = random_site(trial, 0.95);
    const Site found = skin.find(state, above(truth, 0.003));
    ASSERT_EQ(found.facet, truth.facet);
    EXPECT_LE((found.xi - truth.xi).norm(), 1e-10);
  }
}

TEST_F(TubeSkin, FollowingFromANeighbourAgreesWithTheGlobalSearch) {
  for (unsigned trial = 0; trial < 60; ++trial) {
    const Site truth = random_site(trial, 0.7);  // deeper inside than the hysteresis reaches
    for (const int neighbour : skin.neighbours(truth.facet)) {
      if (neighbour < 0) continue;
      const Site followed = skin.follow(state, above(truth, 0.003), {neighbour, Eigen::Vector2d::Zero()});
      ASSERT_EQ(followed.facet, truth.facet);
      EXPECT_LE((followed.xi - truth.xi).norm(), 1e-10);
    }
    EXPECT_EQ(skin.follow(state, above(truth, 0.003), Site{}).facet, truth.facet);  // it met no skin before
  }
}

TEST_F(TubeSkin, APointStaysWithItsFacetALittleOverTheEdgeAndLeavesItFartherOut) {
  const int facet = 0, next = skin.neighbours(facet)[1];
  const Site edge{facet, {0.99, 0.1}};
  const Site near = skin.follow(state, above({facet, {1.1, 0.1}}, 0.001), edge);
  EXPECT_EQ(near.facet, facet);
  EXPECT_NEAR(near.xi[0], 1.1, 1e-6);
  const Site far = skin.follow(state, above({next, {-0.6, 0.1}}, 0.001), edge);
  EXPECT_EQ(far.facet, next);
  EXPECT_NEAR(far.xi[0], -0.6, 1e-10);
  EXPECT_EQ(skin.find(state, above({next, {-0.9, 0.1}}, 0.001)).facet, next);  // without a past, the nearest
}

TEST_F(TubeSkin, APointBeyondTheHemFacesNoSkin) {
  const Eigen::Vector3d x(0.056, 0.0, tube.length + 0.002);
  EXPECT_EQ(skin.find(state, x).facet, -1);
}

/// Flat triangles round their first corner, the origin, which is the highest point: a roof of two, or a pyramid of `sides`.
struct Peak {
  explicit Peak(int sides) : around(sides) {
    body.kind = mesh::CellKind::tet10;
    body.nodes.push_back(Eigen::Vector3d::Zero());
    for (int k = 0; k < sides; ++k) {
      const double turn = 2.0 * std::numbers::pi * (k + 0.2) / sides;
      body.nodes.emplace_back(0.02 * std::cos(turn), 0.02 * std::sin(turn), -0.008);
    }
    for (int k = 0; k < sides; ++k) add(0, 1 + k, 1 + (k + 1) % sides);
  }
  void add(int a, int b, int c) {
    mesh::FacetNodeNumbers facet;
    facet.fill(-1);
    facet[0] = a, facet[1] = b, facet[2] = c;
    for (int e = 0; e < 3; ++e) {
      facet[3 + e] = static_cast<int>(body.nodes.size());
      body.nodes.emplace_back(0.5 * (body.nodes[facet[e]] + body.nodes[facet[(e + 1) % 3]]));
    }
    facets.push_back(facet);
  }
  int around;
  mesh::BodyMesh body;
  std::vector<mesh::FacetNodeNumbers> facets;
};

// One that went over to the other side with every look would meet another normal in every iterate of Newton's method, which would not end.
TEST(Peaks, APointOverAnEdgeOrACornerThatBulgesKeepsItsFacet) {
  const solver::State state;
  for (const int sides : {3, 4, 5, 7}) {
    const Peak peak(sides);
    const MasterSurface surface({}, peak.body, peak.facets);
    const double turn = 2.0 * std::numbers::pi * 0.2 / sides;
    const Eigen::Vector3d along = Eigen::Vector3d(0.02 * std::cos(turn), 0.02 * std::sin(turn), -0.008), up(0.0, 0.0, 0.012);
    for (const bool corner : {true, false})
      for (int from = 0; from < sides; ++from) {
        const Eigen::Vector3d x = corner ? Eigen::Vector3d(up + Eigen::Vector3d(1e-4, 2e-4, 0.0)) : Eigen::Vector3d(0.5 * along + up);
        Site site = surface.follow(state, x, {from, {1.0 / 3.0, 1.0 / 3.0}});
        ASSERT_GE(site.facet, 0) << sides;
        const Eigen::Vector3d foot = surface.positions(state, site.facet) * solver::facet_shape(surface.kind(), site.xi).N;
        EXPECT_LE(corner ? foot.norm() : foot.cross(along.normalized()).norm(), 1e-12) << sides << " from " << from;
        for (int look = 0; look < 3; ++look) {
          const Site next = surface.follow(state, x + 1e-6 * random_vector(3, 1.0, static_cast<unsigned>(look)), site);
          EXPECT_EQ(next.facet, site.facet) << sides << " from " << from;
          EXPECT_LE((next.xi - site.xi).norm(), 1e-3);
        }
      }
  }
}

double factorial(int n) { return n < 2 ? 1.0 : n * factorial(n - 1); }

/// Mean of L1^a L2^b over a triangle: 2 a! b! / (a + b + 2)!.
TEST(TriangleRule, CompositeRulesIntegrateDegreeFiveExactly) {
  for (const int parts : {1, 2, 3, 5})
    for (int degree = 0; degree <= 5; ++degree)
      for (int a = 0; a <= degree; ++a) {
        const int b = degree - a;
        double sum = 0.0;
        for (const auto& q : solver::composite_rule(parts)) sum += q.weight * std::pow(q.L[1], a) * std::pow(q.L[2], b);
        EXPECT_NEAR(sum, 2.0 * factorial(a) * factorial(b) / factorial(a + b + 2), 1e-14) << parts << a << b;
      }
}

TEST(TriangleRule, PointsOfCompositeRulesAreInsideAndTheirCoordinatesSumToOne) {
  for (const int parts : {1, 2, 3, 5}) {
    const auto rule = solver::composite_rule(parts);
    EXPECT_EQ(rule.size(), 7u * parts * parts);
    for (const auto& q : rule) {
      EXPECT_NEAR(q.L.sum(), 1.0, 1e-15);
      EXPECT_GT(q.L.minCoeff(), 0.0);
    }
  }
}

}  // namespace
}  // namespace snug::tests
