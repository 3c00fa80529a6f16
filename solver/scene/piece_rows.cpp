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

/// One side of a seam: its nodes on the flat piece, each with the direction out of the piece in the cloth as worn.
using Outward = std::map<int, Eigen::Vector3d>;

/// N, what the cloth of one side of a seam transmits across it: the forces of its triangles on the seam's nodes, along the directions out of it.
/// They balance what the solver balanced, so that they are as exact as its mean tensions, which the stress at a side of a triangle is not;
/// shear of the skin beside the seam is in them, the other way round on the other side.
double pull_across(const FabricMembrane& sheet, const State& state, const mesh::GarmentMesh& garment, const Outward& outward) {
  double pull = 0.0;
  for (std::size_t t = 0; t < garment.triangles.size(); ++t) {
    const auto& nodes = garment.triangles[t];
    if (std::none_of(nodes.begin(), nodes.end(), [&](int node) { return outward.contains(node); })) continue;
    const NodeVectors<6> forces = sheet.nodal_forces(state, static_cast<int>(t));
    for (int a = 0; a < 6; ++a)
      if (const auto it = outward.find(nodes[a]); it != outward.end()) pull += forces.col(a).dot(it->second.normalized());
  }
  return pull;
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
      for (const std::size_t of : {0, 1}) {
        Outward outward;
        for (const auto& pair : seam.pairs) {
          const auto side = sides.find(pair[of]);  // vertices are in no side's middle
          if (side == sides.end()) continue;
          const auto [triangle, corner] = side->second;
          const FabricMembrane::SideForce force = sheet->side_force(state, garment, triangle, corner);
          row.length += 0.5 * force.length, row.along += 0.5 * force.along;
          row.largest = std::max(row.largest, force.largest);
          for (const int a : {corner, (corner + 1) % 3, 3 + corner}) {
            Eigen::Vector3d& out = outward.try_emplace(garment.triangles[triangle][a], Eigen::Vector3d::Zero()).first->second;
            out += force.out;
          }
        }
        row.line_load += 0.5 * pull_across(*sheet, state, garment, outward);
      }
      if (row.length > 0.0) row.line_load /= row.length, row.along /= row.length;
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace snug::solver
