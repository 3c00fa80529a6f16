// Bodies under loads and moved supports against exact solutions, in every kind of cell.
#include <Eigen/Geometry>

#include "tests/verification/blocks.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/rings.hpp"
#include "tests/verification/tube.hpp"

namespace snug::tests {
namespace {

const std::array kinds = {CellKind::hex27, CellKind::hex8, CellKind::tet10};

// A cube of tetrahedra or hexahedra under uniform pressure shrinks alike in all directions by the law's own p(J).
TEST(Patch, UniformPressureShrinksEveryKindOfCellAlike) {
  for (const CellKind kind : kinds) {
    Block block;
    block.cells = {2, 2, 2}, block.kind = kind;
    block.map = [](const Eigen::Vector3d& u) {  // cells that are no boxes
      const double b = 0.05 * std::sin(std::numbers::pi * u.x()) * std::sin(std::numbers::pi * u.y()) *
                       std::sin(std::numbers::pi * u.z());
      return Eigen::Vector3d(u + Eigen::Vector3d(b, -b, 0.5 * b));
    };
    BlockCase c(make_block(block), {neo_hooke_bulk(10.0, 1000.0)});
    c.hold("left", 0.0, {}, {}), c.hold("bottom", {}, 0.0, {}), c.hold("back", {}, {}, 0.0);
    for (const char* face : {"right", "top", "front"}) c.pressure(face, 51315.7894737);
    const Eigen::Vector3d u = solve(c).displacement(c.mesh, {1.0, 1.0, 1.0});
    for (int i = 0; i < 3; ++i)
      book("cube of " + to_string(kind) + " under pressure", fmt::format("J from u_{}", "xyz"[i]), std::pow(1.0 + u[i], 3),
           0.95, 1e-9, "p(J) of the law: reference book 1.3, V1");
  }
}

// Nodes at which two supports meet answer to each with the components that it holds: a cube under uniform pressure pushes
// every face that holds it with the pressure times the face, straight on.
TEST(Supports, ShareTheNodesAtWhichTheyMeetByComponents) {
  Block block;
  block.cells = {2, 2, 2};
  BlockCase c(make_block(block), {neo_hooke(10.0, 0.49)});
  const std::array<const char*, 3> held = {"left", "bottom", "back"}, pressed = {"right", "top", "front"};
  c.hold(held[0], 0.0, {}, {}), c.hold(held[1], {}, 0.0, {}), c.hold(held[2], {}, {}, 0.0);
  for (const char* face : pressed) c.pressure(face, 1e3);
  const BlockAnswer a = solve(c);
  const double J = std::pow(1.0 + a.displacement(c.mesh, {1.0, 1.0, 1.0}).x(), 3);
  for (int i = 0; i < 3; ++i)
    EXPECT_LE((a.result.balance.reactions.at(held[i]) - 1e3 * std::cbrt(J * J) * Eigen::Vector3d::Unit(i)).norm(), 1e-6) << held[i];
}

/// Strain e of a bar of St. Venant & Kirchhoff's law with nu = 0 under the traction r E: (1 + e) e (2 + e) / 2 = r.
double strain(double r) {
  double e = r;
  for (int i = 0; i < 50; ++i) e -= (0.5 * (1.0 + e) * e * (2.0 + e) - r) / (1.0 + 3.0 * e + 1.5 * e * e);
  return e;
}

// A bar in tension whose middle third is up to 1e6 times stiffer: end displacement and strain of the stiff layer.
TEST(SeriesBar, AContrastOfAMillionKeepsTheStiffLayersStrain) {
  for (const CellKind kind : kinds)
    for (const double contrast : {1e2, 1e4, 1e6}) {
      Block block;
      block.cells = {3, 1, 1}, block.kind = kind;
      block.layers = {"soft", "stiff"};
      block.layer = [](const Eigen::Vector3d& m) { return m.x() > 0.34 && m.x() < 0.66 ? 1 : 0; };
      block.map = [](const Eigen::Vector3d& u) { return Eigen::Vector3d(3.0 * u.x(), u.y(), u.z()); };
      const auto elastic = [](double E) {
        return fmt::format("law = 'linear-elastic'\nyoungs_modulus = '{:.17g} kPa'\npoisson_ratio = 0", E);
      };
      BlockCase c(make_block(block), {elastic(1.0), elastic(contrast)});
      c.hold("left", 0.0, {}, {}), c.hold("bottom", {}, 0.0, {}), c.hold("back", {}, {}, 0.0);
      c.traction("right", 1e3, 0.0, 0.0);
      const BlockAnswer a = solve(c);
      const double end = a.displacement(c.mesh, {3, 0, 0}).x();
      const double stiff = a.displacement(c.mesh, {2, 0, 0}).x() - a.displacement(c.mesh, {1, 0, 0}).x();
      const double exact = strain(1.0 / contrast);
      book("series bar of " + to_string(kind), fmt::format("end displacement, contrast {:g}", contrast), end,
           2.0 * strain(1.0) + exact, 1e-9, "reference book 4 C, closed form of the law");
      book("series bar of " + to_string(kind), fmt::format("strain of the stiff layer, contrast {:g}", contrast), stiff,
           exact, 1e-7, "reference book 4 C, closed form of the law");
    }
}

/// A bar of 1 x 1 x 4 that a pressure which follows it pulls along by its end face, whose border is free.
BlockCase pulled_bar(CellKind kind, double poisson_ratio, double tension) {
  Block block;
  block.cells = {4, 1, 1}, block.kind = kind;
  block.map = [](const Eigen::Vector3d& u) { return Eigen::Vector3d(4.0 * u.x(), u.y(), u.z()); };
  BlockCase c(make_block(block), {neo_hooke(10.0, poisson_ratio)});
  c.pressure("right", -tension);
  return c;
}

// Stress s of an incompressible neo-Hookean bar follows from its stretch l by s = mu (l^2 - 1/l): at s = 2 mu l is the golden
// ratio. The whole load in one increment, with the tangent of a follower pressure, takes at most eight iterations, however
// large it is, and so it does in hexahedra where the other end is held and the bar necks there; tetrahedra take twice as many.
TEST(FollowerPressure, PullsABarInEightIterationsAtEveryLoad) {
  const auto iterations = [](const BlockAnswer& a) { return a.history.back().iteration; };
  for (const CellKind kind : kinds)
    for (const double ratio : {0.5, 1.0, 2.0}) {
      BlockCase led = pulled_bar(kind, 0.499999, ratio * 1e4), held = pulled_bar(kind, 0.49, ratio * 1e4);
      led.hold("left", 0.0, {}, {}), led.hold("bottom", {}, 0.0, {}), led.hold("back", {}, {}, 0.0);
      held.hold("left", 0.0, 0.0, 0.0);
      const BlockAnswer a = solve(led, 1.0), b = solve(held, 1.0);
      EXPECT_EQ(a.path.increments, 1);
      EXPECT_EQ(b.path.increments, 1);
      EXPECT_LE(iterations(a), 8) << to_string(kind) << " at " << ratio;
      EXPECT_LE(iterations(b), kind == CellKind::tet10 ? 16 : 8) << to_string(kind) << " at " << ratio;
      double l = 1.0;  // Newton's method on l^2 - 1/l
      for (int i = 0; i < 50; ++i) l -= (l * l - 1.0 / l - ratio) / (2.0 * l + 1.0 / (l * l));
      book("bar of " + to_string(kind) + " under a follower pressure", fmt::format("stretch at {:g} mu", ratio),
           1.0 + a.displacement(led.mesh, {4.0, 0.0, 0.0}).x() / 4.0, l, 1e-5, "s = mu (l^2 - 1/l), incompressible");
    }
}

/// 20 kPa on the bonded tube at nu = 0.3: 12.3 mm.
BlockCase large_load() {
  BlockCase c = tube(0.020, 0.055, {16, 2, 1}, neo_hooke(10.0, 0.3), CellKind::hex27);
  c.hold("bottom", 0.0, 0.0, 0.0);
  c.pressure("top", 20e3);
  return c;
}

TEST(LargeStep, OneStepAndTwentyEndInTheSameState) {
  const BlockCase c = large_load();
  const BlockAnswer one = solve(c, 1.0), twenty = solve(c, 0.05);
  const auto iterations = static_cast<int>(one.history.size());
  fmt::print("one step: {} increments, {} rows; in steps: {} increments\n", one.path.increments, iterations,
             twenty.path.increments);
  EXPECT_TRUE(one.path.increments > 1 || iterations <= 12);  // few iterations, or an automatic cutback
  EXPECT_LE((one.path.state.values - twenty.path.state.values).norm(), 1e-9 * (twenty.path.state.values).norm());
}

TEST(NewtonQuality, TheLastResidualsFallQuadratically) {
  const BlockAnswer a = solve(large_load());
  std::vector<double> r;  // of the last increment
  for (const auto& row : a.history)
    if (row.increment == a.history.back().increment) r.push_back(row.residual);
  ASSERT_GE(r.size(), 3u);
  double best = 0.0;  // the very last one may stand at round-off
  for (std::size_t i = 2; i < r.size(); ++i)
    best = std::max(best, std::log(r[i] / r[i - 1]) / std::log(r[i - 1] / r[i - 2]));
  fmt::print("order {:.2f}\n", best);
  EXPECT_GE(best, 1.8);
}

TEST(FrameIndifference, ATurnedSolutionIsASolution) {
  const BlockCase c = large_load();
  const BlockAnswer a = solve(c);
  const mesh::GarmentMesh none;
  solver::Scene scene = tests::make_scene(c.c, c.mesh, none, solver::Skin::deformable);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(2.0 * std::numbers::pi / 3.0, Eigen::Vector3d::Ones().normalized()).toRotationMatrix();
  solver::State turned = a.path.state;
  for (std::size_t node = 0; node < c.mesh.nodes.size(); ++node)
    turned.values.segment<3>(3 * static_cast<int>(node)) =
        turn * Eigen::Vector3d(a.path.state.values.segment<3>(3 * static_cast<int>(node)));
  Eigen::VectorXd back = scene.full_residual(turned);
  const Eigen::VectorXd before = scene.full_residual(a.path.state);
  for (std::size_t node = 0; node < c.mesh.nodes.size(); ++node)
    back.segment<3>(3 * static_cast<int>(node)) =
        turn.transpose() * Eigen::Vector3d(back.segment<3>(3 * static_cast<int>(node)));
  EXPECT_LE((back - before).norm(), 1e-10 * before.norm());
}

// Bone of E = 10 GPa against tissue of 30 kPa: meshed to its middle, the limb moves as it does on a rigid bone.
TEST(ElasticBone, MovesTheSkinAsARigidOneDoes) {
  TubeCase t;
  t.length = 0.030, t.around = 16, t.along = 2, t.through = 3;
  std::array<double, 2> radius{};
  for (const bool elastic : {false, true}) {
    input::Case c = describe_tube(t);
    c.garments.clear(), c.contacts.clear();
    c.load.emplace().skin_pressure = 5e3;
    if (elastic) {
      c.body->layers[0].form = input::LayerForm::solid, c.body->layers[0].cells = 1;
      c.body->layers[0].material.table = input::table_of("law = 'linear-elastic'\nyoungs_modulus = '10 GPa'\npoisson_ratio = 0.3");
    }
    const postproc::RunResult result = tests::solve(c, make_meshes(c));
    EXPECT_EQ(result.status, postproc::Status::converged) << result.message;
    radius[elastic] = 1e3 * result.numbers.at("mean_skin_radial_displacement_m");
  }
  fmt::print("skin moves by {:.9f} mm on a rigid bone, {:.9f} mm on an elastic one\n", radius[0], radius[1]);
  EXPECT_LE(std::abs(radius[1] - radius[0]), 2e-5);
}

// Reference book 1.4: a turned cylinder of incompressible material, C10 = 4, C01 = 1 kPa: moment and axial force.
TEST(Torsion, MomentAndAxialForceOfATurnedCylinder) {
  const double length = 5e-3, twist = 50.0;  // m, rad/m
  input::BodySpec spec;
  TubeCase t;
  t.bone = 0.004, t.radius = 0.010, t.length = length, t.around = 24, t.along = 1, t.through = 3;
  input::Case c = describe_tube(t);
  c.garments.clear(), c.contacts.clear();
  const std::string law = "law = 'Mooney-Rivlin'\nC10 = '4 kPa'\nC01 = '1 kPa'\nbulk_modulus = '500 MPa'";
  c.body->layers[0].form = input::LayerForm::solid, c.body->layers[0].cells = 1;
  for (auto& layer : c.body->layers) layer.material.table = input::table_of(law);
  c.body->ends = input::Ends::free;
  for (const char* end : {"lower", "upper"}) {
    input::SupportSpec& support = c.support.emplace_back();
    support.on = end, support.x = 0.0, support.y = 0.0, support.z = 0.0;
  }
  c.support[1].turn = twist * length;
  const solver::Meshes meshes = make_meshes(c);
  const mesh::GarmentMesh none;
  solver::Scene scene = tests::make_scene(c, meshes.body, none, solver::Skin::deformable);
  const auto path = solver::follow_path(scene, tests::placed_state(scene.layout(), meshes.body, none),
                                        solver::tightening(), {}, [](const postproc::Iteration&) {});
  ASSERT_TRUE(path.complete) << path.message;
  const Eigen::VectorXd residual = scene.full_residual(path.state);
  double moment = 0.0, axial = 0.0;
  for (const int node : meshes.body.surface("upper")->nodes) {
    const Eigen::Vector3d x = path.state.values.segment<3>(scene.layout()["body"](node));
    const Eigen::Vector3d f = residual.segment<3>(scene.layout()["body"](node));
    moment += x.x() * f.y() - x.y() * f.x(), axial += f.z();
  }
  book("torsion of a cylinder, Mooney-Rivlin", "moment [kPa mm3], 0.05 rad/mm", 1e6 * moment, 7853.9816339745, 2e-4,
       "reference book 1.4, incompressible");
  book("torsion of a cylinder, Mooney-Rivlin", "axial force [kPa mm2], 0.05 rad/mm", 1e3 * axial, -235.6194490192, 2e-3,
       "reference book 1.4, incompressible");
}

// A cantilever ten times as long as deep, four cells along: no locking from nu = 0.499 to 0.49999.
TEST(Cantilever, ACoarseMeshDoesNotLock) {
  for (const CellKind kind : kinds) {
    std::array<double, 2> tip{};
    for (int i = 0; i < 2; ++i) {
      Block block;
      block.cells = {4, 1, 1}, block.kind = kind;
      if (kind == CellKind::hex8) block.cells = {20, 4, 1};
      block.map = [](const Eigen::Vector3d& u) { return Eigen::Vector3d(0.1 * u.x(), 0.01 * u.y(), 0.01 * u.z()); };
      BlockCase c(make_block(block), {neo_hooke(10.0, i == 0 ? 0.499 : 0.49999)});
      c.hold("left", 0.0, 0.0, 0.0);
      c.traction("right", 0.0, 2.0, 0.0);
      const BlockAnswer a = solve(c);
      tip[i] = a.displacement(c.mesh, {0.1, 0.01, 0.01}).y();
      // The supports answer the load of 2 Pa on 1 cm2; round-off of the pressure grows with the bulk modulus.
      const double round_off = i == 0 ? 1e-8 : 1e-7;
      EXPECT_LE(a.result.balance.force_error.norm(), round_off * 2e-4);
      EXPECT_LE(a.result.balance.moment_error.norm(), round_off * 2e-5);
    }
    fmt::print("{}: tip {:.4f} and {:.4f} mm\n", to_string(kind), 1e3 * tip[0], 1e3 * tip[1]);
    EXPECT_LE(std::abs(tip[1] / tip[0] - 1.0), 0.01) << to_string(kind);
  }
}

// A cube whose inner node is thrown far off comes back: its surface is held, so that rest is the only equilibrium.
TEST(Inversion, AMisplacedInnerNodeComesHomeOrIsRefused) {
  Block block;
  block.cells = {2, 2, 2}, block.kind = CellKind::hex8;
  BlockCase c(make_block(block), {neo_hooke(10.0, 0.3)});
  for (const char* face : {"left", "right", "bottom", "top", "back", "front"}) c.hold(face, 0.0, 0.0, 0.0);
  const mesh::GarmentMesh none;
  solver::Scene scene = tests::make_scene(c.c, c.mesh, none, solver::Skin::deformable);
  const auto start = [&](double x) {
    solver::State state = tests::placed_state(scene.layout(), c.mesh, none);
    for (std::size_t node = 0; node < c.mesh.nodes.size(); ++node)
      if ((c.mesh.nodes[node] - Eigen::Vector3d(0.5, 0.5, 0.5)).norm() < 1e-9)
        state.values[scene.layout()["body"](static_cast<int>(node))] = x;
    return state;
  };
  solver::State inverted = start(1.4);  // ln J has no value there: named, not NaN
  EXPECT_EQ(solver::newton(scene, inverted, {}, [](const postproc::Iteration&) {}), solver::Outcome::inadmissible);
  solver::State strained = start(0.8);
  solver::newton(scene, strained, {}, [](const postproc::Iteration&) {});
  EXPECT_LE((strained.values - start(0.5).values).norm(), 1e-9);
}

}  // namespace
}  // namespace snug::tests
