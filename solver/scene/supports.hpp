// What holds or moves the body: rigid bone, cut planes and the supports of the case, with their displacements.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "cases/input/case.hpp"
#include "mesh/body/body_mesh.hpp"
#include "solver/algebra/state.hpp"

namespace snug::solver {

/// The surface that a load or support of the case names. Throws input::InputError with the names that there are.
const mesh::Surface& named_surface(const mesh::BodyMesh& body, const std::string& name, const input::Location& where);

/// The prescribed entries of the body and where they stand at a load.
class Supports {
 public:
  Supports() = default;
  Supports(const input::Case& description, const mesh::BodyMesh& body, const Layout& layout);

  /// Prescribed entries of the state vector, each once.
  std::vector<int> entries() const;
  bool move() const { return !moving_.empty(); }
  /// From the state to its place at state.load, one value an entry of the state; empty where nothing moves.
  Eigen::VectorXd gap(const State& state) const;
  /// What each support holds, by its name in results ("bone", "lower cut", "upper cut", names of surfaces). A component
  /// that several hold is the first one's.
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

  Layout layout_;
  std::vector<Eigen::Vector3d> reference_;
  std::set<int> prescribed_;       ///< entries
  std::vector<Moving> moving_;
  std::vector<std::pair<std::string, std::vector<Held>>> held_;
};

}  // namespace snug::solver
