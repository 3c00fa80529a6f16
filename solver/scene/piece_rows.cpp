#include "solver/scene/piece_rows.hpp"

#include <algorithm>
#include <map>

namespace snug::solver {

namespace {

const FabricMembrane* sheet_of(const Scene& scene, const std::string& garment) {
  for (const auto& term : scene.terms())
    if (const auto* sheet = dynamic_cast<const FabricMembrane*>(term.get()); sheet && sheet->name() == FabricMembrane::name_of(garment)) return sheet;
  return nullptr;
}

/// Adds a triangle to the sums over its piece, by its area as cut.
void add_triangle(const FabricMembrane::Summary& s, double area, postproc::PieceRow& row) {
  row.area += area, row.worn_area += area * s.area_ratio;
  row.tension_warp += area * s.tension_warp, row.tension_weft += area * s.tension_weft;
  row.stretch_warp += area * s.stretch_warp, row.stretch_weft += area * s.stretch_weft;
  row.largest_tension = std::max({row.largest_tension, s.tension_warp, s.tension_weft});
}

std::vector<postproc::PieceRow> rows_of(const FabricMembrane& sheet, const State& state, const GarmentModel& model, const mesh::GarmentMesh& garment) {
  std::vector<postproc::PieceRow> rows(garment.pieces.size());
  std::vector<int> zone(rows.size(), -1);
  for (postproc::PieceRow& row : rows) row.stretch_warp = row.stretch_weft = 0.0;
  for (std::size_t t = 0; t < garment.triangles.size(); ++t) {
    zone[garment.piece_of(t)] = garment.zone_of(t);
    add_triangle(sheet.summary(state, static_cast<int>(t)), garment.cut_area(t), rows[garment.piece_of(t)]);
  }
  for (std::size_t p = 0; p < rows.size(); ++p) {
    postproc::PieceRow& row = rows[p];
    const materials::Fabric& fabric = model.fabric_of(zone[p]);
    row.garment = garment.name, row.piece = garment.pieces[p], row.fabric = fabric.name, row.thickness = fabric.thickness;
    row.weight = materials::with_usual_sheet(fabric).areal_density * row.area;
    for (double* mean : {&row.tension_warp, &row.tension_weft, &row.stretch_warp, &row.stretch_weft}) *mean /= row.area;
  }
  return rows;
}

/// Triangle and side by the node in the side's middle.
using Sides = std::map<int, std::pair<int, int>>;

Sides sides_of(const mesh::GarmentMesh& garment) {
  Sides sides;
  for (std::size_t t = 0; t < garment.triangles.size(); ++t)
    for (int side = 0; side < 3; ++side) sides[garment.triangles[t][3 + side]] = {static_cast<int>(t), side};
  return sides;
}

}  // namespace

std::vector<postproc::PieceRow> piece_rows(const Scene& scene, const State& state, const Model& model, const std::vector<mesh::GarmentMesh>& garments) {
  std::vector<postproc::PieceRow> rows;
  for (std::size_t g = 0; g < std::min(garments.size(), model.garments.size()); ++g)
    if (const FabricMembrane* sheet = sheet_of(scene, garments[g].name))
      for (postproc::PieceRow& row : rows_of(*sheet, state, model.garments[g], garments[g])) rows.push_back(std::move(row));
  return rows;
}

std::vector<postproc::SeamRow> seam_rows(const Scene& scene, const State& state, const std::vector<mesh::GarmentMesh>& garments) {
  std::vector<postproc::SeamRow> rows;
  for (const mesh::GarmentMesh& garment : garments) {
    const FabricMembrane* sheet = sheet_of(scene, garment.name);
    if (!sheet) continue;
    const Sides sides = sides_of(garment);
    for (const mesh::SewnSeam& seam : garment.seams) {
      postproc::SeamRow row{.garment = garment.name, .seam = seam.name};
      for (const auto& pair : seam.pairs)
        for (const int node : pair) {
          const auto side = sides.find(node);  // vertices are in no side's middle
          if (side == sides.end()) continue;
          const FabricMembrane::SideForce force = sheet->side_force(state, garment, side->second.first, side->second.second);
          row.length += 0.5 * force.length, row.line_load += 0.5 * force.across, row.along += 0.5 * force.along;
          row.largest = std::max(row.largest, force.largest);
        }
      if (row.length > 0.0) row.line_load /= row.length, row.along /= row.length;
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace snug::solver
