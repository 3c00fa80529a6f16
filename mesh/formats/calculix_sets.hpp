// Sets of nodes and elements in the inputs of CalculiX and Abaqus, and the names by which other cards call them.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/formats/calculix_words.hpp"
#include "mesh/formats/fields.hpp"

namespace snug::mesh {

/// What reads the data lines of a card.
using InpData = std::function<void(const FieldLine&)>;

/// A name as it is compared: capitals, without quotes.
std::string inp_name(std::string_view text);

/// An entry by its name, or by that behind the name of an instance ("Part-1-1.top").
template <class Named>
auto found_by_name(Named& named, std::string_view text) {
  const auto whole = named.find(inp_name(text));
  const auto point = text.find('.');
  return whole != named.end() || point == text.npos ? whole : named.find(inp_name(text.substr(point + 1)));
}

class InpSets {
 public:
  std::map<std::string, std::vector<int>> nodes, elements;

  /// Reads *NSET or *ELSET: numbers or names of other sets; GENERATE: from, to, step.
  InpData read(const InpParameters& parameters);
  /// Members of the node set, or the one number, in field 0; what is neither is reported.
  std::vector<int> nodes_named(const FieldLine& line) const;
  std::vector<int> elements_named(const FieldLine& line) const;
  /// Ranges may run over numbers that are not used: these are taken out.
  void drop_gaps(const std::vector<ModelNode>& known);

 private:
  std::set<std::string> generated_;  ///< sets of nodes by ranges
};

}  // namespace snug::mesh
