// Words of the inputs of CalculiX and Abaqus: element types, cards without meaning for the model, names of supports.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh/formats/model.hpp"

namespace snug::mesh {

/// Parameters of a keyword, in capitals.
using InpParameters = std::map<std::string, std::string>;
/// Empty where there is no such parameter or it has no value.
std::string value_of(const InpParameters& parameters, const std::string& key);

/// Cards that say nothing about the model of one static step. Names are capitals without blanks.
bool is_card_without_meaning(const std::string& card);

/// Kind of an element type of solids or shells; the letters of reduced integration, hybrid pressure and the like change nothing here.
std::optional<ElementKind> element_kind_of(const std::string& type);
/// Nodes of types that meshers write beside the solids to mark lines and surfaces: trusses, beams, plane, membrane and surface
/// elements; 0 for others.
int marking_nodes_of(const std::string& type);
extern const char* const supported_inp_elements;

/// The value at a time of pairs of time and value, which rise in time; before and behind them the first and the last one. Not empty.
double interpolated(const std::vector<std::pair<double, double>>& pairs, double time);

/// Components (from 0) that ENCASTRE, PINNED, XSYMM, XASYMM and the like hold; empty for other names.
std::vector<int> held_by_name(const std::string& name);

}  // namespace snug::mesh
