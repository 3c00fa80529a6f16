// A follower pressure on the skin, scaled by the load parameter.
#pragma once

#include <array>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "solver/terms/term.hpp"

namespace snug::solver {

/// Force  -s p int N_a n da  on the current surface. Its tangent is symmetric up to the border of the surface, where the
/// sliding cut planes hold the virtual displacement; the symmetric part is assembled.
class SkinPressureLoad : public Term {
 public:
  SkinPressureLoad(const Layout& layout, const mesh::BodyMesh& mesh, double pressure);

  std::string name() const override { return "skin pressure"; }
  const ElementEntries& entries() const override { return entries_; }
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  void measure(const State& state, Measure& measure) const override;

 private:
  Layout layout_;
  double pressure_;
  std::vector<std::array<int, 9>> facets_;
  ElementEntries entries_;
};

}  // namespace snug::solver
