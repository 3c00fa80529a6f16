// What a TOML file of sensation curves or pressure bands may hold.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/field.hpp"

namespace snug::postproc {

/// One curve with its numbers; which ones it needs goes by its shape.
struct CurveInput {
  std::string location, shape = "linear";
  std::array<double, 2> range = {0.0, 0.0};
  std::optional<double> intercept, slope;
  std::vector<double> pressures, ratings;
  std::optional<double> lowest, highest, middle, width;
  std::optional<double> scatter, mean_rating, mean_scatter, p_value, r_squared, largest_residual, slope_error,
      intercept_error, mean_pressure, pressure_spread;
  int points = 0;
  input::Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "location", .meaning = "name of the location", .required = true}, self.location);
    field(Field{.key = "shape", .meaning = "form of the curve", .choices = {"linear", "piecewise", "logistic"}},
          self.shape);
    field(Field{.key = "range",
                .unit = "Pa",
                .meaning = "lowest and highest pressure of the data behind the curve",
                .required = true,
                .bound = non_negative()},
          self.range);
    field(Field{.key = "intercept", .meaning = "linear: rating at no pressure"}, self.intercept);
    field(Field{.key = "slope", .unit = "1/Pa", .meaning = "linear: rating per pressure"}, self.slope);
    field(Field{.key = "pressures", .unit = "Pa", .meaning = "piecewise: growing pressures of the corners"},
          self.pressures);
    field(Field{.key = "ratings", .meaning = "piecewise: ratings at the corners"}, self.ratings);
    field(Field{.key = "lowest", .meaning = "logistic: rating at low pressure (0)"}, self.lowest);
    field(Field{.key = "highest", .meaning = "logistic: rating at high pressure (4)"}, self.highest);
    field(Field{.key = "middle", .unit = "Pa", .meaning = "logistic: pressure halfway between them"}, self.middle);
    field(Field{.key = "width",
                .unit = "Pa",
                .meaning = "logistic: the rise takes about four times this pressure",
                .bound = positive()},
          self.width);
    field(Field{.key = "points", .meaning = "number of ratings behind the curve"}, self.points);
    field(Field{.key = "scatter", .meaning = "residual standard deviation of the ratings", .bound = non_negative()},
          self.scatter);
    field(Field{.key = "mean_rating", .meaning = "mean of the ratings; used where the curve is not significant"},
          self.mean_rating);
    field(Field{.key = "mean_scatter",
                .meaning = "standard deviation of the ratings about their mean",
                .bound = non_negative()},
          self.mean_scatter);
    field(Field{.key = "p_value",
                .meaning = "of the test that pressure has no effect; 0.05 and more: not significant",
                .bound = between(0.0, 1.0)},
          self.p_value);
    field(Field{.key = "r_squared", .meaning = "share of the ratings' variance that the curve explains"},
          self.r_squared);
    field(Field{.key = "largest_residual", .meaning = "largest distance of a rating from the curve"},
          self.largest_residual);
    field(Field{.key = "slope_error", .unit = "1/Pa", .meaning = "linear: standard error of the slope"},
          self.slope_error);
    field(Field{.key = "intercept_error", .meaning = "linear: standard error of the intercept"}, self.intercept_error);
    field(Field{.key = "mean_pressure", .unit = "Pa", .meaning = "mean pressure of the data"}, self.mean_pressure);
    field(Field{.key = "pressure_spread", .unit = "Pa", .meaning = "standard deviation of the data's pressures"},
          self.pressure_spread);
  }
};

struct BandInput {
  std::string location, name;
  double from = 0.0;
  double to = std::numeric_limits<double>::infinity();
  input::Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "location", .meaning = "where it holds; left out: anywhere"}, self.location);
    field(Field{.key = "name", .meaning = "what the pressures mean", .required = true}, self.name);
    field(Field{.key = "from", .unit = "Pa", .meaning = "lowest pressure", .required = true, .bound = non_negative()},
          self.from);
    field(Field{.key = "to", .unit = "Pa", .meaning = "highest pressure; left out: open upwards"}, self.to);
  }
};

struct CurvesInput {
  std::string name, source, patch, population;
  std::vector<std::string> notes;
  std::string observations, shape = "linear";
  std::vector<CurveInput> curves;
  std::vector<BandInput> bands;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "name", .meaning = "what the set is called", .required = true}, self.name);
    field(Field{.key = "source", .meaning = "citation", .required = true}, self.source);
    field(Field{.key = "patch",
                .meaning = "size of the loaded or measured patch of skin, or that it is not known; ranges of pressure alone need none"},
          self.patch);
    field(Field{.key = "population", .meaning = "who was asked, or that it is not known; ranges of pressure alone need none"},
          self.population);
    field(Field{.key = "notes", .meaning = "what a user of the numbers must know"}, self.notes);
    field(Field{.key = "observations",
                .meaning = "CSV file beside this one to which the curves are fitted: location, "
                           "sensation_rating, a pressure"},
          self.observations);
    field(Field{.key = "shape", .meaning = "form of the fitted curves", .choices = {"linear", "piecewise", "logistic"}},
          self.shape);
    field(Field{.key = "curves", .meaning = "curves with their numbers, one a location"}, self.curves);
    field(Field{.key = "bands", .meaning = "named ranges of pressure: thresholds, classes"}, self.bands);
  }
};

}  // namespace snug::postproc
