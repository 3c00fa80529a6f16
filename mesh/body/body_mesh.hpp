// The layered body as cells of one kind with named layers, surfaces and locations.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "mesh/body/cell_kind.hpp"
#include "mesh/body/limb.hpp"

namespace snug::mesh {

/// A solid layer of the body mesh, from the inside out.
struct Layer {
  std::string name;
  input::MaterialEntry material;
};

/// A membrane carried by the skin surface.
struct SkinMembrane {
  std::string name;
  input::MaterialEntry material;
  double thickness = 0.0;  ///< m
};

/// A named part of the boundary: "skin", "bone", "lower", "upper" of a limb, or what an imported mesh names. Facets are of
/// the mesh's facet kind and their normals point out of the body; an imported curve or point has nodes only.
struct Surface {
  std::string name;
  std::vector<FacetNodeNumbers> facets;
  std::vector<int> nodes;
};

/// What the file of an imported body says of single nodes and facets: forces (N), held components with their
/// displacement (m), nodes that keep their place along a direction (a unit vector) but for a displacement (m), pressures (Pa)
/// against the outward normal that follow the surface.
struct NodalForce {
  int node = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};
struct HeldComponent {
  int node = 0, component = 0;
  double displacement = 0.0;
};
struct HeldAlong {
  int node = 0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  double displacement = 0.0;
};
struct FacetPressure {
  std::vector<FacetNodeNumbers> facets;
  double value = 0.0;
};

/// A shell body is made of quadratic triangles, whose normal is that of their tangents along the first two edges.
struct ShellTriangle {
  FacetNodeNumbers nodes;  ///< tri6
  int layer = 0;           ///< index into BodyMesh::layers: its material
  double thickness = 0.0;  ///< m
  double foundation = 0.0; ///< Pa/m, pressure per deflection along the reference normal
};
/// A node of a shell that may not turn about a coordinate axis.
struct HeldRotation {
  int node = 0, component = 0;
};

/// Nodes are reference positions in the frame of the body (z along the axis, x side, y front), metres.
struct BodyMesh {
  std::vector<Eigen::Vector3d> nodes;
  CellKind kind = CellKind::hex27;
  /// In the limb's hexahedra i runs round the body, j along the axis, k outwards, so that face k = 1 is the outer one.
  std::vector<CellNodes> cells;
  std::vector<int> cell_layer;  ///< index into `layers`
  std::vector<Layer> layers;
  std::vector<SkinMembrane> membranes;  ///< skin as surface membrane (empty or one)
  std::vector<FacetNodeNumbers> skin_facets;  ///< outer surface, where a garment touches: facets of the surface "skin"
  std::vector<int> bone_nodes;                ///< on the rigid bone; empty when the bone is not rigid
  std::vector<Surface> surfaces;
  std::vector<std::string> locations;         ///< names of the skin patches
  std::vector<int> node_location;             ///< per node: index into `locations`, -1 for none and for nodes inside
  std::vector<std::vector<double>> location_shares;  ///< per location and node (location_shares.hpp); empty: nodes belong wholly to `node_location`
  double mean_skin_cell = 0.0;                ///< m, mean edge length of the skin facets
  std::vector<ShellTriangle> shell;           ///< a shell body: then there are no cells, and `kind` is tet10 for its facets
  std::vector<HeldRotation> held_rotations;   ///< of a shell body
  std::vector<int> node_numbers;              ///< those of the file of an imported body; empty: node n has number n + 1
  std::vector<NodalForce> forces;             ///< of the file
  std::vector<HeldComponent> held;            ///< of the file
  std::vector<HeldAlong> held_along;          ///< of the file, where the direction is none of x, y, z
  std::vector<FacetPressure> pressures;       ///< of the file
  std::vector<input::Diagnostic> remarks;     ///< what the file asks for and is done otherwise here

  /// The surface of that name, also in other capitals where there is one such only; or null.
  const Surface* surface(const std::string& name) const;
};

/// The first location whose sector holds the angle (rad) and whose range holds the height (m), or -1.
int location_of(const std::vector<input::LocationSpec>& locations, double angle, double height);

/// Mean edge length of facets, m.
double mean_edge(const BodyMesh& mesh, const std::vector<FacetNodeNumbers>& facets);
/// The shortest one, m.
double shortest_edge(const BodyMesh& mesh, const std::vector<FacetNodeNumbers>& facets);

/// Facets of the cells' faces whose nodes all satisfy `keep` (indexed by node) and that no other cell shares.
std::vector<FacetNodeNumbers> boundary_facets(const BodyMesh& mesh, const std::vector<char>& keep);

struct QualityRow {
  std::string layer;
  int cells = 0;
  double min_scaled_jacobian = 0.0;
  double mean_scaled_jacobian = 0.0;
  double max_aspect = 0.0;
  double volume = 0.0;  ///< m3
};

/// Meshes the limb through the gmsh API. Throws input::InputError naming layer, angle and height where a cell would
/// invert.
BodyMesh make_body_mesh(const input::BodySpec& spec, const Limb& limb);

/// The same body in cells of another kind: Q1 hexahedra on the corners of quadratic ones, or six quadratic tetrahedra in
/// each, whose mid-edge nodes are the hexahedron's own (Kuhn's subdivision). The mesh given has hexahedra with 27 nodes.
BodyMesh convert(const BodyMesh& mesh, CellKind kind);

/// One row a layer; Jacobians sampled at the Gauss points and the nodes.
std::vector<QualityRow> quality(const BodyMesh& mesh);

}  // namespace snug::mesh
