#include "materials/fabric/inputs.hpp"

#include <algorithm>

namespace snug::materials {
namespace {

Fabric assemble(const TensionCurve& warp, const TensionCurve& weft, double shear, const Sheet& sheet) {
  return {.name = {},
          .warp = warp,
          .weft = weft,
          .coupling = sheet.poisson * std::min(warp.smallest_stiffness(), weft.smallest_stiffness()),
          .shear = shear,
          .bending = sheet.bending_stiffness(),
          .areal_density = sheet.weight,
          .thickness = sheet.thickness,
          .friction = sheet.MIU,
          .source = {}};
}

}  // namespace

Fabric LinearFabric::fabric() const {
  return assemble(TensionCurve::linear(warp), TensionCurve::linear(weft), shear, sheet);
}

Fabric CubicFabric::fabric() const {
  const TensionCurve curve = TensionCurve::cubic(k1, k3, data_end);
  return assemble(curve, curve, shear, sheet);
}

Fabric KesFabric::fabric() const { return assemble(tension.curve(), (weft ? *weft : tension).curve(), G, sheet); }

std::optional<Fabric> KesFabric::unloading_fabric() const {
  const KesTension& across = weft ? *weft : tension;
  if (!tension.RT || !across.RT) return std::nullopt;
  return assemble(tension.unloading_curve(), across.unloading_curve(), G, sheet);
}

}  // namespace snug::materials
