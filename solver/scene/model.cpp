#include "solver/scene/model.hpp"

#include <algorithm>
#include <limits>

#include "cases/input/echo.hpp"

namespace snug::solver {

namespace {

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

/// The contact that names the garment, else the one that names nobody.
const input::ContactSpec* spec_of(const input::Case& description, const std::string& garment) {
  const input::ContactSpec* found = nullptr;
  for (const input::ContactSpec& contact : description.contacts) {
    if (contact.slave == garment) return &contact;
    if (contact.slave.empty()) found = &contact;
  }
  return found;
}

ContactModel make_contact(const input::ContactSpec& spec, const std::string& slave, bool alone) {
  ContactModel contact;
  contact.name = alone ? "contact" : "contact of " + slave;
  contact.slave = slave, contact.master = spec.master;
  contact.dual = spec.basis == input::GapTests::dual, contact.spread = spec.spread, contact.where = spec.where;
  return contact;
}

void add_garments(const input::Case& description, Collector& collect, Model& model) {
  for (const input::GarmentSpec& garment : description.garments)
    collect([&] {
      GarmentModel found{garment, materials::find_fabric(garment.fabric, garment.branch)};
      for (const input::ZoneSpec& zone : garment.zone) found.zones.push_back(materials::find_fabric(zone.fabric, garment.branch));
      model.garments.push_back(std::move(found));
    });
}

void add_contacts(const input::Case& description, Model& model) {
  std::vector<const input::ContactSpec*> solids;
  for (const input::ContactSpec& contact : description.contacts)
    if (!contact.slave.empty() && std::none_of(description.garments.begin(), description.garments.end(),
                                               [&](const auto& garment) { return garment.name == contact.slave; }))
      solids.push_back(&contact);
  const bool alone = model.garments.size() + solids.size() == 1;
  for (std::size_t g = 0; g < model.garments.size(); ++g) {
    const input::ContactSpec* spec = spec_of(description, model.garments[g].spec.name);
    if (!spec) continue;
    ContactModel& contact = model.contacts.emplace_back(make_contact(*spec, model.garments[g].spec.name, alone));
    contact.garment = static_cast<int>(g);
    contact.friction = friction_choice(spec->friction, model.garments[g].fabric);
  }
  for (const input::ContactSpec* spec : solids) {
    ContactModel& contact = model.contacts.emplace_back(make_contact(*spec, spec->slave, alone));
    if (contact.master.empty()) contact.master = "skin";
    contact.friction = {spec->friction.value_or(0.0), "the case"};
  }
}

}  // namespace

std::vector<materials::Fabric> GarmentModel::fabrics() const {
  std::vector<materials::Fabric> all{fabric};
  all.insert(all.end(), zones.begin(), zones.end());
  return all;
}

double GarmentModel::stiffness() const {
  double stiffest = fabric.stiffness();
  for (const materials::Fabric& zone : zones) stiffest = std::max(stiffest, zone.stiffness());
  return stiffest;
}

const ContactModel* Model::contact_of(int garment) const {
  const auto it = std::find_if(contacts.begin(), contacts.end(), [&](const auto& contact) { return contact.garment == garment; });
  return it == contacts.end() ? nullptr : &*it;
}

const ContactModel* Model::contact(const std::string& name) const {
  const auto it = std::find_if(contacts.begin(), contacts.end(), [&](const auto& contact) { return contact.name == name; });
  return it == contacts.end() ? nullptr : &*it;
}

bool Model::rubs(int garment) const {
  const ContactModel* contact = contact_of(garment);
  return contact && contact->friction.coefficient > 0.0;
}

bool Model::slides_freely() const {
  return std::any_of(garments.begin(), garments.end(), [](const auto& garment) { return garment.spec.held.empty(); });
}

bool Model::has_friction() const {
  return std::any_of(contacts.begin(), contacts.end(),
                     [](const auto& contact) { return contact.garment >= 0 && contact.friction.coefficient > 0.0; });
}

Model Model::with_friction(double coefficient) const {
  Model rubbing = *this;
  for (ContactModel& contact : rubbing.contacts)
    if (contact.garment >= 0) contact.friction = {coefficient, "a way to the answer"};
  return rubbing;
}

Model make_model(const input::Case& description) {
  Model model{.asked = description};
  Collector collect;
  if (description.body) {
    for (const input::LayerSpec& layer : description.body->layers) {
      if (layer.form == input::LayerForm::membrane)
        collect([&] { materials::find_membrane_tissue(layer.material); });
      else if (layer.form != input::LayerForm::rigid)
        collect([&] { materials::find_tissue(layer.material); });
    }
  }
  add_garments(description, collect, model);
  collect.throw_if_any();
  add_contacts(description, model);
  return model;
}

Model make_model(const input::Case& description, const mesh::BodyMesh& body) {
  Model model{.asked = description};
  Collector collect;
  add_garments(description, collect, model);
  for (const mesh::Layer& layer : body.layers) collect([&] { model.tissues.push_back(materials::find_tissue(layer.material)); });
  for (const mesh::SkinMembrane& membrane : body.membranes)
    collect([&] { model.membranes.push_back({materials::find_membrane_tissue(membrane.material).law, membrane.thickness}); });
  collect.throw_if_any();
  add_contacts(description, model);
  return model;
}

std::string echo_text(const Model& model) {
  return input::echo_text(model.asked, [](const input::Field& field, const input::MaterialEntry& reference) -> std::optional<input::Table> {
    if (field.key == "fabric") return materials::written_out_fabric(reference);
    if (field.key == "material" && reference.name != "rigid") return materials::written_out_tissue(reference);
    return std::nullopt;
  });
}

double softest_shear_modulus(const Model& model) {
  double softest = std::numeric_limits<double>::infinity();
  for (const materials::Tissue& tissue : model.tissues) softest = std::min(softest, materials::initial_shear_modulus(tissue.law));
  return softest;
}

}  // namespace snug::solver
