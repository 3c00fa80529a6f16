// The items that entities of a kind usually have (tables 2.1 to 2.4 of the source), with their symbols and dimensions.
// Others can be added by name; these keep theirs.
#pragma once

#include <string>
#include <vector>

#include "materials/database/datum.hpp"

namespace snug::materials {

enum class Block { general, structural, mechanical, physical, physiological, material };
constexpr auto texts_of(Block) {
  return std::array{"general", "structural", "mechanical", "physical", "physiological", "material"};
}

struct Item {
  Kind kind;
  Block block;
  const char* name;    ///< as in the library; of what a law reads its key there
  const char* symbol;  ///< as queries may say, too; empty: none
  const char* unit;    ///< of the SI; "" plain number, "text" a text
  const char* meaning;
  const char* bare = "";  ///< what a number without unit has where a law writes it so ("%"), else ""
};

const std::vector<Item>& usual_items();
/// Of whatever kind it is; nullptr where it is none of them.
const Item* usual_item(const std::string& name);
const Item* usual_symbol(const std::string& symbol);

}  // namespace snug::materials
