// Numbering, scatter and the linear solver.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "solver/algebra/linear_solver.hpp"
#include "tests/unit/solver/terms.hpp"

namespace snug::tests {
namespace {

using solver::ElementEntries, solver::LinearSolver, solver::Numbering, solver::SparseScatter;

TEST(Numbering, PrescribedEntriesHaveNoUnknownAndSewnEntriesShareOne) {
  const Numbering numbering({0, -1, 5, 0, 4, 5, 4});
  const std::vector<int> expected = {0, -1, 2, 0, 1, 2, 1};
  EXPECT_EQ(numbering.unknowns(), 3);
  EXPECT_EQ(numbering.entries(), 7);
  for (int i = 0; i < 7; ++i) EXPECT_EQ(numbering.unknown(i), expected[i]) << i;
}

Eigen::MatrixXd dense(const SparseScatter& scatter, int columns) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(scatter.rows(), columns);
  for (int row = 0; row < scatter.rows(); ++row)
    for (int k = scatter.row_offsets()[row]; k < scatter.row_offsets()[row + 1]; ++k)
      matrix(row, scatter.columns()[k]) += scatter.values()[k];
  return matrix;
}

/// Random elements assembled by the scatter of rows [first, end) and densely.
void expect_as_dense(const Numbering& numbering, const std::vector<const ElementEntries*>& groups, int first, int end) {
  const int unknowns = numbering.unknowns();
  SparseScatter scatter;
  scatter.build(numbering, groups, first, end);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd residual = Eigen::VectorXd::Zero(unknowns), condensed = residual;
  for (int g = 0; g < static_cast<int>(groups.size()); ++g)
    for (int e = 0; e < groups[g]->elements(); ++e) {
      const auto entries = groups[g]->of(e);
      const std::size_t n = entries.size();
      const Eigen::VectorXd r = random_vector(n, 1.0, 10 * g + e), m = random_vector(n * n, 1.0, 100 + 10 * g + e);
      scatter.add(g, e, {r.data(), n}, {m.data(), n * n});
      scatter.add_condensed(g, e, {m.data(), n});
      for (std::size_t i = 0; i < n; ++i) {
        const int row = numbering.unknown(entries[i]);
        if (row >= 0) residual[row] += r[i], condensed[row] += m[i];
        for (std::size_t j = 0; j < n; ++j)
          if (const int column = numbering.unknown(entries[j]); row >= 0 && column >= 0)
            matrix(row, column) += m[i * n + j];
      }
    }
  const auto ours = [&](const auto& all) { return all.middleRows(first, end - first); };
  EXPECT_LE((dense(scatter, unknowns) - ours(matrix)).norm(), 1e-14);
  EXPECT_LE((scatter.residual() - ours(residual)).norm(), 1e-14);
  EXPECT_LE((scatter.condensed() - ours(condensed)).norm(), 1e-14);
  const Eigen::VectorXd factor = random_vector(unknowns, 1.0, 8);
  Eigen::VectorXd product = Eigen::VectorXd::Zero(end - first);
  solver::multiply(scatter.own_rows(), factor.data(), product.data());
  EXPECT_LE((product - ours(matrix) * factor).norm(), 1e-14);
  const Eigen::VectorXd diagonal = random_vector(end - first, 1.0, 7);
  scatter.add_diagonal(diagonal);
  for (int row = first; row < end; ++row) matrix(row, row) += diagonal[row - first];
  EXPECT_LE((dense(scatter, unknowns) - ours(matrix)).norm(), 1e-14);
  scatter.zero();
  EXPECT_EQ(dense(scatter, unknowns).norm() + scatter.residual().norm(), 0.0);
}

TEST(SparseScatter, EqualsDenseAssemblyWithSewnAndPrescribedEntries) {
  const Numbering numbering({0, -1, 2, 0, 4, 5, 4, 7, 2});  // element 0 of group 0 holds both sides of a seam
  ElementEntries first, second;
  first.push(std::vector<int>{0, 1, 3, 4}), first.push(std::vector<int>{5, 2, 7});
  second.push(std::vector<int>{8, 6}), second.push(std::vector<int>{1, 1}), second.push(std::vector<int>{7, 0, 5});
  expect_as_dense(numbering, {&first, &second}, 0, numbering.unknowns());
}

TEST(SparseScatter, UnknownsSideBySideNeedNotBeCoupledAlike) {
  // Three nodes of three components: an element of two nodes, one of a single component in the middle of a node, one that names
  // components backwards and across nodes, and a node whose middle component is prescribed. The same for a part of the rows.
  ElementEntries first, second;
  first.push(std::vector<int>{0, 1, 2, 3, 4, 5}), first.push(std::vector<int>{6, 7, 8});
  second.push(std::vector<int>{4}), second.push(std::vector<int>{8, 7, 6}), second.push(std::vector<int>{2, 3, 7}), second.push(std::vector<int>{5, 6});
  const Numbering all({0, 1, 2, 3, 4, 5, 6, 7, 8}), without({0, 1, 2, 3, -1, 5, 6, 7, 8});
  for (const Numbering* numbering : {&all, &without})
    for (const auto& [begin, end] : {std::pair{0, numbering->unknowns()}, {0, 4}, {2, 7}, {4, numbering->unknowns()}})
      expect_as_dense(*numbering, {&first, &second}, begin, end);
}

constexpr int positions = 40, multipliers = 6;

/// [K, -G^T; -G, -eps] with K positive definite: what contact with multipliers leads to.
Eigen::MatrixXd quasi_definite(unsigned seed) {
  constexpr int n = positions + multipliers;
  const Eigen::VectorXd values = random_vector(n * n, 1.0, seed);
  const Eigen::MatrixXd R = Eigen::Map<const Eigen::MatrixXd>(values.data(), n, n);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  A.topLeftCorner(positions, positions) =
      R.topLeftCorner(positions, positions) * R.topLeftCorner(positions, positions).transpose();
  A.diagonal().head(positions).array() += 1.0;
  A.bottomLeftCorner(multipliers, positions) = -R.bottomLeftCorner(multipliers, positions);
  A.topRightCorner(positions, multipliers) = -R.bottomLeftCorner(multipliers, positions).transpose();
  A.diagonal().tail(multipliers).setConstant(-1e-6);
  return A;
}

/// A scatter of one dense element.
class OneElement {
 public:
  explicit OneElement(int n) : size_(n) {
    std::vector<int> all(n);
    for (int i = 0; i < n; ++i) all[i] = i;
    entries_.push(all);
    scatter_.build(Numbering(all), {&entries_}, 0, n);
  }
  SparseScatter& operator()(const Eigen::MatrixXd& matrix) {
    const auto n = static_cast<std::size_t>(size_);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(size_);
    scatter_.zero();
    scatter_.add(0, 0, {zero.data(), n}, {matrix.data(), n * n});  // symmetric: either order of storage
    return scatter_;
  }

 private:
  int size_;
  ElementEntries entries_;
  SparseScatter scatter_;
};

const solver::Lag lag{.allowed = true, .tolerance = 1e-10};

struct LinearSystem : testing::Test {
  static constexpr int n = positions + multipliers;
  OneElement element{n};
  LinearSolver solver;
  Eigen::VectorXd right = random_vector(n, 1.0, 9), x;

  void SetUp() override { solver.reset(element(quasi_definite(5)), n); }
  double error(const Eigen::MatrixXd& matrix) const { return (matrix * x - right).norm() / right.norm(); }
};

TEST_F(LinearSystem, AQuasiDefiniteMatrixIsSolvedAndHasOneNegativePivotAMultiplier) {
  const Eigen::MatrixXd A = quasi_definite(5);
  const auto report = solver.solve(element(A), right, x);
  EXPECT_TRUE(report.ok);
  EXPECT_TRUE(report.refactored);
  EXPECT_EQ(report.negative_pivots, multipliers);
  EXPECT_LE(error(A), 1e-10);
}

TEST_F(LinearSystem, ALaggedFactorSolvesAMatrixNearby) {
  Eigen::MatrixXd A = quasi_definite(5);
  ASSERT_TRUE(solver.solve(element(A), right, x).ok);
  A.diagonal().head(positions) *= 1.01;
  const auto report = solver.solve(element(A), right, x, lag);
  EXPECT_TRUE(report.ok);
  EXPECT_FALSE(report.refactored);
  EXPECT_LE(report.iterations, 12);
  EXPECT_LE(error(A), 1e-8);
}

/// A part that is in no factor is solved for all the same: forces that follow the multipliers, half as large as those by which these hold.
TEST_F(LinearSystem, APartOnOneSideIsSolvedForWithTheFactorOfTheRest) {
  const Eigen::MatrixXd A = quasi_definite(5);
  Eigen::MatrixXd part = Eigen::MatrixXd::Zero(n, n);
  part.topRightCorner(positions, multipliers) = 0.5 * quasi_definite(8).topRightCorner(positions, multipliers);
  const solver::OneWay one_way = [&](const Eigen::VectorXd& y, Eigen::VectorXd& sum) { sum += part * y; };
  const auto report = solver.solve(element(A), right, x, {.tolerance = 1e-10}, one_way);
  EXPECT_TRUE(report.ok);
  EXPECT_EQ(report.negative_pivots, multipliers);
  EXPECT_GE(report.iterations, 2);
  EXPECT_LE(error(A + part), 1e-8);
  EXPECT_GE(error(A), 1e-2);
  ASSERT_TRUE(solver.solve(element(A), right, x).ok);  // the next solve is without it
  EXPECT_LE(error(A), 1e-10);
}

/// A part with which FGMRES finds nothing (here: no numbers) is left out: what is found without it comes back.
TEST_F(LinearSystem, APartThatCannotBeSolvedForIsLeftOut) {
  const Eigen::MatrixXd A = quasi_definite(5);
  const solver::OneWay no_numbers = [&](const Eigen::VectorXd&, Eigen::VectorXd& sum) { sum.setConstant(std::nan("")); };
  const auto report = solver.solve(element(A), right, x, {.tolerance = 1e-10}, no_numbers);
  EXPECT_TRUE(report.ok);
  EXPECT_LE(error(A), 1e-8);
}

// A lagged factor gives way to a fresh one where it does not help, and that is seen after four iterations.
TEST_F(LinearSystem, ALaggedFactorGivesWayToAFreshOneWhereItDoesNotHelp) {
  ASSERT_TRUE(solver.solve(element(quasi_definite(5)), right, x).ok);
  const Eigen::MatrixXd other = quasi_definite(77);
  const auto report = solver.solve(element(other), right, x, lag);
  EXPECT_TRUE(report.ok);
  EXPECT_TRUE(report.refactored);
  EXPECT_LE(report.iterations, 6);
  EXPECT_LE(error(other), 1e-10);
}

// Where the iterations end short of the tolerance, an answer that is a thousand times better than none is taken: the next step
// of Newton's method makes up for the rest.
TEST_F(LinearSystem, ALaggedFactorMayEndShortOfItsTolerance) {
  Eigen::MatrixXd A = quasi_definite(5);
  ASSERT_TRUE(solver.solve(element(A), right, x).ok);
  A.diagonal().head(positions).array() *= 1.0 + 0.1 * random_vector(positions, 1.0, 8).array().abs();
  const auto report = solver.solve(element(A), right, x, {.allowed = true, .tolerance = 1e-12});
  EXPECT_TRUE(report.ok);
  EXPECT_FALSE(report.refactored);
  EXPECT_EQ(report.iterations, 10);
  EXPECT_LE(error(A), 1e-2);
  EXPECT_GT(error(A), 1e-10);
}

TEST_F(LinearSystem, AFactorOfAnEarlierPatternPreconditionsTheNext) {
  ASSERT_TRUE(solver.solve(element(quasi_definite(5)), right, x).ok);
  Eigen::MatrixXd A = quasi_definite(5);
  A.diagonal().head(positions) *= 1.01;
  solver.reset(element(A), n);
  const auto report = solver.solve(element(A), right, x, lag);
  EXPECT_TRUE(report.ok);
  EXPECT_FALSE(report.refactored);
  EXPECT_LE(error(A), 1e-8);
}

TEST_F(LinearSystem, RowsOfOtherUnitsDoNotHideBehindLargeOnes) {
  Eigen::MatrixXd A = quasi_definite(5);
  Eigen::VectorXd units = Eigen::VectorXd::Ones(n);
  units.tail(multipliers).setConstant(1e-6);  // gaps in m3 beside forces in N
  const Eigen::MatrixXd scaled = units.asDiagonal() * A * units.asDiagonal();
  const Eigen::VectorXd scaled_right = units.cwiseProduct(right);
  ASSERT_TRUE(solver.solve(element(scaled), scaled_right, x).ok);
  A.diagonal().head(positions) *= 1.01;
  const auto report = solver.solve(element(units.asDiagonal() * A * units.asDiagonal()), scaled_right, x, lag);
  ASSERT_TRUE(report.ok);
  EXPECT_FALSE(report.refactored);
  const Eigen::VectorXd y = units.cwiseProduct(x);  // D A D x = D b  <=>  A (D x) = b
  EXPECT_LE((A * y - right).tail(multipliers).norm(), 1e-7 * right.norm());
}

/// A skew part beside a symmetric matrix: `size` times the norm of its positions' block.
Eigen::MatrixXd with_skew_part(double size) {
  Eigen::MatrixXd A = quasi_definite(5);
  const Eigen::VectorXd values = random_vector(positions * positions, 1.0, 31);
  const Eigen::MatrixXd R = Eigen::Map<const Eigen::MatrixXd>(values.data(), positions, positions);
  const Eigen::MatrixXd skew = R - R.transpose();
  A.topLeftCorner(positions, positions) += size * A.topLeftCorner(positions, positions).norm() / skew.norm() * skew;
  return A;
}

// An unsymmetric matrix is solved exactly with the factor of its symmetric part, and its pivots say nothing of an energy;
// where the skew part outweighs the symmetric one, the whole is factored.
TEST_F(LinearSystem, AnUnsymmetricMatrixIsSolvedWhateverItsSkewPart) {
  for (const double size : {0.02, 100.0}) {
    const Eigen::MatrixXd A = with_skew_part(size);
    solver.reset(element(A.transpose()), n, false);  // the element is stored by rows
    const auto report = solver.solve(element(A.transpose()), right, x);
    EXPECT_TRUE(report.ok);
    EXPECT_EQ(report.negative_pivots, -1);
    EXPECT_LE(error(A), 1e-9);
    EXPECT_GT(report.iterations, 2);
    const auto again = solver.solve(element(1.001 * A.transpose()), right, x, lag);
    EXPECT_FALSE(again.refactored);
    EXPECT_LE(again.iterations, report.iterations);
    if (size > 1.0) EXPECT_LE(again.iterations, 4);  // LU stays in use
  }
}

// An entry that follows others of its element is eliminated as C^T K C and C^T r; what acts on it and what it does are the
// transpose of each other, on entries that are prescribed too.
TEST(SparseScatter, BoundEntriesAreEliminatedAndTheMatrixStaysSymmetric) {
  // entry 2 = 0.3 of entry 0 and -0.8 of entry 1; entry 5 = 0.5 of entry 3, whose neighbour 4 is prescribed
  const Numbering numbering({0, 1, -1, 3, -1, -1, 6}, {}, 1, {{2, {{0, 0.3}, {1, -0.8}}}, {5, {{3, 0.5}}}});
  ASSERT_EQ(numbering.unknowns(), 4);
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(7, 4);
  C(0, 0) = C(1, 1) = C(3, 2) = C(6, 3) = 1.0, C(2, 0) = 0.3, C(2, 1) = -0.8, C(5, 2) = 0.5;
  ElementEntries elements;
  elements.push(std::vector<int>{0, 1, 2, 3, 4, 5}), elements.push(std::vector<int>{6, 5, 3, 4}), elements.push(std::vector<int>{6, 6});
  SparseScatter scatter;
  scatter.build(numbering, {&elements}, 0, numbering.unknowns());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(7, 7);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(7);
  for (int e = 0; e < elements.elements(); ++e) {
    const auto entries = elements.of(e);
    const std::size_t n = entries.size();
    Eigen::MatrixXd m = random_vector(n * n, 1.0, 100 + e).reshaped(n, n);
    m = (m + m.transpose()).eval();
    const Eigen::VectorXd r = random_vector(n, 1.0, e);
    scatter.add(0, e, {r.data(), n}, {m.data(), n * n});
    scatter.add_condensed(0, static_cast<int>(e), {r.data(), n});
    for (std::size_t i = 0; i < n; ++i) {
      f[entries[i]] += r[i];
      for (std::size_t j = 0; j < n; ++j) K(entries[i], entries[j]) += m(i, j);
    }
  }
  EXPECT_LE((dense(scatter, scatter.rows()) - C.transpose() * K * C).norm(), 1e-14 * K.norm());
  EXPECT_LE((dense(scatter, scatter.rows()) - dense(scatter, scatter.rows()).transpose()).norm(), 1e-15 * K.norm());
  EXPECT_LE((scatter.residual() - C.transpose() * f).norm(), 1e-14 * f.norm());
  EXPECT_LE((scatter.condensed() - C.transpose() * f).norm(), 1e-14 * f.norm());  // what cells eliminate acts on the same entries
  Eigen::VectorXd step = C * random_vector(4, 1.0, 3), told = step, folded = f;
  told[2] = 0.0, told[5] = 7.0;  // 7 that it goes by itself
  numbering.spread(told);
  step[5] += 7.0;
  EXPECT_LE((told - step).norm(), 1e-14);
  step[5] -= 7.0;
  numbering.fold(folded);
  EXPECT_EQ(folded[2], 0.0);
  EXPECT_NEAR(folded.dot(step), f.dot(step), 1e-14);  // the same work
}

TEST(Numbering, EachRankOwnsAContiguousRangeAndSewnEntriesFollowTheirMaster) {
  const Numbering numbering({0, -1, 5, 0, 4, 5, 4}, {1, 0, 0, 0, 0, 1, 1}, 3);
  const std::vector<int> expected = {1, -1, 2, 1, 0, 2, 0};
  for (int i = 0; i < 7; ++i) EXPECT_EQ(numbering.unknown(i), expected[i]) << i;
  EXPECT_EQ(numbering.owned(0), std::pair(0, 1));
  EXPECT_EQ(numbering.owned(1), std::pair(1, 3));
  EXPECT_EQ(numbering.owned(2), std::pair(3, 3));
}

TEST_F(LinearSystem, ASingularMatrixIsReportedAndDoesNotThrow) {
  Eigen::MatrixXd A = quasi_definite(5);
  A.row(3).setZero(), A.col(3).setZero();
  const auto report = solver.solve(element(A), right, x);
  EXPECT_FALSE(report.ok);
}

TEST_F(LinearSystem, AFactorisationThatFailedDoesNotSpoilTheNext) {
  Eigen::MatrixXd A = quasi_definite(5);
  A.row(3).setZero(), A.col(3).setZero();
  EXPECT_FALSE(solver.solve(element(A), right, x).ok);
  const Eigen::MatrixXd B = quasi_definite(6);
  EXPECT_TRUE(solver.solve(element(B), right, x).ok);
  EXPECT_LE((B * x - right).norm(), 1e-9 * right.norm());
}

}  // namespace
}  // namespace snug::tests
