// Contact without curvature: the patch test on meshes that do not match.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "solver/scene/constraints.hpp"
#include "solver/stepping/newton.hpp"
#include "solver/terms/contact.hpp"
#include "solver/terms/fabric_membrane.hpp"
#include "solver/terms/tissue.hpp"
#include "tests/verification/blocks.hpp"
#include "tests/verification/book.hpp"

namespace snug::tests {
namespace {

using solver::Layout, solver::State;

/// A sheet of n x n squares over [0, side]^2, each cut in two triangles, inner nodes moved by up to a fifth of a square
/// so that nothing matches; `height` (x, y) -> z is its placed shape.
template <class Height>
mesh::GarmentMesh sheet(int n, double side, const Height& height) {
  mesh::GarmentMesh mesh;
  const double h = side / n;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.2 * h, 0.2 * h);
  const auto vertex = [&](int i, int j) { return (2 * j) * (2 * n + 1) + 2 * i; };
  mesh.pattern.assign((2 * n + 1) * (2 * n + 1), Eigen::Vector2d::Zero());
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      Eigen::Vector2d x(i * h, j * h);
      if (i > 0 && i < n) x.x() += shift(random);
      if (j > 0 && j < n) x.y() += shift(random);
      mesh.pattern[vertex(i, j)] = x;
    }
  const auto middle = [&](int a, int b) {  // nodes stand in the grid of halves
    const int m = (a + b) / 2;
    mesh.pattern[m] = 0.5 * (mesh.pattern[a] + mesh.pattern[b]);
    return m;
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
      mesh.triangles.push_back({a, b, c, middle(a, b), middle(b, c), middle(c, a)});
      mesh.triangles.push_back({a, c, d, middle(a, c), middle(c, d), middle(d, a)});
    }
  for (std::size_t node = 0; node < mesh.pattern.size(); ++node) {
    const Eigen::Vector2d& x = mesh.pattern[node];
    mesh.placed.emplace_back(x.x(), x.y(), height(x));
    mesh.merged.push_back(static_cast<int>(node));
  }
  mesh.warp.assign(mesh.triangles.size(), Eigen::Vector2d::UnitX());
  mesh.mean_edge = h;
  return mesh;
}

/// A dead load p (Pa of the pattern) along -z on every triangle.
class DeadLoad final : public solver::Term {
 public:
  DeadLoad(const Layout& layout, const mesh::GarmentMesh& mesh, double pressure) : pressure_(pressure) {
    for (const auto& t : mesh.triangles) {
      std::array<int, 18> entries{};
      for (int a = 0; a < 6; ++a)
        for (int c = 0; c < 3; ++c) entries[3 * a + c] = layout.garment(t[a], c);
      entries_.push(entries);
      area_.push_back(solver::flat_triangle(mesh.pattern[t[0]], mesh.pattern[t[1]], mesh.pattern[t[2]]).area);
    }
  }
  std::string name() const override { return "dead load"; }
  const solver::ElementEntries& entries() const override { return entries_; }
  bool assemble(const State&, solver::Tangent tangent, solver::Sink& sink) const override {
    const std::vector<double> none(18 * 18, 0.0);
    for (std::size_t e = 0; e < area_.size(); ++e) {
      std::array<double, 18> residual{};
      for (int a = 3; a < 6; ++a) residual[3 * a + 2] = pressure_ * area_[e] / 3.0;  // int N_a of a mid-edge node
      sink.add(static_cast<int>(e), residual,
               solver::wanted(tangent) ? std::span<const double>(none) : std::span<const double>());
    }
    return true;
  }

 private:
  double pressure_;
  solver::ElementEntries entries_;
  std::vector<double> area_;
};

struct Fixed {
  std::vector<int> master;
  explicit Fixed(const Layout& layout) : master(layout.size()) {
    for (int i = 0; i < layout.size(); ++i) master[i] = i;
  }
  void fix(int entry) { master[entry] = -1; }
};

materials::SolidLaw tissue(double shear, double poisson) {
  input::MaterialReference reference;
  reference.table = fmt::format("law = 'neo-Hooke'\nshear_modulus = '{} Pa'\npoisson_ratio = {}", shear, poisson);
  return materials::find_tissue(reference).law;
}

/// Body under a sheet: its top is the skin, its sides slide, its bottom is held along z.
struct Press {
  mesh::BodyMesh body;
  mesh::GarmentMesh garment;
  Layout layout;
  Fixed fixed;

  Press(mesh::BodyMesh b, mesh::GarmentMesh g)
      : body(std::move(b)), garment(std::move(g)), layout(solver::make_layout(body, garment, true, true)), fixed(layout) {
    body.skin_facets = body.surface("top")->facets;
    body.mean_skin_cell = mesh::mean_edge(body, body.skin_facets);
    const auto slide = [&](const std::string& face, int component) {
      for (const int node : body.surface(face)->nodes) fixed.fix(layout.body(node, component));
    };
    slide("left", 0), slide("right", 0), slide("front", 1), slide("back", 1), slide("bottom", 2);
  }
};

/// Block of the unit cube: u along x, v upwards, w against y, so that it is right-handed.
mesh::BodyMesh upright_block(std::array<int, 3> cells, const std::function<Eigen::Vector3d(double, double, double)>& at) {
  Block block;
  block.cells = cells;
  block.map = [at](const Eigen::Vector3d& u) { return at(u.x(), 1.0 - u.z(), u.y()); };
  return make_block(block);
}

// A sheet pressed by a uniform dead load on to a block whose mesh it does not match transmits it uniformly: the
// quadrature is cut along the facets, so that multipliers and stress are exact up to round-off (reference book 3: 1e-10
// with clipping).
TEST(FlatContact, PatchTestOnMeshesThatDoNotMatchIsExact) {
  const double pressure = 700.0, shear = 1e4;
  Press press(upright_block({3, 2, 3}, [](double x, double y, double z) { return Eigen::Vector3d(x, y, z); }),
              sheet(4, 1.0, [](const Eigen::Vector2d&) { return 1.0; }));
  const auto& [body, garment, layout, fixed] = press;
  for (std::size_t node = 0; node < garment.pattern.size(); ++node) {
    const Eigen::Vector2d& x = garment.pattern[node];
    const double edge = std::min({x.x(), x.y(), 1.0 - x.x(), 1.0 - x.y()});
    if (edge < 1e-12)
      for (int c = 0; c < 2; ++c) press.fixed.fix(layout.garment(static_cast<int>(node), c));
  }
  solver::Scene scene(layout, solver::Numbering(fixed.master));
  scene.add(std::make_unique<solver::Tissue>(layout, body, std::vector<materials::SolidLaw>{tissue(shear, 0.45)}));
  input::MaterialReference cloth;
  cloth.table = "law = 'linear'\nwarp = '1000 N/m'\nweft = '1000 N/m'\nshear = '300 N/m'\npoisson = 0";
  scene.add(std::make_unique<solver::FabricMembrane>(layout, garment, materials::find_fabric(cloth), 1.05));
  scene.add(std::make_unique<solver::Contact>(layout, garment, body, true, 1e6, solver::GapBasis::hat));
  scene.add(std::make_unique<DeadLoad>(layout, garment, pressure));
  State state = solver::placed_state(layout, body, garment);
  state.load = 1.0;
  solver::NewtonSettings settings;
  settings.residual = 1e-12;
  const auto outcome = solver::newton(scene, state, settings, [](const postproc::Iteration&) {});
  ASSERT_EQ(outcome, solver::Outcome::converged) << to_string(outcome);

  double worst = 0.0, settled = 0.0, uneven = 0.0;
  for (int i = 0; i < layout.multipliers; ++i)
    worst = std::max(worst, std::abs(state.values[layout.multiplier(i)] / pressure - 1.0));
  std::vector<double> heights;
  for (const int node : body.surface("top")->nodes) heights.push_back(state.values[layout.body(node, 2)]);
  for (const double z : heights) settled += z / static_cast<double>(heights.size());
  for (const double z : heights) uneven = std::max(uneven, std::abs(z - settled));
  book("3 patch test", "largest deviation of a multiplier from the load", worst, 0.0, 1e-10, "equilibrium, reference book 3");
  book("3 patch test", "unevenness of the pressed face over its settlement", uneven / (1.0 - settled), 0.0, 1e-10,
       "equilibrium, reference book 3");
}

}  // namespace
}  // namespace snug::tests
