#include "mesh/body/stations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "cases/input/csv.hpp"
#include "cases/input/suggestion.hpp"
#include "cases/input/units.hpp"
#include "mesh/body/elliptic_outline.hpp"
#include "mesh/body/usual_bone.hpp"

namespace snug::mesh {

namespace {

using input::Csv;
using input::Diagnostics;

struct ColumnSpec {
  std::string name;
  std::string unit;                 // SI; empty for a ratio
  std::optional<double> otherwise;  // value of a column that is left out
  bool positive = false;
  std::vector<std::string> also = {};  // names that people give it
};

const std::vector<ColumnSpec>& column_specs() {
  static const std::vector<ColumnSpec> specs = {{"height", "m", {}, false, {"h", "z", "level", "position", "distance", "height_above_floor", "axial_position", "höhe", "hoehe", "hauteur", "altezza", "altura"}},
                                                {"girth", "m", {}, true, {"circumference", "circ", "perimeter", "skin_girth", "girths", "circumferences", "umfang", "tour", "circonférence", "circonference", "circonferenza", "contorno", "perímetro"}},
                                                {"width_to_depth", "", 1.0, true, {"ratio", "aspect_ratio"}},
                                                {"centre_x", "m", 0.0, false, {"center_x"}},
                                                {"centre_y", "m", 0.0, false, {"center_y"}},
                                                {"bone_girth", "m", {}, true, {"bone_circumference", "bone_perimeter"}},
                                                {"bone_width_to_depth", "", 1.0, true, {"bone_ratio", "bone_aspect_ratio"}},
                                                {"bone_x", "m", 0.0, false, {}},
                                                {"bone_y", "m", 0.0, false, {}}};
  return specs;
}

/// Columns under the names that are asked for.
void rename(Csv& csv) {
  std::vector<std::string> names;
  for (const ColumnSpec& spec : column_specs()) names.push_back(spec.name), names.insert(names.end(), spec.also.begin(), spec.also.end());
  input::take_units_from_names(csv, names);
  for (const ColumnSpec& spec : column_specs()) {
    if (const int known = csv.find(spec.name); known >= 0) {
      csv.columns[known].name = spec.name;
      continue;
    }
    for (const std::string& name : spec.also)
      if (const int found = csv.find(name); found >= 0) {
        csv.columns[found].name = spec.name;
        break;
      }
  }
}

void check_known(const Csv& csv, Diagnostics& diagnostics) {
  std::vector<std::string> known;
  for (const auto& spec : column_specs()) known.push_back(spec.name);
  for (const auto& column : csv.columns)
    if (std::find(known.begin(), known.end(), column.name) == known.end())
      diagnostics.error(column.where, fmt::format("the column \"{}\" is not known", column.name),
                        column.name.find("iamet") != std::string::npos ? "give girths, pi times the diameters of a round section: girth [mm]" : input::did_you_mean(column.name, known));
}

/// Lengths without a unit are not guessed, but what they are likely to be is said.
bool lacks_unit(const Csv& csv, const ColumnSpec& spec, Diagnostics& diagnostics) {
  const int index = csv.find(spec.name);
  if (spec.unit != "m" || index < 0 || !csv.columns[index].unit.empty()) return false;
  Diagnostics unread;
  const std::vector<double> values = input::column_numbers(csv, index, unread);
  const double most = values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
  const char* likely = most > 150.0 ? "mm" : most > 15.0 ? "cm" : most > 0.1 && most < 2.0 ? "m" : "cm";
  const std::string hint = spec.name.ends_with("girth") ? fmt::format("; {:g} would be a girth in {}", most, likely) : "";
  diagnostics.error(csv.columns[index].where, fmt::format("the column {} has no unit", spec.name), fmt::format("give a length in the head, e.g. {} [{}]{}", spec.name, likely, hint));
  return true;
}

std::vector<double> read_column(const Csv& csv, const ColumnSpec& spec, Diagnostics& diagnostics) {
  if (lacks_unit(csv, spec, diagnostics)) return {};
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

/// Rows may go upwards or downwards.
void check_heights(const Csv& csv, const std::vector<double>& height, Diagnostics& diagnostics) {
  if (csv.rows.size() == 1)
    diagnostics.error(csv.place(0, 0), "there is only one station", "give at least two, one row a section");
  const bool downwards = height.size() > 1 && height.back() < height.front();
  for (std::size_t r = 1; r < height.size(); ++r)
    if (!(downwards ? height[r] < height[r - 1] : height[r] > height[r - 1]))
      diagnostics.error(csv.place(r, csv.find("height")),
                        fmt::format("height {:g} m is not {} the row before ({:g} m)", height[r], downwards ? "below" : "above", height[r - 1]),
                        "list the stations in the order of their heights, each height once");
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

/// A girth between those of the rows around it, or beside the next one at an end.
double expected_girth(const std::vector<double>& height, const std::vector<double>& girth, std::size_t r) {
  if (r == 0) return girth[1];
  if (r + 1 == girth.size()) return girth[r - 1];
  const double share = (height[r] - height[r - 1]) / (height[r + 1] - height[r - 1]);
  return girth[r - 1] + share * (girth[r + 1] - girth[r - 1]);
}

constexpr double odd_jump = 1.8, impossible_jump = 4.0;  // of a girth over what its neighbours let expect

/// How many powers of ten each girth stands over the first one, by the jumps from row to row that no body makes.
std::vector<int> powers_of_ten(const std::vector<double>& girth) {
  std::vector<int> powers(girth.size(), 0);
  for (std::size_t r = 1; r < girth.size(); ++r) {
    const double over = girth[r] / girth[r - 1];
    const bool jump = std::max(over, 1.0 / over) > impossible_jump;
    powers[r] = powers[r - 1] + (jump ? static_cast<int>(std::round(std::log10(over))) : 0);
  }
  return powers;
}

constexpr double least_girth = 0.03, most_girth = 2.5;  // m, of any part of a body

/// The power of ten at which no girth is larger than a body's; of several such that of most rows, and then one at which none is very small (bones may be).
int right_power(const std::vector<double>& girth, const std::vector<int>& powers) {
  std::map<int, std::tuple<bool, int, bool>> votes;  // not too large, rows, not too small
  for (std::size_t r = 0; r < girth.size(); ++r) {
    auto& [below, rows, above] = votes.try_emplace(powers[r], true, 0, true).first->second;
    below = below && girth[r] <= most_girth, above = above && girth[r] >= least_girth;
    ++rows;
  }
  return std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first;
}

/// Several girths with the same slip confirm each other, so that the right rows beside them seem to stand out. True where some were found.
bool check_slips_of_several(const Csv& csv, const std::vector<double>& girth, const std::string& name, Diagnostics& diagnostics) {
  const std::vector<int> powers = powers_of_ten(girth);
  const int right = right_power(girth, powers);
  if (std::count(powers.begin(), powers.end(), right) + 1 >= static_cast<std::ptrdiff_t>(girth.size())) return false;
  for (std::size_t r = 0; r < girth.size(); ++r)
    if (const int off = powers[r] - right; off != 0)
      diagnostics.error(csv.place(r, csv.find(name)), fmt::format("{} is {:.4g} mm, {:g} times what rows around let expect", name, 1e3 * girth[r], std::pow(10.0, off)),
                        fmt::format("a decimal point too far {}: {:.6g} mm?", off > 0 ? "right" : "left", 1e3 * girth[r] / std::pow(10.0, off)));
  return true;
}

/// One girth that stands out of its row is a slip of the pen: ten times too large, two digits changed.
void check_girths(const Csv& csv, const Columns& column, const std::string& name, Diagnostics& diagnostics, std::vector<input::Diagnostic>& remarks) {
  const std::vector<double>&height = column.at("height"), &girth = column.at(name);
  if (girth.size() < 3 || check_slips_of_several(csv, girth, name, diagnostics)) return;
  std::vector<double> sorted = girth;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  const auto factor = [](double over) { return std::max(over, 1.0 / over); };
  std::size_t worst = girth.size();
  for (std::size_t r = 0; r < girth.size(); ++r) {  // a right row beside a wrong one stands out, too, but not from the whole table
    if (factor(girth[r] / expected_girth(height, girth, r)) <= odd_jump) continue;
    if (worst == girth.size() || factor(girth[r] / sorted[sorted.size() / 2]) > factor(girth[worst] / sorted[sorted.size() / 2])) worst = r;
  }
  if (worst == girth.size()) return;
  const double over = girth[worst] / expected_girth(height, girth, worst);
  const auto where = csv.place(worst, csv.find(name));
  const std::string found = fmt::format("{} is {:.4g} mm between rows that let {:.4g} mm expect", name, 1e3 * girth[worst], 1e3 * girth[worst] / over);
  const double tens = std::round(std::log10(over));
  const std::string remedy = tens != 0.0 ? fmt::format("a decimal point too far {}: {:.6g} mm?", tens > 0 ? "right" : "left", 1e3 * girth[worst] / std::pow(10.0, tens))
                                         : "look at the digits of this row";
  if (factor(over) > impossible_jump) diagnostics.error(where, found, remedy);
  else remarks.push_back({where, found, remedy});
}

/// Lengths that no part of a body has: the unit of the head is likely another.
void check_size(const Csv& csv, const Columns& column, const std::string& name, double low, double high, Diagnostics& diagnostics,
                std::vector<input::Diagnostic>& remarks) {
  const std::vector<double>& values = column.at(name);
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double span = name == "height" ? *most - *least : *most;
  if (span >= low && span <= high) return;
  const Csv::Column& head = csv.columns[csv.find(name)];
  double now = 1.0;
  input::unit_factor(head.unit, "m", now);
  std::string remedy = "look at the unit in the head of the column";
  for (const auto& [unit, size] : {std::pair{"mm", 1e-3}, std::pair{"cm", 1e-2}, std::pair{"inch", 0.0254}, std::pair{"m", 1.0}}) {
    const double then = span / now * size;
    if (then < 3.0 * low || then > 0.8 * high || size == now) continue;
    remedy = fmt::format("is the unit [{}] instead of [{}]? it would be {:.4g} mm then", unit, head.unit, 1e3 * then);
    break;
  }
  const std::string found = name == "height" ? fmt::format("the heights reach over {:.4g} m", span) : fmt::format("{} is up to {:.4g} m", name, span);
  const auto row = static_cast<std::size_t>((name == "height" ? std::max_element(values.begin(), values.end()) : most) - values.begin());
  const auto where = csv.place(row, csv.find(name));
  if (span > 4.0 * high || span < 0.1 * low) diagnostics.error(where, found, remedy);
  else remarks.push_back({where, found, remedy});
}

/// The table the other way round, where it goes downwards.
void turn_upwards(Columns& column) {
  if (column.at("height").front() < column.at("height").back()) return;
  for (auto& [name, values] : column) std::reverse(values.begin(), values.end());
}

}  // namespace

Limb limb_from_stations(const input::BodySpec& spec) {
  Diagnostics diagnostics;
  Csv csv = input::read_csv(spec.stations, diagnostics);
  diagnostics.throw_if_any();
  rename(csv);
  check_known(csv, diagnostics);
  Columns column;
  std::vector<input::Diagnostic> remarks;
  const bool bone = csv.find("bone_girth") >= 0;
  for (const auto& column_spec : column_specs())
    if (bone || column_spec.name != "bone_girth") column[column_spec.name] = read_column(csv, column_spec, diagnostics);
  check_heights(csv, column.at("height"), diagnostics);
  diagnostics.throw_if_any();
  check_size(csv, column, "girth", least_girth, most_girth, diagnostics, remarks);
  check_size(csv, column, "height", 0.005, 2.5, diagnostics, remarks);
  check_girths(csv, column, "girth", diagnostics, remarks);
  if (bone) check_girths(csv, column, "bone_girth", diagnostics, remarks);
  diagnostics.throw_if_any();
  turn_upwards(column);
  if (!bone) {
    for (const double girth : column.at("girth")) column["bone_girth"].push_back(usual_bone * girth);
    remarks.push_back({{csv.file, csv.columns[0].where.line, 1}, fmt::format("there is no column bone_girth: {:.0f} % of the girth is taken for the bone", 100.0 * usual_bone),
                       usual_bone_remedy("column")});
  }
  Limb limb{outline_of(column, "girth", "width_to_depth", "centre_x", "centre_y"),
            outline_of(column, "bone_girth", "bone_width_to_depth", "bone_x", "bone_y"), column.at("height").front(),
            column.at("height").back()};
  limb.remarks = std::move(remarks);
  check_bone_inside(limb, {csv.file});
  return limb;
}

}  // namespace snug::mesh
