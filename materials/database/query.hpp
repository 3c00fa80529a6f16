// Questions such as  weight < 250 g/m2 and EMT > 30 % and not composition ~ "polyester"
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "materials/database/datum.hpp"

namespace snug::materials {

/// A question as a condition of SQL on `e` (entity) with places for what the user wrote.
///
///   question   = and-parts joined by "or"; and-part = parts joined by "and"; part = "not" part | "(" question ")" |
///   comparison comparison = ITEM < <= > >= = != NUMBER UNIT | ITEM = != ~ TEXT | has ITEM
///
/// ITEM: a name or symbol of an item, in double quotes where it holds blanks; `id`, `kind` and `parent` of the entity,
/// too. ~ : holds the text, without regard to case. An entity without the item answers no comparison, != neither.
struct Condition {
  std::string sql;
  /// Selections of entities by an index, each of which holds every answer: the comparisons that are joined by "and"
  /// alone.
  std::vector<std::string> bounds;
  std::vector<std::variant<double, std::string>> places;
};

/// What is known of an item: nothing when no entity has it; empty text for a plain number, "text" for texts, else its
/// unit.
using ItemUnit = std::function<std::optional<std::string>(const std::string& name)>;

/// At most 4,000 characters and 100 comparisons, nested 50 deep. Throws input::InputError with the column, the nearest
/// item where one is not known, and the unit that is missing.
Condition parse_question(const std::string& question, UnitBook& units, const ItemUnit& unit_of,
                         const std::vector<std::string>& known_items);

}  // namespace snug::materials
