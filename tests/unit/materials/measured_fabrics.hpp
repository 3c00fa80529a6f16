// What the tests of measured fabrics share.
#pragma once

#include <filesystem>
#include <string>

#include "cases/input/table.hpp"
#include "materials/fabric/fabric.hpp"

namespace snug {

constexpr double gf_per_cm = 0.980665;  // N/m; also J/m2 of one gf cm/cm2

inline double green(double e) { return e + 0.5 * e * e; }
inline double nominal(const materials::TensionCurve& curve, double e) { return (1 + e) * curve.at(green(e)).force; }

inline input::MaterialEntry inline_table(const std::string& text, const std::filesystem::path& folder = "") {
  const input::Location where{(folder / "case.toml").string(), 7, 12};
  return {.name = {}, .table = input::table_of(text, where), .where = where};
}
std::string fault(auto&& action) {
  try {
    action();
  } catch (const input::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace snug
