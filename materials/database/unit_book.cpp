#include "materials/database/unit_book.hpp"

#include <array>
#include <cmath>

#include "cases/input/units.hpp"

namespace snug::materials {

namespace {

// Names of the coherent units that sheets of fabrics, fibres and bodies come to; others are made of base units.
constexpr std::array names = {"m",       "kg/m2",    "N/m",  "J/m2",     "N/(m rad)", "N m",       "N",        "Pa",
                              "kg/m3",   "m2",       "kg",   "s",        "K",         "rad",       "1/m",      "kg/m",
                              "W/(m K)", "W/(m2 K)", "m2/s", "J/(kg K)", "J/(m3 K)",  "J/kg",      "1/m2",     "m3",
                              "m/s",     "N s/m2",   "kg/s", "1/s",      "1/K",       "Hz",        "J",        "W",
                              "W/m2",    "m2 K/W",   "N/m3", "N m/rad",  "N m2",      "kg/(m2 s)", "m3/(m2 s)"};

/// "kg m-1 s-3" for what has no name of its own: powers of small size, tried one after the other.
std::string of_base_units(const std::string& unit) {
  const auto power = [](const char* base, int exponent) {
    return exponent == 0 ? std::string() : std::string(base) + std::to_string(exponent) + " ";
  };
  double factor = 1.0;
  for (const int kg : {0, 1, -1, 2, -2})
    for (const int kelvin : {0, -1, 1})
      for (const int rad : {0, -1, 1})
        for (int metre = -5; metre <= 5; ++metre)
          for (int second = -5; second <= 5; ++second) {
            const std::string text =
                power("kg", kg) + power("m", metre) + power("s", second) + power("K", kelvin) + power("rad", rad);
            if (!text.empty() && input::unit_factor(unit, text.substr(0, text.size() - 1), factor))
              return text.substr(0, text.size() - 1);
          }
  return {};
}

/// Does the unit stand for a multiple of the other, so that its square is that multiple squared?
bool is_multiple(const std::string& unit, const std::string& si_unit, double factor) {
  double squared = 0.0;
  return input::unit_factor("(" + unit + ") (" + unit + ")", "(" + si_unit + ") (" + si_unit + ")", squared) &&
         std::abs(squared - factor * factor) <= 1e-12 * squared;
}

std::optional<SiUnit> look_up(const std::string& unit) {
  if (unit.empty() || unit == "1") return SiUnit{};
  if (unit == "%") return SiUnit{.name = {}, .factor = 0.01};
  double factor = 1.0;
  if (!input::unit_factor(unit, unit, factor)) return std::nullopt;  // no unit at all
  if (input::unit_factor(unit, "rad", factor))
    return SiUnit{"rad", factor};  // where an angle is a ratio, a product of two of them is one, too
  for (const char* name : names)
    if (input::unit_factor(unit, name, factor))
      return is_multiple(unit, name, factor) ? std::optional(SiUnit{name, factor}) : std::nullopt;
  if (input::unit_factor(unit, "m/m", factor)) return SiUnit{.name = {}, .factor = factor};
  const std::string name = of_base_units(unit);
  if (name.empty() || !input::unit_factor(unit, name, factor)) return std::nullopt;
  return SiUnit{name, factor};
}

}  // namespace

std::optional<SiUnit> UnitBook::find(const std::string& unit) {
  const auto known = known_.find(unit);
  if (known != known_.end()) return known->second;
  if (known_.size() > 4096) known_.clear();  // a file of a million units is no reason to keep them
  return known_.emplace(unit, look_up(unit)).first->second;
}

}  // namespace snug::materials
