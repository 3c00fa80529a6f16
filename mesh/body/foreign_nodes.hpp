// The nodes of another program's model on their way into a body: numbers, nodes added between them, what acts on them.
#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "mesh/formats/model.hpp"

namespace snug::mesh {

/// Fills nodes and node_numbers of `mesh`, which must outlive it.
class ForeignNodes {
 public:
  ForeignNodes(const Model& model, const input::BodySpec& spec, BodyMesh& mesh);

  /// The place of a node of the file among the mesh's.
  int node_of(int number);
  bool has(int number) const { return ours_.contains(number); }
  int at(int number) const { return ours_.at(number); }
  /// The node amid others, made at `at` where it is missing; it belongs to sets and supports when all `parents` (left out:
  /// those around) do.
  int between(std::vector<int> around, const Eigen::Vector3d& at, std::vector<int> parents = {});
  /// The same where it has been made, else -1.
  int find(std::vector<int> around) const;
  int middle(int a, int b) { return between({a, b}, 0.5 * (mesh_.nodes[a] + mesh_.nodes[b])); }
  /// The mid-edge node of the file.
  void set_middle(int a, int b, int number);

  /// When all nodes are known: numbers for those that were added.
  void number_the_rest();
  /// Marks the nodes of a list of numbers and those that were added amid them only.
  std::vector<char> marked(const std::vector<int>& numbers) const;
  /// Supports (rotations of shells, too) and forces, in SI. Throws input::InputError for a force on a node of no element.
  void add_supports();
  void add_forces();

 private:
  std::map<int, double> held(int component) const;
  void add_oblique_supports();

  const Model& model_;
  const input::BodySpec& spec_;
  BodyMesh& mesh_;
  std::unordered_map<int, Eigen::Vector3d> place_;
  std::unordered_map<int, int> ours_;        ///< number in the file -> node
  std::map<std::vector<int>, int> between_;  ///< nodes around -> the node amid them
  std::vector<std::vector<int>> parents_;    ///< of nodes that were added
};

/// A shell body from the triangles and quadrilaterals of the model (quadrilaterals are cut in two), all turned the same way.
/// Throws input::InputError for degenerate elements and surfaces with one side.
BodyMesh shell_body_of(const Model& model, const input::BodySpec& spec);

}  // namespace snug::mesh
