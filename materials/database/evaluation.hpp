// Data that follow from other data of their entity: equations and tables, evaluated when they are asked for.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "materials/database/datum.hpp"

namespace snug::materials {

/// Parses every equation of the entity, and checks that its symbols are data of the entity, that it comes to the
/// dimension of its unit, and that it needs itself neither at once nor by others. Then fills `si` of those that need no
/// state variable. Reports at the entity.
void check_equations(Entity& entity, UnitBook& units, input::Diagnostics& diagnostics);

/// Numbers in place of those of the data, and of state variables (data without a value): symbol or name to a quantity
/// as text, "310 K".
using Given = std::map<std::string, std::string>;

struct Evaluated {
  double si = 0.0;
  std::string si_unit;
  double in_unit = 0.0;  ///< in the datum's own unit
  const Datum* datum = nullptr;
};

/// The item of an entity: its equation when it has one, else its table (at the point that `given` names its first
/// column with), else its value. `content` gives the file of a table by its hash. Throws input::InputError where the
/// item is not there, where a state variable is not given, where a given number has another dimension, and where the
/// result is no finite number.
Evaluated evaluate(const Entity& entity, const std::string& item, const Given& given, UnitBook& units,
                   const std::function<std::string(const std::string& hash)>& content);

}  // namespace snug::materials
