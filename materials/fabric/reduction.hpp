// Raw tests reduced to the quantities of a KES sheet.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "materials/fabric/raw_test.hpp"

namespace snug::materials {

/// Where quantities are read off a curve, SI.
struct ReductionPlaces {
  double bending_hysteresis = 50.0;  ///< curvature (1/m) of 2HB: 0.5 /cm; the habit of KES is 1.0 /cm
};

/// The quantities that a test gives, by their symbols, in SI (elongations and resiliences as ratios):
///   tensile       Fm, EMT, WT, LT, and RT where the force comes back to rest
///   shear         G, and 2HG, 2HG5 where there is a way back
///   bending       B, and 2HB
///   compression   T0, Tm, Pm, WC, LC, and RC
///   friction      MIU, MMD
///   roughness     SMD
/// The formulas stand at the functions in reduction.cpp and, for people, in `formula_of`. Throws input::InputError at
/// the file: what is no such test, or does not reach far enough.
std::map<std::string, double> reduced(const RawTest& test, const ReductionPlaces& places = {});

/// How a quantity comes out of its test, in one line; `places` where it was read.
std::string formula_of(const std::string& symbol, const ReductionPlaces& places = {});

/// Mean and standard deviation (of the sample; 0 of one) over specimens.
struct Spread {
  double mean = 0.0, deviation = 0.0;
  int count = 0;
};
Spread spread_of(const std::vector<double>& values);

}  // namespace snug::materials
