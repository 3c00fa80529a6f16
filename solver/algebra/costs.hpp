// What the parts of a solution cost, summed over a scene's life.
#pragma once

#include <chrono>
#include <string>

namespace snug::solver {

struct Costs {
  double search = 0.0;         ///< s: contact search and active set
  double pattern = 0.0;        ///< s: sparsity pattern
  double assembly = 0.0;       ///< s: element kernels and scatter
  double factorisation = 0.0;  ///< s: analysis and factor
  double solution = 0.0;       ///< s: FGMRES with its applications of the factor
  int factorisations = 0, solutions = 0, iterations = 0;
  std::string factor;          ///< how the last one was made

  Costs& operator+=(const Costs& other) {
    search += other.search, pattern += other.pattern, assembly += other.assembly;
    factorisation += other.factorisation, solution += other.solution;
    factorisations += other.factorisations, solutions += other.solutions, iterations += other.iterations;
    if (!other.factor.empty()) factor = other.factor;
    return *this;
  }
};

/// Adds the time it lives to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum) {}
  ~Stopwatch() { sum_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& sum_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace snug::solver
