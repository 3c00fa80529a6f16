// Shell bodies against plate and membrane theory, and on springs.
#include "tests/verification/book.hpp"
#include "tests/verification/shell_models.hpp"

namespace snug::tests {
namespace {

/// A quarter of a clamped square plate, side 1 m, n x n pairs of triangles, under a load that bends it by a thousandth of its
/// thickness; deflection of its middle over q L^4/D.
double clamped_plate(int n, double thickness) {
  const double E = 1e6, nu = 0.3, D = E * std::pow(thickness, 3) / (12.0 * (1.0 - nu * nu));
  mesh::Model model = square_shell(n, n, [](double u, double v) { return Eigen::Vector3d(0.5 * u, 0.5 * v, 0.0); }, E, nu, thickness);
  hold(model, [](const Eigen::Vector3d& x) { return x.x() > 0.5 - 1e-9 || x.y() > 0.5 - 1e-9; }, {0, 1, 2, 3, 4, 5});
  hold_symmetry(model, {0, 1});
  BlockCase c = shell_case(model);
  const double q = 1e-3 * thickness * D / 1.265e-3;
  c.traction("skin", 0.0, 0.0, q);
  return solve(c, 1.0).displacement(c.mesh, {0.0, 0.0, 0.0}).z() * D / q;
}

TEST(Shells, AClampedSquarePlateBendsAsKirchhoffSaysAtAnyThickness) {
  // Constant curvature in a triangle: the error falls by four when the mesh is halved.
  const double exact = 0.0012653190871;
  const double coarse = clamped_plate(24, 1e-2), fine = clamped_plate(48, 1e-2);
  book("clamped plate", "w_c D/(q L^4), 48 x 48 on a quarter", fine, exact, 1e-3, "reference book 2.2 (Ritz)");
  EXPECT_NEAR((coarse - exact) / (fine - exact), 4.0, 0.4);
  for (const double thickness : {1e-1, 1e-3})
    book("clamped plate", fmt::format("w_c D/(q L^4), t/L = {:.0e}", thickness), clamped_plate(48, thickness), exact, 1e-3, "reference book 2.2 (Ritz)");
}

enum class Edge { clamped, supported };

/// The middle of a plate under a small uniform load over q / D: of a square of side 1 m or a disc of radius 1 m.
double plate_middle(bool disc, Edge edge, int n) {
  const double E = 1e6, nu = 0.3, thickness = 1e-2, D = E * std::pow(thickness, 3) / (12.0 * (1.0 - nu * nu));
  mesh::Model model = disc ? quarter_disc(n, 1.0, E, nu, thickness)
                           : square_shell(n, n, [](double u, double v) { return Eigen::Vector3d(0.5 * u, 0.5 * v, 0.0); }, E, nu, thickness);
  const auto border = [&](const Eigen::Vector3d& x) { return disc ? x.norm() > 1.0 - 1e-9 : x.x() > 0.5 - 1e-9 || x.y() > 0.5 - 1e-9; };
  hold(model, border, edge == Edge::clamped ? std::vector{0, 1, 2, 3, 4, 5} : std::vector{0, 1, 2});
  hold_symmetry(model, {0, 1});
  BlockCase c = shell_case(model);
  const double q = 1e-2 * thickness * D;
  c.traction("skin", 0.0, 0.0, q);
  return solve(c, 1.0).displacement(c.mesh, {0.0, 0.0, 0.0}).z() * D / q;
}

// The plates of the textbook: Navier's simply supported square, clamped and simply supported discs.
TEST(Shells, SupportedSquaresAndDiscsBendAsPlateTheorySays) {
  struct Row { std::string name; bool disc; Edge edge; double exact; };
  for (const Row& row : {Row{"simply supported square, w_c D/(q L^4)", false, Edge::supported, 0.004062353},
                         Row{"clamped disc, w_c D/(q a^4)", true, Edge::clamped, 1.0 / 64.0},
                         Row{"simply supported disc, nu = 0.3, w_c D/(q a^4)", true, Edge::supported, 0.063701923}})
    book("plates", row.name, plate_middle(row.disc, row.edge, row.disc ? 144 : 48), row.exact, 1e-3, "reference book 2.2 (Navier; closed form)");
}

// A strip that hangs from its clamped end by its own weight, q = w L^3/B (the cantilever test of fabrics), comes to the place
// of the heavy elastica.
TEST(Shells, AStripUnderItsOwnWeightHangsAsTheHeavyElastica) {
  struct Row { double q, x, y; };
  const double E = 1.2e6, thickness = 1e-3, B = E * std::pow(thickness, 3) / 12.0;
  for (const Row& row : {Row{2.0, 0.9668929469, 0.2385065829}, Row{8.0, 0.7244247341, 0.6406307174}, Row{20.0, 0.4452320522, 0.8298814434}}) {
    mesh::Model model = square_shell(80, 2, [](double u, double v) { return Eigen::Vector3d(u, 0.025 * v, 0.0); }, E, 0.0, thickness);
    hold(model, [](const Eigen::Vector3d& x) { return x.x() < 1e-9; }, {0, 1, 2, 3, 4, 5});
    BlockCase c = shell_case(model);
    c.traction("skin", 0.0, 0.0, -row.q * B);
    const Eigen::Vector3d tip = solve(c, 0.1).displacement(c.mesh, {1.0, 0.0125, 0.0});
    const std::string scene = fmt::format("drape of a strip, w L^3/B = {}", row.q);
    book(scene, "x of the tip over L", 1.0 + tip.x(), row.x, 1e-3, "reference book 2.3: heavy elastica (s04)");
    book(scene, "fall of the tip over L", -tip.z(), row.y, 1e-3, "reference book 2.3: heavy elastica (s04)");
  }
}

struct Sphere {
  double displacement, stress, spread;  ///< radial, mean; mean membrane stress; largest less smallest displacement
};

Sphere pressurised_sphere(int n, double R, double t, double E, double nu, double p) {
  mesh::Model model = octant(n, R, E, nu, t);
  hold_symmetry(model, {0, 1, 2});
  BlockCase c = shell_case(model);
  c.pressure("skin", -p);  // from within
  const BlockAnswer answer = solve(c, 1.0);
  const double share = 1.0 / static_cast<double>(c.mesh.nodes.size());
  Sphere sphere{0.0, 0.0, 0.0};
  double low = 1.0, high = 0.0;
  for (std::size_t k = 0; k < c.mesh.nodes.size(); ++k) {
    const double u = answer.result.body.fields[postproc::field::displacement][k].dot(c.mesh.nodes[k]) / R;
    sphere.displacement += share * u, low = std::min(low, u), high = std::max(high, u);
    sphere.stress += share * answer.result.body.fields[postproc::field::cauchy_stress][k].head<3>().sum() / 2.0;
  }
  sphere.spread = high - low;
  return sphere;
}

TEST(Shells, APressurisedSphereStretchesAsAMembrane) {
  // u = p R^2 (1 - nu)/(2 E t), sigma = p R/(2 t): membrane theory, exact but for (t/R)^2/12 = 8e-6 of bending; small p.
  const double R = 0.1, t = 1e-3, E = 1e6, nu = 0.3, p = 1e-3, exact = p * R * R * (1.0 - nu) / (2.0 * E * t);
  const Sphere coarse = pressurised_sphere(16, R, t, E, nu, p), fine = pressurised_sphere(32, R, t, E, nu, p);
  book("pressurised sphere", "mean radial displacement [m]", fine.displacement, exact, 1e-4, "membrane theory: p R^2 (1 - nu)/(2 E t)");
  book("pressurised sphere", "mean membrane stress [Pa]", fine.stress, p * R / (2.0 * t), 1e-4, "membrane theory: p R/(2 t)");
  EXPECT_LT(fine.spread, 1e-3 * exact);        // everywhere the same ...
  EXPECT_LT(fine.spread, coarse.spread / 4.0);  // ... the better the finer the mesh
}

TEST(Shells, ACantileverUnderEndShearFollowsTheElastica) {
  // Sze, Liu & Lo 2004, sec. 4.1, with the exact inextensible elastica: L = 10, b = 1, h = 0.1, E = 1.2e6, nu = 0, P = 4.
  mesh::Model model = square_shell(40, 4, [](double u, double v) { return Eigen::Vector3d(10.0 * u, v, 0.0); }, 1.2e6, 0.0, 0.1);
  hold(model, [](const Eigen::Vector3d& x) { return x.x() < 1e-9; }, {0, 1, 2, 3, 4, 5});
  BlockCase c = shell_case(model);
  name_nodes(c.mesh, "end", [](const Eigen::Vector3d& x) { return x.x() > 10.0 - 1e-9; });
  input::Force& force = c.c.load->force.emplace_back();
  force.on = "end", force.value = {0.0, 0.0, 4.0};
  const BlockAnswer answer = solve(c, 0.1);
  const Eigen::Vector3d tip = answer.displacement(c.mesh, {10.0, 0.5, 0.0});
  book("cantilever, end shear", "w at the tip", tip.z(), 6.699641813, 1e-3, "reference book 2.1, table 3.1: exact elastica (s04)");
  book("cantilever, end shear", "-u at the tip", -tip.x(), 3.289412422, 1e-3, "reference book 2.1, table 3.1: exact elastica (s04)");
}

TEST(Shells, AFoundationAloneCarriesAPistonsLoad) {
  // A free flat plate on springs k under a uniform traction q sinks by q/k everywhere, whatever its stiffness.
  mesh::Model model = square_shell(3, 3, [](double u, double v) { return Eigen::Vector3d(u, v, 0.0); }, 1e6, 0.3, 0.01);
  model.sections[0].foundation = 4e3;
  hold(model, [](const Eigen::Vector3d& x) { return x.norm() < 1e-9; }, {0, 1});
  hold(model, [](const Eigen::Vector3d& x) { return (x - Eigen::Vector3d(1, 0, 0)).norm() < 1e-9; }, {1});
  BlockCase c = shell_case(model);
  c.traction("skin", 0.0, 0.0, 0.02);
  const BlockAnswer answer = solve(c, 1.0);
  for (const Eigen::Vector3d& u : answer.result.body.fields[postproc::field::displacement]) EXPECT_NEAR(u.z(), 0.02 / 4e3, 1e-12);
}

}  // namespace
}  // namespace snug::tests
