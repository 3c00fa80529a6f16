// Strips that are long across the drawing, blown up, pulled across or hung up from flat and free of stress (reference
// book 2.8, 3 and 4 B).
#include "tests/verification/book.hpp"
#include "tests/verification/membrane_scene.hpp"
#include "tests/verification/straight_fabric.hpp"

namespace snug::tests {
namespace {

/// From x = -1 to 1 m, held at both ends; a slice of it, 0.1 m wide, cannot change its width.
Sheet bridge(int cells, const materials::Fabric& fabric) {
  Sheet sheet(mapped_sheet(cells, 1, [](double u, double v) { return Plane(2.0 * u - 1.0, 0.1 * v); }), fabric);
  sheet.hold({1}, [](const Plane&) { return true; });
  sheet.hold({0, 2}, [](const Plane& x) { return std::abs(x.x()) > 1.0 - 1e-9; });
  return sheet;
}

TEST(FlatStrip, BlownUpItIsAnArcOfACircle) {
  struct Row {
    double load, angle, tension, height;  ///< p l/K, half angle (rad), T/(p l), w0/l
  };
  const double K = 1000.0;
  for (const Row& row : std::vector<Row>{{1e-4, 0.084353269580, 11.8689755897, 0.042201661494},
                                         {1e-3, 0.181812201055, 5.5306002259, 0.091157344618},
                                         {1e-2, 0.392493388954, 2.6144242721, 0.198805453961},
                                         {1e-1, 0.853750156641, 1.3266995585, 0.454844227334}}) {
    Sheet sheet = bridge(24, straight_fabric(K, 0.5 * K));
    sheet.pressure = row.load * K;
    sheet.solve();
    Eigen::Vector2d pull = Eigen::Vector2d::Zero();  // of one end, over the width
    for (const auto& [node, f] : sheet.reactions([](const Plane& x) { return x.x() > 1.0 - 1e-9; })) pull += Plane(f.x(), -f.z()) / 0.1;
    const std::string scene = fmt::format("2.8 inflated strip, p l/K = {:g}", row.load), source = "reference book 2.8, closed form";
    book(scene, "half angle, rad", std::atan2(pull.y(), pull.x()), row.angle, 1e-4, source);
    book(scene, "tension over p l", pull.norm() / sheet.pressure, row.tension, 1e-4, source);
    // The mean across (Simpson's rule): little holds the single node of a slice that no tension crosses.
    const auto height = [&](double y) { return sheet.at(sheet.node_at({0.0, y})).z(); };
    book(scene, "height over half width", (height(0.0) + 4.0 * height(0.05) + height(0.1)) / 6.0, row.height, 1e-4, source);
  }
}

// Two bars in line, without tension and so without stiffness across, sag by w under P = k w^3 (St Venant-Kirchhoff) or
// P = 2 k w (1 - 1/sqrt(1 + w^2)) (engineering strain).
TEST(FlatStrip, SagsUnderALoadAcrossWithoutPrestress) {
  struct Row {
    double sag, engineering, svk;
  };
  const auto sag = [](const materials::Fabric& fabric, double load) {
    Sheet sheet = bridge(2, fabric);
    const auto middle = [](const Plane& x) { return std::abs(x.x()) < 1e-9; };
    for (int node = 0; node < sheet.size(); ++node)  // Simpson's rule: int N_a along the line
      if (middle(sheet.mesh.pattern[node]))
        sheet.forces[node].z() = load * 0.1 * (std::abs(sheet.mesh.pattern[node].y() - 0.05) < 1e-9 ? 4.0 : 1.0) / 6.0;
    sheet.solve();
    EXPECT_EQ(sheet.answer.increments, 1);
    return sheet.at(sheet.node_at({0.0, 0.05})).z();
  };
  for (const Row& row : std::vector<Row>{{0.001, 9.99999250118053e-10, 1e-9},
                                         {0.01, 9.99925006247464e-07, 1e-6},
                                         {0.1, 0.000992561958002158, 1e-3},
                                         {0.5, 0.105572809000084, 0.125}}) {
    const std::string scene = fmt::format("4 B flat cable, w/l = {:g}", row.sag);
    book(scene, "sag, engineering strain", sag(straight_fabric(1.0, 0.5 * 1.0), row.engineering), row.sag, 1e-6, "reference book 4 B, closed form");
    book(scene, "sag, St Venant-Kirchhoff", sag(isotropic(1.0, 0.0), row.svk), row.sag, 1e-6, "reference book 4 B, closed form");
  }
}

// Its own weight w per area stretches a hanging strip of length L and line stiffness k by w L^2/(2 k).
TEST(FlatStrip, HangingItStretchesUnderItsOwnWeight) {
  const double k = 100.0, weight = 1.4709975;
  Sheet sheet(mapped_sheet(2, 6, [](double u, double v) { return Plane(0.2 * u, -v); }), straight_fabric(k, 0.5 * k));
  sheet.hold({0, 2}, [](const Plane&) { return true; });
  sheet.hold({1}, [](const Plane& x) { return x.y() > -1e-9; });
  solver::add_weight(sheet.mesh, {weight / 9.80665}, {0.0, -9.80665, 0.0}, sheet.forces);
  sheet.solve();
  book("3 hanging strip", "elongation, m", -1.0 - sheet.at(sheet.node_at({0.0, -1.0})).y(), 0.0073549875, 1e-6, "w L^2/(2 k), reference book 3");
}

}  // namespace
}  // namespace snug::tests
