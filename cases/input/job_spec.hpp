// What a case asks beside its answer: pressures that it is to reach, what a sensor would read, and runs with other values. They change nothing that is
// solved, so that what solves does not know them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/case.hpp"
#include "cases/input/field.hpp"

namespace snug::input {

/// A pressure that is wanted at a location, or round the body at a height.
struct WantedPressure {
  std::string location;
  std::optional<double> height;  ///< m
  double pressure = 0.0;         ///< Pa, mean over the location, or round the body
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "location", .meaning = "name of one of body.locations: the mean over it"}, self.location);
    field(Field{.key = "height", .unit = "m", .meaning = "instead of a location: the mean round the body at this height, as heights of stations count"}, self.height);
    field(Field{.key = "pressure", .unit = "Pa", .meaning = "wanted there, e.g. \"20 mmHg\"", .required = true, .bound = positive()}, self.pressure);
  }
};

/// What the garment is made for. A run says how near it comes, `snug size` finds the cut that comes nearest.
struct TargetSpec {
  std::vector<WantedPressure> pressures;
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "pressures",
                .meaning = "[{ location = \"Ankle\", pressure = \"20 mmHg\" }, …], or a profile over height, [{ height = \"50 mm\", pressure = \"20 mmHg\" }, …]",
                .required = true},
          self.pressures);
  }
};

/// A flat sensor between garment and skin.
struct SensorSpec {
  std::string name;
  std::string location;
  std::optional<double> height, angle;  ///< m, rad
  double diameter = 0.0;                ///< m
  double thickness = 0.0;               ///< m
  bool bulge = false;
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "name", .meaning = "name in results", .required = true}, self.name);
    field(Field{.key = "location", .meaning = "lies in the middle of this one of body.locations; height or angle may be given beside it"}, self.location);
    field(Field{.key = "height", .unit = "m", .meaning = "of its middle, as heights of stations count"}, self.height);
    field(Field{.key = "angle", .unit = "rad", .meaning = "of its middle round the body: 0 deg = side (+x), 90 deg = front (+y)", .bound = between(-7, 7)}, self.angle);
    field(Field{.key = "diameter", .unit = "m", .meaning = "of the disc over which it takes the mean; of an oval one that of equal area", .required = true, .bound = positive()},
          self.diameter);
    field(Field{.key = "thickness", .unit = "m", .meaning = "by which it lifts the garment off the skin where bulge = true", .bound = non_negative()}, self.thickness);
    field(Field{.key = "bulge", .meaning = "true: also what the bulge adds that it makes in the garment (docs/jobs.md has the formula)"}, self.bulge);
  }
};

/// Sections of case.toml beside those of Case.
struct Jobs {
  std::optional<TargetSpec> target;
  std::vector<SensorSpec> sensors;
  std::vector<StudyVariant> variants;  ///< that snug run makes one run each of

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "target", .meaning = "pressures that the garment is made for: a run says how near it comes, snug size finds the cut"}, self.target);
    field(Field{.key = "sensor", .meaning = "what a flat sensor under the garment would read; several as [[sensor]]", .one_or_more = true}, self.sensors);
    field(Field{.key = "variant",
                .meaning = "the case with other values, one block each: snug run makes a run of every one and puts them side by side on a page",
                .one_or_more = true},
          self.variants);
  }
};

/// The same of a case directory. Throws InputError; `read_case` finds the same errors.
Jobs read_jobs(const std::filesystem::path& directory, const ReadOptions& options = {});

/// Their sections as text, for case.echo.toml; without the variants, one of which was run.
std::string echo_text(const Jobs& jobs);

}  // namespace snug::input
