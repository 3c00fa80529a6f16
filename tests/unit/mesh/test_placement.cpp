#include "mesh/placement/place_garment.hpp"

#include <numbers>

#include "mesh/placement/fit_on_body.hpp"
#include "mesh/placement/garment_chart.hpp"
#include "tests/unit/mesh/patterns.hpp"
#include "tests/unit/mesh/placement_patterns.hpp"
#include "tests/unit/mesh/standing_bodies.hpp"

namespace snug::mesh {

namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

TriangleSurface sphere(const Vector3d& centre, double radius, double size) {
  const auto round = [&](const Vector3d& p) { return (p - centre).norm() - radius; };
  const Vector3d reach = Vector3d::Constant(radius + 2.0 * size);
  return MarchingTetrahedra(round, {centre - reach, centre + reach}, size).take();
}

TriangleSurface joined(TriangleSurface one, const TriangleSurface& other) {
  const int first = static_cast<int>(one.vertices.size());
  one.vertices.insert(one.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& t : other.triangles) one.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return one;
}

const DressForm& figure() {
  static const DressForm form(standing_figure_body());
  return form;
}

struct Worn {
  CheckedPattern checked;
  SewnMesh sewn;
  PlacedGarment placed;
};

Worn worn(const std::string& text, double cells = 0.015, const PlacementOptions& options = {},
          const DressForm& form = figure()) {
  Worn result{checked_toml(text), {}, {}};
  result.sewn = mesh_pattern(result.checked, cells);
  result.placed = place_garment(result.checked, result.sewn, form, options);
  return result;
}

std::string faults(const PlacedGarment& placed) {
  std::string text;
  for (const Criterion& one : placed.acceptance)
    if (!one.met) text += one.what + ": " + one.found + "\n";
  return text;
}

}  // namespace

TEST(DistanceGrid, SaysHowFarOutsideASphereAPointIs) {
  const DistanceGrid grid(sphere({0.1, 0.2, 0.3}, 0.15, 0.01), 0.008);
  for (const double distance : {-0.05, -0.01, 0.0, 0.004, 0.015, 0.04}) {
    const Vector3d direction = Vector3d(0.3, -0.5, 0.8).normalized();
    const DistanceGrid::Value value = grid.at(Vector3d(0.1, 0.2, 0.3) + (0.15 + distance) * direction);
    EXPECT_NEAR(value.distance, distance, 0.0015) << distance;  // linear between points 8 mm apart, swept far away
    EXPECT_GT(value.direction.dot(direction), 0.99) << distance;
  }
}

TEST(DistanceGrid, WallsInsideASelfCuttingBodyAreNoSkin) {
  // Two spheres that cut each other. On the middle plane each has a wall within the other.
  const TriangleSurface both = joined(sphere({-0.06, 0, 0}, 0.1, 0.01), sphere({0.06, 0, 0}, 0.1, 0.01));
  const DistanceGrid grid(both, 0.006);
  const double lens = std::sqrt(0.1 * 0.1 - 0.06 * 0.06);  // radius of the circle in which they meet
  EXPECT_LT(grid.distance({0, 0, 0}), -0.03);              // far from the skin, the walls 40 mm beside it do not count
  EXPECT_LT(grid.distance({0.04, 0, 0}), -0.03);           // on the wall of the one, deep in the other
  EXPECT_NEAR(grid.distance({0, 0, lens}), 0.0, 0.006);
  EXPECT_GT(grid.distance({0, 0, lens + 0.02}), 0.01);
  EXPECT_NEAR(winding_number(both, {0, 0, 0}), 2.0, 1e-6);
  EXPECT_NEAR(winding_number(both, {0.1, 0, 0}), 1.0, 1e-6);
  EXPECT_NEAR(winding_number(both, {0, 0.2, 0}), 0.0, 1e-6);
}

TEST(StandingBody, TheFrameIsFoundHoweverTheBodyStands) {
  TriangleSurface scan = figure_scan(0.025);
  const BodySurface straight = standing_body(scan, {.up = input::FileAxis::y}, {});
  const Eigen::AngleAxisd turn(2.4, Vector3d::UnitY());
  for (Vector3d& vertex : scan.vertices) vertex = 1000.0 * (turn * vertex + Vector3d(0.7, 0.2, -0.4));
  const BodySurface moved = standing_body(scan, {.unit = 1e-3, .up = input::FileAxis::y}, {});
  double off = 0.0;
  for (std::size_t n = 0; n < scan.vertices.size(); ++n) {
    off = std::max(off, (moved.surface.vertices[n] - straight.surface.vertices[n]).norm());
    off = std::max(off,
                   (moved.rotation * (1e-3 * scan.vertices[n]) + moved.translation - moved.surface.vertices[n]).norm());
  }
  EXPECT_LT(off, 1e-9);
  double toes = 0.0;
  for (const Vector3d& vertex : straight.surface.vertices) toes = std::max(toes, vertex.z() < 0.05 ? vertex.y() : 0.0);
  EXPECT_NEAR(toes, 0.15 + 0.035, 0.01);  // in front, where the figure has its feet
}

TEST(StandingBody, WhatEnclosesNothingOrHasNoFrontIsRefused) {
  TriangleSurface open = figure_scan(0.03);
  open.triangles.pop_back();
  EXPECT_THAT(refusal([&] { standing_body(open, {.up = input::FileAxis::y}, {"a.obj"}); }), HasSubstr("3 edges"));
  const TriangleSurface lying = figure_scan(0.03);
  EXPECT_THAT(refusal([&] { DressForm(standing_body(lying, {.up = input::FileAxis::z}, {"a.obj"})); }),
              HasSubstr("of the body are not apart"));
  const auto posts = [](const Vector3d& p) {
    return std::hypot(std::abs(p.x()) - 0.1, p.y()) - 0.05 + 10.0 * std::max(0.0, std::abs(p.z() - 0.5) - 0.45);
  };
  const TriangleSurface feetless =
      MarchingTetrahedra(posts, {Vector3d(-0.2, -0.1, 0), Vector3d(0.2, 0.1, 1)}, 0.02).take();
  EXPECT_THAT(refusal([&] { standing_body(feetless, {}, {"a.obj"}); }), HasSubstr("which side is the front"));
}

TEST(Landmarks, AreWhereTheFigureHasThem) {
  const Landmarks& marks = figure().marks;
  EXPECT_NEAR(marks.crotch, 0.80, 0.03);  // the trunk's round end: 0.93 - 0.125
  EXPECT_NEAR(marks.neck, 1.46, 0.04);    // between shoulders and head
  EXPECT_GT(marks.armpit, 1.22);          // the arms leave the trunk's round upper end
  EXPECT_LT(marks.armpit, 1.33);
  EXPECT_NEAR(marks.ankle, 0.1, 0.08);
  EXPECT_GT(marks.seat_girth, marks.waist_girth);
}

TEST(GarmentRings, TheKindOfAGarmentIsToldByItsSeams) {
  EXPECT_EQ(find_rings(checked_toml(test_leggings)).kind, GarmentKind::legs);
  EXPECT_EQ(find_rings(checked_toml(test_vest)).kind, GarmentKind::shoulders);
  EXPECT_EQ(find_rings(checked_toml(test_skirt)).kind, GarmentKind::tube);
}

TEST(GarmentRings, AnOuterSeamMayBeMissingInALeg) {
  // Front and back of each leg in one piece: the seams left fork on both of its borders.
  const CheckedPattern one_piece = checked_toml(R"(unit = "1 cm"
[[piece]]
name = "right"
edges = [
  { name = "hem", from = [3, 16] }, { name = "inseam front", from = [27, 16] }, { name = "front", from = [42, 74] },
  { name = "waist", from = [37, 104] }, { name = "back", from = [0, 104] }, { name = "inseam back", from = [-8, 74] } ]
[[piece]]
name = "left"
mirror_of = "right"
[[seam]]
name = "inseam right"
a = "right.inseam front"
b = "right.inseam back"
[[seam]]
name = "inseam left"
a = "left.inseam front"
b = "left.inseam back"
[[seam]]
name = "front"
a = "right.front"
b = "left.front"
[[seam]]
name = "back"
a = "right.back"
b = "left.back"
)");
  const GarmentRings rings = find_rings(one_piece);
  EXPECT_EQ(rings.kind, GarmentKind::legs);
  EXPECT_EQ(rings.tracks[0].size(), 1u);
  EXPECT_EQ(rings.tracks[1].size(), 1u);
  EXPECT_NE(rings.tracks[0][0].piece, rings.tracks[1][0].piece);
  EXPECT_NEAR(rings.fork, 0.74, 1e-9);
}

TEST(GarmentRings, WhatDoesNotGoRoundTheBodyIsRefusedByName) {
  const std::string apart =
      with(test_vest, "[[seam]]\nname = \"right\"\na = \"front.right\"\nb = \"back.right\"\n", "");
  EXPECT_THAT(refusal([&] { find_rings(checked_toml(apart)); }),
              HasSubstr("the piece front is not sewn to a neighbour at its left border"));
}

TEST(GarmentChart, ARowIsStretchedEvenlyRoundTheBody) {
  // The skirt's hem is laid round both legs: its quarters are as long as each other, and all is as long as the taped
  // girth.
  const CheckedPattern skirt = checked_toml(test_skirt);
  const GarmentChart chart(skirt, figure().sections, figure().marks, figure().body, 0.0);
  const double y = 0.40;
  const double half = 0.60 - y / 0.45 * 0.16;
  std::vector<double> lengths;
  std::vector<Vector3d> way;
  for (int n = 0; n <= 400; ++n) way.push_back(chart.place(0, {half * (n / 200.0 - 1.0), y}));
  double whole = 0.0;
  for (int quarter = 0; quarter < 4; ++quarter) {
    double length = 0.0;
    for (int n = 100 * quarter; n < 100 * (quarter + 1); ++n) length += (way[n + 1] - way[n]).norm();
    lengths.push_back(length);
    whole += length;
  }
  for (const double length : lengths) EXPECT_NEAR(length, 0.25 * whole, 0.01 * whole);
  EXPECT_NEAR(way.front().x(), 0.0, 0.01);  // its seam is behind
  EXPECT_LT(way.front().y(), -0.05);
  EXPECT_NEAR((way.front() - way.back()).norm(), 0.0, 1e-6);
  EXPECT_GT(way[200].y(), 0.05);  // its middle in front
  EXPECT_GT(way[100].x(), 0.05);  // seen from the outside x runs from the right over the front to the left
  EXPECT_NEAR(way[0].z(), figure().marks.waist - 0.05, 1e-9);  // 50 mm below its upper edge
}

TEST(Placement, GarmentsWithLegsWithShouldersAndWithNeitherAreAccepted) {
  for (const std::string& text : {test_leggings, test_vest, test_skirt}) {
    const Worn garment = worn(text);
    EXPECT_EQ(faults(garment.placed), "") << text.substr(0, 60);
    EXPECT_TRUE(garment.placed.accepted());
    if (garment.sewn.pieces.size() > 1) EXPECT_GT(garment.placed.first_gap + garment.placed.last_gap, 0.0);  // one piece is laid closed
  }
}

TEST(Placement, SeamsAreClosedAndTheSolverTakesTheMesh) {
  const Worn garment = worn(test_leggings);
  for (const SewnSeam& seam : garment.sewn.seams)
    for (const auto& [a, b] : seam.pairs)
      EXPECT_EQ((garment.placed.places[a] - garment.placed.places[b]).norm(), 0.0) << seam.name;
  const GarmentMesh mesh = garment_mesh(garment.sewn, garment.placed.places, "leggings");
  EXPECT_EQ(mesh.edges.size(), 3u);
  for (const auto& t : mesh.triangles)  // mid-edge nodes on straight edges
    EXPECT_LT((mesh.placed[t[3]] - 0.5 * (mesh.placed[t[0]] + mesh.placed[t[1]])).norm(), 1e-12);
}

TEST(Placement, NothingOfAPlacedGarmentIsInTheFigure) {
  // By the function that the figure is made of, not by the surface that the particles saw.
  const Worn garment = worn(test_vest);
  double deepest = 1.0;
  for (const Vector3d& p : garment.placed.places) deepest = std::min(deepest, standing_figure(p));
  EXPECT_GT(deepest, -0.004);  // chords of 18 mm and the floor of the scan
}

TEST(Placement, HigherLowerFinerCoarserAndTurnedItIsAcceptedToo) {
  for (const double raise : {-0.04, 0.04})
    EXPECT_EQ(faults(worn(test_leggings, 0.015, {.raise = raise}).placed), "") << raise;
  for (const double cells : {0.01, 0.02}) EXPECT_EQ(faults(worn(test_vest, cells).placed), "") << cells;
  TriangleSurface scan = figure_scan();
  for (Vector3d& vertex : scan.vertices)
    vertex = Eigen::AngleAxisd(0.9, Vector3d::UnitY()) * vertex + Vector3d(0.3, 0, 0.1);
  const DressForm turned(standing_body(scan, {.up = input::FileAxis::y}, {}));
  EXPECT_EQ(faults(worn(test_leggings, 0.015, {}, turned).placed), "");
}

TEST(Placement, WhatIsMuchTooSmallIsRefusedWithSeamAndGap) {
  Pattern pattern = graded(checked_toml(test_vest).pattern, 0.35, 1.0);
  const CheckedPattern small = checked(pattern);
  const SewnMesh sewn = mesh_pattern(small, 0.015);
  const std::string text = refusal([&] { check_accepted(place_garment(small, sewn, figure()), small.pattern); });
  EXPECT_THAT(text, ::testing::AnyOf(HasSubstr("stays open by"), HasSubstr("the garment cannot be placed")));
}

TEST(Acceptance, AGarmentBesideTheBodyOrInsideOutIsNotAccepted) {
  const Worn garment = worn(test_leggings);
  std::vector<Vector3d> places = garment.placed.places;
  const auto judged = [&](const std::vector<Vector3d>& x, const ClothTriangles& cloth) {
    OpenLoops open;
    for (const OpenLoop& loop : garment.checked.sewing.open)
      for (const int node : garment.sewn.open.at(loop.name)) open[loop.name].push_back(x[node]);
    std::string text;
    for (const Criterion& one : acceptance(cloth, x, open, figure(), GarmentKind::legs))
      if (!one.met) text += one.what + "; ";
    return text;
  };
  EXPECT_EQ(judged(places, garment.placed.cloth), "");
  ClothTriangles turned = garment.placed.cloth;
  for (auto& t : turned.nodes) std::swap(t[1], t[2]);
  for (auto& flat : turned.flat) std::swap(flat[1], flat[2]);
  EXPECT_EQ(judged(places, turned), "the cloth goes once round trunk and legs, its outside out; ");
  std::vector<Vector3d> beside = places;
  for (Vector3d& p : beside) p.y() += 0.6;  // in front of the body: free of crossings, round nothing
  EXPECT_EQ(judged(beside, garment.placed.cloth),
            "the cloth goes once round trunk and legs, its outside out; each open edge goes round its limb; ");
  std::vector<Vector3d> sunk = places;
  for (Vector3d& p : sunk) p.y() += 0.02;
  EXPECT_THAT(judged(sunk, garment.placed.cloth), HasSubstr("no triangle crosses the body"));
}

TEST(LimbPaths, ARingIsFoundRoundTheLimbThatItEncloses) {
  const LimbPaths paths(figure());
  const auto ring = [](const Vector3d& middle, const Vector3d& axis, double radius) {
    const Vector3d u = axis.unitOrthogonal(), v = axis.normalized().cross(u);
    std::vector<Vector3d> loop;
    for (int n = 0; n < 40; ++n)
      loop.push_back(middle +
                     radius * (std::cos(0.05 * n * std::numbers::pi) * u + std::sin(0.05 * n * std::numbers::pi) * v));
    return loop;
  };
  EXPECT_EQ(paths.enclosed_by(ring({0.1, 0, 0.4}, Vector3d::UnitZ(), 0.09)), BodyPart::right_leg);
  EXPECT_EQ(paths.enclosed_by(ring({-0.1, 0, 0.4}, -Vector3d::UnitZ(), 0.09)), BodyPart::left_leg);
  EXPECT_EQ(paths.enclosed_by(ring({0, 0, 1.0}, Vector3d::UnitZ(), 0.3)), BodyPart::trunk);
  EXPECT_EQ(paths.enclosed_by(ring({0, 0, 1.47}, Vector3d::UnitZ(), 0.1)), BodyPart::neck);
  EXPECT_EQ(paths.enclosed_by(ring({0.345, 0.01, 1.1}, {0.35, 0.02, -0.485}, 0.09)), BodyPart::right_arm);
  EXPECT_EQ(paths.enclosed_by(ring({-0.345, 0.01, 1.1}, {-0.35, 0.02, -0.485}, 0.09)), BodyPart::left_arm);
  EXPECT_EQ(paths.enclosed_by(ring({0, 0.5, 1.0}, Vector3d::UnitZ(), 0.2)), BodyPart::nothing);
}

TEST(PrincipalStretches, OfAStretchedAndShearedTriangle) {
  // F = [[1.2, 0.3], [0, 0.8]] turned in space: the singular values of F, by the quadratic equation of F^T F.
  const ClothTriangles cloth{{{0, 1, 2}},
                             {{Eigen::Vector2d(0.1, 0.2), Eigen::Vector2d(0.3, 0.2), Eigen::Vector2d(0.2, 0.5)}}};
  Eigen::Matrix<double, 3, 2> gradient;
  gradient << 1.2, 0.3, 0.0, 0.8, 0.0, 0.0;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Vector3d> places;
  for (const auto& p : cloth.flat[0]) places.push_back(turn * gradient * p + Vector3d(1, 2, 3));
  const auto stretch = principal_stretches(cloth, places)[0];
  const double trace = 1.44 + 0.09 + 0.64, determinant = 0.96 * 0.96;
  EXPECT_NEAR(stretch[0] * stretch[0], 0.5 * (trace + std::sqrt(trace * trace - 4 * determinant)), 1e-12);
  EXPECT_NEAR(stretch[1] * stretch[1], 0.5 * (trace - std::sqrt(trace * trace - 4 * determinant)), 1e-12);
}

// What lies over all girths is told, cloth on shoulders: the straps end 230 mm above the sides. The girths of leggings reach to their waist.
TEST(Placement, ClothOverAllGirthsIsTold) {
  const Worn vest = worn(test_vest, 0.02), leggings = worn(test_leggings, 0.02);
  const double above = above_girths(fit_on_body(vest.sewn, vest.placed, figure()));
  EXPECT_GT(above, 0.15);
  EXPECT_LT(above, 0.30);
  EXPECT_EQ(above_girths(fit_on_body(leggings.sewn, leggings.placed, figure())), 0.0);
}

}  // namespace snug::mesh
