// Columns of the tables that testing machines write, found by the names that they go by.
#pragma once

#include <string>
#include <vector>

#include "cases/input/csv.hpp"

namespace snug::materials {

/// The first of these names that the table has, or -1.
int column_of(const input::Csv& csv, const std::vector<std::string>& names);

/// What a column counts in: per specimen, or as measured on a specimen of that size.
struct ColumnUnits {
  std::string as_measured;   ///< SI unit of the machine's own number, "N"
  double size = 0.0;         ///< of the specimen, m, by which it is divided; 0 = not known
  std::string per_specimen;  ///< SI unit of the quotient, "N/m", which the column may have instead
  std::string remedy;        ///< where the size is not known
};

/// The column in SI, per specimen; reports what is wrong and gives an empty vector then.
std::vector<double> column_in(const input::Csv& csv, int column, const ColumnUnits& units,
                              input::Diagnostics& diagnostics);

/// Names of columns of tensile tests.
std::vector<std::string> strain_names();
std::vector<std::string> extension_names();
std::vector<std::string> force_names();
/// Of forces on the way back that stand beside those on the way up.
std::vector<std::string> unloading_names();

}  // namespace snug::materials
