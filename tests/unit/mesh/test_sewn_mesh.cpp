#include "tests/unit/mesh/patterns.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <set>

#include "mesh/pattern/sewn_mesh.hpp"

namespace snug::mesh {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::HasSubstr;
using std::numbers::pi;

double twice_area(const SewnMesh& mesh, const std::array<int, 6>& t) {
  const Vector2d u = mesh.flat[t[1]] - mesh.flat[t[0]], v = mesh.flat[t[2]] - mesh.flat[t[0]];
  return u.x() * v.y() - u.y() * v.x();
}

double area(const SewnMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) sum += 0.5 * twice_area(mesh, t);
  return sum;
}

double length(const SewnMesh& mesh, const std::vector<int>& nodes) {
  double sum = 0.0;
  for (std::size_t n = 1; n < nodes.size(); ++n) sum += (mesh.flat[nodes[n]] - mesh.flat[nodes[n - 1]]).norm();
  return sum;
}

/// Vertices - sides + triangles of the sewn surface.
int mesh_euler(const SewnMesh& mesh) {
  std::set<int> vertices;
  std::set<std::set<int>> sides;
  for (const auto& t : mesh.triangles)
    for (int n = 0; n < 3; ++n) {
      vertices.insert(mesh.merged[t[n]]);
      sides.insert({mesh.merged[t[n]], mesh.merged[t[3 + n]], mesh.merged[t[(n + 1) % 3]]});
    }
  return static_cast<int>(vertices.size()) - static_cast<int>(sides.size()) + static_cast<int>(mesh.triangles.size());
}

/// What every mesh must be: straight triangles that run counter-clockwise, with six nodes that stay six when sewn.
void expect_sound(const SewnMesh& mesh) {
  ASSERT_EQ(mesh.node_piece.size(), mesh.flat.size());
  ASSERT_EQ(mesh.merged.size(), mesh.flat.size());
  std::set<int> used;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    EXPECT_GT(twice_area(mesh, t), 0.0);
    std::set<int> nodes;
    for (int n = 0; n < 6; ++n) {
      nodes.insert(mesh.merged[t[n]]);
      used.insert(t[n]);
      EXPECT_EQ(mesh.node_piece[t[n]], mesh.triangle_piece[i]);
    }
    EXPECT_EQ(nodes.size(), 6u);
    for (int n = 0; n < 3; ++n)
      EXPECT_LT((mesh.flat[t[3 + n]] - 0.5 * (mesh.flat[t[n]] + mesh.flat[t[(n + 1) % 3]])).norm(), 1e-15);
  }
  EXPECT_EQ(used.size(), mesh.flat.size());  // a node without a triangle would have no stiffness
  for (std::size_t n = 0; n < mesh.merged.size(); ++n) {
    EXPECT_LE(mesh.merged[n], static_cast<int>(n));
    EXPECT_EQ(mesh.merged[mesh.merged[n]], mesh.merged[n]);
  }
}

TEST(SewnMesh, BothSidesOfASeamAreDividedAlikeAndMerged) {
  const SewnMesh mesh = mesh_pattern(checked_toml(two_halves), 0.02);
  expect_sound(mesh);
  ASSERT_EQ(mesh.seams.size(), 2u);
  for (const SewnSeam& seam : mesh.seams) {
    EXPECT_EQ(seam.pairs.size(), 2u * 15 + 1);  // 300 mm in 15, with middles
    for (const auto& [a, b] : seam.pairs) {
      EXPECT_NE(a, b);
      EXPECT_EQ(mesh.merged[a], mesh.merged[b]);
      EXPECT_NEAR(mesh.flat[a].y(), mesh.flat[b].y(), 1e-12);  // drawn upright, sewn upright
    }
  }
  std::size_t gone = 0;
  for (std::size_t n = 0; n < mesh.merged.size(); ++n) gone += mesh.merged[n] != static_cast<int>(n);
  EXPECT_EQ(gone, 2u * 31);
  EXPECT_EQ(mesh_euler(mesh), 0);
}

TEST(SewnMesh, EdgesAndHemsHaveTheirNodesInOrder) {
  const SewnMesh mesh =
      mesh_pattern(checked_toml(two_halves + "[[hem]]\nname = \"fly\"\nedges = \"front.top[0.2..0.6]\"\n"), 0.02);
  EXPECT_EQ(mesh.edges.at("front.hem").size(), 21u);
  EXPECT_EQ(mesh.flat[mesh.edges.at("front.hem").front()], Vector2d(0.0, 0.0));
  EXPECT_NEAR(length(mesh, mesh.edges.at("back.left")), 0.3, 1e-14);
  ASSERT_EQ(mesh.open.size(), 3u);
  const auto& hem = mesh.open.at("hem");
  EXPECT_EQ(hem.size(), 40u);
  EXPECT_EQ(std::set<int>(hem.begin(), hem.end()).size(), 40u);
  for (const int node : hem) EXPECT_EQ(mesh.merged[node], node);
  EXPECT_NEAR(length(mesh, mesh.open.at("fly")), 0.08, 1e-14);
}

/// Curves become chords: areas and lengths are off by the square of the cell size, and by little.
TEST(SewnMesh, AreasAndSeamLengthsConvergeToThePatterns) {
  const std::string bowed =
      with(with(two_halves, "{ name = \"left\", from = [200, 0] }",
                "{ name = \"left\", kind = \"cubic\", from = [200, 0], control = [[260, 100], [160, 200]] }"),
           "{ name = \"left\", from = [0, 300] }",
           "{ name = \"left\", kind = \"arc\", from = [0, 300], through = [[-25, 150]] }");
  const CheckedPattern checked = checked_toml(bowed);
  double exact = 0.0;
  for (const Piece& piece : checked.pattern.pieces) exact += mesh::area(piece);
  const double seam = mesh::length(checked.pattern, checked.pattern.seams[0].a);
  double of_area[2], of_length[2];
  for (const int n : {0, 1}) {
    const SewnMesh mesh = mesh_pattern(checked, 0.02 / (1 << n));
    of_area[n] = std::abs(area(mesh) / exact - 1.0);
    of_length[n] = std::abs(length(mesh, mesh.edges.at("front.left")) / seam - 1.0);
  }
  EXPECT_LT(of_area[0], 1e-3);
  EXPECT_LT(of_length[0], 1e-3);
  EXPECT_NEAR(std::log2(of_area[0] / of_area[1]), 2.0, 0.3);
  EXPECT_NEAR(std::log2(of_length[0] / of_length[1]), 2.0, 0.3);
}

TEST(SewnMesh, StraightPiecesKeepTheirAreaToRoundOff) {
  EXPECT_NEAR(area(mesh_pattern(checked_toml(two_halves), 0.013)), 0.12, 1e-14);
}

/// A cone's tip: both edges of the piece end in one vertex, and no triangle may have one of its sides folded by the
/// seam.
TEST(SewnMesh, AtTheTipOfAConeNoTriangleIsFolded) {
  for (const double angle : {20.0, 60.0, 150.0}) {
    const double a = 0.5 * angle * pi / 180.0;
    const std::string text =
        "unit = \"1 m\"\n[[piece]]\nname = \"p\"\nedges = [{ name = \"one\", from = [0, 0] }, { name = \"base\", kind "
        "= \"arc\", from = [" +
        std::to_string(0.2 * std::sin(a)) + ", " + std::to_string(-0.2 * std::cos(a)) +
        "], through = [[0, -0.2]], to = [" + std::to_string(-0.2 * std::sin(a)) + ", " +
        std::to_string(-0.2 * std::cos(a)) + "] }, { name = \"other\", from = [" + std::to_string(-0.2 * std::sin(a)) +
        ", " + std::to_string(-0.2 * std::cos(a)) + "] }]\n[[seam]]\na = \"p.one\"\nb = \"p.other\"\n";
    // The lower side runs from right to left below the tip, which is clockwise: as seen from the inside.
    const SewnMesh mesh =
        mesh_pattern(checked_toml(with(text, "name = \"p\"\n", "name = \"p\"\nseen_from = \"inside\"\n")), 0.02);
    expect_sound(mesh);
    EXPECT_EQ(mesh_euler(mesh), 1) << angle;
    EXPECT_EQ(mesh.open.size(), 1u);
  }
}

TEST(SewnMesh, ADartAndAHoleAreMeshedRound) {
  const SewnMesh mesh = mesh_pattern(checked_toml(R"(unit = "1 mm"
[[piece]]
name = "p"
grain = [[0, 0], [1, 1]]
edges = [
  { name = "a", from = [0, 0] }, { name = "b", from = [200, 0] }, { name = "t1", from = [200, 100] }, { name = "in", from = [110, 100] },
  { name = "out", from = [100, 40] }, { name = "t2", from = [90, 100] }, { name = "c", from = [0, 100] },
]
holes = [{ name = "eye", edges = [{ kind = "arc", from = [40, 50], through = [[50, 60]] }, { kind = "arc", from = [60, 50], through = [[50, 40]] }] }]
darts = [{ sides = ["in", "out"] }]
)"),
                                     0.008);
  expect_sound(mesh);
  EXPECT_EQ(mesh_euler(mesh), 0);  // a disc with a hole
  EXPECT_TRUE(mesh.open.contains("eye"));
  for (const Vector2d& warp : mesh.warp) EXPECT_LT((warp - Vector2d(std::sqrt(0.5), std::sqrt(0.5))).norm(), 1e-15);
}

/// Largest principal strain (Green's, as it is, without sign) in the middle of a triangle whose nodes stand at `x`.
double strain_in_the_middle(const SewnMesh& mesh, const std::array<int, 6>& t, const std::vector<Vector3d>& x) {
  Eigen::Matrix<double, 3, 3> G;  // columns: dx/dL of the area coordinates
  for (int i = 0; i < 3; ++i) G.col(i) = (x[t[i]] + 4.0 * (x[t[3 + i]] + x[t[3 + (i + 2) % 3]])) / 3.0;
  Eigen::Matrix<double, 3, 2> d;
  d << G.col(0) - G.col(2), G.col(1) - G.col(2);
  Eigen::Matrix2d D;
  D << mesh.flat[t[0]] - mesh.flat[t[2]], mesh.flat[t[1]] - mesh.flat[t[2]];
  const Eigen::Matrix<double, 3, 2> F = d * D.inverse();
  const Eigen::Matrix2d E = 0.5 * (F.transpose() * F - Eigen::Matrix2d::Identity());
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(E).eigenvalues().cwiseAbs().maxCoeff();
}

/// A disc of 100 mm with a dart of 60 degrees to its middle, put on the cone of that half angle: the mean of what its triangles are strained by, over their areas.
double strain_on_cone(double cell, double half_angle) {
  const SewnMesh mesh = mesh_pattern(checked_toml(R"(unit = "1 mm"
[[piece]]
name = "disc"
edges = [
  { name = "in", from = [0, 0] },
  { name = "rim", kind = "arc", from = [50, -86.60254037844386], through = [[0, 100]] },
  { name = "out", from = [-50, -86.60254037844386] },
]
darts = [{ sides = ["out", "in"] }]
)"), cell);
  expect_sound(mesh);
  std::vector<Vector3d> x;
  for (const Vector2d& flat : mesh.flat) {
    const double angle = std::atan2(-flat.x(), flat.y()) * 360.0 / 300.0;  // from the middle of the cloth; the dart lies at half a turn
    x.push_back(flat.norm() * Vector3d(std::sin(half_angle) * std::cos(angle), std::sin(half_angle) * std::sin(angle), -std::cos(half_angle)));
  }
  for (std::size_t n = 0; n < x.size(); ++n) EXPECT_LT((x[n] - x[mesh.merged[n]]).norm(), 1e-9);  // both sides of the dart meet
  double sum = 0.0;
  for (const auto& t : mesh.triangles) sum += 0.5 * twice_area(mesh, t) * strain_in_the_middle(mesh, t, x);
  return sum / area(mesh);
}

TEST(SewnMesh, ADartMakesTheConeOfItsAngleWithoutStrain) {
  // sin a = 1 - 60/360: there the strain is of the triangles alone and falls with the square of their size; on a cone that is a tenth blunter it is not.
  const double half_angle = std::asin(1.0 - 60.0 / 360.0);
  const double coarse = strain_on_cone(0.016, half_angle), fine = strain_on_cone(0.008, half_angle);
  EXPECT_LT(fine, 1e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.6);
  EXPECT_GT(strain_on_cone(0.008, 1.1 * half_angle), 20.0 * fine);
}

/// Where one side is longer, its divisions are: as many on both.
TEST(SewnMesh, EaseIsInTheLengthsOfTheDivisions) {
  const SewnMesh mesh = mesh_pattern(
      checked_toml(with(two_halves, "{ name = \"left\", from = [200, 0] }",
                        "{ name = \"left\", kind = \"quadratic\", from = [200, 0], control = [[320, 150]] }")),
      0.02);
  const auto &a = mesh.edges.at("front.left"), &b = mesh.edges.at("back.left");
  EXPECT_EQ(a.size(), b.size());
  double shortest = 1e9, longest = 0.0;
  for (std::size_t n = 2; n < a.size(); n += 2) {
    const double one = (mesh.flat[a[n]] - mesh.flat[a[n - 2]]).norm();
    shortest = std::min(shortest, one), longest = std::max(longest, one);
  }
  EXPECT_LT(longest / shortest, 1.01);
}

TEST(SewnMesh, CellsThatCannotBeAreRefused) {
  const CheckedPattern tube = checked_toml(two_halves);
  EXPECT_THAT(refusal([&] { mesh_pattern(tube, 0.0); }), HasSubstr("test.toml: error: cells of 0 mm"));
  EXPECT_THAT(refusal([&] { mesh_pattern(tube, 1e-5); }),
              HasSubstr("front cannot be meshed with cells of 0.01 mm: more than"));
}

/// The hand-over: two halves of a tube of 400 mm round a cylinder become the solver's mesh, and its nodes are where
/// they were put.
TEST(SewnMesh, PlacedItIsTheSolversMesh) {
  const SewnMesh sewn = mesh_pattern(checked_toml(two_halves), 0.02);
  const double radius = 0.4 / (2.0 * pi);
  std::vector<Vector3d> placed;
  for (std::size_t n = 0; n < sewn.flat.size(); ++n) {  // seen from the outside x runs counter-clockwise from above
    const double angle = (sewn.flat[n].x() + 0.2 * sewn.node_piece[n]) / radius;
    placed.emplace_back(radius * std::cos(angle), radius * std::sin(angle), sewn.flat[n].y());
  }
  for (std::size_t n = 0; n < placed.size(); ++n) {
    EXPECT_LT((placed[n] - placed[sewn.merged[n]]).norm(), 1e-12);  // the seams close by themselves
    placed[n] = placed[sewn.merged[n]];
  }
  const GarmentMesh mesh = garment_mesh(sewn, placed, "tube");
  EXPECT_EQ(mesh.triangles.size(), sewn.triangles.size());
  EXPECT_EQ(mesh.edges.size(), 2u);
  for (const auto& t : mesh.triangles) {
    const auto x = [&](int n) { return mesh.placed[t[n]]; };
    const Vector3d normal = (x(1) - x(0)).cross(x(2) - x(0)).normalized();
    EXPECT_GT(normal.dot(Vector3d(x(3).x(), x(3).y(), 0.0).normalized()), 0.9);
    for (int n = 0; n < 3; ++n)
      EXPECT_NEAR((x(n) - x((n + 1) % 3)).norm(), (mesh.pattern[t[n]] - mesh.pattern[t[(n + 1) % 3]]).norm(), 2e-4);
  }
  std::vector<Vector3d> torn = placed;
  torn[sewn.seams[0].pairs[3][1]].x() += 1e-6;
  EXPECT_THROW(garment_mesh(sewn, torn, "tube"), std::invalid_argument);
  EXPECT_THROW(garment_mesh(sewn, {placed.begin(), placed.end() - 1}, "tube"), std::invalid_argument);
}

}  // namespace
}  // namespace snug::mesh
