// Cook's membrane and the compression of a block, in plane strain, against converged mixed finite elements.
#include "tests/verification/blocks.hpp"
#include "tests/verification/book.hpp"

namespace snug::tests {
namespace {

const std::string source = "reference book 1.9 (s13, own p-FEM)";

/// Corners (0, 0), (48, 44), (48, 60), (0, 44) mm of thickness 1 mm, one cell thick, clamped at x = 0, a dead traction
/// force / 16 mm2 upwards on the right edge; n cells a side.
BlockCase cook(int n, const std::string& material, double force_mN, CellKind kind = CellKind::hex27) {
  Block block;
  block.cells = {n, n, 1}, block.kind = kind;
  block.map = [](const Eigen::Vector3d& u) {
    const double low = 44.0 * u.x(), high = 44.0 + 16.0 * u.x();
    return Eigen::Vector3d(48e-3 * u.x(), 1e-3 * (low + (high - low) * u.y()), 1e-3 * u.z());
  };
  BlockCase c(make_block(block), {material});
  c.hold("left", 0.0, 0.0, 0.0);
  c.hold("back", {}, {}, 0.0), c.hold("front", {}, {}, 0.0);
  c.traction("right", 0.0, 1e-3 * force_mN / 16e-6, 0.0);
  return c;
}

Eigen::Vector3d corner(const BlockCase& c) { return 1e3 * solve(c).displacement(c.mesh, {48e-3, 60e-3, 0.0}); }

// The book's own Q2/P1 has its pressure linear in the coordinates of the cell and ours in space, so that they are the same
// element on parallelograms only (the block below): on Cook's trapezoids the difference falls with the mesh.
TEST(Cook, TheBooksQuadraticMeshesAreMet) {
  const std::string material = neo_hooke_bulk(80.1938, 400942.0);
  double coarser = 0.0;
  for (const auto& [n, exact, tolerance] : {std::tuple{8, 6.90427, 2e-4}, {16, 6.91954, 5e-5}, {32, 6.92688, 5e-5}}) {
    const double u = corner(cook(n, material, 100.0)).y();
    book("Cook A, nu = 0.4999", fmt::format("u_y(48, 60) [mm], Q2/P1 {} x {}", n, n), u, exact, tolerance,
         source + ", the same mesh, mapped pressure");
    EXPECT_GT(u, coarser);       // uniform meshes come from below ...
    EXPECT_LT(u, 6.934 + 1e-3);  // ... and stay below the converged value
    coarser = u;
  }
}

// Uniform meshes converge like h at the clamped obtuse corner: the book's own 32 x 32 is 1e-3 short in case A.
TEST(Cook, CompressibleAndTissueLikeMaterialsMeetTheConvergedCorner) {
  const auto c = corner(cook(48, neo_hooke_bulk(26.25, 70.0), 5.0));
  book("Cook C, nu = 1/3", "u_y(48, 60) [mm]", c.y(), 1.5623, 1e-3, source);
  book("Cook C, nu = 1/3", "u_x(48, 60) [mm]", c.x(), -1.20539, 1e-3, source);
  const auto d = corner(cook(48, neo_hooke_bulk(10.0, 496.6667), 10.0));
  book("Cook D, nu = 0.49", "u_y(48, 60) [mm]", d.y(), 5.8225, 1e-3, source);
  book("Cook D, nu = 0.49", "u_x(48, 60) [mm]", d.x(), -4.79771, 1e-3, source);
}

// At a small part of the load the answer is the linear one. Plane stress is plane strain with the constants
// nu' = nu / (1 + nu), E' = E (1 + 2 nu) / (1 + nu)^2.
TEST(Cook, SmallLoadsGiveTheLinearAnswer) {
  struct Row { std::string name; double E, nu, force, tip, middle; };  // kPa, mN, mm
  const double nu = 1.0 / 3.0, stress_nu = nu / (1.0 + nu), stress_E = (1.0 + 2.0 * nu) / ((1.0 + nu) * (1.0 + nu));
  for (const Row& row : {Row{"nu = 1/3", 1.0, nu, 1.0, 22.589, 21.5246}, Row{"plane stress, nu = 1/3", stress_E, stress_nu, 1.0, 25.17, 23.968},
                         Row{"nu = 0.4999", 250.0, 0.4999, 100.0, 7.765, 7.405}}) {
    const double scale = 1e-4;
    const BlockCase c = cook(32, neo_hooke(row.E / (2.0 * (1.0 + row.nu)), row.nu), scale * row.force);
    const BlockAnswer a = solve(c);
    const auto u_y = [&](double y) { return 1e3 * a.displacement(c.mesh, {48e-3, y, 0.0}).y() / scale; };
    book("Cook, linear, " + row.name, "u_y(48, 60) at the book's load", u_y(60e-3), row.tip, 2e-3, source);
    book("Cook, linear, " + row.name, "u_y(48, 52) at the book's load", u_y(52e-3), row.middle, 2e-3, source);
  }
}

TEST(Cook, LinearHexahedraAndQuadraticTetrahedraComeToTheSameCorner) {
  const std::string material = neo_hooke_bulk(80.1938, 400942.0);
  book("Cook A, nu = 0.4999", "u_y(48, 60) [mm], P2/P1 tetrahedra 32 x 32 x 6",
       corner(cook(32, material, 100.0, CellKind::tet10)).y(), 6.934, 5e-3, source);
  book("Cook A, nu = 0.4999", "u_y(48, 60) [mm], Q1/P0 32 x 32", corner(cook(32, material, 100.0, CellKind::hex8)).y(),
       6.934, 1e-2, source);
}

TEST(Block, CompressionMeetsTheBooksMeshAndItsConvergedValue) {
  for (const auto& [q, exact, same_mesh] : {std::tuple{20.0, 0.0528474, 0.0528466}, {60.0, 0.150669, 0.150666},
                                            {120.0, 0.272521, 0.272509}}) {
    Block block;
    block.cells = {16, 16, 1};
    block.map = [](const Eigen::Vector3d& u) { return Eigen::Vector3d(u.x(), u.y(), 0.1 * u.z()); };
    BlockCase c(make_block(block), {neo_hooke_bulk(80.194e-3, 400.9432687)});  // Pa
    name_part(c.mesh, "loaded", "top", [](const Eigen::Vector3d& x) { return x.x() <= 0.5 + 1e-9; });
    c.hold("left", 0.0, {}, {}), c.hold("bottom", {}, 0.0, {}), c.hold("top", 0.0, {}, {});
    c.hold("back", {}, {}, 0.0), c.hold("front", {}, {}, 0.0);
    c.traction("loaded", 0.0, -q, 0.0);
    const double u = -solve(c).displacement(c.mesh, {0.0, 1.0, 0.0}).y();
    book("block, nu = 0.4999", fmt::format("-u_y(0, 1) at q = {}, Q2/P1 16 x 16", q), u, same_mesh, 1e-5,
         "reference book 1.10 (s13), the same mesh");
    book("block, nu = 0.4999", fmt::format("-u_y(0, 1) at q = {}", q), u, exact, 1e-4, "reference book 1.10 (s13)");
  }
}

}  // namespace
}  // namespace snug::tests
