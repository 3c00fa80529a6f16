// Entities in and out: TOML and JSON (text_form.hpp), and CSV.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "materials/database/library.hpp"

namespace snug::materials {

/// Entities of a .toml, .json or .csv file. A CSV file has either a row a datum, as it is written,
///   kind,id,parent,item,type,value,unit,uncertainty,low,high,symbol,source
/// or a row an entity: id, kind (else `kind` of the call), parent, and one column an item, with its unit in the head:
/// "weight [g/m2]". At most 256 MB (JSON 64 MB, TOML 256 kB, which is what its parser takes). Throws input::InputError
/// with all that is wrong.
Entries read_entries(const std::filesystem::path& file, Kind kind, UnitBook& units);

/// Writes entities by the ending of the file's name, with the files they refer to beside a .toml or .json. Reading
/// gives the same again. Throws std::runtime_error where it cannot be written, input::InputError for another ending.
void write_entries(const std::vector<Entity>& entities, const Library& library, const std::filesystem::path& file);

/// The text of such a file; ending ".toml", ".json" or ".csv".
std::string text_of_entries(const std::vector<Entity>& entities, const Library& library, const std::string& ending);

}  // namespace snug::materials
