// What holds or moves the body: rigid bone, cut planes and the supports of the case, with their displacements.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "solver/algebra/layout.hpp"
#include "solver/algebra/state.hpp"
#include "solver/scene/model.hpp"
#include "solver/scene/rigid_motions.hpp"

namespace snug::solver {

/// The surface that a load or support of the case names. Throws input::InputError with the names that there are.
const mesh::Surface& named_surface(const mesh::BodyMesh& body, const std::string& name, const input::Location& where);

/// The prescribed entries of the body and where they stand at a load. Parts of the body that these leave free to move as a
/// whole are held, too, by as many components as it takes: `check_balance` says whether nothing has to be borne there.
class Supports {
 public:
  Supports() = default;
  Supports(const Model& model, const mesh::BodyMesh& body, const Layout& layout);

  /// Prescribed entries of the state vector, each once.
  std::vector<int> entries() const;
  bool move() const { return !moving_.empty(); }
  /// From the state to its place at state.load, one value an entry of the state; empty where nothing moves.
  Eigen::VectorXd gap(const State& state) const;
  /// The parts that only such supports keep from moving.
  const std::vector<FreePart>& free_parts() const { return free_; }
  /// Entries that hold them.
  const std::vector<int>& free_entries() const { return free_entries_; }
  /// What each support holds, by its name in results ("bone", "lower cut", "upper cut", names of surfaces, "free motions of
  /// the body"). A component that several hold is the first one's.
  struct Held {
    int node, component;
  };
  const std::vector<std::pair<std::string, std::vector<Held>>>& held() const { return held_; }

 private:
  /// A support whose nodes move: displacement and turn about the line along z through `middle`, at full load.
  struct Moving {
    std::vector<int> nodes;
    Eigen::Vector3d displacement;
    double turn;
    Eigen::Vector2d middle;
    std::array<bool, 3> held;
  };
  /// Adds to the support that was begun last.
  void prescribe(int node, int component);
  void hold(const std::vector<mesh::HeldComponent>& held);
  void hold(const mesh::BodyMesh& body, const input::SupportSpec& spec);
  void hold_free_motions(const mesh::BodyMesh& body);

  Field body_;
  std::vector<Eigen::Vector3d> reference_;
  std::set<int> prescribed_;       ///< entries
  std::vector<Moving> moving_;
  std::vector<std::pair<std::string, std::vector<Held>>> held_;
  std::vector<FreePart> free_;
  std::vector<int> free_entries_;
};

/// Parts of the body that no support of the case holds can be in equilibrium only under forces (N, one a node of the body)
/// that do nothing along their free motions. Throws input::InputError with the part, its motions and the net load.
void check_balance(const Supports& supports, const mesh::BodyMesh& body, const std::vector<Eigen::Vector3d>& forces,
                   const input::Location& where);

}  // namespace snug::solver
