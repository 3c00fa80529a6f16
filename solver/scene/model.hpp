// What a case asks for, resolved: every law, fabric and coefficient found, every default filled. Nothing below looks one up.
#pragma once

#include <string>
#include <vector>

#include "cases/input/case.hpp"
#include "materials/fabric/fabric.hpp"
#include "materials/laws/skin_membrane.hpp"
#include "materials/laws/solid_law.hpp"
#include "mesh/body/body_mesh.hpp"
#include "solver/scene/friction_choice.hpp"

namespace snug::solver {

/// A garment with its fabrics.
struct GarmentModel {
  input::GarmentSpec spec;
  materials::Fabric fabric;                   ///< of what is in no zone
  std::vector<materials::Fabric> zones = {};  ///< of its zones (spec.zone), in their order

  /// Its own, then those of its zones: index 1 + zone.
  std::vector<materials::Fabric> fabrics() const;
  const materials::Fabric& fabric_of(int zone) const { return zone < 0 ? fabric : zones[zone]; }
  /// N/m, of the stiffest.
  double stiffness() const;
};

/// Surfaces that touch: a garment on what lies under it, or two surfaces of the body.
struct ContactModel {
  std::string name;           ///< of the interface: "contact", or "contact of SLAVE" where there are several
  int garment = -1;           ///< index of the slave; -1: `slave` is a surface of the body
  std::string slave;
  std::string master;         ///< of a garment: "skin", or the garment under it, or empty (layers.hpp); else a surface of the body
  bool dual = false;          ///< basis of the weighted gap
  FrictionChoice friction;
  bool spread = false;
  input::Location where = {};

  std::string friction_name() const { return name == "contact" ? "friction" : "friction of " + slave; }
};

struct Model {
  input::Case asked;                              ///< what the rest was made from; its materials are names
  std::vector<GarmentModel> garments;
  std::vector<ContactModel> contacts;             ///< garments first, in their order
  std::vector<materials::Tissue> tissues;         ///< one a layer of the body mesh
  std::vector<materials::SkinMembrane> membranes; ///< one a membrane of the body mesh

  bool deformable() const { return asked.solver.tier == input::Tier::L4; }
  /// The garment is particles that fall on the rigid skin.
  bool falls() const { return asked.solver.tier == input::Tier::particle; }
  /// The contact of a garment, or null where it touches nothing.
  const ContactModel* contact_of(int garment) const;
  /// The contact of that name.
  const ContactModel* contact(const std::string& name) const;
  /// True where friction holds the garment.
  bool rubs(int garment) const;
  /// True where neither an edge nor friction holds it: it is held at its probe edge, where a force means that it would slide off.
  bool probed(int garment) const { return garments[garment].spec.held.empty() && !rubs(garment); }
  /// True where a garment that no edge holds could slide off.
  bool slides_freely() const;
  /// True where some garment rubs on the skin.
  bool has_friction() const;
  /// Every garment that says nothing itself rubs with this coefficient.
  Model with_friction(double coefficient) const;
};

/// Looks up what the case names: garments and contacts, and the materials of its layers; errors come together.
/// Throws input::InputError.
Model make_model(const input::Case& description);
/// The same with the materials of the body's mesh, which of a foreign file are its own.
Model make_model(const input::Case& description, const mesh::BodyMesh& body);

/// The case with every value in SI, defaults filled in, and the materials that it names or gives written out: a case that reads
/// back to the same model (case.echo.toml).
std::string echo_text(const Model& model);

/// Shear modulus (Pa) of the softest layer that is solved; infinite for a rigid body.
double softest_shear_modulus(const Model& model);

}  // namespace snug::solver
