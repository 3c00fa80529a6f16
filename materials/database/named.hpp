// The library as cases see it: what ships, and how a name of a case becomes the table that its law reads.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/input/material_entry.hpp"
#include "materials/database/library.hpp"

namespace snug::materials {

/// What the library begins with: fabrics.toml and tissues.toml, and the texts of materials/data/library. Where both
/// have a fabric its data are put together: a number that both print stands once, with the deviation and the source of
/// the table, and comes first.
Entries shipped_entries(UnitBook& units);
/// Of these texts; another when one of them changes.
std::string shipped_edition();
/// What a law reads of an entity of that kind.
bool is_law_key(Kind kind, const std::string& item);
/// With all of these.
Library::Settings library_settings(const std::filesystem::path& file, const std::string& who);

/// The entry that a case names, as a table of its numbers. Left as it is: a table of the case, "rigid", and what
/// fabrics.toml and tissues.toml have, for which nothing else is looked at. Otherwise what ships is looked through, and
/// then the library, where `file` names one that is there (it is not made). Throws input::InputError with the nearest
/// name, and for an entity without a law.
input::MaterialEntry resolved(const input::MaterialEntry& asked, Kind kind, const std::filesystem::path& file);

/// The table of an entity as the reader of its law wants it, for a case that names it at `where`. Throws input::InputError without a law.
input::MaterialEntry entry_of(const Entity& entity, const input::Location& where, UnitBook& units);

/// Fabrics and tissues that ship with a law beyond fabrics.toml and tissues.toml.
std::vector<std::string> further_shipped(Kind kind);

}  // namespace snug::materials
