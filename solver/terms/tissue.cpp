#include "solver/terms/tissue.hpp"

#include <Eigen/LU>

#include <cmath>

#include "solver/terms/parallel.hpp"
#include "solver/terms/tabulate.hpp"

namespace snug::solver {

struct Tissue::Slot {
  Eigen::Matrix<double, 81, 1> residual;
  Eigen::Matrix<double, 81, 81, Eigen::RowMajor> matrix;
};

Tissue::Tissue(const Layout& layout, const mesh::BodyMesh& mesh, std::vector<materials::SolidLaw> laws)
    : layout_(layout), laws_(std::move(laws)) {
  const HexTable table = tabulate_hexahedra(mesh);
  cells_.resize(mesh.cells.size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    Cell& cell = cells_[c];
    cell.nodes = mesh.cells[c];
    cell.law = &laws_[mesh.cell_layer[c]];
    cell.gradient = table.gradient[c];
    cell.weight = table.weight[c];
    Eigen::Vector3d centre = table.point[c] * cell.weight / cell.weight.sum();
    const double size = std::cbrt(cell.weight.sum());
    cell.mode.row(0).setOnes();
    cell.mode.bottomRows<3>() = (table.point[c].colwise() - centre) / size;
    cell.mass_inverse = Eigen::Matrix4d(cell.mode * cell.weight.asDiagonal() * cell.mode.transpose()).inverse();
    std::array<int, 81> entries{};
    for (int a = 0; a < 27; ++a)
      for (int i = 0; i < 3; ++i) entries[3 * a + i] = layout.body(cell.nodes[a], i);
    entries_.push(entries);
  }
}

Eigen::Matrix<double, 3, 27> Tissue::positions(const Eigen::VectorXd& values, const Cell& cell) const {
  Eigen::Matrix<double, 3, 27> x;
  for (int a = 0; a < 27; ++a) x.col(a) = values.segment<3>(layout_.body(cell.nodes[a]));
  return x;
}

bool Tissue::kinematics(const State& state, const Cell& cell, Kinematics& k) const {
  const Eigen::Matrix<double, 3, 81> F = positions(state.values, cell) * cell.gradient;
  for (int q = 0; q < points; ++q) {
    k.F[q] = F.middleCols<3>(3 * q);
    k.J[q] = k.F[q].determinant();
    if (!(k.J[q] > 0.0)) return false;
    k.cofactor[q] = k.J[q] * k.F[q].inverse().transpose();
  }
  k.averaged = cell.mode.transpose() * (cell.mass_inverse * (cell.mode * cell.weight.cwiseProduct(k.J)));
  if (!(k.averaged.minCoeff() > 0.0)) return false;
  Eigen::Matrix<double, 27, 1> pressure;
  k.volumetric_energy = 0.0;
  for (int q = 0; q < points; ++q) {
    const auto v = materials::volumetric(*cell.law, k.averaged[q]);
    k.volumetric_energy += cell.weight[q] * v.energy;
    pressure[q] = v.pressure;
    k.modulus[q] = v.modulus;
  }
  k.pressure = cell.mode.transpose() * (cell.mass_inverse * (cell.mode * cell.weight.cwiseProduct(pressure)));
  return true;
}

namespace {

// d cof(F)_iJ / dF_kL = (cof_iJ cof_kL - cof_iL cof_kJ) / J, index 3 i + J.
void add_cofactor_derivative(const Eigen::Matrix3d& cofactor, double J, double p, Eigen::Matrix<double, 9, 9>& A) {
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          A(3 * i + a, 3 * k + b) += p / J * (cofactor(i, a) * cofactor(k, b) - cofactor(i, b) * cofactor(k, a));
}

}  // namespace

void Tissue::residual_and_tangent(const Cell& cell, const Kinematics& k, bool tangent, Slot& slot) const {
  Eigen::Matrix<double, 3, 81> stress;                                  // weighted P of all points
  std::array<std::array<Eigen::Matrix3d, 9>, points> A;                 // weighted blocks (i, k) of the tangent
  for (int q = 0; q < points; ++q) {
    const auto iso = materials::isochoric(*cell.law, k.F[q]);
    stress.middleCols<3>(3 * q) = cell.weight[q] * (iso.stress + k.pressure[q] * k.cofactor[q]);
    if (!tangent) continue;
    Eigen::Matrix<double, 9, 9> full = iso.tangent;
    add_cofactor_derivative(k.cofactor[q], k.J[q], k.pressure[q], full);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) A[q][3 * i + j] = cell.weight[q] * full.block<3, 3>(3 * i, 3 * j);
  }
  Eigen::Map<Eigen::Matrix<double, 3, 27>>(slot.residual.data()) = stress * cell.gradient.transpose();
  if (!tangent) return;

  Eigen::Matrix<double, 27, 27> block;
  static thread_local Eigen::Matrix<double, 81, 27> right;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      for (int q = 0; q < points; ++q)
        right.middleRows<3>(3 * q).noalias() = A[q][3 * i + j] * cell.gradient.middleCols<3>(3 * q).transpose();
      block.noalias() = cell.gradient * right;
      for (int a = 0; a < nodes; ++a)
        for (int b = 0; b < nodes; ++b) {
          slot.matrix(3 * a + i, 3 * b + j) = block(a, b);
          slot.matrix(3 * b + j, 3 * a + i) = block(a, b);
        }
    }
  Eigen::Matrix<double, 4, 81> D = Eigen::Matrix<double, 4, 81>::Zero();
  for (int q = 0; q < points; ++q) {
    const Eigen::Matrix<double, 3, 27> g = k.cofactor[q] * cell.gradient.middleCols<3>(3 * q).transpose();
    D += cell.weight[q] * cell.mode.col(q) * Eigen::Map<const Eigen::Matrix<double, 1, 81>>(g.data());
  }
  const Eigen::Matrix4d H = cell.mode * cell.weight.cwiseProduct(k.modulus).asDiagonal() * cell.mode.transpose();
  const Eigen::Matrix4d middle = cell.mass_inverse * H * cell.mass_inverse;
  slot.matrix.noalias() += D.transpose() * (middle * D);
}

bool Tissue::assemble(const State& state, Tangent tangent, Sink& sink) const {
  std::vector<Slot> slots(64);
  const auto compute = [&](int e, Slot& slot) {
    Kinematics k;
    if (!kinematics(state, cells_[e], k)) return false;
    residual_and_tangent(cells_[e], k, wanted(tangent), slot);
    if (state.stiffening != 1.0) slot.residual *= state.stiffening, slot.matrix *= state.stiffening;
    return slot.residual.allFinite();
  };
  return for_elements(cells(), slots, compute, [&](int e, Slot& slot) {
    sink.add(e, {slot.residual.data(), 81},
             wanted(tangent) ? std::span<const double>(slot.matrix.data(), 81 * 81) : std::span<const double>());
  });
}

double Tissue::energy(const State& state) const {
  double sum = 0.0;
  Kinematics k;
  for (const Cell& cell : cells_) {
    if (!kinematics(state, cell, k)) return std::numeric_limits<double>::infinity();
    sum += k.volumetric_energy;
    for (int q = 0; q < points; ++q) sum += cell.weight[q] * materials::isochoric(*cell.law, k.F[q]).energy;
  }
  return state.stiffening * sum;
}

namespace {

// First root in (0, limit] of det(F + a dF) = 0.05 det F, a cubic in a; `limit` when there is none.
double first_root(const Eigen::Matrix3d& F, const Eigen::Matrix3d& dF, double limit) {
  const double c0 = F.determinant(), c3 = dF.determinant();
  const double at_plus = (F + dF).determinant(), at_minus = (F - dF).determinant();
  const double c2 = 0.5 * (at_plus + at_minus) - c0, c1 = 0.5 * (at_plus - at_minus) - c3;
  const auto value = [&](double a) { return 0.95 * c0 + a * (c1 + a * (c2 + a * c3)); };
  std::array<double, 3> ends = {limit, limit, limit};  // extrema split the interval into monotone pieces
  const double discriminant = c2 * c2 - 3.0 * c1 * c3;
  if (std::abs(c3) > 1e-300 && discriminant >= 0.0) {
    const double root = std::sqrt(discriminant);
    ends[0] = std::min((-c2 - root) / (3.0 * c3), (-c2 + root) / (3.0 * c3));
    ends[1] = std::max((-c2 - root) / (3.0 * c3), (-c2 + root) / (3.0 * c3));
  } else if (std::abs(c2) > 1e-300) {
    ends[0] = -c1 / (2.0 * c2);
  }
  double begin = 0.0;
  for (double end : ends) {
    end = std::clamp(end, begin, limit);
    if (value(end) < 0.0) {
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (begin + end);
        (value(middle) < 0.0 ? end : begin) = middle;
      }
      return begin;
    }
    begin = end;
  }
  return limit;
}

}  // namespace

double Tissue::step_bound(const State& state, const Eigen::VectorXd& direction, double limit) const {
  double bound = limit;
  for (const Cell& cell : cells_) {
    const Eigen::Matrix<double, 3, 81> F = positions(state.values, cell) * cell.gradient;
    const Eigen::Matrix<double, 3, 81> dF = positions(direction, cell) * cell.gradient;
    for (int q = 0; q < points; ++q) {
      const double root = first_root(F.middleCols<3>(3 * q), dF.middleCols<3>(3 * q), limit);
      if (root < limit) bound = std::min(bound, 0.9 * root);
    }
  }
  return bound;
}

std::array<Eigen::Matrix<double, 6, 1>, 27> Tissue::nodal_stress(const State& state, int index) const {
  const Cell& cell = cells_[index];
  Kinematics k;
  std::array<Eigen::Matrix<double, 6, 1>, 27> at_nodes;
  for (auto& s : at_nodes) s.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (!kinematics(state, cell, k)) return at_nodes;
  Eigen::Matrix<double, 6, 27> at_points;
  for (int q = 0; q < points; ++q) {
    const auto iso = materials::isochoric(*cell.law, k.F[q]);
    const Eigen::Matrix3d s = (iso.stress + k.pressure[q] * k.cofactor[q]) * k.F[q].transpose() / k.J[q];
    at_points.col(q) << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2);
  }
  const Eigen::Matrix<double, 6, 27> extrapolated = at_points * gauss_to_nodes();
  for (int a = 0; a < 27; ++a) at_nodes[a] = extrapolated.col(a);
  return at_nodes;
}

}  // namespace snug::solver
