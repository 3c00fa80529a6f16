// Equilibria along their curve, past the loads at which it turns back.
#pragma once

#include "solver/stepping/load_path.hpp"

namespace snug::solver {

struct ArcSettings {
  int increments = 200;         ///< most of them
  int failures = 8;             ///< halvings in a row before giving up
  int iterations = 12;          ///< of one increment
  double longest_turn = 0.35;   ///< rad between the directions of two increments; more is halved
  NewtonSettings newton;
  std::function<bool(const State&)> stop;  ///< ends the curve at the first state where it holds; may be empty
  std::function<void(const Scene&, const State&, int increment)> accepted;  ///< every converged state; may be empty
};

struct ArcResult {
  PathResult path;              ///< the last state; complete: at full load, or where `stop` held. `reached`: its load
  State strongest;              ///< the state of the largest load, a limit load where `turned`
  bool turned = false;          ///< the load fell along the curve
};

/// From a converged state below full load along the curve R(x, s) = 0, first towards more load. Increments of length l,
///   |x - x0|^2 = l^2   over the positions (cylindrical: Crisfield 1981, Comput. Struct. 13, 55),
/// whose constraint is linearised with the balance (Riks 1979; Ramm 1981), so that the quadratic equation and its choice of a
/// root are not met:
///   K a = -R,  K b = -dR/ds,  ds = -((|D|^2 - l^2)/2 + D . a) / (D . b),  dx = a + ds b,  D = x - x0,
/// both with one factor. Loads (`Term::is_load`) grow with s; nothing else may. Lengths follow the count of iterations.
/// `origin`: where displacements count from; the first length is a tenth of the displacement, or, where there is none, that of
/// a twentieth of the load.
ArcResult follow_arc(Scene& scene, const State& start, const State& origin, const ArcSettings& settings, const IterationSink& sink);

}  // namespace snug::solver
