// Cloth as particles joined by edges, drawn into shape by projection (position based dynamics: Mueller et al., J. Vis.
// Commun. Image R. 18 (2007) 109). It finds a start shape; it carries no forces and knows no units of stiffness.
#pragma once

#include <Eigen/Core>

#include <array>
#include <utility>
#include <vector>

#include "mesh/placement/distance_grid.hpp"

namespace snug::mesh {

/// Triangles with the flat coordinates of their own piece.
struct ClothTriangles {
  std::vector<std::array<int, 3>> nodes;
  std::vector<std::array<Eigen::Vector2d, 3>> flat;  ///< m
};

/// Two particles that are drawn together as a seam closes.
struct Stitching {
  int a = 0, b = 0;
  double gap = 0.0;  ///< m, to which they are drawn now
};

/// Two limbs side by side with little room between them: cloth of the one stays on its side of the middle.
struct LimbGap {
  double top = 0.0, spacing = 1.0;  ///< m; below the height `top` only
  std::vector<double> middle;       ///< m, x by height from the floor on
  std::vector<int> side;            ///< of each particle: 1 larger x, -1 smaller, 0 either
};

/// What one step of the particles is made with.
struct ParticleStep {
  double stiffness = 1.0;     ///< share of an edge's stretch that a sweep takes away
  double compression = 0.05;  ///< the same of its shortening, relative to `stiffness`
  double bending = 0.02;      ///< the same of the distance across an edge, once a step
  double clearance = 0.002;   ///< m, of particles and middles of triangles from the skin
  double friction = 0.5;      ///< share of the way along the skin that a particle in contact is taken back
  int sweeps = 8;
  double farthest = 0.005;  ///< m that a particle moves on by itself
};

class ClothParticles {
 public:
  ClothParticles(std::vector<Eigen::Vector3d> places, ClothTriangles triangles);

  void set_gap(LimbGap gap) { gap_ = std::move(gap); }

  /// Moves on with nine tenths of the last step, then sweeps over edges, stitching and skin.
  void advance(const ParticleStep& step, const std::vector<Stitching>& stitching, const DistanceGrid& body);

  /// Moves particles to the middle of their neighbours, those on an open edge to that of their neighbours along it, and
  /// off the skin.
  void smooth(const std::vector<int>& particles, double clearance, const DistanceGrid& body);

  /// Widens triangles whose smaller principal stretch is below a bound to that bound, one after the other, half way
  /// (strain limiting: Thomaszewski, Pabst and Strasser, Comput. Graph. Forum 28 (2009) 569), and moves their corners
  /// off the skin.
  void widen(const std::vector<int>& triangles, double least, double clearance, const DistanceGrid& body);

  const std::vector<Eigen::Vector3d>& places() const { return places_; }
  std::vector<Eigen::Vector3d>& places() { return places_; }
  const ClothTriangles& triangles() const { return triangles_; }

 private:
  struct Link {
    int a = 0, b = 0;
    double length = 0.0;  // m, flat
    bool open = false;    // has one triangle
  };
  void find_links();
  void pull_edges(const ParticleStep& step);
  void unfold(const ParticleStep& step);
  void stitch(const std::vector<Stitching>& stitching);
  void keep_off(const ParticleStep& step, const DistanceGrid& body, bool middles);
  void keep_apart();

  std::vector<Eigen::Vector3d> places_, before_;
  ClothTriangles triangles_;
  std::vector<Link> edges_, across_;
  LimbGap gap_;
};

}  // namespace snug::mesh
