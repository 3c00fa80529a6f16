#include "solver/library/prepared_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "cases/input/suggestion.hpp"
#include "cases/input/warned_error.hpp"
#include "mesh/body/branching_body.hpp"
#include "mesh/body/foreign.hpp"
#include "mesh/body/import.hpp"
#include "mesh/body/import_shell.hpp"
#include "mesh/body/scan.hpp"
#include "mesh/placement/closed_skin.hpp"
#include "postproc/evaluate.hpp"
#include "solver/library/graduated.hpp"
#include "solver/library/named_materials.hpp"
#include "solver/library/plausibility.hpp"
#include "solver/library/sensor.hpp"
#include "solver/library/size_estimate.hpp"
#include "solver/scene/garment_cells.hpp"
#include "solver/scene/layers.hpp"

namespace snug::solver {

namespace {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

struct Heights {
  double lower = std::numeric_limits<double>::max(), upper = std::numeric_limits<double>::lowest();
};

/// The heights of an imported body that the garments cover, with a cell's margin. Throws where one has no position.
Heights heights_of(const std::vector<mesh::GarmentCut>& cuts, const mesh::BodyMesh& body) {
  Heights heights;
  for (const mesh::GarmentCut& cut : cuts) {
    const double low = input::lowest_point(cut.spec);
    heights.lower = std::min(heights.lower, low - body.mean_skin_cell), heights.upper = std::max(heights.upper, low + mesh::rise_of(cut) + body.mean_skin_cell);
  }
  return heights;
}

/// A body that is one tube wears its garments as a limb does, and so does one that branches, where all of them are on a part of it that is
/// one tube; else they are placed on its form.
bool worn_as_limb(const std::vector<mesh::GarmentCut>& cuts, const mesh::BodyMesh& body) {
  if (!mesh::branches(body)) return true;
  if (std::any_of(cuts.begin(), cuts.end(), [](const mesh::GarmentCut& cut) { return !cut.spec.position || mesh::openings_of(cut) != 2; })) return false;
  const Heights heights = heights_of(cuts, body);
  return mesh::one_loop_between(body, heights.lower, heights.upper);
}

/// What the garments are placed on, where the body is cells of a file.
void find_wearer(const input::Case& description, const std::vector<mesh::GarmentCut>& cuts, Meshes& meshes) {
  if (cuts.empty()) return;
  if (!meshes.body.shell.empty()) mesh::turn_skin_outwards(meshes.body);
  if (worn_as_limb(cuts, meshes.body)) {
    const Heights heights = heights_of(cuts, meshes.body);
    meshes.limb = mesh::limb_from_skin(meshes.body, heights.lower, heights.upper, cuts.front().spec.where);
    return;
  }
  if (description.solver.tier == input::Tier::L0)
    throw input::InputError(description.body->where, "tier L0 is tension over radius round a limb, and the body branches", "take tier L1 or L4");
  meshes.form = std::make_unique<mesh::DressForm>(mesh::body_of_skin(meshes.body, description.body->where));
}

/// An imported body may bring its loads along; a case without any would only say so after the solve.
void check_that_something_acts(const input::Case& description, const mesh::BodyMesh& body) {
  const auto moves = [](const auto& held) { return held.displacement != 0.0; };
  if (!description.garments.empty() || description.load || !description.support.empty() || !description.postures.empty() || !body.forces.empty() || !body.pressures.empty() ||
      std::any_of(body.held.begin(), body.held.end(), moves) || std::any_of(body.held_along.begin(), body.held_along.end(), moves))
    return;
  throw input::InputError(description.body->where, "nothing acts on the body",
                          "add [load], a [[support]] that moves or a [[posture]], or forces in " + description.body->mesh.string());
}

/// What acts on the skin needs one.
void check_skin(const input::Case& description, const mesh::BodyMesh& body) {
  const bool pressed = description.load && description.load->skin_pressure != 0.0;
  if (!body.skin_facets.empty() || !body.shell.empty() || (!pressed && description.garments.empty())) return;
  std::vector<std::string> names;
  for (const mesh::Surface& surface : body.surfaces)
    if (!surface.facets.empty()) names.push_back("\"" + surface.name + "\"");
  throw input::InputError(description.garments.empty() ? description.body->where : description.garments.front().where,
                          fmt::format("{} has no surface \"skin\", on which {} acts", description.body->mesh.string(), pressed ? "the skin_pressure" : "the garment"),
                          fmt::format("name the physical surface so; its surfaces are: {}", names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

/// A scan becomes hexahedra or tetrahedra; the report says which and why.
void make_scan(const input::BodySpec& spec, Meshes& meshes) {
  const mesh::CellChoice choice = mesh::choose_cells(spec);
  if (choice.tetrahedra) {
    mesh::ScannedBody scanned = mesh::body_from_scan(spec);
    meshes.body = std::move(scanned.mesh), meshes.scan = std::move(scanned.report);
  } else {
    const input::BodySpec limb = mesh::with_lower_and_upper(spec);
    meshes.limb = mesh::make_limb(limb);
    meshes.body = mesh::make_body_mesh(limb, meshes.limb);
    mesh::name_cuts(spec, meshes.body);
  }
  meshes.scan.said.insert(meshes.scan.said.begin(), fmt::format("{}: {}", choice.tetrahedra ? "tetrahedra" : "hexahedra", choice.reason));
}

Meshes make_body(const input::Case& description, const std::vector<mesh::GarmentCut>& cuts, const mesh::GmshOptions& gmsh, double memory_limit) {
  Meshes meshes;
  if (!description.body) return meshes;
  if (description.body->kind == input::BodyKind::imported) {
    const bool model = mesh::is_model_file(description.body->mesh);
    meshes.body = model ? mesh::import_model(*description.body, description.directory) : mesh::import_body_mesh(*description.body, gmsh);
    check_that_something_acts(description, meshes.body);
    check_skin(description, meshes.body);
    find_wearer(description, cuts, meshes);
  } else if (description.body->kind == input::BodyKind::scan) {
    refuse_large_body(description, memory_limit);
    make_scan(*description.body, meshes);
    if (!meshes.limb.skin) find_wearer(description, cuts, meshes);  // tetrahedra
  } else {
    refuse_large_body(description, memory_limit);
    meshes.limb = mesh::make_limb(*description.body);
    meshes.body = mesh::make_body_mesh(*description.body, meshes.limb);
  }
  return meshes;
}

/// The patterns that the garments name; what a pattern says of its fabric is taken where the garment says nothing.
std::vector<mesh::GarmentCut> read_cuts(input::Case& description) {
  std::vector<mesh::GarmentCut> cuts;
  for (input::GarmentSpec& garment : description.garments) {
    cuts.push_back(mesh::read_cut(garment));
    garment.fabric = cuts.back().spec.fabric, garment.zone = cuts.back().spec.zone;
  }
  return cuts;
}

/// Sizes of the garments' cells; garments with more of them than the machine can hold are refused.
std::vector<double> garment_cell_sizes(const PreparedCase& prepared, const std::vector<mesh::GarmentCut>& cuts, const std::vector<mesh::GarmentFit>& fits) {
  std::vector<double> sizes;
  for (std::size_t g = 0; g < cuts.size(); ++g) {
    sizes.push_back(worn_cell_size(prepared.model, static_cast<int>(g), fits[g], prepared.meshes.limb, prepared.meshes.body));
    refuse_large_garment(cuts[g], cuts[g].spec.cell_size > 0.0 ? cuts[g].spec.cell_size : sizes.back(), prepared.memory_limit);
  }
  return sizes;
}

/// Of the locations that come with a standard body those stay that lie on the part that is meshed.
void keep_found_locations(const mesh::BodyMesh& body, input::Case& description, const input::Jobs& jobs) {
  if (!description.body) return;
  const auto found = [&](const std::string& name) { return std::find(body.locations.begin(), body.locations.end(), name) != body.locations.end(); };
  const std::size_t cut_away = std::erase_if(description.body->locations, [&](const input::LocationSpec& one) { return one.where_there && !found(one.name); });
  if (cut_away == 0) return;
  const auto check = [&](const std::string& name, const input::Location& where) {
    if (!name.empty() && !found(name))
      throw input::InputError(where, fmt::format("\"{}\" does not lie on the part of the body between the cuts", name), input::did_you_mean(name, body.locations));
  };
  if (jobs.target)
    for (const input::WantedPressure& wanted : jobs.target->pressures) check(wanted.location, wanted.where);
  for (const input::SensorSpec& sensor : jobs.sensors) check(sensor.location, sensor.where);
  if (description.comfort && description.body->locations.empty())
    throw input::InputError(description.body->where, "[comfort] has no locations to judge: none of the standard body's lies between the cuts",
                            "cut elsewhere, add [[body.locations]], or leave [comfort] out");
}

/// Graduated tubes that say what they are to press with and not how wide they are get the circumferences of the law of Laplace.
void cut_graduated(std::vector<mesh::GarmentCut>& cuts, PreparedCase& prepared) {
  for (std::size_t g = 0; g < cuts.size(); ++g) {
    input::PatternSpec& tube = prepared.description.garments[g].pattern;
    if (!tube.graduated() || !tube.circumferences.empty()) continue;
    tube.circumferences = laplace_girths(prepared.model.garments[g], prepared.meshes.limb);
    for (input::PatternSpec* same : {&cuts[g].spec.pattern, &prepared.model.garments[g].spec.pattern, &prepared.model.asked.garments[g].pattern})
      same->circumferences = tube.circumferences;
  }
}

void mesh_garments(const std::vector<mesh::GarmentCut>& cuts, PreparedCase& prepared) {
  std::vector<mesh::GarmentFit> fits;
  const mesh::DressForm* form = prepared.meshes.form.get();
  for (const mesh::GarmentCut& cut : cuts) fits.push_back(form ? mesh::placed_fit(cut, *form) : mesh::placed_fit(cut, prepared.meshes.limb));
  const std::vector<double> cell_sizes = garment_cell_sizes(prepared, cuts, fits);
  const auto add = [&](const std::vector<input::Diagnostic>& more) { prepared.warnings.insert(prepared.warnings.end(), more.begin(), more.end()); };
  add(implausible(prepared.model, prepared.meshes, fits));
  for (std::size_t g = 0; g < cuts.size(); ++g) {
    if (cuts[g].pattern) add(cuts[g].pattern->warnings);
    const double lift = placing_lift(prepared.model, prepared.meshes.garments, fits[g]);
    prepared.meshes.garments.push_back(form ? mesh::make_garment_mesh(cuts[g], *form, cell_sizes[g], lift)
                                            : mesh::make_garment_mesh(cuts[g], prepared.meshes.limb, cell_sizes[g], lift));
  }
}

/// How wide the garments are against the limbs that they are worn on.
std::vector<postproc::FitRow> fit_of(const Meshes& meshes) {
  constexpr int rows = 9;
  std::vector<postproc::FitRow> fit;
  for (const mesh::GarmentMesh& garment : meshes.garments)
    for (const mesh::LimbFit& limb : garment.fit.limbs)
      for (const mesh::FitRow& row : limb.some_rows(rows)) fit.push_back({garment.name, row.height, row.body, row.girth, row.cover, limb.limb});
  if (!meshes.limb.skin) return fit;
  for (const mesh::GarmentMesh& garment : meshes.garments)
    for (int i = 0; i < rows; ++i) {
      const mesh::FitRow row = garment.fit.at(garment.fit.lower + garment.fit.length() * (i + 0.5) / rows);
      fit.push_back({garment.name, row.height, meshes.limb.girth(row.height), row.girth, row.cover, {}});
    }
  return fit;
}

std::string place_text(const input::Location& where) {
  return where.line > 0 ? where.file + ", line " + std::to_string(where.line) : where.file;
}

}  // namespace

PreparedCase prepare(const std::filesystem::path& directory, const PrepareOptions& options) {
  PreparedCase prepared;
  const Stopwatch reading;
  prepared.description = input::read_case(directory, options.reading);
  prepared.jobs = input::read_jobs(directory, options.reading);
  std::vector<mesh::GarmentCut> cuts = read_cuts(prepared.description);
  resolve_materials(prepared.description, options.library);
  make_model(prepared.description);  // names that are wrong should be said before minutes of meshing
  if (prepared.description.comfort) postproc::load_evidence(*prepared.description.comfort, prepared.description.directory);
  prepared.phases.push_back({"reading", reading.seconds()});
  const Stopwatch meshing;
  prepared.memory_limit = options.memory_limit > 0.0 ? options.memory_limit : memory_of_machine();
  prepared.meshes = make_body(prepared.description, cuts, options.gmsh, prepared.memory_limit);
  prepared.warnings = prepared.meshes.body.remarks;
  prepared.warnings.insert(prepared.warnings.end(), prepared.meshes.limb.remarks.begin(), prepared.meshes.limb.remarks.end());
  input::with_warnings(prepared.warnings, [&] {
    keep_found_locations(prepared.meshes.body, prepared.description, prepared.jobs);
    prepared.model = make_model(prepared.description, prepared.meshes.body);
    sensor_places(prepared.jobs.sensors, prepared.description, prepared.meshes.body);  // one beside the skin is told before the solve
    cut_graduated(cuts, prepared);
    mesh_garments(cuts, prepared);
  });
  prepared.quality = mesh::quality(prepared.meshes.body);
  prepared.phases.push_back({"meshing", meshing.seconds()});
  return prepared;
}

Plan plan(const PreparedCase& prepared) {
  Plan planned = plan(prepared.model, prepared.meshes, prepared.memory_limit);
  refuse_large_plan(planned, prepared.memory_limit, prepared.description);
  return planned;
}

postproc::RunResult solve(const PreparedCase& prepared, const Observer& observer, const KeptStates& kept, const Stop& stop, Journal* journal) {
  postproc::RunResult run = solve(prepared.model, prepared.meshes, observer, kept, stop, journal, prepared.memory_limit);
  for (const input::Diagnostic& warning : prepared.warnings)
    run.warnings.push_back({"the input", warning.found, place_text(warning.where), warning.remedy, {}});
  run.fit = fit_of(prepared.meshes);
  run.profile = pressure_profile(prepared.model, prepared.meshes, run);
  if (!run.profile.empty()) {
    double& error = run.numbers["largest_error_of_profile"] = 0.0;
    for (const postproc::ProfileRow& row : run.profile) error = std::max(error, std::abs(row.found / row.wanted - 1.0));
  }
  run.phases.insert(run.phases.begin(), prepared.phases.begin(), prepared.phases.end());
  return run;
}

postproc::Evaluation evaluate(const PreparedCase& prepared, const postproc::RunResult& run) {
  postproc::Evaluation evaluation = postproc::evaluate(run, prepared.description.comfort, prepared.description.directory);
  if (prepared.jobs.target) evaluation.targets = postproc::target_rows(run, evaluation.locations, *prepared.jobs.target);
  evaluation.sensors = sensor_rows(prepared.jobs.sensors, prepared.model, prepared.meshes, run);
  return evaluation;
}

}  // namespace snug::solver
