#include "mesh/body/stations.hpp"

#include <fmt/format.h>

#include <fstream>
#include <map>
#include <sstream>

#include "mesh/body/elliptic_outline.hpp"

namespace snug::mesh {

namespace {

using input::InputError;
using input::Location;

struct Row {
  std::map<std::string, double> value;  // SI
  Location where;
};

struct Column {
  std::string name;
  double unit = 1.0;
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\""), last = text.find_last_not_of(" \t\r\"");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

Column parse_column(const std::string& cell, const Location& where) {
  const auto open = cell.find('['), close = cell.find(']');
  Column column{trimmed(cell.substr(0, open))};
  if (open == std::string::npos || close == std::string::npos) return column;
  const std::string unit = trimmed(cell.substr(open + 1, close - open - 1));
  const std::map<std::string, double> units = {{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}};
  if (!units.contains(unit)) throw InputError(where, "unknown unit [" + unit + "]", "write [mm], [cm] or [m]");
  column.unit = units.at(unit);
  return column;
}

std::vector<Row> read_rows(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError({path}, "the file cannot be opened", "check the name in body.stations");
  std::vector<Column> columns;
  std::vector<Row> rows;
  std::string line, cell;
  for (int number = 1; std::getline(file, line); ++number) {
    if (trimmed(line).empty() || trimmed(line)[0] == '#') continue;
    std::stringstream cells(line);
    const bool header = columns.empty();
    Row row{{}, {path, number, 1}};
    for (std::size_t i = 0; std::getline(cells, cell, ','); ++i) {
      if (header) columns.push_back(parse_column(cell, row.where));
      else if (i < columns.size()) row.value[columns[i].name] = std::stod(cell) * columns[i].unit;
    }
    if (!header) rows.push_back(row);
  }
  return rows;
}

double get(const Row& row, const std::string& name, std::optional<double> otherwise = {}) {
  if (const auto found = row.value.find(name); found != row.value.end()) return found->second;
  if (otherwise) return *otherwise;
  throw InputError(row.where, "column " + name + " is missing", "add the column \"" + name + " [mm]\"");
}

Ellipse section_of(const Row& row, const std::string& girth, const std::string& ratio, const std::string& x,
                   const std::string& y) {
  const double perimeter = get(row, girth), width_to_depth = get(row, ratio, 1.0);
  if (!(perimeter > 0.0))
    throw InputError(row.where, fmt::format("{} of {:g} mm", girth, 1e3 * perimeter), "write a positive girth");
  if (!(width_to_depth > 0.0))
    throw InputError(row.where, fmt::format("{} of {:g}", ratio, width_to_depth), "write a positive ratio (1 = circle)");
  return ellipse_of_girth(get(row, "height"), perimeter, width_to_depth, get(row, x, 0.0), get(row, y, 0.0));
}

}  // namespace

Limb limb_from_stations(const input::BodySpec& spec) {
  const std::string path = spec.stations.string();
  const std::vector<Row> rows = read_rows(path);
  if (rows.size() < 2)
    throw InputError({path}, fmt::format("{} station(s)", rows.size()), "give at least two stations (rows)");
  std::vector<Ellipse> skin, bone;
  for (const Row& row : rows) {
    skin.push_back(section_of(row, "girth", "width_to_depth", "centre_x", "centre_y"));
    bone.push_back(section_of(row, "bone_girth", "bone_width_to_depth", "bone_x", "bone_y"));
    if (skin.size() > 1 && !(skin.back().z > skin[skin.size() - 2].z))
      throw InputError(row.where, fmt::format("height {:g} mm is not above the one before", 1e3 * skin.back().z),
                       "list the stations from below upwards, each height once");
  }
  Limb limb{std::make_unique<EllipticOutline>(skin), std::make_unique<EllipticOutline>(bone), skin.front().z,
            skin.back().z};
  check_bone_inside(limb, {path});
  return limb;
}

}  // namespace snug::mesh
