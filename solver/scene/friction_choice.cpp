#include "solver/scene/friction_choice.hpp"

#include "materials/fabric/fabric.hpp"

namespace snug::solver {

FrictionChoice friction_choice(const input::Case& description) {
  if (!description.garment || !description.contact) return {0.0, "no garment in contact"};
  if (description.contact->friction) return {*description.contact->friction, "the case"};
  const materials::Fabric fabric = materials::find_fabric(description.garment->fabric);
  if (fabric.friction) return {*fabric.friction, "MIU of " + fabric.name};
  return {usual_friction, "not in the case: textiles on dry skin have 0.2 to 0.6"};
}

bool has_friction(const input::Case& description) { return friction_choice(description).coefficient > 0.0; }

input::Case without_friction(const input::Case& description) {
  input::Case smooth = description;
  if (smooth.contact) smooth.contact->friction = 0.0;
  return smooth;
}

}  // namespace snug::solver
