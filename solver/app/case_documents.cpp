// Plans, meshes, patterns and comparisons as JSON.
#include <algorithm>
#include <cmath>

#include "solver/app/documents.hpp"

namespace snug::app {

namespace {

Json known(double value) { return value > 0.0 ? Json(value) : Json(); }

Json fit_json(const std::string& limb, const mesh::FitRow& row, double body) {
  Json json = {{"height_m", row.height}, {"body_girth_m", body}, {"garment_girth_m", row.girth}, {"ease", row.girth / body - 1.0}, {"cover", row.cover}};
  if (!limb.empty()) json["limb"] = limb;
  return json;
}

Json garment_json(const mesh::GarmentMesh& garment, const PreparedCase& prepared) {
  const mesh::MeanFit mean = prepared.meshes.form ? mesh::mean_fit(garment.fit) : mesh::mean_fit(garment.fit, prepared.meshes.limb);
  const bool covers = mean.body_girth > 0.0;
  Json json = {{"name", garment.name},
               {"triangles", garment.triangles.size()},
               {"order", garment.order},
               {"mean_edge_m", garment.mean_edge},
               {"mean_girth_as_cut_m", covers ? Json(mean.garment_girth) : Json()},
               {"mean_girth_of_body_m", covers ? Json(mean.body_girth) : Json()},
               {"mean_ease", covers ? Json(mean.garment_girth / mean.body_girth - 1.0) : Json()},
               {"fit", Json::array()}};
  for (const mesh::LimbFit& limb : garment.fit.limbs)
    for (const mesh::FitRow& row : limb.rows) json["fit"].push_back(fit_json(limb.limb, row, row.body));
  if (garment.fit.limbs.empty())
    for (const mesh::FitRow& row : garment.fit.rows) json["fit"].push_back(fit_json({}, row, prepared.meshes.limb.girth(row.height)));
  return json;
}

Json scan_json(const mesh::ScanReport& scan) {
  Json cuts = Json::array(), sections = Json::array();
  for (const mesh::CutRow& cut : scan.cuts) cuts.push_back({{"name", cut.name}, {"girth_of_scan_m", cut.girth_of_scan}, {"girth_m", cut.girth}, {"area_m2", cut.area}});
  for (const mesh::SectionRow& row : scan.sections)
    sections.push_back({{"height_m", row.height}, {"girth_of_scan_m", row.girth_of_scan}, {"girth_m", row.girth}, {"outlines", row.limbs}});
  return {{"said", scan.said}, {"cuts", cuts}, {"sections", sections}, {"volume_m3", scan.volume}, {"volume_of_scan_m3", scan.volume_of_scan},
          {"deviation_rms_m", scan.deviation_rms}, {"deviation_max_m", scan.deviation_max}};
}

Json place_json(const postproc::NodePlace& at) {
  Json json = {{"node", at.node}, {"value", at.value}};
  if (std::isfinite(at.place.x())) json["at_m"] = {at.place.x(), at.place.y(), at.place.z()};
  return json;
}

Json column_json(const postproc::ColumnComparison& column) {
  Json worst = Json::array();
  for (const postproc::WorstNode& one : column.worst) {
    worst.push_back(place_json(one.at));
    worst.back().erase("value");
    worst.back().update({{"result", one.result}, {"reference", one.reference}, {"difference", one.at.value}});
  }
  return {{"column", column.label},
          {"unit", column.unit},
          {"compared", column.compared},
          {"unknown", column.unknown},
          {"rms", column.rms},
          {"maximum", column.maximum},
          {"scale", column.scale},
          {"tolerance", column.tolerance},
          {"within", column.within},
          {"worst", worst},
          {"result", {{"minimum", place_json(column.result_minimum)}, {"maximum", place_json(column.result_maximum)}}},
          {"reference", {{"minimum", place_json(column.reference_minimum)}, {"maximum", place_json(column.reference_maximum)}}}};
}

}  // namespace

Json plan_json(const solver::Plan& plan) {
  long total = 0;
  Json unknowns = Json::object();
  for (const auto& [part, count] : plan.unknowns) unknowns[part] = count, total += count;
  unknowns["total"] = total;
  return {{"tier", plan.tier}, {"in", plan.parts_in}, {"out", plan.parts_out}, {"unknowns", unknowns}, {"memory_bytes", known(plan.memory_bytes)}, {"disk_bytes", plan.disk_bytes}, {"seconds", known(plan.seconds)}};
}

void add_meshes(Json& json, const PreparedCase& prepared) {
  Json layers = Json::array(), garments = Json::array();
  for (const mesh::QualityRow& row : prepared.quality)
    layers.push_back({{"layer", row.layer}, {"cells", row.cells}, {"min_scaled_jacobian", row.min_scaled_jacobian}, {"mean_scaled_jacobian", row.mean_scaled_jacobian},
                      {"max_aspect", row.max_aspect}, {"volume_m3", row.volume}});
  for (const mesh::GarmentMesh& garment : prepared.meshes.garments) garments.push_back(garment_json(garment, prepared));
  Json locations = Json::array();
  const mesh::BodyMesh& body = prepared.meshes.body;
  for (std::size_t l = 0; l < body.locations.size(); ++l)
    locations.push_back({{"name", body.locations[l]}, {"nodes", std::count(body.node_location.begin(), body.node_location.end(), static_cast<int>(l))}});
  json["layers"] = layers;
  json["locations"] = locations;
  json["garments"] = garments;
  if (!prepared.meshes.scan.empty()) json["scan"] = scan_json(prepared.meshes.scan);
  if (!prepared.description.body || prepared.description.body->kind != input::BodyKind::scan || !prepared.meshes.limb.bone) return;
  Json girths = Json::array();
  for (const mesh::GirthRow& row : mesh::girth_table(prepared.meshes.limb, 7))
    girths.push_back({{"height_m", row.height}, {"girth_m", row.girth}, {"width_m", row.width}, {"depth_m", row.depth}});
  json["girths"] = girths;
  json["smooth_skin_to_scan_m"] = {{"rms", prepared.meshes.limb.residual.rms}, {"max", prepared.meshes.limb.residual.max}};
}

Json targets_json(const std::vector<postproc::TargetRow>& rows) {
  Json json = Json::array();
  for (const postproc::TargetRow& row : rows) json.push_back({{"place", row.place}, {"wanted_Pa", row.wanted}, {"found_Pa", row.found}, {"found_over_wanted", row.found / row.wanted}});
  return json;
}

Json comparison_json(const postproc::Comparison& comparison) {
  Json columns = Json::array();
  for (const postproc::ColumnComparison& column : comparison.columns) columns.push_back(column_json(column));
  return {{"result", comparison.result},     {"reference", comparison.reference}, {"notes", comparison.notes},
          {"matching", comparison.matching}, {"compared_nodes", comparison.compared}, {"missing_nodes", comparison.missing},
          {"largest_gap_m", comparison.largest_gap}, {"within", comparison.within()}, {"columns", columns}};
}

Json pattern_json(const mesh::CheckedPattern& checked) {
  const mesh::Pattern& pattern = checked.pattern;
  Json pieces = Json::array(), seams = Json::array(), open = Json::array();
  for (const mesh::Piece& piece : pattern.pieces) {
    const Eigen::Vector2d size = mesh::box(piece).sizes();
    const auto& fabric = piece.fabric ? piece.fabric : pattern.fabric;
    Json edges = Json::array();
    for (const mesh::PieceEdge& edge : piece.edges) edges.push_back({{"name", edge.name}, {"length_m", mesh::ArcLength(edge.curve).length()}});
    pieces.push_back({{"name", piece.name}, {"area_m2", mesh::area(piece)}, {"width_m", size.x()}, {"height_m", size.y()}, {"fabric", fabric ? Json(fabric->name) : Json()}, {"edges", edges}});
  }
  for (const mesh::Seam& seam : pattern.seams) {
    const double a = mesh::length(pattern, seam.a), b = mesh::length(pattern, seam.b);
    seams.push_back({{"name", seam.name}, {"a", mesh::name_of(pattern, seam.a)}, {"b", mesh::name_of(pattern, seam.b)}, {"length_a_m", a}, {"length_b_m", b}, {"ease", mesh::ease(a, b)}});
  }
  for (const mesh::OpenLoop& loop : checked.sewing.open) {
    double length = 0.0;
    for (const int s : loop.stretches) length += checked.sewing.stretches[s].length;
    open.push_back({{"name", loop.name}, {"length_m", length}});
  }
  return {{"title", pattern.title}, {"pieces", pieces}, {"seams", seams}, {"open_edges", open}};
}

Json mesh_json(const mesh::SewnMesh& mesh) {
  std::size_t gone = 0;
  for (std::size_t n = 0; n < mesh.merged.size(); ++n) gone += mesh.merged[n] != static_cast<int>(n);
  return {{"triangles", mesh.triangles.size()}, {"nodes", mesh.flat.size()}, {"nodes_after_sewing", mesh.flat.size() - gone}, {"mean_edge_m", mesh.mean_edge}};
}

}  // namespace snug::app
