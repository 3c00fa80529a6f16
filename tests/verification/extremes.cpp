// Stiff and extreme scenes, solved with the numbers of the ordinary one: each with its error and its time beside it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "tests/verification/book.hpp"
#include "tests/verification/radial_limb.hpp"
#include "tests/verification/tube.hpp"

namespace snug::tests {
namespace {

/// A sleeve T = k1 (l - 1) on the tube of 20 to 55 mm, mu = 10 kPa.
struct Scene {
  std::string name;
  double k1 = 200.0;               ///< N/m
  double poisson_ratio = 0.49;
  double rest = 0.044;             ///< m, radius of the sleeve at rest
  double garment_cell = 0.0;       ///< of the skin's cell; 0: as shipped
};

TubeCase tube_of(const Scene& scene) {
  TubeCase tube;
  tube.length = 0.030;
  tube.around = 24, tube.along = 2, tube.through = 2;
  tube.sleeve = scene.rest;
  tube.tissue = fmt::format("law = 'neo-Hooke'\nshear_modulus = '10 kPa'\npoisson_ratio = {}", scene.poisson_ratio);
  tube.fabric = fmt::format("law = 'cubic'\nk1 = '{} N/m'\nk3 = '0 N/m'\nshear = '{} N/m'\npoisson = 0", scene.k1,
                            0.3 * scene.k1);
  tube.cell_size = scene.garment_cell * 2.0 * std::numbers::pi * tube.radius / tube.around;
  return tube;
}

struct Answer {
  postproc::RunResult result;
  double seconds = 0.0;
};

Answer timed_run(const TubeCase& tube) {
  const auto start = std::chrono::steady_clock::now();
  Answer answer{run(tube)};
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(answer.result.status, postproc::Status::converged) << answer.result.message;
  return answer;
}

void print_time(const std::string& name, const Answer& answer, const Answer& ordinary) {
  fmt::print("{:40} {:6.2f} s ({:.1f} times the ordinary scene), {} increments, {} iterations\n", name, answer.seconds,
             answer.seconds / ordinary.seconds, answer.result.increments, answer.result.iterations);
}

double iterations_of(const Answer& answer) { return static_cast<double>(answer.result.iterations); }

class Extremes : public ::testing::Test {
 protected:
  static const Answer& ordinary() {
    static const Answer answer = timed_run(tube_of({}));
    return answer;
  }
  /// The scene against the radial equation.
  static Answer meets_exact(const Scene& scene, double tolerance = 1e-3) {
    const auto line_load = [&](double r) { return scene.k1 * (r / scene.rest - 1.0) / r; };
    const RadialAnswer exact = solve_limb({{0.020, 0.055, 1e4, scene.poisson_ratio}}, Volumetric::barrier, line_load);
    ordinary();
    const Answer answer = timed_run(tube_of(scene));
    print_time(scene.name, answer, ordinary());
    book("4 extremes", scene.name + ": contact pressure, Pa", answer.result.numbers.at("mean_contact_pressure_Pa"),
         exact.pressure, tolerance, "radial equation");
    return answer;
  }
};

// The ordinary scene meets the exact pressure.
TEST_F(Extremes, Ordinary) { meets_exact({.name = "ordinary: nu 0.49, 200 N/m, 20 % undersize"}); }

// Tissue at nu = 0.49999 is solved as exactly as at 0.49, in at most half as many iterations again.
TEST_F(Extremes, NearlyIncompressible) {
  const Answer answer = meets_exact({.name = "nu = 0.49999", .poisson_ratio = 0.49999});
  EXPECT_LE(iterations_of(answer), 1.5 * iterations_of(ordinary()));
}

/// A sleeve held at its upper edge on a limb that widens upwards by a sixth of its length: the hem pulls tissue along.
TubeCase tapering(double poisson_ratio, input::Elements elements) {
  TubeCase tube = tube_of({.k1 = 300.0, .poisson_ratio = poisson_ratio});
  tube.length = 0.060, tube.taper = 1.0 / 6.0, tube.radius = 0.050;
  tube.around = 20, tube.along = 4, tube.through = 2, tube.elements = elements;
  tube.cell_size = 0.006;  // on every kind of skin alike
  return tube;
}

Answer tapering_run(double poisson_ratio, input::Elements elements) {
  input::Case c = describe_tube(tapering(poisson_ratio, elements));
  c.garments.front().held = {{.edge = "upper", .held = input::HeldDirection::axis}};
  Answer answer{tests::solve(c, make_meshes(c))};
  EXPECT_EQ(answer.result.status, postproc::Status::converged) << text_of(elements) << ", nu = " << poisson_ratio << ": " << answer.result.message;
  return answer;
}

// Hexahedra carry their pressure through Newton's method, so that tissue at nu = 0.4999999 takes at most 1.3 times the
// iterations of nu = 0.49. The tetrahedra of another mesh and formulation, whose pressure is an unknown, find the same
// pressure but for what the hem makes of the two meshes at nu = 0.49, too (5e-3; Q1/P0 cells, straight and of first order: 2e-2).
TEST_F(Extremes, HexahedraTakeNoMoreIterationsAtTheLimitOfIncompressibility) {
  const auto mean = [](const Answer& answer) { return answer.result.numbers.at("mean_contact_pressure_Pa"); };
  const double soft_tetrahedra = mean(tapering_run(0.49, input::Elements::P2P1)), tetrahedra = mean(tapering_run(0.4999999, input::Elements::P2P1));
  for (const input::Elements elements : {input::Elements::Q2P1, input::Elements::Q1P0}) {
    const Answer soft = tapering_run(0.49, elements), limit = tapering_run(0.4999999, elements);
    fmt::print("{}: {} iterations at nu = 0.49, {} at 0.4999999\n", text_of(elements), soft.result.iterations, limit.result.iterations);
    EXPECT_LE(iterations_of(limit), 1.3 * iterations_of(soft)) << text_of(elements);
    book("4 extremes", fmt::format("tapering limb at nu = 0.4999999, {}: mean pressure, Pa", text_of(elements)), mean(limit),
         tetrahedra * mean(soft) / soft_tetrahedra, elements == input::Elements::Q2P1 ? 1e-3 : 2e-2, "P2/P1 tetrahedra, with the meshes' difference at nu = 0.49");
  }
}

// A fabric a hundred times stiffer, or softer, is no other case.
TEST_F(Extremes, StiffFabric) { meets_exact({.name = "fabric 100 times stiffer", .k1 = 20e3}); }
TEST_F(Extremes, SoftFabric) { meets_exact({.name = "fabric 100 times softer", .k1 = 2.0}); }

// A sleeve of 60 % of the limb's girth.
TEST_F(Extremes, FortyPercentUndersize) { meets_exact({.name = "40 % undersize", .rest = 0.033}); }

// A garment four times coarser than the skin, and four times finer.
TEST_F(Extremes, CoarseGarment) { meets_exact({.name = "garment 4 times coarser than the skin", .garment_cell = 4.0}, 1e-2); }
TEST_F(Extremes, FineGarment) { meets_exact({.name = "garment 4 times finer than the skin", .garment_cell = 0.25}); }

// A sleeve of just the limb's girth lies on it without pressure: no more of it than the same thousandth of the fabric's
// stiffness over the radius, the pressure of a whole stretch, that bounds the other scenes' error.
TEST_F(Extremes, ZeroPrestress) {
  const Answer answer = timed_run(tube_of({.name = "zero prestress", .rest = 0.055}));
  print_time("zero prestress", answer, ordinary());
  const auto& p = answer.result.body.fields[postproc::field::contact_pressure];
  book("4 extremes", "zero prestress: largest nodal pressure over k1/R", *std::max_element(p.begin(), p.end()) / (200.0 / 0.055),
       0.0, 1e-3, "nothing pulls");
}

// A sharp ridge of bone (tip radius under a millimetre) 3 mm below the skin of soft tissue under a tight sleeve (pressure
// above the tissue's shear modulus): nu from 0.45 to 0.49999 converges untuned, forces balance, and where tissue gives
// way at all the pressure over the ridge is the largest of the round.
TEST_F(Extremes, RidgeOfBone) {
  for (const double nu : {0.45, 0.49999}) {
    TubeCase tube = tube_of({.k1 = 1000.0});
    tube.tissue = fmt::format("law = 'neo-Hooke'\nshear_modulus = '2 kPa'\npoisson_ratio = {}", nu);
    tube.bone_ratio = 6.0, tube.bone = 0.0204, tube.bone_offset = 0.022;  // semi-axes about 30 and 5 mm
    const Answer answer = timed_run(tube);
    print_time(fmt::format("ridge of bone, nu = {}", nu), answer, ordinary());
    EXPECT_LE(answer.result.balance.force_error.norm(), 1e-8 * answer.result.balance.contact_force);
    if (nu > 0.49) continue;  // incompressible tissue on bone cannot give way: the round stays a circle
    const auto& body = answer.result.body;
    const std::vector<double>& pressure = body.fields[postproc::field::contact_pressure];
    const auto largest = std::max_element(pressure.begin(), pressure.end());
    const Eigen::Vector3d place = body.nodes[largest - pressure.begin()];
    EXPECT_GT(place.x(), 0.9 * tube.radius) << place.transpose();
  }
}

}  // namespace
}  // namespace snug::tests
