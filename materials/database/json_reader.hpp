// JSON text as the plain values of cases/input.
#pragma once

#include <string>

#include "cases/input/table.hpp"

namespace snug::materials {

/// The object that a JSON text is, members in their order, nulls as texts that are empty. Every place is `where`.
/// Throws input::InputError where the text is no JSON, no object, or nested more than 20 deep.
input::Table table_of_json(const std::string& text, const input::Location& where);

}  // namespace snug::materials
