// The order of elimination, factors in both precisions, and when a lagged one gives way.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <petscvec.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <random>
#include <set>
#include <unistd.h>
#include <vector>

#include "solver/algebra/elimination_order.hpp"
#include "solver/algebra/linear_solver.hpp"
#include "solver/algebra/preconditioner.hpp"
#include "tests/unit/solver/terms.hpp"

namespace snug::tests {
namespace {

using solver::FactorKind;

/// Compressed rows of a symmetric pattern.
struct Rows {
  std::vector<int> offsets = {0}, columns;
  solver::RowPattern pattern() const {
    const int n = static_cast<int>(offsets.size()) - 1;
    return {0, n, n, offsets.data(), columns.data()};
  }
};

/// side x side nodes with three unknowns each, a node coupled with its eight neighbours. `shuffled`: numbered by lot.
Rows grid(int side, bool shuffled) {
  std::vector<int> number(side * side), at(side * side);
  std::iota(number.begin(), number.end(), 0);
  if (shuffled) std::shuffle(number.begin(), number.end(), std::mt19937(3));
  for (int node = 0; node < side * side; ++node) at[number[node]] = node;
  Rows rows;
  for (int place = 0; place < side * side; ++place) {
    const int i = at[place] % side, j = at[place] / side;
    std::set<int> neighbours;
    for (int di = -1; di <= 1; ++di)
      for (int dj = -1; dj <= 1; ++dj)
        if (i + di >= 0 && i + di < side && j + dj >= 0 && j + dj < side) neighbours.insert(number[(j + dj) * side + i + di]);
    for (int c = 0; c < 3; ++c) {
      for (const int k : neighbours)
        for (int d = 0; d < 3; ++d) rows.columns.push_back(3 * k + d);
      rows.offsets.push_back(static_cast<int>(rows.columns.size()));
    }
  }
  return rows;
}

/// Entries below the diagonal of the Cholesky factor when unknowns are eliminated by their place.
long factor_entries(const Rows& rows, const std::vector<int>& place) {
  const int n = static_cast<int>(place.size());
  std::vector<std::set<int>> later(n);  // by place
  for (int u = 0; u < n; ++u)
    for (const int v : rows.pattern().row(u))
      if (place[v] > place[u]) later[place[u] - 1].insert(place[v] - 1);
  long entries = 0;
  for (int p = 0; p < n; ++p) {
    entries += static_cast<long>(later[p].size());
    if (later[p].empty()) continue;
    const int parent = *later[p].begin();
    later[parent].insert(std::next(later[p].begin()), later[p].end());
  }
  return entries;
}

// The order is a permutation that keeps the unknowns of a node together and fills the factor far less than the order by
// rows of the grid, however the nodes are numbered.
TEST(EliminationOrder, FillsLessThanTheOrderAlongTheGrid) {
  constexpr int side = 48;
  const Rows along = grid(side, false);
  std::vector<int> natural(along.pattern().count);
  std::iota(natural.begin(), natural.end(), 1);
  const long banded = factor_entries(along, natural);
  for (const bool shuffled : {false, true}) {
    const Rows rows = grid(side, shuffled);
    const std::vector<int> place = solver::nested_dissection(rows.pattern()), starts = solver::vertex_starts(rows.pattern());
    ASSERT_EQ(starts.size(), natural.size() / 3 + 1);
    for (std::size_t v = 0; v < starts.size(); ++v) EXPECT_EQ(starts[v], static_cast<int>(3 * v));
    ASSERT_EQ(place.size(), natural.size());
    std::vector<int> sorted = place;
    std::ranges::sort(sorted);
    EXPECT_EQ(sorted, natural);
    for (std::size_t u = 0; u < place.size(); u += 3) {
      EXPECT_EQ(place[u + 1], place[u] + 1) << u;
      EXPECT_EQ(place[u + 2], place[u] + 2) << u;
    }
    EXPECT_LT(factor_entries(rows, place), 0.55 * banded) << shuffled;
  }
}

// Graphs of one vertex and of vertices without any neighbour are ordered, too.
TEST(EliminationOrder, TakesWhatHasNoEdges) {
  Rows full, diagonal;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) full.columns.push_back(j);
    full.offsets.push_back(static_cast<int>(full.columns.size()));
    diagonal.columns.push_back(i);
    diagonal.offsets.push_back(i + 1);
  }
  for (const Rows& rows : {full, diagonal}) {
    std::vector<int> place = solver::nested_dissection(rows.pattern());
    std::ranges::sort(place);
    EXPECT_EQ(place, (std::vector<int>{1, 2, 3, 4}));
  }
}

/// A chain of nodes under springs of `stiff` and soft ones between, three components each, and constraints that bind
/// neighbours to one another: [K, G^T; G, 0].
struct Saddle {
  Eigen::MatrixXd matrix;
  int constraints = 0;
};
Saddle chain(double stiff) {
  constexpr int nodes = 80, bound = 25;
  Saddle s;
  s.constraints = bound;
  s.matrix = Eigen::MatrixXd::Zero(3 * nodes + bound, 3 * nodes + bound);
  for (int i = 0; i < nodes; ++i)
    for (int c = 0; c < 3; ++c) {
      const int u = 3 * i + c;
      const double k = i % 4 == 0 ? stiff : 1.0;
      s.matrix(u, u) += 0.1 + k;
      if (i + 1 == nodes) continue;
      s.matrix(u + 3, u + 3) += k, s.matrix(u, u + 3) -= k, s.matrix(u + 3, u) -= k;
    }
  for (int g = 0; g < bound; ++g) {
    const int row = 3 * nodes + g, node = 3 * g + 1;
    for (int c = 0; c < 3; ++c) s.matrix(row, 3 * node + c) = s.matrix(3 * node + c, row) = 0.3 + 0.2 * c;
    s.matrix(row, 3 * node + 3) = s.matrix(3 * node + 3, row) = -1.0;
  }
  return s;
}

/// |A x - b| / |b| of one application of a factor made anew of A, and the negative pivots that it has counted.
std::pair<double, int> applied(solver::Preconditioner& factor, const Eigen::MatrixXd& A, solver::Operand operand) {
  const auto n = static_cast<int>(A.rows());
  Rows rows;
  std::vector<double> of_matrix;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j)
      if (A(i, j) != 0.0 || A(j, i) != 0.0 || i == j) rows.columns.push_back(j), of_matrix.push_back(A(i, j));
    rows.offsets.push_back(static_cast<int>(rows.columns.size()));
  }
  EXPECT_TRUE(factor.renew({rows.pattern(), of_matrix.data(), nullptr}, operand, true));
  Vec in = nullptr, out = nullptr;
  VecCreateMPI(PETSC_COMM_WORLD, n, n, &in);
  VecDuplicate(in, &out);
  const Eigen::VectorXd b = random_vector(n, 1.0, 4);
  PetscScalar* values = nullptr;
  VecGetArray(in, &values);
  std::copy(b.begin(), b.end(), values);
  VecRestoreArray(in, &values);
  EXPECT_EQ(factor.apply(in, out), 0);
  VecGetArray(out, &values);
  const Eigen::VectorXd x = Eigen::Map<Eigen::VectorXd>(values, n);
  VecRestoreArray(out, &values);
  const int negative = factor.negative_pivots();
  VecDestroy(&in), VecDestroy(&out);
  const Eigen::MatrixXd inverted = operand == solver::Operand::symmetric_part ? Eigen::MatrixXd(0.5 * (A + A.transpose())) : A;
  return {(inverted * x - b).norm() / b.norm(), negative};
}

std::pair<double, int> applied(FactorKind kind, const Eigen::MatrixXd& A, solver::Operand operand = solver::Operand::symmetric) {
  const auto factor = solver::mumps_factor(kind);
  return applied(*factor, A, operand);
}

/// Nodes of three components in a ring, each coupled with the next and with the one `far` ahead.
Eigen::MatrixXd ring(int nodes, int far) {
  Eigen::MatrixXd A = 20.0 * Eigen::MatrixXd::Identity(3 * nodes, 3 * nodes);
  for (int node = 0; node < nodes; ++node)
    for (const int other : {(node + 1) % nodes, (node + far) % nodes})
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) A(3 * node + i, 3 * other + j) = A(3 * other + j, 3 * node + i) = 1.0 + 0.3 * i - 0.5 * j;
  return A;
}

// One factor, made anew of other patterns over the same nodes and then over others, inverts each of them to round-off: an order of
// elimination that is kept fits them all, and one that does not is not kept.
TEST(Factor, GoesOnWithOtherPatterns) {
  const auto factor = solver::mumps_factor(FactorKind::double_precision);
  for (const auto& [nodes, far] : {std::pair{60, 2}, {60, 17}, {60, 29}, {45, 11}, {60, 5}}) {
    const auto [error, negative] = applied(*factor, ring(nodes, far), solver::Operand::symmetric);
    EXPECT_LT(error, 1e-12) << nodes << " nodes, " << far;
    EXPECT_GE(negative, 0);
  }
}

// Of a matrix that is not symmetric the symmetric part is inverted where that is asked for, and all of it where that is, both to
// round-off; neither has a count of negative pivots that Newton's method may go by.
TEST(Factor, InvertsThePartOfTheMatrixThatIsAskedFor) {
  constexpr int n = 40;
  const Eigen::VectorXd values = random_vector(n * n, 1.0, 11);
  const Eigen::MatrixXd A = Eigen::Map<const Eigen::MatrixXd>(values.data(), n, n) + 12.0 * Eigen::MatrixXd::Identity(n, n);
  ASSERT_GT((A - A.transpose()).norm(), 10.0);
  for (const auto operand : {solver::Operand::symmetric_part, solver::Operand::whole}) {
    const auto [error, negative] = applied(FactorKind::double_precision, A, operand);
    EXPECT_LT(error, 1e-13);
    EXPECT_EQ(negative, -1);
  }
}

// A factor in single precision solves to single precision, one in double precision to double; both count one negative pivot a
// constraint, whose rows have no stiffness of their own, also where soft and stiff lie side by side.
TEST(Factor, EitherPrecisionCountsTheNegativePivotsOfASaddle) {
  for (const double stiff : {1.0, 1e3}) {
    const Saddle saddle = chain(stiff);
    const auto exact = applied(FactorKind::double_precision, saddle.matrix), single = applied(FactorKind::single_precision, saddle.matrix);
    EXPECT_LT(exact.first, 1e-11) << stiff;
    EXPECT_LT(single.first, 1e-2) << stiff;
    EXPECT_GT(single.first, 1e-9) << stiff;
    EXPECT_EQ(exact.second, saddle.constraints) << stiff;
    EXPECT_EQ(single.second, saddle.constraints) << stiff;
    EXPECT_EQ(applied(FactorKind::low_rank, saddle.matrix).second, saddle.constraints) << stiff;
  }
}

/// Files of MUMPS in the folder for temporary ones, and their size.
std::pair<int, double> factors_on_disk() {
  std::pair<int, double> found = {0, 0.0};
  for (const auto& file : std::filesystem::directory_iterator(std::filesystem::temp_directory_path()))
    if (file.path().filename().string().starts_with("mumps_")) ++found.first, found.second += static_cast<double>(file.file_size());
  return found;
}

// A factor that may not be in memory is written to disk and inverts the same matrix, of any precision; its files go with it, and when it is made
// anew.
TEST(Factor, ThatDoesNotFitIsWrittenToDiskAndItsFilesGoWithIt) {
  const std::filesystem::path own = std::filesystem::temp_directory_path() / fmt::format("snug-factor-{}", ::getpid());
  std::filesystem::create_directory(own);
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  ::setenv("TMPDIR", own.c_str(), 1);
  for (const FactorKind kind : {FactorKind::double_precision, FactorKind::single_precision, FactorKind::low_rank}) {
    auto factor = solver::mumps_factor(kind, 1.0);
    for (const int far : {17, 29}) {
      const auto [error, negative] = applied(*factor, ring(200, far), solver::Operand::symmetric);
      EXPECT_LT(error, kind == FactorKind::double_precision ? 1e-12 : 1e-4);
      EXPECT_EQ(negative, 0);
      EXPECT_TRUE(factor->description().ends_with(", written to disk")) << factor->description();
      const auto [files, bytes] = factors_on_disk();
      EXPECT_GT(files, 0);
      EXPECT_GT(bytes, 200 * (6 + 2 * 9) * sizeof(float));  // what the matrix itself has: three unknowns a node, two neighbours
    }
    factor.reset();
    EXPECT_EQ(factors_on_disk().first, 0);
  }
  auto fits = solver::mumps_factor(FactorKind::single_precision, 64e9);
  applied(*fits, ring(200, 17), solver::Operand::symmetric);
  EXPECT_EQ(factors_on_disk().first, 0);
  EXPECT_EQ(fits->description().find("disk"), std::string::npos);
  if (before) ::setenv("TMPDIR", kept.c_str(), 1);
  else ::unsetenv("TMPDIR");
  std::filesystem::remove_all(own);
}

/// Blocks of ten nodes held together by springs of `stiff`, each on a spring of 1 to the ground and one to the next block.
solver::LinearReport solve_blocks(double stiff, double& error, const solver::Lag& lag = {}) {
  constexpr int nodes = solver::single_precision_from, block = 10;
  solver::ElementEntries springs;
  std::vector<double> stiffness;
  const auto add = [&](std::vector<int> ends, double k) { springs.push(ends), stiffness.push_back(k); };
  for (int i = 0; i < nodes; ++i) {
    if (i % block == 0) add({i}, 1.0);
    if (i + 1 < nodes) add({i, i + 1}, (i + 1) % block == 0 ? 1.0 : stiff);
  }
  std::vector<int> all(nodes);
  std::iota(all.begin(), all.end(), 0);
  solver::SparseScatter scatter;
  scatter.build(solver::Numbering(all), {&springs}, 0, nodes);
  const Eigen::VectorXd u = random_vector(nodes, 1.0, 2);  // the answer
  Eigen::VectorXd right = Eigen::VectorXd::Zero(nodes), x;
  const auto assemble = [&] {
    scatter.zero();
    const std::vector<double> none(2, 0.0);
    for (int e = 0; e < springs.elements(); ++e) {
      const double k = stiffness[e];
      const std::vector<double> matrix = springs.of(e).size() == 1 ? std::vector<double>{k} : std::vector<double>{k, -k, -k, k};
      scatter.add(0, e, {none.data(), springs.of(e).size()}, matrix);
    }
  };
  for (int e = 0; e < springs.elements(); ++e) {
    const auto ends = springs.of(e);
    const double force = stiffness[e] * (ends.size() == 1 ? u[ends[0]] : u[ends[0]] - u[ends[1]]);
    right[ends[0]] += force;
    if (ends.size() == 2) right[ends[1]] -= force;
  }
  solver::LinearSolver linear;
  assemble();
  linear.reset(scatter, nodes);
  const solver::LinearReport report = linear.solve(scatter, right, x, lag);
  error = (x - u).norm() / u.norm();
  return report;
}

// A large system is factored in single precision, and FGMRES makes its answer as good as one in double; where stiffnesses lie
// so far apart that it cannot, and where its pivots are to decide, it is made in double.
TEST(Factor, InSinglePrecisionGivesWayToOneInDoubleWhereItDoesNotDo) {
  double error = 0.0;
  solver::LinearReport report = solve_blocks(1e2, error);
  EXPECT_TRUE(report.ok);
  EXPECT_NE(report.factor.find("METIS, single precision"), std::string::npos) << report.factor;
  EXPECT_TRUE(report.single_precision);
  EXPECT_LT(error, 1e-9);
  report = solve_blocks(1e9, error);
  EXPECT_TRUE(report.ok);
  EXPECT_NE(report.factor.find("METIS, double precision"), std::string::npos) << report.factor;
  EXPECT_LT(error, 1e-5);
  report = solve_blocks(1e2, error, {.precise = true});
  EXPECT_TRUE(report.ok);
  EXPECT_FALSE(report.single_precision);
  EXPECT_EQ(report.negative_pivots, 0);
}

}  // namespace
}  // namespace snug::tests
