// Tables of postproc/data that are part of the program (CMake copies their text into the library).
#pragma once

#include <string_view>

namespace snug::postproc {

/// postproc/data/wear_trial_2002.csv: garment, location, pressure_gf_per_cm2, sensation_rating.
std::string_view wear_trial_2002();

}  // namespace snug::postproc
