// Discs of rubber blown up from flat by a pressure that follows them, up to the largest that they bear (reference book 2.4 D).
#include "solver/stepping/arc_length.hpp"
#include "solver/terms/skin_membrane_term.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/inflated_disc.hpp"

namespace snug::tests {
namespace {

/// A quarter of a disc as the skin of a body without cells, whose law is incompressible and hyperelastic.
struct RubberDisc {
  int rings;
  double radius;
  mesh::GarmentMesh flat;
  mesh::BodyMesh body;
  solver::Layout layout;
  std::vector<int> master, rim;

  RubberDisc(int n, double a) : rings(n), radius(a), flat(quarter_disc(n, a)) {
    body.kind = mesh::CellKind::tet10;  // facets are quadratic triangles
    body.nodes = flat.placed;
    for (const auto& t : flat.triangles) body.skin_facets.push_back({t[0], t[1], t[2], t[3], t[4], t[5], -1, -1, -1});
    layout = tests::make_layout(body, {}, true, false);
    for (int i = 0; i < layout.size(); ++i) master.push_back(i);
    for (int node = 0; node < layout["body"].count; ++node) {
      const Plane& x = flat.pattern[node];
      const bool at_rim = x.norm() > (1.0 - 1e-9) * radius;
      if (at_rim) rim.push_back(node);
      for (int c = 0; c < 3; ++c)
        if (at_rim || (c < 2 && x[c] < 1e-9 * radius)) master[layout["body"](node, c)] = -1;
    }
  }
  solver::Scene scene(const materials::SkinMembrane& law, double pressure) const {
    solver::Scene scene(layout, solver::Numbering(master));
    scene.add(std::make_unique<solver::SkinMembraneTerm>(layout["body"], body, law));
    auto load = std::make_unique<solver::PressureLoad>(layout["body"], body, "disc", body.skin_facets, -pressure);
    load->hold_border(scene.numbering());
    scene.add(std::move(load));
    const double stiffness = law.thickness * materials::initial_shear_modulus(law.law);
    scene.damp(Eigen::VectorXd::Constant(layout.size(), stiffness));
    return scene;
  }
  solver::State start() const { return tests::placed_state(layout, body, {}); }
};

Inflated inflate(const RubberDisc& disc, const materials::SkinMembrane& law, double pressure) {
  solver::Scene scene = disc.scene(law, pressure);
  const auto path = solver::follow_path(scene, disc.start(), solver::tightening(), {}, [](const auto&) {});
  EXPECT_TRUE(path.complete) << path.message << " at " << path.reached;
  const auto at = [&](int node) -> Eigen::Vector3d { return path.state.values.segment<3>(disc.layout["body"](node)); };
  Inflated answer{};
  answer.height = at(0).z();
  answer.pole_stretch = pole_stretch(at(0), at(disc.flat.triangles[0][3]), at(disc.flat.triangles[0][1]), disc.radius * ring_radius(1, disc.rings));
  const Eigen::VectorXd residual = scene.full_residual(path.state);
  std::map<int, Eigen::Vector3d> reactions;
  for (const int node : disc.rim) reactions[node] = residual.segment<3>(disc.layout["body"](node));
  add_rim(reactions, [&](int node) { return disc.flat.pattern[node]; }, disc.radius, answer);
  return answer;
}

materials::SkinMembrane rubber(const std::string& table, double thickness) {
  input::MaterialEntry reference;
  reference.table = input::table_of(table + "\npoisson_ratio = 0.49");  // which an incompressible membrane does not use
  return {materials::find_membrane_tissue(reference).law, thickness};
}

TEST(RubberDisc, FollowsItsPressureUpToTheLimit) {
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
    const Inflated disc = inflate(RubberDisc(20, 1.0), law, row.pressure);
    const std::string scene = fmt::format("2.4 D neo-Hookean disc, p a/(mu h) = {:.4f}", row.pressure);
    const char* source = "reference book 2.4 D, shooting (s05)";
    book(scene, "pole stretch", disc.pole_stretch, row.stretch, 1e-4, source);
    book(scene, "height over radius", disc.height, row.height, 1e-4, source);
    book(scene, "slope at the rim, deg", disc.edge_slope * 180.0 / std::numbers::pi, row.slope, 1e-4, source);
  }
}

// Oden and Sato's disc of 1967, radius 7.5 in and thickness 0.5 in; the unit of length here is the inch, of stress the psi.
TEST(RubberDisc, FollowsItsPressureAsMooneyAndRivlinSay) {
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
    const Inflated disc = inflate(RubberDisc(20, 7.5), law, row.pressure);
    const std::string scene = fmt::format("2.4 D Mooney-Rivlin disc, {:g} psi", row.pressure);
    const char* source = "reference book 2.4 D, shooting (s05)";
    book(scene, "height, in", disc.height, row.height, 1e-4, source);
    book(scene, "pole stretch", disc.pole_stretch, row.stretch, 1e-4, source);
  }
}

/// The value at `x` of the cubic through the four nearest of points (x, y) along a curve, x ascending.
double on_curve(const std::vector<std::pair<double, double>>& points, double x) {
  std::size_t first = 0;
  while (first + 4 < points.size() && points[first + 2].first < x) ++first;
  double sum = 0.0;
  for (std::size_t i = first; i < first + 4; ++i) {
    double weight = points[i].second;
    for (std::size_t j = first; j < first + 4; ++j)
      if (j != i) weight *= (x - points[j].first) / (points[i].first - points[j].first);
    sum += weight;
  }
  return sum;
}

// Past its limit pressure the disc grows while the pressure falls: pole stretches 3 and 4 lie on that branch.
TEST(RubberDisc, GrowsPastItsLimitPressureAlongTheCurve) {
  const RubberDisc disc(20, 1.0);
  const double full = 2.5;  // p a/(mu h), never reached
  solver::Scene scene = disc.scene(rubber("law = 'neo-Hooke'\nshear_modulus = '1 Pa'", 1.0), full);
  std::vector<std::pair<double, double>> pressure, height;  // over the pole's stretch
  const auto stretch = [&](const solver::State& state) {
    const auto at = [&](int node) -> Eigen::Vector3d { return state.values.segment<3>(disc.layout["body"](node)); };
    return pole_stretch(at(0), at(disc.flat.triangles[0][3]), at(disc.flat.triangles[0][1]), disc.radius * ring_radius(1, disc.rings));
  };
  solver::ArcSettings settings;
  settings.longest = 2.0;
  settings.stop = [&](const solver::State& state) { return stretch(state) > 4.3; };
  settings.accepted = [&](const solver::Scene&, const solver::State& state, int) {
    pressure.emplace_back(stretch(state), full * state.load);
    height.emplace_back(stretch(state), state.values[disc.layout["body"](0, 2)]);
  };
  const auto start = solver::follow_path(scene, disc.start(), solver::tightening(0.0, 0.4), {}, [](const auto&) {});
  ASSERT_TRUE(start.complete) << start.message;
  int iterations = 0;
  const auto curve = solver::follow_arc(scene, start.state, disc.start(), settings, [&](const auto&) { ++iterations; });
  fmt::print("disc along its curve: {} increments, {} iterations, to a stretch of {:.3f}\n", curve.path.increments, iterations,
             stretch(curve.path.state));
  ASSERT_TRUE(curve.path.complete) << curve.path.message;
  ASSERT_TRUE(curve.limit_load.has_value());
  const char* source = "reference book 2.4 D, shooting (s05)";
  const std::string scene_name = "2.4 D neo-Hookean disc, arc length";
  book(scene_name, "limit pressure a/(mu h)", full * *curve.limit_load, 1.87917347, 1e-3, source);
  struct Row {
    double stretch, pressure, height;
  };
  for (const Row& row : std::vector<Row>{{3.0, 1.8079220952, 1.4888464331}, {4.0, 1.6719595145, 1.8059325009}}) {
    book(scene_name, fmt::format("p a/(mu h) at a pole stretch of {:g}", row.stretch), on_curve(pressure, row.stretch), row.pressure, 1e-3, source);
    book(scene_name, fmt::format("height over radius at a pole stretch of {:g}", row.stretch), on_curve(height, row.stretch), row.height, 1e-3, source);
  }
}

// A load path that ends below the whole load goes on along the curve, which never comes up to it: the answer is the state of
// the largest pressure, and it says so.
TEST(RubberDisc, APressureThatItCannotBearEndsAtTheLargestOne) {
  const RubberDisc disc(10, 1.0);
  const double beyond = 2.0;
  solver::Scene scene = disc.scene(rubber("law = 'neo-Hooke'\nshear_modulus = '1 Pa'", 1.0), beyond);
  int by_load = 0, along = 0;
  const auto loaded = solver::follow_load(scene, disc.start(), false, {}, [&](const auto&) { ++by_load; }, [&](const auto&) { ++along; });
  fmt::print("disc under too much: {} iterations by load, {} along the curve\n", by_load, along);
  EXPECT_FALSE(loaded.path.complete);
  ASSERT_TRUE(loaded.limit_load.has_value());
  const char* source = "reference book 2.4 D, shooting (s05)";
  book("2.4 D neo-Hookean disc, arc length", "limit pressure a/(mu h) after a load path that failed", beyond * *loaded.limit_load,
       1.87917347, 1e-3, source);
  EXPECT_LE(loaded.path.reached, *loaded.limit_load * (1.0 + 1e-9));
  EXPECT_GE(loaded.path.reached, 0.99 * *loaded.limit_load);
  EXPECT_NE(loaded.path.message.find("the load has a largest value"), std::string::npos) << loaded.path.message;
}

// Beyond a pressure p a/(mu h) = 1.87917347 a neo-Hookean disc has no equilibrium: a path of loads ends there.
TEST(RubberDisc, LoadPathEndsAtItsLimitPressure) {
  const RubberDisc disc(10, 1.0);
  const double beyond = 1.9;
  solver::Scene scene = disc.scene(rubber("law = 'neo-Hooke'\nshear_modulus = '1 Pa'", 1.0), beyond);
  solver::PathSettings settings;
  settings.longest_step = 0.25, settings.smallest_step = 1e-5, settings.failures = 40;
  settings.intermediate_residual = settings.newton.residual;
  const auto path = solver::follow_path(scene, disc.start(), solver::tightening(), settings, [](const auto&) {});
  EXPECT_FALSE(path.complete);
  book("2.4 D neo-Hookean disc", "limit pressure a/(mu h)", path.reached * beyond, 1.87917347, 1e-4, "reference book 2.4 D, shooting (s05)");
}

}  // namespace
}  // namespace snug::tests
