#include "mesh/formats/apdl_selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace snug::mesh {

std::vector<int> ApdlSelection::nodes() const {
  std::vector<int> nodes;
  for (const auto& [node, at] : deck_.nodes)
    if (contains(node)) nodes.push_back(node);
  return nodes;
}

std::vector<int> ApdlSelection::named(const FieldLine& line, std::size_t last) const {
  const std::string who = upper_case(line.text(1));
  if (who == "ALL") return nodes();
  if (const auto set = deck_.node_sets.find(who); set != deck_.node_sets.end()) return set->second;
  const int first = line.integer_at(1), end = line.integer_at(last, first), step = std::max(1, line.integer_at(last + 1, 1));
  std::vector<int> range;
  if (first < 1)
    line.error(1, fmt::format("\"{}\" is no node", line.text(1)), "give its number, ALL or a component");
  else if (end - first > 10'000'000)
    line.error(last, "the range is too large", "select nodes and write ALL");
  else
    for (long node = first; node <= end; node += step)
      if (end == first || deck_.nodes.contains(static_cast<int>(node))) range.push_back(static_cast<int>(node));
  return range;
}

void ApdlSelection::make_component(const FieldLine& line) {
  if (const std::string kind = upper_case(line.text(2)); kind.empty() || kind.starts_with("NODE")) deck_.node_sets[upper_case(line.text(1))] = nodes();
}

void ApdlSelection::select(const FieldLine& line, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& place) {
  const std::string mode = upper_case(line.text(1)), item = upper_case(line.text(2)), component = upper_case(line.text(3));
  if (mode == "ALL" || mode == "NONE") {
    all_ = mode == "ALL", selected_.clear();
    return;
  }
  const bool by_place = item == "LOC" && (component == "X" || component == "Y" || component == "Z");
  if ((mode != "S" && mode != "R" && mode != "A" && mode != "U") || (!by_place && item != "NODE"))
    return line.error(1, "this selection is not read", "write nsel,s|r|a|u,loc,x|y|z,from,to or nsel,s,node,,from,to");
  const double low = line.number_at(4), high = line.number_at(5, low);
  const double slack = low == high ? std::max(0.005 * std::abs(low), 1e-6) : 1e-6 * std::abs(high - low);  // Ansys' tolerance
  apply(mode, [&](int node, const Eigen::Vector3d& at) {
    const double value = by_place ? place(at)[component[0] - 'X'] : node;
    return value >= low - slack && value <= high + slack;
  });
}

void ApdlSelection::select_component(const FieldLine& line) {
  const auto set = deck_.node_sets.find(upper_case(line.text(2)));
  if (set == deck_.node_sets.end())
    return line.error(2, fmt::format("there is no component \"{}\" of nodes", line.text(2)), "define it with CM or CMBLOCK first");
  const std::set<int> members(set->second.begin(), set->second.end());
  apply(line.empty(1) ? "S" : upper_case(line.text(1)), [&](int node, const Eigen::Vector3d&) { return members.contains(node); });
}

void ApdlSelection::apply(const std::string& mode, const std::function<bool(int, const Eigen::Vector3d&)>& test) {
  std::set<int> now;
  for (const auto& [node, at] : deck_.nodes) {
    const bool before = contains(node), hit = test(node, at);
    if (mode == "S" ? hit : mode == "R" ? before && hit : mode == "A" ? before || hit : before && !hit) now.insert(node);
  }
  selected_ = std::move(now), all_ = false;
}

}  // namespace snug::mesh
