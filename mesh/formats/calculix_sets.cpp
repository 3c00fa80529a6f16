#include "mesh/formats/calculix_sets.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace snug::mesh {

namespace {

constexpr std::size_t largest_set = 20'000'000;

std::vector<int> named(const std::map<std::string, std::vector<int>>& sets, const FieldLine& line, const char* of, const char* card) {
  if (const auto number = integer_of(line.text(0))) return {*number};
  const auto set = found_by_name(sets, line.text(0));
  if (set != sets.end()) return set->second;
  line.error(0, fmt::format("there is no set \"{}\" of {}", line.text(0), of), fmt::format("define it with {}, or give a number", card));
  return {};
}

void add_range(std::vector<int>& members, const FieldLine& line) {
  const int first = line.integer_at(0), last = line.integer_at(1), step = std::max(1, line.integer_at(2, 1));
  if (last < first || (last - first) / step > 10'000'000 || members.size() > largest_set) return line.error(1, "this is no range", "write first, last, step");
  for (long n = first; n <= last; n += step) members.push_back(static_cast<int>(n));
}

}  // namespace

std::string inp_name(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = trimmed(text.substr(1, text.size() - 2));
  return upper_case(text);
}

InpData InpSets::read(const InpParameters& parameters) {
  const auto name = parameters.find("NSET");
  const bool of_nodes = name != parameters.end(), generate = parameters.contains("GENERATE");
  const auto of_elements = parameters.find("ELSET");
  const std::string called = of_nodes ? name->second : of_elements == parameters.end() ? "" : of_elements->second;
  if (generate && of_nodes) generated_.insert(called);
  auto& sets = of_nodes ? nodes : elements;
  std::vector<int>& members = sets[called];
  return [&sets, &members, generate](const FieldLine& line) {
    if (generate) return add_range(members, line);
    for (std::size_t f = 0; f < line.fields.size(); ++f) {
      if (line.empty(f)) continue;
      if (const auto number = integer_of(line.text(f))) {
        members.push_back(*number);
        continue;
      }
      const auto other = found_by_name(sets, line.text(f));
      if (other == sets.end() || other->second.size() + members.size() > largest_set)
        return line.error(f, fmt::format("there is no set \"{}\"", line.text(f)), "define it before, or give numbers");
      const std::vector<int> copy = other->second;
      members.insert(members.end(), copy.begin(), copy.end());
    }
  };
}

std::vector<int> InpSets::nodes_named(const FieldLine& line) const { return named(nodes, line, "nodes", "*NSET"); }
std::vector<int> InpSets::elements_named(const FieldLine& line) const { return named(elements, line, "elements", "*ELSET"); }

void InpSets::drop_gaps(const std::vector<ModelNode>& known) {
  if (generated_.empty()) return;
  std::set<int> numbers;
  for (const ModelNode& node : known) numbers.insert(node.number);
  for (const std::string& name : generated_)
    if (const auto set = nodes.find(name); set != nodes.end()) std::erase_if(set->second, [&](int node) { return !numbers.contains(node); });
}

}  // namespace snug::mesh
