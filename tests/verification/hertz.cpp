// A rigid tool pressed into an elastic half space in plane strain: Hertz's cylinder and the flat punch.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "solver/stepping/newton.hpp"
#include "solver/terms/contact.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/press.hpp"

namespace snug::tests {
namespace {

constexpr double half_width = 1e-3, thickness = 0.2e-3;  // m: contact half width aimed at; of the slice
constexpr double shear = 10e3, poisson = 0.3;
constexpr double contact_modulus = 2.0 * shear / (1.0 - poisson);  // E* = E / (1 - nu^2)
constexpr int fine_cells = 20, coarse_cells = 10;  // over the first two half widths; geometric beyond, to 19 of them

/// Cell borders in the unit interval to distances from the middle of the contact.
double graded(double u) {
  const double cells = u * (fine_cells + coarse_cells);
  const double size = 2.0 * half_width / fine_cells;
  if (cells <= fine_cells) return cells * size;
  const double growth = 1.5, k = cells - fine_cells;  // sum of growth^1 .. growth^k cells of that size
  return 2.0 * half_width + size * growth * (std::pow(growth, k) - 1.0) / (growth - 1.0);
}

/// Half of the scene: the tool's middle is the plane x = 0.
struct Indentation {
  Press press;
  solver::Scene scene;
  State state;

  Indentation(double tool_width, int tool_cells, const std::function<double(double)>& shape)
      : press(upright_block({fine_cells + coarse_cells, fine_cells + coarse_cells, 1},
                            [](double x, double y, double z) {
                              return Eigen::Vector3d(graded(x), thickness * y, -graded(1.0 - z));
                            }),
              sheet({tool_cells, 1}, {tool_width, thickness}, [&](const Eigen::Vector2d& x) { return shape(x.x()); }, 0.0)),
        scene(press.layout, solver::Numbering(numbered())) {
    scene.add(std::make_unique<solver::Tissue>("tissue", solver::body_fields(press.layout, "body"), press.body,
                                               std::vector<materials::SolidLaw>{tissue(shear, poisson)}));
    scene.add(std::make_unique<solver::Contact>("contact", solver::Interface{press.layout["contact"], solver::garment_slave(press.layout["garment"], press.garment), solver::MasterSurface(press.layout["body"], press.body, press.body.skin_facets)}, shear / half_width, solver::GapBasis::hat));
    state = tests::placed_state(press.layout, press.body, press.garment);
    state.load = 1.0;
  }

  std::vector<int> numbered() {
    for (std::size_t node = 0; node < press.garment.pattern.size(); ++node)
      for (int c = 0; c < 3; ++c) press.fixed.fix(press.layout["garment"](static_cast<int>(node), c));
    return press.fixed.master;
  }

  /// Lowers the tool to `depth` below where it was made.
  solver::Outcome lower(double depth) {
    for (std::size_t node = 0; node < press.garment.pattern.size(); ++node)
      state.values[press.layout["garment"](static_cast<int>(node), 2)] = press.garment.placed[node].z() - depth;
    solver::NewtonSettings settings;
    return solver::newton(scene, state, settings, [](const postproc::Iteration&) {});
  }

  /// Force per length on both halves, N/m.
  double force() const {
    double sum = 0.0;
    for (const auto& point : scene.find<solver::Contact>()->point_forces(state)) sum += point.force.z();
    return 2.0 * sum / thickness;
  }

  /// Multipliers at the tool's vertices with their x, middle first.
  std::vector<Eigen::Vector2d> pressures() const {
    std::vector<Eigen::Vector2d> list;
    const auto* contact = scene.find<solver::Contact>();
    for (std::size_t node = 0; node < press.garment.pattern.size(); ++node)
      if (const int i = contact->multiplier_of(static_cast<int>(node)); i >= 0)
        list.emplace_back(press.garment.pattern[node].x(), state.values[press.layout["contact"](i)]);
    std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
    return list;
  }
};

// A rigid cylinder on a half space: pressure, half width and profile of Hertz's theory at the force that was reached,
// p0 = sqrt(F E* / (pi R)), b = sqrt(4 F R / (pi E*)), p = p0 sqrt(1 - (x/b)^2), for b/R = 0.02.
TEST(Hertz, ARigidCylinderOnAHalfSpace) {
  const double radius = 50.0 * half_width;
  Indentation cylinder(2.0 * half_width, 23, [&](double x) { return radius - std::sqrt(radius * radius - x * x); });
  for (const double part : {0.25, 0.5, 1.0})  // the approach grows with the body's size (about ln(L/b) b^2/R)
    ASSERT_EQ(cylinder.lower(part * 4.2e-5), solver::Outcome::converged);
  const double force = cylinder.force();
  const double p0 = std::sqrt(force * contact_modulus / (std::numbers::pi * radius));
  const double b = std::sqrt(4.0 * force * radius / (std::numbers::pi * contact_modulus));
  // p^2 is linear in x^2 where there is contact: a line through the inner nine tenths.
  std::vector<Eigen::Vector2d> inner;
  double squares = 0.0;
  const auto pressures = cylinder.pressures();
  for (const auto& at : pressures) {
    const double x = at.x(), p = at.y();
    const double exact = x < b ? p0 * std::sqrt(1.0 - x * x / (b * b)) : 0.0;
    squares += (p - exact) * (p - exact) / (p0 * p0);
    if (x < 0.9 * b) inner.emplace_back(x * x / (b * b), p * p / (p0 * p0));
  }
  Eigen::MatrixXd A(inner.size(), 2);
  Eigen::VectorXd r(inner.size());
  for (std::size_t n = 0; n < inner.size(); ++n) A.row(n) << 1.0, inner[n].x(), r[n] = inner[n].y();
  const Eigen::Vector2d line = A.colPivHouseholderQr().solve(r);
  const std::string source = "Hertz; reference book 3, line contact";
  book("Hertz, rigid cylinder", "peak pressure over p0", std::sqrt(line[0]), 1.0, 1e-2, source);
  book("Hertz, rigid cylinder", "half width over b", std::sqrt(-line[0] / line[1]), 1.0, 1e-2, source);
  book("Hertz, rigid cylinder", "rms of the profile over p0", std::sqrt(squares / pressures.size()), 0.0, 2e-2, source);
}

// A flat punch with sharp edges: 71.287 % of the load inside nine tenths of the half width; never the peak.
TEST(FlatPunch, TheMiddleCarriesItsShareOfTheLoad) {
  const int cells = 12;
  Indentation punch(half_width, cells, [](double) { return 0.0; });
  ASSERT_EQ(punch.lower(1e-5), solver::Outcome::converged);
  double inside = 0.0, all = 0.0;
  const auto* contact = punch.scene.find<solver::Contact>();
  for (const auto& point : contact->point_forces(punch.state)) {
    all += point.force.z();
    if (point.x.x() < 0.9 * half_width) inside += point.force.z();
  }
  book("flat punch, plane strain", "share of the load inside 0.9 a", inside / all, 0.71286741, 1e-2, "reference book 3, strip");
}

}  // namespace
}  // namespace snug::tests
