// The scene of a case: which terms its parts have and what joins them.
#include <algorithm>

#include "solver/scene/bands.hpp"
#include "solver/scene/layers.hpp"
#include "solver/scene/loads.hpp"
#include "solver/scene/scene.hpp"
#include "solver/scene/tools.hpp"
#include "solver/terms/drag.hpp"
#include "solver/terms/facet_kind.hpp"
#include "solver/terms/shell.hpp"
#include "solver/terms/skin_membrane_term.hpp"

namespace snug::solver {

namespace {

// A garment that sticks gives way to its own tension by this fraction of what a triangle alone would.
constexpr double sticking = 2.0;

// Pressure per gap of the stiffest layer: computed, never a user's number.
double body_stiffness(const Model& model, double master_edge) {
  double stiffest = 0.0;
  for (const materials::Tissue& tissue : model.tissues)
    stiffest = std::max(stiffest, 3.0 * materials::initial_shear_modulus(tissue.law) / master_edge);
  return stiffest;
}

// The same of a sheet.
double sheet_stiffness(const GarmentModel& model, const mesh::GarmentMesh& garment) {
  return model.stiffness() / (garment.mean_edge * garment.mean_edge);
}

ShellElasticity shell_elasticity(const materials::Tissue& tissue, const mesh::Layer& layer) {
  if (const auto* elastic = std::get_if<materials::LinearElastic>(&tissue.law)) return {elastic->youngs_modulus, elastic->poisson_ratio};
  throw input::InputError(layer.material.where, "the law of the shell \"" + layer.name + "\" is not linear",
                          "write law = \"linear-elastic\" with youngs_modulus and poisson_ratio");
}

// The same of a shell body: of its stiffest triangle as a sheet.
double shell_stiffness(const Model& model, const mesh::BodyMesh& body, double edge) {
  double stiffest = 0.0;
  for (const mesh::ShellTriangle& t : body.shell)
    stiffest = std::max(stiffest, shell_elasticity(model.tissues[t.layer], body.layers[t.layer]).youngs_modulus * t.thickness / (edge * edge));
  return stiffest;
}

void add_body(const Model& model, const mesh::BodyMesh& body, Scene& scene) {
  const Field& position = scene.layout()["body"];
  scene.add(Part{"body", Role::body, position});
  if (!body.shell.empty()) {
    std::vector<ShellElasticity> elasticity;
    for (std::size_t l = 0; l < body.layers.size(); ++l) elasticity.push_back(shell_elasticity(model.tissues[l], body.layers[l]));
    scene.add(std::make_unique<Shell>(position, body, std::move(elasticity), model.asked.body->where));
  } else {
    std::vector<materials::SolidLaw> laws;
    for (const materials::Tissue& tissue : model.tissues) laws.push_back(tissue.law);
    scene.add(std::make_unique<Tissue>("tissue", body_fields(scene.layout(), "body"), body, std::move(laws)));
    for (const materials::SkinMembrane& membrane : model.membranes)
      scene.add(std::make_unique<SkinMembraneTerm>(position, body, membrane));
  }
  add_loads(model, body, scene);
}

double ground_stiffness(const Model& model, const mesh::BodyMesh& body, double edge) {
  return body.shell.empty() ? body_stiffness(model, edge) : shell_stiffness(model, body, edge);
}

void add_touch(const ContactModel& contact, std::vector<std::string> masters, const FabricMembrane* sheet, Interface interface, double stiffness,
               double stick, Scene& scene) {
  const double edge = interface.slave.mean_edge;
  Touch touch{.slave = contact.slave, .masters = std::move(masters), .sheet = sheet};
  touch.contact = &scene.add(std::make_unique<Contact>(contact.name, std::move(interface), stiffness,
                                                       contact.dual ? GapBasis::dual : GapBasis::hat));
  if (contact.friction.coefficient > 0.0)
    touch.friction = &scene.add(std::make_unique<Friction>(contact.friction_name(), *touch.contact, contact.friction.coefficient,
                                                           Friction::usual_elastic_slip * edge, sticking * stick));
  scene.add(std::move(touch));
}

void add_garment(const Model& model, int g, const Meshes& meshes, Skin skin, std::optional<double> prestretch, Scene& scene) {
  const GarmentModel& garment = model.garments[g];
  const mesh::GarmentMesh& mesh = meshes.garments[g];
  const Field& position = scene.layout()[mesh.name];
  scene.add(Part{mesh.name, Role::garment, position});
  const FabricMembrane& fabric = scene.add(std::make_unique<FabricMembrane>(mesh.name, position, mesh, garment.fabrics(), prestretch));
  add_loose_cloth(model, g, mesh, scene);
  add_bands(garment.spec, mesh, scene);
  const ContactModel* contact = model.contact_of(g);
  if (!contact) return;
  const double sheet = sheet_stiffness(garment, mesh);
  const std::vector<int> under = layers_under(model, meshes.garments, g);
  MasterSurface ground(scene.layout()["body"], meshes.body, meshes.body.skin_facets);
  double stiffness = skin == Skin::deformable ? std::max(sheet, ground_stiffness(model, meshes.body, ground.mean_edge())) : sheet;
  for (const int layer : under) stiffness = std::max(stiffness, sheet_stiffness(model.garments[layer], meshes.garments[layer]));
  add_touch(*contact, master_names(meshes.garments, under), &fabric,
            {scene.layout()[contact->name], slave_with_bands(position, garment.spec, mesh), over_layers(scene.layout(), meshes.garments, under, std::move(ground))},
            stiffness, sheet, scene);
}

void add_solid_contact(const Model& model, const ContactModel& contact, const mesh::BodyMesh& body, Scene& scene) {
  const Field& position = scene.layout()["body"];
  MasterSurface master(position, body, contact_facets(body, contact.master, contact.where));
  const double stiffness = body_stiffness(model, master.mean_edge());
  add_touch(contact, {contact.master}, nullptr,
            {scene.layout()[contact.name], surface_slave(position, body, slave_facets(body, contact)), std::move(master)}, stiffness,
            stiffness, scene);
}

// What cloth that rubs and has lost its rest, and the skin below it, creep against: cloth is held back as it is damped, skin by its own stiffness over a cell.
void add_drag(const Model& model, const mesh::BodyMesh& body, Skin skin, Scene& scene) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(scene.layout().size());
  for (const Touch& touch : scene.touches())
    if (touch.sheet && touch.friction) touch.sheet->damp(weights);
  if (!weights.isZero(0.0) && skin == Skin::deformable) {
    const Field& position = scene.layout()["body"];
    const double stiffness = ground_stiffness(model, body, mesh::mean_edge(body, body.skin_facets));
    for (const auto& facet : body.skin_facets) {
      const double share = area(body, {facet}) / node_count(facet_kind(body.kind));
      for (int a = 0; a < node_count(facet_kind(body.kind)); ++a)
        for (int c = 0; c < 3; ++c) weights[position(facet[a], c)] += stiffness * share;
    }
  }
  for (const auto& [entry, follows] : scene.numbering().bound()) weights[entry] = 0.0;
  if (!weights.isZero(0.0)) scene.add(std::make_unique<Drag>(weights));
}

// What is left free must be in balance before anything moves.
void check_balance(const Scene& scene, const Model& model, const Meshes& meshes, const input::Location& where) {
  State state = placed_state(scene.layout(), model, meshes);
  state.load = 1.0;
  const Eigen::VectorXd load = scene.load_forces(state);
  const Field& body = scene.layout()["body"];
  std::vector<Eigen::Vector3d> forces;
  for (int node = 0; node < body.count; ++node) forces.push_back(load.segment<3>(body(node)));
  check_balance(scene.supports(), meshes.body, forces, where);
}

}  // namespace

Scene make_scene(const Model& model, const Meshes& meshes, Skin skin, std::optional<double> prestretch) {
  const Layout layout = make_layout(model, meshes, skin);
  Supports supports(model, meshes.body, layout);
  Numbering numbering = make_numbering(model, meshes, layout, supports);
  Scene scene(layout, std::move(numbering), std::move(supports));
  if (skin == Skin::deformable) add_body(model, meshes.body, scene);
  if (!scene.supports().free_parts().empty()) check_balance(scene, model, meshes, model.asked.body->where);
  for (std::size_t g = 0; g < model.garments.size(); ++g) add_garment(model, static_cast<int>(g), meshes, skin, prestretch, scene);
  add_drag(model, meshes.body, skin, scene);
  for (const ContactModel& contact : model.contacts)
    if (contact.garment < 0 && skin == Skin::deformable) add_solid_contact(model, contact, meshes.body, scene);
  if (skin == Skin::deformable) add_tools(model, meshes.body, body_stiffness, scene);
  return scene;
}

State placed_state(const Layout& layout, const Meshes& meshes) {
  State state;
  state.values = Eigen::VectorXd::Zero(layout.size());
  const auto place = [&](const Field& field, const std::vector<Eigen::Vector3d>& at) {
    for (int node = 0; node < field.count; ++node) state.values.segment<3>(field(node)) = at[node];
  };
  place(layout["body"], meshes.body.nodes);
  for (const mesh::GarmentMesh& garment : meshes.garments) place(layout[garment.name], garment.placed);
  return state;
}

State placed_state(const Layout& layout, const Model& model, const Meshes& meshes) {
  State state = placed_state(layout, meshes);
  for (const input::ToolSpec& tool : model.asked.tools)
    if (const Field& tip = layout[tip_field(tool)]; tip.count > 0) state.values.segment<3>(tip(0)) = place_tool(meshes.body, tool).start;
  return state;
}

}  // namespace snug::solver
