// The standard bodies that ship: surfaces with landmarks, named planes to cut at and locations (scripts/standard-bodies writes them).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/input/body_spec.hpp"
#include "cases/input/diagnostics.hpp"

namespace snug::input {

/// A place with a name; of some the girth of the body there.
struct Landmark {
  std::string name;
  std::array<double, 3> at = {0, 0, 0};  ///< m
  std::optional<double> girth;           ///< m

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "name", .meaning = "name of the place", .required = true}, self.name);
    field(Field{.key = "at", .unit = "m", .meaning = "where it is", .required = true}, self.at);
    field(Field{.key = "girth", .unit = "m", .meaning = "girth of the body there", .bound = positive()}, self.girth);
  }
};

/// A plane that a standard body can be cut at. Those of a body are a tree whose root is the pelvis.
struct StandardCut {
  std::string name;
  std::array<double, 3> point = {0, 0, 0};   ///< m, in the middle of the limb
  std::array<double, 3> normal = {0, 0, 1};  ///< away from the pelvis
  std::string towards;                       ///< the next cut on the way to the pelvis; empty: none
  double girth = 0.0;                        ///< m, of the section

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "name", .meaning = "name of the cut", .required = true}, self.name);
    field(Field{.key = "point", .unit = "m", .meaning = "a point of the plane in the middle of the limb", .required = true}, self.point);
    field(Field{.key = "normal", .meaning = "away from the pelvis", .required = true}, self.normal);
    field(Field{.key = "towards", .meaning = "the next cut on the way to the pelvis"}, self.towards);
    field(Field{.key = "girth", .unit = "m", .meaning = "girth of the section", .bound = positive()}, self.girth);
  }
};

/// In the frame of the body: x to the right of the person, y to the front, z up from the soles, m.
struct StandardBody {
  std::string title, source, licence;
  std::filesystem::path surface;  ///< OBJ, in metres and in this frame
  double stature = 0.0;           ///< m
  std::vector<Landmark> landmarks;
  std::vector<StandardCut> cuts;
  std::vector<LocationSpec> locations;

  const StandardCut* cut(const std::string& name) const;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "title", .meaning = "what the body is", .required = true}, self.title);
    field(Field{.key = "surface", .meaning = "file of the surface, beside this one", .required = true}, self.surface);
    field(Field{.key = "source", .meaning = "where it comes from", .required = true}, self.source);
    field(Field{.key = "licence", .meaning = "terms of use", .required = true}, self.licence);
    field(Field{.key = "stature", .unit = "m", .meaning = "height of the body", .required = true, .bound = positive()}, self.stature);
    field(Field{.key = "landmark", .meaning = "places with names"}, self.landmarks);
    field(Field{.key = "cut", .meaning = "planes to cut at"}, self.cuts);
    field(Field{.key = "location", .meaning = "named patches of skin"}, self.locations);
  }
};

/// Names of the standard bodies of a folder, sorted; none where there is no such folder.
std::vector<std::string> standard_bodies(const std::filesystem::path& folder);

/// Reads FOLDER/NAME.toml. Throws InputError.
StandardBody read_standard_body(const std::filesystem::path& folder, const std::string& name);

/// Puts surface, unit and axes of the body that `body.scan.standard` names in their place, and of the cuts that are given by name alone point and
/// normal: out of the part that all the cuts border on. Without locations of its own the case gets those of the body (`where_there`). Reports what
/// does not fit together.
void use_standard_body(BodySpec& body, const Table& table, const std::filesystem::path& folder, Diagnostics& diagnostics);

}  // namespace snug::input
