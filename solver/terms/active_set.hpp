// Which vertices are in contact: the active set of a semismooth Newton method.
#pragma once

#include <utility>
#include <vector>

namespace snug::solver {

/// Block principal pivoting (Judice & Pires, Computers & Operations Research 21 (1994)): all vertices on the wrong side
/// change at once as long as their number falls. When it has not for some iterations the sets go in circles, which the
/// hats' full coupling allows; then only those change that are wrong by at least a share of the worst, so that small errors
/// beside it, which its change may mend, do not come and go with it. The worst one is always among them. Where that does
/// not help for long, one alone changes, the one that has done so least often; and where that does not, the last one, which ends for
/// every positive definite problem (Murty, Opsearch 11 (1974) 123-130) but lets the others wait while it swings. With
/// friction not every problem has a solution: a vertex may press on its neighbours' slip so that its gap closes as its multiplier grows, and
/// then neither touching nor not touching is right to the last bit. Where sets have gone in circles a vertex out of contact therefore
/// stays so while it is wrong by no more than `slack`.
class ActiveSet {
 public:
  explicit ActiveSet(int vertices) : memory_{std::vector<char>(vertices, 0)} {}

  /// Before an increment: the count of the vertices on the wrong side starts anew.
  void begin();
  /// Changes towards the trials of an iterate, one a vertex: positive in contact; any unit, the same for all and for `slack`.
  void follow(const std::vector<double>& trials, double slack = 0.0);

  /// All that it goes by: one flag a vertex and the counts of `follow`.
  struct Memory {
    std::vector<char> flags = {};
    int changed = 0, fewest_wrong = 0, waited = 0;
    int circled = 0;                ///< 1: since `begin` the sets have gone in circles
    std::vector<int> turns = {};    ///< how often each vertex has changed alone since then; empty: none has
  };
  const Memory& memory() const { return memory_; }
  explicit ActiveSet(Memory memory) : memory_(std::move(memory)) {}

  bool operator[](int vertex) const { return memory_.flags[vertex]; }
  const std::vector<char>& flags() const { return memory_.flags; }
  /// Vertices on the wrong side at the last decision.
  int changed() const { return memory_.changed; }

 private:
  void count_anew();
  int next_alone(const std::vector<int>& wrong);

  Memory memory_;
};

}  // namespace snug::solver
