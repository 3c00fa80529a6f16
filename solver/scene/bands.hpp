// The elastic bands along the edges of garments.
#pragma once

#include <vector>

#include "postproc/result.hpp"
#include "solver/scene/scene.hpp"
#include "solver/terms/band.hpp"

namespace snug::solver {

/// What a case asks for on a mesh. Throws input::InputError where the garment has no such edge.
struct BandModel {
  double stiffness = 0.0, edge_length = 0.0, rest_length = 0.0;  ///< N; m, of the edge as cut; m
};
BandModel band_model(const input::BandSpec& spec, const mesh::GarmentMesh& garment);

/// The garment as it bears on what it meets: with the width of its bands along their edges.
ContactSlave slave_with_bands(const Field& positions, const input::GarmentSpec& spec, const mesh::GarmentMesh& garment);

/// Adds the bands of a garment to its scene.
void add_bands(const input::GarmentSpec& spec, const mesh::GarmentMesh& garment, Scene& scene);

/// The bands of a scene in a state.
std::vector<postproc::Band> band_rows(const Scene& scene, const State& state);

}  // namespace snug::solver
