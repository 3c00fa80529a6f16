// A curve that was measured point by point: the table of a datum.
#pragma once

#include <string>
#include <vector>

#include "cases/input/diagnostics.hpp"
#include "materials/database/unit_book.hpp"

namespace snug::materials {

/// A CSV text with a head line of two columns and their units, "elongation [%],force [gf]": the first increases
/// strictly.
struct Curve {
  struct Column {
    std::string name, unit;  ///< unit as printed
    SiUnit si;
    std::vector<double> values;  ///< in SI
  };
  Column x, y;

  /// At least two points, at most 100,000. Throws input::InputError with the line.
  static Curve parse(const std::string& text, const std::string& file, UnitBook& units);
  /// y at x, both in SI. Between points as M. Steffen, Astron. Astrophys. 239 (1990) 443-450: a cubic with continuous
  /// slope that is monotone where the points are, and so never leaves the interval of its two neighbours. Not a number
  /// outside the points.
  double at(double x) const;
};

}  // namespace snug::materials
