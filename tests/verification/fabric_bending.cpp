// Bending of the garment against the elastica: the cantilever test of fabrics, strips across warp and weft, a sewn loop.
#include <map>

#include "mesh/particles/particle_cloth.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/membrane_scene.hpp"
#include "tests/verification/tube.hpp"

namespace snug::tests {
namespace {

/// A fabric of bending stiffness B and 4 B along the weft, hardly stretched: of effective thickness sqrt(12 B/k).
materials::Fabric bending_fabric(double B, double thickness) {
  materials::Fabric fabric = isotropic(12.0 * B / (thickness * thickness), 0.0);
  fabric.bending = {B, 4.0 * B};
  return fabric;
}

/// A strip from x = -L to L, 2 cells across, held along its middle and hanging the same way on both sides: where the halves
/// meet it is clamped, and the moment goes on.
Sheet strip(int cells, double L, const materials::Fabric& fabric) {
  Sheet sheet(mapped_sheet(2 * cells, 2, [=](double u, double v) { return Plane(L * (2.0 * u - 1.0), 2.0 * L / cells * v); }), fabric);
  sheet.hold({0, 1, 2}, [](const Plane& x) { return std::abs(x.x()) < 1e-9; });
  for (int node = 0; node < sheet.size(); ++node)
    if (const Plane& x = sheet.mesh.pattern[node]; x.x() < -1e-9)
      sheet.master[sheet.layout["garment"](node, 2)] = sheet.layout["garment"](sheet.node_at({-x.x(), x.y()}), 2);
  sheet.eta = 1.0;  // what it does in compression is not asked here
  return sheet;
}

// A strip that hangs over an edge by its own weight, q = w L^3/B (Peirce's cantilever; bending length c = (B/w)^(1/3) = L/2
// at q = 8, where the chord falls at 41.5 degrees), comes to the place of the heavy elastica.
TEST(FabricBending, AStripUnderItsOwnWeightHangsAsTheHeavyElastica) {
  struct Row { double q, x, y; };
  const double L = 0.03, w = 2.1;
  for (const Row& row : {Row{2.0, 0.9668929469, 0.2385065829}, Row{8.0, 0.7244247341, 0.6406307174}, Row{20.0, 0.4452320522, 0.8298814434}}) {
    const double B = w * L * L * L / row.q;
    Sheet sheet = strip(40, L, bending_fabric(B, 1e-2 * L));
    solver::add_weight(sheet.mesh, {w / 9.80665}, {0.0, 0.0, -9.80665}, sheet.forces);
    sheet.settings.first_step = 0.1, sheet.settings.intermediate_residual = 1e-6;
    sheet.solve();
    const Eigen::Vector3d tip = sheet.at(sheet.node_at({L, L / 40}));
    const std::string scene = fmt::format("fabric cantilever, w L^3/B = {}", row.q);
    book(scene, "x of the tip over L", tip.x() / L, row.x, 1e-3, "reference book 2.3: heavy elastica (s04)");
    book(scene, "fall of the tip over L", -tip.z() / L, row.y, 1e-3, "reference book 2.3: heavy elastica (s04)");
    if (row.q == 8.0) book(scene, "angle of the chord, deg", std::atan2(-tip.z(), tip.x()) * 180.0 / std::numbers::pi, 41.5, 2e-3, "Peirce, J. Textile Inst. 21 (1930) T377");
  }
}

// Under a small weight w a cantilever of length L sinks by w L^4/(8 B): B of the warp for a strip cut along it, of the weft for
// one across; the finer the nearer.
TEST(FabricBending, StripsAlongWarpAndWeftBendByTheirOwnStiffness) {
  const double L = 0.03, B = 2e-6;
  for (const bool along : {true, false}) {
    const double stiffness = along ? B : 4.0 * B, w = 1e-3 * L * 8.0 * stiffness / std::pow(L, 4);
    const auto sag = [&](int cells) {
      Sheet sheet = strip(cells, L, bending_fabric(B, 1e-2 * L));
      if (!along) sheet.mesh.warp.assign(sheet.mesh.triangles.size(), Plane::UnitY());
      solver::add_weight(sheet.mesh, {w / 9.80665}, {0.0, 0.0, -9.80665}, sheet.forces);
      sheet.solve();
      return -sheet.at(sheet.node_at({L, L / cells})).z() * 8.0 * stiffness / (w * std::pow(L, 4));
    };
    const double coarse = sag(20), fine = sag(40);
    book(fmt::format("fabric strip along the {}", along ? "warp" : "weft"), "sag 8 B/(w L^4)", fine, 1.0, 1e-3, "beam theory");
    EXPECT_LT(std::abs(fine - 1.0), 0.7 * std::abs(coarse - 1.0));
  }
}

// Half of a cantilever is of a fabric four times as stiff, the half at its end of the other: under a small weight w it sinks by
// int M (L - x)/B dx = w/8 ((L^4 - (L/2)^4)/B1 + (L/2)^4/B2), which needs the slope to go on over the edge between the two.
TEST(FabricBending, AStripOfTwoFabricsBendsEachByItsOwnAndKeepsItsSlopeBetweenThem) {
  const double L = 0.03, B1 = 8e-6, B2 = 2e-6, w = 1e-3 * L * 8.0 * B2 / std::pow(L, 4);
  const auto sag = [&](int cells) {
    Sheet sheet = strip(cells, L, bending_fabric(B1, 1e-2 * L));
    sheet.zones = {bending_fabric(B2, 1e-2 * L)};
    for (const auto& t : sheet.mesh.triangles)
      sheet.mesh.triangle_zone.push_back(std::abs(sheet.mesh.pattern[t[0]].x() + sheet.mesh.pattern[t[1]].x() + sheet.mesh.pattern[t[2]].x()) > 1.5 * L ? 0 : -1);
    solver::add_weight(sheet.mesh, {w / 9.80665, w / 9.80665}, {0.0, 0.0, -9.80665}, sheet.forces);
    sheet.solve();
    return -sheet.at(sheet.node_at({L, L / cells})).z();
  };
  const double exact = w / 8.0 * ((std::pow(L, 4) - std::pow(L / 2, 4)) / B1 + std::pow(L / 2, 4) / B2);
  const double coarse = sag(20) / exact, fine = sag(40) / exact;
  book("fabric strip of two fabrics", "sag over that of a beam", fine, 1.0, 1e-3, "beam theory");
  EXPECT_LT(std::abs(fine - 1.0), 0.7 * std::abs(coarse - 1.0));
}

// A strip sewn to a loop is round, M = 2 pi B/L everywhere, whatever it is placed as; its seam is held flat by what it joins.
TEST(FabricBending, ASewnLoopIsRound) {
  const double L = 0.06, B = 2e-6, width = L / 12;
  Sheet sheet(mapped_sheet(36, 3, [=](double u, double v) { return Plane(L * u, width * v); }), bending_fabric(B, 1e-2 * L));
  sheet.eta = 1.0;
  sheet.sew([](const Plane& x) { return x.x() < 1e-9; }, [=](const Plane& x) { return x.x() > L - 1e-9; });
  const double radius = L / (2.0 * std::numbers::pi);
  for (int node = 0; node < sheet.size(); ++node) {
    const Plane& x = sheet.mesh.pattern[sheet.mesh.merged[node]];
    const double angle = x.x() / radius;
    sheet.mesh.placed[node] = {1.2 * radius * std::cos(angle), 0.78 * radius * std::sin(angle), x.y()};
  }
  // As a body it may not move: one node stands, another one stays in its plane, a third one at its height.
  sheet.hold({0, 1, 2}, [](const Plane& x) { return x.norm() < 1e-9; });
  sheet.hold({1, 2}, [=](const Plane& x) { return (x - Plane(0.5 * L, 0.0)).norm() < 1e-9; });
  sheet.hold({2}, [=](const Plane& x) { return (x - Plane(L * 9 / 36, 0.0)).norm() < 1e-9; });
  sheet.solve();
  const double energy = solver::FabricBending("garment", sheet.layout["garment"], sheet.mesh, {sheet.fabric.bending}).energy(sheet.answer.state);
  book("sewn loop", "bending energy L/(B width)", energy * L / (B * width), 19.7392088, 2e-3, "reference book 2.3: welded seam, 2 pi^2");
  const double across = (sheet.at(sheet.node_at({0.0, 0.0})) - sheet.at(sheet.node_at({0.5 * L, 0.0}))).norm();
  const double deep = (sheet.at(sheet.node_at({0.25 * L, 0.0})) - sheet.at(sheet.node_at({0.75 * L, 0.0}))).norm();
  book("sewn loop", "its two diameters", deep / across, 1.0, 1e-3, "a circle");
}

// With a bending stiffness that goes to nothing a tight sleeve is the membrane's: its pressures are those of the scene without the term, and with a thousand times
// that stiffness more than a hundred times as far from them.
TEST(FabricBending, ASleeveThatHardlyBendsPressesAsAMembrane) {
  TubeCase tube;
  tube.around = 12, tube.along = 3, tube.through = 1, tube.tier = input::Tier::L1, tube.taper = 0.1;
  const std::string fabric = tube.fabric;
  const auto pressures = [&](double B) {
    tube.fabric = fabric + fmt::format("\nB = '{:.17g} N m'", B);
    input::Case c = describe_tube(tube);
    c.contacts.front().friction = 0.5;
    c.garments.front().bending = B > 0.0;
    const postproc::RunResult run = tests::solve(c, make_meshes(c));
    EXPECT_EQ(run.status, postproc::Status::converged) << run.message;
    Eigen::VectorXd forces(run.samples.size());
    for (std::size_t i = 0; i < run.samples.size(); ++i) forces[i] = run.samples[i].force;
    return forces;
  };
  const Eigen::VectorXd membrane = pressures(0.0);
  const auto off = [&](double B) { return (pressures(B) - membrane).norm() / membrane.norm(); };
  const double faint = off(1e-11), light = off(1e-8);
  book("sleeve that hardly bends", "pressures off the membrane's, B 1e-11 N m", faint, 0.0, 1e-7, "B to 0");
  EXPECT_GT(light, 100.0 * faint);
}

/// The same strip as particles at the corners of its triangles, at rest: the place of its end.
Eigen::Vector3d tip_of_particles(const Sheet& strip, double weight, double L) {
  const mesh::TensileCurve curve = [k = strip.fabric.warp.at(0.0).stiffness](double s) {
    return mesh::Tensile{0.5 * k * (s - 1.0) * (s - 1.0), k * (s - 1.0), k};
  };
  mesh::ClothSheet sheet{.laws = {{curve, curve, strip.fabric.shear, strip.fabric.bending.warp, strip.fabric.bending.weft, weight / 9.80665}}, .drag = 0.5};
  std::map<int, int> number;
  mesh::Places places;
  std::vector<mesh::HeldComponents> held;
  for (const auto& t : strip.mesh.triangles) {
    mesh::FlatTriangle& flat = sheet.triangles.emplace_back();
    for (int a = 0; a < 3; ++a) {
      const auto [it, fresh] = number.emplace(t[a], static_cast<int>(places.size()));
      if (fresh) places.push_back(strip.mesh.placed[t[a]]), held.push_back(std::abs(places.back().x()) < 1e-9 ? mesh::held_all : 0);
      flat.particles[a] = it->second, flat.flat[a] = strip.mesh.pattern[t[a]];
    }
  }
  mesh::ParticleCloth cloth(std::move(sheet), places, held);
  double dt = 1e-3;
  for (int n = 0; n < 200; ++n) {
    cloth.step(dt);
    double fastest = 1e-9;
    for (const Eigen::Vector3d& v : cloth.velocities()) fastest = std::max(fastest, v.norm());
    dt = std::clamp(std::min(1.5 * dt, 0.05 * L / fastest), 1e-5, 2.0);
  }
  const auto end = std::max_element(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); }) - places.begin();
  return cloth.places()[end];
}

// Over the edge of a table a strip of particles sags as one of the bending shell does: its end within 10 % (issue of garments; the coarser of
// the meshes is as a scene of particles has it, some ten cells over what hangs).
TEST(FabricBending, AStripOfParticlesSagsAsTheBendingShell) {
  const double L = 0.03, w = 2.1;
  for (const double q : {2.0, 8.0}) {
    const double B = w * L * L * L / q;
    const auto sag = [&](int cells, bool particles) {
      Sheet sheet = strip(cells, L, bending_fabric(B, 1e-2 * L));
      if (particles) return -tip_of_particles(sheet, w, L).z() / L;
      solver::add_weight(sheet.mesh, {w / 9.80665}, {0.0, 0.0, -9.80665}, sheet.forces);
      sheet.settings.first_step = 0.1, sheet.settings.intermediate_residual = 1e-6;
      sheet.solve();
      return -sheet.at(sheet.node_at({L, L / cells})).z() / L;
    };
    const double shell = sag(20, false), coarse = sag(10, true), fine = sag(20, true);
    const std::string scene = fmt::format("strip of particles over an edge, w L^3/B = {}", q);
    book(scene, "fall of the tip over L, 10 cells", coarse, shell, 0.05, "own bending shell");
    book(scene, "fall of the tip over L, 20 cells", fine, shell, 0.02, "own bending shell");
  }
}

}  // namespace
}  // namespace snug::tests
