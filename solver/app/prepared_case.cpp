#include "solver/app/prepared_case.hpp"

#include <algorithm>
#include <chrono>

#include "materials/fabric/fabric.hpp"
#include "materials/laws/solid_law.hpp"
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

/// Collects the errors of several look-ups, so that they come together.
class Collector {
 public:
  template <class LookUp>
  void operator()(LookUp look_up) {
    try {
      look_up();
    } catch (const input::InputError& error) {
      for (const input::Diagnostic& one : error.errors()) diagnostics_.error(one.where, one.found, one.remedy);
    }
  }
  void throw_if_any() const { diagnostics_.throw_if_any(); }

 private:
  input::Diagnostics diagnostics_;
};

/// Names that are wrong should be said before minutes of meshing and solving.
void check_materials(const input::Case& description) {
  Collector collect;
  if (description.body)
    for (const input::LayerSpec& layer : description.body->layers)
      if (layer.form == "membrane")
        collect([&] { materials::find_membrane_tissue(layer.material); });
      else if (layer.form != "rigid")
        collect([&] { materials::find_tissue(layer.material); });
  if (description.garment) collect([&] { materials::find_fabric(description.garment->fabric); });
  if (description.comfort) collect([&] { postproc::load_evidence(*description.comfort, description.directory); });
  collect.throw_if_any();
}

/// The part of an imported body that the garment is placed on, with a cell's margin.
mesh::Limb limb_below(const input::GarmentSpec& garment, const mesh::BodyMesh& body) {
  const double margin = body.mean_skin_cell;
  return mesh::limb_from_skin(body, garment.position - margin, garment.position + garment.pattern.length + margin,
                              garment.where);
}

/// An imported body may bring its loads along; a case without any would only say so after the solve.
void check_that_something_acts(const input::Case& description, const mesh::BodyMesh& body) {
  const auto moves = [](const mesh::HeldComponent& held) { return held.displacement != 0.0; };
  if (description.garment && !body.shell.empty())
    throw input::InputError(description.garment->where, "a garment on a shell body is not available yet",
                            "give the body as solids, or leave [garment], [contact] and [comfort] out");
  if (description.garment || description.load || !description.support.empty() || !body.forces.empty() || !body.pressures.empty() ||
      std::any_of(body.held.begin(), body.held.end(), moves))
    return;
  throw input::InputError(description.body->where, "nothing acts on the body",
                          "add [load] or a [[support]] that moves, or forces in " + description.body->mesh.string());
}

solver::Meshes make_meshes(const input::Case& description, const CaseOptions& options) {
  solver::Meshes meshes;
  if (!description.body) return meshes;
  if (description.body->kind == "imported") {
    const bool model = mesh::is_model_file(description.body->mesh);
    meshes.body = model ? mesh::import_model(*description.body) : mesh::import_body_mesh(*description.body, options.gmsh());
    check_that_something_acts(description, meshes.body);
    if (description.garment) meshes.limb = limb_below(*description.garment, meshes.body);
  } else {
    refuse_large_body(description, options.memory_limit());
    meshes.limb = mesh::make_limb(*description.body);
    meshes.body = mesh::make_body_mesh(*description.body, meshes.limb);
  }
  if (!description.garment) return meshes;
  const double cell_size = solver::worn_cell_size(description, meshes.limb, meshes.body);
  const double given = description.garment->cell_size;
  refuse_large_garment(description, given > 0.0 ? given : cell_size, options.memory_limit());
  meshes.garment = mesh::make_garment_mesh(*description.garment, meshes.limb, cell_size);
  return meshes;
}

}  // namespace

PreparedCase prepare(const std::filesystem::path& directory, const CaseOptions& options) {
  PreparedCase prepared;
  const Stopwatch reading;
  prepared.description = options.read(directory);
  check_materials(prepared.description);
  prepared.phases.push_back({"reading", reading.seconds()});
  const Stopwatch meshing;
  prepared.meshes = make_meshes(prepared.description, options);
  prepared.quality = mesh::quality(prepared.meshes.body);
  prepared.memory_limit = options.memory_limit();
  prepared.phases.push_back({"meshing", meshing.seconds()});
  return prepared;
}

}  // namespace snug::app
