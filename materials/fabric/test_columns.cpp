#include "materials/fabric/test_columns.hpp"

#include <fmt/format.h>

#include "cases/input/units.hpp"

namespace snug::materials {

int column_of(const input::Csv& csv, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (const int column = csv.find(name); column >= 0) return column;
  return -1;
}

std::vector<double> column_in(const input::Csv& csv, int column, const ColumnUnits& units,
                              input::Diagnostics& diagnostics) {
  const input::Csv::Column& head = csv.columns[column];
  double factor = 1.0;
  if (input::unit_factor(head.unit, units.per_specimen, factor))
    return input::numbers(csv, head.name, units.per_specimen, diagnostics);
  std::vector<double> values = input::numbers(csv, head.name, units.as_measured, diagnostics);
  if (!values.empty() && !(units.size > 0.0))
    diagnostics.error(head.where, fmt::format("{} is {} here", head.name, input::dimension_name(units.as_measured)),
                      units.remedy);
  for (double& value : values) value *= units.size > 0.0 ? 1.0 / units.size : 1.0;
  return values;
}

std::vector<std::string> strain_names() {
  return {"strain", "tensile_strain", "elongation", "extension_strain", "engineering_strain", "nominal_strain", "e", "dehnung", "allongement"};
}
std::vector<std::string> extension_names() { return {"extension", "displacement", "crosshead", "elongation_length", "weg", "traverse", "standardweg"}; }
std::vector<std::string> force_names() { return {"force", "load", "tensile_force", "standard_force", "tension", "f", "kraft", "standardkraft", "zugkraft", "charge"}; }
std::vector<std::string> unloading_names() {
  return {"unloading", "unloading_force", "force_unloading", "recovery", "recovery_force"};
}

}  // namespace snug::materials
