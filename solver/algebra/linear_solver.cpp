#include "solver/algebra/linear_solver.hpp"

#include <petscksp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "solver/algebra/communicator.hpp"
#include "solver/algebra/preconditioner.hpp"

namespace snug::solver {

namespace {

// Of a solve with a fresh factor: what it goes for, and what does where round-off ends it before.
constexpr double exact = 1e-12, nearly_exact = 1e-10;
// With a lagged factor: about half of what a factorisation costs. Its work grows with n^2 and that of an iteration with n^(4/3)
// (nested dissection of a solid: George, SIAM J. Numer. Anal. 10 (1973) 345-363), and at 150k unknowns it costs as much as 40
// iterations; so it does at 310k and at 980k, where blocks of low rank save the factor what it would cost more. No measured
// time decides, so that a run can be repeated to the last bit, and on any number of ranks.
int most_iterations(int unknowns) { return std::clamp(static_cast<int>(20.0 * std::pow(unknowns / 150e3, 2.0 / 3.0)), 10, 20); }
constexpr int fresh_iterations = 20;
// A solve is given up where it contracts too slowly to end in time: by so much more than what the iterations so far make expect,
// since FGMRES grows faster as it goes.
constexpr int watched_from = 4;
constexpr double superlinear = 1.5;
constexpr double stalled = 0.1;  // an iteration with a fresh factor that brings less than this
// What a solve with a lagged factor has to bring where its iterations end before its tolerance: one more step of Newton's method
// costs less than a factor.
constexpr double good_enough = 1e-3;
// From so many unknowns on a compressed factor costs less (docs/growth.md).
constexpr int low_rank_from = 100000;
// With the factor of the symmetric part: 11 to 28 were seen on bars that bend under a pressure of twice their shear modulus.
// The factor of the whole costs twice as much, in time and in memory.
constexpr int most_unsymmetric = 60;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// What a solve is allowed, and where it stood at its start.
struct Allowed {
  double tolerance = 0.0, acceptable = 0.0;  ///< to go for; what does where no more is to be had
  int most = 0;
  bool watched = false;  ///< it may be given up before
  double start = 0.0, last = 0.0;
};

PetscErrorCode judge(KSP, PetscInt iteration, PetscReal norm, KSPConvergedReason* reason, void* context) {
  Allowed& allowed = *static_cast<Allowed*>(context);
  if (iteration == 0) allowed.start = norm;
  const double before = std::exchange(allowed.last, norm);
  const double goal = allowed.tolerance * allowed.start;
  const auto too_slow = [&] {
    if (!allowed.watched || iteration < watched_from) return false;
    const double contraction = std::log(norm / allowed.start);
    return contraction >= 0.0 || iteration * std::log(allowed.tolerance) / contraction > superlinear * allowed.most;
  };
  *reason = KSP_CONVERGED_ITERATING;
  if (!std::isfinite(norm)) *reason = KSP_DIVERGED_NANORINF;
  else if (norm <= goal) *reason = KSP_CONVERGED_RTOL;
  else if (!allowed.watched && iteration > 0 && norm <= allowed.acceptable * allowed.start && norm > stalled * before) *reason = KSP_CONVERGED_ITS;
  else if (iteration >= allowed.most || too_slow()) *reason = KSP_DIVERGED_ITS;
  return 0;
}

PetscErrorCode apply_inverse(PC shell, Vec in, Vec out) {
  void* inverse = nullptr;
  PCShellGetContext(shell, &inverse);
  return static_cast<Preconditioner*>(inverse)->apply(in, out);
}

/// The matrix as FGMRES sees it: own rows times a vector, of which each rank has the entries that its rows name.
class Product {
 public:
  Product() = default;
  Product(const Product&) = delete;
  Product& operator=(const Product&) = delete;
  ~Product() { clear(); }

  Mat of(const OwnRows& rows) {
    clear();
    rows_ = rows;
    const RowPattern& pattern = rows.pattern;
    MatCreateShell(PETSC_COMM_WORLD, pattern.count, pattern.count, pattern.unknowns, pattern.unknowns, this, &shell_);
    MatShellSetOperation(shell_, MATOP_MULT, reinterpret_cast<void (*)()>(apply));
    if (ranks() > 1) gather_what_rows_name();
    return shell_;
  }
  /// The same pattern with other values, and what is added to it: D of all unknowns and a part that is not scaled, or null.
  void renew(const OwnRows& rows, const Eigen::VectorXd& scale, const OneWay* one_way) { rows_ = rows, scale_ = &scale, one_way_ = one_way; }
  void clear() {
    VecScatterDestroy(&gather_);
    VecDestroy(&all_);
    MatDestroy(&shell_);
  }

 private:
  /// `all_` is of all unknowns, so that columns stay as they are; only what is named is sent.
  void gather_what_rows_name() {
    const RowPattern& pattern = rows_.pattern;
    std::vector<char> named(pattern.unknowns, 0);
    for (int k = 0; k < pattern.offsets[pattern.count]; ++k) named[pattern.columns[k]] = 1;
    std::vector<PetscInt> list;
    for (int u = 0; u < pattern.unknowns; ++u)
      if (named[u]) list.push_back(u);
    IS entries = nullptr;
    Vec like = nullptr;
    ISCreateGeneral(PETSC_COMM_SELF, static_cast<PetscInt>(list.size()), list.data(), PETSC_COPY_VALUES, &entries);
    VecCreateSeq(PETSC_COMM_SELF, pattern.unknowns, &all_);
    VecSet(all_, 0.0);
    MatCreateVecs(shell_, &like, nullptr);
    VecScatterCreate(like, entries, all_, entries, &gather_);
    VecDestroy(&like);
    ISDestroy(&entries);
  }

  static PetscErrorCode apply(Mat shell, Vec x, Vec product) {
    void* self = nullptr;
    MatShellGetContext(shell, &self);
    const Product& p = *static_cast<Product*>(self);
    if (p.gather_) {
      VecScatterBegin(p.gather_, x, p.all_, INSERT_VALUES, SCATTER_FORWARD);
      VecScatterEnd(p.gather_, x, p.all_, INSERT_VALUES, SCATTER_FORWARD);
    }
    const Vec from = p.gather_ ? p.all_ : x;
    const PetscScalar* given = nullptr;
    PetscScalar* made = nullptr;
    VecGetArrayRead(from, &given);
    VecGetArray(product, &made);
    multiply(p.rows_, given, made);
    VecRestoreArrayRead(from, &given);
    if (p.one_way_) p.add_one_way(x, made);
    VecRestoreArray(product, &made);
    return 0;
  }

  void add_one_way(Vec x, PetscScalar* made) const {
    const int first = rows_.pattern.first, end = first + rows_.pattern.count;
    Eigen::VectorXd all = Eigen::VectorXd::Zero(rows_.pattern.unknowns), sum = all;
    const PetscScalar* mine = nullptr;
    VecGetArrayRead(x, &mine);
    for (int i = first; i < end; ++i) all[i] = (*scale_)[i] * mine[i - first];
    VecRestoreArrayRead(x, &mine);
    gather_ranges(all, first, end);
    (*one_way_)(all, sum);
    for (int i = first; i < end; ++i) made[i - first] += (*scale_)[i] * sum[i];
  }

  OwnRows rows_;
  const Eigen::VectorXd* scale_ = nullptr;
  const OneWay* one_way_ = nullptr;
  Mat shell_ = nullptr;
  Vec all_ = nullptr;
  VecScatter gather_ = nullptr;
};

}  // namespace

struct LinearSolver::Petsc {
  OwnRows rows;
  Product product;
  Vec right = nullptr, solution = nullptr;
  KSP ksp = nullptr;
  FactorKind kind = FactorKind::double_precision;
  double memory = 0.0;  ///< bytes that the program may take
  std::unique_ptr<Preconditioner> inverse = mumps_factor(kind);  ///< of the last matrix that was factored; its pattern may be an earlier one
  bool factored = false;    ///< `inverse` can be applied
  bool analysed = false;    ///< `inverse` is of the present pattern
  bool symmetric = true;
  bool precise = false;     ///< FGMRES did not get there with a factor in single precision
  bool whole = false;       ///< FGMRES did not get there with the symmetric part: `inverse` is of the whole, until the next pattern
  Allowed allowed;
  int unknowns = 0, first = 0, end = 0;
  int negative_pivots = -1;
  Eigen::VectorXd scale;    ///< D of all unknowns

  void destroy_factor() {
    inverse->clear();
    factored = analysed = false;
  }
  void choose_factor() {
    const bool doubled = precise || unknowns < single_precision_from;
    const FactorKind wanted = doubled ? FactorKind::double_precision : unknowns < low_rank_from ? FactorKind::single_precision : FactorKind::low_rank;
    if (wanted == kind) return;
    kind = wanted;
    factored = analysed = false;
    inverse = mumps_factor(kind, memory);
    use_inverse();
  }
  /// A factor that is nearer to the matrix: of the whole instead of its symmetric part, then in double precision. False: there is none.
  bool step_up() {
    if (!symmetric && !whole) {
      whole = true, analysed = false;
      return true;
    }
    if (kind == FactorKind::double_precision) return false;
    precise = true;
    choose_factor();
    return true;
  }
  void use_inverse() {
    PC shell = nullptr;
    KSPGetPC(ksp, &shell);
    PCSetType(shell, PCSHELL);
    PCShellSetContext(shell, inverse.get());
    PCShellSetApply(shell, apply_inverse);
  }
  void destroy_system() {
    KSPDestroy(&ksp);
    VecDestroy(&solution);
    VecDestroy(&right);
    product.clear();
  }
  ~Petsc() { destroy_system(); }

  void rescale(const SparseScatter& scatter) {
    scale = Eigen::VectorXd::Zero(unknowns);
    const Eigen::VectorXd diagonal = scatter.diagonal();
    for (int i = 0; i < scatter.rows(); ++i)
      if (diagonal[i] > 0.0 && std::isfinite(diagonal[i])) scale[first + i] = 1.0 / std::sqrt(diagonal[i]);
    gather_ranges(scale, first, end);
    const Eigen::VectorXd largest = scatter.largest_in_rows(scale);
    for (int i = 0; i < scatter.rows(); ++i) {
      if (scale[first + i] != 0.0) continue;
      const double size = std::max(largest[i], std::sqrt(std::abs(diagonal[i])));
      scale[first + i] = size > 0.0 && std::isfinite(size) ? 1.0 / size : 1.0;
    }
    gather_ranges(scale, first, end);
  }

  void put(const Eigen::VectorXd& values) {
    PetscScalar* mine = nullptr;
    VecGetArray(right, &mine);
    for (int i = first; i < end; ++i) mine[i - first] = scale[i] * values[i];
    VecRestoreArray(right, &mine);
  }

  void get(Eigen::VectorXd& values) const {
    values = Eigen::VectorXd::Zero(unknowns);
    const PetscScalar* mine = nullptr;
    VecGetArrayRead(solution, &mine);
    for (int i = first; i < end; ++i) values[i] = scale[i] * mine[i - first];
    VecRestoreArrayRead(solution, &mine);
    gather_ranges(values, first, end);
  }

  bool renew_factor() {
    const bool fresh = !std::exchange(analysed, false);
    const Operand operand = symmetric ? Operand::symmetric : whole ? Operand::whole : Operand::symmetric_part;
    factored = analysed = inverse->renew(rows, operand, fresh);
    if (symmetric) negative_pivots = inverse->negative_pivots();
    return factored;
  }

  bool iterate(const Allowed& what, int& iterations) {
    allowed = what;
    KSPSetTolerances(ksp, what.tolerance, 0.0, PETSC_DEFAULT, what.most);
    if (KSPSolve(ksp, right, solution) != 0) return false;
    KSPConvergedReason reason = KSP_DIVERGED_ITS;
    KSPGetConvergedReason(ksp, &reason);
    PetscInt taken = 0;
    KSPGetIterationNumber(ksp, &taken);
    iterations += static_cast<int>(taken);
    if (reason > 0) return true;
    return allowed.last <= allowed.acceptable * allowed.start;
  }
};

LinearSolver::LinearSolver() : petsc_(std::make_unique<Petsc>()) {}
LinearSolver::~LinearSolver() = default;
LinearSolver::LinearSolver(LinearSolver&&) noexcept = default;
LinearSolver& LinearSolver::operator=(LinearSolver&&) noexcept = default;

void LinearSolver::may_take(double memory) {
  Petsc& p = *petsc_;
  if (memory == p.memory) return;
  p.memory = memory;
  p.factored = p.analysed = false;
  p.inverse = mumps_factor(p.kind, memory);
  if (p.ksp) p.use_inverse();
}

void LinearSolver::reset(SparseScatter& scatter, int unknowns, bool symmetric) {
  Petsc& p = *petsc_;
  p.destroy_system();
  p.analysed = false;
  p.symmetric = symmetric, p.whole = false, p.negative_pivots = -1;
  if (unknowns != p.unknowns) p.destroy_factor();
  p.unknowns = unknowns, p.first = scatter.first_row(), p.end = scatter.first_row() + scatter.rows();
  p.rows = scatter.own_rows();
  const Mat matrix = p.product.of(p.rows);
  MatCreateVecs(matrix, &p.solution, &p.right);
  KSPCreate(PETSC_COMM_WORLD, &p.ksp);
  KSPSetType(p.ksp, KSPFGMRES);
  KSPGMRESSetRestart(p.ksp, most_unsymmetric);
  KSPSetConvergenceTest(p.ksp, judge, &p.allowed, nullptr);
  KSPSetOperators(p.ksp, matrix, matrix);
  p.use_inverse();
  p.choose_factor();
}

LinearReport LinearSolver::solve(SparseScatter& scatter, const Eigen::VectorXd& right, Eigen::VectorXd& x,
                                 const Lag& lag, const OneWay& one_way) {
  Petsc& p = *petsc_;
  if (lag.precise) {
    p.precise = true;
    p.choose_factor();
  }
  const bool lagged = lag.allowed && !lag.precise && p.factored;
  if (!lagged) p.rescale(scatter);
  scatter.scale(p.scale);
  p.rows = scatter.own_rows();
  p.product.renew(p.rows, p.scale, one_way ? &one_way : nullptr);
  p.put(right);
  LinearReport report;
  double start = now();
  const auto lap = [&] {
    const double before = start;
    return (start = now()) - before;
  };
  const bool near = (p.symmetric || p.whole) && !one_way;  // what is factored is what is solved
  if (lagged) report.ok = p.iterate({lag.tolerance, good_enough, near ? most_iterations(p.unknowns) : most_unsymmetric, true}, report.iterations);
  report.solve_seconds = lap();
  const auto refactor = [&] {
    report.refactored = true;
    const bool factored = p.renew_factor();
    report.factor_seconds += lap();
    const double goal = p.kind == FactorKind::double_precision && !one_way ? exact : std::max(exact, lag.tolerance);
    report.ok = factored && p.iterate({goal, std::max(goal, nearly_exact), near ? fresh_iterations : most_unsymmetric}, report.iterations);
    p.factored = report.ok;
    report.solve_seconds += lap();
  };
  if (!report.ok) refactor();
  if (!report.ok && one_way && p.analysed) {  // without it
    p.product.renew(p.rows, p.scale, nullptr);
    report.ok = p.iterate({std::max(exact, lag.tolerance), nearly_exact, fresh_iterations}, report.iterations);
    p.factored = report.ok;
  }
  while (!report.ok && p.step_up()) refactor();
  report.negative_pivots = p.negative_pivots;
  report.single_precision = p.kind != FactorKind::double_precision;
  report.factor = p.inverse->description();
  p.product.renew(p.rows, p.scale, nullptr);
  p.get(x);
  report.ok = report.ok && x.allFinite();
  return report;
}

bool LinearSolver::solve_again(const Eigen::VectorXd& right, Eigen::VectorXd& x) {
  Petsc& p = *petsc_;
  p.put(right);
  int iterations = 0;
  const bool ok = p.factored && p.iterate({exact, nearly_exact, p.symmetric || p.whole ? fresh_iterations : most_unsymmetric}, iterations);
  p.get(x);
  return ok && x.allFinite();
}

}  // namespace snug::solver
