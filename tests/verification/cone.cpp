// A sleeve on a frictionless rigid cone, held at its large end, against its membrane equation (reference book 3).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "materials/fabric/fabric.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/rigid_surfaces.hpp"

namespace snug::tests {
namespace {

constexpr double half_angle = std::numbers::pi / 18.0, large_radius = 0.060, rest_radius = 0.044, rest_length = 0.060;

/// Nominal line forces (N per rest width) along the meridian and round, of the stretches.
struct LineForces { double meridian, hoop; };
using SheetLaw = std::function<LineForces(double meridian, double hoop)>;

/// The book's law: N = k (e + nu e') of engineering strains.
SheetLaw engineering(double k, double nu) {
  return [=](double s, double t) { return LineForces{k * (s - 1.0 + nu * (t - 1.0)), k * (t - 1.0 + nu * (s - 1.0))}; };
}

SheetLaw law_of(const materials::Fabric& fabric) {
  return [fabric](double s, double t) {
    const Eigen::Vector3d force = fabric.unrelaxed({0.5 * (s * s - 1.0), 0.5 * (t * t - 1.0), 0.0}).force;
    return LineForces{s * force[0], t * force[1]};
  };
}

struct ConeAnswer { double tension, small_radius; };  ///< N/m at the large end, m

double meridian_stretch(const SheetLaw& law, double force, double hoop) {
  double s = 1.0;
  for (int k = 0; k < 60; ++k) {
    const double d = 1e-6, step = (law(s, hoop).meridian - force) * 2.0 * d / (law(s + d, hoop).meridian - law(s - d, hoop).meridian);
    s -= step;
    if (std::abs(step) < 1e-14) break;
  }
  return s;
}

/// r' = -l_s sin(a), N_s' = -N_t sin(a) / R_f from the large end to the free one, where N_s = 0 (shooting, Runge and Kutta).
ConeAnswer membrane_equation(const SheetLaw& law) {
  const double sine = std::sin(half_angle);
  const auto march = [&](double tension) {
    Eigen::Vector2d y(large_radius, tension);
    const auto slope = [&](const Eigen::Vector2d& at) {
      const double hoop = at[0] / rest_radius, s = meridian_stretch(law, at[1], hoop);
      return Eigen::Vector2d(-s * sine, -law(s, hoop).hoop * sine / rest_radius);
    };
    constexpr int steps = 400;
    const double h = rest_length / steps;
    for (int n = 0; n < steps; ++n) {
      const Eigen::Vector2d a = slope(y), b = slope(y + 0.5 * h * a), c = slope(y + 0.5 * h * b), d = slope(y + h * c);
      y += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    }
    return y;
  };
  double t0 = 40.0, t1 = 60.0, f0 = march(t0)[1], f1 = march(t1)[1];
  while (std::abs(t1 - t0) > 1e-11 * t1) {
    const double t2 = t1 - f1 * (t1 - t0) / (f1 - f0);
    t0 = t1, f0 = f1, t1 = t2, f1 = march(t1)[1];
  }
  return {t1, march(t1)[0]};
}

Eigen::Vector3d on_cone(double angle, double slant) {  // slant from the large end towards the apex
  const double r = large_radius - slant * std::sin(half_angle);
  return {r * std::cos(angle), r * std::sin(angle), -slant * std::cos(half_angle)};
}

input::Case describe(const std::string& fabric) {
  input::Case c;
  c.garments.emplace_back().position = 0.0;
  c.garments.front().pattern.length = rest_length;
  c.garments.front().pattern.flat_circumference = 2.0 * std::numbers::pi * rest_radius;
  c.garments.front().fabric.table = input::table_of(fabric);
  c.garments.front().held = {{.edge = "upper", .held = input::HeldDirection::all}};
  c.contacts.emplace_back();
  c.contacts.front().friction = 0.0;
  return c;
}

mesh::GarmentMesh sleeve(const input::Case& c, double cell) {
  mesh::Limb limb;
  limb.skin = std::make_unique<CircularOutline>();
  limb.lower = -0.01, limb.upper = rest_length + 0.01;
  mesh::GarmentMesh mesh = mesh::make_tube_mesh(c.garments.front(), limb, cell, 0.0);
  for (std::size_t node = 0; node < mesh.placed.size(); ++node) {
    const Eigen::Vector3d& x = mesh.placed[node];
    mesh.placed[node] = on_cone(std::atan2(x.y(), x.x()), rest_length - mesh.pattern[node].y());
  }
  return mesh;
}

ConeAnswer solve(const input::Case& c, double cell) {
  const double skin_cell = 1.37 * cell, half = 0.5 * rest_length + 2.0 * skin_cell;
  const mesh::BodyMesh body =
      skin_grid(static_cast<int>(std::lround(2.0 * std::numbers::pi * large_radius / skin_cell)),
                static_cast<int>(std::lround(2.0 * half / skin_cell)), half, skin_cell, 0.0,
                [&](double angle, double z) { return on_cone(angle, 0.5 * rest_length - z); });
  const mesh::GarmentMesh garment = sleeve(c, cell);
  solver::Scene scene = tests::make_scene(c, body, garment, solver::Skin::rigid);
  solver::PathSettings settings;
  settings.newton.penetration = 1e-6 * garment.mean_edge;
  const auto path = solver::follow_path(scene, tests::placed_state(scene.layout(), body, garment), solver::tightening(),
                                        settings, [](const postproc::Iteration&) {});
  EXPECT_TRUE(path.complete) << path.message << " at " << path.reached;
  const Eigen::VectorXd residual = scene.full_residual(path.state);
  ConeAnswer answer{};
  for (const int node : garment.edges.at("upper")) {
    if (garment.merged[node] != node) continue;  // sewn nodes once
    const int entry = scene.layout()["garment"](node);
    const Eigen::Vector3d x = path.state.values.segment<3>(entry), f = residual.segment<3>(entry);
    const Eigen::Vector3d down = on_cone(std::atan2(x.y(), x.x()), 1.0) - on_cone(std::atan2(x.y(), x.x()), 0.0);
    answer.tension -= f.dot(down) / (2.0 * std::numbers::pi * rest_radius);
  }
  const auto& edge = garment.edges.at("lower");
  for (const int node : edge)
    answer.small_radius += path.state.values.segment<2>(scene.layout()["garment"](garment.merged[node])).norm() / edge.size();
  answer.tension = std::abs(answer.tension);
  return answer;
}

// The membrane equation of this file, with the book's law, gives the book's numbers.
TEST(FrictionlessCone, TheMembraneEquationMeetsTheReferenceBook) {
  struct Row { double nu, tension, radius; };
  for (const Row& row : {Row{0.0, 57.13740194, 49.33324985}, Row{0.2, 57.52647622, 49.84612975}}) {
    const ConeAnswer exact = membrane_equation(engineering(1000.0, row.nu));
    const std::string scene = fmt::format("sleeve on a cone, membrane equation, nu = {}", row.nu);
    book(scene, "meridian tension at the large end, N/m", exact.tension, row.tension, 1e-8, "reference book 3 (s08)");
    book(scene, "radius at the small end, mm", 1e3 * exact.small_radius, row.radius, 1e-8, "reference book 3 (s08)");
  }
}

// A sleeve that only its large end holds finds the tension and the radius of the membrane equation: with the book's law at
// nu = 0, and at nu = 0.2, where our fabric couples Green strains and not the book's engineering ones, with its own.
TEST(FrictionlessCone, TheSleeveHangsAsTheMembraneEquationSays) {
  struct Row { std::string name, fabric; };
  for (const Row& row : {Row{"nu = 0", "law = 'cubic'\nk1 = '1000 N/m'\nk3 = '0 N/m'\nshear = '300 N/m'\npoisson = 0"},
                         Row{"St. Venant & Kirchhoff, nu = 0.2",
                             "law = 'linear'\nwarp = '1000 N/m'\nweft = '1000 N/m'\nshear = '400 N/m'\npoisson = 0.2"}}) {
    const input::Case c = describe(row.fabric);
    const ConeAnswer exact = membrane_equation(law_of(materials::find_fabric(c.garments.front().fabric)));
    for (const double cell : {0.012, 0.008}) {
      const ConeAnswer a = solve(c, cell);
      fmt::print("{} cell {} mm: tension {:.3e}, radius {:.3e}\n", row.name, 1e3 * cell, a.tension / exact.tension - 1.0,
                 a.small_radius / exact.small_radius - 1.0);
      if (cell > 0.01) continue;
      book("sleeve on a cone, " + row.name, "meridian tension at the large end, N/m", a.tension, exact.tension, 1e-4, "membrane equation");
      book("sleeve on a cone, " + row.name, "radius at the small end, mm", 1e3 * a.small_radius, 1e3 * exact.small_radius, 1e-4,
           "membrane equation");
    }
  }
}

}  // namespace
}  // namespace snug::tests
