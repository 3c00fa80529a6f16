#include "mesh/garment/garment_cut.hpp"
#include "mesh/garment/tube_pattern.hpp"
#include "mesh/pattern/trimming.hpp"
#include "mesh/placement/closed_skin.hpp"
#include "mesh/placement/garment_rings.hpp"
#include "tests/unit/mesh/bodies.hpp"
#include "tests/unit/mesh/branching_bodies.hpp"
#include "tests/unit/mesh/patterns.hpp"
#include "tests/unit/mesh/placement_patterns.hpp"

namespace snug::mesh {

namespace {

using ::testing::HasSubstr;

const BodyMesh& child() {
  static const BodyMesh body = hips_body(0.023);
  return body;
}

const DressForm& child_form() {
  static const DressForm form(body_of_skin(child(), {"hips"}));
  return form;
}

GarmentCut shorts() {
  GarmentCut cut;
  cut.spec.name = "shorts", cut.spec.pattern.kind = input::PatternKind::sewn;
  cut.pattern = checked_toml(test_shorts);
  return cut;
}

}  // namespace

// A body of cells is told to branch by its skin: three cuts, or two loops side by side; a tube is none.
TEST(ClosedSkin, HipsBranchAndALimbDoesNot) {
  EXPECT_TRUE(branches(child()));
  EXPECT_FALSE(one_loop_between(child(), 0.05, 0.40));
  EXPECT_TRUE(one_loop_between(child(), 0.28, 0.45));
  EXPECT_FALSE(branches(make_body_mesh(layered_spec(), cylinder())));
}

// The lids close the skin: as much volume as the cells have, and the origin between the legs.
TEST(ClosedSkin, LidsCloseIt) {
  const BodySurface body = body_of_skin(child(), {});
  EXPECT_EQ(skin_borders(body.surface).size(), 0u);
  double cells = 0.0, surface = 0.0;
  for (const auto& row : quality(child())) cells += row.volume;
  for (const auto& t : body.surface.triangles) {
    const auto& x = body.surface.vertices;
    surface += x[t[0]].dot(x[t[1]].cross(x[t[2]])) / 6.0;
  }
  EXPECT_NEAR(surface, cells, 5e-3 * cells);  // a curved facet is four flat ones, of some 7 mm on radii of 50 mm and more
  EXPECT_NEAR(body.translation.x(), 0.0, 1e-6);
  EXPECT_TRUE(body.is_cut());
}

// A body that is cut has the landmarks that are left of it: crotch where the function joins the legs, no armpits.
TEST(ClosedSkin, LandmarksOfACutBody) {
  const Landmarks& marks = child_form().marks;
  EXPECT_TRUE(marks.legs);
  EXPECT_FALSE(marks.arms);
  EXPECT_NEAR(marks.ankle, 0.0, 1e-9);
  double crotch = 0.1;
  while (hips({0.0, 0.0, crotch}) > 0.0) crotch += 1e-4;  // lowest point of the middle that is inside
  EXPECT_GT(marks.crotch, crotch - 0.005);
  EXPECT_LT(marks.crotch, crotch + 0.025);  // where it reaches across by 0.024 of the scale
}

// Legs that stand apart, an ankle as far from the middle as half of the thigh's height, have sections down to their cuts.
TEST(ClosedSkin, LegsThatStandApartAreFoundDownToTheirCuts) {
  const auto straddling = [](const Eigen::Vector3d& p) {
    const Eigen::Vector3d q(std::abs(p.x()), p.y(), p.z()), flat(q.x() / 1.3, q.y(), q.z());
    return std::min(round_cone(flat, {0, 0, 0.32}, {0, 0, 0.62}, 0.088, 0.08), round_cone(q, {0.21, 0, -0.1}, {0.062, 0, 0.30}, 0.040, 0.056));
  };
  const DressForm form(body_of_skin(ImplicitBody(straddling, {0.24, 0.11}, 0.0, 0.46, 0.023, 0.03).take(), {"hips"}));
  for (const Side side : {Side::right, Side::left})
    for (const double z : {0.01, 0.05, 0.15}) {
      const auto leg = form.sections.leg(side, z);
      ASSERT_TRUE(leg) << z;
      EXPECT_NEAR(sign_of(side) * leg->centroid.x(), 0.21 - 0.148 * (z + 0.1) / 0.4, 0.005) << z;
    }
}

// Shorts on hips: one mesh for the solver, with the pattern's areas, open edges and names, round each leg and the trunk, outside the body.
TEST(BranchingPlacement, ShortsAreLaidOnHips) {
  const GarmentMesh mesh = make_garment_mesh(shorts(), child_form(), 0.015);
  EXPECT_EQ(mesh.edges.size(), 3u);
  EXPECT_TRUE(mesh.edges.contains("waist"));
  ASSERT_EQ(mesh.fit.limbs.size(), 3u);
  for (const LimbFit& limb : mesh.fit.limbs) {
    EXPECT_GT(limb.rows.size(), 5u) << limb.limb;
    const FitRow& middle = limb.rows[limb.rows.size() / 2];
    EXPECT_GT(middle.girth / middle.body, 0.78) << limb.limb;
    EXPECT_LT(middle.girth / middle.body, 0.95) << limb.limb;
  }
  EXPECT_EQ(mesh.stand_off, 0.0);
  double deepest = 1.0, area = 0.0, pieces = 0.0;
  for (const auto& x : mesh.placed) deepest = std::min(deepest, hips(x));
  EXPECT_GT(deepest, -0.002);  // by the function itself: chords of the skin and of the cloth
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector2d u = mesh.pattern[t[1]] - mesh.pattern[t[0]], v = mesh.pattern[t[2]] - mesh.pattern[t[0]];
    area += 0.5 * (u.x() * v.y() - u.y() * v.x());
  }
  const GarmentCut cut = shorts();
  for (const Piece& piece : cut.pattern->pattern.pieces) pieces += mesh::area(piece);
  EXPECT_NEAR(area, pieces, 2e-3 * pieces);
}

// The right leg is laid as the left one is: girths of cloth and body by height agree from side to side.
TEST(BranchingPlacement, BothLegsAlike) {
  const GarmentFit fit = placed_fit(shorts(), child_form());
  const auto rows = [&](const char* name) {
    for (const LimbFit& limb : fit.limbs)
      if (limb.limb == name) return limb.some_rows(5);
    return std::vector<FitRow>{};
  };
  const auto right = rows("right leg"), left = rows("left leg");
  ASSERT_EQ(right.size(), 5u);
  ASSERT_EQ(left.size(), 5u);
  for (std::size_t n = 0; n < 4; ++n) {  // the highest may reach into the crotch
    EXPECT_NEAR(right[n].body, left[n].body, 0.02 * left[n].body);
    EXPECT_NEAR(right[n].girth, left[n].girth, 0.03 * left[n].girth);
  }
}

// Shorts that are cut off on the hips, so low that their centre seams lie flatter than they rise, are shorts still: their fork is where the inseams end.
TEST(BranchingPlacement, ShortsCutLowOnTheHipsHaveLegs) {
  const Pattern low = trimmed(shorts().pattern->pattern, 0.0, 0.150, {});  // the centre seams go 12 mm across and 10 mm up
  const GarmentRings rings = find_rings(checked(low));
  EXPECT_EQ(rings.kind, GarmentKind::legs);
  EXPECT_NEAR(rings.fork - rings.hem, 0.14, 1e-4);  // y from 80 to 220 mm in the drawing
  GarmentCut cut = shorts();
  cut.pattern = checked(low);
  EXPECT_EQ(make_garment_mesh(cut, child_form(), 0.015).edges.size(), 3u);
}

// The keys of a case work as on a limb: a lowest point, factors of the pattern's size; and what they make impossible is refused with lengths.
TEST(BranchingPlacement, StartHeightAndScale) {
  GarmentCut cut = shorts();
  cut.spec.position = 0.07;
  const GarmentMesh lower = make_garment_mesh(cut, child_form(), 0.015);
  EXPECT_NEAR(lower.fit.lower, 0.07, 0.012);
  cut.spec.position.reset();
  cut.pattern = checked(graded(cut.pattern->pattern, 1.1, 1.0));
  const MeanFit usual = mean_fit(placed_fit(shorts(), child_form())), wider = mean_fit(placed_fit(cut, child_form()));
  EXPECT_NEAR(wider.garment_girth / usual.garment_girth, 1.1, 0.02);
  cut.spec.position = 0.20;
  EXPECT_THAT(refusal([&] { make_garment_mesh(cut, child_form(), 0.015); }), HasSubstr("from fork to hem"));
  GarmentCut high = shorts();
  high.pattern = checked(graded(high.pattern->pattern, 1.0, 1.6));
  EXPECT_THAT(refusal([&] { make_garment_mesh(high, child_form(), 0.015); }), ::testing::AnyOf(HasSubstr("beyond a cut"), HasSubstr("from fork to hem")));
}

// What hangs on shoulders, on a body that has none, is refused by what is missing.
TEST(BranchingPlacement, ABodyWithoutShouldersIsNamed) {
  GarmentCut vest = shorts();
  vest.pattern = checked_toml(test_vest);
  EXPECT_THAT(refusal([&] { make_garment_mesh(vest, child_form(), 0.02); }), HasSubstr("the body has none"));
}

// A tube on the trunk of such a body is the pattern of one piece that it is; its edges have their names, its lowest point its height.
TEST(BranchingPlacement, ATubeGoesRoundTheTrunk) {
  GarmentCut band;
  band.spec = tube_spec(0.52, 0.08, 0.30);
  const GarmentMesh mesh = make_garment_mesh(band, child_form(), 0.015);
  EXPECT_TRUE(mesh.edges.contains("upper"));
  EXPECT_TRUE(mesh.edges.contains("lower"));
  ASSERT_EQ(mesh.fit.limbs.size(), 1u);
  EXPECT_EQ(mesh.fit.limbs.front().limb, "trunk");
  EXPECT_NEAR(mesh.fit.lower, 0.30, 0.008);
  const FitRow& middle = mesh.fit.limbs.front().rows[mesh.fit.limbs.front().rows.size() / 2];
  EXPECT_NEAR(middle.girth, 0.52, 0.006);
}

}  // namespace snug::mesh
