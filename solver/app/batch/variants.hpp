// Which runs a command asks for: cases, the variants in them, values of a sweep.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/study_spec.hpp"

namespace snug::app {

/// Values of one key.
struct Sweep {
  std::string key;
  std::vector<std::string> values;  ///< as of --set
  std::vector<double> numbers;      ///< of them, in `unit`; empty: they are no numbers
  std::string unit;
};

/// "KEY=FROM:TO:N", N values in equal steps ("garment.pattern.flat_circumference=190 mm:220 mm:4"), or "KEY=A,B,C". Throws input::InputError.
Sweep sweep_of(const std::string& text);

/// Every combination of the values, the last key fastest; named by what is set.
std::vector<input::StudyVariant> combinations(const std::vector<Sweep>& sweeps);

/// Names of directories for runs that are called so: letters, digits, dots and dashes, each its own.
std::vector<std::string> folder_names(const std::vector<std::string>& names);

}  // namespace snug::app
