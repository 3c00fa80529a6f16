// What the commands of an APDL text leave behind before a model is made of it.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "mesh/formats/fields.hpp"
#include "mesh/formats/model.hpp"
#include "mesh/formats/nodal_frames.hpp"

namespace snug::mesh {

/// An element as its command or block gives it; what kind it is follows from its type at the end.
struct ApdlElement {
  int number = 0, type = 1, material = 1, real = 1, section = 1;
  std::vector<int> nodes;
  int line = 0;
};

/// An area between keypoints with the attributes that it is meshed with.
struct ApdlArea {
  std::vector<int> corners;
  int type = 1, material = 1, real = 1, section = 1;
  int line = 0;
};

struct ApdlMaterial {
  std::map<std::string, double> properties;  ///< EX, PRXY, NUXY, GXY, DENS
  bool elastic = false;                      ///< E and nu stand in `table` (TB,ELASTIC)
  ModelLaw hyperelastic = ModelLaw::none;
  std::vector<double> table;  ///< of TBDATA
  int terms = 1;
  int line = 0;
};

struct ApdlDeck {
  std::map<int, Eigen::Vector3d> nodes, keypoints;
  std::vector<ApdlElement> elements;
  std::vector<ApdlArea> areas;
  std::map<int, int> types;  ///< number -> that of the element's name (SHELL63: 63)
  std::map<int, std::map<int, int>> options;  ///< key options that are not 0, by type
  NodalFrames frames;
  std::map<int, ApdlMaterial> materials;
  std::map<int, std::vector<double>> reals, shell_sections;
  std::map<std::string, std::vector<int>> node_sets, element_sets;
  std::vector<ModelSupport> supports, keypoint_supports;
  std::vector<ModelForce> forces, keypoint_forces;
  std::vector<ModelPressure> pressures;  ///< faces as Ansys counts them, from 1
  int divisions = 0;                     ///< of a line between keypoints; 0: not said
  bool large_displacements = false;      ///< NLGEOM,ON
};

/// Fixed columns of a Fortran format such as (3i9,6e21.13e3).
struct FixedColumns {
  std::vector<int> widths;
  std::vector<char> integer;  ///< one a column
};
/// Empty where the text is no such format.
FixedColumns fixed_columns(std::string_view format);

/// The lines of a text, one by one.
class LineSource {
 public:
  explicit LineSource(std::string_view text) : rest_(text) {}
  bool next(std::string_view& line);
  int number() const { return number_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

/// The frame of a node by its angles (degrees).
void set_frame(ApdlDeck& deck, int node, double thxy, double thyz, double thzx);
/// A key option of a type; those that change what the element is are reported. Of shells the first option turns bending off; the
/// others of solids and shells choose integration and output.
void set_key_option(const FieldLine& line, ApdlDeck& deck, int type, int option, std::size_t field);

/// Reads the block that `head` (NBLOCK, EBLOCK, CMBLOCK, RLBLOCK, ETBLOCK, SECBLOCK) begins; true when it is one.
bool read_block(const FieldLine& head, LineSource& lines, ApdlDeck& deck);

/// Meshes the areas: triangles and quadrilaterals with `divisions` parts a side. Nodes at keypoints take their numbers
/// where they are free; loads and supports of keypoints go to them.
void mesh_areas(ApdlDeck& deck, const std::string& file, input::Diagnostics& diagnostics);

/// Types, materials and sections found and put together.
Model model_of(const ApdlDeck& deck, const std::string& file, input::Diagnostics& diagnostics);

}  // namespace snug::mesh
