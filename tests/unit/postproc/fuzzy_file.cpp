#include "postproc/comfort/fuzzy_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "postproc/comfort/comfort.hpp"
#include "postproc/comfort/fuzzy_rule.hpp"
#include "postproc/comfort/shipped_data.hpp"

namespace snug::postproc {
namespace {

const std::vector<std::string> nine = {"Chest",       "Front waist", "Front thigh", "Side lats", "Side waist",
                                       "Side pelvis", "Side thigh",  "Back waist",  "Back thigh"};

FuzzySystem shipped(const std::string& name) {
  input::MaterialEntry reference;
  reference.name = name;
  return load_fuzzy(reference, {});
}

/// The text without its comment lines.
std::string bare(std::string_view text, char comment) {
  std::istringstream lines{std::string(text)};
  std::string rest;
  for (std::string line; std::getline(lines, line);)
    if (line.empty() || line[0] != comment) rest += line + "\n";
  return rest;
}

TEST(FuzzyFile, TheShippedSystemIsTheOneOfTheSource) {
  // Nine inputs with five terms on [0, 4], one output with three terms on [0, 4], the rules of table 5.4; the rules
  // that the program makes for the nine locations are the ones of the file.
  const FuzzySystem system = shipped("wear trial 2002");
  ASSERT_EQ(system.inputs.size(), 9u);
  for (const FuzzyVariable& input : system.inputs) {
    EXPECT_EQ(input.terms.size(), 5u);
    EXPECT_EQ(input.low, 0.0);
    EXPECT_EQ(input.high, 4.0);
  }
  EXPECT_EQ(system.inputs[1].name, "Front_waist");
  EXPECT_EQ(system.output.terms.size(), 3u);
  EXPECT_EQ(system.output.high, 4.0);
  EXPECT_EQ(system.rules.size(), 11u);
  EXPECT_EQ(comfort_system(nine), system);
}

TEST(FuzzyFile, ShippedFilesAreWhatTheProgramWrites) {
  // FLL as it stands; FIS made of it with the maximum for "or": 27 + 1 + 512 rules of single terms.
  FuzzySystem system = shipped("wear trial 2002");
  EXPECT_EQ(fll_text(system), bare(shipped_text("wear_trial_2002.fll"), '#'));
  system.disjunction = "Maximum";
  system.name = "wear trial 2002, single terms";
  EXPECT_EQ(fis_text(system), bare(shipped_text("wear_trial_2002.fis"), '%'));
  EXPECT_EQ(shipped("wear trial 2002, single terms").rules.size(), 540u);
}

TEST(FuzzyFile, SplittingIntoSingleTermsDoesNotChangeTheAnswer) {
  // With minimum and maximum the 540 rules of the FIS file answer as the 11 rules that they came from.
  FuzzySystem few = shipped("wear trial 2002");
  few.disjunction = "Maximum";
  FuzzyEngine grouped(few), single(shipped("wear trial 2002, single terms"));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> rating(0.0, 4.0);
  for (int trial = 0; trial < 30; ++trial) {
    std::vector<double> values;
    for (int i = 0; i < 9; ++i) values.push_back(std::min(rating(random), rating(random)));
    EXPECT_DOUBLE_EQ(grouped.score(values), single.score(values));
  }
}

FuzzySystem uneven() {
  FuzzySystem system;
  system.name = "uneven numbers";
  system.inputs = {{"p", -1.0 / 3, 5.7, {bell("low", 1e-7, 1.0 / 3, 2.5), {"mid", "Triangle", {0.1, 0.7, 1e5}}}},
                   {"s_2", 0, 1, {{"g", "Gaussian", {0.123456789012345678, 1e-3}}, {"t", "Trapezoid", {0, 1, 2, 3}}}}};
  system.output = {"y", 0, 10, {bell("bad", 0, 2.5, 2), bell("good", 10, 0.1, 1.0 / 7)}};
  system.rules = {"if p is low and s_2 is not g then y is good", "if p is mid or s_2 is t then y is bad with 0.3"};
  system.conjunction = "AlgebraicProduct";
  system.aggregation = "AlgebraicSum";
  return system;
}

TEST(FuzzyFile, BothFormatsReadBackWhatWasWritten) {
  // Every number comes back to the last bit, other shapes, norms, "not" and weights included.
  EXPECT_EQ(read_fuzzy_text(fll_text(uneven()), FuzzyFormat::fll, "a.fll"), uneven());
  EXPECT_EQ(read_fuzzy_text(fis_text(uneven()), FuzzyFormat::fis, "a.fis"), uneven());
}

TEST(FuzzyFile, WhatFisCannotHoldIsRefused) {
  // Splitting under the bounded sum would change the answer: no file is better than a wrong one.
  EXPECT_THROW(fis_text(shipped("wear trial 2002")), std::invalid_argument);
  FuzzySystem hedged = uneven();
  hedged.rules[0] = "if p is very low then y is bad";
  EXPECT_THROW(fis_text(hedged), std::invalid_argument);
}

TEST(FuzzyFile, WrongFilesAreErrorsWithTheirLine) {
  // An unknown term in a rule, a wrong norm, a number that is none and plain rubbish name the file, and the line where
  // the parser tells it.
  const std::string good = fll_text(uneven());
  const auto error = [](const std::string& text, FuzzyFormat format) -> std::string {
    try {
      read_fuzzy_text(text, format, "my.file");
    } catch (const input::InputError& fault) {
      return fault.what();
    }
    return "accepted";
  };
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_NE(error(replaced("p is mid", "p is huge"), FuzzyFormat::fll).find("my.file:31:1"), std::string::npos)
      << error(replaced("p is mid", "p is huge"), FuzzyFormat::fll);
  EXPECT_NE(error(replaced("AlgebraicSum", "Nothing"), FuzzyFormat::fll).find("my.file"), std::string::npos);
  EXPECT_NE(error(replaced("Centroid 1001", "Bisector 100"), FuzzyFormat::fll).find("centroid"), std::string::npos);
  EXPECT_NE(error("rubbish", FuzzyFormat::fll).find("my.file"), std::string::npos);
  EXPECT_NE(error("rubbish", FuzzyFormat::fis).find("my.file"), std::string::npos);
  EXPECT_NE(error("", FuzzyFormat::fis).find("my.file"), std::string::npos);
  std::string fis = fis_text(uneven());
  fis.replace(fis.find("[2.5 2 0]"), 9, "[2.5 x 0]");
  EXPECT_NE(error(fis, FuzzyFormat::fis).find("my.file"), std::string::npos);
}

TEST(FuzzyFile, RubbishNeverCrashesTheReaders) {
  // A thousand files with random bytes changed, cut off or doubled are read or refused as wrong input.
  std::mt19937 random(11);
  const std::string texts[2] = {fll_text(uneven()), fis_text(uneven())};
  int refused = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::string text = texts[trial % 2];
    for (int change = 0; change < 3; ++change) {
      const std::size_t at = random() % text.size();
      if (random() % 3 == 0)
        text.erase(at, random() % 20);
      else if (random() % 2 == 0)
        text[at] = static_cast<char>(random() % 256);
      else
        text.insert(at, text.substr(random() % text.size(), random() % 30));
    }
    try {
      read_fuzzy_text(text, trial % 2 ? FuzzyFormat::fis : FuzzyFormat::fll, "rubbish");
    } catch (const input::InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(FuzzyRule, TextTreeAndText) {
  // A rule read and written again is the same; "and" binds tighter than "or".
  for (const std::string text : {"if a is b then y is z", "if (a is b or c is d) and e is not f then y is z with 0.25",
                                 "if (a is b and c is d) or e is very very f then y is z"})
    EXPECT_EQ(text_of(parse_rule(text)), text);
  EXPECT_EQ(text_of(parse_rule("if a is b and c is d or e is f then y is z")),
            "if (a is b and c is d) or e is f then y is z");
  for (const std::string wrong :
       {"", "if", "if a then y is z", "if a is b y is z", "if (a is b then y is z", "if a is b then y is z with",
        "if a is b then y is z with x", "if a is b then y is z z"})
    EXPECT_THROW(parse_rule(wrong), std::invalid_argument) << wrong;
}

TEST(FuzzyRule, MissingInputsDropOutOfTheRules) {
  // Of "all nine are comfortable" the present ones are left; rules on missing inputs alone go.
  const FuzzySystem three = restricted(shipped("wear trial 2002"), {2, 6, 8});
  EXPECT_EQ(three, [] {
    FuzzySystem made = comfort_system({"Front thigh", "Side thigh", "Back thigh"});
    return made;
  }());
}

TEST(FuzzyRule, RulesAreSaidInWords) {
  // A rule over all inputs is said of "every location", alternatives of one location as a list.
  const FuzzySystem system = shipped("wear trial 2002");
  EXPECT_EQ(in_words(parse_rule(system.rules[1]), system),
            "if Front waist is uncomfortable, very uncomfortable or extremely uncomfortable then the garment is "
            "uncomfortable");
  EXPECT_EQ(in_words(parse_rule(system.rules[10]), system),
            "if every location is neutral or comfortable then the garment is acceptable");
}

}  // namespace
}  // namespace snug::postproc
