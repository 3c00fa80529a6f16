#include "solver/app/prepared_case.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "mesh/body/foreign.hpp"
#include "mesh/body/import.hpp"
#include "mesh/body/scan.hpp"
#include "postproc/evaluate.hpp"
#include "solver/app/size_estimate.hpp"
#include "solver/scene/garment_cells.hpp"

namespace snug::app {

namespace {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The part of an imported body that the garments are placed on, with a cell's margin.
mesh::Limb limb_below(const std::vector<input::GarmentSpec>& garments, const mesh::BodyMesh& body) {
  const double margin = body.mean_skin_cell;
  double low = std::numeric_limits<double>::max(), high = -low;
  for (const input::GarmentSpec& garment : garments)
    low = std::min(low, garment.position - margin), high = std::max(high, garment.position + garment.pattern.length + margin);
  return mesh::limb_from_skin(body, low, high, garments.front().where);
}

/// An imported body may bring its loads along; a case without any would only say so after the solve.
void check_that_something_acts(const input::Case& description, const mesh::BodyMesh& body) {
  const auto moves = [](const mesh::HeldComponent& held) { return held.displacement != 0.0; };
  if (!description.garments.empty() && !body.shell.empty())
    throw input::InputError(description.garments.front().where, "a garment on a shell body is not available yet",
                            "give the body as solids, or leave [garment], [contact] and [comfort] out");
  if (!description.garments.empty() || description.load || !description.support.empty() || !body.forces.empty() || !body.pressures.empty() ||
      std::any_of(body.held.begin(), body.held.end(), moves))
    return;
  throw input::InputError(description.body->where, "nothing acts on the body",
                          "add [load] or a [[support]] that moves, or forces in " + description.body->mesh.string());
}

solver::Meshes make_body(const input::Case& description, const CaseOptions& options) {
  solver::Meshes meshes;
  if (!description.body) return meshes;
  if (description.body->kind == "imported") {
    const bool model = mesh::is_model_file(description.body->mesh);
    meshes.body = model ? mesh::import_model(*description.body) : mesh::import_body_mesh(*description.body, options.gmsh());
    check_that_something_acts(description, meshes.body);
    if (!description.garments.empty()) meshes.limb = limb_below(description.garments, meshes.body);
  } else {
    refuse_large_body(description, options.memory_limit());
    meshes.limb = mesh::make_limb(*description.body);
    meshes.body = mesh::make_body_mesh(*description.body, meshes.limb);
  }
  return meshes;
}

void add_garments(const solver::Model& model, const CaseOptions& options, solver::Meshes& meshes) {
  for (std::size_t g = 0; g < model.garments.size(); ++g) {
    const input::GarmentSpec& spec = model.garments[g].spec;
    const double cell_size = solver::worn_cell_size(model, static_cast<int>(g), meshes.limb, meshes.body);
    refuse_large_garment(spec, spec.cell_size > 0.0 ? spec.cell_size : cell_size, options.memory_limit());
    meshes.garments.push_back(mesh::make_garment_mesh(spec, meshes.limb, cell_size));
  }
}

}  // namespace

PreparedCase prepare(const std::filesystem::path& directory, const CaseOptions& options) {
  PreparedCase prepared;
  const Stopwatch reading;
  prepared.description = options.read(directory);
  solver::make_model(prepared.description);  // names that are wrong should be said before minutes of meshing
  if (prepared.description.comfort) postproc::load_evidence(*prepared.description.comfort, prepared.description.directory);
  prepared.phases.push_back({"reading", reading.seconds()});
  const Stopwatch meshing;
  prepared.meshes = make_body(prepared.description, options);
  prepared.model = solver::make_model(prepared.description, prepared.meshes.body);
  add_garments(prepared.model, options, prepared.meshes);
  prepared.quality = mesh::quality(prepared.meshes.body);
  prepared.memory_limit = options.memory_limit();
  prepared.phases.push_back({"meshing", meshing.seconds()});
  return prepared;
}

}  // namespace snug::app
