#include "mesh/body/stations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "cases/input/csv.hpp"
#include "cases/input/suggestion.hpp"
#include "mesh/body/elliptic_outline.hpp"

namespace snug::mesh {

namespace {

using input::Csv;
using input::Diagnostics;

struct ColumnSpec {
  std::string name;
  std::string unit;                 // SI; empty for a ratio
  std::optional<double> otherwise;  // value of a column that is left out
  bool positive = false;
};

const std::vector<ColumnSpec>& column_specs() {
  static const std::vector<ColumnSpec> specs = {{"height", "m", {}, false},
                                                {"girth", "m", {}, true},
                                                {"width_to_depth", "", 1.0, true},
                                                {"centre_x", "m", 0.0, false},
                                                {"centre_y", "m", 0.0, false},
                                                {"bone_girth", "m", {}, true},
                                                {"bone_width_to_depth", "", 1.0, true},
                                                {"bone_x", "m", 0.0, false},
                                                {"bone_y", "m", 0.0, false}};
  return specs;
}

void check_known(const Csv& csv, Diagnostics& diagnostics) {
  std::vector<std::string> known;
  for (const auto& spec : column_specs()) known.push_back(spec.name);
  for (const auto& column : csv.columns)
    if (std::find(known.begin(), known.end(), column.name) == known.end())
      diagnostics.error(column.where, fmt::format("the column \"{}\" is not known", column.name),
                        input::did_you_mean(column.name, known));
}

std::vector<double> read_column(const Csv& csv, const ColumnSpec& spec, Diagnostics& diagnostics) {
  if (spec.otherwise && csv.find(spec.name) < 0) return std::vector<double>(csv.rows.size(), *spec.otherwise);
  const auto values = input::numbers(csv, spec.name, spec.unit, diagnostics);
  for (std::size_t r = 0; r < values.size(); ++r) {
    const auto where = csv.place(r, csv.find(spec.name));
    if (!std::isfinite(values[r]))
      diagnostics.error(where, fmt::format("{} is not finite", spec.name), "write a number");
    else if (spec.positive && !(values[r] > 0.0))
      diagnostics.error(where, fmt::format("{} is {:g} {}", spec.name, values[r], spec.unit),
                        "write a value greater than zero");
  }
  return values;
}

void check_heights(const Csv& csv, const std::vector<double>& height, Diagnostics& diagnostics) {
  if (csv.rows.size() == 1)
    diagnostics.error(csv.place(0, 0), "there is only one station", "give at least two, one row a section");
  for (std::size_t r = 1; r < height.size(); ++r)
    if (!(height[r] > height[r - 1]))
      diagnostics.error(csv.place(r, csv.find("height")),
                        fmt::format("height {:g} m is not above the row before ({:g} m)", height[r], height[r - 1]),
                        "list the stations from below upwards, each height once");
}

using Columns = std::map<std::string, std::vector<double>>;

std::unique_ptr<Outline> outline_of(const Columns& column, const std::string& girth, const std::string& ratio,
                                    const std::string& x, const std::string& y) {
  std::vector<Ellipse> sections;
  for (std::size_t r = 0; r < column.at("height").size(); ++r)
    sections.push_back(ellipse_of_girth(column.at("height")[r], column.at(girth)[r], column.at(ratio)[r],
                                        column.at(x)[r], column.at(y)[r]));
  return std::make_unique<EllipticOutline>(sections);
}

}  // namespace

Limb limb_from_stations(const input::BodySpec& spec) {
  Diagnostics diagnostics;
  const Csv csv = input::read_csv(spec.stations, diagnostics);
  diagnostics.throw_if_any();
  check_known(csv, diagnostics);
  Columns column;
  for (const auto& column_spec : column_specs()) column[column_spec.name] = read_column(csv, column_spec, diagnostics);
  check_heights(csv, column.at("height"), diagnostics);
  diagnostics.throw_if_any();
  Limb limb{outline_of(column, "girth", "width_to_depth", "centre_x", "centre_y"),
            outline_of(column, "bone_girth", "bone_width_to_depth", "bone_x", "bone_y"), column.at("height").front(),
            column.at("height").back()};
  check_bone_inside(limb, {csv.file});
  return limb;
}

}  // namespace snug::mesh
