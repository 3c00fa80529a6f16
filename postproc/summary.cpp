#include "postproc/summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "postproc/documents.hpp"
#include "postproc/units.hpp"

namespace snug::postproc {
namespace {

/// An empty map would become null.
template <class Map>
Json object(const Map& map) {
  return map.empty() ? Json::object() : Json(map);
}

Json vector_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json balance_json(const Balance& balance) {
  Json reactions = Json::object();
  for (const auto& [name, force] : balance.reactions) reactions[name] = vector_json(force);
  Json json = {{"garment_force_N", vector_json(balance.garment_force)},
               {"skin_force_N", vector_json(balance.skin_force)},
               {"force_error_N", vector_json(balance.force_error)},
               {"moment_error_Nm", vector_json(balance.moment_error)},
               {"contact_force_N", balance.contact_force},
               {"friction_force_N", balance.friction_force},
               {"reactions_N", reactions}};
  if (!balance.garment_weight.isZero(0.0)) json["garment_weight_N"] = vector_json(balance.garment_weight);
  return json;
}

Json donning_json(const RunResult& run) {
  Json json = Json::array();
  for (const DonningRow& row : run.donning)
    json.push_back({{"assumption", row.name},
                    {"friction_from", row.from},
                    {"converged", row.converged},
                    {"mean_contact_pressure_Pa", row.mean_pressure},
                    {"max_contact_pressure_Pa", row.max_pressure}});
  return json;
}

// Pressures of locations and the largest one leave the strips out.
Json surface_contacts_json(const RunResult& run) {
  Json json = Json::array();
  for (const SurfaceContact& contact : run.surface_contacts)
    json.push_back({{"name", contact.name},
                    {"slave", contact.slave},
                    {"master", contact.master},
                    {"force_N", contact.force},
                    {"area_m2", contact.area},
                    {"mean_pressure_Pa", contact.mean_pressure()},
                    {"largest_pressure_Pa", contact.largest_pressure},
                    {"friction_force_N", contact.friction_force}});
  return json;
}

Json tools_json(const RunResult& run) {
  Json json = Json::array();
  for (const ToolResult& tool : run.tools)
    json.push_back({{"name", tool.name},
                    {"shape", tool.shape},
                    {"surface", tool.surface},
                    {"direction", vector_json(tool.direction)},
                    {"start_m", vector_json(tool.tip)},
                    {"travel_m", tool.end().travel},
                    {"depth_m", tool.end().depth},
                    {"force_N", tool.end().force},
                    {"across_N", tool.end().across},
                    {"reaction_N", vector_json(tool.reaction)},
                    {"stiffness_N_per_m", tool.stiffness()},
                    {"slope_N_per_m", tool.slope()},
                    {"contact_area_m2", tool.end().area},
                    {"mean_pressure_Pa", tool.mean_pressure()},
                    {"largest_pressure_Pa", tool.end().largest_pressure},
                    {"friction_force_N", tool.end().friction_force}});
  return json;
}

Json bones_json(const MovementState& state) {
  Json json = Json::array();
  for (const BoneRow& bone : state.bones) {
    json.push_back({{"name", bone.bone}, {"turn_rad", bone.turn}});
    if (!bone.shift.isZero(0.0)) json.back()["shift_m"] = vector_json(bone.shift);
  }
  return json;
}

/// Where the movement has come to: "dressed", then the postures; a last one that was not reached with the share of the way.
Json postures_json(const RunResult& run, const Evaluation& evaluation) {
  Json json = Json::array();
  for (std::size_t n = 0; n < run.movement.size(); ++n) {
    const MovementState& state = run.movement[n];
    if (!state.reached() && n + 1 < run.movement.size()) continue;
    Json locations = Json::array();
    const MovementRating none{state.locations, {}, {}};
    const MovementRating& rating = n < evaluation.movement.size() ? evaluation.movement[n] : none;
    for (const LocationRow& row : rating.locations)
      locations.push_back({{"location", row.name}, {"coverage", row.coverage}, {"mean_pressure_Pa", row.mean_pressure}, {"max_pressure_Pa", row.max_pressure},
                           {"rating", row.rating ? Json(*row.rating) : Json()}});
    json.push_back({{"name", state.posture},
                    {"share", state.share},
                    {"bones", bones_json(state)},
                    {"mean_contact_pressure_Pa", state.mean_pressure},
                    {"max_contact_pressure_Pa", state.max_pressure},
                    {"contact_area_m2", state.contact_area},
                    {"contact_force_N", state.contact_force},
                    {"friction_force_N", state.friction_force},
                    {"force_error_N", state.force_error},
                    {"moment_error_Nm", state.moment_error},
                    {"locations", locations},
                    {"comfort", rating.comfort ? Json(rating.comfort->score) : Json()}});
  }
  return json;
}

/// All states of the movement, as columns.
Json movement_json(const RunResult& run) {
  Json progress = Json::array(), mean = Json::array(), locations = Json::array();
  for (const MovementState& state : run.movement) progress.push_back(state.progress), mean.push_back(state.mean_pressure);
  for (std::size_t l = 0; l < run.movement.front().locations.size(); ++l) {
    Json pressure = Json::array();
    for (const MovementState& state : run.movement) pressure.push_back(state.locations[l].mean_pressure);
    locations.push_back({{"location", run.movement.front().locations[l].name}, {"mean_pressure_Pa", pressure}});
  }
  return {{"progress", progress}, {"mean_contact_pressure_Pa", mean}, {"locations", locations}};
}

Json hems_json(const RunResult& run) {
  Json json = Json::array();
  for (const Hem& hem : run.hems)
    json.push_back({{"edge", hem.edge},
                    {"line_load_N_per_m", hem.line_load},
                    {"length_m", hem.length},
                    {"strip_m", hem.strip},
                    {"reach_m", hem.reach},
                    {"force_within_reach_N", hem.force}});
  return json;
}

Json fit_json(const RunResult& run) {
  Json json = Json::array();
  for (const FitRow& row : run.fit)
    json.push_back({{"garment", row.garment},
                    {"height_m", row.height},
                    {"body_girth_m", row.body_girth},
                    {"garment_girth_m", row.garment_girth},
                    {"ease", row.ease()},
                    {"cover", row.cover}});
  for (std::size_t n = 0; n < run.fit.size(); ++n)
    if (!run.fit[n].limb.empty()) json[n]["limb"] = run.fit[n].limb;
  return json;
}

Json pieces_json(const RunResult& run) {
  Json json = Json::array();
  for (const PieceRow& piece : run.pieces)
    json.push_back({{"name", piece.garment + ", " + piece.piece},
                    {"garment", piece.garment},
                    {"piece", piece.piece},
                    {"fabric", piece.fabric},
                    {"area_m2", piece.area},
                    {"worn_area_m2", piece.worn_area},
                    {"weight_kg", piece.weight},
                    {"thickness_m", piece.thickness > 0.0 ? Json(piece.thickness) : Json()},
                    {"tension_warp_N_per_m", piece.tension_warp},
                    {"tension_weft_N_per_m", piece.tension_weft},
                    {"largest_tension_N_per_m", piece.largest_tension},
                    {"stretch_warp", piece.stretch_warp},
                    {"stretch_weft", piece.stretch_weft}});
  return json;
}

Json seams_json(const RunResult& run) {
  Json json = Json::array();
  for (const SeamRow& seam : run.seams)
    json.push_back({{"name", seam.garment + ", " + seam.seam},
                    {"garment", seam.garment},
                    {"seam", seam.seam},
                    {"length_m", seam.length},
                    {"line_load_N_per_m", seam.line_load},
                    {"largest_line_load_N_per_m", seam.largest},
                    {"shear_N_per_m", seam.along}});
  return json;
}

Json profile_json(const RunResult& run) {
  Json json = Json::array();
  for (const ProfileRow& row : run.profile)
    json.push_back({{"name", fmt::format("{}, {:.4g} mm", row.garment, 1e3 * row.height)},
                    {"garment", row.garment},
                    {"height_m", row.height},
                    {"from_m", row.from},
                    {"to_m", row.to},
                    {"wanted_Pa", row.wanted},
                    {"found_Pa", row.found},
                    {"found_over_wanted", row.found / row.wanted}});
  return json;
}

Json bands_json(const RunResult& run) {
  Json json = Json::array();
  for (const Band& band : run.bands)
    json.push_back({{"name", band.garment + ", " + band.edge},
                    {"garment", band.garment},
                    {"edge", band.edge},
                    {"rest_length_m", band.rest_length},
                    {"length_m", band.length},
                    {"tension_N", band.tension},
                    {"least_tension_N", band.least_tension},
                    {"largest_tension_N", band.largest_tension},
                    {"line_load_N_per_m", band.line_load}});
  return json;
}

Json warnings_json(const RunResult& run) {
  Json json = Json::array();
  for (const Warning& w : run.warnings)
    json.push_back({{"name", w.name}, {"text", w.text}, {"place", w.place}, {"remedy", w.remedy},
                    {"quantity", w.quantity}, {"value", w.value}, {"limit", w.limit}});
  return json;
}

Json state_json(const StateTruth& truth) {
  return {{"stage", truth.stage},
          {"fraction", truth.fraction},
          {"body_stiffening", truth.stiffening},
          {"friction_bound", truth.friction_bound}};
}

Json unknowns_json(const RunResult& run) {
  Json json = object(run.unknowns);
  json["total"] = std::accumulate(run.unknowns.begin(), run.unknowns.end(), 0L,
                                  [](long sum, const auto& part) { return sum + part.second; });
  return json;
}

/// Fields that are not our own: no file but this one tells their unit and meaning.
void add_fields(const char* part, const Fields& fields, Json& list) {
  for (const NamedField& field : fields)
    if (field.recorded && meaning_of(field.name).description.empty())
      list.push_back({{"part", part}, {"name", field.name}, {"unit", field.unit}, {"place", field.place == Place::node ? "node" : "cell"},
                      {"description", field.description}});
}

Json fields_json(const RunResult& run) {
  Json list = Json::array();
  add_fields("body", run.body.fields, list);
  add_fields("garment", run.garment.fields, list);
  return list;
}

Json residuals_json(const RunResult& run) {
  if (run.history.empty()) return Json::object();
  const Iteration& last = run.history.back();
  return {{"residual", last.residual},
          {"complementarity", last.complementarity},
          {"load", last.load},
          {"contact_nodes", last.contact_nodes}};
}

Json phases_json(const std::vector<Phase>& phases) {
  Json json = Json::array();
  for (const Phase& phase : phases) {
    Json one = {{"name", phase.name}, {"seconds", phase.seconds}};
    if (!phase.parts.empty()) one["parts"] = phases_json(phase.parts);
    json.push_back(one);
  }
  return json;
}

double total_seconds(const RunResult& run) {
  return std::accumulate(run.phases.begin(), run.phases.end(), 0.0,
                         [](double sum, const Phase& phase) { return sum + phase.seconds; });
}

void add_outcome(Json& json, const RunResult& run) {
  json["title"] = run.title;
  json["tier"] = run.tier;
  json["status"] = name_of(run.status);
  json["message"] = run.message;
  if (!run.truth.stage.empty()) json["state"] = state_json(run.truth);
  json["what_to_try"] = run.remedies;
  if (!run.truth.stage.empty() && run.status != Status::converged) json["state"]["text"] = state_text(run);
  json["warnings"] = warnings_json(run);
  json["assumptions"] = run.assumptions;
  json["plan"] = {{"in", run.parts_in}, {"out", run.parts_out}};
  json["unknowns"] = unknowns_json(run);
  json["increments"] = run.increments;
  json["iterations"] = run.iterations;
  json["residuals"] = residuals_json(run);
  json["balance"] = balance_json(run.balance);
  if (!run.hems.empty()) json["hems"] = hems_json(run);
  if (!run.fit.empty()) json["fit"] = fit_json(run);
  if (!run.bands.empty()) json["bands"] = bands_json(run);
  if (!run.pieces.empty()) json["pieces"] = pieces_json(run);
  if (!run.seams.empty()) json["seams"] = seams_json(run);
  if (!run.profile.empty()) json["pressure_profile"] = profile_json(run);
  if (!run.surface_contacts.empty()) json["surface_contacts"] = surface_contacts_json(run);
  if (!run.tools.empty()) json["tools"] = tools_json(run);
  json["max_penetration_m"] = run.max_penetration;
  json["mean_laplace_pressure_Pa"] = run.mean_laplace_pressure;
  if (!run.donning.empty()) json["spread_over_donning_paths"] = donning_json(run);
  json["numbers"] = object(run.numbers);
  if (Json fields = fields_json(run); !fields.empty()) json["fields"] = std::move(fields);
}

}  // namespace

std::string state_text(const RunResult& run) {
  const StateTruth& truth = run.truth;
  std::string text = fmt::format("at {:.1f} % of the stage \"{}\"", 100.0 * truth.fraction, truth.stage);
  if (truth.stiffening != 1.0) text += fmt::format(", the body {:.3g} times as stiff as it is", truth.stiffening);
  if (std::isinf(truth.friction_bound)) text += ", the garment stuck where it was placed";
  else if (truth.friction_bound != 1.0) text += fmt::format(", friction bound to {:.3g} times its coefficient", truth.friction_bound);
  return text;
}

Json as_read(const Json& json) { return Json::parse(text_of(json)); }

// nlohmann writes numbers that are not finite as null, which is what we want of a value that was not computed.
std::string text_of(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n'; }

Json summary_document(const RunResult& run, const Evaluation& evaluation, const Provenance& provenance) {
  Json json;
  add_outcome(json, run);
  add_evaluation(json, evaluation);
  if (!run.movement.empty()) json["postures"] = postures_json(run, evaluation), json["movement"] = movement_json(run);
  json["seconds"] = total_seconds(run);
  json["phases"] = phases_json(run.phases);
  json["linear_solver"] = object(run.linear_solver);
  if (!run.factor.empty()) json["linear_solver"]["factor"] = run.factor;
  json["peak_memory_bytes"] = run.peak_memory;
  json["peak_memory_of_a_rank_bytes"] = run.peak_memory_of_a_rank;
  json["mesh_quality"] = object(provenance.mesh_quality);
  json["command"] = provenance.command;
  json["versions"] = object(provenance.versions);
  json["input_hashes"] = object(provenance.input_hashes);
  return as_read(json);
}

}  // namespace snug::postproc
