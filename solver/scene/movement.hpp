// The postures of a case as a movement of its bones, and what goes along with them from where it stood when the garment was put on.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mesh/body/skeleton.hpp"
#include "solver/algebra/layout.hpp"
#include "solver/algebra/state.hpp"
#include "solver/scene/model.hpp"
#include "solver/scene/run.hpp"

namespace snug::solver {

/// The way through the postures. Progress counts them: 0 is the position in which the garment is put on, k the k-th posture; in between turns and shifts go evenly.
class Movement {
 public:
  /// Empty where the case has no postures or its body does not deform. Throws input::InputError: bones that are none of the body (mesh/body/skeleton), a turn that would fold the core, a
  /// garment that nothing holds.
  Movement(const Model& model, const mesh::BodyMesh& body);

  int postures() const { return static_cast<int>(poses_.size()) - 1; }
  bool empty() const { return postures() < 1; }
  const mesh::Skeleton& skeleton() const { return skeleton_; }
  /// Of posture k, counted from 1; 0: "dressed".
  const std::string& name(int posture) const { return names_[posture]; }
  mesh::Pose pose(double progress) const;
  /// Steps on the way to posture k at least.
  int steps(int posture) const { return steps_[posture]; }
  int all_steps() const;
  /// "shank 25.8 deg" at a progress; "as put on" where nothing is moved.
  std::string text(double progress) const;

 private:
  void add(const input::PostureSpec& posture);
  void check_garments(const Model& model) const;

  mesh::Skeleton skeleton_;
  std::vector<std::string> names_ = {"dressed"};
  std::vector<mesh::Pose> poses_;
  std::vector<int> steps_ = {0};
};

/// Shares in the bones of every node of a scene, and what carries it along. Nodes of garments go with the skin under them where the movement begins.
class Carrier {
 public:
  Carrier(Movement movement, const Meshes& meshes, const Layout& layout, const State& dressed);

  const Movement& movement() const { return movement_; }
  /// `first`: the node's x entry.
  bool moves(int first) const;
  /// Where what stood where the node stood when the movement began is carried to, m.
  Eigen::Vector3d place(int first, double progress) const;
  /// Carries all positions of a state from its progress to another one: what deforms stays deformed, and goes along.
  void carry(State& state, double progress) const;

 private:
  std::span<const double> shares(int first) const;

  Movement movement_;
  int positions_ = 0;
  Eigen::VectorXd dressed_;
  std::vector<double> shares_;  ///< node by node, one a bone
};

}  // namespace snug::solver
