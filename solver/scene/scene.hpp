// The parts of a scene, owned, in the order in which a case names them. What a case does not name does not exist here.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/algebra/costs.hpp"
#include "solver/algebra/linear_solver.hpp"
#include "solver/scene/constraints.hpp"
#include "solver/scene/model.hpp"
#include "solver/scene/run.hpp"
#include "solver/terms/contact.hpp"
#include "solver/terms/fabric_membrane.hpp"
#include "solver/terms/friction.hpp"
#include "solver/terms/tissue.hpp"

namespace snug::solver {

/// What a part of a scene is to the others.
enum class Role { body, garment };
/// A mesh with its positions in the state.
struct Part {
  std::string name;
  Role role = Role::body;
  Field position;
};
/// A pair of parts that touch, with its terms; they belong to the scene.
struct Touch {
  std::string slave;                  ///< part, or a surface of the body
  std::vector<std::string> masters;   ///< what it may meet, in the order of the contact's surfaces: garments, "skin", a surface of the body
  const FabricMembrane* sheet = nullptr;  ///< of a garment; null: the slave is a surface of the body
  const Contact* contact = nullptr;
  const Friction* friction = nullptr; ///< null: none
};

/// Terms, numbering and the matrix they share. Use `make_scene`. What changes is in the state; what is here of it (pattern,
/// matrix, factor) is that of the state that `update` saw last.
class Scene {
 public:
  Scene(const Layout& layout, Numbering numbering, Supports supports = {});

  /// Holds its parts anew: other entries have unknowns from now on. States stay what they are, the pattern is built anew.
  void hold(Supports supports, Numbering numbering);

  /// Returns the term.
  template <class T>
  T& add(std::unique_ptr<T> term) {
    T& added = *term;
    own(std::move(term));
    return added;
  }
  void add(Part part) { parts_.push_back(std::move(part)); }
  void add(Touch touch) { touches_.push_back(std::move(touch)); }
  const std::vector<Part>& parts() const { return parts_; }
  const std::vector<Touch>& touches() const { return touches_; }
  const Layout& layout() const { return layout_; }
  const Numbering& numbering() const { return numbering_; }
  const Supports& supports() const { return supports_; }
  const std::vector<std::unique_ptr<Term>>& terms() const { return terms_; }
  /// The first term of type T, of that name if one is given, or null where the scene has none.
  template <class T>
  T* find(const std::string& name = {}) const {
    for (const auto& term : terms_)
      if (auto* found = dynamic_cast<T*>(term.get()); found && (name.empty() || found->name() == name)) return found;
    return nullptr;
  }

  /// Before an increment: terms renew what stands still during its iterations.
  void renew(State& state);
  /// Terms take an accepted state for the one that their history starts from.
  void commit(State& state) const;
  /// Lets every term look at the state; the sparsity pattern follows where what they couple has changed.
  void update(State& state);
  /// Gives a state that no term has seen its histories, without a pattern; leaves others as they are.
  void look(State& state) const;
  /// The state's histories as they were stored in a file (state.hpp). Throws std::runtime_error when they are of another scene.
  void restore(State& state) const;
  /// What of another scene's state this one shares: fields of the same name and size, and the histories that its terms take
  /// over; the rest is that of `placed`.
  State transfer(const State& from, const Layout& layout, State placed) const;
  /// Residual and tangent of all terms into the matrix. False: inadmissible state.
  bool assemble(const State& state, Tangent tangent);
  /// Residual on every entry, prescribed ones included (where it is minus the support's force).
  Eigen::VectorXd full_residual(const State& state) const;
  /// The forces of the loads, one value an entry.
  Eigen::VectorXd load_forces(const State& state) const;
  /// Solves tangent * step = -residual with `proximal` times the garment's proximal weights added to the diagonal;
  /// `step` has an entry for every state entry. Prescribed entries take the step to their place at state.load, and the
  /// others answer to it.
  /// `whole`: with what stands in no matrix, too (Term::add_one_way).
  LinearReport solve(const State& state, Tangent tangent, double proximal, const Lag& lag, Eigen::VectorXd& step, bool whole = false);
  /// The last factor was one of a full tangent without more negative pivots than its saddle rows.
  bool factor_is_of_minimum() const { return of_minimum_; }
  /// After `solve` at the state: the step that other forces (one value an entry) ask for, with the same matrix.
  bool respond(const State& state, const Eigen::VectorXd& forces, Eigen::VectorXd& step);
  /// Bytes that the program may take on all ranks together (mumps_factor); 0: there is no bound.
  void may_take(double memory) { solver_.may_take(memory); }
  /// Gives the memory of matrix and factor back; the next update builds them anew.
  void drop_matrix();
  /// What was spent since the last call.
  Costs take_costs() { return std::exchange(costs_, {}); }

  /// Rows of pressures and multipliers: the negative pivots that a minimum on their constraints has.
  int saddle_rows() const;
  /// Norm of the residual over force rows, N, as assembled last.
  double force_residual() const;
  /// The same with what is missing in cell-wise volumes and pressures brought in as force: what the residual would be if they
  /// followed the positions. After an assembly with its tangent.
  double condensed_residual() const;
  /// The residual along a step: what the energy rises by at its start where there is one, J.
  double slope(const Eigen::VectorXd& step) const;
  /// What round-off of the positions alone makes of the force residual, N: eps |x| K_ii over the rows.
  double round_off(const State& state) const;
  /// Largest coordinate of the state, m.
  double farthest(const State& state) const;
  Measure measure(const State& state) const;
  /// J: what body and garments store, less the work of the loads; NaN where a load has no potential.
  double energy(const State& state) const;
  double step_bound(const State& state, const Eigen::VectorXd& step) const;
  /// Adds weights (N/m, one a state entry) to the proximal term beside those of the terms.
  void damp(const Eigen::VectorXd& weights) { proximal_weights_ += weights; }

  /// What Newton's method has to know of the terms together (term.hpp).
  bool damped() const { return !proximal_weights_.isZero(0.0); }
  bool bends() const;
  bool renews_near_answer() const;

 private:
  void own(std::unique_ptr<Term> term);
  void mark_force_rows();
  bool pattern_is_of(const State& state) const;
  void rebuild(const State& state);
  double force_norm(const Eigen::VectorXd& rows) const;
  OneWay one_way(const State& state) const;
  /// An entry for every state entry from all unknowns; what neither is one nor follows one stays as it is.
  void take_unknowns(const Eigen::VectorXd& x, Eigen::VectorXd& step) const;
  /// The other way round: forces on entries onto the unknowns that carry them.
  void add_to_unknowns(Eigen::VectorXd forces, Eigen::VectorXd& sum) const;

  Layout layout_;
  Numbering numbering_;
  Supports supports_;
  std::vector<std::unique_ptr<Term>> terms_;
  std::vector<Part> parts_;
  std::vector<Touch> touches_;
  SparseScatter scatter_;
  LinearSolver solver_;
  bool of_minimum_ = false;
  Eigen::VectorXd proximal_weights_;
  std::vector<char> force_row_;  ///< one an unknown: a force balance (and no gap)
  Costs costs_;
  std::vector<const ElementEntries*> built_;  ///< what the pattern was built of, one a term; empty: not built
  Histories built_of_;                        ///< keeps them alive
};

/// Builds the scene of a case from its parts. With a `prestretch` a garment's rest shape is not its pattern but its
/// placed shape shrunk by that factor (verification). Throws input::InputError where what the case names does not fit together.
Scene make_scene(const Model& model, const Meshes& meshes, Skin skin, std::optional<double> prestretch = {});

/// The strain-free start: parts where their meshes have them, no contact pressure, s = 0. With the model tools stand at their start.
State placed_state(const Layout& layout, const Meshes& meshes);
State placed_state(const Layout& layout, const Model& model, const Meshes& meshes);

}  // namespace snug::solver
