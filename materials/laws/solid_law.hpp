// The contract of a law of a solid. Soft, nearly incompressible laws are split, W(F) = W_iso(F) + U(J), with W_iso
// depending on J^(-1/3) F only: the mixed element averages J inside the cell and asks for the two parts. Laws without
// split are for displacement-only elements. Every law answers `coupled`.
#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "cases/input/material_entry.hpp"
#include "materials/laws/arruda_boyce.hpp"
#include "materials/laws/compressible_neo_hooke.hpp"
#include "materials/laws/fung.hpp"
#include "materials/laws/linear_elastic.hpp"
#include "materials/laws/mooney_rivlin.hpp"
#include "materials/laws/neo_hooke.hpp"
#include "materials/laws/ogden.hpp"
#include "materials/laws/yeoh.hpp"

namespace snug::materials {

/// Every law of a solid, visibly. Adding one is a file, this line, its input (laws/inputs.hpp) and the line in the
/// typed test list.
using SolidLaw = std::variant<NeoHooke, MooneyRivlin, Ogden, Yeoh, ArrudaBoyce, Fung, CompressibleNeoHooke, LinearElastic>;

/// A law made of an isochoric and a volumetric part.
template <class Law>
concept Split = requires(const Law& law, const Eigen::Matrix3d& F) {
  law.isochoric(F);
  law.volumetric(1.0);
};

bool is_split(const SolidLaw& law);
/// Isochoric part at F, det F > 0 (the caller's duty: steps are bounded before inversion). is_split(law) must hold.
SolidResponse isochoric(const SolidLaw& law, const Eigen::Matrix3d& F);
/// Volumetric part at J > 0. is_split(law) must hold.
VolumetricResponse volumetric(const SolidLaw& law, double J);
/// The whole law at F, det F > 0: energy, first Piola stress and tangent.
SolidResponse coupled(const SolidLaw& law, const Eigen::Matrix3d& F);

/// Moduli of the undeformed state, Pa.
double initial_shear_modulus(const SolidLaw& law);
double initial_bulk_modulus(const SolidLaw& law);
double initial_youngs_modulus(const SolidLaw& law);

/// A named tissue of the shipped data: law, parameters, range and source.
struct Tissue {
  std::string name;
  SolidLaw law;
  double density = 1060.0;  ///< kg/m3; where an entry says nothing, that of muscle (Ward & Lieber 2005, 1056-1060)
  std::array<double, 2> shear_range = {0.0, 0.0};  ///< Pa, lowest and highest published; 0, 0 when not given
  std::string source;                              ///< where the numbers come from and what was assumed
};

/// The tissue as a table of its values in SI, which reads back to the same. The entry has been found before.
input::Table written_out_tissue(const input::MaterialEntry& asked);
/// Looks the entry up in the shipped data (materials/data/tissues.toml) or reads its inline table.
/// Throws input::InputError with the nearest known name.
Tissue find_tissue(const input::MaterialEntry& asked);
/// The same for a layer that is a membrane, which has to be incompressible: a law without split is an error.
Tissue find_membrane_tissue(const input::MaterialEntry& asked);
std::vector<std::string> tissue_names();

}  // namespace snug::materials
