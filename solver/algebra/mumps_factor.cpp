#include <petscksp.h>

#include "solver/algebra/preconditioner.hpp"

namespace snug::solver {

namespace {

class MumpsFactor : public Preconditioner {
 public:
  MumpsFactor() = default;
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;
  ~MumpsFactor() override { clear(); }

  bool renew(Mat matrix, bool symmetric, bool fresh) override {
    if (fresh || !factor_) analyse(matrix, symmetric);
    negative_pivots_ = -1;
    PCSetReusePreconditioner(factor_, PETSC_FALSE);
    const bool ok = PCSetUp(factor_) == 0 && done(symmetric);
    if (!ok) clear();  // a factor that failed is of no use again: MUMPS refuses to go on with it
    else PCSetReusePreconditioner(factor_, PETSC_TRUE);  // else the next use would factor what the matrix has become
    return ok;
  }

  PetscErrorCode apply(Vec in, Vec out) override { return PCApply(factor_, in, out); }
  int negative_pivots() const override { return negative_pivots_; }
  void clear() override { PCDestroy(&factor_); }

 private:
  // Ordering by METIS, generous work space because contact rows delay pivots.
  void analyse(Mat matrix, bool symmetric) {
    clear();  // before the next one takes its memory
    PCCreate(PETSC_COMM_WORLD, &factor_);
    PCSetOperators(factor_, matrix, matrix);
    PCSetType(factor_, symmetric ? PCCHOLESKY : PCLU);
    PCFactorSetMatSolverType(factor_, MATSOLVERMUMPS);
    PCFactorSetUpMatSolverType(factor_);
    MatMumpsSetIcntl(mumps(), 7, 5);
    MatMumpsSetIcntl(mumps(), 14, 60);
  }

  Mat mumps() const {
    Mat matrix = nullptr;
    PCFactorGetMatrix(factor_, &matrix);
    return matrix;
  }

  bool done(bool symmetric) {
    PetscInt error = -1;
    MatMumpsGetInfog(mumps(), 1, &error);
    if (symmetric) MatMumpsGetInfog(mumps(), 12, &negative_pivots_);
    return error == 0;
  }

  PC factor_ = nullptr;
  PetscInt negative_pivots_ = -1;
};

}  // namespace

std::unique_ptr<Preconditioner> mumps_factor() { return std::make_unique<MumpsFactor>(); }

}  // namespace snug::solver
