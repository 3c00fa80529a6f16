// Sheets that wrinkle: the relaxed law carries tension along the wrinkles and nothing across (reference book 2.5).
#include "tests/verification/book.hpp"
#include "tests/verification/membrane_scene.hpp"

namespace snug::tests {
namespace {

constexpr double fine = 1e-6;  ///< residual stiffness in compression: its share of the answers is of its own size

/// A ring between the radii 1 and `outer`, both rims held, the inner one turned by a small angle.
Sheet ring(double outer, double nu, int around, int across) {
  mesh::GarmentMesh mesh = mapped_sheet(around, across, [&](double u, double v) {
    const double a = -2.0 * std::numbers::pi * u, r = 1.0 + (outer - 1.0) * v * v;
    return Plane(r * std::cos(a), r * std::sin(a));
  }, on_arc);
  std::map<std::pair<long, long>, int> place;  // sews the ends
  for (std::size_t node = 0; node < mesh.pattern.size(); ++node) {
    const auto key = std::pair(std::lround(1e9 * mesh.pattern[node].x()), std::lround(1e9 * mesh.pattern[node].y()));
    mesh.merged[node] = place.emplace(key, static_cast<int>(node)).first->second;
  }
  return {std::move(mesh), isotropic(1.0, nu)};
}

/// Torque over angle and Eh.
double torque(double outer, double nu, double eta, int across = 16) {
  Sheet sheet = ring(outer, nu, 4 * across, across);
  const double turn = 1e-5;
  const auto inner = [](const Plane& x) { return x.norm() < 1.0 + 1e-9; };
  sheet.eta = eta;
  sheet.hold({2}, [](const Plane&) { return true; });
  sheet.hold({0, 1}, [&](const Plane& x) { return inner(x) || x.norm() > outer - 1e-9; });
  for (int node = 0; node < sheet.size(); ++node) {
    for (int c = 0; c < 3; ++c)
      sheet.master[sheet.layout["garment"](node, c)] = sheet.master[sheet.layout["garment"](sheet.mesh.merged[node], c)];
    // Starts with the turn of a sheet that does not wrinkle.
    const Plane& x = sheet.mesh.pattern[node];
    const double t = turn * (outer * outer / x.squaredNorm() - 1.0) / (outer * outer - 1.0);
    sheet.mesh.placed[node] = {std::cos(t) * x.x() - std::sin(t) * x.y(), std::sin(t) * x.x() + std::cos(t) * x.y(), 0.0};
  }
  sheet.settings.newton.residual = 1e-12;  // of a force of 1e-3 Eh, at strains of 1e-5
  sheet.solve([](solver::State& state, double) { state.load = 1.0; });
  double sum = 0.0;
  for (const auto& [node, f] : sheet.reactions(inner)) sum += sheet.at(node).x() * f.y() - sheet.at(node).y() * f.x();
  return sum / turn;
}

// A twisted ring wrinkles everywhere; its tension runs along straight rays (Reissner 1938, Mansfield 1969).
TEST(TensionField, TwistedRingCarriesTheTorqueOfStraightRays) {
  struct Row {
    double outer, exact, poisson, unwrinkled;  ///< M/(Eh a^2 phi): nu = 0; nu = 0.3; nu = 0.3 without wrinkles
  };
  for (const Row& row : std::vector<Row>{{1.5, 5.3768364416, 5.37683658, 8.69979504},
                                         {2.0, 3.6780449287, 3.67828353, 6.44429262},
                                         {3.0, 2.7079735341, 2.71121228, 5.43737190},
                                         {5.0, 2.1041874728, 2.10916353, 5.03460361}}) {
    const std::string scene = fmt::format("2.5 twisted ring, b/a = {:g}", row.outer);
    book(scene, "M/(E h a^2 phi), nu 0", torque(row.outer, 0.0, fine), row.exact, 1e-4, "reference book 2.5, closed form (s05)");
    book(scene, "M/(E h a^2 phi), nu 0.3", torque(row.outer, 0.3, fine), row.poisson, 1e-4, "reference book 2.5, relaxed radial elements (s05)");
    book(scene, "M/(E h a^2 phi), nu 0.3, not relaxed", torque(row.outer, 0.3, 1.0), row.unwrinkled, 1e-4, "4 pi (G/E)/(1 - a^2/b^2)");
  }
}

// W + eta (W - W_r) costs the torque a part in proportion to eta, twice as much here.
TEST(TensionField, ResidualStiffnessCostsInProportion) {
  const double none = torque(2.0, 0.0, 1e-8, 8);
  const auto cost = [&](double eta) { return torque(2.0, 0.0, eta, 8) / none - 1.0; };
  EXPECT_NEAR(cost(1e-3) / 1e-3, 2.0, 0.2);
  EXPECT_NEAR(cost(1e-3) / cost(1e-4), 10.0, 0.2);
}

struct Shear {
  double gamma, along, across;  ///< P12, P22 per Eh
};
const std::vector<Shear> shears = {{0.01, 0.002537750781, 0.002525093749},
                                   {0.1, 0.029007805675, 0.027593652514},
                                   {0.5, 0.254780097671, 0.198926289083}};

TEST(TensionField, ShearedSheetPullsAlongItsLargestStrain) {
  for (const Shear& row : shears) {
    Eigen::Matrix<double, 3, 2> F = Eigen::Matrix<double, 3, 2>::Identity();
    F(0, 1) = row.gamma;
    const std::string scene = fmt::format("2.5 simple shear {:g}", row.gamma), source = "reference book 2.5 (s09 G)";
    const Eigen::Vector3d P = F * line_forces(isotropic(1.0, 0.0), F, 0.0).col(1);
    book(scene, "P12/(E h), one point", P.x(), row.along, 1e-9, source);
    book(scene, "P22/(E h), one point", P.y(), row.across, 1e-9, source);

    Sheet sheet(mapped_sheet(4, 4, [](double u, double v) { return Plane(u + 0.1 * u * v * (1 - u) * (1 - v), v); }), isotropic(1.0, 0.0));
    const auto rim = [](const Plane& x) { return std::min({x.x(), x.y(), 1.0 - x.x(), 1.0 - x.y()}) < 1e-9; };
    sheet.eta = 1e-10;
    sheet.hold({2}, [](const Plane&) { return true; });
    sheet.hold({0, 1}, rim);
    for (int node = 0; node < sheet.size(); ++node)
      if (rim(sheet.mesh.pattern[node])) sheet.mesh.placed[node].x() += row.gamma * sheet.mesh.pattern[node].y();
    sheet.solve([](solver::State& state, double) { state.load = 1.0; });
    Eigen::Vector3d top = Eigen::Vector3d::Zero();
    for (const auto& [node, f] : sheet.reactions([](const Plane& x) { return x.y() > 1.0 - 1e-9; })) top += f;
    book(scene, "P12/(E h), 32 triangles", top.x(), row.along, 1e-8, source);
    book(scene, "P22/(E h), 32 triangles", top.y(), row.across, 1e-8, source);
  }
}

}  // namespace
}  // namespace snug::tests
