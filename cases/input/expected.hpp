// expected.toml: what a case must give.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/diagnostics.hpp"
#include "cases/input/field.hpp"

namespace snug::input {

/// One entry: a number with its tolerance, or a text.
struct Expected {
  std::string quantity, text, source;
  std::optional<double> value, relative, absolute;
  Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "quantity",
                .meaning = "dotted key of summary.json; rows of locations by their name, components by 0, 1, 2",
                .required = true},
          self.quantity);
    field(Field{.key = "value", .meaning = "number expected, in the unit of the key"}, self.value);
    field(Field{.key = "text", .meaning = "text expected, instead of a number"}, self.text);
    field(Field{.key = "relative", .meaning = "tolerance over |value|", .bound = positive()}, self.relative);
    field(Field{.key = "absolute", .meaning = "tolerance in the unit of the key", .bound = positive()}, self.absolute);
    field(Field{.key = "source", .meaning = "exact, paper, or own run with its date", .required = true}, self.source);
  }
};

/// Reads the file. Throws InputError with every error together.
std::vector<Expected> read_expected(const std::filesystem::path& file);

}  // namespace snug::input
