// What holds cloth back while it creeps to where it rests.
#pragma once

#include <string>
#include <vector>

#include "solver/terms/term.hpp"

namespace snug::solver {

/// Where a step against the drag has set out from, and how strong the drag is; without it where there is none, as in every accepted state.
struct DragHistory : History {
  double drag = 0.0;        ///< over the weights
  Eigen::VectorXd from;     ///< values
  void write(ByteWriter&) const override {}
};

/// A step of implicit Euler against a drag on every node: with the weights w (N/m) and the place x0 that the step sets out from,
///   f = drag w (x - x0),   W = drag/2 sum w |x - x0|^2.
/// It is definite, so that cloth which buckles or slides to another place gets there by small moves, each of them an equilibrium with
/// the drag (pseudo-transient continuation: Kelley & Keyes, SIAM J. Numer. Anal. 35 (1998) 508).
class Drag : public Term {
 public:
  /// `weights`: N/m, one an entry of the state; entries without one are not held back.
  explicit Drag(const Eigen::VectorXd& weights);

  /// From here on the state's cloth is held back on its way from where it is; 0: it is not.
  static void hold_back(State& state, double drag);
  /// Largest way of a node that is held back between two values of the state, m.
  double way(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const;

  std::string name() const override { return own_name; }
  const ElementEntries& entries(const State&) const override { return entries_; }
  double energy(const State& state) const override;
  double stored_energy(const State&) const override { return 0.0; }
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  void restore(State& state) const override;

 private:
  static constexpr const char* own_name = "drag";
  std::vector<double> weights_;  ///< one an element
  ElementEntries entries_;       ///< one each
};

}  // namespace snug::solver
