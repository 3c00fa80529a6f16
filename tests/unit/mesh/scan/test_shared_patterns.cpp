// Patterns of other programs, in the folder beside that of the scan; skipped where they are not there.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

#include "mesh/pattern/drawing.hpp"
#include "mesh/pattern/garmentcode.hpp"
#include "mesh/pattern/read_pattern.hpp"
#include "mesh/pattern/sewn_mesh.hpp"

namespace snug::mesh {
namespace {

struct Expected {
  const char* file;
  std::size_t pieces, seams, open;
  double widest_ease;  ///< what the folder's README says of the partners of seams, and of the shirt's by its own file
};

double area_of(const SewnMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector2d u = mesh.flat[t[1]] - mesh.flat[t[0]], v = mesh.flat[t[2]] - mesh.flat[t[0]];
    sum += 0.5 * (u.x() * v.y() - u.y() * v.x());
  }
  return sum;
}

class SharedPatterns : public testing::TestWithParam<Expected> {
 protected:
  std::filesystem::path file() const { return std::filesystem::path(SNUG_SCAN_DIR) / "../patterns" / GetParam().file; }
};

/// Read, checked without a warning, sewn to as many open edges as the garment has holes for neck and limbs, drawn,
/// meshed with its area kept, and the same again when written.
TEST_P(SharedPatterns, AreReadCheckedSewnDrawnAndMeshed) {
  const CheckedPattern one = checked(read_pattern(file()));
  EXPECT_TRUE(one.warnings.empty());
  EXPECT_EQ(one.pattern.pieces.size(), GetParam().pieces);
  EXPECT_EQ(one.pattern.seams.size(), GetParam().seams);
  EXPECT_EQ(one.sewing.open.size(), GetParam().open);
  for (const Seam& seam : one.pattern.seams)
    EXPECT_LT(ease(length(one.pattern, seam.a), length(one.pattern, seam.b)), GetParam().widest_ease) << seam.name;
  for (const OpenLoop& loop : one.sewing.open)
    for (const double angle : loop.angles)
      EXPECT_GT(angle, 0.75 * std::numbers::pi) << loop.name;  // hems run over seams without a corner
  const SewnMesh mesh = mesh_pattern(one, 0.015);
  double area_of_pieces = 0.0;
  for (const Piece& piece : one.pattern.pieces) area_of_pieces += area(piece);
  EXPECT_NEAR(area_of(mesh), area_of_pieces, 1e-3 * area_of_pieces);
  EXPECT_GT(drawing_svg(one, &mesh).size(), 100000u);
  const CheckedPattern again = checked(parse_garmentcode(garmentcode_text(one), "again"));
  EXPECT_EQ(again.sewing.open.size(), GetParam().open);
}

INSTANTIATE_TEST_SUITE_P(All, SharedPatterns,
                         testing::Values(Expected{"leggings-10.json", 4, 6, 3, 2e-4},
                                         Expected{"trousers-block.json", 4, 6, 3, 5e-4},
                                         Expected{"tshirt.json", 4, 6, 4, 1e-4},
                                         Expected{"vest-15.json", 4, 6, 4, 1e-4},
                                         Expected{"shirt_mean_specification.json", 8, 18, 4, 4e-3}),
                         [](const auto& info) {
                           std::string name = info.param.file;
                           std::erase_if(name, [](unsigned char c) { return !std::isalnum(c); });
                           return name;
                         });

}  // namespace
}  // namespace snug::mesh
