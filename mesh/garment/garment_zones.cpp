#include "mesh/garment/garment_zones.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "cases/input/suggestion.hpp"

namespace snug::mesh {

namespace {

using input::InputError;
using input::MaterialEntry;

bool given(const MaterialEntry& fabric) { return !fabric.name.empty() || fabric.is_inline(); }

/// One entry of the data, or one table in one place (which mirrored pieces share).
bool same(const MaterialEntry& a, const MaterialEntry& b) {
  if (a.is_inline() != b.is_inline()) return false;
  if (a.is_inline()) return a.where.file == b.where.file && a.where.line == b.where.line && a.where.column == b.where.column;
  return a.name == b.name;
}

std::string text_of(const MaterialEntry& fabric) { return fabric.name.empty() ? "of its own values" : "\"" + fabric.name + "\""; }

/// What pieces name that name nothing of their own: the pattern's fabric, or the one that all of them name.
std::optional<MaterialEntry> common_fabric(const Pattern& pattern) {
  if (pattern.fabric) return pattern.fabric;
  const std::optional<MaterialEntry>& first = pattern.pieces.front().fabric;
  const auto alike = [&](const Piece& piece) { return first && piece.fabric && same(*piece.fabric, *first); };
  return std::all_of(pattern.pieces.begin(), pattern.pieces.end(), alike) ? first : std::nullopt;
}

void check_zones(const input::GarmentSpec& spec, const Pattern& pattern) {
  std::set<std::string> seen;
  for (const input::ZoneSpec& zone : spec.zone)
    for (const std::string& piece : zone.pieces) {
      std::vector<std::string> names;
      for (const Piece& one : pattern.pieces) names.push_back(one.name);
      if (pattern.find(piece) < 0) throw InputError(zone.where, fmt::format("\"{}\" is no piece of the pattern", piece), input::did_you_mean(piece, names));
      if (!seen.insert(piece).second) throw InputError(zone.where, fmt::format("the piece {} is in two zones", piece), "name each piece once");
    }
}

MaterialEntry fabric_of(const input::GarmentSpec& spec, const std::optional<MaterialEntry>& common, const Piece& piece) {
  if (const int zone = zone_of_piece(spec, piece.name); zone >= 0) return spec.zone[zone].fabric;
  if (piece.fabric && !(common && same(*piece.fabric, *common))) return *piece.fabric;
  if (given(spec.fabric)) return spec.fabric;
  if (common) return *common;
  throw InputError(spec.where, "the key fabric is missing, and the pattern has none", "add fabric: an entry of snug materials list or a table of values");
}

}  // namespace

int zone_of_piece(const input::GarmentSpec& spec, const std::string& piece) {
  for (std::size_t z = 0; z < spec.zone.size(); ++z)
    if (std::find(spec.zone[z].pieces.begin(), spec.zone[z].pieces.end(), piece) != spec.zone[z].pieces.end()) return static_cast<int>(z);
  return -1;
}

std::vector<input::Diagnostic> settle_fabrics(GarmentCut& cut) {
  const Pattern& pattern = cut.pattern->pattern;
  check_zones(cut.spec, pattern);
  const std::optional<MaterialEntry> common = common_fabric(pattern);
  std::vector<input::ZoneSpec> zones;
  for (const Piece& piece : pattern.pieces) {
    const MaterialEntry fabric = fabric_of(cut.spec, common, piece);
    auto zone = std::find_if(zones.begin(), zones.end(), [&](const input::ZoneSpec& one) { return same(one.fabric, fabric); });
    if (zone == zones.end()) zone = zones.insert(zones.end(), {.pieces = {}, .from_height = 0.0, .to_height = {}, .fabric = fabric, .where = fabric.where});
    zone->pieces.push_back(piece.name);
  }
  std::vector<input::Diagnostic> warnings;
  MaterialEntry& own = cut.spec.fabric;
  const auto worn = [&](const MaterialEntry& fabric) { return std::any_of(zones.begin(), zones.end(), [&](const auto& zone) { return same(zone.fabric, fabric); }); };
  if (!own.name.empty() && !worn(own))
    warnings.push_back({own.where, fmt::format("no piece is of the garment's fabric {}", text_of(own)), "the pieces have fabrics of their own: leave it out, or leave theirs out"});
  if (!given(own) || !worn(own)) own = zones.front().fabric;
  cut.spec.zone = zones.size() > 1 ? std::move(zones) : std::vector<input::ZoneSpec>{};
  return warnings;
}

}  // namespace snug::mesh
