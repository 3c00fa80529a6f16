#include "cases/input/garment_checks.hpp"

#include <fmt/format.h>

#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "cases/input/suggestion.hpp"
#include "cases/input/units.hpp"

namespace snug::input {

namespace {

constexpr const char* position_missing = "the key position is missing";
constexpr const char* position_remedy = "add position: height of the lowest point as placed, e.g. \"0.1 m\"";

/// Crotch, shoulders and waist tell where a garment is worn.
bool may_branch(const BodySpec& body) { return body.kind != BodyKind::stations; }

void check_tube(const GarmentSpec& garment, const Table* pattern, Diagnostics& diagnostics) {
  const PatternSpec& tube = garment.pattern;
  const auto missing = [&](const char* key, const char* meaning, const char* example) {
    if (pattern && !pattern->find(key))
      diagnostics.error(tube.where, fmt::format("the key {} is missing", key),
                        fmt::format("add {}: {} of the tube as cut, e.g. \"{}\"; or name a sewing pattern: pattern = \"FILE\"", key, meaning, example));
  };
  if (!tube.graduated()) missing("flat_circumference", "circumference", "400 mm");
  missing("length", "length", "200 mm");
  if (!garment.bottom.empty())
    diagnostics.error(garment.where, "bottom is for sewing patterns; a tube has its lower edge", "leave it out");
  for (const auto& [scale, key, size] : {std::tuple{tube.girth_scale, "girth_scale", "circumference"}, std::tuple{tube.length_scale, "length_scale", "length"}})
    if (scale != 1.0) diagnostics.error(tube.where, fmt::format("{} is of the drawings of a pattern, and this is a tube", key), fmt::format("change its {}", size));
}

/// Rows from below, within the tube.
template <class Row>
void check_rows(const std::vector<Row>& rows, const char* key, double length, Diagnostics& diagnostics) {
  if (rows.size() == 1) diagnostics.error(rows.front().where, fmt::format("{} has one row", key), "give at least two heights");
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (r > 0 && !(rows[r].height > rows[r - 1].height))
      diagnostics.error(rows[r].where, fmt::format("{}: the height {:.4g} mm is not above the {:.4g} mm before it", key, 1e3 * rows[r].height, 1e3 * rows[r - 1].height),
                        "list the heights from the lower edge up, each once");
    if (length > 0.0 && rows[r].height > length * (1.0 + 1e-9))
      diagnostics.error(rows[r].where, fmt::format("{}: the height {:.4g} mm is above the upper edge at {:.4g} mm", key, 1e3 * rows[r].height, 1e3 * length),
                        "heights count from the lower edge of the tube; look at its length");
  }
}

void check_graduated(const GarmentSpec& garment, Diagnostics& diagnostics) {
  const PatternSpec& tube = garment.pattern;
  if (tube.flat_circumference != 0.0)
    diagnostics.error(tube.where, "flat_circumference is of a tube that is as wide everywhere, and this one is graduated", "write circumferences, or kind = \"tube\"");
  if (tube.circumferences.empty() && tube.pressures.empty())
    diagnostics.error(tube.where, "a graduated tube has neither circumferences nor pressures",
                      "add circumferences = [{ height = \"0 mm\", girth = \"180 mm\" }, …], or the pressures that it is made for");
  if (garment.warp != WarpDirection::along)
    diagnostics.error(garment.where, "warp is around, and what is knitted round has its wales along", "leave it out");
  check_rows(tube.circumferences, "circumferences", tube.length, diagnostics);
  check_rows(tube.pressures, "pressures", tube.length, diagnostics);
}

void check_not_graduated(const GarmentSpec& garment, Diagnostics& diagnostics) {
  const PatternSpec& pattern = garment.pattern;
  if (!pattern.circumferences.empty() || !pattern.pressures.empty())
    diagnostics.error(pattern.where, fmt::format("{} are of a graduated tube", pattern.circumferences.empty() ? "pressures" : "circumferences"), "add kind = \"graduated\", or leave them out");
}

/// Of a tube: stretches of its height that do not overlap.
void check_heights(const GarmentSpec& garment, Diagnostics& diagnostics) {
  const double length = garment.pattern.length;
  std::vector<std::pair<double, double>> taken;
  for (const ZoneSpec& zone : garment.zone) {
    if (!zone.pieces.empty()) diagnostics.error(zone.where, "a zone names pieces, and a tube has none", "write from_height and to_height");
    const double from = zone.from_height, to = zone.to_height.value_or(length);
    if (length > 0.0 && (!(to > from) || to > length * (1.0 + 1e-9)))
      diagnostics.error(zone.where, fmt::format("a zone goes from {:.4g} to {:.4g} mm of a tube of {:.4g} mm", 1e3 * from, 1e3 * to, 1e3 * length),
                        "write heights over the lower edge, the lower one first");
    for (const auto& [low, high] : taken)
      if (from < high - 1e-9 && to > low + 1e-9) diagnostics.error(zone.where, "two zones overlap", "let one end where the other begins");
    taken.emplace_back(from, to);
  }
}

void check_zones(const GarmentSpec& garment, Diagnostics& diagnostics) {
  if (!garment.pattern.sewn()) return check_heights(garment, diagnostics);
  for (const ZoneSpec& zone : garment.zone) {
    if (zone.pieces.empty()) diagnostics.error(zone.where, "a zone of a sewn garment names no pieces", "add pieces = [\"front\"]");
    if (zone.from_height != 0.0 || zone.to_height)
      diagnostics.error(zone.where, "a zone of a sewn garment has heights, which are of a tube", "name its pieces; a piece is of one fabric");
  }
}

void check_sewn(const GarmentSpec& garment, Diagnostics& diagnostics) {
  const PatternSpec& sewn = garment.pattern;
  if (sewn.file.empty() && diagnostics.errors().empty()) diagnostics.error(sewn.where, "a sewn pattern names no file", "add file = \"patterns/vest.toml\"");
  if (garment.warp != WarpDirection::along)
    diagnostics.error(garment.where, "warp is of a tube, and the pieces of a pattern have their grain", "leave it out; give the pieces another grain");
  for (const auto& [size, key] : {std::pair{sewn.flat_circumference, "flat_circumference"}, std::pair{sewn.length, "length"}})
    if (size != 0.0) diagnostics.error(sewn.where, fmt::format("{} is of a tube, and there is a file", key), "leave it out; girth_scale and length_scale change the pattern");
}

void check_held(const GarmentSpec& garment, Diagnostics& diagnostics) {
  std::set<std::string> seen;
  for (const HeldEdge& held : garment.held)
    if (!garment.pattern.sewn() && held.edge != "upper" && held.edge != "lower" && !held.edge.empty())
      diagnostics.error(held.where, fmt::format("\"{}\" is no edge", held.edge), did_you_mean(held.edge, {"upper", "lower"}));
  for (const HeldEdge& held : garment.held)
    if (!seen.insert(held.edge).second && !held.edge.empty())
      diagnostics.error(held.where, fmt::format("the {} edge is held twice", held.edge), "name each edge once");
}

void check_bands(const GarmentSpec& garment, Diagnostics& diagnostics) {
  std::set<std::string> seen;
  for (const BandSpec& band : garment.band) {
    if (!seen.insert(band.edge).second && !band.edge.empty())
      diagnostics.error(band.where, fmt::format("the {} edge has two bands", band.edge), "name each edge once");
    if (band.rest_length.empty()) continue;
    const auto length = rest_length(band, 1.0);
    if (!length)
      diagnostics.error(band.where, fmt::format("rest_length \"{}\" is neither a percentage nor a length", band.rest_length),
                        "write how much shorter than the edge as cut it is, \"-8 %\", or how long, \"310 mm\"");
    else if (!(*length > 0.0))
      diagnostics.error(band.where, fmt::format("rest_length \"{}\" leaves nothing of the band", band.rest_length), "write more than -100 %");
  }
}

}  // namespace

std::optional<double> rest_length(const BandSpec& band, double pattern_length) {
  if (const Quantity length = to_si(band.rest_length, "m"); length.ok()) return length.value;
  if (const Quantity percent = to_si(band.rest_length, "%"); percent.ok()) return pattern_length * (1.0 + 0.01 * percent.value);
  return {};
}

double lowest_point(const GarmentSpec& garment) {
  if (garment.position) return *garment.position;
  throw InputError(garment.where, position_missing, position_remedy);
}

const Table* garment_table(const Table& root, std::size_t garment) {
  const Value* garments = root.find("garment");
  const bool list = garments && garments->array() && garment < garments->array()->size();
  return list ? (*garments->array())[garment].table() : root.table("garment");
}

void check_garments(const Case& c, const Table& root, Diagnostics& diagnostics) {
  std::set<std::string> names;
  for (std::size_t g = 0; g < c.garments.size(); ++g) {
    const GarmentSpec& garment = c.garments[g];
    const Table* table = garment_table(root, g);
    garment.pattern.sewn() ? check_sewn(garment, diagnostics) : check_tube(garment, table ? table->table("pattern") : nullptr, diagnostics);
    garment.pattern.graduated() ? check_graduated(garment, diagnostics) : check_not_graduated(garment, diagnostics);
    check_zones(garment, diagnostics);
    if (!garment.pattern.sewn() && table && !table->find("fabric"))
      diagnostics.error(garment.where, "the key fabric is missing", "add fabric: an entry of snug materials list or a table of values");
    if (table && !table->find("position") && !(c.body && may_branch(*c.body))) diagnostics.error(garment.where, position_missing, position_remedy);
    check_held(garment, diagnostics);
    check_bands(garment, diagnostics);
    if (!names.insert(garment.name).second)
      diagnostics.error(garment.where, fmt::format("a second garment is called \"{}\"", garment.name),
                        "give each garment a name of its own: name = \"band\"");
    if (garment.name == "body" || garment.name.empty())
      diagnostics.error(garment.where, fmt::format("a garment is called \"{}\"", garment.name), "give it another name");
  }
}

}  // namespace snug::input
