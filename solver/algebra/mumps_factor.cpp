#include <dmumps_c.h>
#include <malloc.h>
#include <petscksp.h>
#include <smumps_c.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/algebra/blas_threads.hpp"
#include "solver/algebra/communicator.hpp"
#include "solver/algebra/elimination_order.hpp"
#include "solver/algebra/memory.hpp"
#include "solver/algebra/preconditioner.hpp"

namespace snug::solver {

namespace {

// Rows that are not symmetric choose their pivots by the usual bound. A symmetric tissue is positive definite and its multipliers'
// rows have what they need in 2 x 2 pivots: with the usual 0.01 a body near to incompressible delays thousands of pivots that need
// no delay, and costs 60 % more work, with the same residual at the end.
constexpr double symmetric_threshold = 1e-6, usual_threshold = 0.01;
constexpr double compression = 1e-4;       // of blocks; at 1e-3 the count of negative pivots goes wrong
constexpr int workspace = 20;              // per cent above the estimate, doubled where that is too little
constexpr int most_workspace = 500;

/// Thousands of blocks that MUMPS has freed are not the system's before the heap is trimmed: at 300,000 unknowns 2 GB of 5.
void give_memory_back() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

/// MUMPS' two precisions under the same names.
struct DoublePrecision {
  using Real = double;
  using Instance = DMUMPS_STRUC_C;
  static void call(Instance& instance) { dmumps_c(&instance); }
};
struct SinglePrecision {
  using Real = float;
  using Instance = SMUMPS_STRUC_C;
  static void call(Instance& instance) { smumps_c(&instance); }
};

template <class Precision>
class MumpsFactor : public Preconditioner {
  using Real = typename Precision::Real;

 public:
  MumpsFactor(bool low_rank, double memory) : low_rank_(low_rank), memory_(memory) {}
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;
  ~MumpsFactor() override { clear(); }

  bool renew(const OwnRows& rows, Operand operand, bool fresh) override {
    negative_pivots_ = -1;
    if (fresh || !started_) start(operand != Operand::whole);
    const Triplets triplets = triplets_of(rows, operand);
    const bool ok = (analysed_ || analyse(rows.pattern)) && factor();
    hand_over({});  // the arrays end here
    if (!ok) clear();
    else if (operand == Operand::symmetric) negative_pivots_ = mumps_.infog[11];
    return ok;
  }

  PetscErrorCode apply(Vec in, Vec out) override {
    PetscInt size = 0;
    VecGetSize(in, &size);
    if (ranks() == 1) return apply_here(in, out, size);
    if (!to_first_) VecScatterCreateToZero(in, &to_first_, &on_first_);
    VecScatterBegin(to_first_, in, on_first_, INSERT_VALUES, SCATTER_FORWARD);
    VecScatterEnd(to_first_, in, on_first_, INSERT_VALUES, SCATTER_FORWARD);
    const PetscErrorCode status = apply_here(on_first_, on_first_, rank() == 0 ? size : 0);
    VecScatterBegin(to_first_, on_first_, out, INSERT_VALUES, SCATTER_REVERSE);
    VecScatterEnd(to_first_, on_first_, out, INSERT_VALUES, SCATTER_REVERSE);
    return status;
  }

  int negative_pivots() const override { return negative_pivots_; }

  std::string description() const override {
    if (!analysed_) return {};
    std::string text = ordered_ ? "ordered by METIS" : "ordered by minimum degree";
    text += std::is_same_v<Real, float> ? ", single precision" : ", double precision";
    if (low_rank_ && !on_disk_) text += ", block low-rank";
    return on_disk_ ? text + ", written to disk" : text;
  }

  void clear() override {
    VecScatterDestroy(&to_first_);
    VecDestroy(&on_first_);
    if (started_) run(-2);
    give_memory_back();
    started_ = analysed_ = on_disk_ = false;
    negative_pivots_ = -1;
  }

 private:
  /// The matrix, or its upper triangle where it is symmetric, as MUMPS takes it.
  struct Triplets {
    std::vector<int> rows, columns;
    std::vector<Real> values;
  };

  void run(int job) {
    mumps_.job = job;
    Precision::call(mumps_);
  }
  int& control(int number) { return mumps_.icntl[number - 1]; }

  void start(bool symmetric) {
    clear();  // before the next one takes its memory
    mumps_ = {};
    mumps_.comm_fortran = MPI_Comm_c2f(PETSC_COMM_WORLD);
    mumps_.par = 1;
    mumps_.sym = symmetric ? 2 : 0;
    run(-1);
    started_ = true;
    for (const int stream : {1, 2, 3}) control(stream) = -1;
    control(4) = 0;
    control(6) = 0;              // no permutation of columns, on which the order of elimination would not hold
    control(12) = 1;             // nor one of 2 x 2 pivots beforehand
    control(13) = 1;             // the root as all fronts: with ScaLAPACK its pivots are not counted
    control(14) = workspace;
    control(18) = ranks() == 1 ? 0 : 3;
    control(28) = 1;
    mumps_.cntl[0] = symmetric ? symmetric_threshold : usual_threshold;
    if (low_rank_) {
      control(35) = 2;
      mumps_.cntl[6] = compression;
    }
  }

  /// MUMPS adds up what it is given for a place, and takes (i, j) and (j, i) of a symmetric matrix for one: halves make the
  /// symmetric part.
  Triplets triplets_of(const OwnRows& rows, Operand operand) {
    Triplets t;
    const RowPattern& pattern = rows.pattern;
    const std::size_t all = pattern.offsets[pattern.count];
    const std::size_t expected = operand == Operand::symmetric ? (all + pattern.count) / 2 : all;
    t.rows.reserve(expected), t.columns.reserve(expected), t.values.reserve(expected);
    for (int i = 0; i < pattern.count; ++i)
      for (int k = pattern.offsets[i]; k < pattern.offsets[i + 1]; ++k) {
        const int row = pattern.first + i, column = pattern.columns[k];
        if (operand == Operand::symmetric && column < row) continue;
        const double share = operand == Operand::symmetric_part && column != row ? 0.5 : 1.0;
        t.rows.push_back(row + 1), t.columns.push_back(column + 1);
        t.values.push_back(static_cast<Real>(share * rows.values[k]));
      }
    mumps_.n = pattern.unknowns;
    hand_over(t);
    return t;
  }

  void hand_over(const Triplets& triplets) {
    const auto size = static_cast<MUMPS_INT8>(triplets.values.size());
    int* rows = const_cast<int*>(triplets.rows.data());
    int* columns = const_cast<int*>(triplets.columns.data());
    Real* values = const_cast<Real*>(triplets.values.data());
    if (ranks() == 1)
      mumps_.nnz = size, mumps_.irn = rows, mumps_.jcn = columns, mumps_.a = values;
    else
      mumps_.nnz_loc = size, mumps_.irn_loc = rows, mumps_.jcn_loc = columns, mumps_.a_loc = values;
  }

  /// An order serves as long as the vertices are the same: which nodes a contact couples changes little of the graph. MUMPS gets the
  /// vertices, too, and analyses the graph of these, which has a ninth of the matrix' entries.
  bool analyse(const RowPattern& pattern) {
    if (std::vector<int> starts = vertex_starts(pattern); starts != vertices_) {
      vertices_ = std::move(starts);
      place_ = nested_dissection(pattern);
    }
    std::vector<int> blocks = vertices_;
    for (int& start : blocks) ++start;
    control(7) = place_.empty() ? 0 : 1;
    control(15) = 1;
    mumps_.perm_in = place_.data();
    mumps_.nblk = static_cast<int>(blocks.size()) - 1, mumps_.blkptr = blocks.data();
    run(1);
    if (mumps_.infog[0] >= 0 && !fits()) {
      put_on_disk();
      run(1);
    }
    mumps_.perm_in = mumps_.blkptr = nullptr;
    ordered_ = mumps_.infog[6] == 1;  // what ran, not what was asked for
    analysed_ = mumps_.infog[0] >= 0;
    give_memory_back();
    return analysed_;
  }

  /// MUMPS' estimate for all ranks beside what they hold already, known to all of them alike.
  bool fits() const {
    if (memory_ <= 0.0) return true;
    const double megabytes = low_rank_ ? mumps_.infog[36] : mumps_.infog[16];
    return sum_over_ranks(resident_memory()) + 1e6 * megabytes <= memory_;
  }
  /// Blocks that go to disk are those of full rank.
  void put_on_disk() {
    on_disk_ = true;
    control(22) = 1;
    control(35) = 0;
    const std::string folder = std::filesystem::temp_directory_path().string();
    if (folder.size() >= sizeof mumps_.ooc_tmpdir) throw std::runtime_error(folder + ": the name is too long for the files of the factor; set TMPDIR to a shorter one");
    folder.copy(mumps_.ooc_tmpdir, folder.size());
  }

  bool factor() {
    const std::unique_ptr<OneBlasThread> alone = low_rank_ ? std::make_unique<OneBlasThread>() : nullptr;
    run(2);
    while (needs_workspace(mumps_.infog[0]) && control(14) < most_workspace) {
      control(14) *= 2;
      run(2);
    }
    if (on_disk_ && mumps_.infog[0] == not_written)
      throw std::runtime_error(std::filesystem::temp_directory_path().string() + ": the factor of the matrix cannot be written there; make room (df -h), or set TMPDIR to a folder on a larger disk");
    return mumps_.infog[0] >= 0;
  }
  static constexpr int not_written = -90;  // MUMPS' guide: an error of the files out of core
  static bool needs_workspace(int status) { return status == -8 || status == -9 || status == -14 || status == -15 || status == -17 || status == -20; }

  PetscErrorCode apply_here(Vec in, Vec out, PetscInt size) {
    const PetscScalar* given = nullptr;
    right_.resize(size);
    VecGetArrayRead(in, &given);
    for (PetscInt i = 0; i < size; ++i) right_[i] = static_cast<Real>(given[i]);
    VecRestoreArrayRead(in, &given);
    mumps_.nrhs = 1, mumps_.lrhs = static_cast<int>(size), mumps_.rhs = right_.data();
    run(3);
    PetscScalar* answer = nullptr;
    VecGetArray(out, &answer);
    for (PetscInt i = 0; i < size; ++i) answer[i] = right_[i];
    VecRestoreArray(out, &answer);
    return mumps_.infog[0] >= 0 ? 0 : PETSC_ERR_LIB;
  }

  bool low_rank_;
  double memory_;         ///< bytes, of the program on all ranks; 0: no bound
  bool started_ = false, analysed_ = false;
  bool on_disk_ = false;
  bool ordered_ = false;  ///< by METIS
  typename Precision::Instance mumps_ = {};
  std::vector<int> vertices_, place_;  ///< of the last order: where vertices start, and on the first rank the places of the unknowns
  std::vector<Real> right_;
  VecScatter to_first_ = nullptr;
  Vec on_first_ = nullptr;
  int negative_pivots_ = -1;
};

}  // namespace

std::unique_ptr<Preconditioner> mumps_factor(FactorKind kind, double memory) {
  if (kind == FactorKind::double_precision) return std::make_unique<MumpsFactor<DoublePrecision>>(false, memory);
  return std::make_unique<MumpsFactor<SinglePrecision>>(kind == FactorKind::low_rank, memory);
}

}  // namespace snug::solver
