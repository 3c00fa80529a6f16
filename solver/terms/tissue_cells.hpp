// The kernel of Tissue for any kind of cell. Included by the sources that make one of them and by nothing else.
#pragma once

#include <Eigen/LU>
#include <tbb/parallel_for.h>

#include <cmath>

#include "solver/terms/inversion.hpp"
#include "solver/terms/parallel.hpp"
#include "solver/terms/pressure_unknowns.hpp"
#include "solver/terms/tabulate.hpp"
#include "solver/terms/tissue_kernel.hpp"

namespace snug::solver {

namespace {

// d cof(F)_iJ / dF_kL = (cof_iJ cof_kL - cof_iL cof_kJ) / J, index 3 i + J.
void add_cofactor_derivative(const Eigen::Matrix3d& cofactor, double J, double p, Eigen::Matrix<double, 9, 9>& A) {
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          A(3 * i + a, 3 * k + b) += p / J * (cofactor(i, a) * cofactor(k, b) - cofactor(i, b) * cofactor(k, a));
}

// J with U'(J) = p: Newton's method from J = 1, at most tenfold less a step.
double dilatation(const materials::SolidLaw& law, double p) {
  double J = 1.0;
  for (int i = 0; i < 60; ++i) {
    const auto v = materials::volumetric(law, J);
    const double next = std::max(0.1 * J, J - (v.pressure - p) / v.modulus);
    const bool done = std::abs(next - J) <= 1e-15 * J;
    J = next;
    if (done) break;
  }
  return J;
}

/// Cells of `nodes` nodes and `points` quadrature points, with `modes` dilatations and pressures of their own or `vertices`
/// pressure unknowns in each.
template <int nodes, int points, int modes, int vertices>
class CellKernel final : public Tissue::Kernel {
  static constexpr int positions = 3 * nodes, size = positions + vertices, fields = modes + vertices;
  using PointValues = Eigen::Matrix<double, points, 1>;
  using FieldVector = Eigen::Matrix<double, fields, 1>;
  using Fields = Eigen::Matrix<double, fields, fields>;
  using Gradients = Eigen::Matrix<double, nodes, 3 * points>;  ///< of the shape functions: node a, column 3 q + J

  struct Cell {
    std::array<int, size> entry;
    int own;                                            ///< first entry of the dilatations; the pressures follow
    const materials::SolidLaw* law;
    bool split;
    Eigen::Matrix<double, 3, 3 * points> inverse;       ///< of the Jacobian to the reference cell at the points, 1/m
    PointValues weight;                                 ///< m3
    Eigen::Matrix<double, fields, points> mode;         ///< phi_m or L_v at the points
    Fields mass_inverse;
  };
  struct Kinematics {
    Gradients gradient;                                 ///< 1/m
    std::array<Eigen::Matrix3d, points> F, cofactor;
    PointValues J, dilatation, pressure, modulus;
    double volumetric_energy = 0.0;
  };
  struct Slot {
    Eigen::Matrix<double, size, 1> residual, condensed;
    Eigen::Matrix<double, size, size, Eigen::RowMajor> matrix;
  };
  /// The rows of a cell's own fields, their derivative to the positions and that of U'.
  struct FieldRows {
    FieldVector dilatation, pressure;                   ///< r_t, r_p
    Eigen::Matrix<double, fields, positions> D;
    Fields H;
  };
  struct Point {
    double energy;
    Eigen::Matrix3d stress;
    Eigen::Matrix<double, 9, 9> tangent;
  };

 public:
  CellKernel(const Tissue::Fields& field, const mesh::BodyMesh& mesh, const std::vector<materials::SolidLaw>& laws)
      : reference_(reference_gradients(mesh.kind)), to_nodes_(points_to_nodes(mesh.kind)) {
    const PressureUnknowns unknowns = pressure_unknowns(mesh);
    cells_.resize(mesh.cells.size());
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      Cell& cell = cells_[c];
      const CellTable table = tabulate(mesh, static_cast<int>(c));
      cell.law = &laws[mesh.cell_layer[c]];
      cell.split = materials::is_split(*cell.law);
      cell.own = field.cells(2 * modes * static_cast<int>(c));
      cell.inverse = table.inverse, cell.weight = table.weight;
      for (int a = 0; a < nodes; ++a)
        for (int i = 0; i < 3; ++i) cell.entry[3 * a + i] = field.positions(mesh.cells[c][a], i);
      for (int v = 0; v < vertices; ++v) cell.entry[positions + v] = field.pressures(unknowns.of_cell[c][v]);
      entries.push(cell.entry);
      if constexpr (vertices > 0) {
        cell.mode = vertex_shapes();
      } else {
        const Eigen::Vector3d centre = table.point * cell.weight / cell.weight.sum();
        cell.mode.row(0).setOnes();
        if constexpr (modes > 1)
          cell.mode.template bottomRows<3>() = (table.point.colwise() - centre) / std::cbrt(cell.weight.sum());
      }
      cell.mass_inverse = Fields(cell.mode * cell.weight.asDiagonal() * cell.mode.transpose()).inverse();
    }
  }

  double energy(const State& state) const override {
    double sum = 0.0;
    Kinematics k;
    for (const Cell& cell : cells_) {
      if (!kinematics(state, cell, k)) return std::numeric_limits<double>::infinity();
      sum += k.volumetric_energy;
      for (int q = 0; q < points; ++q) sum += cell.weight[q] * point(cell, k, q, false).energy;
    }
    return state.stiffening * sum;
  }

  bool assemble(const State& state, bool tangent, Sink& sink) const override {
    std::vector<Slot> slots(64);
    const auto compute = [&](int e, Slot& slot) {
      Kinematics k;
      if (!kinematics(state, cells_[e], k)) return false;
      residual_and_tangent(cells_[e], k, tangent, slot);
      if (state.stiffening != 1.0)
        slot.residual *= state.stiffening, slot.matrix *= state.stiffening, slot.condensed *= state.stiffening;
      return slot.residual.allFinite();
    };
    return for_elements(sink, static_cast<int>(cells_.size()), slots, compute, [&](int e, Slot& slot) {
      sink.add(e, {slot.residual.data(), size},
               tangent ? std::span<const double>(slot.matrix.data(), size * size) : std::span<const double>());
      if (modes > 0 && tangent && cells_[e].split) sink.add_condensed(e, {slot.condensed.data(), size});
    });
  }

  double step_bound(const State& state, const Eigen::VectorXd& direction, double limit) const override {
    double bound = limit;
    for (const Cell& cell : cells_) {
      const Gradients gradient = gradients(cell);
      const Eigen::Matrix<double, 3, 3 * points> F = vectors(state.values, cell) * gradient;
      const Eigen::Matrix<double, 3, 3 * points> dF = vectors(direction, cell) * gradient;
      for (int q = 0; q < points; ++q) {
        const double root = first_inversion(F.template middleCols<3>(3 * q), dF.template middleCols<3>(3 * q), limit);
        if (root < limit) bound = std::min(bound, 0.9 * root);
      }
    }
    return bound;
  }

  void recover(const State& state, Eigen::VectorXd& step) const override {
    if constexpr (modes > 0)
      tbb::parallel_for(std::size_t{0}, cells_.size(), [&](std::size_t c) {
        const Cell& cell = cells_[c];
        Kinematics k;
        if (!cell.split || !kinematics(state, cell, k)) return;
        const FieldRows rows = field_rows(cell, k, true);
        const Eigen::Matrix<double, 3, nodes> du = vectors(step, cell);
        const FieldVector dt = cell.mass_inverse * (rows.pressure + rows.D * du.reshaped());
        step.segment<modes>(cell.own) = dt;
        step.segment<modes>(cell.own + modes) = cell.mass_inverse * (rows.dilatation + rows.H * dt);
      });
  }

  /// Largest relative volume by which a pressure unknown is missed, or a cell's dilatation, or that its pressure is off the
  /// law.
  double volume_error(const State& state) const override {
    if constexpr (modes > 0) return field_error(state);
    Eigen::VectorXd missed = Eigen::VectorXd::Zero(state.values.size()), volume = missed;
    Kinematics k;
    for (const Cell& cell : cells_) {
      if (!cell.split || !kinematics(state, cell, k)) continue;
      for (int v = 0; v < vertices; ++v)
        for (int q = 0; q < points; ++q) {
          const double w = cell.mode(v, q) * cell.weight[q];
          missed[cell.entry[positions + v]] += w * (k.J[q] - k.dilatation[q]);
          volume[cell.entry[positions + v]] += w;
        }
    }
    return (volume.array() > 0.0).select(missed.cwiseAbs().cwiseQuotient(volume), 0.0).maxCoeff();
  }

  Eigen::Matrix<double, 6, Eigen::Dynamic> nodal_stress(const State& state, int index) const override {
    const Cell& cell = cells_[index];
    Kinematics k;
    if (!kinematics(state, cell, k))
      return Eigen::Matrix<double, 6, nodes>::Constant(std::numeric_limits<double>::quiet_NaN());
    Eigen::Matrix<double, 6, points> at_points;
    for (int q = 0; q < points; ++q) {
      const Eigen::Matrix3d s = point(cell, k, q, false).stress * k.F[q].transpose() / k.J[q];
      at_points.col(q) << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2);
    }
    return at_points * to_nodes_;
  }

 private:
  Eigen::Matrix<double, 3, nodes> vectors(const Eigen::VectorXd& values, const Cell& cell) const {
    Eigen::Matrix<double, 3, nodes> x;
    for (int a = 0; a < nodes; ++a) x.col(a) = values.segment<3>(cell.entry[3 * a]);
    return x;
  }

  /// Made where they are wanted: stored they would take nine times the memory of the Jacobians.
  Gradients gradients(const Cell& cell) const {
    Gradients g;
    for (int q = 0; q < points; ++q)
      g.template middleCols<3>(3 * q).noalias() = reference_.template middleCols<3>(3 * q) * cell.inverse.template middleCols<3>(3 * q);
    return g;
  }

  bool kinematics(const State& state, const Cell& cell, Kinematics& k) const {
    k.gradient = gradients(cell);
    const Eigen::Matrix<double, 3, 3 * points> F = vectors(state.values, cell) * k.gradient;
    for (int q = 0; q < points; ++q) {
      k.F[q] = F.template middleCols<3>(3 * q);
      k.J[q] = k.F[q].determinant();
      if (!(k.J[q] > 0.0)) return false;
      k.cofactor[q] = k.J[q] * k.F[q].inverse().transpose();
    }
    k.volumetric_energy = 0.0;
    return !cell.split || (vertices > 0 ? given_pressure(state, cell, k) : given_fields(state, cell, k));
  }

  bool given_pressure(const State& state, const Cell& cell, Kinematics& k) const {
    Eigen::Matrix<double, fields, 1> at_vertices;
    for (int v = 0; v < vertices; ++v) at_vertices[v] = state.values[cell.entry[positions + v]];
    k.pressure = cell.mode.transpose() * at_vertices;
    for (int q = 0; q < points; ++q) {
      k.dilatation[q] = dilatation(*cell.law, k.pressure[q]);
      const auto v = materials::volumetric(*cell.law, k.dilatation[q]);
      k.volumetric_energy += cell.weight[q] * (v.energy + k.pressure[q] * (k.J[q] - k.dilatation[q]));
      k.modulus[q] = v.modulus;
    }
    return true;
  }

  bool given_fields(const State& state, const Cell& cell, Kinematics& k) const {
    if constexpr (modes > 0) {
      k.dilatation = PointValues::Ones() + cell.mode.transpose() * state.values.segment<modes>(cell.own);
      k.pressure = cell.mode.transpose() * state.values.segment<modes>(cell.own + modes);
      if (!(k.dilatation.minCoeff() > 0.0)) return false;
      for (int q = 0; q < points; ++q) {
        const auto v = materials::volumetric(*cell.law, k.dilatation[q]);
        k.volumetric_energy += cell.weight[q] * (v.energy + k.pressure[q] * (k.J[q] - k.dilatation[q]));
        k.modulus[q] = v.modulus;
      }
    }
    return true;
  }

  FieldRows field_rows(const Cell& cell, const Kinematics& k, bool derivatives) const {
    FieldRows rows;
    PointValues off_law;
    for (int q = 0; q < points; ++q)
      off_law[q] = cell.weight[q] * (materials::volumetric(*cell.law, k.dilatation[q]).pressure - k.pressure[q]);
    rows.dilatation = cell.mode * off_law;
    rows.pressure = cell.mode * cell.weight.cwiseProduct(k.J - k.dilatation);
    if (!derivatives) return rows;
    rows.D = volume_derivative(cell, k);
    rows.H = cell.mode * cell.weight.cwiseProduct(k.modulus).asDiagonal() * cell.mode.transpose();
    return rows;
  }

  double field_error(const State& state) const {
    double error = 0.0;
    Kinematics k;
    for (const Cell& cell : cells_) {
      if (!cell.split || !kinematics(state, cell, k)) continue;
      const FieldRows rows = field_rows(cell, k, false);
      error = std::max(error, (cell.mass_inverse * rows.pressure).cwiseAbs().maxCoeff());
      error = std::max(error, (cell.mass_inverse * rows.dilatation).cwiseAbs().maxCoeff() / k.modulus.maxCoeff());
    }
    return error;
  }

  Eigen::Matrix<double, fields, positions> volume_derivative(const Cell& cell, const Kinematics& k) const {
    Eigen::Matrix<double, fields, positions> D = Eigen::Matrix<double, fields, positions>::Zero();
    for (int q = 0; q < points; ++q) {
      const Eigen::Matrix<double, 3, nodes> g = k.cofactor[q] * k.gradient.template middleCols<3>(3 * q).transpose();
      D += cell.weight[q] * cell.mode.col(q) * Eigen::Map<const Eigen::Matrix<double, 1, positions>>(g.data());
    }
    return D;
  }

  /// Energy, P and tangent of a point; the energy of a split law without its volumetric part.
  Point point(const Cell& cell, const Kinematics& k, int q, bool tangent) const {
    if (!cell.split) {
      const auto r = materials::coupled(*cell.law, k.F[q]);
      return {r.energy, r.stress, r.tangent};
    }
    const auto iso = materials::isochoric(*cell.law, k.F[q]);
    Point p{iso.energy, iso.stress + k.pressure[q] * k.cofactor[q], iso.tangent};
    if (tangent) add_cofactor_derivative(k.cofactor[q], k.J[q], k.pressure[q], p.tangent);
    return p;
  }

  void residual_and_tangent(const Cell& cell, const Kinematics& k, bool tangent, Slot& slot) const {
    Eigen::Matrix<double, 3, 3 * points> stress;               // weighted P of all points
    std::array<std::array<Eigen::Matrix3d, 9>, points> A;      // weighted blocks (i, k) of the tangent
    for (int q = 0; q < points; ++q) {
      const Point p = point(cell, k, q, tangent);
      stress.template middleCols<3>(3 * q) = cell.weight[q] * p.stress;
      for (int i = 0; i < 3 && tangent; ++i)
        for (int j = 0; j < 3; ++j) A[q][3 * i + j] = cell.weight[q] * p.tangent.template block<3, 3>(3 * i, 3 * j);
    }
    Eigen::Map<Eigen::Matrix<double, 3, nodes>>(slot.residual.data()) = stress * k.gradient.transpose();
    if (vertices > 0) slot.residual.template tail<vertices>().setZero();
    if (tangent) displacement_tangent(k.gradient, A, slot);
    if (cell.split) pressure_parts(cell, k, tangent, slot);
  }

  void displacement_tangent(const Gradients& gradient, const std::array<std::array<Eigen::Matrix3d, 9>, points>& A,
                            Slot& slot) const {
    if (vertices > 0) slot.matrix.template rightCols<vertices>().setZero();
    if (vertices > 0) slot.matrix.template bottomRows<vertices>().setZero();
    Eigen::Matrix<double, nodes, nodes> block;
    static thread_local Eigen::Matrix<double, 3 * points, nodes> right;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) {
        for (int q = 0; q < points; ++q)
          right.template middleRows<3>(3 * q).noalias() =
              A[q][3 * i + j] * gradient.template middleCols<3>(3 * q).transpose();
        block.noalias() = gradient * right;
        for (int a = 0; a < nodes; ++a)
          for (int b = 0; b < nodes; ++b) {
            slot.matrix(3 * a + i, 3 * b + j) = block(a, b);
            slot.matrix(3 * b + j, 3 * a + i) = block(a, b);
          }
      }
  }

  /// What ties the pressure to the volume: condensed into the displacements, or its own rows.
  void pressure_parts(const Cell& cell, const Kinematics& k, bool tangent, Slot& slot) const {
    if constexpr (vertices > 0) {
      slot.residual.template tail<vertices>() = cell.mode * cell.weight.cwiseProduct(k.J - k.dilatation);
      if (!tangent) return;
      const Eigen::Matrix<double, fields, positions> D = volume_derivative(cell, k);
      slot.matrix.template bottomLeftCorner<vertices, positions>() = D;
      slot.matrix.template topRightCorner<positions, vertices>() = D.transpose();
      slot.matrix.template bottomRightCorner<vertices, vertices>() =
          -cell.mode * cell.weight.cwiseQuotient(k.modulus).asDiagonal() * cell.mode.transpose();
    } else if (tangent) {
      const FieldRows rows = field_rows(cell, k, true);
      const Fields middle = cell.mass_inverse * rows.H * cell.mass_inverse;
      slot.matrix.noalias() += rows.D.transpose() * (middle * rows.D);
      slot.condensed.noalias() = rows.D.transpose() * (cell.mass_inverse * rows.dilatation + middle * rows.pressure);
    }
  }

  Gradients reference_;
  Eigen::Matrix<double, points, nodes> to_nodes_;
  std::vector<Cell> cells_;
};

}  // namespace

}  // namespace snug::solver
