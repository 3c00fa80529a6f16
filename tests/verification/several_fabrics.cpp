// Garments of several fabrics, and tubes whose courses have lengths of their own, on limbs that do not give way.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

#include "mesh/garment/garment_cut.hpp"
#include "mesh/garment/garment_zones.hpp"
#include "mesh/pattern/toml_pattern.hpp"
#include "solver/library/graduated.hpp"
#include "solver/scene/laplace.hpp"
#include "tests/pattern_texts.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/tube.hpp"

namespace snug::tests {
namespace {

/// The knit of the tubes, its stiffness the same along and round, N/m.
std::string knit(double stiffness, double weight = 200.0) {
  return fmt::format("law = 'linear'\nwarp = '{0} N/m'\nweft = '{0} N/m'\nshear = '{1} N/m'\npoisson = 0\nweight = '{2} g/m2'\nthickness = '0.5 mm'", stiffness, 0.3 * stiffness, weight);
}

double radius_of(const TubeCase& tube, double z) { return tube.radius + tube.taper * z; }

/// Mean pressure on the touched skin between two heights.
double ring_pressure(const postproc::RunResult& run, double from, double to) {
  double force = 0.0, area = 0.0;
  for (const postproc::ContactSample& sample : run.samples)
    if (sample.at.z() > from && sample.at.z() < to) force += sample.force, area += sample.area;
  return force / area;
}

struct Worn {
  input::Case c;
  solver::Meshes meshes;
  postproc::RunResult run;
};

/// Two halves on a rigid cylinder, of these stiffnesses.
Worn two_halves(double first, double second) {
  TubeCase tube;
  tube.around = 24, tube.along = 3, tube.through = 1, tube.tier = input::Tier::L1, tube.fabric = knit(first);
  Worn worn{describe_tube(tube), {}, {}};
  input::GarmentSpec& garment = worn.c.garments.front();
  garment.zone = {{.pieces = {"part 1"}, .from_height = 0.0, .to_height = {}, .fabric = {}, .where = {}}};
  garment.zone.front().fabric.table = input::table_of(knit(second, 300.0)), garment.zone.front().fabric.where.line = 1;
  mesh::GarmentCut cut{garment, mesh::checked(mesh::parse_toml_pattern(tube_text(2, 2e3 * std::numbers::pi * tube.sleeve, 1e3 * tube.length), "sleeve.toml"))};
  mesh::settle_fabrics(cut);
  garment = cut.spec;
  worn.meshes.limb = mesh::make_limb(*worn.c.body);
  worn.meshes.body = mesh::make_body_mesh(*worn.c.body, worn.meshes.limb);
  worn.meshes.garments.push_back(mesh::make_garment_mesh(cut, worn.meshes.limb, 0.006));
  worn.run = tests::solve(worn.c, worn.meshes);
  return worn;
}

// Round a cylinder without friction both halves bear one tension T = K E(l) l, and their stretches add up to twice that of the whole: what
// presses is T/r, and every seam transmits T.
TEST(SeveralFabrics, HalvesOfTwoStiffnessesBearOneTensionRoundACylinder) {
  const TubeCase tube;
  const double first = 400.0, second = 1200.0, whole = tube.radius / tube.sleeve;
  const auto tension = [](double stiffness, double l) { return stiffness * 0.5 * (l * l - 1.0) * l; };
  double low = 1.0, high = whole;  // stretch of the stiffer half
  for (int i = 0; i < 60; ++i) {
    const double l = 0.5 * (low + high);
    (tension(second, l) < tension(first, 2.0 * whole - l) ? low : high) = l;
  }
  const double T = tension(second, low);
  const Worn worn = two_halves(first, second);
  ASSERT_EQ(worn.run.status, postproc::Status::converged) << worn.run.message;
  book("sleeve of two fabrics on a rigid cylinder", "pressure, Pa", worn.run.numbers.at("mean_contact_pressure_Pa"), T / tube.radius, 1e-3, "T/r, springs in line");
  ASSERT_EQ(worn.run.pieces.size(), 2u);
  for (const postproc::PieceRow& piece : worn.run.pieces) {
    const bool stiff = piece.piece == "part 1";
    book("sleeve of two fabrics on a rigid cylinder", "tension of " + piece.piece + ", N/m", piece.tension_weft, T, 2e-3, "springs in line");
    book("sleeve of two fabrics on a rigid cylinder", "stretch of " + piece.piece, piece.stretch_weft, stiff ? low : 2.0 * whole - low, 1e-3, "springs in line");
    EXPECT_NEAR(piece.area, std::numbers::pi * tube.sleeve * tube.length, 1e-9);
    EXPECT_NEAR(piece.weight, piece.area * (stiff ? 0.3 : 0.2), 1e-12);
    EXPECT_EQ(piece.thickness, 0.5e-3);
  }
  ASSERT_EQ(worn.run.seams.size(), 2u);
  for (const postproc::SeamRow& seam : worn.run.seams) {
    book("sleeve of two fabrics on a rigid cylinder", "line load of " + seam.seam + ", N/m", seam.line_load, T, 5e-3, "springs in line");
    EXPECT_LT(seam.along, 0.01 * T);
    EXPECT_NEAR(seam.length, tube.length, 1e-3 * tube.length);
  }
  // What the law of Laplace expects of it is the same.
  const double expected = solver::laplace_pressure(solver::make_model(worn.c, worn.meshes.body).garments, worn.meshes).mean;
  EXPECT_NEAR(expected, T / tube.radius, 2e-3 * T / tube.radius);
}

TEST(SeveralFabrics, TwoZonesOfOneFabricAreOneFabricToTheLastBit) {
  // The same values under two names give what a garment without zones gives, every position alike.
  TubeCase tube;
  tube.around = 12, tube.along = 3, tube.through = 1, tube.tier = input::Tier::L1, tube.fabric = knit(800.0);
  const input::Case plain = describe_tube(tube);
  input::Case zoned = plain;
  solver::Meshes meshes = make_meshes(plain);
  const postproc::RunResult one = tests::solve(plain, meshes);
  zoned.garments.front().zone = {{.pieces = {}, .from_height = 0.0, .to_height = 0.03, .fabric = {}, .where = {}}};
  zoned.garments.front().zone.front().fabric.table = input::table_of(knit(800.0));
  const mesh::GarmentMesh& mesh = meshes.garments.front();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) meshes.garments.front().triangle_zone.push_back(t % 3 == 0 ? 0 : -1);
  const postproc::RunResult two = tests::solve(zoned, meshes);
  ASSERT_EQ(one.garment.current.size(), two.garment.current.size());
  for (std::size_t n = 0; n < one.garment.current.size(); ++n) ASSERT_EQ(one.garment.current[n], two.garment.current[n]);
}

/// Over the cone's slope, so that the tube stays where it was placed: without friction its hoop tension draws it towards the narrow end.
constexpr double sticks = 0.5;

/// A cone that does not give way, round which a tube is knitted at four fifths of its girth everywhere.
TubeCase cone() {
  TubeCase tube;
  tube.around = 24, tube.along = 6, tube.through = 1, tube.length = 0.12, tube.radius = 0.045, tube.taper = 0.15, tube.tier = input::Tier::L1, tube.fabric = knit(500.0);
  return tube;
}

Worn graduated(const TubeCase& tube, const std::function<double(double)>& girth) {
  Worn worn{describe_tube(tube), {}, {}};
  worn.c.contacts.front().friction = sticks;
  input::PatternSpec& pattern = worn.c.garments.front().pattern;
  pattern.kind = input::PatternKind::graduated, pattern.flat_circumference = 0.0;
  for (int i = 0; i <= 8; ++i) pattern.circumferences.push_back({tube.length * i / 8.0, girth(tube.length * i / 8.0), {}});
  worn.meshes = make_meshes(worn.c);
  worn.run = tests::solve(worn.c, worn.meshes);
  return worn;
}

// One stretch l round the cone everywhere, and 1/cos(a) along it, for heights are the limb's: the tension K E(l) l cos(a) presses with its curvature cos(a)/r;
// a tube of one width could not.
TEST(Graduated, AMatchingTubeOnAConeIsStretchedAlikeEverywhere) {
  const TubeCase tube = cone();
  const double l = 1.25, T = 500.0 * 0.5 * (l * l - 1.0) * l, slope = 1.0 / std::sqrt(1.0 + tube.taper * tube.taper);
  const Worn worn = graduated(tube, [&](double z) { return 2.0 * std::numbers::pi * radius_of(tube, z) / l; });
  ASSERT_EQ(worn.run.status, postproc::Status::converged) << worn.run.message;
  for (const auto& [from, to] : {std::pair{0.02, 0.04}, std::pair{0.05, 0.07}, std::pair{0.08, 0.10}})
    book("graduated tube on a rigid cone", fmt::format("pressure at {:.0f} mm, Pa", 500.0 * (from + to)), ring_pressure(worn.run, from, to),
         T * slope * slope / radius_of(tube, 0.5 * (from + to)), 1e-2, "K E l cos(a)^2/r");
  ASSERT_EQ(worn.run.pieces.size(), 1u);
  book("graduated tube on a rigid cone", "stretch along the courses", worn.run.pieces.front().stretch_weft, l, 2e-3, "girths of limb and tube");
  double area = 0.0;  // of the cloth: its courses, one by one
  for (int i = 0; i < 1000; ++i) area += 2.0 * std::numbers::pi * radius_of(tube, (i + 0.5) * tube.length / 1000.0) / l * tube.length / 1000.0;
  EXPECT_NEAR(worn.run.pieces.front().area, area, 1e-3 * area);
  EXPECT_TRUE(worn.run.seams.empty());
}

TEST(Graduated, OneOfOneWidthIsATube) {
  // The same circumference at all heights presses as a tube cut so, to a millionth.
  TubeCase tube = cone();
  tube.taper = 0.0;
  const Worn knitted = graduated(tube, [&](double) { return 2.0 * std::numbers::pi * tube.sleeve; });
  const postproc::RunResult cut = tests::run(tube);
  ASSERT_EQ(knitted.run.status, postproc::Status::converged);
  ASSERT_EQ(cut.status, postproc::Status::converged);
  EXPECT_NEAR(knitted.run.numbers.at("mean_contact_pressure_Pa") / cut.numbers.at("mean_contact_pressure_Pa"), 1.0, 1e-6);
}

TEST(Graduated, TheLawOfLaplaceGivesTheCircumferencesAndASolutionCorrectsThem) {
  // On a rigid cone, for 3 kPa falling to 2 kPa: the first circumferences press within 3 % of that (the cone's slope is not in them), the corrected ones nearer.
  const TubeCase tube = cone();
  input::Case c = describe_tube(tube);
  c.contacts.front().friction = sticks;
  input::PatternSpec& pattern = c.garments.front().pattern;
  pattern.kind = input::PatternKind::graduated, pattern.flat_circumference = 0.0;
  pattern.pressures = {{0.0, 3000.0, {}}, {0.05, 2500.0, {}}, {tube.length, 2000.0, {}}};
  const mesh::Limb limb = mesh::make_limb(*c.body);
  EXPECT_DOUBLE_EQ(solver::wanted_pressure(pattern, 0.025), 2750.0);
  EXPECT_DOUBLE_EQ(solver::wanted_pressure(pattern, 0.2), 2000.0);
  const auto error_of = [&](std::vector<input::GirthRow> rows, std::vector<input::GirthRow>& better) {
    pattern.circumferences = std::move(rows);
    const solver::Meshes meshes = make_meshes(c);
    const solver::Model model = solver::make_model(c, meshes.body);
    const postproc::RunResult run = solver::solve(model, meshes);
    EXPECT_EQ(run.status, postproc::Status::converged) << run.message;
    double error = 0.0;
    for (const postproc::ProfileRow& row : solver::pressure_profile(model, meshes, run)) error = std::max(error, std::abs(row.found / row.wanted - 1.0));
    better = solver::corrected_girths(model, 0, meshes, run);
    return error;
  };
  std::vector<input::GirthRow> better;
  const std::vector<input::GirthRow> first = solver::laplace_girths(solver::make_model(c).garments.front(), limb);
  for (const input::GirthRow& row : first) {  // T = K E(l) l = p G / (2 pi)
    const double l = limb.girth(row.height) / row.girth;
    EXPECT_NEAR(500.0 * 0.5 * (l * l - 1.0) * l, solver::wanted_pressure(pattern, row.height) * radius_of(tube, row.height), 1e-3 * 100.0);
  }
  const double laplace = error_of(first, better), corrected = error_of(better, better);
  fmt::print("Laplace's circumferences within {:.2f} %, corrected within {:.2f} %\n", 100.0 * laplace, 100.0 * corrected);
  EXPECT_LT(laplace, 0.03);
  EXPECT_LT(corrected, 0.01);
}

}  // namespace
}  // namespace snug::tests
