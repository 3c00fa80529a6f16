// How rough cloth on skin is taken to be, and why.
#pragma once

#include <optional>
#include <string>

#include "materials/fabric/fabric.hpp"

namespace snug::solver {

/// Coefficient of friction of a pair of surfaces, and who says so ("the case", "MIU of the fabric", ...).
struct FrictionChoice {
  double coefficient = 0.0;
  std::string source;
  bool of_case = false;  ///< the case says it
};

/// Of textiles on dry skin, where nobody says.
constexpr double usual_friction = 0.3;

/// What the case says; where it is silent the fabric's own coefficient, else 0.3: textiles on dry skin have 0.2 to 0.6
/// (Derler & Gerhardt, Tribology Letters 45 (2012) 1-27).
FrictionChoice friction_choice(const std::optional<double>& given, const materials::Fabric& fabric);

}  // namespace snug::solver
