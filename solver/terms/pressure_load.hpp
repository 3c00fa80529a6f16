// A follower pressure on facets of the body or on the garment, scaled by the load parameter.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "mesh/garment/garment_mesh.hpp"
#include "solver/algebra/numbering.hpp"
#include "solver/terms/facet.hpp"
#include "solver/terms/term.hpp"

namespace snug::solver {

/// Force  -s p int N_a n da  on the current surface. Its tangent is symmetric but for a line integral along the border of
/// the surface, p/2 int (du x dv) . dx, which vanishes where the border is held, and where it stays in a plane (of symmetry).
class PressureLoad : public Term {
 public:
  /// `name` is that of the surface; `pressure` in Pa, positive against the outward normal.
  PressureLoad(const Field& positions, const mesh::BodyMesh& mesh, std::string name,
               const std::vector<mesh::FacetNodeNumbers>& facets, double pressure);
  /// On all triangles of a garment, positive against the normal about which they turn counter-clockwise: as on a body, a
  /// negative pressure blows the garment up.
  PressureLoad(const Field& positions, const mesh::GarmentMesh& mesh, double pressure);
  /// The tangent becomes symmetric where the constraints make it so: no border, or one that keeps its place, a line or a
  /// plane.
  void hold_border(const Numbering& numbering);

  std::string name() const override { return "pressure on " + name_; }
  const ElementEntries& entries(const State&) const override { return entries_; }
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  void measure(const State& state, Measure& measure) const override;
  bool symmetric() const override { return symmetric_; }
  bool is_load() const override { return true; }

 private:
  struct Point {
    FacetShape shape;
    double weight = 0.0;
  };
  /// An edge of one facet only.
  struct Border {
    std::vector<int> nodes;        ///< their first entries
    std::array<bool, 3> level;     ///< components that all of its nodes have alike at rest
  };
  void find_border(const std::vector<int>& outline, int nodes_an_edge, const std::function<Eigen::Vector3d(int, int)>& place);
  FacetNodes positions(const State& state, int facet) const;

  std::string name_;
  std::vector<Point> points_;  ///< of every facet
  std::vector<Border> border_;
  bool symmetric_ = false;
  double pressure_;
  ElementEntries entries_;
};

}  // namespace snug::solver
