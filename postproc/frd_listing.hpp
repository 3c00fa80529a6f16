// Results of CalculiX in its .frd files.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "postproc/listing_reader.hpp"

namespace snug::postproc {

/// Places, displacements and stresses at the nodes of every step of a .frd file in ASCII (*NODE FILE, U; *EL FILE, S); nothing where the text is none.
/// Other blocks are passed over; their components are global. Binary ones, rows that are cut short and what is no number are reported. Source: CalculiX GraphiX
/// manual, "Result Format" (chapters 11.2 to 11.6): values stand in columns of 12, nodes in columns of 5 or 10.
std::optional<std::vector<ListingTable>> frd_tables(std::string_view text, const std::string& shown_as, input::Diagnostics& diagnostics);

}  // namespace snug::postproc
