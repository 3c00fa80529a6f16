#include "materials/fabric/raw_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/input/suggestion.hpp"
#include "materials/fabric/test_columns.hpp"

namespace snug::materials {

namespace {

using input::InputError;
using Names = std::vector<std::string>;

const Names angle_names = {"angle", "shear_angle", "shear", "phi", "shear_strain"};
const Names shear_force_names = {"force", "shear_force", "load", "fs", "f"};
const Names curvature_names = {"curvature", "kappa", "k"};
const Names moment_names = {"moment", "bending_moment", "m"};
const Names thickness_names = {"thickness", "t", "height", "gap"};
const Names pressure_names = {"pressure", "compressive_stress", "p"};
const Names distance_names = {"distance", "displacement", "position", "length", "l", "x"};
const Names friction_names = {"friction", "coefficient_of_friction", "friction_coefficient", "mu", "miu"};
const Names height_names = {"height", "roughness", "surface_height", "thickness_variation", "z"};

/// The columns of a kind of test, and what they count in.
struct Form {
  TestKind kind;
  Names x, y;
  ColumnUnits x_units, y_units;
};

ColumnUnits plain(const std::string& unit) {
  return {.as_measured = unit, .size = 1.0, .per_specimen = unit, .remedy = {}};
}

std::vector<Form> forms(const Specimen& specimen) {
  const ColumnUnits per_width{
      .as_measured = "N", .size = specimen.width, .per_specimen = "N/m", .remedy = specimen.width_remedy};
  const ColumnUnits moment{
      .as_measured = "N m", .size = specimen.width, .per_specimen = "N", .remedy = specimen.width_remedy};
  return {{TestKind::shear, angle_names, shear_force_names, plain("rad"), per_width},
          {TestKind::bending, curvature_names, moment_names, plain("1/m"), moment},
          {TestKind::compression, thickness_names, pressure_names, plain("m"), plain("Pa")},
          {TestKind::friction, distance_names, friction_names, plain("m"), plain("1")},
          {TestKind::roughness, distance_names, height_names, plain("m"), plain("m")}};
}

/// Ratios need no unit, or have [1] or [-].
std::vector<double> values_of(const input::Csv& csv, int column, const ColumnUnits& units,
                              input::Diagnostics& diagnostics) {
  const std::string& unit = csv.columns[column].unit;
  const bool is_ratio = unit == "1" || unit == "-" || (unit.empty() && units.as_measured == "1");
  if (is_ratio && units.per_specimen == "1")
    return input::column_numbers(csv, static_cast<std::size_t>(column), diagnostics);
  return column_in(csv, column, units, diagnostics);
}

/// What stands in a column of the way back beside that of the way up, behind it and in reverse.
void append_way_back(const std::vector<double>& x, const std::vector<double>& y, std::vector<Sample>& samples) {
  const auto turn =
      std::max_element(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.y < b.y; }) -
      samples.begin();
  samples.resize(static_cast<std::size_t>(turn) + 1);
  for (std::size_t r = samples.size(); r-- > 0;) samples.push_back({x[r], y[r], samples[r].line});
}

RawTest assembled(TestKind kind, const input::Csv& csv, int x_column, const ColumnUnits& x_units, int y_column,
                  const ColumnUnits& y_units) {
  input::Diagnostics diagnostics;
  const std::vector<double> x = values_of(csv, x_column, x_units, diagnostics),
                            y = values_of(csv, y_column, y_units, diagnostics);
  const int back_column = column_of(csv, unloading_names());
  const std::vector<double> back =
      back_column < 0 ? std::vector<double>{} : values_of(csv, back_column, y_units, diagnostics);
  diagnostics.throw_if_any();
  RawTest test{.kind = kind, .samples = {}, .where = {csv.file, 0, 0}};
  for (std::size_t r = 0; r < x.size(); ++r) test.samples.push_back({x[r], y[r], csv.rows[r].line});
  if (back_column >= 0) append_way_back(x, back, test.samples);
  return test;
}

bool is_tensile(const input::Csv& csv) {
  return (column_of(csv, strain_names()) >= 0 || column_of(csv, extension_names()) >= 0) &&
         column_of(csv, force_names()) >= 0;
}

Names heads(const input::Csv& csv) {
  Names names;
  for (const input::Csv::Column& column : csv.columns)
    names.push_back(column.unit.empty() ? column.name : column.name + " [" + column.unit + "]");
  return names;
}

/// "force_N", "strain %": units that stand in the names.
input::Csv with_units(input::Csv csv) {
  Names known;
  for (const Names& names : {strain_names(), extension_names(), force_names(), unloading_names(), angle_names, shear_force_names, curvature_names, moment_names, thickness_names,
                             pressure_names, distance_names, height_names})
    known.insert(known.end(), names.begin(), names.end());
  input::take_units_from_names(csv, known);
  return csv;
}

}  // namespace

RawTest tensile_test(const input::Csv& table, const Specimen& specimen) {
  const input::Csv csv = with_units(table);
  const int relative = column_of(csv, strain_names()), absolute = column_of(csv, extension_names());
  const int strain = relative >= 0 ? relative : absolute, force = column_of(csv, force_names());
  if (strain < 0 || force < 0)
    throw InputError({csv.file, csv.columns[0].where.line, 1},
                     fmt::format("the table has no column {}", strain < 0 ? "strain or extension" : "force or load"),
                     "name them so, e.g. strain [%], force [N]");
  if (csv.columns[strain].unit.empty() && relative >= 0)
    throw InputError(csv.columns[strain].where, fmt::format("{} has no unit", csv.columns[strain].name),
                     "write strain [%], or strain [1] where 1 is 100 %");
  return assembled(
      TestKind::tensile, csv, strain,
      {.as_measured = "m", .size = specimen.gauge_length, .per_specimen = "1", .remedy = specimen.gauge_remedy}, force,
      {.as_measured = "N", .size = specimen.width, .per_specimen = "N/m", .remedy = specimen.width_remedy});
}

RawTest read_test(const std::filesystem::path& file, const Specimen& specimen) {
  input::Diagnostics diagnostics;
  const input::Csv csv = with_units(input::read_csv(file, diagnostics));
  diagnostics.throw_if_any();
  for (const Form& form : forms(specimen)) {
    const int x = column_of(csv, form.x), y = column_of(csv, form.y);
    if (x >= 0 && y >= 0 && x != y) return assembled(form.kind, csv, x, form.x_units, y, form.y_units);
  }
  if (is_tensile(csv)) return tensile_test(csv, specimen);
  throw InputError({csv.file, csv.columns[0].where.line, 1},
                   "the columns " + input::joined(heads(csv)) + " are those of no test that is known",
                   "name two of them strain [%] and force [gf/cm], angle [deg] and force [gf/cm], curvature [1/cm] and "
                   "moment [gf cm/cm], thickness [mm] and "
                   "pressure [gf/cm2], distance [mm] and friction, or distance [mm] and height [um]");
}

}  // namespace snug::materials
