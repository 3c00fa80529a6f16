#include "solver/terms/tabulate.hpp"

#include <Eigen/Dense>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q_cache.h>
#include <deal.II/grid/tria.h>

#include <map>

namespace snug::solver {

namespace {

using Triangulation = dealii::Triangulation<3>;

// Cells keep the order of the mesh; only the corner nodes become vertices of the triangulation.
void make_triangulation(const mesh::BodyMesh& mesh, Triangulation& triangulation) {
  std::map<int, unsigned int> vertex;
  std::vector<dealii::Point<3>> vertices;
  std::vector<dealii::CellData<3>> cells(mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (int v = 0; v < 8; ++v) {
      const int node = mesh.cells[c][18 * (v / 4) + 6 * (v / 2 % 2) + 2 * (v % 2)];
      const auto [it, fresh] = vertex.emplace(node, static_cast<unsigned int>(vertices.size()));
      if (fresh) vertices.emplace_back(mesh.nodes[node].x(), mesh.nodes[node].y(), mesh.nodes[node].z());
      cells[c].vertices[v] = it->second;
    }
  triangulation.create_triangulation(vertices, cells, {});
}

}  // namespace

HexTable tabulate_hexahedra(const mesh::BodyMesh& mesh) {
  HexTable table;
  if (mesh.cells.empty()) return table;
  Triangulation triangulation;
  make_triangulation(mesh, triangulation);
  const dealii::FE_Q<3> element(2);
  const auto lexicographic = dealii::FETools::hierarchic_to_lexicographic_numbering<3>(2);
  dealii::MappingQCache<3> mapping(2);
  mapping.initialize(triangulation, [&](const Triangulation::cell_iterator& cell) {
    std::vector<dealii::Point<3>> support(27);
    for (int i = 0; i < 27; ++i) {
      const Eigen::Vector3d& x = mesh.nodes[mesh.cells[cell->index()][lexicographic[i]]];
      support[i] = {x.x(), x.y(), x.z()};
    }
    return support;
  });
  dealii::FEValues<3> values(mapping, element, dealii::QGauss<3>(3),
                             dealii::update_gradients | dealii::update_JxW_values | dealii::update_quadrature_points);
  const std::size_t n = mesh.cells.size();
  table.gradient.resize(n), table.weight.resize(n), table.point.resize(n);
  for (const auto& cell : triangulation.active_cell_iterators()) {
    values.reinit(cell);
    const int c = cell->index();
    for (int q = 0; q < 27; ++q) {
      table.weight[c][q] = values.JxW(q);
      for (int d = 0; d < 3; ++d) table.point[c](d, q) = values.quadrature_point(q)[d];
      for (int i = 0; i < 27; ++i)
        for (int d = 0; d < 3; ++d) table.gradient[c](lexicographic[i], 3 * q + d) = values.shape_grad(i, q)[d];
    }
  }
  return table;
}

const Eigen::Matrix<double, 27, 27>& gauss_to_nodes() {
  static const Eigen::Matrix<double, 27, 27> matrix = [] {
    const auto trilinear = [](double x, double y, double z) {
      return Eigen::Matrix<double, 8, 1>{{1, x, y, z, x * y, y * z, x * z, x * y * z}};
    };
    Eigen::Matrix<double, 8, 27> at_points, at_nodes;
    const double g = std::sqrt(0.6);
    for (int i = 0; i < 27; ++i) {
      const double x = i % 3 - 1, y = i / 3 % 3 - 1, z = i / 9 - 1;
      at_nodes.col(i) = trilinear(x, y, z);
      at_points.col(i) = trilinear(g * x, g * y, g * z);
    }
    const Eigen::Matrix<double, 8, 8> normal = at_points * at_points.transpose();
    return Eigen::Matrix<double, 27, 27>(at_points.transpose() * normal.inverse() * at_nodes);
  }();
  return matrix;
}

}  // namespace snug::solver
