// Contact without curvature: the patch test on meshes that do not match.
#include <gtest/gtest.h>

#include "solver/stepping/newton.hpp"
#include "solver/terms/contact.hpp"
#include "solver/terms/dead_load.hpp"
#include "solver/terms/fabric_membrane.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/press.hpp"

namespace snug::tests {
namespace {

using solver::Layout, solver::State;

// A sheet pressed by a uniform dead load on to a block whose mesh it does not match transmits it uniformly: the
// quadrature is cut along the facets, so that multipliers and stress are exact up to round-off (reference book 3: 1e-10
// with clipping).
TEST(FlatContact, PatchTestOnMeshesThatDoNotMatchIsExact) {
  const double pressure = 700.0, shear = 1e4;
  Press press(upright_block({3, 2, 3}, [](double x, double y, double z) { return Eigen::Vector3d(x, y, z); }),
              sheet({4, 4}, {1.0, 1.0}, [](const Eigen::Vector2d&) { return 1.0; }));
  const auto& [body, garment, layout, fixed] = press;
  for (std::size_t node = 0; node < garment.pattern.size(); ++node) {
    const Eigen::Vector2d& x = garment.pattern[node];
    const double edge = std::min({x.x(), x.y(), 1.0 - x.x(), 1.0 - x.y()});
    if (edge < 1e-12)
      for (int c = 0; c < 2; ++c) press.fixed.fix(layout["garment"](static_cast<int>(node), c));
  }
  solver::Scene scene(layout, solver::Numbering(fixed.master));
  scene.add(std::make_unique<solver::Tissue>("tissue", solver::body_fields(layout, "body"), body, std::vector<materials::SolidLaw>{tissue(shear, 0.45)}));
  input::MaterialEntry cloth;
  cloth.table = input::table_of("law = 'linear'\nwarp = '1000 N/m'\nweft = '1000 N/m'\nshear = '300 N/m'\npoisson = 0");
  scene.add(std::make_unique<solver::FabricMembrane>("garment", layout["garment"], garment, std::vector{materials::find_fabric(cloth)}, 1.05));
  scene.add(std::make_unique<solver::Contact>("contact", solver::Interface{layout["contact"], solver::garment_slave(layout["garment"], garment), solver::MasterSurface(layout["body"], body, body.skin_facets)}, 1e6,
                                              solver::GapBasis::hat));
  solver::NodalForces weight(garment.pattern.size(), Eigen::Vector3d::Zero());
  solver::add_weight(garment, {1.0}, {0.0, 0.0, -pressure}, weight);  // Pa of the pattern
  scene.add(std::make_unique<solver::DeadLoad>("weight of the garment", layout["garment"], weight));
  State state = tests::placed_state(layout, body, garment);
  state.load = 1.0;
  solver::NewtonSettings settings;
  settings.residual = 1e-12;
  const auto outcome = solver::newton(scene, state, settings, [](const postproc::Iteration&) {});
  ASSERT_EQ(outcome, solver::Outcome::converged) << to_string(outcome);

  double worst = 0.0, settled = 0.0, uneven = 0.0;
  for (int i = 0; i < layout["contact"].count; ++i)
    worst = std::max(worst, std::abs(state.values[layout["contact"](i)] / pressure - 1.0));
  std::vector<double> heights;
  for (const int node : body.surface("top")->nodes) heights.push_back(state.values[layout["body"](node, 2)]);
  for (const double z : heights) settled += z / static_cast<double>(heights.size());
  for (const double z : heights) uneven = std::max(uneven, std::abs(z - settled));
  book("3 patch test", "largest deviation of a multiplier from the load", worst, 0.0, 1e-10, "equilibrium, reference book 3");
  book("3 patch test", "unevenness of the pressed face over its settlement", uneven / (1.0 - settled), 0.0, 1e-10,
       "equilibrium, reference book 3");
}

}  // namespace
}  // namespace snug::tests
