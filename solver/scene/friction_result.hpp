// What friction adds to the result of a state.
#pragma once

#include "mesh/garment/garment_mesh.hpp"
#include "postproc/result.hpp"
#include "postproc/skin_pressure.hpp"
#include "solver/scene/scene.hpp"

namespace snug::solver {

/// Adds the friction of one garment to its samples, to the balance, and as `shear_traction` and `slip` to the garment's fields, which
/// have its `contact_pressure`.
void add_friction(const Friction& friction, const Contact& contact, const State& state, bool deformable, const mesh::GarmentMesh& garment,
                  postproc::Fields& fields, std::vector<postproc::ContactSample>& samples, postproc::Balance& balance);

/// The same fields of the skin, of all garments together; `normal` is its pressure from the same samples.
void fill_skin_friction(const postproc::SkinPressure& normal, postproc::RunResult& result);

}  // namespace snug::solver
