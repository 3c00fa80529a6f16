// What each piece of a garment bears, and each seam transmits.
#pragma once

#include <vector>

#include "postproc/result.hpp"
#include "solver/scene/scene.hpp"

namespace snug::solver {

/// One row a piece (or zone of a tube) of every garment of the scene that the model knows.
std::vector<postproc::PieceRow> piece_rows(const Scene& scene, const State& state, const Model& model, const std::vector<mesh::GarmentMesh>& garments);

/// One row a seam of every garment: forces per length as worn, from the stresses at the seam in the triangles of either side, of which the
/// mean is taken: where the cloth is in balance they differ by no more than the error of the triangles.
std::vector<postproc::SeamRow> seam_rows(const Scene& scene, const State& state, const std::vector<mesh::GarmentMesh>& garments);

}  // namespace snug::solver
