#include "solver/scene/body_strain.hpp"

#include <Eigen/Dense>

namespace snug::solver {

BodyStrain body_strain(const mesh::BodyMesh& body, const std::vector<Eigen::Vector3d>& displacement) {
  BodyStrain strain;
  std::vector<Eigen::Vector3d> now = body.nodes;
  for (std::size_t n = 0; n < now.size(); ++n) now[n] += displacement[n];
  for (const mesh::CellNodes& cell : body.cells) {
    const mesh::CellPositions rest = mesh::cell_positions(body.kind, cell, body.nodes), moved = mesh::cell_positions(body.kind, cell, now);
    for (const mesh::SamplePoint& point : mesh::gauss_points(body.kind)) {
      const Eigen::Matrix3d F = mesh::jacobian(moved, point) * mesh::jacobian(rest, point).inverse();
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> stretch(F.transpose() * F, Eigen::EigenvaluesOnly);
      const auto place = [&] { return Eigen::Vector3d(rest * point.values); };
      if (const double l = std::sqrt(stretch.eigenvalues()[2]); l > strain.largest_stretch) strain.largest_stretch = l, strain.stretched_at = place();
      if (const double J = F.determinant(); J < strain.smallest_volume_ratio) strain.smallest_volume_ratio = J, strain.squeezed_at = place();
    }
  }
  return strain;
}

}  // namespace snug::solver
