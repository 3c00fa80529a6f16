// Scales of the plots: round limits, ticks, colours.
#pragma once

#include <string>
#include <vector>

#include "postproc/report/surfaces.hpp"

namespace snug::postproc::report {

/// The smallest of 1, 2, 2.5, 5 times a power of ten that divides `range` into `parts` steps at most.
double round_step(double range, int parts);

/// Multiples of round_step within [from, to].
std::vector<double> ticks(double from, double to, int parts);

/// Number for people: `digits` significant ones, a narrow space between thousands, a true minus sign; "0" for zero.
std::string number(double value, int digits = 3);

/// A mark on a scale or a count: as few digits as it takes, a narrow space between thousands.
std::string plain(double value);

/// "10⁻³" for -3.
std::string power_of_ten(int power);

/// Colour of t in [0, 1] as "#rrggbb": viridis (van der Walt & Smith 2015, CC0), evenly lighter from dark blue to
/// yellow, also for readers who do not tell red from green and on a grey printer.
std::string colour(double t);

/// The stops of the colour map, evenly spaced, as 0xrrggbb.
const std::vector<int>& colour_stops();

/// A scale of pressure: bands of equal height from 0 to `top`, shown in `unit`.
struct PressureScale {
  double top = 1.0;  ///< Pa
  int bands = 10;
  std::string unit = "Pa";
  double factor = 1.0;                                         ///< Pa in a unit
  double level(int band) const { return top * band / bands; }  ///< lower limit of a band, Pa
  std::string band_colour(int band) const { return colour((band + 0.5) / bands); }
};

/// Round, and just above the largest pressure inside the garments (coverage above 0.95, beside the hems): a hem is a line
/// and would take the whole scale.
PressureScale pressure_scale(const std::vector<const Skin*>& skins);

/// The pressure beside the hems; that everywhere where the skin knows no hems. Pa, one value a node.
const std::vector<double>& pressure_beside(const Skin& skin);
/// The largest pressure where the garment covers the skin wholly beside the hems, and anywhere. Pa.
double largest_inside(const Skin& skin);
double largest(const Skin& skin);

}  // namespace snug::postproc::report
