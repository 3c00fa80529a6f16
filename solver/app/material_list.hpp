// What the shipped data and the laws offer.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cases/input/key_list.hpp"
#include "materials/fabric/sheet.hpp"

namespace snug::app {

/// Fabrics and tissues by name.
std::string materials_text();
/// The same for --json: {"fabrics", "tissues", "own_fabrics", "own_tissues"}.
nlohmann::ordered_json materials_json();

/// One entry as the data hold it, with its source. Throws input::InputError with the nearest known name.
std::string material_text(const std::string& name);

/// "thickness 0.57 mm, 0.54 at 5, 0.5 at 20, 0.476 mm at 50 gf/cm2"; what does not go together is said; empty where nothing was measured.
std::string thickness_text(const materials::Compression& compression, double thickness);

/// Inputs of the laws that an inline table may name; keys such as "neo-Hooke.shear_modulus".
std::vector<input::KeyRow> law_keys();

/// Names of the laws of solids.
std::vector<std::string> law_names();

/// The page of the law called `name`, "Ogden" or "law.Ogden": formula, when to use it, source. Empty when there is
/// none.
std::string law_page_text(const std::string& name);

}  // namespace snug::app
