// Declare an input once: each law, term, body kind and recorder has one
//
//   template <class Self, class Visitor>
//   static void describe(Self& self, Visitor&& field) {
//     field(Field{.key = "shear_modulus", .unit = "Pa", .meaning = "initial shear modulus", .required = true,
//                 .bound = positive()}, self.shear_modulus);
//   }
//
// next to the struct it fills. Reading, checking, the list of keys, the echo and the schema are visitors
// over that one list. The default of a field is the member's own initial value; a std::optional member may be left out.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace snug::input {

/// Admissible interval of a number in SI; `open` ends exclude the value itself.
struct Bound {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;
};

inline Bound positive() { return {.low = 0.0, .low_open = true}; }
inline Bound non_negative() { return {.low = 0.0}; }
inline Bound between(double low, double high) { return {.low = low, .high = high}; }

/// The description of one input.
struct Field {
  std::string key;
  std::string unit = {};  ///< SI unit of a quantity ("m", "Pa", "N/m", "rad"); empty for text, counts and ratios
  std::string meaning = {};
  bool required = false;
  Bound bound = {};
  std::vector<std::string> choices = {};  ///< admissible texts, when the field is a choice
  std::string text_key = {};  ///< of a table: the key that a text in its place stands for
  bool one_or_more = false;               ///< a list of tables of which one may stand as a plain table, without brackets
};

}  // namespace snug::input
