// Discs of fabric blown up by a pressure that follows them, from flat and free of stress (reference book 2.4): Newton's
// method finds its way although such a sheet has no stiffness across itself.
#include "tests/verification/book.hpp"
#include "tests/verification/inflated_disc.hpp"

namespace snug::tests {
namespace {

Inflated inflate(int rings, double radius, const materials::Fabric& fabric, double pressure) {
  Sheet sheet(quarter_disc(rings, radius), fabric);
  const auto rim = [&](const Plane& x) { return x.norm() > (1.0 - 1e-9) * radius; };
  sheet.hold({0, 1, 2}, rim);
  sheet.hold({0}, [&](const Plane& x) { return x.x() < 1e-9 * radius; });
  sheet.hold({1}, [&](const Plane& x) { return x.y() < 1e-9 * radius; });
  sheet.pressure = pressure;
  sheet.solve();
  EXPECT_EQ(sheet.answer.increments, 1);  // at once, from rest
  const double ring = radius * ring_radius(1, rings);
  Inflated answer{};
  answer.height = sheet.at(0).z();
  answer.pole_stretch = pole_stretch(sheet.at(0), sheet.at(sheet.node_at({0.5 * ring, 0.0})), sheet.at(sheet.node_at({ring, 0.0})), ring);
  add_rim(sheet.reactions(rim), [&](int node) { return sheet.mesh.pattern[node]; }, radius, answer);
  return answer;
}

/// T = K (1 + nu) (l^2 - 1)/2 of a sheet stretched alike both ways, N/m of current length.
double equibiaxial(double youngs, double nu, double stretch) {
  return youngs / (1.0 - nu) * 0.5 * (stretch * stretch - 1.0);
}

// With strains of 1e-4 exact kinematics are those of moderate rotations.
TEST(CircularMembrane, MeetsHenckysConstantsAtSmallStrain) {
  struct Row {
    double nu, pole, edge, height;
  };
  const double radius = 1.0, youngs = 1.0, p = 1e-7;
  for (const Row& row : std::vector<Row>{{0.00, 0.40510327, 0.28937196, 0.71831924},
                                         {0.20, 0.42068309, 0.31610929, 0.67743533},
                                         {0.25, 0.42561193, 0.32417076, 0.66579130},
                                         {0.30, 0.43110102, 0.33295681, 0.65344334},
                                         {0.34, 0.43596656, 0.34058979, 0.64299804},
                                         {0.40, 0.44421766, 0.35323275, 0.62625508},
                                         {0.45, 0.45216140, 0.36508342, 0.61117056},
                                         {0.50, 0.46132768, 0.37841207, 0.59487903}}) {
    const Inflated disc = inflate(16, radius, isotropic(youngs, row.nu), p);
    const double force = std::cbrt(youngs * p * p * radius * radius), length = radius * std::cbrt(p * radius / youngs);
    const std::string scene = fmt::format("2.4 A Hencky's membrane, nu {:.2f}", row.nu);
    const char* source = "reference book 2.4 A (s05)";
    book(scene, "pole tension over (E h p^2 a^2)^(1/3)", equibiaxial(youngs, row.nu, disc.pole_stretch) / force, row.pole, 1e-4, source);
    book(scene, "edge tension over (E h p^2 a^2)^(1/3)", disc.edge_tension / force, row.edge, 1e-4, source);
    book(scene, "height over a (p a/(E h))^(1/3)", disc.height / length, row.height, 1e-4, source);
  }
}

struct FiniteRow {
  double pressure, height, pole, edge, stretch;
};

void finite_strain(const std::string& name, double radius, double youngs, double nu, const std::vector<FiniteRow>& rows) {
  for (const FiniteRow& row : rows) {
    const Inflated disc = inflate(16, radius, isotropic(youngs, nu), row.pressure);
    const std::string scene = fmt::format("{}, {:g} Pa", name, row.pressure), source = "reference book 2.4, shooting (s05)";
    book(scene, "height, m", disc.height, row.height, 1e-4, source);
    book(scene, "pole tension, N/m", equibiaxial(youngs, nu, disc.pole_stretch), row.pole, 1e-4, source);
    book(scene, "edge tension, N/m", disc.edge_tension, row.edge, 1e-4, source);
    book(scene, "pole stretch", disc.pole_stretch, row.stretch, 1e-4, source);
  }
}

TEST(CircularMembrane, MeetsTheExactAnswersAtFiniteStrain) {
  finite_strain("2.4 B disc, Eh 31148.8 N/m", 0.1425, 31148.8, 0.34,
                {{1e2, 0.0070638049, 80.820233, 63.120927, 1.0017110052},
                 {1e3, 0.0152471200, 378.419032, 295.252920, 1.0079862856},
                 {1e4, 0.0331418273, 1827.988339, 1421.178896, 1.0380101591},
                 {1e5, 0.0745683677, 10127.058434, 7884.958700, 1.1954734332}});
  finite_strain("2.4 C disc like fabric", 0.1, 1000.0, 0.3,
                {{10.0, 0.0065404375, 4.32881706, 3.34208627, 1.0030255948},
                 {100.0, 0.0141384569, 20.39492415, 15.72716942, 1.0141759679},
                 {500.0, 0.0243799448, 61.83161845, 47.58444022, 1.0423839340},
                 {1000.0, 0.0309515382, 101.32450960, 77.91637082, 1.0685758342},
                 {3000.0, 0.0456656511, 230.81185352, 177.91613416, 1.1502767471}});
}

TEST(CircularMembrane, ErrorsFallWithTheFourthPowerOfTheMesh) {
  const auto error = [](int rings) { return std::abs(inflate(rings, 0.1, isotropic(1000.0, 0.3), 1000.0).height / 0.0309515382 - 1.0); };
  EXPECT_GT(error(8) / error(16), 12.0);
}

}  // namespace
}  // namespace snug::tests
