// The skin as a membrane on the surface nodes of the body.
#pragma once

#include <array>
#include <vector>

#include "materials/laws/skin_membrane.hpp"
#include "mesh/body/body_mesh.hpp"
#include "solver/terms/facet_kind.hpp"
#include "solver/terms/membrane_kernel.hpp"
#include "solver/terms/term.hpp"

namespace snug::solver {

class SkinMembraneTerm : public Term {
 public:
  SkinMembraneTerm(const Field& positions, const mesh::BodyMesh& mesh, const materials::SkinMembrane& law);

  std::string name() const override { return "skin membrane"; }
  const ElementEntries& entries(const State&) const override { return entries_; }
  double energy(const State& state) const override;
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;

 private:
  struct Point {
    Derivatives<9> d;     ///< along an orthonormal frame of the rest surface, 1/m
    double weight = 0.0;  ///< rest area, m2
  };
  struct Element {
    mesh::FacetNodeNumbers nodes;
    std::vector<Point> points;
  };
  materials::MembraneResponse response(const NodeVectors<9>& x, const Point& point) const;
  NodeVectors<9> places(const State& state, const Element& element) const;

  Field positions_;
  materials::SkinMembrane law_;
  std::vector<Element> elements_;
  ElementEntries entries_;
};

}  // namespace snug::solver
