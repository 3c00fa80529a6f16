// Named fields with units: terms publish them, recorders write what there is, readers give it back.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <list>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "postproc/stress.hpp"

namespace snug::postproc {

/// For what of its mesh a field has a value: a node, or a cell of the body or triangle of a garment.
enum class Place { node, cell };

/// What our own code asks for by name; the name of such a field is written here (namespace `field`) and nowhere else.
template <class Value>
struct FieldName {
  const char *name, *unit, *description;
  Place place = Place::node;
  bool recorded = true;                       ///< false: an intermediate result, in no file
  std::array<const char*, 6> components = {};  ///< names; none: those of the kind of value
};

namespace field {

inline constexpr FieldName<Eigen::Vector3d> displacement{"displacement", "m", "from the reference, of a garment from the placed shape"};
inline constexpr FieldName<int> node_number{"node_number", "", "of an imported body, in its file"};
inline constexpr FieldName<double> contact_pressure{"contact_pressure", "Pa", "per covered skin; on a garment per its current area"};
inline constexpr FieldName<double> coverage{"coverage", "", "covered share of the node's part of the skin"};
inline constexpr FieldName<double> hem{"hem", "", "1 in the strip beside an edge of a garment (hem.hpp), else 0"};
inline constexpr FieldName<double> pressure_inside{"pressure_inside", "Pa", "of the contact beside those strips, 0 in them"};
/// Of a node's own `pressure_inside` and of the points beside the strips in a facet of the node that a strip's border runs through.
inline constexpr FieldName<double> largest_inside{"largest_inside", "Pa", "largest pressure beside those strips", Place::node, false};
inline constexpr FieldName<double> laplace_pressure{"laplace_pressure", "Pa", "tension times curvature on the undeformed skin"};
inline constexpr FieldName<Eigen::Vector3d> shear_traction{"shear_traction", "Pa", "friction of the garment on the skin, on a garment of the skin on it"};
inline constexpr FieldName<double> slip{"slip", "", "0 no contact, 1 sticks, 2 slips"};
inline constexpr FieldName<double> skin_area{"skin_area", "m2", "the node's part of the deformed skin", Place::node, false};
/// Nodal averages; of a shell that of its middle.
inline constexpr FieldName<Stress> cauchy_stress{"cauchy_stress", "Pa", "Cauchy stress"};
inline constexpr FieldName<double> von_mises{"von_mises", "Pa", "von Mises equivalent of cauchy_stress"};
inline constexpr FieldName<Eigen::Vector3d> principal_stress{
    "principal_stress", "Pa", "of cauchy_stress, largest first", Place::node, true, {"S1", "S2", "S3"}};
inline constexpr FieldName<Stress> stress_top{"stress_top", "Pa", "Cauchy stress of a shell where its normal points"};
inline constexpr FieldName<Stress> stress_bottom{"stress_bottom", "Pa", "Cauchy stress of a shell on the other side"};
inline constexpr FieldName<int> location{"location", "", "index into location_names; -1: none"};
inline constexpr FieldName<double> sensation{"sensation", "", "rating of a covered node's location, 0 to 4"};
inline constexpr FieldName<int> layer{"layer", "", "index into layer_names", Place::cell};

inline constexpr FieldName<double> tension_warp{"tension_warp", "N/m", "Cauchy force per current length along warp", Place::cell};
inline constexpr FieldName<double> tension_weft{"tension_weft", "N/m", "Cauchy force per current length along weft", Place::cell};
inline constexpr FieldName<double> shear{"shear", "N/m", "Cauchy shear force per current length", Place::cell};
inline constexpr FieldName<Eigen::Vector2d> stretch{"stretch", "", "current length over that on the pattern", Place::cell};
inline constexpr FieldName<double> wrinkled{"wrinkled", "", "0 taut, 1 wrinkled, 2 slack", Place::cell};
inline constexpr FieldName<Eigen::Vector2d> pattern{"pattern", "m", "place on the flat pieces", Place::node, true, {"x", "y"}};
inline constexpr FieldName<int> piece{"piece", "", "index into piece_names", Place::cell};
inline constexpr FieldName<double> garment{"garment", "", "which of several, in the order of the case", Place::cell};
inline constexpr FieldName<double> area_ratio{"area_ratio", "", "current area over that on the pattern", Place::cell, false};

}  // namespace field

/// Unit and meaning of one of our own fields; empty texts of another's.
struct FieldMeaning {
  std::string_view name, unit, description;
};
FieldMeaning meaning_of(std::string_view name);

/// A field with all its values. Tensors are symmetric: xx yy zz xy yz xz. SI.
struct NamedField {
  using Values = std::variant<std::vector<double>, std::vector<int>, std::vector<Eigen::Vector2d>, std::vector<Eigen::Vector3d>, std::vector<Stress>>;

  std::string name, unit, description;
  Place place = Place::node;
  Values values;
  std::vector<std::string> components;  ///< names; empty: a scalar
  bool recorded = true;

  std::size_t size() const;
  /// Component of an entry, as a number.
  double at(std::size_t entry, std::size_t component = 0) const;
};

/// The components of a kind of value: along warp and weft, of a vector, of a tensor.
std::vector<std::string> usual_components(const NamedField::Values& values);

template <class Value>
NamedField named(const FieldName<Value>& name, std::vector<Value> values) {
  NamedField field{name.name, name.unit, name.description, name.place, std::move(values), {}, name.recorded};
  for (const char* component : name.components)
    if (component) field.components.emplace_back(component);
  if (field.components.empty()) field.components = usual_components(field.values);
  return field;
}

/// The fields of a body or of all garments: our own in the order in which files list them, others behind in the order in
/// which they came. A field that a scene does not have is not there. References stay good while other fields come and go.
class Fields {
 public:
  auto begin() const { return list_.begin(); }
  auto end() const { return list_.end(); }
  bool empty() const { return list_.empty(); }

  const NamedField* find(std::string_view name) const;
  NamedField* find(std::string_view name);
  /// Throws std::logic_error where there is one of that name.
  void add(NamedField field);
  void remove(std::string_view name);

  template <class Value>
  bool has(const FieldName<Value>& name) const {
    return find(name) != nullptr;
  }
  /// The values, or null where there are none of that kind.
  template <class Value>
  const std::vector<Value>* find(const FieldName<Value>& name) const {
    const NamedField* field = find(std::string_view(name.name));
    return field ? std::get_if<std::vector<Value>>(&field->values) : nullptr;
  }
  /// The values; throws std::out_of_range where there are none.
  template <class Value>
  const std::vector<Value>& operator[](const FieldName<Value>& name) const {
    const std::vector<Value>* values = find(name);
    if (!values) lacking(name.name);
    return *values;
  }
  template <class Value>
  std::vector<Value>& operator[](const FieldName<Value>& name) {
    return const_cast<std::vector<Value>&>(std::as_const(*this)[name]);
  }
  /// Adds a field, or gives it other values.
  template <class Value>
  std::vector<Value>& set(const FieldName<Value>& name, std::vector<Value> values) {
    if (NamedField* there = find(std::string_view(name.name)))
      there->values = std::move(values);
    else
      add(named(name, std::move(values)));
    return (*this)[name];
  }
  /// The values; zeros for so many entries where there are none yet.
  template <class Value>
  std::vector<Value>& ensure(const FieldName<Value>& name, std::size_t entries) {
    if (has(name)) return (*this)[name];
    std::vector<Value> zeros(entries);
    if constexpr (!std::is_arithmetic_v<Value>) std::fill(zeros.begin(), zeros.end(), Value::Zero());
    return set(name, std::move(zeros));
  }
  template <class Value>
  void remove(const FieldName<Value>& name) {
    remove(std::string_view(name.name));
  }

 private:
  [[noreturn]] static void lacking(std::string_view name);
  std::list<NamedField> list_;
};

/// Adds `cauchy_stress` and what follows from it: `von_mises` and `principal_stress`.
void add_stress(Fields& fields, std::vector<Stress> cauchy);

}  // namespace snug::postproc
