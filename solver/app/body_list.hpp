// The standard bodies that ship, for snug list.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace snug::app {

/// Each with source and licence, girths, cuts and locations. Throws input::InputError where a file of theirs is broken.
std::string bodies_text();
/// The same for --json: one object a body.
nlohmann::ordered_json bodies_json();

}  // namespace snug::app
