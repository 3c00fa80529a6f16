// A finite element model of another program as its file says it: numbers, units and names are the file's own. The readers
// of APDL text, CDB files and CalculiX input fill it, the writers print it, mesh/body/foreign makes a body of it.
#pragma once

#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cases/input/diagnostics.hpp"

namespace snug::mesh {

/// Nodes in the order that Abaqus, CalculiX and Ansys share: corners (below, then above), then the middles of the edges
/// below, above and upright; of triangles and tetrahedra 12 23 31 14 24 34. The tip of a pyramid is its last corner. A middle
/// that the file leaves out (0) lies half way.
enum class ElementKind { tet4, tet10, hex8, hex20, tri3, tri6, quad4, quad8, wedge6, wedge15, pyramid5, pyramid13 };
int node_count(ElementKind kind);
int corner_count(ElementKind kind);
bool is_shell(ElementKind kind);
bool is_tetrahedron(ElementKind kind);
/// "8-node hexahedron", ...
std::string to_string(ElementKind kind);
/// Corner places (from 0) of the ends of each edge that has a middle, in the order of the middles.
const std::vector<std::array<int, 2>>& model_edges(ElementKind kind);
/// Corner places (from 0) of each face of a solid, in the order of CalculiX's labels P1, P2, ...; normals point inwards.
const std::vector<std::vector<int>>& model_faces(ElementKind kind);

struct ModelNode {
  int number = 0;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  bool operator==(const ModelNode&) const = default;
};

struct ModelElement {
  int number = 0;
  ElementKind kind = ElementKind::hex8;
  std::vector<int> nodes;  ///< numbers
  int material = 0;        ///< index into Model::materials
  int section = -1;        ///< index into Model::sections; -1 for solids
  bool operator==(const ModelElement&) const = default;
};

/// Constants: elastic E, nu; compressible neo-Hooke E, nu (W = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2); neo-Hooke mu, kappa; Mooney-Rivlin C10, C01, kappa; Yeoh C10, C20, C30, kappa; Arruda-Boyce mu, lambda_m, kappa; Ogden mu_1, alpha_1, ..., kappa in the
/// convention W = sum mu_p/alpha_p (...). Those with kappa have the volumetric energy kappa/2 (J - 1)^2, kappa/2 (ln J)^2 or kappa/4 (J^2 - 1 - 2 ln J).
enum class ModelLaw { none, elastic, neo_hooke, mooney_rivlin, ogden, yeoh, arruda_boyce, compressible_neo_hooke };
enum class ModelVolume { quadratic, logarithmic, barrier };

struct ModelMaterial {
  std::string name;
  ModelLaw law = ModelLaw::none;
  std::vector<double> constants;
  double density = 0.0;  ///< 0: not given
  ModelVolume volume = ModelVolume::quadratic;
  bool operator==(const ModelMaterial&) const = default;
};

/// Of shells.
struct ModelSection {
  double thickness = 0.0;
  double foundation = 0.0;  ///< pressure per deflection along the normal (SHELL63's elastic foundation stiffness)
  bool operator==(const ModelSection&) const = default;
};

/// A component (from 0; 3, 4, 5 are rotations) held at a displacement.
struct ModelSupport {
  int node = 0, component = 0;
  double value = 0.0;
  bool operator==(const ModelSupport&) const = default;
};
/// A node held at a displacement along a direction (a unit vector) that is none of x, y, z.
struct ModelObliqueSupport {
  int node = 0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  double value = 0.0;
  bool operator==(const ModelObliqueSupport&) const = default;
};
struct ModelForce {
  int node = 0, component = 0;
  double value = 0.0;
  bool operator==(const ModelForce&) const = default;
};
/// On a face of a solid (an index into model_faces) against its outward normal; on a shell (face 0) along the normal that
/// its nodes turn about.
struct ModelPressure {
  int element = 0, face = 0;
  double value = 0.0;
  bool operator==(const ModelPressure&) const = default;
};

/// An acceleration that acts on the density of an element's material.
struct ModelWeight {
  int element = 0;
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
  bool operator==(const ModelWeight&) const = default;
};

struct Model {
  std::vector<ModelNode> nodes;        ///< by ascending number
  std::vector<ModelElement> elements;  ///< by ascending number
  std::vector<ModelMaterial> materials;
  std::vector<ModelSection> sections;
  std::map<std::string, std::vector<int>> node_sets;  ///< numbers, ascending
  std::vector<ModelSupport> supports;
  std::vector<ModelObliqueSupport> oblique_supports;
  std::vector<ModelForce> forces;
  std::vector<ModelPressure> pressures;
  std::vector<ModelWeight> weights;  ///< of solids; several of one element add up
  std::map<int, int> element_line;  ///< where an element stands in its file, for messages
  std::vector<input::Diagnostic> remarks;  ///< what the file asks for and is done otherwise here

  /// Line of an element, 0 where it is not known.
  int line_of(int element) const {
    const auto it = element_line.find(element);
    return it == element_line.end() ? 0 : it->second;
  }
};

/// As many wrong places of a file are reported; the rest of it is not read.
inline constexpr std::size_t most_model_errors = 1000;

/// What the readers have in common at the end: sorts, and reports elements with nodes that are not there, materials
/// without a law and supports and forces at nodes that are not there.
void finish(Model& model, const std::string& file, input::Diagnostics& diagnostics);

/// Of a file with `steps` load steps, of which the loads at the end of `asked` (0: the last) are in the model: says so where there are several,
/// reports a step that is not there.
void tell_load_step(Model& model, int steps, int asked, const input::Location& last, input::Diagnostics& diagnostics);

/// What is said where a file asks for a linear step: the answers differ as soon as displacements are large.
input::Diagnostic linear_step_remark(const std::string& file, const std::string& switch_on, int line = 0);

/// Reads APDL text or a CDB file (.cdb, .ans, .mac, .apdl, .txt), CalculiX input (.inp) or a FEBio model (.feb), by the ending of its name.
/// Files that it includes must lie in `root` (left out: in its own folder). Of several load steps the end of `load_step`, counted from 1,
/// is taken (0: of the last).
/// Throws input::InputError with the line of everything that is wrong or cannot be taken over.
Model read_model(const std::filesystem::path& file, const std::filesystem::path& root = {}, int load_step = 0);
/// True for names that read_model takes.
bool is_model_file(const std::filesystem::path& file);

Model parse_apdl(const std::string& text, const std::string& shown_as, input::Diagnostics& diagnostics, int load_step = 0);
/// *INCLUDE looks for files from `folder` and takes none outside `root`; without them it is refused.
Model parse_calculix(const std::string& text, const std::string& shown_as, input::Diagnostics& diagnostics, const std::filesystem::path& folder = {},
                     const std::filesystem::path& root = {}, int load_step = 0);

/// A FEBio model of format 3 or 4: solids with their materials, node sets (of surfaces, too), displacements, forces and pressures.
Model parse_febio(const std::string& text, const std::string& shown_as, input::Diagnostics& diagnostics, int load_step = 0);

/// One static step with large displacements; displacements of all nodes go to the .dat file. Numbers have the 20 characters
/// that CalculiX reads: what is read back is what was written, to 1e-14 of the longest ones.
void write_calculix(std::ostream& out, const Model& model);
/// A CDB file: NBLOCK, EBLOCK, components, materials, supports and loads, with 17 digits: read back to the last bit.
void write_cdb(std::ostream& out, const Model& model);

}  // namespace snug::mesh
