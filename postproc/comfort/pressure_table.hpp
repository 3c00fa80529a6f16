// Tables with a column of clothing pressures: the wear trial, users' curves, users' measurements.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cases/input/csv.hpp"

namespace snug::postproc {

/// Pressure of every row in Pa, from the column pressure_Pa, pressure_gf_per_cm2 or pressure_mmHg (plain numbers) or
/// from "pressure [unit]". Reports a missing column, cells that are no finite numbers and negative pressures; then the
/// result is empty.
std::vector<double> pressures_of(const input::Csv& table, input::Diagnostics& diagnostics);

/// Upper and lower case are the same in names of locations.
bool same_name(std::string_view a, std::string_view b);

/// A table that is part of the program: commas, no quotes, # starts a comment line.
input::Csv shipped_csv(std::string_view text, const std::string& name);

}  // namespace snug::postproc
