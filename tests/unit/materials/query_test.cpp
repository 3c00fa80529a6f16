// The language of questions, asked of a small library.
#include <gmock/gmock.h>

#include "tests/unit/materials/library_under_test.hpp"

namespace snug::testing {
namespace {

using materials::Kind, materials::Library;
using ::testing::ElementsAre, ::testing::HasSubstr;

class Question : public LibraryTest {
 protected:
  void SetUp() override {
    LibraryTest::SetUp();
    library_ = std::make_unique<Library>(open_empty());
    add(*library_, entity(Kind::garment, "shirt", "\"commercial name\" = \"Levi's 50% off\""));
    add(*library_,
        fabric("light", "weight = \"100 g/m2\"\nEMT = \"40 %\"\ncomposition = \"100% Cotton\"\nparent = \"shirt\""));
    add(*library_, fabric("middle",
                          "weight = [{ value = \"200 g/m2\" }, { value = \"50 g/m2\" }]\nEMT = \"20 %\"\ncomposition = "
                          "\"88% polyester & 12% spandex\""));
    add(*library_, fabric("heavy", "weight = \"0.4 kg/m2\"\n\"my own number\" = \"7\""));
  }
  std::vector<std::string> ask(const std::string& question) const { return library_->find_where(question); }
  std::string refused(const std::string& question) const {
    return error_of([&] { ask(question); });
  }
  std::unique_ptr<Library> library_;
};

TEST_F(Question, ComparisonsConvertUnits) {
  EXPECT_THAT(ask("weight < 250 g/m2"), ElementsAre("light", "middle"));
  EXPECT_THAT(ask("weight <= 0.2 kg/m2"), ElementsAre("light", "middle"));
  EXPECT_THAT(ask("weight = 0.1 kg/m2"), ElementsAre("light"));
  EXPECT_THAT(ask("weight != 0.1 kg/m2"), ElementsAre("middle", "heavy"));
  EXPECT_THAT(ask("EMT > 0.3"), ElementsAre("light"));
  EXPECT_THAT(ask("EMT > 30 %"), ElementsAre("light"));
  EXPECT_THAT(ask("weight < 60 g/m2"), ElementsAre()) << "the first datum of an item counts";
}

TEST_F(Question, AndOrNotAndParentheses) {
  EXPECT_THAT(ask("weight > 150 g/m2 and EMT < 30 % or weight < 150 g/m2"), ElementsAre("light", "middle"));
  EXPECT_THAT(ask("weight > 150 g/m2 and (EMT < 30 % or weight > 300 g/m2)"), ElementsAre("middle", "heavy"));
  EXPECT_THAT(ask("not weight > 150 g/m2 and kind = fabric"), ElementsAre("light"));
  EXPECT_THAT(ask("not (has weight)"), ElementsAre("shirt"));
  EXPECT_THAT(ask("has EMT"), ElementsAre("light", "middle"));
  EXPECT_THAT(ask("(weight>0 kg/(m2))and(weight<9 kg/m2)"), ElementsAre("light", "middle", "heavy"));
}

TEST_F(Question, TextsAndTheEntityItself) {
  EXPECT_THAT(ask("composition ~ cotton"), ElementsAre("light"));
  EXPECT_THAT(ask("composition ~ \"12% SPANDEX\""), ElementsAre("middle"));
  EXPECT_THAT(ask("composition ~ \"1_0\""), ElementsAre()) << "patterns of SQL are texts";
  EXPECT_THAT(ask("\"commercial name\" = \"Levi's 50% off\""), ElementsAre("shirt"));
  EXPECT_THAT(ask("parent = shirt"), ElementsAre("light"));
  EXPECT_THAT(ask("id ~ h"), ElementsAre("shirt", "light", "heavy"));
  EXPECT_THAT(ask("\"my own number\" = 7"), ElementsAre("heavy"));
  EXPECT_THAT(library_->find_where("id ~ i", Kind::garment), ElementsAre("shirt"));
}

TEST_F(Question, WhatIsNoQuestionIsRefusedWithItsPlaceAndRemedy) {
  EXPECT_THAT(refused("wieght < 3 g/m2"),
              HasSubstr("question:1:1: error: no entity has the item \"wieght\"; did you mean weight?"));
  EXPECT_THAT(refused("weight < 3"), HasSubstr("question:1:10: error: \"3\" has no unit, weight comes in kg/m2"));
  EXPECT_THAT(refused("weight < 3 m"), HasSubstr("is of another dimension"));
  EXPECT_THAT(refused("weight < light"), HasSubstr("no number with a unit"));
  EXPECT_THAT(refused("weight ~ 3 g/m2"), HasSubstr("weight is a number"));
  EXPECT_THAT(refused("composition < 3"), HasSubstr("composition is a text"));
  EXPECT_THAT(refused("weight"), HasSubstr("no comparison behind the item"));
  EXPECT_THAT(refused("weight < "), HasSubstr("nothing to compare with"));
  EXPECT_THAT(refused("weight < 3 g/m2 and"), HasSubstr("ends where an item should stand"));
  EXPECT_THAT(refused("(weight < 3 g/m2"), HasSubstr("a ) is missing"));
  EXPECT_THAT(refused("weight < 3 g/m2)"), HasSubstr("where the question should end"));
  EXPECT_THAT(refused("composition = \"open"), HasSubstr("quote is not closed"));
  EXPECT_THAT(refused(""), HasSubstr("ends where an item should stand"));
  EXPECT_THAT(refused("weight < 1 g/m2; DROP TABLE entity"), HasSubstr("no number with a unit"));
  EXPECT_THAT(refused(std::string(3000, '(')), HasSubstr("nested more than 50 deep"));
  EXPECT_THAT(refused(std::string(5000, 'a')), HasSubstr("a question of 5000 characters"));
  std::string many = "has weight";
  for (int n = 0; n < 200; ++n) many += " or has EMT";
  EXPECT_THAT(refused(many), HasSubstr("more than 100 comparisons"));
}

}  // namespace
}  // namespace snug::testing
