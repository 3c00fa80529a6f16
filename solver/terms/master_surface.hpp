// The master side of contact: its facets, their neighbours, and where a point of the slave meets them.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "mesh/garment/garment_mesh.hpp"
#include "solver/algebra/state.hpp"
#include "solver/fem/box_tree.hpp"
#include "solver/terms/facet_kind.hpp"

namespace snug::solver {

/// Where a point of the slave meets the master; facet -1: it faces none.
struct Site {
  int facet = -1;
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();
};

class MasterSurface {
 public:
  /// Facets of a body. With a field of positions nodes move with the state; with an empty one they stand where the mesh has them.
  MasterSurface(const Field& positions, const mesh::BodyMesh& mesh, std::vector<mesh::FacetNodeNumbers> facets);
  /// The triangles of a garment (quadratic ones) as they move; sewn nodes are one. Throws std::invalid_argument for linear ones.
  MasterSurface(const Field& positions, const mesh::GarmentMesh& garment);

  bool deformable() const { return positions_.count > 0; }
  int facets() const { return static_cast<int>(facets_.size()); }
  mesh::FacetKind kind() const { return kind_; }
  const FacetDomain& domain() const { return *domain_; }
  double mean_edge() const { return mean_edge_; }  ///< m
  /// Nodes of the mesh, on the surface or not.
  int nodes() const { return static_cast<int>(reference_.size()); }
  /// Entry of a component of a node; of a deformable one only.
  int entry(int node, int component) const { return positions_(node, component); }
  /// Node numbers, -1 in the slots that the kind does not use.
  const mesh::FacetNodeNumbers& nodes_of(int facet) const { return facets_[facet]; }
  FacetNodes positions(const State& state, int facet) const;
  /// Neighbour across each edge of the domain; -1 on the border.
  const std::vector<int>& neighbours(int facet) const { return neighbours_[facet]; }

  /// Global search for the facet nearest to x: a tree of bounding boxes, then projection. Without a `tree` the boxes are those of the reference surface.
  Site find(const State& state, const Eigen::Vector3d& x, const fem::BoxTree* tree = nullptr) const;
  /// Follows x from the last site over neighbouring facets; falls back on `find`.
  Site follow(const State& state, const Eigen::Vector3d& x, const Site& last, const fem::BoxTree* tree = nullptr) const;
  /// Boxes of the surface as it is: where bones have moved it far from its reference.
  fem::BoxTree tree(const State& state) const;

 private:
  MasterSurface(const Field& positions, mesh::FacetKind kind, std::vector<mesh::FacetNodeNumbers> facets,
                std::vector<Eigen::Vector3d> reference, double mean_edge);
  /// Walks from `site` to the facet that x projects into; the first facet may be left by `stay` without leaving it.
  bool settle(const State& state, const Eigen::Vector3d& x, double stay, Site& site) const;
  Site nearest_of(const State& state, const Eigen::Vector3d& x, std::vector<Site> places) const;
  double distance(const State& state, const Eigen::Vector3d& x, const Site& site) const;  ///< m
  void connect();
  std::vector<Eigen::AlignedBox3d> boxes() const;

  Field positions_;
  mesh::FacetKind kind_;
  const FacetDomain* domain_;
  std::vector<mesh::FacetNodeNumbers> facets_;
  std::vector<std::vector<int>> neighbours_;
  std::vector<Eigen::Vector3d> reference_;
  double mean_edge_;
  fem::BoxTree tree_;
};

}  // namespace snug::solver
