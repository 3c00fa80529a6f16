// An entity as it was, for the history.
#pragma once

#include <string>

#include "materials/database/datum.hpp"

namespace snug::materials {

/// With the marks of what ships.
std::string snapshot(const Entity& entity);
/// Throws input::InputError when it is none.
Entity from_snapshot(const std::string& text);

}  // namespace snug::materials
