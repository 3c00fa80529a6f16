// Quantities with units as texts: "0.57 mm", "20 gf/cm2", "0.77 gf/(cm degree)".
#pragma once

#include <string>

namespace snug::input {

/// What a text means as a quantity, or why it is none.
struct Quantity {
  double value = 0.0;  ///< in the SI unit asked for
  std::string found;   ///< empty when the text is a quantity of the right dimension, else what is wrong
  bool ok() const { return found.empty(); }
};

/// Converts `text` to `si_unit` ("m", "Pa", "N/m", "rad", ...).
Quantity to_si(const std::string& text, const std::string& si_unit);

/// True when `unit` is a known unit that converts to `si_unit`; `factor` is then its size in SI.
bool unit_factor(const std::string& unit, const std::string& si_unit, double& factor);

/// "a length" for "m", "a pressure" for "Pa", ...
std::string dimension_name(const std::string& si_unit);
/// A quantity such as a user would write: "0.57 mm" for "m", "20 gf/cm2" for "Pa", ...
std::string example_quantity(const std::string& si_unit);

}  // namespace snug::input
