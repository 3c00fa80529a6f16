// Equilibria along their curve, past the loads at which it turns back.
#pragma once

#include <optional>

#include "solver/stepping/load_path.hpp"

namespace snug::solver {

struct ArcSettings {
  int increments = 200;         ///< most of them
  int failures = 8;             ///< halvings in a row before giving up
  int iterations = 12;          ///< of one increment
  double longest = 0.0;         ///< length of an increment over that of the first; 0: any
  NewtonSettings newton;
  std::function<bool(const State&)> stop;  ///< ends the curve at the first state where it holds; may be empty
  std::function<void(const Scene&, const State&, int increment)> accepted;  ///< every converged state; may be empty
};

struct ArcResult {
  PathResult path;                   ///< the last state; complete: at full load, or where `stop` held. `reached`: its load
  State strongest;                   ///< the state before the load fell for the first time, or the last one
  std::optional<double> limit_load;  ///< the largest load there, by the polynomial through four states over their arc
};

/// From a converged state below full load along the curve R(x, s) = 0, first towards more load. Increments of length l,
///   |D|^2 = l^2,  D = x - x0 over the positions (cylindrical: Crisfield 1981, Comput. Struct. 13, 55),
/// whose constraint is linearised with the balance (Riks 1979; Ramm 1981), so that there is no quadratic equation and no choice
/// of its roots:
///   K a = -R,  K b = -dR/ds,  ds = -((|D|^2 - l^2)/2 + D . a) / (D . b),  dx = a + ds b,
/// both with one factor. Loads (`Term::is_load`) grow with s, and nothing else may. Lengths follow the count of iterations.
/// `origin`: where displacements count from; the first length is a twentieth of the displacement.
ArcResult follow_arc(Scene& scene, const State& start, const State& origin, const ArcSettings& settings, const IterationSink& sink);

/// How the load of a body goes from none to full.
struct LoadedPath {
  PathResult path;                   ///< where it is not complete, the state of the largest load that was reached
  std::optional<double> limit_load;  ///< where the load fell on the way
};

/// By increments of the load (`rows`); where these end below full load, or from a twentieth of it on where `along_curve`, along
/// the curve of equilibria (`curve_rows`).
LoadedPath follow_load(Scene& scene, const State& placed, bool along_curve, const PathSettings& settings, const IterationSink& rows,
                       const IterationSink& curve_rows);

}  // namespace snug::solver
