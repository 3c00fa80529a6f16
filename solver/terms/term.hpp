// A term of the scene's energy: one file a physics. A term knows its fields and its own data, no load path, and of other terms
// those that it is built on. All that changes is in the state: a term answers the same for the same state.
#pragma once

#include <Eigen/SparseCore>

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "postproc/fields.hpp"
#include "solver/algebra/layout.hpp"
#include "solver/algebra/sparse_scatter.hpp"
#include "solver/algebra/state.hpp"

namespace snug::solver {

/// Where a term puts its element vectors and matrices; `matrix` is asked for only when the tangent is wanted.
class Sink {
 public:
  virtual ~Sink() = default;
  virtual void add(int element, std::span<const double> residual, std::span<const double> matrix) = 0;
  /// With the matrix: what entries without unknowns, eliminated from the element, add to the residual of the others.
  virtual void add_condensed(int, std::span<const double>) {}
  /// False for elements that another rank computes: they need not be added.
  virtual bool wants(int element) const { return true; }
};

/// What a term says of the state beside its residual (contact mostly). All SI.
struct Measure {
  double contact_force = 0.0;      ///< N, sum of |point forces|
  double smallest_force = 0.0;     ///< N, what the residual is measured against where nothing touches
  double complementarity = 0.0;    ///< Pa
  double penetration = 0.0;        ///< m
  double pressure_scale = 0.0; ///< Pa, mean over active nodes
  double volume_error = 0.0;       ///< relative volume that a pressure of the body misses
  int active = 0, changed = 0;     ///< contact nodes; changed in the last update
};

/// What to assemble beside the residual. `convex` leaves out the parts of the tangent that may be indefinite away from
/// equilibrium (the skin's own turning and sliding under a contact pressure that the tissue does not carry yet).
enum class Tangent { none, full, convex };
inline bool wanted(Tangent tangent) { return tangent != Tangent::none; }

/// Results by part of the scene ("body", a garment's name): a value a node or cell of the part's mesh.
using PublishedFields = std::map<std::string, postproc::Fields>;

class Term {
 public:
  virtual ~Term() = default;
  /// Its own in a scene: its history stands in the state under it.
  virtual std::string name() const = 0;
  /// The state entries that each element couples. They change with the history: the same object as long as they are the same.
  virtual const ElementEntries& entries(const State& state) const = 0;
  /// Energy (J) at the state where one exists, NaN where none does.
  virtual double energy(const State&) const { return std::numeric_limits<double>::quiet_NaN(); }
  /// What of it is stored: nothing where the term dissipates or only holds.
  virtual double stored_energy(const State& state) const { return energy(state); }
  /// Residual (gradient of the energy) and, if wanted, its derivative, element by element.
  /// Returns false when the state is not admissible (inverted cell).
  virtual bool assemble(const State& state, Tangent tangent, Sink& sink) const = 0;
  /// Adds what of the residual's derivative stands in no energy and on one side only, and so in no matrix that is factored: forces that
  /// follow the multipliers while the gaps do not answer to them. Rows and columns are entries of the state.
  virtual void add_one_way(const State&, std::vector<Eigen::Triplet<double>>& /*derivative*/) const {}
  /// Largest fraction of `direction` that stays admissible, at most `limit`.
  virtual double step_bound(const State&, const Eigen::VectorXd& direction, double limit) const { return limit; }
  /// Gives its step to what the term eliminated: entries without unknowns follow from the step of the others.
  virtual void recover(const State&, Eigen::VectorXd&) const {}
  virtual void measure(const State&, Measure&) const {}
  /// Adds what it knows of the state as fields of its parts: they come into the result, its files and what reads these.
  virtual void publish(const State&, PublishedFields&) const {}

  /// Renews in the history what stands still while Newton's method iterates (the quadrature of contact), before an increment.
  virtual void renew(State&) const {}
  /// Looks at a new iterate (search, active set) before it is assembled.
  virtual void update(State&) const {}
  /// Takes an accepted state, which `update` saw, for the one that history starts from.
  virtual void commit(State&) const {}
  /// The history of another scene's state that this one goes on from, where the term takes it over.
  virtual void carry(const State& /*from*/, State&) const {}
  /// Its history from a file: as it was when it was stored.
  virtual void restore(State&) const {}

  /// False where the tangent is not symmetric: a force that derives from no energy.
  virtual bool symmetric() const { return true; }
  /// A force from outside, which the balance of the supports counts.
  virtual bool is_load() const { return false; }
  /// It resists bending: whole steps of Newton's method lead uphill first, and a line search along them would stop them.
  virtual bool bends() const { return false; }
  /// `renew` moves the answer a little, so that it is wanted once more near it.
  virtual bool renews_near_answer() const { return false; }
  /// Adds its weights (N/m, one an entry) to those of the proximal term: for parts that may be without stiffness of their own.
  virtual void damp(Eigen::VectorXd& /*weights*/) const {}
};

}  // namespace snug::solver
