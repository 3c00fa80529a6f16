#include "solver/scene/friction_choice.hpp"

namespace snug::solver {

FrictionChoice friction_choice(const std::optional<double>& given, const materials::Fabric& fabric) {
  if (given) return {*given, "the case", true};
  if (fabric.friction) return {*fabric.friction, "MIU of " + fabric.name};
  return {usual_friction, "not in the case: textiles on dry skin have 0.2 to 0.6"};
}

}  // namespace snug::solver
