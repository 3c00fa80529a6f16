// Entities as the tables of a text: [fabric.N88P] of a TOML file, or the same as JSON. What stands there reads back to
// the same data.
//
//   [fabric."my knit"]
//   parent = "007"                                        # an entity one step up
//   source = "our laboratory, 2026-03-01"                 # of all data that name none
//   weight = "215.0 g/m2"                                 # digits as printed; "1.09" is a plain number
//   WT = "10.02 +- 8.26 gf cm/cm2"                        # with its standard deviation
//   LT = [{ value = "1.00", source = "table 5.2" }, { value = "1.02", source = "table 7.1" }]   # the first counts
//   G = { value = "0.66 gf/(cm degree)", range = ["0.4 gf/(cm degree)", "0.9 gf/(cm degree)"] }
//   warp = { equation = "EA*thickness", unit = "N/m" }
//   "weft tensile test" = { table = "weft.csv" }          # a file beside this one; figure = "weft.png" likewise
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cases/input/table.hpp"
#include "materials/database/datum.hpp"

namespace snug::materials {

/// A file that data refer to by its hash.
struct LibraryFile {
  std::string hash, name, content;
};

/// Entities of a text with the files they refer to.
struct Entries {
  std::vector<Entity> entities;
  std::vector<LibraryFile> files;
};

/// The content of a file that a text names; throws input::InputError.
using FileReader = std::function<std::string(const std::string& name, const input::Location& where)>;
/// Reads files of a folder, at most 16 MB each, none outside of it.
FileReader files_of(const std::filesystem::path& folder);

/// Entities of a text whose tables are named kind.id. Reports everything that is wrong with them but what needs the
/// library.
Entries entries_of(const input::Table& text, const FileReader& read, UnitBook& units, input::Diagnostics& diagnostics);
/// One of them, of a table of its own.
Entity entity_of(Kind kind, const std::string& id, const input::Table& table, const FileReader& read, UnitBook& units,
                 std::vector<LibraryFile>& files, input::Diagnostics& diagnostics);

/// Data of such a table alone.
std::vector<Datum> data_of(const input::Table& table, const FileReader& read, UnitBook& units,
                           std::vector<LibraryFile>& files, input::Diagnostics& diagnostics);

/// An item from a text such as a user writes behind "=": "0.57 mm", "1.00 +- 0.11", "twill".
Datum datum_of(const std::string& name, const std::string& text, UnitBook& units);

/// The table that reads back to the same entity; `file_name`: what a file of that hash is called there.
input::Table to_table(const Entity& entity, const std::function<std::string(const std::string& hash)>& file_name);
/// kind.id for several.
input::Table to_table(const std::vector<Entity>& entities,
                      const std::function<std::string(const std::string& hash)>& file_name);

/// What the laws of fabrics and tissues read: the first datum of each name, numbers as they were printed, equations as
/// their values.
input::Table law_table(const Entity& entity, UnitBook& units);

}  // namespace snug::materials
