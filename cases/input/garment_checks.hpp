// What the garments of a case must have and must not.
#pragma once

#include "cases/input/case.hpp"

namespace snug::input {

/// The table of a garment in the case; null where there is none.
const Table* garment_table(const Table& root, std::size_t garment);

/// Reports what is missing or contradicts itself within each garment, and names that two of them share.
void check_garments(const Case& description, const Table& root, Diagnostics& diagnostics);

}  // namespace snug::input
