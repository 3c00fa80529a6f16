#include "mesh/garment/garment_cut.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "mesh/garment/garment_zones.hpp"
#include "mesh/garment/limb_placement.hpp"
#include "mesh/garment/tube_chart.hpp"
#include "mesh/garment/tube_girth.hpp"
#include "mesh/garment/tube_pattern.hpp"
#include "mesh/pattern/read_pattern.hpp"
#include "mesh/pattern/sewn_mesh.hpp"
#include "mesh/pattern/trimming.hpp"
#include "mesh/placement/fit_on_body.hpp"

namespace snug::mesh {

namespace {

using input::InputError;

constexpr double usual_lift = 2e-4;  // m, of make_garment_mesh

/// Cells that show the shape of a garment: some forty round it.
double coarse_cell(const GarmentCut& cut) {
  const CutSize size = size_of(cut);
  return std::sqrt(size.area / 2500.0);
}

/// Cells that a garment is placed on: as fine as those that it is solved on mostly are, since folds between coarse ones remain. Of a tube, which has
/// no seams that pieces would be drawn together by, coarse ones show the shape, and particles shorten it less.
double placing_cell(const GarmentCut& cut) {
  if (!cut.pattern) return coarse_cell(cut);
  const CutSize size = size_of(cut);
  return std::sqrt(size.area / 9000.0);
}

/// How far the body stretches the garment round it, at least 1, to a thousandth.
double mean_stretch(const MeanFit& mean) { return std::round(1e3 * std::max(1.0, mean.stretch)) / 1e3; }

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

/// The solver's mesh of what stands somewhere, however it came there.
GarmentMesh finished(const GarmentCut& cut, const SewnMesh& sewn, const std::vector<Eigen::Vector3d>& placed, GarmentFit fit, double stand_off) {
  GarmentMesh mesh = garment_mesh(sewn, placed, cut.spec.name);
  mesh.fit = std::move(fit), mesh.stand_off = stand_off, mesh.order = cut.spec.order;
  if (!cut.spec.zone.empty())
    for (const int piece : sewn.triangle_piece) mesh.triangle_zone.push_back(zone_of_piece(cut.spec, sewn.pieces[piece]));
  name_edges(cut, sewn, mesh);
  return mesh;
}

/// As many triangles as a tube of that size as worn has: stretched one way, they are longer that way and shorter the other.
double flat_cell(const GarmentCut& cut, double worn_size, double stretch) {
  return cut.spec.cell_size > 0.0 ? cut.spec.cell_size : worn_size / std::sqrt(stretch);
}

/// A garment on a body that branches.
struct OnBody {
  CheckedPattern pattern;
  SewnMesh sewn;
  PlacedGarment placed;
  GarmentFit fit;
};

/// A tube is laid on a body that branches as the flat rectangle that it is, whose courses are of one length.
void check_flat(const GarmentCut& cut) {
  if (cut.spec.shape)
    throw InputError(cut.spec.shape->where, "a net goes round one limb, and the body branches where this garment is to lie",
                     "leave the shape out: patterns are placed on such bodies by themselves, or cut the scan so that one limb is left");
  if (cut.spec.pattern.graduated())
    throw InputError(cut.spec.pattern.where, "a graduated tube goes round one limb, and the body branches where this one is to lie",
                     "place it on a part of the body that is one tube, or cut the scan so that one limb is left");
  if (!cut.pattern && !cut.spec.zone.empty())
    throw InputError(cut.spec.zone.front().where, "zones by height are of tubes round one limb, and the body branches where this one is to lie",
                     "make it a pattern whose pieces have fabrics of their own");
}

PlacementOptions options_of(const GarmentCut& cut, const DressForm& form, double lift) {
  PlacementOptions options;
  options.clearance += lift - usual_lift;
  if (cut.spec.position) options.lowest = *cut.spec.position + form.body.translation.z();
  return options;
}

OnBody place_on_body(const GarmentCut& cut, const DressForm& form, double cell, double lift) {
  check_flat(cut);
  OnBody on{cut.pattern ? *cut.pattern : tube_pattern(cut.spec), {}, {}, {}};
  on.sewn = mesh_pattern(on.pattern, cell);
  on.placed = place_garment(on.pattern, on.sewn, form, options_of(cut, form, lift));
  check_accepted(on.placed, on.pattern.pattern);
  on.fit = fit_on_body(on.sewn, on.placed, form);
  return on;
}

/// Placed on cells of its own, whatever it is solved on; none where it cannot be placed on those.
std::optional<OnBody> place_on_its_own_cells(const GarmentCut& cut, const DressForm& form, double lift) {
  try {
    return place_on_body(cut, form, placing_cell(cut), lift);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// The same garment in cells of another size.
OnBody in_cells(const GarmentCut& cut, const std::optional<OnBody>& own, const DressForm& form, double cell, double lift) {
  if (own) {
    OnBody on{own->pattern, mesh_pattern(own->pattern, cell), {}, own->fit};
    on.placed = carried_over(own->placed, own->sewn, on.pattern, on.sewn, form, options_of(cut, form, lift));
    if (on.placed.accepted()) return on;
  }
  return place_on_body(cut, form, cell, lift);
}

}  // namespace

GarmentCut read_cut(const input::GarmentSpec& spec) {
  GarmentCut cut{spec, std::nullopt};
  if (spec.shape) cut.shape = read_net_shape(*spec.shape);
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

std::size_t openings_of(const GarmentCut& cut) { return cut.pattern ? cut.pattern->sewing.open.size() : 2; }

double rise_of(const GarmentCut& cut) {
  if (!cut.pattern) return cut.spec.pattern.length;
  const TubeChart chart = tube_chart(mesh_pattern(*cut.pattern, coarse_cell(cut)), cut.spec.bottom, cut.spec.where);
  return *std::max_element(chart.up.begin(), chart.up.end());
}

GarmentFit placed_fit(const GarmentCut& cut, const Limb& limb) {
  return cut.pattern ? place_on_limb(mesh_pattern(*cut.pattern, coarse_cell(cut)), cut.spec, limb, usual_lift).fit : tube_fit(cut.spec);
}

GarmentFit placed_fit(const GarmentCut& cut, const DressForm& form) { return place_on_body(cut, form, coarse_cell(cut), usual_lift).fit; }

namespace {

GarmentMesh on_skin(const GarmentCut& cut, const Limb& limb, double worn_size, double lift) {
  if (!cut.pattern) return make_tube_mesh(cut.spec, limb, worn_size, lift);
  const double stretch = cut.spec.cell_size > 0.0 ? 1.0 : mean_stretch(mean_fit(placed_fit(cut, limb), limb));
  const SewnMesh sewn = mesh_pattern(*cut.pattern, flat_cell(cut, worn_size, stretch));
  LimbPlacement placement = place_on_limb(sewn, cut.spec, limb, lift);
  return finished(cut, sewn, placement.placed, std::move(placement.fit), placement.stand_off);
}

}  // namespace

GarmentMesh make_garment_mesh(const GarmentCut& cut, const Limb& limb, double worn_size, double lift) {
  GarmentMesh mesh = on_skin(cut, limb, worn_size, lift);
  if (cut.shape) lay_on(*cut.shape, limb, mesh);
  return mesh;
}

GarmentMesh make_garment_mesh(const GarmentCut& cut, const DressForm& form, double worn_size, double lift) {
  const std::optional<OnBody> own = place_on_its_own_cells(cut, form, lift);
  const double stretch = cut.spec.cell_size > 0.0 || !own ? 1.0 : mean_stretch(mean_fit(own->fit));
  OnBody on = in_cells(cut, own, form, flat_cell(cut, worn_size, stretch), lift);
  for (Eigen::Vector3d& place : on.placed.places) place = form.body.in_file(place);
  const double off = stand_off(on.fit);
  return finished(cut, on.sewn, on.placed.places, std::move(on.fit), off);
}

}  // namespace snug::mesh
