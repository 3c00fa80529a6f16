// The loads of a case as terms of the scene.
#pragma once

#include "solver/scene/scene.hpp"
#include "solver/terms/dead_load.hpp"

namespace snug::solver {

/// Tractions, forces and weight of the case and the forces of an imported body, N, one a node.
NodalForces dead_forces(const Model& model, const mesh::BodyMesh& body);
/// Follower pressures on the skin, on named surfaces and of an imported body.
std::vector<mesh::FacetPressure> surface_pressures(const input::LoadSpec& load, const mesh::BodyMesh& body);

/// Standard gravity along the body's axis, which is upright; m/s2.
inline constexpr std::array<double, 3> upright_gravity = {0.0, 0.0, -9.80665};

/// What makes loose cloth hang: whether the scene has the fabric's bending and its weight. Both unless the case says
/// otherwise where a part of the garment is wider than the body as placed; bending also where cloth lies on shoulders: slack in both directions it
/// would have no stiffness at all, and letting go of it does not settle (a vest: 45 iterations end at 1e-5, with bending 25 at 1e-10). It takes
/// quadratic triangles.
struct LooseCloth {
  bool bending = false, weight = false;
};
LooseCloth loose_cloth(const input::GarmentSpec& garment, const mesh::GarmentMesh& mesh);
/// Adds what of it the scene has; a fabric that says nothing has the usual weight and bending stiffness.
void add_loose_cloth(const Model& model, int garment, const mesh::GarmentMesh& mesh, Scene& scene);

/// Facets of a surface that a contact names. Throws input::InputError where there are none, and for a slave that is not made of
/// quadratic tetrahedra.
std::vector<mesh::FacetNodeNumbers> contact_facets(const mesh::BodyMesh& body, const std::string& name, const input::Location& where);
std::vector<mesh::FacetNodeNumbers> slave_facets(const mesh::BodyMesh& body, const ContactModel& contact);

/// Adds follower pressures, and tractions, forces and weight as one dead load. Throws input::InputError where a load
/// names a surface that is not there or has no facets.
void add_loads(const Model& model, const mesh::BodyMesh& body, Scene& scene);

}  // namespace snug::solver
