#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "mesh/placement/fit_on_body.hpp"
#include "solver/scene/bands.hpp"
#include "solver/scene/constraints.hpp"
#include "solver/scene/laplace.hpp"
#include "solver/scene/layers.hpp"
#include "solver/scene/loads.hpp"
#include "solver/scene/particle_scene.hpp"
#include "solver/scene/run.hpp"
#include "solver/scene/scene.hpp"
#include "solver/scene/tools.hpp"

namespace snug::solver {

namespace {

long count(const Numbering& numbering, int begin, int end) {
  std::vector<char> seen(numbering.unknowns(), 0);
  long sum = 0;
  for (int i = begin; i < end; ++i)
    if (const int unknown = numbering.unknown(i); unknown >= 0 && !seen[unknown]) seen[unknown] = 1, ++sum;
  return sum;
}

/// The tip of a tool is prescribed.
bool of_tool(const Model& model, const Field& field) {
  return std::any_of(model.asked.tools.begin(), model.asked.tools.end(), [&](const auto& tool) { return tip_field(tool) == field.name; });
}

void count_unknowns(const Model& model, const Meshes& meshes, Plan& plan) {
  const Layout layout = make_layout(model, meshes, model.deformable() ? Skin::deformable : Skin::rigid);
  const Numbering numbering = make_numbering(model, meshes, layout, Supports(model, meshes.body, layout));
  for (const Field& field : layout.fields())
    if (field.rows != Rows::cell && field.count > 0 && !of_tool(model, field))
      plan.unknowns[field.name == "body pressure" ? "pressure" : field.name] = count(numbering, field.first, field.end());
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

/// What the body's outer facets are called.
const char* facets_text(mesh::FacetKind kind) {
  return kind == mesh::FacetKind::quad9 ? "biquadratic" : kind == mesh::FacetKind::quad4 ? "bilinear" : "quadratic triangular";
}

void list_body(const Model& model, const Meshes& meshes, Plan& plan) {
  const mesh::BodyMesh& body = meshes.body;
  if (!model.deformable()) {
    plan.parts_in.push_back(fmt::format("skin: rigid, {} {} facets", body.skin_facets.size(), facets_text(facet_kind(body.kind))));
    plan.parts_out.push_back("tissue: tier " + plan.tier + " takes the skin as rigid");
    for (const auto& support : model.asked.support)
      plan.parts_out.push_back(fmt::format("support: {}, for tier {} takes the body as rigid", support.on, plan.tier));
    return;
  }
  if (!body.shell.empty()) return list_shell(body, plan);
  for (std::size_t l = 0; l < body.layers.size(); ++l) {
    const auto cells = std::count(body.cell_layer.begin(), body.cell_layer.end(), static_cast<int>(l));
    plan.parts_in.push_back(fmt::format("{}: {}, {} {}", body.layers[l].name, model.tissues[l].name, cells, to_string(body.kind)));
  }
  for (const auto& membrane : body.membranes)
    plan.parts_in.push_back(fmt::format("{}: membrane of {:.2f} mm", membrane.name, 1e3 * membrane.thickness));
  if (!body.bone_nodes.empty())
    plan.parts_out.push_back("bone: rigid, a fixed boundary without unknowns");
}

std::string bending_text(const materials::Fabric& fabric) {
  const auto B = materials::with_usual_sheet(fabric).bending;
  return fmt::format("{:.3g} N m along the warp, {:.3g} along the weft{}", B.warp, B.weft, fabric.bending.warp == 0.0 ? " (assumed: a bending length of 12 mm)" : "");
}

std::string weight_text(const materials::Fabric& fabric) {
  return fmt::format("{:.3g} g/m2{}", 1e3 * materials::with_usual_sheet(fabric).areal_density, fabric.areal_density == 0.0 ? " (assumed)" : "");
}

/// "N85L15", or "N85L15 and C98L2".
std::string names_of_fabrics(const GarmentModel& garment) {
  std::vector<std::string> names;
  for (const materials::Fabric& fabric : garment.fabrics())
    if (std::find(names.begin(), names.end(), fabric.name) == names.end()) names.push_back(fabric.name);
  return fmt::format("{}", fmt::join(names, " and "));
}

/// What a text says of the garment's fabric, or of each of several: "N85L15 …, C98L2 …".
std::string of_each(const GarmentModel& garment, std::string (*text)(const materials::Fabric&)) {
  if (garment.zones.empty()) return text(garment.fabric);
  std::vector<std::string> texts;
  for (const materials::Fabric& fabric : garment.fabrics())
    if (std::string one = fmt::format("{} {}", fabric.name, text(fabric)); std::find(texts.begin(), texts.end(), one) == texts.end()) texts.push_back(std::move(one));
  return fmt::format("{}", fmt::join(texts, "; "));
}

// Why cloth has bending and weight in this scene or not, and where a number is not the fabric's own.
void list_loose_cloth(const GarmentModel& model, const mesh::GarmentMesh& mesh, Plan& plan) {
  const input::GarmentSpec& garment = model.spec;
  const std::string& name = garment.name;
  const LooseCloth cloth = loose_cloth(garment, mesh);
  const bool loose = mesh.stand_off > 0.0, on_shoulders = !loose && mesh::above_girths(mesh.fit) > 0.0;
  const std::string wide = loose ? fmt::format("the {} is up to {:.3g} mm wider all round than the body", name, 1e3 * mesh.stand_off)
                                 : "the " + name + " is nowhere wider than the body";
  const std::string bent = !loose && !on_shoulders ? wide : !cloth.bending ? "it takes quadratic triangles"
                           : loose ? wide : "on shoulders no girth tells where the " + name + " is taut";
  const auto put = [&](const std::string& part, bool in, const std::optional<bool>& asked, const std::string& size, const std::string& why) {
    const std::string reason = asked ? "the case says so" : why;
    (in ? plan.parts_in : plan.parts_out).push_back(fmt::format("{}: {}{}", part, in ? size + "; " : "", reason));
  };
  put(name == "garment" ? "bending" : "bending of the " + name, cloth.bending, garment.bending, of_each(model, bending_text), bent);
  put("weight of the " + name, cloth.weight, garment.weight, of_each(model, weight_text), wide);
}

/// What of a garment is of which fabric, where it is of several.
void list_fabrics(const GarmentModel& garment, const mesh::GarmentMesh& mesh, Plan& plan) {
  if (garment.zones.empty()) return;
  std::vector<double> areas(mesh.pieces.size(), 0.0);
  std::vector<int> zone(mesh.pieces.size(), -1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) areas[mesh.piece_of(t)] += mesh.cut_area(t), zone[mesh.piece_of(t)] = mesh.zone_of(t);
  for (std::size_t p = 0; p < mesh.pieces.size(); ++p)
    plan.parts_in.push_back(fmt::format("fabric of {}, {}: {}, {:.4g} cm2", garment.spec.name, mesh.pieces[p], garment.fabric_of(zone[p]).name, 1e4 * areas[p]));
}

/// "on": what the slave lies on where it is not the skin alone.
void list_contact(const ContactModel* contact, const std::string& on, Plan& plan) {
  const std::string part = contact ? contact->name : "contact", rubbing = contact ? contact->friction_name() : "friction";
  if (!contact) {
    plan.parts_out.push_back("contact: no [contact] in the case");
    plan.parts_out.push_back("friction: no garment in contact");
    return;
  }
  plan.parts_in.push_back(fmt::format("{}: weighted gaps, {} multipliers{}", part, contact->dual ? "dual" : "hat", on));
  const FrictionChoice& friction = contact->friction;
  if (friction.coefficient > 0.0)
    plan.parts_in.push_back(fmt::format("{}: coefficient {:g} ({})", rubbing, friction.coefficient, friction.source));
  else
    plan.parts_out.push_back(fmt::format("{}: none, says {}", rubbing, friction.source));
}

/// ", on inner where it lies over it, else on the skin"; nothing where there is the skin alone.
std::string layers_text(const std::vector<std::string>& masters) {
  std::string text;
  for (std::size_t m = 0; m + 1 < masters.size(); ++m) text += fmt::format("{} {}", text.empty() ? "" : ", else on", masters[m]);
  return text.empty() ? text : fmt::format(", on{} where it lies over it, else on the skin", text);
}

void list_bands(const input::GarmentSpec& garment, const mesh::GarmentMesh& mesh, Plan& plan) {
  for (const input::BandSpec& band : garment.band) {
    const BandModel as = band_model(band, mesh);
    plan.parts_in.push_back(fmt::format("band of {}, {} edge: {:.3g} N at a strain of 1, {:.4g} mm at rest along {:.4g} mm as cut", garment.name, band.edge, as.stiffness,
                                        1e3 * as.rest_length, 1e3 * as.edge_length));
  }
}

/// A garment of particles: what acts on them.
void list_falling_garment(const Model& model, const Meshes& meshes, Plan& plan) {
  const GarmentModel& garment = model.garments.front();
  const mesh::GarmentMesh& mesh = meshes.garments.front();
  const std::string& name = garment.spec.name;
  plan.parts_in.push_back(fmt::format("{}: {}, {} particles at the corners of {} triangles, stretched and sheared", name, names_of_fabrics(garment), count_particles(mesh), mesh.triangles.size()));
  list_fabrics(garment, mesh, plan);
  if (!mesh.fit.placing.empty()) plan.parts_in.push_back(fmt::format("{}: placed {}", name, mesh.fit.placing));
  plan.parts_in.push_back("bending: " + of_each(garment, bending_text));
  plan.parts_in.push_back("weight: " + of_each(garment, weight_text));
  plan.parts_in.push_back(fmt::format("air: {:g} N s/m3 against the velocity while it falls", air_drag));
  list_bands(garment.spec, mesh, plan);
  const ContactModel* contact = model.contact_of(0);
  plan.parts_in.push_back(fmt::format("contact: the skin repels particles nearer than {:g} mm", 1e3 * skin_reach));
  if (contact->friction.coefficient > 0.0)
    plan.parts_in.push_back(fmt::format("friction: coefficient {:g} ({})", contact->friction.coefficient, contact->friction.source));
  else
    plan.parts_out.push_back(fmt::format("friction: none, says {}", contact->friction.source));
  plan.parts_out.push_back("pressures: particles give the shape of cloth, not what it presses with (tiers L1 and L4 do)");
  plan.parts_out.push_back("contact of the cloth with itself: folds may go through one another");
}

void list_garment(const Model& model, int g, const Meshes& meshes, Plan& plan) {
  if (model.falls()) return list_falling_garment(model, meshes, plan);
  const std::string& name = model.garments[g].spec.name;
  const std::string fabric = names_of_fabrics(model.garments[g]);
  if (model.asked.solver.tier == input::Tier::L0) {
    plan.parts_in.push_back(fmt::format("{}: law of Laplace, tension of {}", name, fabric));
    if (g == 0) plan.parts_out.push_back("garment mesh, contact: tier L0 has no unknowns");
    return;
  }
  const mesh::GarmentMesh& mesh = meshes.garments[g];
  plan.parts_in.push_back(
      fmt::format("{}: {}, tension-field membrane, {} P{} triangles", name, fabric, mesh.triangles.size(), mesh.order));
  list_fabrics(model.garments[g], mesh, plan);
  if (!mesh.fit.placing.empty()) plan.parts_in.push_back(fmt::format("{}: placed {}", name, mesh.fit.placing));
  list_contact(model.contact_of(g), layers_text(master_names(meshes.garments, layers_under(model, meshes.garments, g))), plan);
  list_loose_cloth(model.garments[g], mesh, plan);
  list_bands(model.garments[g].spec, mesh, plan);
}

// A garment whose contact names the skin alone lies over others without touching them: thin cloth passes on what presses on it.
void list_overlaps(const Model& model, const Meshes& meshes, Plan& plan) {
  for (std::size_t a = 0; a < model.garments.size(); ++a)
    for (std::size_t b = a + 1; b < model.garments.size(); ++b) {
      const mesh::GarmentMesh &one = meshes.garments[a], &other = meshes.garments[b];
      if (const ContactModel* contact = model.contact_of(static_cast<int>(b)); !contact || contact->master != "skin") continue;
      const double low = std::max(one.fit.lower, other.fit.lower), high = std::min(one.fit.upper, other.fit.upper);
      if (high > low)
        plan.parts_out.push_back(fmt::format("contact of {} with {}: the case lays it on the skin alone; over one another at heights {:.0f} to {:.0f} mm, "
                                             "each touches the skin and their pressures add up",
                                             other.name, one.name, 1e3 * low, 1e3 * high));
    }
}

void list_garments(const Model& model, const Meshes& meshes, Plan& plan) {
  if (model.garments.empty()) plan.parts_out.push_back("garment: no [garment] in the case");
  if (model.garments.empty() && model.contacts.empty() && model.asked.tools.empty()) plan.parts_out.push_back("contact: no garment");
  for (std::size_t g = 0; g < model.garments.size(); ++g) list_garment(model, static_cast<int>(g), meshes, plan);
  list_overlaps(model, meshes, plan);
  for (const ContactModel& contact : model.contacts)
    if (contact.garment < 0) list_contact(&contact, ", on " + contact.master, plan);
}

void list_file_loads(const mesh::BodyMesh& body, Plan& plan) {
  if (!body.forces.empty()) plan.parts_in.push_back(fmt::format("load: forces of the file at {} nodes", body.forces.size()));
  if (!body.pressures.empty()) plan.parts_in.push_back("load: pressures of the file, following the surface");
  if (!body.held_along.empty())
    plan.parts_in.push_back(fmt::format("support: nodes held by the file along {} directions of their own", body.held_along.size()));
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

void list_tools(const Model& model, const mesh::BodyMesh& body, Plan& plan) {
  for (std::string& part : tool_parts(model, body)) plan.parts_in.push_back(std::move(part));
}

// The way through the postures; the mesh says whether there is one.
void list_postures(const Model& model, const Movement& movement, Plan& plan) {
  if (model.asked.postures.empty()) return;
  if (movement.empty()) return plan.parts_out.push_back(fmt::format("postures: tier {} has a rigid skin, which does not bend", input::text_of(model.asked.solver.tier)));
  for (int k = 1; k <= movement.postures(); ++k)
    plan.parts_in.push_back(fmt::format("posture: {}, {}, in {} {} at least", movement.name(k), movement.text(k), movement.steps(k), movement.steps(k) == 1 ? "step" : "steps"));
}

// Building the scene finds loads that nothing bears.
void list_free_motions(const Model& model, const Meshes& meshes, Plan& plan) {
  const Supports supports(model, meshes.body, make_layout(model, meshes, Skin::deformable));
  if (supports.free_parts().empty()) return;
  make_scene(model, meshes, Skin::deformable);
  for (const FreePart& part : supports.free_parts())
    plan.parts_in.push_back(fmt::format("support: {} is free {}: held without force, statically determinate", part.name, motions_text(part)));
}

// Whether a garment presses harder than the softest tissue is stiff (law of Laplace).
bool presses_hard(const Model& model, const Meshes& meshes) {
  for (std::size_t g = 0; g < model.garments.size(); ++g)
    if (laplace_pressure(meshes.garments[g].fit, model.garments[g], meshes.limb, meshes.body).mean > softest_shear_modulus(model)) return true;
  return false;
}

bool bends(const Model& model, const Meshes& meshes) {
  for (std::size_t g = 0; g < model.garments.size(); ++g)
    if (loose_cloth(model.garments[g].spec, meshes.garments[g]).bending) return true;
  return false;
}

// With the factor on disk, by unknowns of the body: 1.39 and 2.66 GB of memory at 149,000 and 308,000 unknowns, 0.59 GB of disk at the former (2026-11), where 98 stands for 110; the factor of a
// solid in the order of nested dissection grows with n^(4/3) (George 1973).
constexpr double beside_disk = 8.5e3, factor_on_disk = 110.0, slower_on_disk = 1.3;

// Time and memory by unknowns, fitted to the scenes of tests/stability, on two cores (2026-11): a guide, no promise. A body alone
// takes half the iterations of one with a garment, friction is let go in a stage of its own, which goes step by step where the
// garment presses harder than the tissue is stiff, and cloth off the skin takes twice as many. A factor in single precision takes
// about half of all.
void estimate(const Model& model, const Meshes& meshes, double memory, Plan& plan) {
  if (model.falls()) {
    const double unknowns = 3.0 * count_particles(meshes.garments.front());
    plan.unknowns["garment"] = static_cast<long>(unknowns);
    plan.seconds = 6e-3 * unknowns, plan.memory_bytes = 2e8 + 2e4 * unknowns;
    return;
  }
  double rigid = 0.0, body = 0.0;
  for (const auto& [part, unknowns] : plan.unknowns) (part == "body" ? body : rigid) += static_cast<double>(unknowns);
  plan.seconds = 1e-4 * rigid + (body > 0.0 ? 4e-6 * std::pow(body + rigid, 1.4) : 0.0);
  if (body + rigid >= single_precision_from) plan.seconds *= 0.45;
  if (model.garments.empty()) plan.seconds *= 0.5;
  if (model.has_friction()) plan.seconds *= 1.6;
  if (model.has_friction() && body > 0.0 && presses_hard(model, meshes)) plan.seconds *= 5.0;
  if (model.asked.solver.tier != input::Tier::L0 && bends(model, meshes)) plan.seconds *= 2.5;
  const Need need = need_of_run(rigid, body);
  plan.memory_bytes = need.memory;
  if (memory <= 0.0 || need.memory <= memory || need.disk <= 0.0) return;
  plan.parts_in.push_back(fmt::format("factor of the matrix: written to disk, {:.3g} GB; with it in memory the case would take {:.3g} GB, and there are {:.3g}", 1e-9 * need.disk, 1e-9 * need.memory, 1e-9 * memory));
  plan.memory_bytes = need.memory_beside_disk, plan.disk_bytes = need.disk, plan.seconds *= slower_on_disk;
}

// Of the time to put the garment on.
constexpr double share_of_a_step = 0.5;

}  // namespace

Need need_of_run(double rigid, double body) {
  const bool single = body + rigid >= single_precision_from;
  Need need{.memory = 2e8 + 6e3 * rigid + (single ? 1.4e4 : 2.4e4) * body};
  need.memory_beside_disk = need.memory;
  if (body <= 0.0 || !single) return need;
  need.memory_beside_disk = 2e8 + 6e3 * rigid + beside_disk * body;
  need.disk = factor_on_disk * std::pow(body, 4.0 / 3.0);
  return need;
}

Plan plan(const Model& model, const Meshes& meshes, double memory) {
  Plan plan;
  plan.tier = input::text_of(model.asked.solver.tier);
  list_body(model, meshes, plan);
  list_garments(model, meshes, plan);
  if (model.deformable()) list_loads(model.asked, meshes, plan);
  list_tools(model, meshes.body, plan);
  const Movement movement(model, meshes.body);
  list_postures(model, movement, plan);
  if (model.deformable()) list_free_motions(model, meshes, plan);
  if (!model.asked.comfort) plan.parts_out.push_back("comfort: no [comfort] in the case");
  if (model.asked.solver.tier != input::Tier::L0 && !model.falls()) count_unknowns(model, meshes, plan);
  estimate(model, meshes, memory, plan);
  if (!movement.empty()) plan.seconds *= 1.0 + share_of_a_step * movement.all_steps();
  return plan;
}

}  // namespace snug::solver
