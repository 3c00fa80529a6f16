// How rough cloth on skin is taken to be, and why.
#pragma once

#include <string>

#include "cases/input/case.hpp"

namespace snug::solver {

/// Coefficient of friction of the garment on the skin, and who says so ("the case", "MIU of the fabric", ...).
struct FrictionChoice {
  double coefficient = 0.0;
  std::string source;
};

/// Of textiles on dry skin, where nobody says.
constexpr double usual_friction = 0.3;

/// What the case says; where it is silent the fabric's own coefficient, else 0.3: textiles on dry skin have 0.2 to 0.6
/// (Derler & Gerhardt, Tribology Letters 45 (2012) 1-27). Zero without a garment in contact.
FrictionChoice friction_choice(const input::Case& description);
bool has_friction(const input::Case& description);

/// The case without its friction.
input::Case without_friction(const input::Case& description);

}  // namespace snug::solver
