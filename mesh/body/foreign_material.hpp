// The materials of another program's model as layers.
#pragma once

#include "mesh/body/body_mesh.hpp"
#include "mesh/formats/model.hpp"

namespace snug::mesh {

/// One layer a material of the model, in its order: named like it, with the law of the file in SI, or with the one that
/// spec.layers gives to that name. Throws input::InputError for materials without a law and for layers that the model
/// does not have.
std::vector<Layer> foreign_layers(const Model& model, const input::BodySpec& spec);

}  // namespace snug::mesh
