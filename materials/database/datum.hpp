// What the library knows: entities (a fibre, a fabric, a body, ...) and their data, each with what was printed and what
// that is in SI.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/choice.hpp"
#include "cases/input/diagnostics.hpp"
#include "materials/database/unit_book.hpp"

namespace snug::materials {

/// From the leaves of the hierarchy upwards: a fibre's parent may be a yarn or a fabric, a fabric's a garment. Tissues
/// belong to bodies.
enum class Kind { fibre, yarn, fabric, garment, tissue, body, project };
constexpr auto texts_of(Kind) { return std::array{"fibre", "yarn", "fabric", "garment", "tissue", "body", "project"}; }
/// Kinds that the parent of an entity may have.
std::vector<Kind> parents_of(Kind kind);

/// value: a number or a text, or nothing (a state variable, given when the data are asked for); equation: an expression
/// of other data; table and figure: a file of the library, by the hash of its content.
enum class DatumType { value, equation, table, figure };
constexpr auto texts_of(DatumType) { return std::array{"value", "equation", "table", "figure"}; }

/// One property as it was printed or measured. An entity may have several of one name (another source, another type):
/// the first counts.
struct Datum {
  std::string name = {};    ///< of the item: "weight", "LT"
  std::string symbol = {};  ///< in equations; empty: the name
  DatumType type = DatumType::value;
  std::string value = {};                             ///< digits as printed, text, expression, or hash
  std::string unit = {};                              ///< as printed; of an equation that of its result
  std::string uncertainty = {}, low = {}, high = {};  ///< standard deviation and range, digits as printed, in `unit`
  std::string source = {};                            ///< empty: that of the entity
  std::optional<double> si = {};  ///< the number in SI; nothing for texts, files, and equations that need more
  bool shipped = false;           ///< of the text that ships
  bool operator==(const Datum&) const = default;
};

struct Entity {
  Kind kind = Kind::fabric;
  std::string id, parent = {};  ///< of the whole library, one of a kind; empty: no parent
  std::vector<Datum> data = {};
  bool shipped = false;
  input::Location where = {};  ///< in the file it was read from

  /// The first datum of that name, or nullptr.
  const Datum* find(const std::string& name) const;
  bool same_content(const Entity& other) const;
};

/// The same kind, ID, parent and data, whoever ships them and in whatever order of the items.
bool same_values(const Entity& a, const Entity& b);

/// The number that a text is, all of it and finite; an optional sign, digits, a decimal point, an exponent.
std::optional<double> plain_number(const std::string& text);

/// What stands in a text such as "11.01 +- 1.06 gf cm/cm2": number, standard deviation, unit, all but the number
/// optional. Nothing where it does not begin with a number or what follows is no unit: then it is a text.
struct Printed {
  std::string number, uncertainty, unit;
};
std::optional<Printed> printed_quantity(const std::string& text, UnitBook& units);
/// The same quantity as text again.
std::string quantity_text(const Datum& datum);

/// Whether names, texts and numbers are fit to be kept; reports what is not at `where`. Names: letters, digits, blanks
/// and - _ . + / ( ), at most 100 bytes; texts: at most 100,000 bytes of UTF-8 without control characters.
void check_id(const std::string& id, const input::Location& where, input::Diagnostics& diagnostics);
/// The same of a text beside the data; throws input::InputError.
void check_remark(const std::string& what, const std::string& text);
/// Fills `si` of a value with its unit.
void check_datum(Datum& datum, UnitBook& units, const input::Location& where, input::Diagnostics& diagnostics);

}  // namespace snug::materials
