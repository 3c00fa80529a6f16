// Displacements in the log and the data files of FEBio.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "postproc/listing_reader.hpp"

namespace snug::postproc {

/// The records of node data (<node_data data="ux;uy;uz">) of all times; nothing where the text has no records of FEBio. A record is known by its name:
/// the list of its variables, or "displacement". Records of other variables are passed over; rows that are cut short and what is no number are reported.
/// Source: FEBio User's Manual, version 4, sec. 3.17.1 "Logfile".
std::optional<std::vector<ListingTable>> febio_records(std::string_view text, const std::string& shown_as, input::Diagnostics& diagnostics);

}  // namespace snug::postproc
