// A sleeve on a soft tube does not know how it was cut: against the exact radial solution, whatever its pieces and seams.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mesh/garment/garment_cut.hpp"
#include "mesh/pattern/toml_pattern.hpp"
#include "tests/pattern_texts.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/tube.hpp"

namespace snug::tests {
namespace {

constexpr double exact = 6202.61651745;  // Pa, reference book 1.6 C (s03_layered_tube_sleeve), row 1layer 0.4900 44 SVK 1000

// The case of that row with a sleeve of these pieces.
postproc::RunResult sewn(int pieces, double lean) {
  TubeCase tube;
  tube.around = 24, tube.along = 4, tube.through = 4;
  input::Case c = describe_tube(tube);
  c.garments.front().fabric.table = input::table_of("law = 'linear'\nwarp = '1000 N/m'\nweft = '1000 N/m'\nshear = '300 N/m'\npoisson = 0");
  solver::Meshes meshes;
  meshes.limb = mesh::make_limb(*c.body);
  meshes.body = mesh::make_body_mesh(*c.body, meshes.limb);
  const std::string text = tube_text(pieces, 2e3 * std::numbers::pi * tube.sleeve, 1e3 * tube.length, lean);
  const mesh::GarmentCut cut{c.garments.front(), mesh::checked(mesh::parse_toml_pattern(text, "sleeve.toml"))};
  const double cell = solver::worn_cell_size(solver::make_model(c, meshes.body), 0, mesh::placed_fit(cut, meshes.limb), meshes.limb, meshes.body);
  meshes.garments.push_back(mesh::make_garment_mesh(cut, meshes.limb, cell));
  return tests::solve(c, meshes);
}

TEST(Seams, ASleevePressesAlikeHoweverItIsCut) {
  // One piece, two halves, four quarters, and three pieces with slanting seams give the exact pressure as the tube of one rectangle does (2.0e-5).
  for (const auto& [pieces, lean, name] : {std::tuple{1, 0.0, "one piece"}, std::tuple{2, 0.0, "two halves"}, std::tuple{4, 0.0, "four quarters"},
                                           std::tuple{3, 25.0, "three pieces, slanting seams"}}) {
    const postproc::RunResult result = sewn(pieces, lean);
    ASSERT_EQ(result.status, postproc::Status::converged) << name << ": " << result.message;
    book("sewn sleeve on a soft tube", fmt::format("pressure, Pa: {}", name), result.numbers.at("mean_contact_pressure_Pa"), exact, 3e-5, "reference book 1.6 C");
    double most = 0.0;
    long nodes = 0;
    for (const double p : result.body.fields[postproc::field::contact_pressure])
      if (p > 0.5 * exact) most = std::max(most, std::abs(p / exact - 1.0)), ++nodes;
    EXPECT_GT(nodes, 300);
    fmt::print("{}: {} nodes, largest error of one {:.1e}\n", name, nodes, most);
    EXPECT_LT(most, 2e-3) << name;
  }
}

}  // namespace
}  // namespace snug::tests
