#include "solver/terms/tabulate.hpp"

#include <Eigen/Dense>

#include <array>

namespace snug::solver {

using mesh::CellKind;

CellTable tabulate(const mesh::BodyMesh& mesh, int cell) {
  const auto& rule = mesh::gauss_points(mesh.kind);
  const auto x = mesh::cell_positions(mesh.kind, mesh.cells[cell], mesh.nodes);
  const auto points = static_cast<Eigen::Index>(rule.size());
  CellTable table{Eigen::Matrix3Xd(3, 3 * points), Eigen::VectorXd(points), Eigen::Matrix3Xd(3, points)};
  for (Eigen::Index q = 0; q < points; ++q) {
    const Eigen::Matrix3d jacobian = mesh::jacobian(x, rule[q]);
    table.inverse.middleCols<3>(3 * q) = jacobian.inverse();
    table.weight[q] = rule[q].weight * jacobian.determinant();
    table.point.col(q) = x * rule[q].values;
  }
  return table;
}

Eigen::MatrixXd reference_gradients(CellKind kind) {
  const auto& rule = mesh::gauss_points(kind);
  Eigen::MatrixXd gradients(static_cast<Eigen::Index>(mesh::reference_nodes(kind).size()), 3 * static_cast<Eigen::Index>(rule.size()));
  for (std::size_t q = 0; q < rule.size(); ++q) gradients.middleCols<3>(3 * static_cast<Eigen::Index>(q)) = rule[q].gradients;
  return gradients;
}

const Eigen::MatrixXd& points_to_nodes(CellKind kind) {
  static const auto make = [](CellKind kind) -> Eigen::MatrixXd {
    const int terms = kind == CellKind::hex27 ? 8 : 4;
    const auto polynomials = [&](const Eigen::Vector3d& r) -> Eigen::VectorXd {
      const double x = r.x() - 0.5, y = r.y() - 0.5, z = r.z() - 0.5;
      return Eigen::Matrix<double, 8, 1>{{1, x, y, z, x * y, y * z, x * z, x * y * z}}.head(terms);
    };
    const auto& rule = mesh::gauss_points(kind);
    const auto& nodes = mesh::reference_nodes(kind);
    Eigen::MatrixXd at_points(terms, rule.size()), at_nodes(terms, nodes.size());
    for (std::size_t q = 0; q < rule.size(); ++q) at_points.col(q) = polynomials(rule[q].reference);
    for (std::size_t a = 0; a < nodes.size(); ++a) at_nodes.col(a) = polynomials(nodes[a]);
    return at_points.transpose() * (at_points * at_points.transpose()).inverse() * at_nodes;
  };
  static const std::array matrices = {make(CellKind::hex27), make(CellKind::hex8), make(CellKind::tet10)};
  return matrices[static_cast<int>(kind)];
}

Eigen::Matrix4Xd vertex_shapes() {
  return fem::tabulate(fem::Element::tet4, fem::quadrature(fem::Domain::tetrahedron, 5).points).values;
}

}  // namespace snug::solver
