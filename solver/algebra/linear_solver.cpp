#include "solver/algebra/linear_solver.hpp"

#include <petscksp.h>

#include <vector>

namespace snug::solver {

struct LinearSolver::Petsc {
  Mat matrix = nullptr;
  Vec right = nullptr, solution = nullptr, gathered = nullptr;
  VecScatter gather = nullptr;
  KSP ksp = nullptr;
  bool factored = false;
  int negative_pivots = -1;

  void destroy() {
    KSPDestroy(&ksp);
    VecScatterDestroy(&gather);
    VecDestroy(&gathered);
    VecDestroy(&solution);
    VecDestroy(&right);
    MatDestroy(&matrix);
    factored = false;
  }
  ~Petsc() { destroy(); }
};

namespace {

// Multifrontal symmetric factorisation, ordering by METIS, generous work space because contact rows delay pivots.
void configure_factor(PC pc) {
  PCSetType(pc, PCCHOLESKY);
  PCFactorSetMatSolverType(pc, MATSOLVERMUMPS);
  PCFactorSetUpMatSolverType(pc);
  Mat factor = nullptr;
  PCFactorGetMatrix(pc, &factor);
  MatMumpsSetIcntl(factor, 7, 5);
  MatMumpsSetIcntl(factor, 14, 60);
}

}  // namespace

LinearSolver::LinearSolver() : petsc_(std::make_unique<Petsc>()) {}
LinearSolver::~LinearSolver() = default;
LinearSolver::LinearSolver(LinearSolver&&) noexcept = default;
LinearSolver& LinearSolver::operator=(LinearSolver&&) noexcept = default;

std::pair<int, int> LinearSolver::owned_rows(int unknowns) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &ranks);
  const auto bound = [&](long r) { return static_cast<int>(r * unknowns / ranks); };
  return {bound(rank), bound(rank + 1)};
}

void LinearSolver::reset(const SparseScatter& scatter, int unknowns) {
  Petsc& p = *petsc_;
  p.destroy();
  MatCreateMPIAIJWithArrays(PETSC_COMM_WORLD, scatter.rows(), scatter.rows(), unknowns, unknowns,
                            scatter.row_offsets().data(), scatter.columns().data(), scatter.values().data(), &p.matrix);
  MatSetOption(p.matrix, MAT_SYMMETRIC, PETSC_TRUE);
  MatSetOption(p.matrix, MAT_SYMMETRY_ETERNAL, PETSC_TRUE);
  MatCreateVecs(p.matrix, &p.solution, &p.right);
  VecScatterCreateToAll(p.solution, &p.gather, &p.gathered);
  KSPCreate(PETSC_COMM_WORLD, &p.ksp);
  KSPSetType(p.ksp, KSPFGMRES);
  KSPSetOperators(p.ksp, p.matrix, p.matrix);
  PC pc = nullptr;
  KSPGetPC(p.ksp, &pc);
  configure_factor(pc);
  KSPSetTolerances(p.ksp, 1e-10, 0.0, PETSC_DEFAULT, 12);
}

LinearReport LinearSolver::solve(const SparseScatter& scatter, const Eigen::VectorXd& right, Eigen::VectorXd& x,
                                 bool may_lag) {
  Petsc& p = *petsc_;
  MatUpdateMPIAIJWithArray(p.matrix, scatter.values().data());
  PetscInt first = 0, end = 0;
  VecGetOwnershipRange(p.right, &first, &end);
  PetscScalar* values = nullptr;
  VecGetArray(p.right, &values);
  for (PetscInt i = first; i < end; ++i) values[i - first] = right[i];
  VecRestoreArray(p.right, &values);

  LinearReport report;
  for (const bool fresh : {false, true}) {
    if (!fresh && !(may_lag && p.factored)) continue;
    KSPSetReusePreconditioner(p.ksp, fresh ? PETSC_FALSE : PETSC_TRUE);
    KSPSolve(p.ksp, p.right, p.solution);
    KSPConvergedReason reason = KSP_DIVERGED_ITS;
    KSPGetConvergedReason(p.ksp, &reason);
    PetscInt iterations = 0;
    KSPGetIterationNumber(p.ksp, &iterations);
    report.iterations = static_cast<int>(iterations);
    report.refactored = fresh;
    report.ok = reason > 0;
    if (fresh) {
      PC pc = nullptr;
      Mat factor = nullptr;
      KSPGetPC(p.ksp, &pc);
      PCFactorGetMatrix(pc, &factor);
      PetscInt negative = -1;
      MatMumpsGetInfog(factor, 12, &negative);
      p.negative_pivots = static_cast<int>(negative);
      p.factored = report.ok;
    }
    if (report.ok) break;
  }
  report.negative_pivots = p.negative_pivots;
  VecScatterBegin(p.gather, p.solution, p.gathered, INSERT_VALUES, SCATTER_FORWARD);
  VecScatterEnd(p.gather, p.solution, p.gathered, INSERT_VALUES, SCATTER_FORWARD);
  const PetscScalar* all = nullptr;
  VecGetArrayRead(p.gathered, &all);
  x = Eigen::Map<const Eigen::VectorXd>(all, right.size());
  VecRestoreArrayRead(p.gathered, &all);
  report.ok = report.ok && x.allFinite();
  return report;
}

}  // namespace snug::solver
