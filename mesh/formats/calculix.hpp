// A body as input of CalculiX (also read by Abaqus): 20-node hexahedra, neo-Hookean layers, pressure on the skin.
#pragma once

#include <ostream>
#include <vector>

#include "mesh/body/body_mesh.hpp"

namespace snug::mesh {

/// *HYPERELASTIC, NEO HOOKE: W = mu/2 (J^(-2/3) I1 - 3) + kappa/2 (J - 1)^2, so that C10 = mu/2 and D1 = 2/kappa.
struct NeoHookeConstants {
  double shear_modulus = 0.0, bulk_modulus = 0.0;  ///< Pa
};

/// Writes the body with its bone fixed, its cut planes sliding along their plane, and a follower pressure (Pa) on the
/// skin, in SI. The centre and face nodes of the 27-node cells are left out (C3D20R). Node sets BONE, LOWER, UPPER and
/// SKIN; element sets are LAYER1, LAYER2, ... `materials`: one a layer of the mesh. Node n of the mesh has number n
/// + 1. One static step with large displacements whose displacements of SKIN are printed to the .dat file. Source:
/// CalculiX CrunchiX user's manual 2.20, C3D20R, *HYPERELASTIC, *DLOAD.
void write_calculix(std::ostream& out, const BodyMesh& mesh, const std::vector<NeoHookeConstants>& materials,
                    double skin_pressure);

}  // namespace snug::mesh
