// What a slave may meet: surfaces that lie over one another, a garment and the skin under it.
#pragma once

#include <memory>
#include <vector>

#include "solver/terms/master_surface.hpp"

namespace snug::solver {

/// Surfaces from the outermost inwards; a point of the slave meets the first of them that it faces, and beyond that one's edge
/// the next. Facets and nodes are numbered through. Where surfaces lie on one another the gap has no jump at an edge, so that
/// one field of pressures serves all of them.
class MasterStack {
 public:
  /// One surface alone.
  MasterStack(MasterSurface surface);
  /// At least one.
  explicit MasterStack(std::vector<MasterSurface> surfaces);

  int surfaces() const { return static_cast<int>(surfaces_.size()); }
  const MasterSurface& surface(int s) const { return surfaces_[s]; }
  /// The surface of a facet, and the first facet of a surface.
  int surface_of(int facet) const;
  int first_facet(int surface) const { return first_facet_[surface]; }

  /// Whether nodes of any surface are unknowns, and of that of a facet.
  bool deformable() const { return deformable_; }
  bool moves(int facet) const { return surfaces_[surface_of(facet)].deformable(); }
  mesh::FacetKind kind(int facet) const { return surfaces_[surface_of(facet)].kind(); }
  const FacetDomain& domain(int facet) const { return surfaces_[surface_of(facet)].domain(); }
  /// m, of the surface with the longest and with the shortest edges.
  double longest_mean_edge() const;
  double shortest_mean_edge() const;
  /// Entry of a component of a node; of a surface that moves only.
  int entry(int node, int component) const;
  /// Node numbers, -1 in the slots that the kind does not use.
  const mesh::FacetNodeNumbers& nodes_of(int facet) const { return nodes_[facet]; }
  /// Neighbour in the same surface across each edge of the domain; -1 on its border.
  const std::vector<int>& neighbours(int facet) const { return neighbours_[facet]; }
  FacetNodes positions(const State& state, int facet) const;

  /// Boxes of the surfaces as they are; null where bones have moved nothing, and the reference serves.
  using Trees = std::shared_ptr<const std::vector<fem::BoxTree>>;
  Trees trees(const State& state) const;
  /// The first surface that x faces.
  Site find(const State& state, const Eigen::Vector3d& x, const Trees& trees = {}) const;
  /// Follows x over its surface as long as it faces it, else looks for it anew. A point changes over to another surface where
  /// its triangle is cut again.
  Site follow(const State& state, const Eigen::Vector3d& x, const Site& last, const Trees& trees = {}) const;

 private:
  void number_through();
  Site shifted(int surface, Site site) const;

  std::vector<MasterSurface> surfaces_;
  std::vector<int> first_facet_, first_node_;  ///< one more than surfaces
  std::vector<mesh::FacetNodeNumbers> nodes_;
  std::vector<std::vector<int>> neighbours_;
  bool deformable_ = false;
};

}  // namespace snug::solver
