// How fine a garment has to be for the skin that it presses on.
#pragma once

#include "mesh/garment/garment_fit.hpp"
#include "solver/scene/model.hpp"

namespace snug::solver {

/// Edge length (m) of the garment's triangles as worn: 0.6 of the mean cell of the skin, which counts as no longer than three times its shortest side. Where the pressure that the law of
/// Laplace expects exceeds the shear modulus of the softest tissue the skin is so soft that its nodes escape between
/// multipliers that stand wider than they do, in a zigzag that costs no energy: there the multipliers stand closer than
/// the nodes of the skin's shortest side.
double worn_cell_size(const Model& model, int garment, const mesh::GarmentFit& fit, const mesh::Limb& limb, const mesh::BodyMesh& body);

}  // namespace snug::solver
