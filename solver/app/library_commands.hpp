// The part of snug materials that reads and writes the engineering database.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "materials/database/library.hpp"
#include "solver/app/command.hpp"

namespace snug::app {

/// find, evaluate, items, add, copy, edit, remove, history, undo, import, export, check: each a command below
/// materials.
std::vector<std::unique_ptr<Command>> library_commands();

/// The library of the user, made where it is not there. Throws input::InputError.
materials::Library open_library();

/// Everything that is known of an entity, a line a datum: as printed, in SI, source. Of the library when it is there
/// (it is not made), else of what ships. Empty when nobody knows it.
std::string known_data_text(const std::string& id);
/// The same for --json; null when nobody knows it.
nlohmann::ordered_json known_data_json(const std::string& id);

/// The unit that the SI value of a datum has; empty for plain numbers and texts.
std::string si_unit(const materials::Datum& datum, materials::UnitBook& units);

/// IDs of own entities of a kind, with a law or without; none when there is no library.
std::vector<std::string> own_entities(materials::Kind kind);

}  // namespace snug::app
