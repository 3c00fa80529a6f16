#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "materials/fabric/fabric.hpp"
#include "materials/laws/solid_law.hpp"
#include "solver/scene/constraints.hpp"
#include "solver/scene/friction_choice.hpp"
#include "solver/scene/garment_cells.hpp"
#include "solver/scene/laplace.hpp"
#include "solver/scene/loads.hpp"
#include "solver/scene/run.hpp"
#include "solver/scene/scene.hpp"

namespace snug::solver {

namespace {

long count(const Numbering& numbering, int begin, int end) {
  std::vector<char> seen(numbering.unknowns(), 0);
  long sum = 0;
  for (int i = begin; i < end; ++i)
    if (const int unknown = numbering.unknown(i); unknown >= 0 && !seen[unknown]) seen[unknown] = 1, ++sum;
  return sum;
}

void count_unknowns(const input::Case& description, const Meshes& meshes, bool deformable, Plan& plan) {
  const bool contact = description.garment && description.contact;
  const Layout layout = make_layout(meshes.body, meshes.garment, deformable, contact);
  const Numbering numbering = make_numbering(description, meshes.body, meshes.garment, layout,
                                             Supports(description, meshes.body, layout));
  const auto put = [&](const std::string& part, int begin, int end) {
    if (end > begin) plan.unknowns[part] = count(numbering, begin, end);
  };
  for (const Field& field : layout.fields())
    if (field.rows != Rows::cell) put(field.name == "body pressure" ? "pressure" : field.name, field.first, field.end());
}

void list_shell(const mesh::BodyMesh& body, Plan& plan) {
  for (std::size_t l = 0; l < body.layers.size(); ++l) {
    std::size_t count = 0;
    double low = std::numeric_limits<double>::infinity(), high = 0.0, foundation = 0.0;
    for (const mesh::ShellTriangle& t : body.shell) {
      if (t.layer != static_cast<int>(l)) continue;
      ++count, low = std::min(low, t.thickness), high = std::max(high, t.thickness), foundation = std::max(foundation, t.foundation);
    }
    if (count == 0) continue;
    plan.parts_in.push_back(fmt::format("{}: elastic shell that stretches and bends, {} mm, {} quadratic triangles{}", body.layers[l].name,
                                        low == high ? fmt::format("{:.4g}", 1e3 * low) : fmt::format("{:.4g} to {:.4g}", 1e3 * low, 1e3 * high),
                                        count, foundation > 0.0 ? fmt::format(", on springs of {:.4g} Pa/m", foundation) : ""));
  }
}

void list_body(const input::Case& description, const Meshes& meshes, Plan& plan) {
  if (plan.tier != "L4") {
    plan.parts_in.push_back(fmt::format("skin: rigid, {} biquadratic facets", meshes.body.skin_facets.size()));
    plan.parts_out.push_back("tissue: tier " + plan.tier + " takes the skin as rigid");
    return;
  }
  if (!meshes.body.shell.empty()) return list_shell(meshes.body, plan);
  for (std::size_t l = 0; l < meshes.body.layers.size(); ++l) {
    const auto cells = std::count(meshes.body.cell_layer.begin(), meshes.body.cell_layer.end(), static_cast<int>(l));
    plan.parts_in.push_back(fmt::format("{}: {}, {} {}", meshes.body.layers[l].name,
                                        materials::find_tissue(meshes.body.layers[l].material).name, cells,
                                        to_string(meshes.body.kind)));
  }
  for (const auto& membrane : meshes.body.membranes)
    plan.parts_in.push_back(fmt::format("{}: membrane of {:.2f} mm", membrane.name, 1e3 * membrane.thickness));
  if (!meshes.body.bone_nodes.empty())
    plan.parts_out.push_back("bone: rigid, a fixed boundary without unknowns");
}

// Why cloth has bending and weight in this scene or not, and where a number is not the fabric's own.
void list_loose_cloth(const input::GarmentSpec& garment, const materials::Fabric& fabric, const mesh::GarmentMesh& mesh, Plan& plan) {
  const LooseCloth cloth = loose_cloth(garment, mesh);
  const materials::Fabric sheet = materials::with_usual_sheet(fabric);
  const bool loose = mesh.stand_off > 0.0;
  const std::string why = loose ? fmt::format("the garment is up to {:.3g} mm wider all round than the body", 1e3 * mesh.stand_off)
                                : "the garment is nowhere wider than the body";
  const auto put = [&](const std::string& part, bool in, const std::optional<bool>& asked, const std::string& size) {
    const std::string reason = asked ? "the case says so" : in || !loose ? why : "it takes quadratic triangles";
    (in ? plan.parts_in : plan.parts_out).push_back(fmt::format("{}: {}{}", part, in ? size + "; " : "", reason));
  };
  const auto& B = sheet.bending;
  put("bending", cloth.bending, garment.bending,
      fmt::format("{:.3g} N m along the warp, {:.3g} along the weft{}", B.warp, B.weft,
                  fabric.bending.warp == 0.0 ? " (assumed: a bending length of 12 mm)" : ""));
  put("weight of the garment", cloth.weight, garment.weight,
      fmt::format("{:.3g} g/m2{}", 1e3 * sheet.areal_density, fabric.areal_density == 0.0 ? " (assumed)" : ""));
}

void list_garment(const input::Case& description, const Meshes& meshes, Plan& plan) {
  if (!description.garment) {
    plan.parts_out.push_back("garment: no [garment] in the case");
    plan.parts_out.push_back("contact: no garment");
    return;
  }
  const auto fabric = materials::find_fabric(description.garment->fabric);
  if (plan.tier == "L0") {
    plan.parts_in.push_back("garment: law of Laplace, tension of " + fabric.name);
    plan.parts_out.push_back("garment mesh, contact: tier L0 has no unknowns");
    return;
  }
  plan.parts_in.push_back(
      fmt::format("garment: {}, tension-field membrane, {} P{} triangles", fabric.name, meshes.garment.triangles.size(), meshes.garment.order));
  if (description.contact)
    plan.parts_in.push_back("contact: weighted gaps, " + description.contact->basis + " multipliers");
  else
    plan.parts_out.push_back("contact: no [contact] in the case");
  if (const FrictionChoice friction = friction_choice(description); friction.coefficient > 0.0)
    plan.parts_in.push_back(fmt::format("friction: coefficient {:g} ({})", friction.coefficient, friction.source));
  else
    plan.parts_out.push_back("friction: " + (description.contact ? "none, says " + friction.source : friction.source));
  list_loose_cloth(*description.garment, fabric, meshes.garment, plan);
}

void list_file_loads(const mesh::BodyMesh& body, Plan& plan) {
  if (!body.forces.empty()) plan.parts_in.push_back(fmt::format("load: forces of the file at {} nodes", body.forces.size()));
  if (!body.pressures.empty()) plan.parts_in.push_back("load: pressures of the file, following the surface");
  if (!body.held.empty()) plan.parts_in.push_back(fmt::format("support: {} components of nodes held by the file", body.held.size()));
}

void list_loads(const input::Case& description, const Meshes& meshes, Plan& plan) {
  const bool of_file = !meshes.body.forces.empty() || !meshes.body.pressures.empty();
  if (!description.load || description.load->empty()) {
    if (!of_file) plan.parts_out.push_back("load: no [load] in the case");
  } else {
    const input::LoadSpec& load = *description.load;
    if (load.skin_pressure != 0.0) plan.parts_in.push_back("load: follower pressure on the skin");
    for (const auto& p : load.pressure) plan.parts_in.push_back(fmt::format("load: follower pressure on {}", p.on));
    for (const auto& t : load.traction) plan.parts_in.push_back(fmt::format("load: dead traction on {}", t.on));
    for (const auto& f : load.force) plan.parts_in.push_back(fmt::format("load: dead force on {}", f.at ? "a point" : f.on));
    if (load.gravity != std::array<double, 3>{0, 0, 0}) plan.parts_in.push_back("load: weight");
  }
  list_file_loads(meshes.body, plan);
  for (const auto& support : description.support) plan.parts_in.push_back(fmt::format("support: {}", support.on));
}

// Building the scene finds loads that nothing bears.
void list_free_motions(const input::Case& description, const Meshes& meshes, Plan& plan) {
  const Supports supports(description, meshes.body, make_layout(meshes.body, meshes.garment, true, false));
  if (supports.free_parts().empty()) return;
  make_scene(description, meshes.body, meshes.garment, Skin::deformable);
  for (const FreePart& part : supports.free_parts())
    plan.parts_in.push_back(fmt::format("support: {} is free {}: held without force, statically determinate", part.name, motions_text(part)));
}

// Whether the garment presses harder than the softest tissue is stiff (law of Laplace).
bool presses_hard(const input::Case& description, const Meshes& meshes) {
  if (meshes.body.layers.empty()) return false;
  const auto fabric = materials::find_fabric(description.garment->fabric);
  return laplace_pressure(*description.garment, fabric, meshes.limb, meshes.body).mean > softest_shear_modulus(meshes.body);
}

// Time and memory by unknowns, fitted to the scenes of tests/stability, on two cores (2026-11): a guide, no promise. A body alone
// takes half the iterations of one with a garment, friction is let go in a stage of its own, which goes step by step where the
// garment presses harder than the tissue is stiff, and cloth off the skin takes twice as many.
void estimate(const input::Case& description, const Meshes& meshes, Plan& plan) {
  double rigid = 0.0, body = 0.0;
  for (const auto& [part, unknowns] : plan.unknowns) (part == "body" ? body : rigid) += static_cast<double>(unknowns);
  plan.seconds = 1e-4 * rigid + (body > 0.0 ? 4e-6 * std::pow(body + rigid, 1.4) : 0.0);
  if (!description.garment) plan.seconds *= 0.5;
  if (has_friction(description)) plan.seconds *= 1.6;
  if (has_friction(description) && body > 0.0 && presses_hard(description, meshes)) plan.seconds *= 5.0;
  if (description.garment && loose_cloth(*description.garment, meshes.garment).bending) plan.seconds *= 2.5;
  plan.memory_bytes = 2e8 + 6e3 * rigid + 3e4 * body;
}

}  // namespace

Plan plan(const input::Case& description, const Meshes& meshes) {
  Plan plan;
  plan.tier = description.solver.tier;
  list_body(description, meshes, plan);
  list_garment(description, meshes, plan);
  if (plan.tier == "L4") list_loads(description, meshes, plan);
  if (plan.tier == "L4") list_free_motions(description, meshes, plan);
  if (!description.comfort) plan.parts_out.push_back("comfort: no [comfort] in the case");
  if (plan.tier != "L0") count_unknowns(description, meshes, plan.tier == "L4", plan);
  estimate(description, meshes, plan);
  return plan;
}

}  // namespace snug::solver
