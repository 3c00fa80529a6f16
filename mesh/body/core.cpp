#include "mesh/body/core.hpp"

#include <cmath>
#include <map>

namespace snug::mesh {

namespace {

constexpr double size = 0.55, bulge = 0.35;  // of the square against the outline

}  // namespace

CoreBorder::CoreBorder(const Outline& bone, double z) : bone_(bone), z_(z), centre_(section_centre(bone, z)) {
  for (int c = 0; c < 4; ++c) corner_[c] = bone.at(0.25 * c, z).head<2>() - centre_;
}

Eigen::Vector3d CoreBorder::at(double turn) const {
  const double side = 4.0 * (turn - std::floor(turn));
  const int c = static_cast<int>(side) % 4;
  const double s = side - std::floor(side);
  const Eigen::Vector2d straight = (1.0 - s) * corner_[c] + s * corner_[(c + 1) % 4];
  const Eigen::Vector2d round = bone_.at(turn, z_).head<2>() - centre_;
  Eigen::Vector3d x;
  x << centre_ + size * ((1.0 - bulge) * straight + bulge * round), z_;
  return x;
}

void fill_core(int around, int along, Lattice& lattice, std::vector<Eigen::Vector3d>& nodes) {
  const int n = around / 2;  // half cells along a side of the square
  std::map<LatticeKey, int> border;
  for (std::size_t node = 0; node < lattice.nodes.size(); ++node)
    if (lattice.nodes[node].k == 0) border[lattice.nodes[node]] = static_cast<int>(node);
  // (a, b) runs over the square, a from turn 0 to 1/4, b from turn 0 to -1/4; the border goes round counter-clockwise.
  std::map<LatticeKey, int> inner;
  const auto node_at = [&](int a, int b, int j) {
    const int i = b == 0 ? a : a == n ? n + b : b == n ? 3 * n - a : a == 0 ? 4 * n - b : -1;
    return i >= 0 ? border.at({i % (4 * n), j, 0}) : inner.at({a, j, b});
  };
  for (int j = 0; j <= 2 * along; ++j)
    for (int a = 1; a < n; ++a)
      for (int b = 1; b < n; ++b) {
        const auto x = [&](int p, int q) { return nodes[node_at(p, q, j)]; };
        const double s = double(a) / n, t = double(b) / n;  // Coons patch of the border
        const Eigen::Vector3d corners = (1 - s) * (1 - t) * x(0, 0) + s * (1 - t) * x(n, 0) + s * t * x(n, n) + (1 - s) * t * x(0, n);
        const Eigen::Vector3d point = (1 - t) * x(a, 0) + t * x(a, n) + (1 - s) * x(0, b) + s * x(n, b) - corners;
        inner[{a, j, b}] = static_cast<int>(nodes.size());
        nodes.push_back(point);
        lattice.nodes.push_back({-1, j, -1});
      }
  for (int j = 0; j < along; ++j)
    for (int a = 0; a < n / 2; ++a)
      for (int b = 0; b < n / 2; ++b) {
        auto& cell = lattice.cells.emplace_back();
        for (int c = 0; c < 27; ++c) cell[c] = node_at(2 * a + c % 3, 2 * b + c / 3 % 3, 2 * j + c / 9);
        lattice.cell_layer.push_back(0);
      }
}

}  // namespace snug::mesh
