// A follower pressure on facets of the body or on the garment, scaled by the load parameter.
#pragma once

#include <string>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "mesh/garment/garment_mesh.hpp"
#include "solver/terms/facet.hpp"
#include "solver/terms/term.hpp"

namespace snug::solver {

/// Force  -s p int N_a n da  on the current surface. The symmetric part of its tangent is assembled; what that leaves out
/// is a line integral along the border of the surface, p/2 int (du x dv) . dx, which vanishes where the border is held,
/// and where it stays in a plane (of symmetry). On a border that is free in space Newton's convergence becomes linear.
class PressureLoad : public Term {
 public:
  /// `name` is that of the surface; `pressure` in Pa, positive against the outward normal.
  PressureLoad(const Layout& layout, const mesh::BodyMesh& mesh, std::string name,
               const std::vector<mesh::FacetNodeNumbers>& facets, double pressure);
  /// On all triangles of a garment, positive against the normal about which they turn counter-clockwise: as on a body, a
  /// negative pressure blows the garment up.
  PressureLoad(const Layout& layout, const mesh::GarmentMesh& mesh, double pressure);

  std::string name() const override { return "pressure on " + name_; }
  const ElementEntries& entries() const override { return entries_; }
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  void measure(const State& state, Measure& measure) const override;
  bool is_load() const override { return true; }

 private:
  struct Point {
    FacetShape shape;
    double weight = 0.0;
  };
  FacetNodes positions(const State& state, int facet) const;

  std::string name_;
  std::vector<Point> points_;  ///< of every facet
  double pressure_;
  ElementEntries entries_;
};

}  // namespace snug::solver
