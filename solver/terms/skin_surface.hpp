// The skin as master surface: its facets, their neighbours, and where a garment point meets them.
#pragma once

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "solver/algebra/state.hpp"
#include "solver/terms/facet_kind.hpp"

namespace snug::solver {

/// Where a garment point meets the skin; facet -1: it faces none.
struct Site {
  int facet = -1;
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();
};

class SkinSurface {
 public:
  /// `deformable`: nodes move with the state (body entries of the layout); otherwise they stand at their reference place.
  SkinSurface(const Layout& layout, const mesh::BodyMesh& mesh, bool deformable);
  ~SkinSurface();

  bool deformable() const { return deformable_; }
  int facets() const { return static_cast<int>(facets_.size()); }
  mesh::FacetKind kind() const { return kind_; }
  const FacetDomain& domain() const { return *domain_; }
  /// Node numbers, -1 in the slots that the kind does not use.
  const mesh::FacetNodeNumbers& nodes_of(int facet) const { return facets_[facet]; }
  FacetNodes positions(const State& state, int facet) const;
  /// Neighbour across each edge of the domain; -1 on the border.
  const std::vector<int>& neighbours(int facet) const { return neighbours_[facet]; }

  /// Global search for the facet nearest to x: a tree of bounding boxes of the reference surface, then projection.
  Site find(const State& state, const Eigen::Vector3d& x) const;
  /// Follows x from the last site over neighbouring facets; falls back on `find`.
  Site follow(const State& state, const Eigen::Vector3d& x, const Site& last) const;

 private:
  struct Tree;
  /// Walks from `site` to the facet that x projects into; the first facet may be left by `stay` without leaving it.
  bool settle(const State& state, const Eigen::Vector3d& x, double stay, Site& site) const;
  void connect();

  Layout layout_;
  bool deformable_;
  mesh::FacetKind kind_;
  const FacetDomain* domain_;
  std::vector<mesh::FacetNodeNumbers> facets_;
  std::vector<std::vector<int>> neighbours_;
  std::vector<Eigen::Vector3d> reference_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace snug::solver
