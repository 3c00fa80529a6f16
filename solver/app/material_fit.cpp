#include "solver/app/material_fit.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <numbers>

#include "cases/input/suggestion.hpp"
#include "cases/input/units.hpp"
#include "materials/database/datum.hpp"
#include "materials/fabric/measured.hpp"
#include "materials/fabric/reduction.hpp"
#include "solver/app/documents.hpp"
#include "solver/app/library_command.hpp"
#include "solver/app/material_list.hpp"
#include "solver/app/write_named.hpp"

namespace snug::app {

namespace {

using materials::RawTest, materials::Spread, materials::TestKind;

constexpr double gram_force = 9.80665e-3;  // N

/// A quantity as sheets print it.
struct SheetLine {
  const char *symbol, *unit;
  double si;          ///< size of the unit
  bool by_direction;  ///< warp and weft stand apart
  const char* law;    ///< that reads it; "" = every one, "-" = none
};

const std::vector<SheetLine>& sheet_lines() {
  constexpr double per_cm = gram_force / 1e-2, degree = std::numbers::pi / 180.0;
  static const std::vector<SheetLine> lines = {{"LT", "", 1.0, true, "kes"},
                                               {"WT", "gf cm/cm2", per_cm, true, "kes"},
                                               {"Fm", "gf/cm", per_cm, true, "kes"},
                                               {"EMT", "%", 0.01, true, "-"},
                                               {"RT", "%", 0.01, true, "kes"},
                                               {"G", "gf/(cm degree)", per_cm / degree, false, "kes"},
                                               {"2HG", "gf/cm", per_cm, false, ""},
                                               {"2HG5", "gf/cm", per_cm, false, ""},
                                               {"B", "gf cm2/cm", gram_force * 1e-2, true, ""},
                                               {"2HB", "gf cm/cm", gram_force, false, ""},
                                               {"LC", "", 1.0, false, ""},
                                               {"WC", "gf cm/cm2", per_cm, false, ""},
                                               {"RC", "%", 0.01, false, ""},
                                               {"T0", "mm", 1e-3, false, ""},
                                               {"Tm", "mm", 1e-3, false, ""},
                                               {"Pm", "gf/cm2", gram_force / 1e-4, false, ""},
                                               {"MIU", "", 1.0, false, ""},
                                               {"MMD", "", 1.0, false, ""},
                                               {"SMD", "um", 1e-6, false, ""}};
  return lines;
}

/// What the tests gave, one value a specimen, SI.
using Measured = std::map<std::string, std::vector<double>>;

/// The tests of one direction.
struct Direction {
  std::vector<RawTest> tests;
  Measured values;

  std::vector<const RawTest*> tensile() const {
    std::vector<const RawTest*> found;
    for (const RawTest& test : tests)
      if (test.kind == TestKind::tensile) found.push_back(&test);
    return found;
  }
};

std::string toml_line(const std::string& key, input::Value value) {
  input::Table table;
  table.set(key, std::move(value));
  std::string text = input::to_toml(table);
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

/// "0.77089", "\"5.4845 gf cm/cm2\"", with the deviation where there are several specimens and it is wanted.
std::string printed(const SheetLine& line, const Spread& spread, bool with_deviation) {
  std::string text = fmt::format("{:.5g}", spread.mean / line.si);
  const bool deviates = with_deviation && spread.count > 1;
  if (deviates) text += fmt::format(" +- {:.2g}", spread.deviation / line.si);
  if (*line.unit) text += std::string(" ") + line.unit;
  return *line.unit || deviates ? "\"" + text + "\"" : text;
}

std::string points_text(const std::string& key, const RawTest& test) {
  std::vector<materials::CurvePoint> points;
  for (const materials::Sample& sample : test.samples) points.push_back({sample.x, sample.y});
  std::string text = key + "_points = [\n";
  for (const materials::CurvePoint& point : materials::knots_of(points, test.where))
    text += fmt::format("  {{ strain = {:.9g}, force = \"{:.9g} N/m\" }},\n", point.strain, point.force);
  return text + "]\n";
}

class Fit : public Command {
 public:
  std::string name() const override { return "fit"; }
  std::string summary() const override {
    return "raw tests (tensile, shear, bending, compression, friction, roughness) reduced to a fabric, as TOML";
  }

  void declare(CLI::App& app) override {
    app.add_option("CURVES", warp_files_,
                   "tables with units in the head: strain [%], force [gf/cm]; angle [deg], force [gf/cm]; curvature "
                   "[1/cm], moment [gf cm/cm]; thickness "
                   "[mm], pressure [gf/cm2]; distance [mm], friction or height [um]. Rows in the order of the test, "
                   "the way back behind the way up or in a "
                   "column unloading. Several of one kind are specimens: mean and standard deviation")
        ->required();
    app.add_option("--weft", weft_files_, "tables along the weft; the others are then the warp's")->type_name("CURVES");
    app.add_option("--name", name_, "of the fabric; left out: that of the first table");
    app.add_option("--source", source_, "where the numbers come from; left out: the tables");
    app.add_option("--width", width_, "of the specimen where tables have forces (\"50 mm\")");
    app.add_option("--gauge-length", gauge_, "free length of the strip where tables have extensions");
    app.add_option("--hysteresis-at", place_, "curvature at which 2HB is read; the habit of KES is \"1.0 1/cm\"")
        ->capture_default_str();
    app.add_option("--law", law_, "kes: the exponential of LT, WT and Fm; curve: through the points of the test")
        ->check(CLI::IsMember({"kes", "curve"}))
        ->capture_default_str();
    app.add_option("--with", more_, "a further item of the fabric: --with \"weight=215 g/m2\"; may be repeated")
        ->type_name("ITEM=VALUE")
        ->allow_extra_args(false);
    app.add_flag("--case", for_case_, "as a section of case.toml instead of one that snug materials import reads");
    app.add_option("--out", out_, "file to write instead of the terminal");
  }

  int execute() override {
    places_.bending_hysteresis = length("--hysteresis-at", place_, "1/m");
    read(warp_files_, warp_);
    read(weft_files_, weft_);
    const std::string text = entry();
    if (out_.empty())
      console().say_as_it_is(text);
    else
      write_named(out_, text);
    console().document() = {{"file", out_.empty() ? Json() : Json(out_)}, {"toml", text}};
    tell_what_is_missing();
    return done;
  }

 private:
  static double length(const std::string& option, const std::string& text, const char* unit) {
    const input::Quantity size = input::to_si(text, unit);
    if (size.ok() && size.value > 0.0) return size.value;
    throw input::InputError({.file = option}, size.ok() ? "\"" + text + "\" is not greater than 0" : size.found,
                            "give it with its unit, \"" + input::example_quantity(unit) + "\"");
  }

  void read(const std::vector<std::string>& files, Direction& direction) const {
    const materials::Specimen specimen{.width = width_.empty() ? 0.0 : length("--width", width_, "m"),
                                       .gauge_length = gauge_.empty() ? 0.0 : length("--gauge-length", gauge_, "m"),
                                       .width_remedy = "give the width of the specimen, --width \"50 mm\"",
                                       .gauge_remedy = "give the free length of the strip, --gauge-length \"100 mm\""};
    for (const std::string& file : files) {
      direction.tests.push_back(materials::read_test(file, specimen));
      for (const auto& [symbol, value] : materials::reduced(direction.tests.back(), places_))
        direction.values[symbol].push_back(value);
    }
  }

  /// Of the warp, or of both where the law has one number for both.
  std::vector<double> values(const SheetLine& line, bool weft) const {
    std::vector<double> all;
    const auto add = [&](const Measured& measured) {
      if (const auto found = measured.find(line.symbol); found != measured.end())
        all.insert(all.end(), found->second.begin(), found->second.end());
    };
    if (!weft || !line.by_direction) add(warp_.values);
    if (weft || !line.by_direction) add(weft_.values);
    return all;
  }
  bool reads(const SheetLine& line) const { return *line.law == '\0' || line.law == law_; }
  bool has_further(const std::string& item) const {
    return std::any_of(more_.begin(), more_.end(),
                       [&](const std::string& word) { return word.starts_with(item + "="); });
  }

  std::string entry() const {
    const std::string name = entry_name();
    std::string text = for_case_ ? "[garment.fabric]\n" + toml_line("name", input::value_without_place(name)) + "\n"
                                 : "[fabric.\"" + name + "\"]\n";
    text += toml_line("source", input::value_without_place(source_.empty() ? "tests " + tables() : source_)) + "\n";
    if (!warp_.tensile().empty()) text += "law = \"" + law_ + "\"\n";
    for (const SheetLine& line : sheet_lines())
      if (const auto all = values(line, false); !all.empty() && !has_further(line.symbol))
        text += sheet_text(line, line.symbol, materials::spread_of(all));
    text += weft_text() + curve_text();
    for (const std::string& word : more_) {
      const auto [item, value] = item_and_value(word, "fit");
      const auto number = materials::plain_number(value);
      text += toml_line(item, number ? input::value_without_place(*number) : input::value_without_place(value)) + "\n";
    }
    return text + thickness_comment();
  }

  std::string entry_name() const {
    const std::string name = name_.empty() ? std::filesystem::path(warp_files_.front()).stem().string() : name_;
    input::Diagnostics diagnostics;
    materials::check_id(name, {.file = "--name"}, diagnostics);
    diagnostics.throw_if_any();
    return name;
  }
  std::string tables() const {
    std::vector<std::string> names;
    for (const auto* files : {&warp_files_, &weft_files_})
      for (const std::string& file : *files) names.push_back(std::filesystem::path(file).filename().string());
    return input::joined(names);
  }

  /// A line with its formula. What the law does not read is an item of the library, and in a case no more than said.
  std::string sheet_text(const SheetLine& line, const std::string& key, const Spread& spread) const {
    std::string text = fmt::format("{} = {}", key, printed(line, spread, !for_case_));
    if (for_case_ && !reads(line)) text = "# " + text;
    const std::string specimens =
        spread.count > 1 ? fmt::format("; {} specimens, +- {:.2g}", spread.count, spread.deviation / line.si) : "";
    return fmt::format("{:<34}  # {}{}\n", text, materials::formula_of(line.symbol, places_), specimens);
  }

  std::string weft_text() const {
    if (weft_.tests.empty()) return {};
    std::string inside, comments, text;
    for (const SheetLine& line : sheet_lines()) {
      const auto all = values(line, true);
      if (!line.by_direction || all.empty()) continue;
      if (std::string(line.symbol) == "B") {
        text += sheet_text(line, "B_weft", materials::spread_of(all));
      } else if (reads(line) || (!for_case_ && law_ == "kes")) {
        inside += fmt::format("{}{} = {}", inside.empty() ? "" : ", ", line.symbol,
                              printed(line, materials::spread_of(all), !for_case_));
      } else {
        comments += fmt::format("# weft: {} = {}\n", line.symbol, printed(line, materials::spread_of(all), true));
      }
    }
    if (!inside.empty()) text += "weft = { " + inside + " }\n";
    return text + comments;
  }

  std::string curve_text() const {
    if (law_ != "curve" || warp_.tensile().empty()) return {};
    const auto warp = warp_.tensile(), weft = weft_.tensile();
    for (const auto* tests : {&warp, &weft})
      if (tests->size() > 1)
        throw input::InputError(
            (*tests)[1]->where, "a second tensile test of one direction",
            "law curve goes through the points of one: give one, or --law kes, which takes their means");
    std::string text =
        points_text("warp", *warp.front()) + points_text("weft", weft.empty() ? *warp.front() : *weft.front());
    const auto G = values({"G", "", 1.0, false, ""}, false);
    if (!G.empty()) text += fmt::format("shear = \"{:.6g} N/m\"\n", materials::spread_of(G).mean);
    return text;
  }

  std::string thickness_comment() const {
    const auto mean = [&](const char* symbol) -> std::optional<double> {
      const auto all = values({symbol, "", 1.0, false, ""}, false);
      return all.empty() ? std::nullopt : std::optional(materials::spread_of(all).mean);
    };
    const std::string text =
        thickness_text({.LC = mean("LC"), .WC = mean("WC"), .T0 = mean("T0"), .Tm = mean("Tm"), .Pm = mean("Pm")}, 0.0);
    return text.empty() ? text : "# " + text + "\n";
  }

  void tell_what_is_missing() const {
    const auto note = [this](const std::string& text) { console().note("note: " + text); };
    if (warp_.tensile().empty()) note("no tensile test: a case cannot use the entry before it has a law and its curve");
    const std::string shear = law_ == "kes" ? "G" : "shear";
    if (warp_.values.count("G") + weft_.values.count("G") == 0 && !has_further(shear))
      note(fmt::format("no test of shear: the law needs {}, e.g. --with \"{}\"", shear,
                       shear == "G" ? "G=0.7 gf/(cm degree)" : "shear=40 N/m"));
    if (!weft_files_.empty() && weft_.tensile().empty())
      note("no tensile test along the weft: it is taken to be the warp's");
  }

  std::vector<std::string> warp_files_, weft_files_, more_;
  std::string name_, source_, width_, gauge_, place_ = "0.5 1/cm", law_ = "kes", out_;
  bool for_case_ = false;
  materials::ReductionPlaces places_;
  Direction warp_, weft_;
};

}  // namespace

std::unique_ptr<Command> make_fit() { return std::make_unique<Fit>(); }

}  // namespace snug::app
