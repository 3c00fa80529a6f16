// A sleeve on an elastic cylindrical shell on springs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "mesh/body/import_shell.hpp"
#include "mesh/body/scan.hpp"
#include "solver/library/prepared_case.hpp"
#include "solver/scene/layers.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/shell_models.hpp"

namespace snug::tests {
namespace {

using std::numbers::pi;

struct Tube {
  double radius = 0.05, length = 0.06, thickness = 1e-3, youngs = 2e8, poisson = 0.3, foundation = 4e7;  ///< m, Pa, Pa/m
  int around = 40, along = 8;
  bool inside_out = false;  ///< normals of the file point inwards
};

/// Pairs of triangles round the z axis; the lower end is held along it.
mesh::Model shell_tube(const Tube& tube) {
  mesh::Model model = empty_shell(tube.youngs, tube.poisson, tube.thickness);
  model.sections[0].foundation = tube.foundation;
  ShellLattice lattice{model, [&](int i, int j) {
                         const double angle = pi * i / tube.around;
                         return Eigen::Vector3d(tube.radius * std::cos(angle), tube.radius * std::sin(angle), 0.5 * tube.length * j / tube.along);
                       }};
  const auto corner = [&](int i, int j) { return std::array{i, j}; };
  const auto triangle = [&](std::array<int, 2> a, std::array<int, 2> b, std::array<int, 2> c) {
    const auto node = [&](int i, int j) { return lattice.node(i % (2 * tube.around), j); };
    const auto mid = [&](const auto& p, const auto& q) { return node((p[0] + q[0]) / 2, (p[1] + q[1]) / 2); };
    if (tube.inside_out) std::swap(b, c);
    model.elements.push_back({static_cast<int>(model.elements.size()) + 1, mesh::ElementKind::tri6,
                              {node(a[0], a[1]), node(b[0], b[1]), node(c[0], c[1]), mid(a, b), mid(b, c), mid(c, a)}, 0, 0});
  };
  for (int j = 0; j < 2 * tube.along; j += 2)
    for (int i = 0; i < 2 * tube.around; i += 2)
      if ((i + j) % 4 == 0)
        triangle(corner(i, j), corner(i + 2, j), corner(i + 2, j + 2)), triangle(corner(i, j), corner(i + 2, j + 2), corner(i, j + 2));
      else
        triangle(corner(i, j), corner(i + 2, j), corner(i, j + 2)), triangle(corner(i + 2, j), corner(i + 2, j + 2), corner(i, j + 2));
  hold(model, [](const Eigen::Vector3d& x) { return x.z() < 1e-9; }, {2});
  return model;
}

/// T/r of a sleeve of 500 N/m (S = k E) and rest radius 44 mm that keeps its length.
double shell_pressure(double r) {
  const double l = r / 0.044;
  return 500.0 * 0.5 * (l * l - 1.0) * l / r;
}

input::Case sleeve_on(const Tube& tube) {
  BlockCase block = shell_case(shell_tube(tube));
  input::Case c = block.c;
  c.load.reset();
  input::GarmentSpec& sleeve = c.garments.emplace_back();
  sleeve.position = 0.0;
  sleeve.pattern.flat_circumference = 2.0 * pi * 0.044, sleeve.pattern.length = tube.length;
  sleeve.fabric.table = input::table_of("law = 'linear'\nwarp = '500 N/m'\nweft = '500 N/m'\nshear = '150 N/m'\npoisson = 0");
  for (const char* edge : {"upper", "lower"}) sleeve.held.push_back({.edge = edge, .held = input::HeldDirection::axis});
  c.contacts.emplace_back().friction = 0.0;
  return c;
}

solver::Meshes meshes_of(const Tube& tube, const input::Case& c) {
  solver::Meshes meshes;
  meshes.body = shell_case(shell_tube(tube)).mesh;
  mesh::turn_skin_outwards(meshes.body);
  meshes.limb = mesh::limb_from_skin(meshes.body, 0.0, tube.length, {});
  meshes.garments.push_back(mesh::make_tube_mesh(c.garments[0], meshes.limb, 0.6 * meshes.body.mean_skin_cell));
  return meshes;
}

// The ends are free of moment and slide, so that the shell is a ring at every height: p = (E t/R^2 + k) w, and the sleeve's T/r
// at the radius R - w presses it.
TEST(ShellSleeve, PressesAnElasticCylinderOnSpringsAsTheRingSays) {
  for (const bool inside_out : {false, true}) {
    const Tube tube{.inside_out = inside_out};
    const double ring = tube.youngs * tube.thickness / (tube.radius * tube.radius) + tube.foundation;
    double w = 0.0;
    for (int k = 0; k < 100; ++k) w = shell_pressure(tube.radius - w) / ring;
    const input::Case c = sleeve_on(tube);
    const postproc::RunResult result = tests::solve(c, meshes_of(tube, c));
    EXPECT_EQ(result.status, postproc::Status::converged) << result.message;
    const std::string scene = inside_out ? "sleeve on a shell, file inside out" : "sleeve on a shell";
    book(scene, "displacement of the skin, m", result.numbers.at("mean_skin_radial_displacement_m"), -w, 2e-3, "ring on springs: p = (E t/R^2 + k) w");
    book(scene, "contact shell_pressure, Pa", result.numbers.at("mean_contact_pressure_Pa"), shell_pressure(tube.radius - w), 1e-3, "T(r)/r with it");
    EXPECT_LE(result.balance.force_error.norm(), 1e-9 * result.balance.contact_force);
  }
}

// The same by a file of CalculiX through the library, with friction that the case leaves to the run.
TEST(ShellSleeve, ACaseWithAShellOfAFileIsPreparedAndSolved) {
  const Tube tube{.around = 20, .along = 4};
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("snug-shell-sleeve-{}", ::getpid());
  std::filesystem::create_directories(folder);
  std::ofstream file(folder / "tube.inp");
  mesh::write_calculix(file, shell_tube(tube));
  file.close();
  std::ofstream(folder / "case.toml") << "title = \"sleeve on a shell\"\n[body]\nkind = \"imported\"\nmesh = \"tube.inp\"\nunit = \"1 m\"\nforce_unit = \"1 N\"\n"
                                         "[garment]\npattern = { kind = \"tube\", flat_circumference = \"276 mm\", length = \"40 mm\" }\nfabric = \"N85L15\"\n"
                                         "position = \"10 mm\"\n[contact]\n";
  const solver::PreparedCase prepared = solver::prepare(folder);
  const postproc::RunResult result = solver::solve(prepared);
  EXPECT_EQ(result.status, postproc::Status::converged) << result.message;
  EXPECT_GT(result.numbers.at("mean_contact_pressure_Pa"), 100.0);
  EXPECT_LT(result.numbers.at("mean_skin_radial_displacement_m"), 0.0);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace snug::tests
