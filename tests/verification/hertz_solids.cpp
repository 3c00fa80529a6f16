// Two elastic cylinders pressed together: Hertz's theory with both sides soft.
#include <gtest/gtest.h>

#include "tests/verification/book.hpp"
#include "tests/verification/two_solids.hpp"

namespace snug::tests {
namespace {

/// Places 0 .. length over the unit interval: `even` cells of `size`, then `growing` ones of which each is larger than the one
/// before by the same factor.
class Graded {
 public:
  Graded(double size, int even, int growing, double length) : size_(size), even_(even), growing_(growing) {
    double low = 1.0 + 1e-9, high = 3.0;
    while (high - low > 1e-14) (at_end(growth_ = 0.5 * (low + high)) < length ? low : high) = growth_;
  }
  int cells() const { return even_ + growing_; }
  double operator()(double u) const {
    const double k = u * cells() - even_;
    return size_ * (k <= 0.0 ? even_ + k : even_ + grown(growth_, k));
  }

 private:
  static double grown(double q, double k) { return q * (std::pow(q, k) - 1.0) / (q - 1.0); }  // q + q^2 + .. q^k
  double at_end(double q) const { return size_ * (even_ + grown(q, growing_)); }
  double size_, growth_ = 1.0;
  int even_, growing_;
};

constexpr double R = 8.0, E = 200.0, nu = 0.3;  // the book has no units: m, Pa
/// Hertz's theory is linear. Under the book's force of 10 N/m the strain is 2.4 % (and the peak 4 % lower for it); a
/// hundredth of it strains a tenth as much, and makes a tenth of half width and pressure.
constexpr double scale = 10.0, force = 10.0 / (scale * scale);  // N/m
constexpr double half_width = 0.68077837 / scale, peak = 9.35135129 / scale, thickness = 0.2 * half_width;

/// Half of a cylinder's contact zone, to 16 half widths along and across the face: `cells` a half width along it.
Solid cylinder(int cells, CellKind kind, double side) {
  const double size = half_width / cells, length = 16.0 * half_width;
  const Graded along(size, 5 * cells / 4, 8, length), across(size, 3, 10, length);
  Block block;
  block.kind = kind, block.cells = {along.cells(), across.cells(), 1};
  block.map = [=](const Eigen::Vector3d& u) {
    const double x = along(u.x()), sagitta = R - std::sqrt(R * R - x * x), y = across(side > 0.0 ? u.y() : 1.0 - u.y());
    return Eigen::Vector3d(x, side * (y + sagitta * (1.0 - y / length)), thickness * u.z());
  };
  return {make_block(block), side > 0.0 ? "bottom" : "top", E, nu};
}

struct Cylinders : TwoSolids {
  explicit Cylinders(CellKind lower) : TwoSolids(cylinder(16, lower, -1.0), cylinder(15, CellKind::tet10, 1.0)) {
    for (const Solid* solid : {&master, &slave})
      for (const auto& [face, c] : {std::pair{"left", 0}, {"right", 0}, {"front", 2}, {"back", 2}}) hold(*solid, face, c);
    hold(master, "bottom", 1);
    const auto& top = slave.mesh.surface("top")->nodes;  // a rigid plate
    for (const int node : top) fixed.master[layout.body(node, 1)] = layout.body(top.front(), 1);
    forces[top.front()] = {0.0, -0.5 * force * thickness, 0.0};
    // what holds the upper body up is contact: it starts pushed into the lower one
    for (const int node : nodes_of(slave)) state.values[layout.body(node, 1)] -= 1.5 * half_width * half_width / R;
  }
  /// Pressure by x, the mean over the slice.
  std::map<double, double> profile() const {
    std::map<long, std::vector<Vertex>> rows;
    for (const Vertex& v : vertices()) rows[std::lround(1e6 * reference(v.node).x() / half_width)].push_back(v);
    std::map<double, double> list;
    for (const auto& [x, row] : rows) {
      double sum = 0.0;
      for (const Vertex& v : row) sum += v.pressure;
      list[reference(row.front().node).x()] = sum / static_cast<double>(row.size());
    }
    return list;
  }
};

// Two equal cylinders that touch along a line, both soft: half width (from the second moment of the pressure, b^2/4 for an
// ellipse), peak and profile of Hertz's theory.
TEST(HertzSolids, TwoEqualCylinders) {
  for (const auto& [kind, name] : {std::pair{CellKind::hex27, "hexahedra"}, {CellKind::tet10, "tetrahedra"}}) {
    Cylinders cylinders(kind);
    solver::Scene scene = cylinders.scene();
    ASSERT_EQ(cylinders.solve(scene, 1e-9 * half_width), solver::Outcome::converged);
    double sum = 0.0, moment = 0.0;
    for (const auto& point : scene.find<solver::Contact>()->point_forces(cylinders.state))
      sum += point.force.y(), moment += point.force.y() * point.x.x() * point.x.x();
    const auto profile = cylinders.profile();
    double squares = 0.0;
    int inside = 0;
    for (const auto& [x, p] : profile) {
      if (x > 1.2 * half_width) continue;
      const double s = x / half_width, exact = s < 1.0 ? std::sqrt(1.0 - s * s) : 0.0;
      squares += (p / peak - exact) * (p / peak - exact), ++inside;
    }
    const std::string row = fmt::format("3 Hertz, two equal cylinders, lower of {}", name), source = "Hertz; reference book 3, F/100";
    book(row, "force", 2.0 * sum / thickness * scale * scale, 10.0, 1e-3, "equilibrium");
    book(row, "half width b", 2.0 * std::sqrt(moment / sum) * scale, 0.68077837, 1e-2, source);
    book(row, "peak pressure p0", profile.begin()->second * scale, 9.35135129, 1e-2, source);
    book(row, "rms of the profile over p0, to 1.2 b", std::sqrt(squares / inside), 0.0, 2e-2, source);
  }
}

}  // namespace
}  // namespace snug::tests
