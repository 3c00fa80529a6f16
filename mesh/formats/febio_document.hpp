// What the readers of parts of a FEBio file share: its text as XML with places, numbers, and loads over time.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pugixml.hpp>

#include "cases/input/diagnostics.hpp"

namespace snug::mesh {

class FebioDocument {
 public:
  /// Reports what is no XML.
  FebioDocument(const std::string& text, const std::string& file, input::Diagnostics& diagnostics);

  /// <febio_spec>; empty where there is none.
  pugi::xml_node root() const { return root_; }
  input::Location place(const pugi::xml_node& node) const;
  void error(const pugi::xml_node& node, std::string found, std::string remedy) const;

  /// Numbers between commas or blanks; what is none is reported.
  std::vector<double> numbers(const pugi::xml_node& node) const;
  std::vector<int> integers(const pugi::xml_node& node) const;
  /// The one number of a child, times what its load curve (lc) has at a time. Nothing where the child is missing; reports maps, formulas and curves
  /// that are not there.
  std::optional<double> value(const pugi::xml_node& parent, const char* name, double time) const;
  /// The factor of a node's load curve at a time, 1 without one.
  double curve_at(const pugi::xml_node& node, double time) const;

 private:
  void read_curves();

  const std::string& text_;
  const std::string& file_;
  input::Diagnostics& diagnostics_;
  pugi::xml_document document_;
  pugi::xml_node root_;
  std::vector<std::ptrdiff_t> line_ends_;
  struct Curve {
    std::vector<std::pair<double, double>> points;
    bool linear = true, known = true;
  };
  std::map<std::string, Curve> curves_;  ///< by id
};

}  // namespace snug::mesh
