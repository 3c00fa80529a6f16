#include "postproc/fields.hpp"

#include <algorithm>
#include <stdexcept>

namespace snug::postproc {

namespace {

template <class Value>
constexpr FieldMeaning meaning(const FieldName<Value>& field) {
  return {field.name, field.unit, field.description};
}

/// Our own fields in their order in every file, whoever publishes them first.
constexpr std::array own_fields = {
    meaning(field::displacement),    meaning(field::node_number),      meaning(field::contact_pressure), meaning(field::coverage),
    meaning(field::hem),             meaning(field::pressure_inside),  meaning(field::largest_inside),   meaning(field::laplace_pressure),
    meaning(field::shear_traction),  meaning(field::slip),             meaning(field::skin_area),        meaning(field::cauchy_stress),
    meaning(field::von_mises),       meaning(field::principal_stress), meaning(field::stress_top),       meaning(field::stress_bottom),
    meaning(field::location),        meaning(field::sensation),        meaning(field::layer),            meaning(field::tension_warp),
    meaning(field::tension_weft),    meaning(field::shear),            meaning(field::stretch),          meaning(field::wrinkled),
    meaning(field::pattern),         meaning(field::piece),            meaning(field::garment),          meaning(field::area_ratio)};

auto own(std::string_view name) {
  return std::find_if(own_fields.begin(), own_fields.end(), [&](const FieldMeaning& field) { return field.name == name; });
}

auto rank_of(std::string_view name) { return own(name) - own_fields.begin(); }

template <class Value>
double component_of(const Value& value, std::size_t component) {
  if constexpr (std::is_arithmetic_v<Value>) return value;
  else return value[static_cast<Eigen::Index>(component)];
}

}  // namespace

FieldMeaning meaning_of(std::string_view name) {
  const auto found = own(name);
  return found == own_fields.end() ? FieldMeaning{name, {}, {}} : *found;
}

std::vector<std::string> usual_components(const NamedField::Values& values) {
  struct Names {
    std::vector<std::string> operator()(const std::vector<double>&) const { return {}; }
    std::vector<std::string> operator()(const std::vector<int>&) const { return {}; }
    std::vector<std::string> operator()(const std::vector<Eigen::Vector2d>&) const { return {"warp", "weft"}; }
    std::vector<std::string> operator()(const std::vector<Eigen::Vector3d>&) const { return {"X", "Y", "Z"}; }
    std::vector<std::string> operator()(const std::vector<Stress>&) const { return {"XX", "YY", "ZZ", "XY", "YZ", "XZ"}; }
  };
  return std::visit(Names{}, values);
}

std::size_t NamedField::size() const {
  return std::visit([](const auto& all) { return all.size(); }, values);
}

double NamedField::at(std::size_t entry, std::size_t component) const {
  return std::visit([&](const auto& all) { return component_of(all[entry], component); }, values);
}

const NamedField* Fields::find(std::string_view name) const {
  const auto found = std::find_if(list_.begin(), list_.end(), [&](const NamedField& field) { return field.name == name; });
  return found == list_.end() ? nullptr : &*found;
}

NamedField* Fields::find(std::string_view name) { return const_cast<NamedField*>(std::as_const(*this).find(name)); }

void Fields::add(NamedField field) {
  if (find(std::string_view(field.name))) throw std::logic_error("the field " + field.name + " is published twice");
  const auto rank = rank_of(field.name);
  const auto behind = std::find_if(list_.begin(), list_.end(), [&](const NamedField& other) { return rank_of(other.name) > rank; });
  list_.insert(behind, std::move(field));
}

void Fields::remove(std::string_view name) {
  std::erase_if(list_, [&](const NamedField& field) { return field.name == name; });
}

void Fields::lacking(std::string_view name) { throw std::out_of_range("the result has no field " + std::string(name)); }

void add_stress(Fields& fields, std::vector<Stress> cauchy) {
  std::vector<double> equivalent;
  std::vector<Eigen::Vector3d> principal;
  equivalent.reserve(cauchy.size()), principal.reserve(cauchy.size());
  for (const Stress& stress : cauchy) equivalent.push_back(von_mises(stress)), principal.push_back(principal_stresses(stress));
  fields.add(named(field::cauchy_stress, std::move(cauchy)));
  fields.add(named(field::von_mises, std::move(equivalent)));
  fields.add(named(field::principal_stress, std::move(principal)));
}

}  // namespace snug::postproc
