#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cases/input/echo.hpp"
#include "cases/input/material_entry.hpp"
#include "cases/input/reader.hpp"
#include "cases/input/key_list.hpp"

namespace snug::input {
namespace {

struct Part {
  double thickness = 0.001;
  double ratio = 0.3;
  int cells = 2;
  std::string form = "solid";
  std::optional<double> modulus;
  MaterialEntry material;
  Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "thickness", .unit = "m", .meaning = "through the layer", .required = true, .bound = positive()},
          self.thickness);
    field(Field{.key = "ratio", .bound = {.low = 0.0, .high = 0.5, .high_open = true}}, self.ratio);
    field(Field{.key = "cells", .bound = {.low = 1}}, self.cells);
    field(Field{.key = "form", .choices = {"solid", "membrane", "rigid"}}, self.form);
    field(Field{.key = "modulus", .unit = "Pa"}, self.modulus);
    field(Field{.key = "material"}, self.material);
  }
};

Part read_part(const std::string& text, Diagnostics& diagnostics) {
  const Table table = parse_text(text, {"case.toml", 1, 1}, diagnostics);
  return read<Part>(table, diagnostics);
}

std::string only_error(const std::string& text) {
  Diagnostics diagnostics;
  read_part(text, diagnostics);
  EXPECT_EQ(diagnostics.errors().size(), 1u);
  return diagnostics.any() ? to_string(diagnostics.errors()[0]) : "";
}

TEST(Reader, QuantitiesArriveInSi) {
  // A described struct is filled in SI whatever units were written, and what is left out keeps its default.
  Diagnostics diagnostics;
  const Part part = read_part("thickness = \"0.57 mm\"\nmodulus = \"20 gf/cm2\"\n", diagnostics);
  EXPECT_FALSE(diagnostics.any());
  EXPECT_DOUBLE_EQ(part.thickness, 0.57e-3);
  EXPECT_NEAR(*part.modulus, 1961.33, 1e-9);
  EXPECT_EQ(part.cells, 2);
  EXPECT_EQ(part.form, "solid");
}

TEST(Reader, BareNumberIsRefusedWithTheUnitExpected) {
  // A number without unit where one is due is an error at its place that names the SI unit, even 0.
  EXPECT_EQ(only_error("thickness = 0.57"),
            "case.toml:1:13: error: thickness is the bare number 0.57; a unit is due here: write \"0.57 m\" if SI was "
            "meant, e.g. \"0.57 mm\"");
  EXPECT_NE(only_error("thickness = 0").find("write \"0 m\" if SI was meant"), std::string::npos);
}

TEST(Reader, WrongDimensionNamesWhatIsExpected) {
  // A quantity of another dimension is refused with the dimension due and an example.
  const std::string error = only_error("thickness = \"1 mm\"\nmodulus = \"3 mm\"");
  EXPECT_EQ(
      error,
      "case.toml:2:11: error: modulus: \"3 mm\" is not a pressure; give a pressure with its unit, e.g. \"20 gf/cm2\" "
      "(SI: Pa)");
}

TEST(Reader, UnknownKeyHasTheNearestKnownOneAsHint) {
  // A misspelt key is an error at the key itself.
  const std::string error = only_error("thickness = \"1 mm\"\n  raito = 0.3");
  EXPECT_EQ(error.rfind("case.toml:2:3: error: unknown key raito; did you mean ratio? known: thickness, ratio", 0), 0u)
      << error;
}

TEST(Reader, AllErrorsComeTogether) {
  // Reading goes on after an error: five faults give five diagnostics.
  Diagnostics diagnostics;
  read_part("ratio = 0.5\ncells = 2.5\nform = \"solidd\"\nfoo = 1\n", diagnostics);
  std::vector<std::pair<int, int>> places;
  for (const Diagnostic& error : diagnostics.errors()) places.emplace_back(error.where.line, error.where.column);
  EXPECT_EQ(places, (std::vector<std::pair<int, int>>{{1, 1}, {1, 9}, {2, 9}, {3, 8}, {4, 1}}));
  EXPECT_THROW(diagnostics.throw_if_any(), InputError);
}

TEST(Reader, AnOpenBoundIsNotReached) {
  // A thickness of nothing and a ratio of one half lie on open bounds and are refused; a ratio of 0 and one cell lie on closed ones.
  EXPECT_NE(only_error("thickness = \"0 mm\"").find("it must be greater than 0 m"), std::string::npos);
  EXPECT_NE(only_error("thickness = \"1 mm\"\nratio = 0.5").find("less than 0.5"), std::string::npos);
  Diagnostics diagnostics;
  EXPECT_EQ(read_part("thickness = \"1 mm\"\nratio = 0\ncells = 1", diagnostics).ratio, 0.0);
  EXPECT_FALSE(diagnostics.any());
}

TEST(Reader, BoundIsNamedInSi) {
  // A number outside its bound is refused with the bound.
  EXPECT_EQ(only_error("thickness = \"0 mm\""), "case.toml:1:13: error: thickness is 0 m; it must be greater than 0 m");
}

TEST(Reader, InlineTableKeepsTheExactPlaces) {
  // The values of an inline table that another room reads later still point into the case file.
  for (const std::string text : {"thickness = \"1 mm\"\nmaterial = {  law = \"linear\",   warp=3 }\n",
                                 "thickness = \"1 mm\"\n[material]\nlaw = \"linear\"\n\n    warp   =   3\n"}) {
    Diagnostics diagnostics;
    const Table table = parse_text(text, {"case.toml", 1, 1}, diagnostics);
    const Part part = read<Part>(table, diagnostics);
    ASSERT_FALSE(diagnostics.any()) << to_string(diagnostics.errors()[0]);
    const Table& inner = part.material.table;
    const Table& original = *table.table("material");
    ASSERT_EQ(inner.keys(), original.keys());
    for (std::size_t i = 0; i < inner.entries.size(); ++i) {
      EXPECT_EQ(inner.entries[i].where.line, original.entries[i].where.line);
      EXPECT_EQ(inner.entries[i].where.column, original.entries[i].where.column);
      EXPECT_EQ(inner.entries[i].value.where.column, original.entries[i].value.where.column);
    }
  }
}

TEST(Reader, ChoiceOfALawIsReadBeforeTheLaw) {
  // A room may read the key that selects the law and leave the others to the law.
  Diagnostics diagnostics;
  const Table table = parse_text("{ law = \"neo-Hook\", a = 1 }", {"case.toml", 7, 20}, diagnostics);
  read_choice(table, "law", {"neo-Hooke", "Ogden"}, diagnostics);
  ASSERT_EQ(diagnostics.errors().size(), 1u);
  EXPECT_EQ(to_string(diagnostics.errors()[0]),
            "case.toml:7:28: error: \"neo-Hook\" is no law; did you mean neo-Hooke? known: neo-Hooke, Ogden");
}

TEST(Reader, WrongSyntaxIsLocated) {
  // A text that is no TOML is one located error.
  Diagnostics diagnostics;
  parse_text("a = 1\nb = = 2\n", {"case.toml", 1, 1}, diagnostics);
  ASSERT_EQ(diagnostics.errors().size(), 1u);
  EXPECT_EQ(diagnostics.errors()[0].where.line, 2) << to_string(diagnostics.errors()[0]);
}

TEST(Reader, HostileTextIsAnErrorAndNoCrash) {
  // Nesting that would overflow the parser, duplicate keys and binary bytes are located errors.
  for (const std::string& text :
       {"a = 1\nb = " + std::string(100000, '['), "b = 1\na" + std::string(100000, '.') + "b = 1",
        std::string("a = 1\na = 2"), std::string("a = 1\n\0\1\377 = 3", 12), std::string("a = 1\nb = \"open")}) {
    Diagnostics diagnostics;
    parse_text(text, {"case.toml", 1, 1}, diagnostics);
    ASSERT_EQ(diagnostics.errors().size(), 1u);
    EXPECT_EQ(diagnostics.errors()[0].where.line, 2) << to_string(diagnostics.errors()[0]);
  }
}

enum class Fibre { wool, raw_silk };
constexpr auto texts_of(Fibre) { return std::array{"wool", "raw silk"}; }

struct Yarn {
  Fibre fibre = Fibre::wool;
  std::vector<Fibre> plied = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "fibre", .meaning = "what it is spun of"}, self.fibre);
    field(Field{.key = "plied"}, self.plied);
  }
};

TEST(Reader, AChoiceIsReadAsItsEnumerator) {
  // One of the texts of an enum is read as its enumerator, written as that text again, and explained with all of them; what is
  // none of them is an error and leaves the default.
  Diagnostics diagnostics;
  const Table table = parse_text("fibre = \"raw silk\"\nplied = [\"wool\", \"raw silk\"]\n", {"case.toml", 1, 1}, diagnostics);
  const Yarn yarn = read<Yarn>(table, diagnostics);
  EXPECT_FALSE(diagnostics.any());
  EXPECT_EQ(yarn.fibre, Fibre::raw_silk);
  EXPECT_EQ(yarn.plied, (std::vector{Fibre::wool, Fibre::raw_silk}));
  EXPECT_EQ(to_toml(to_table(yarn)), "fibre = \"raw silk\"\nplied = [\"wool\", \"raw silk\"]\n");
  const std::vector<KeyRow> rows = keys_of<Yarn>();
  EXPECT_EQ(rows.front().kind, "choice");
  EXPECT_EQ(rows.front().default_value, "\"wool\"");
  EXPECT_EQ(rows.front().field.choices, (std::vector<std::string>{"wool", "raw silk"}));
  EXPECT_EQ(read<Yarn>(parse_text("fibre = \"raw silt\"\n", {"case.toml", 1, 1}, diagnostics), diagnostics).fibre, Fibre::wool);
  ASSERT_EQ(diagnostics.errors().size(), 1u);
  EXPECT_EQ(to_string(diagnostics.errors()[0]), "case.toml:1:9: error: \"raw silt\" is no fibre; did you mean raw silk? known: wool, raw silk");
}

}  // namespace
}  // namespace snug::input
