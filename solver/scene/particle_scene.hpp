// A garment as particles on the rigid skin of a body (tier particle): from the model to what falls.
#pragma once

#include <memory>
#include <vector>

#include "mesh/particles/particle_cloth.hpp"
#include "solver/scene/run.hpp"

namespace snug::solver {

struct ParticleScene {
  std::unique_ptr<mesh::ParticleCloth> cloth;
  std::vector<int> particle_of;  ///< of every pattern node of the garment; -1: a mid-edge node, on its side's middle
  std::vector<mesh::HeldComponents> held;
  std::vector<std::string> holder;  ///< of every particle: the edge that holds it, "upper"; empty: none
  double weight = 0.0;              ///< N
};

/// What air bears a moving cloth with, per area and velocity, N s/m3. It takes part in how the cloth falls, not in where it
/// comes to rest.
inline constexpr double air_drag = 0.5;
/// Cloth begins to bear on the skin at this distance, m.
inline constexpr double skin_reach = 1e-3;

/// The garment of a case (the first) with its fabrics, bands and held edges, on the skin where it has a contact. Stretch, shear and
/// bending are the fabric's (or the usual sheet's where it has none); in compression cloth resists as it begins to
/// resist tension, and buckles. There is no lateral contraction. Throws input::InputError where the case names an edge
/// that the garment does not have.
ParticleScene make_particle_scene(const Model& model, const Meshes& meshes);

/// Particles of a garment: its vertices, those of a seam counted once.
int count_particles(const mesh::GarmentMesh& garment);

/// Fills places, fields by kind of force, balance and `numbers`. The skin gets no pressures: particles do not know them.
void fill_particle_result(const ParticleScene& scene, const Model& model, const Meshes& meshes, postproc::RunResult& result);

}  // namespace snug::solver
