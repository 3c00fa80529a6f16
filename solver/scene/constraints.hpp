// Who may move: prescribed and sewn entries of the state vector.
#pragma once

#include <string>

#include "mesh/body/body_mesh.hpp"
#include "mesh/garment/garment_mesh.hpp"
#include "solver/algebra/numbering.hpp"
#include "solver/algebra/state.hpp"
#include "solver/algebra/layout.hpp"
#include "solver/scene/model.hpp"
#include "solver/scene/run.hpp"
#include "solver/scene/supports.hpp"
#include "solver/terms/tissue.hpp"

namespace snug::solver {

/// Adds the positions of a part, "PART" (one a node); its pressures, "PART pressure" (tetrahedra) or "PART cells" (dilatation
/// less one, then pressure in Pa, cell by cell); the pressures of an interface (Pa per rest area of the slave, one a vertex).
void add_positions(Layout& layout, const std::string& part, const mesh::BodyMesh& mesh);
void add_pressures(Layout& layout, const std::string& part, const mesh::BodyMesh& mesh);
void add_multipliers(Layout& layout, const std::string& interface, int vertices);
/// What tissue stands on.
Tissue::Fields body_fields(const Layout& layout, const std::string& part);

/// Which bodies of the tiers take part.
enum class Skin { rigid, deformable };

/// Fields of a scene: positions of the body where it is deformable and of the garments by their names, pressures of the body,
/// pressures of the contacts by theirs.
Layout make_layout(const Model& model, const Meshes& meshes, Skin skin);

/// The edge ("upper" or "lower") at which such a garment is held all the same, so that the reaction there tells whether
/// it would slide: the wider one as placed. Without friction a garment is drawn towards the narrow end, and so it hangs
/// from this edge; from the other one it would be pushed together.
std::string probe_edge(const mesh::GarmentMesh& garment);

/// Without friction nothing decides how far a garment is turned round the limb (and the facets of the skin would make a
/// ratchet of it): one seam node of the upper edge keeps its place round the axis, and its reaction is reported.
struct TurnPin {
  int node = 0;       ///< representative garment node
  int component = 0;  ///< x or y, whichever is nearer to the hoop direction there
};
TurnPin turn_pin(const mesh::GarmentMesh& garment);

/// The supports of a scene whose bones carry what they hold, the edges of garments included.
Supports carried_supports(const Model& model, const Meshes& meshes, const Layout& layout, std::shared_ptr<const Carrier> carrier);

/// What the supports prescribe has no unknowns; neither have pressures of layers whose law has none; sewn garment nodes
/// share their unknowns; held edges keep their place along the skin's meridian, the tangent in the direction of the axis at
/// the placed foot point, and move freely off the skin and round it (without friction, a garment without any is held at its
/// probe edge, and one that can turn by its pin; friction needs neither).
Numbering make_numbering(const Model& model, const Meshes& meshes, const Layout& layout, const Supports& supports);

}  // namespace snug::solver
