// Which unit of the SI a unit as printed comes to, by the units of cases/input.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace snug::materials {

struct SiUnit {
  std::string name;     ///< coherent: "Pa", "N/m", "kg m-1 s-3"; empty for a plain number
  double factor = 1.0;  ///< its size in SI
};

/// Looks units up and remembers them.
class UnitBook {
 public:
  /// Nothing for what is no unit, and for a scale with a zero of its own (degC), whose products mean nothing. "", "1"
  /// and "%" are plain numbers.
  std::optional<SiUnit> find(const std::string& unit);

 private:
  std::map<std::string, std::optional<SiUnit>> known_;
};

}  // namespace snug::materials
