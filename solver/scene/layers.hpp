// Garments over one another: which of them a garment meets, where it is placed, and what each contact carries.
#pragma once

#include <string>
#include <vector>

#include "solver/scene/run.hpp"
#include "solver/terms/master_stack.hpp"

namespace snug::solver {

/// The garments that garment g may meet, the outermost first: those listed before it that its contact does not leave out
/// (input::ContactSpec::master) and whose placed boxes meet its own. Throws input::InputError where one of them is made of
/// linear triangles, on which nothing lies.
std::vector<int> layers_under(const Model& model, const std::vector<mesh::GarmentMesh>& garments, int g);

/// The same surfaces as a contact has them, and their names: garments, then the ground, "skin".
MasterStack over_layers(const Layout& layout, const std::vector<mesh::GarmentMesh>& garments, const std::vector<int>& under, MasterSurface ground);
std::vector<std::string> master_names(const std::vector<mesh::GarmentMesh>& garments, const std::vector<int>& under);

/// How far off the skin the next garment, of this fit, is placed (m): outside all that cover heights of its own and are placed already.
double placing_lift(const Model& model, const std::vector<mesh::GarmentMesh>& placed, const mesh::GarmentFit& next);

}  // namespace snug::solver
