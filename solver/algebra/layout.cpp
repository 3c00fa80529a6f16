#include "solver/algebra/layout.hpp"

#include <algorithm>
#include <stdexcept>

namespace snug::solver {

namespace {

template <class Fields>
auto find(Fields& fields, const std::string& name) {
  return std::find_if(fields.begin(), fields.end(), [&](const Field& field) { return field.name == name; });
}

}  // namespace

Field Layout::add(Field field) {
  if (find(fields_, field.name) != fields_.end()) throw std::logic_error("a second field is called " + field.name);
  field.first = size();
  if (field.rows == Rows::force) {
    if (positions_ != field.first) throw std::logic_error("the positions of " + field.name + " come after other fields");
    positions_ = field.end();
  }
  return fields_.emplace_back(std::move(field));
}

const Field& Layout::operator[](const std::string& name) const {
  static const Field none;
  const auto it = find(fields_, name);
  return it == fields_.end() ? none : *it;
}

}  // namespace snug::solver
