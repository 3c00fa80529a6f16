// What the shipped data and the laws offer.
#pragma once

#include <string>
#include <vector>

#include "cases/input/reference.hpp"

namespace snug::app {

/// Fabrics and tissues by name.
std::string materials_text();

/// One entry as the data hold it, with its source. Throws input::InputError with the nearest known name.
std::string material_text(const std::string& name);

/// Inputs of the laws that an inline table may name; keys such as "neo-Hooke.shear_modulus".
std::vector<input::ReferenceRow> law_reference();

}  // namespace snug::app
