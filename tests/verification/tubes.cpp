// Tubes and spheres under pressure against exact radial solutions (reference book 1.4 to 1.8).
#include <map>

#include "tests/verification/book.hpp"
#include "tests/verification/rings.hpp"

namespace snug::tests {
namespace {

// Reference book 1.5 A: tissue of 20 to 55 mm bonded to a rigid bone under 5 kPa; every kind of cell converges at its rate.
TEST(BondedTube, EveryKindOfCellConvergesAtItsRate) {
  for (const CellKind kind : {CellKind::hex27, CellKind::hex8, CellKind::tet10}) {
    std::array<double, 3> error{};
    for (int level = 0; level < 3; ++level) {
      BlockCase c = tube(0.020, 0.055, {12 << level, 2 << level, 1}, neo_hooke(10.0, 0.49), kind, 0.03 / (1 << level));
      c.hold("bottom", 0.0, 0.0, 0.0);
      c.pressure("top", 5e3);
      error[level] = (1e3 * mean_radius(c, solve(c), "top") - 54.76269347193) / 0.23730652807;
      fmt::print("{} level {}: {:.3e}\n", to_string(kind), level, error[level]);
    }
    const double rate = kind == CellKind::hex8 ? 1.7 : 2.7;  // of the displacement at the surface: at least h^2, h^3
    EXPECT_GE(std::log2(std::abs(error[1] / error[2])), rate) << to_string(kind);
    EXPECT_LE(std::abs(error[2]), kind == CellKind::hex8 ? 2e-2 : 1e-3) << to_string(kind);
  }
}

TEST(BondedTube, EveryPoissonRatioAndLoadMeetsItsRow) {
  struct Row { double nu, p, radius; };
  const Row rows[] = {
      {0.3, 1, 54.11024944713}, {0.3, 5, 50.88440134396}, {0.3, 20, 42.69971739943}, {0.45, 1, 54.76526261357},
      {0.45, 5, 53.84224547386}, {0.45, 20, 50.61813944797}, {0.49, 1, 54.95242653983}, {0.49, 5, 54.76269347193},
      {0.49, 20, 54.05931120938}, {0.499, 1, 54.99522880571}, {0.499, 5, 54.97614945296}, {0.499, 20, 54.90467931111},
      {0.4999, 1, 54.99952274260}, {0.4999, 5, 54.99761376705}, {0.4999, 20, 54.99045587920}, {0.49999, 1, 54.99995227288},
      {0.49999, 5, 54.99976136494}, {0.49999, 20, 54.99904546788}};
  for (const Row& row : rows) {
    BlockCase c = tube(0.020, 0.055, {24, 4, 1}, neo_hooke(10.0, row.nu), CellKind::hex27);
    c.hold("bottom", 0.0, 0.0, 0.0);
    c.pressure("top", 1e3 * row.p);
    book("tube on bone, V1", fmt::format("u_out [mm], nu = {}, p = {} kPa", row.nu, row.p),
         1e3 * mean_radius(c, solve(c), "top") - 55.0, row.radius - 55.0, 1e-4, "reference book 1.5 A");
  }
}

// Reference book 1.7: the same tube with a free bore, from nearly incompressible to nu = 0.49999.
TEST(FreeBore, InnerAndOuterRadiusMeetTheirRows) {
  struct Row { double nu, inner, outer; };
  for (const Row& row : {Row{0.45, 18.82201552737, 54.30977046039}, Row{0.49, 18.90182893683, 54.55553441269},
                         Row{0.499, 18.91983748883, 54.61100947384}, Row{0.4999, 18.92163918864, 54.61656007165},
                         Row{0.49999, 18.92181924770, 54.61711512009}}) {
    BlockCase c = tube(0.020, 0.055, {32, 8, 1}, neo_hooke(10.0, row.nu), CellKind::hex27);
    name_nodes(c.mesh, "x axis", [](const Eigen::Vector3d& x) { return std::abs(x.y()) < 1e-9; });
    name_nodes(c.mesh, "y axis", [](const Eigen::Vector3d& x) { return std::abs(x.x()) < 1e-9; });
    c.hold("x axis", {}, 0.0, {}), c.hold("y axis", 0.0, {}, {});  // lines of symmetry: no rigid motion
    c.pressure("top", 1e3);
    const BlockAnswer a = solve(c);
    book("tube with free bore", fmt::format("u_in [mm], nu = {}", row.nu), 1e3 * mean_radius(c, a, "bottom") - 20.0,
         row.inner - 20.0, 2e-4, "reference book 1.7");
    book("tube with free bore", fmt::format("u_out [mm], nu = {}", row.nu), 1e3 * mean_radius(c, a, "top") - 55.0,
         row.outer - 55.0, 2e-4, "reference book 1.7");
  }
}

class Round final : public mesh::Outline {
 public:
  Eigen::Vector3d at(double turn, double z) const override {
    const double angle = 2.0 * std::numbers::pi * turn;
    return {0.055 * std::cos(angle), 0.055 * std::sin(angle), z};
  }
};

// Reference book 1.7: that tube under a sleeve T = 200 (l - 1) N/m of rest radius 44 mm, which closes its bore.
TEST(FreeBore, ASleeveClosesItAsItsRowsSay) {
  struct Row { double nu, inner, outer, pressure; };
  const Row rows[] = {{0.45, 18.96714732343, 54.39559380361, 0.86868615274},
                      {0.49, 19.02311245192, 54.60402061796, 0.88272059772},
                      {0.499, 19.03596798932, 54.65196901838, 0.88593406354},
                      {0.4999, 19.03725885275, 54.65678516688, 0.88625652659},
                      {0.49999, 19.03738791532, 54.65726696811, 0.88628878225}};
  const double length = 0.0075;
  for (const Row& row : rows) {
    BlockCase c = tube(0.020, 0.055, {40, 8, 1}, neo_hooke(10.0, row.nu), CellKind::hex27, length);
    name_nodes(c.mesh, "x axis", [](const Eigen::Vector3d& x) { return std::abs(x.y()) < 1e-9; });
    name_nodes(c.mesh, "y axis", [](const Eigen::Vector3d& x) { return std::abs(x.x()) < 1e-9; });
    c.hold("x axis", {}, 0.0, {}), c.hold("y axis", 0.0, {}, {});
    c.mesh.skin_facets = c.mesh.surface("top")->facets;
    c.mesh.mean_skin_cell = mesh::mean_edge(c.mesh, c.mesh.skin_facets);
    c.c.contacts.emplace_back();
    c.c.contacts.front().friction = 0.0;
    input::GarmentSpec& sleeve = c.c.garments.emplace_back();
    sleeve.position = 0.0;
    sleeve.pattern.flat_circumference = 2.0 * std::numbers::pi * 0.044, sleeve.pattern.length = length;
    sleeve.fabric.table = input::table_of("law = 'cubic'\nk1 = '200 N/m'\nk3 = '0 N/m'\nshear = '60 N/m'\npoisson = 0");
    sleeve.held = {{.edge = "upper", .held = input::HeldDirection::axis}, {.edge = "lower", .held = input::HeldDirection::axis}};
    mesh::Limb limb;
    limb.skin = std::make_unique<Round>(), limb.upper = length;
    const mesh::GarmentMesh garment = mesh::make_tube_mesh(sleeve, limb, 0.5 * c.mesh.mean_skin_cell);
    solver::Scene scene = tests::make_scene(c.c, c.mesh, garment, solver::Skin::deformable);
    solver::PathSettings settings;
    settings.newton.penetration = 1e-6 * garment.mean_edge;
    BlockAnswer a;
    a.path = solver::follow_path(scene, tests::placed_state(scene.layout(), c.mesh, garment), solver::tightening(), settings,
                                 [](const postproc::Iteration&) {});
    EXPECT_TRUE(a.path.complete) << a.path.message;
    a.result.body = solver::body_result(c.mesh, true);
    tests::fill_result(scene, a.path.state, c.mesh, garment, a.result);
    const std::string name = fmt::format("free bore under a sleeve, nu = {}", row.nu), source = "reference book 1.7";
    book(name, "u_in [mm]", 1e3 * mean_radius(c, a, "bottom") - 20.0, row.inner - 20.0, 1e-4, source);
    book(name, "u_out [mm]", 1e3 * mean_radius(c, a, "top") - 55.0, row.outer - 55.0, 1e-4, source);
    book(name, "pressure, kPa", 1e-3 * a.result.numbers.at("mean_contact_pressure_Pa"), row.pressure, 1e-4, source);
  }
}

// Reference book 1.4: pressure inside a tube of A = 10, B = 20 mm for a bore of 1.25 and 1.5 A, at axial stretch 1 and 1.2.
TEST(Inflation, ThePressureOfAnIncompressibleTubeOpensItsBore) {
  struct Row { double stretch, pressure, bore; };
  for (const Row& row : {Row{1.0, 2.757115368034, 1.25}, Row{1.0, 4.282284090965, 1.5}, Row{1.2, 2.991510013633, 1.25},
                         Row{1.2, 4.043599895351, 1.5}}) {
    BlockCase c = tube(0.010, 0.020, {24, 8, 1}, neo_hooke(10.0, 0.49999), CellKind::hex27, 2e-3);
    name_nodes(c.mesh, "x axis", [](const Eigen::Vector3d& x) { return std::abs(x.y()) < 1e-9; });
    name_nodes(c.mesh, "y axis", [](const Eigen::Vector3d& x) { return std::abs(x.x()) < 1e-9; });
    c.hold("x axis", {}, 0.0, {}), c.hold("y axis", 0.0, {}, {});
    c.c.support[1].z = 2e-3 * (row.stretch - 1.0);
    c.pressure("bottom", 1e3 * row.pressure);
    book("inflated tube, nu = 0.49999", fmt::format("a / A at axial stretch {}, Pi = {:.4f} kPa", row.stretch, row.pressure),
         mean_radius(c, solve(c), "bottom") / 0.010, row.bore, 2e-4, "reference book 1.4, incompressible");
  }
}

// Reference book 1.5 A, the logarithmic and the quadratic volume energy (V2, V3).
TEST(BondedTube, TheOtherVolumeEnergiesMeetTheirRows) {
  struct Row { const char* form; double radius; };
  for (const Row& row : {Row{"logarithmic", 54.76499320790}, Row{"quadratic", 54.76151314491}}) {
    BlockCase c = tube(0.020, 0.055, {24, 4, 1}, neo_hooke(10.0, 0.49) + fmt::format("\nvolumetric = '{}'", row.form), CellKind::hex27);
    c.hold("bottom", 0.0, 0.0, 0.0);
    c.pressure("top", 5e3);
    book("tube on bone, nu = 0.49, 5 kPa", fmt::format("u_out [mm], {} volume energy", row.form),
         1e3 * mean_radius(c, solve(c), "top") - 55.0, row.radius - 55.0, 1e-4, "reference book 1.5 A");
  }
}

/// Muscle 20 to 45, fat to 53, skin to 55 mm of 8, 3 and 50 kPa; w along the axis.
BlockCase three_layers(std::array<int, 2> cells, double nu, double length) {
  Block block;
  block.cells = {cells[0], cells[1] + 3, 1}, block.closed = true;  // two of the outer cells are fat, one is skin
  block.layers = {"muscle", "fat", "skin"};
  const double rows = cells[1] + 3;
  const auto radius = [=](double v) {
    const double row = v * rows - cells[1];
    return row <= 0.0 ? 0.045 + 0.025 * row / cells[1] : row <= 2.0 ? 0.045 + 0.004 * row : 0.053 + 0.002 * (row - 2.0);
  };
  block.layer = [=](const Eigen::Vector3d& m) { return m.y() * rows < cells[1] ? 0 : m.y() * rows < cells[1] + 2 ? 1 : 2; };
  block.map = [=](const Eigen::Vector3d& u) {
    const double r = radius(u.y()), a = -2.0 * std::numbers::pi * u.x();
    return Eigen::Vector3d(r * std::cos(a), r * std::sin(a), length * u.z());
  };
  return BlockCase(make_block(block), {neo_hooke(8.0, nu), neo_hooke(3.0, nu), neo_hooke(50.0, nu)});
}

double radius_of(const BlockCase& c, const BlockAnswer& a, double reference) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t node = 0; node < c.mesh.nodes.size(); ++node)
    if (std::abs(c.mesh.nodes[node].head<2>().norm() - reference) < 1e-6)
      sum += (c.mesh.nodes[node] + a.result.body.fields[postproc::field::displacement][node]).head<2>().norm(), ++count;
  return sum / count;
}

// Reference book 1.5 B: muscle, fat and skin on a rigid bone; every interface comes to its radius.
TEST(BondedTube, ThreeLayersMeetTheirRows) {
  struct Row { double nu, p, muscle, fat, skin; };
  const Row rows[] = {
      {0.45, 1, 44.78549194160, 52.59603970653, 54.60464824262}, {0.45, 5, 43.94749325828, 51.05427556091, 53.09612568805},
      {0.45, 20, 41.09474577223, 46.26795586537, 48.41467325051}, {0.49, 1, 44.95535274414, 52.91387464612, 54.91612250308},
      {0.49, 5, 44.77747164113, 52.57223679692, 54.58344544045}, {0.49, 20, 44.12066792200, 51.33275924045, 53.37705610998},
      {0.499, 1, 44.99549114233, 52.99125207597, 54.99149061969}, {0.499, 5, 44.97746250272, 52.95628842013, 54.95748089972},
      {0.499, 20, 44.90995206715, 52.82557555661, 54.83034179791}, {0.4999, 1, 44.99954866154, 52.99912381830, 54.99914781470},
      {0.4999, 5, 44.99774337531, 52.99561937120, 54.99573935090}, {0.4999, 20, 44.99097451549, 52.98248168181, 54.98296156578}};
  for (const Row& row : rows) {
    BlockCase c = three_layers({24, 4}, row.nu, 3e-3);
    c.hold("back", {}, {}, 0.0), c.hold("front", {}, {}, 0.0);
    c.hold("bottom", 0.0, 0.0, 0.0);
    c.pressure("top", 1e3 * row.p);
    const BlockAnswer a = solve(c);
    const std::string scene = fmt::format("three layers on bone, nu = {}, p = {} kPa", row.nu, row.p);
    for (const auto& [at, exact] : {std::pair{45.0, row.muscle}, {53.0, row.fat}, {55.0, row.skin}})
      book(scene, fmt::format("displacement at {} mm [mm]", at), 1e3 * radius_of(c, a, 1e-3 * at) - at, exact - at, 1e-4,
           "reference book 1.5 B");
  }
}

// Reference book 1.8: incompressible layers round a bone they slide on along its axis; the length that leaves no axial
// resultant on the ends. The ends stay plane: their displacement is sought by the secant rule.
TEST(FrictionlessBone, TheEndsComeToTheirPlaceWithoutAxialForce) {
  struct Row { bool layered; double p, stretch, radius, bone; };
  const double length = 3e-3;
  for (const Row& row : {Row{false, 0.5, 1.01597605460, 54.62345934935, 0.6346302583},
                         Row{false, 2.0, 1.06399082924, 53.54555562934, 2.4950815648},
                         Row{true, 1.0, 1.03232680978, 54.24757512778, 1.2163145213}}) {
    const auto at_stretch = [&](double stretch) {
      BlockCase c = row.layered ? three_layers({24, 4}, 0.499999, length)
                                : tube(0.020, 0.055, {24, 4, 1}, neo_hooke(10.0, 0.499999), CellKind::hex27, length);
      c.c.support.clear();
      c.hold("bottom", 0.0, 0.0, {});
      c.hold("back", {}, {}, 0.0), c.hold("front", {}, {}, length * (stretch - 1.0));
      c.pressure("top", 1e3 * row.p);
      BlockAnswer a = solve(c);
      return std::tuple{a.result.balance.reactions.at("front").z(), 1e3 * mean_radius(c, a, "top"), std::move(a)};
    };
    double l0 = 1.0, l1 = row.stretch + 0.005, f0 = std::get<0>(at_stretch(l0)), radius = 0.0;
    for (int k = 0; k < 6 && std::abs(l1 - l0) > 1e-7; ++k) {
      const auto [f1, r, answer] = at_stretch(l1);
      const double l2 = l1 - f1 * (l1 - l0) / (f1 - f0);
      l0 = l1, f0 = f1, l1 = l2, radius = r;
    }
    const std::string scene = fmt::format("{} on a frictionless bone, p = {} kPa", row.layered ? "three layers" : "tube", row.p);
    book(scene, "axial stretch - 1", l1 - 1.0, row.stretch - 1.0, 1e-4, "reference book 1.8, incompressible");
    book(scene, "u_out [mm]", radius - 55.0, row.radius - 55.0, 1e-4, "reference book 1.8, incompressible");
  }
}

/// The positive octant of a spherical shell: three patches of a cubed sphere with n x n cells each.
BodyMesh octant(int n, int through, double inner, double outer) {
  BodyMesh mesh;
  mesh.layers.push_back({"tissue", {}});
  std::map<std::array<int, 4>, int> number;
  const auto node = [&](std::array<int, 3> key, int k) {
    const auto [it, fresh] = number.try_emplace({key[0], key[1], key[2], k}, static_cast<int>(mesh.nodes.size()));
    if (fresh) {
      Eigen::Vector3d d;
      for (int c = 0; c < 3; ++c) d[c] = std::tan(0.25 * std::numbers::pi * key[c] / (2.0 * n));
      mesh.nodes.push_back((inner + (outer - inner) * k / (2.0 * through)) * d.normalized());
    }
    return it->second;
  };
  mesh::Surface bore{"bore", {}, {}};
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < through; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          auto& cell = mesh.cells.emplace_back();
          for (int a = 0; a < 27; ++a) {
            std::array<int, 3> key;
            key[axis] = 2 * n, key[(axis + 1) % 3] = 2 * i + a % 3, key[(axis + 2) % 3] = 2 * j + a / 3 % 3;
            cell[a] = node(key, 2 * k + a / 9);
          }
          mesh.cell_layer.push_back(0);
        }
  std::vector<char> inside(mesh.nodes.size(), 0);
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    if (mesh.nodes[a].norm() < inner * (1.0 + 1e-9)) inside[a] = 1, bore.nodes.push_back(static_cast<int>(a));
  bore.facets = boundary_facets(mesh, inside);
  mesh.surfaces.push_back(std::move(bore));
  mesh.node_location.assign(mesh.nodes.size(), -1);
  return mesh;
}

// Reference book 1.4: pressure inside a spherical shell of A = 10, B = 20 mm, below and near its limit point.
TEST(Inflation, ThePressureOfAnIncompressibleSphereOpensItsBore) {
  struct Row { double pressure, bore; };
  for (const Row& row : {Row{2.871548459343, 1.1}, Row{5.518685419794, 1.25}}) {
    BlockCase c(octant(3, 6, 0.010, 0.020), {neo_hooke(10.0, 0.49999)});
    for (int axis = 0; axis < 3; ++axis) {
      const std::string name = std::string("plane ") + "xyz"[axis];
      name_nodes(c.mesh, name, [&](const Eigen::Vector3d& x) { return std::abs(x[axis]) < 1e-12; });
      std::array<std::optional<double>, 3> held;
      held[axis] = 0.0;
      c.hold(name, held[0], held[1], held[2]);
    }
    c.pressure("bore", 1e3 * row.pressure);
    const BlockAnswer a = solve(c);
    double bore = 0.0;
    const auto& nodes = c.mesh.surface("bore")->nodes;
    for (const int n : nodes) bore += (c.mesh.nodes[n] + a.result.body.fields[postproc::field::displacement][n]).norm() / nodes.size();
    book("inflated sphere, nu = 0.49999", fmt::format("a / A - 1 at Pi = {:.4f} kPa", row.pressure), bore / 0.010 - 1.0,
         row.bore - 1.0, 1e-4, "reference book 1.4, incompressible");
  }
}

// Reference book 1.4, Rivlin's flexure: a block of thickness 1 bent to the curvature 0.5 by its end faces, whose places
// are prescribed; the moment on them. Its other faces are free and must come to the radii of the exact solution.
TEST(Flexure, TheMomentOfABentBlock) {
  struct Row { double curvature, inner, outer, moment; };
  for (const Row& row : {Row{0.25, 3.534462123502, 4.526855697111, 0.081821120431},
                         Row{0.5, 1.572302755515, 2.544039299028, 0.155610338631}}) {
    Block block;
    block.cells = {8, 8, 1};
    block.map = [](const Eigen::Vector3d& u) { return Eigen::Vector3d(u.x(), u.y() - 0.5, 0.1 * u.z()); };
    BlockCase c(make_block(block), {neo_hooke(1.0, 0.49999)});
    c.hold("back", {}, {}, 0.0), c.hold("front", {}, {}, 0.0);
    const auto exact = [&](const Eigen::Vector3d& x) {  // thickness along x, angle along y
      const double r = std::sqrt(row.inner * row.inner + 2.0 * x.x() / row.curvature), angle = row.curvature * x.y();
      return Eigen::Vector3d(r * std::cos(angle) - row.inner, r * std::sin(angle), x.z());
    };
    for (const char* end : {"bottom", "top"})
      for (const int node : c.mesh.surface(end)->nodes)
        for (int component = 0; component < 2; ++component)
          c.mesh.held.push_back({node, component, (exact(c.mesh.nodes[node]) - c.mesh.nodes[node])[component]});
    const BlockAnswer a = solve(c);
    const mesh::GarmentMesh none;
    const solver::Scene scene = tests::make_scene(c.c, c.mesh, none, solver::Skin::deformable);
    const Eigen::VectorXd residual = scene.full_residual(a.path.state);
    double moment = 0.0;
    for (const int node : c.mesh.surface("top")->nodes) {
      const Eigen::Vector3d x = a.path.state.values.segment<3>(scene.layout()["body"](node)) + Eigen::Vector3d(row.inner, 0.0, 0.0);
      const Eigen::Vector3d f = residual.segment<3>(scene.layout()["body"](node));
      moment += (x.x() * f.y() - x.y() * f.x()) / 0.1;
    }
    const std::string scene_name = fmt::format("flexure of a block, curvature {}", row.curvature);
    book(scene_name, "moment over mu H^2", 1e-3 * moment, row.moment, 1e-4, "reference book 1.4, Rivlin");
    const double outer = row.inner + 1.0 + a.displacement(c.mesh, {1.0, 0.0, 0.0}).x();
    book(scene_name, "outer radius over H", outer, row.outer, 1e-4, "reference book 1.4, Rivlin");
  }
}

}  // namespace
}  // namespace snug::tests
