// The shipped data as TOML text, one table an entry (materials/data/*.toml, put into the program when it is built).
#pragma once

#include <string>
#include <vector>

#include "cases/input/field.hpp"
#include "cases/input/material_entry.hpp"
#include "cases/input/table.hpp"

namespace snug::materials {

extern const char* const shipped_fabrics;
extern const char* const shipped_tissues;

/// What ships beyond what a run reads by itself (materials/data/library): entities as TOML, and the files they refer
/// to.
struct ShippedText {
  const char *name, *text;
};
const std::vector<ShippedText>& shipped_library();

/// Where an entry's numbers come from.
struct Provenance {
  std::string name;
  std::string source;
  std::vector<std::string> assumptions;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "name", .meaning = "what results call it, of values that stand in a case"}, self.name);
    field(Field{.key = "source", .meaning = "where the numbers come from, as printed there"}, self.source);
    field(Field{.key = "assumptions", .meaning = "what is not measured and was chosen instead"}, self.assumptions);
  }
  /// Source and assumptions in one line.
  std::string text() const;
};

/// One entry by its name or the inline table of an entry, with the name it goes by.
struct Entry {
  std::string name;
  input::Table table;
  Provenance provenance;
};

/// Finds the table that `asked` means: its own one, or the entry of that name in `shipped`. `what` ("fabric", "tissue") is
/// for the message. Throws input::InputError with the nearest known name.
Entry find_entry(const input::MaterialEntry& asked, const input::Table& shipped, const std::string& what);

/// An entry written out: its law with the values in SI and its defaults, what `more` adds, its name and where it comes from.
input::Table written_out(const Entry& entry, const input::Table& form, const input::Table& more);

/// Keys of an entry that are not the law's own.
inline std::vector<std::string> common_keys() { return {"law", "name", "source", "assumptions"}; }

}  // namespace snug::materials
