// A follower pressure on facets of the body, scaled by the load parameter.
#pragma once

#include <string>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "solver/terms/term.hpp"

namespace snug::solver {

/// Force  -s p int N_a n da  on the current surface. Its tangent is symmetric up to the border of the surface, which is
/// held or short in most scenes; the symmetric part is assembled.
class PressureLoad : public Term {
 public:
  /// `name` is that of the surface; `pressure` in Pa, positive against the outward normal.
  PressureLoad(const Layout& layout, const mesh::BodyMesh& mesh, std::string name,
               std::vector<mesh::FacetNodeNumbers> facets, double pressure);

  std::string name() const override { return "pressure on " + name_; }
  const ElementEntries& entries() const override { return entries_; }
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  void measure(const State& state, Measure& measure) const override;
  bool is_load() const override { return true; }

 private:
  Layout layout_;
  std::string name_;
  mesh::FacetKind kind_;
  std::vector<mesh::FacetNodeNumbers> facets_;
  double pressure_;
  ElementEntries entries_;
};

}  // namespace snug::solver
