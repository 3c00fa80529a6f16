#include "mesh/formats/febio_document.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesh/formats/calculix_words.hpp"
#include "mesh/formats/fields.hpp"
#include "mesh/formats/model.hpp"

namespace snug::mesh {

namespace {

/// Words between commas, blanks and ends of lines.
std::vector<std::string_view> words(std::string_view text) {
  constexpr std::string_view apart = ", \t\r\n";
  std::vector<std::string_view> list;
  while (true) {
    const auto begin = text.find_first_not_of(apart);
    if (begin == text.npos) return list;
    const auto end = std::min(text.find_first_of(apart, begin), text.size());
    list.push_back(text.substr(begin, end - begin));
    text.remove_prefix(end);
  }
}

}  // namespace

FebioDocument::FebioDocument(const std::string& text, const std::string& file, input::Diagnostics& diagnostics) : text_(text), file_(file), diagnostics_(diagnostics) {
  for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos; ++at) line_ends_.push_back(static_cast<std::ptrdiff_t>(at));
  const pugi::xml_parse_result result = document_.load_buffer(text.data(), text.size());
  root_ = document_.child("febio_spec");
  if (!result)
    diagnostics.error({file, static_cast<int>(std::upper_bound(line_ends_.begin(), line_ends_.end(), result.offset) - line_ends_.begin()) + 1, 1},
                      fmt::format("this is no XML: {}", result.description()), "give a FEBio model (.feb) as FEBio Studio writes it");
  else if (!root_)
    diagnostics.error({file, 1, 1}, "there is no <febio_spec> in it", "give a FEBio model (.feb) as FEBio Studio writes it");
  read_curves();
}

input::Location FebioDocument::place(const pugi::xml_node& node) const {
  const std::ptrdiff_t offset = std::max<std::ptrdiff_t>(0, node.offset_debug());
  return {file_, static_cast<int>(std::upper_bound(line_ends_.begin(), line_ends_.end(), offset) - line_ends_.begin()) + 1, 1};
}

void FebioDocument::error(const pugi::xml_node& node, std::string found, std::string remedy) const {
  if (diagnostics_.errors().size() < most_model_errors) diagnostics_.error(place(node), std::move(found), std::move(remedy));
}

std::vector<double> FebioDocument::numbers(const pugi::xml_node& node) const {
  std::vector<double> values;
  for (const std::string_view word : words(node.text().get())) {
    if (const auto value = number_of(word)) values.push_back(*value);
    else error(node, fmt::format("\"{}\" is no number", word.substr(0, 20)), "give numbers with commas between them");
  }
  return values;
}

std::vector<int> FebioDocument::integers(const pugi::xml_node& node) const {
  std::vector<int> values;
  for (const std::string_view word : words(node.text().get())) {
    if (const auto value = integer_of(word)) values.push_back(*value);
    else error(node, fmt::format("\"{}\" is no whole number", word.substr(0, 20)), "give the numbers of nodes with commas between them");
  }
  return values;
}

std::optional<double> FebioDocument::value(const pugi::xml_node& parent, const char* name, double time) const {
  const pugi::xml_node node = parent.child(name);
  if (!node) return std::nullopt;
  const std::string_view type = node.attribute("type").value();
  const std::vector<double> found = type.empty() || type == "const" ? numbers(node) : std::vector<double>{};
  if (found.size() != 1) {
    error(node, fmt::format("<{}> is not one number", name), "give one number: maps and formulas are not read");
    return std::nullopt;
  }
  return found[0] * curve_at(node, time);
}

double FebioDocument::curve_at(const pugi::xml_node& node, double time) const {
  const pugi::xml_attribute lc = node.attribute("lc");
  if (!lc || lc.as_int() == 0) return 1.0;
  const auto curve = curves_.find(lc.value());
  if (curve == curves_.end() || !curve->second.known || curve->second.points.empty()) {
    error(node, fmt::format("there is no load curve {}", lc.value()), "give it as <load_controller type=\"loadcurve\"> with points of time and value");
    return 1.0;
  }
  const auto& points = curve->second.points;
  const bool at_point = std::any_of(points.begin(), points.end(), [&](const auto& p) { return p.first == time; });
  if (!curve->second.linear && !at_point && time > points.front().first && time < points.back().first)
    error(node, fmt::format("the load curve {} is not linear between its points", lc.value()), "let it be linear, or end at one of its points");
  return interpolated(points, time);
}

void FebioDocument::read_curves() {
  for (const pugi::xml_node& one : root_.child("LoadData").children()) {
    Curve& curve = curves_[one.attribute("id").value()];
    const std::string_view name = one.name(), type = one.attribute("type").value();
    curve.known = name == "loadcurve" || type == "loadcurve";
    const std::string shape = upper_case(name == "loadcurve" ? type : std::string_view(one.child("interpolate").text().get()));
    curve.linear = shape.empty() || shape == "LINEAR" || shape == "LOADCURVE";
    const pugi::xml_node points = one.child("points") ? one.child("points") : one;
    for (const char* tag : {"pt", "point"})
      for (const pugi::xml_node& point : points.children(tag)) {
        const std::vector<double> pair = numbers(point);
        if (pair.size() == 2) curve.points.emplace_back(pair[0], pair[1]);
        else error(point, "a point of a load curve is a time and a value", "write <pt>time, value</pt>");
      }
  }
}

}  // namespace snug::mesh
