// What holds or moves the body: rigid bone, cut planes and the supports of the case, with their displacements.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "solver/algebra/layout.hpp"
#include "solver/algebra/state.hpp"
#include "solver/scene/constraint_table.hpp"
#include "solver/scene/model.hpp"
#include "solver/scene/movement.hpp"
#include "solver/scene/rigid_motions.hpp"

namespace snug::solver {

/// The surface that a load or support of the case names. Throws input::InputError with the names that there are.
const mesh::Surface& named_surface(const mesh::BodyMesh& body, const std::string& name, const input::Location& where);

/// The prescribed entries of the body and where they stand at a load: "bone", "lower cut", "upper cut" where they have no names in the case, else cuts by
/// their names, what the file holds, the supports of the case by their surfaces. What bone and cuts hold by themselves gives way to a support
/// of the case on the same surface. Nodes of the rigid bone are the bone's: other surfaces that end there leave them to it. Where several hold a component alike they bear the same of its force; where they do not,
/// the constructor throws input::InputError (constraint_table.hpp). Parts of the body that these leave free to move as a whole are
/// held, too ("free motions of the body"), by as many components as it takes: `check_balance` says whether nothing has to be borne
/// there.
/// Where bones move, all that is held beyond a joint, cuts, supports and held edges of garments alike, goes along from where it stood when the movement began, in all directions; what is held
/// before the joints stays held as it was.
class Supports {
 public:
  Supports() = default;
  Supports(const Model& model, const mesh::BodyMesh& body, const Layout& layout, std::shared_ptr<const Carrier> carrier = {});

  /// What is prescribed and by whom; the garments' rows come on top of it (constraints.hpp).
  const ConstraintTable& table() const { return table_; }
  bool move() const { return table_.moves(); }
  /// Bones carry what they hold.
  bool carry() const { return carrier_ != nullptr; }
  const Carrier* carrier() const { return carrier_.get(); }
  /// The node with that x entry goes along with a bone where it is held at all.
  bool carries(int first) const { return carrier_ && carrier_->moves(first); }
  /// Holds a node of a garment that goes along.
  void carry(int first);
  /// From the state to its place at state.load and state.posture, one value an entry of the state; empty where nothing moves.
  Eigen::VectorXd gap(const State& state) const;
  /// The parts that only such supports keep from moving.
  const std::vector<FreePart>& free_parts() const { return free_; }
  /// What holds nodes along lines of their own: cuts in tilted planes, oblique supports of the file. The residual of such a node (its x entry), but for
  /// components that are prescribed, is what the line answers; where several meet at a node it is the first one's.
  struct Oblique {
    std::string name;
    std::vector<int> first;
  };
  const std::vector<Oblique>& oblique() const { return oblique_; }
  /// Entries that hold them.
  const std::vector<int>& free_entries() const { return free_entries_; }

 private:
  void prescribe(int node, int component, int holder, const Motion& motion, const mesh::BodyMesh& body);
  void hold_limb(const input::BodySpec& spec, const std::vector<input::SupportSpec>& supports, const mesh::BodyMesh& body);
  void slide(const std::string& name, const mesh::Surface& cut, const std::function<bool(const std::string&, int)>& said, const mesh::BodyMesh& body);
  void hold(const std::vector<mesh::HeldComponent>& held, const input::Location& where, const mesh::BodyMesh& body);
  void hold(const input::SupportSpec& spec, const mesh::BodyMesh& body);
  void hold_along(const std::vector<mesh::HeldAlong>& held, const input::Location& where, const mesh::BodyMesh& body);
  void move(const input::ToolSpec& tool, const Field& tip, const mesh::BodyMesh& body);
  void resolve_lines(const mesh::BodyMesh& body);
  void hold_free_motions(const mesh::BodyMesh& body);

  Field body_;
  std::shared_ptr<const Carrier> carrier_;
  std::set<int> carried_;  ///< x entries of nodes
  std::set<int> bone_;  ///< nodes
  ConstraintTable table_{0};
  std::vector<FreePart> free_;
  std::vector<int> free_entries_;
  std::map<int, std::vector<Line>> lines_;  ///< by node
  std::vector<Oblique> oblique_;
};

/// Parts of the body that no support of the case holds can be in equilibrium only under forces (N, one a node of the body)
/// that do nothing along their free motions. Throws input::InputError with the part, its motions and the net load.
void check_balance(const Supports& supports, const mesh::BodyMesh& body, const std::vector<Eigen::Vector3d>& forces,
                   const input::Location& where);

}  // namespace snug::solver
