#include "mesh/garment/garment_cut.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "mesh/garment/garment_zones.hpp"
#include "mesh/garment/limb_placement.hpp"
#include "mesh/garment/tube_chart.hpp"
#include "mesh/garment/tube_girth.hpp"
#include "mesh/pattern/read_pattern.hpp"
#include "mesh/pattern/sewn_mesh.hpp"
#include "mesh/pattern/trimming.hpp"

namespace snug::mesh {

namespace {

using input::InputError;

/// Cells that show the shape of a garment: some forty round it.
double coarse_cell(const GarmentCut& cut) {
  const CutSize size = size_of(cut);
  return std::sqrt(size.area / 2500.0);
}

/// How far the limb stretches the garment round it, at least 1, to a thousandth.
double mean_stretch(const GarmentFit& fit, const Limb& limb) {
  return std::round(1e3 * std::max(1.0, mean_fit(fit, limb).stretch)) / 1e3;
}

/// Representatives of an edge of a piece that the garment is held at.
std::vector<int> nodes_of_edge(const SewnMesh& sewn, const std::string& edge) {
  std::vector<int> nodes;
  if (const auto it = sewn.edges.find(edge); it != sewn.edges.end())
    for (const int node : it->second) nodes.push_back(sewn.merged[node]);
  return nodes;
}

void name_edges(const GarmentCut& cut, const SewnMesh& sewn, GarmentMesh& mesh) {
  const auto name = [&](const std::string& edge, const input::Location& where) {
    if (mesh.edges.contains(edge)) return;
    mesh.edges[edge] = nodes_of_edge(sewn, edge);
    if (!mesh.edges[edge].empty()) return;
    std::vector<std::string> names;
    for (const auto& [open, nodes] : sewn.open) names.push_back("\"" + open + "\"");
    throw InputError(where, fmt::format("\"{}\" is no edge of the pattern", edge),
                     fmt::format("its open edges are {}; an edge of a piece is \"piece.edge\"", fmt::join(names, ", ")));
  };
  for (const input::HeldEdge& held : cut.spec.held) name(held.edge, held.where);
  for (const input::BandSpec& band : cut.spec.band) name(band.edge, band.where);
}

}  // namespace

GarmentCut read_cut(const input::GarmentSpec& spec) {
  GarmentCut cut{spec, std::nullopt};
  if (!spec.pattern.sewn()) return cut;
  Pattern pattern = read_pattern(spec.pattern.file);
  check_pieces(pattern);
  if (!spec.pattern.pieces.empty()) pattern = selected(pattern, spec.pattern.pieces, spec.pattern.where);
  if (spec.pattern.from_height > 0.0 || spec.pattern.to_height)
    pattern = trimmed(pattern, spec.pattern.from_height, spec.pattern.to_height.value_or(1e3), spec.pattern.where);
  if (spec.pattern.girth_scale != 1.0 || spec.pattern.length_scale != 1.0)
    pattern = graded(pattern, spec.pattern.girth_scale, spec.pattern.length_scale);
  cut.pattern = checked(std::move(pattern));
  for (input::Diagnostic& warning : settle_fabrics(cut)) cut.pattern->warnings.push_back(std::move(warning));
  return cut;
}

CutSize size_of(const GarmentCut& cut) {
  if (!cut.pattern) {
    const double length = cut.spec.pattern.length, girth = TubeGirth(cut.spec.pattern).mean();
    return {girth * length, 2.0 * (girth + length)};
  }
  CutSize size;
  for (const Piece& piece : cut.pattern->pattern.pieces) size.area += area(piece);
  for (const Stretch& stretch : cut.pattern->sewing.stretches) size.border += stretch.length;
  return size;
}

double rise_of(const GarmentCut& cut) {
  if (!cut.pattern) return cut.spec.pattern.length;
  const TubeChart chart = tube_chart(mesh_pattern(*cut.pattern, coarse_cell(cut)), cut.spec.bottom, cut.spec.where);
  return *std::max_element(chart.up.begin(), chart.up.end());
}

GarmentFit placed_fit(const GarmentCut& cut, const Limb& limb) {
  return cut.pattern ? place_on_limb(mesh_pattern(*cut.pattern, coarse_cell(cut)), cut.spec, limb, 2e-4).fit : tube_fit(cut.spec);
}

GarmentMesh make_garment_mesh(const GarmentCut& cut, const Limb& limb, double worn_size, double lift) {
  if (!cut.pattern) return make_tube_mesh(cut.spec, limb, worn_size, lift);
  // As many triangles as a tube of that size as worn has: stretched one way, they are longer that way and shorter the other.
  const double cell = cut.spec.cell_size > 0.0 ? cut.spec.cell_size : worn_size / std::sqrt(mean_stretch(placed_fit(cut, limb), limb));
  const SewnMesh sewn = mesh_pattern(*cut.pattern, cell);
  LimbPlacement placement = place_on_limb(sewn, cut.spec, limb, lift);
  GarmentMesh mesh = garment_mesh(sewn, placement.placed, cut.spec.name);
  mesh.fit = std::move(placement.fit), mesh.stand_off = placement.stand_off, mesh.order = cut.spec.order;
  if (!cut.spec.zone.empty())
    for (const int piece : sewn.triangle_piece) mesh.triangle_zone.push_back(zone_of_piece(cut.spec, sewn.pieces[piece]));
  name_edges(cut, sewn, mesh);
  return mesh;
}

}  // namespace snug::mesh
