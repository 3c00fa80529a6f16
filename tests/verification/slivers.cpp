// Cells of extreme shape: nearly flat tetrahedra and needles, whose linear fields must stay exact (reference book 4).
#include <map>

#include "tests/verification/blocks.hpp"
#include "tests/verification/book.hpp"

namespace snug::tests {
namespace {

/// The unit cube as twelve tetrahedra from its faces' triangles to one inner node `height` above the bottom.
BodyMesh fan(double height) {
  BodyMesh mesh;
  mesh.kind = CellKind::tet10;
  mesh.layers.push_back({"tissue", {}});
  for (int n = 0; n < 8; ++n) mesh.nodes.emplace_back(n % 2, n / 2 % 2, n / 4);
  mesh.nodes.emplace_back(0.5, 0.4, height);
  std::map<std::pair<int, int>, int> middle;
  const auto between = [&](int a, int b) {
    const auto [it, fresh] = middle.try_emplace(std::minmax(a, b), static_cast<int>(mesh.nodes.size()));
    if (fresh) mesh.nodes.push_back(0.5 * (mesh.nodes[a] + mesh.nodes[b]));
    return it->second;
  };
  // Corners of the six faces, counter-clockwise seen from outside.
  for (const auto& [a, b, c, d] : {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    for (const auto& [p, q, r] : {std::array{a, b, c}, {a, c, d}}) {
      auto& cell = mesh.cells.emplace_back();
      cell.fill(-1);
      const std::array<int, 4> v = {p, r, q, 8};  // seen from outside clockwise: the fourth vertex lies inside
      for (int i = 0; i < 4; ++i) cell[i] = v[i];
      const std::array<std::array<int, 2>, 6> edges = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
      for (int e = 0; e < 6; ++e) cell[4 + e] = between(v[edges[e][0]], v[edges[e][1]]);
      mesh.cell_layer.push_back(0);
    }
  mesh.node_location.assign(mesh.nodes.size(), -1);
  return mesh;
}

const Eigen::Matrix3d gradient = (Eigen::Matrix3d() << 1.10, 0.20, 0.00, 0.05, 0.95, 0.10, 0.00, 0.10, 1.05).finished();

/// Prescribes x -> F x on the cube's faces; the largest miss of the inner nodes.
double largest_miss(BlockCase& c, const Eigen::Vector3d& size) {
  for (std::size_t node = 0; node < c.mesh.nodes.size(); ++node) {
    const Eigen::Vector3d& x = c.mesh.nodes[node];
    bool outside = false;
    for (int k = 0; k < 3; ++k) outside = outside || std::abs(x[k]) < 1e-12 || std::abs(x[k] - size[k]) < 1e-12 * size[k];
    for (int k = 0; k < 3 && outside; ++k) c.mesh.held.push_back({static_cast<int>(node), k, (gradient * x - x)[k]});
  }
  const BlockAnswer a = solve(c);
  double miss = 0.0;
  for (std::size_t node = 0; node < c.mesh.nodes.size(); ++node)
    miss = std::max(miss, (c.mesh.nodes[node] + a.result.body.fields[postproc::field::displacement][node] - gradient * c.mesh.nodes[node]).norm());
  const auto pressures = a.path.state.values.segment(a.layout.positions(), a.layout["body pressure"].count);  // of tetrahedra
  if (pressures.size() > 0) {
    EXPECT_LE(pressures.maxCoeff() / pressures.minCoeff() - 1.0, 1e-6);
  }
  return miss;
}

// Tetrahedra with an inner node at a ten-thousandth of the edge above a face (dihedral angles below 0.02 degrees), of
// compressible and nearly incompressible tissue, keep a homogeneous deformation and its pressure.
TEST(Slivers, NearlyFlatTetrahedraKeepAHomogeneousDeformation) {
  for (const double nu : {0.3, 0.49, 0.4999}) {
    BlockCase c(fan(1e-4), {neo_hooke(10.0, nu)});
    book("slivers of tetrahedra", fmt::format("largest miss over the edge, nu = {}", nu), largest_miss(c, Eigen::Vector3d::Ones()), 0.0, 1e-9,
         "homogeneous deformation, reference book 4");
  }
}

// Hexahedra a thousand times longer than wide keep it too.
TEST(Slivers, NeedlesOfHexahedraKeepAHomogeneousDeformation) {
  for (const CellKind kind : {CellKind::hex27, CellKind::hex8}) {
    Block block;
    block.cells = {2, 2, 2}, block.kind = kind;
    block.map = [](const Eigen::Vector3d& u) { return Eigen::Vector3d(1000.0 * u.x(), u.y(), u.z()); };
    BlockCase c(make_block(block), {neo_hooke(10.0, 0.49)});
    book("needles of " + to_string(kind), "largest miss over the length", largest_miss(c, {1000.0, 1.0, 1.0}) / 1000.0, 0.0, 1e-9,
         "homogeneous deformation, reference book 4");
  }
}

}  // namespace
}  // namespace snug::tests
