// Membranes blown up by a pressure that follows them, from flat and free of stress (reference book 2.4): Newton's
// method finds its way although such a sheet has no stiffness across itself.
#include "tests/verification/book.hpp"
#include "tests/verification/membrane_scene.hpp"

#include "solver/terms/skin_membrane_term.hpp"

namespace snug::tests {
namespace {

/// A disc at rest in its rim, answers in its own units.
struct Inflated {
  double height, pole_stretch;
  double edge_tension, edge_slope;  ///< N/m per current length; rad
};

/// Stretch along the innermost edge of length h at its two Gauss points, where quadratic elements know the derivative
/// along an edge best; l0 + c r^2 through both, taken to the pole.
double pole_stretch(const Eigen::Vector3d& pole, const Eigen::Vector3d& half, const Eigen::Vector3d& end, double h) {
  const auto stretch = [&](double s) { return ((4 * s - 3) * pole + (4 - 8 * s) * half + (4 * s - 1) * end).norm() / h; };
  const double near = 0.5 - std::sqrt(1.0 / 12.0), far = 1.0 - near;
  return (far * far * stretch(near) - near * near * stretch(far)) / (far * far - near * near);
}

/// The rim's forces add up to tension times rim length along the meridian's tangent.
template <class Reactions, class Place>
void add_rim(const Reactions& reactions, const Place& place, double radius, Inflated& answer) {
  Plane pull = Plane::Zero();
  for (const auto& [node, f] : reactions) {
    const Plane x = place(node);
    pull += Plane(f.template head<2>().dot(x.normalized()), -f.z());
  }
  answer.edge_tension = pull.norm() / (0.5 * std::numbers::pi * radius);
  answer.edge_slope = std::atan2(pull.y(), pull.x());
}

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

/// The skin membrane, whose law is incompressible and hyperelastic, as a disc; `stiffness` (N/m) of its thickness.
Inflated inflate(int rings, double radius, const materials::SkinMembrane& law, double stiffness, double pressure) {
  const mesh::GarmentMesh none, disc = quarter_disc(rings, radius);
  mesh::BodyMesh body;
  body.kind = mesh::CellKind::tet10;  // facets are quadratic triangles
  body.nodes = disc.placed;
  for (const auto& t : disc.triangles) body.skin_facets.push_back({t[0], t[1], t[2], t[3], t[4], t[5], -1, -1, -1});
  const solver::Layout layout = solver::make_layout(body, none, true, false);
  std::vector<int> master(layout.size());
  std::vector<int> rim;
  for (int i = 0; i < layout.size(); ++i) master[i] = i;
  for (int node = 0; node < layout.body_nodes; ++node) {
    const Plane& x = disc.pattern[node];
    if (x.norm() > (1.0 - 1e-9) * radius) rim.push_back(node);
    for (int c = 0; c < 3; ++c)
      if (x.norm() > (1.0 - 1e-9) * radius || (c < 2 && x[c] < 1e-9 * radius)) master[layout.body(node, c)] = -1;
  }
  solver::Scene scene(layout, solver::Numbering(master));
  scene.add(std::make_unique<solver::SkinMembraneTerm>(layout, body, law));
  scene.add(std::make_unique<solver::PressureLoad>(layout, body, "disc", body.skin_facets, -pressure));
  scene.set_proximal_weights(Eigen::VectorXd::Constant(layout.size(), stiffness));
  const auto path = solver::follow_path(scene, solver::placed_state(layout, body, none), solver::tightening(), {}, [](const auto&) {});
  EXPECT_TRUE(path.complete) << path.message << " at " << path.reached;
  const auto at = [&](int node) -> Eigen::Vector3d { return path.state.values.segment<3>(layout.body(node)); };
  const double ring = radius * ring_radius(1, rings);
  Inflated answer{};
  answer.height = at(0).z();
  answer.pole_stretch = pole_stretch(at(0), at(disc.triangles[0][3]), at(disc.triangles[0][1]), ring);
  const Eigen::VectorXd residual = scene.full_residual(path.state);
  std::map<int, Eigen::Vector3d> reactions;
  for (const int node : rim) reactions[node] = residual.segment<3>(layout.body(node));
  add_rim(reactions, [&](int node) { return disc.pattern[node]; }, radius, answer);
  return answer;
}

materials::SkinMembrane rubber(const std::string& table, double thickness) {
  input::MaterialReference reference;
  reference.table = table + "\npoisson_ratio = 0.49";  // which an incompressible membrane does not use
  return {materials::find_membrane_tissue(reference).law, thickness};
}

TEST(CircularMembrane, BlowsUpARubberDiscUpToItsLimitPressure) {
  struct Row {
    double stretch, pressure, height, slope;  ///< pole stretch, p a/(mu h0), w0/a, deg
  };
  const auto law = rubber("law = 'neo-Hooke'\nshear_modulus = '1 Pa'", 1.0);
  for (const Row& row : std::vector<Row>{{1.05, 0.2349413453, 0.2740925596, 34.156349},
                                         {1.10, 0.5277819218, 0.3834724285, 46.838560},
                                         {1.20, 0.9992518339, 0.5309760700, 62.474063},
                                         {1.30, 1.3098681477, 0.6379562055, 72.537771},
                                         {1.50, 1.6435818408, 0.7987892130, 85.484962},
                                         {2.00, 1.8695547483, 1.0830671613, 102.703086}}) {
    const Inflated disc = inflate(20, 1.0, law, 1.0, row.pressure);
    const std::string scene = fmt::format("2.4 D neo-Hookean disc, p a/(mu h) = {:.4f}", row.pressure);
    const char* source = "reference book 2.4 D, shooting (s05)";
    book(scene, "pole stretch", disc.pole_stretch, row.stretch, 1e-4, source);
    book(scene, "height over radius", disc.height, row.height, 1e-4, source);
    book(scene, "slope at the rim, deg", disc.edge_slope * 180.0 / std::numbers::pi, row.slope, 1e-4, source);
  }
}

// Oden and Sato's disc of 1967, radius 7.5 in and thickness 0.5 in; the unit of length here is the inch, of stress the psi.
TEST(CircularMembrane, BlowsUpAMooneyRivlinDisc) {
  struct Row {
    double pressure, height, stretch;
  };
  const auto law = rubber("law = 'Mooney-Rivlin'\nC10 = '80 Pa'\nC01 = '20 Pa'", 0.5);
  for (const Row& row : std::vector<Row>{{5.0, 2.46137855, 1.0711974071},
                                         {10.0, 3.33750283, 1.1324945726},
                                         {20.0, 4.94061735, 1.2976859716},
                                         {30.0, 7.09231546, 1.6137400704},
                                         {36.44274412, 9.37083559, 2.0},
                                         {46.44654119, 15.57163736, 3.0}}) {
    const Inflated disc = inflate(20, 7.5, law, 100.0, row.pressure);
    const std::string scene = fmt::format("2.4 D Mooney-Rivlin disc, {:g} psi", row.pressure);
    const char* source = "reference book 2.4 D, shooting (s05)";
    book(scene, "height, in", disc.height, row.height, 1e-4, source);
    book(scene, "pole stretch", disc.pole_stretch, row.stretch, 1e-4, source);
  }
}

}  // namespace
}  // namespace snug::tests
