// Nodal tables with a head line and separated columns, as Workbench, PyMAPDL and Abaqus write them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "postproc/listing_reader.hpp"

namespace snug::postproc {

/// The table of a file whose first line heads a column of node numbers ("Node Number<tab>Total Deformation (mm)", "node,UX,UY,UZ");
/// behind columns of Abaqus such as Frame and Instance Name too, or with a first column without a name, as of data frames);
/// nothing where it is none. Columns are named as Ansys does (USUM, SEQV, S1, ...) and carry the units of their heads. Reports what
/// is wrong in it.
std::optional<ListingTable> column_table(std::string_view text, const std::filesystem::path& file, input::Diagnostics& diagnostics);

/// The table of a report of Abaqus (.rpt: "Field Output Report", values at nodes of one part); nothing where the text is none.
std::optional<ListingTable> field_report(std::string_view text, const std::string& shown_as, input::Diagnostics& diagnostics);

}  // namespace snug::postproc
