// Numbers of an entity that do not go together.
#pragma once

#include <string>
#include <vector>

#include "materials/database/datum.hpp"

namespace snug::materials {

/// One line each, empty where nothing is doubtful. Compared are, where the entity has them: weight over thickness with
/// the density; the work of a tensile test with its linearity, largest force and elongation, WT = LT Fm EMT/2 (warp and
/// weft); what compression takes off with the thickness; each value with its own range. More than a twentieth apart is
/// doubtful: measured digits differ by less.
std::vector<std::string> doubts_of(const Entity& entity);

}  // namespace snug::materials
