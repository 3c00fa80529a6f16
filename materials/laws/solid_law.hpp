// The contract of a law of soft tissue: W(F) = W_iso(F) + U(J), with W_iso depending on J^(-1/3) F only.
// The split is part of the contract because the element averages J inside the cell (three-field formulation).
#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "cases/input/material_reference.hpp"
#include "materials/laws/neo_hooke.hpp"

namespace snug::materials {

/// Every law of tissue, visibly. Adding one is a file, this line, the line in the typed test list and a reference
/// paragraph.
using SolidLaw = std::variant<NeoHooke>;

inline IsochoricResponse isochoric(const SolidLaw& law, const Eigen::Matrix3d& F) {
  return std::visit([&](const auto& l) { return l.isochoric(F); }, law);
}
inline VolumetricResponse volumetric(const SolidLaw& law, double J) {
  return std::visit([&](const auto& l) { return l.volumetric(J); }, law);
}
/// Shear modulus of the undeformed state, Pa.
inline double initial_shear_modulus(const SolidLaw& law) {
  return std::visit([](const auto& l) { return l.shear_modulus; }, law);
}

/// A named tissue of the shipped data: law, parameters, range and source.
struct Tissue {
  std::string name;
  SolidLaw law;
  std::array<double, 2> shear_range = {0.0, 0.0};  ///< Pa, lowest and highest published; 0, 0 when not given
  std::string source;                              ///< where the numbers come from and what was assumed
};

/// Looks the reference up in the shipped data (materials/data/tissues.toml) or reads its inline table.
/// Throws input::InputError with the nearest known name.
Tissue find_tissue(const input::MaterialReference& reference);
std::vector<std::string> tissue_names();

}  // namespace snug::materials
