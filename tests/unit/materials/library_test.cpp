// The library as a store: what is put in comes out; parents, dimensions, history; hostile input; texts in and out.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "materials/database/evaluation.hpp"
#include "materials/database/exchange.hpp"
#include "materials/database/sha256.hpp"
#include "tests/unit/materials/library_under_test.hpp"

namespace snug::testing {
namespace {

namespace fs = std::filesystem;
using materials::Datum, materials::DatumType, materials::Entity, materials::Kind, materials::Library, materials::Stroke;
using ::testing::ElementsAre, ::testing::HasSubstr;

using LibraryStore = LibraryTest;

TEST_F(LibraryStore, WhatIsPutInComesOutAndIsThereForTheNext) {
  const Entity knit = fabric("my knit", R"toml(
weight = "215.0 g/m2"
LT = [{ value = "1.00 +- 0.11", source = "table 5.2" }, { value = "1.02", source = "table 7.1" }]
G = { value = "0.66 gf/(cm degree)", range = ["0.4 gf/(cm degree)", "0.9 gf/(cm degree)"] }
stiffness = { equation = "2*weight*c^2", unit = "N/m" }
c = { value = "", unit = "m/s" }
note = "a text; with 'quotes', \"others\" and 100 %"
)toml");
  {
    Library library = open_empty();
    add(library, knit);
  }
  const Entity found = open_empty().entity("my knit");
  EXPECT_TRUE(materials::same_values(found, knit));
  EXPECT_NEAR(*found.find("weight")->si, 0.215, 1e-16);
  EXPECT_EQ(found.find("LT")->uncertainty, "0.11");
  EXPECT_FALSE(found.find("stiffness")->si) << "its state variable is not given";
}

TEST_F(LibraryStore, ParentsAreOneStepUp) {
  Library library = open_empty();
  add(library, entity(Kind::garment, "shirt", ""));
  add(library, fabric("cloth", "parent = \"shirt\""));
  add(library, entity(Kind::yarn, "yarn", "parent = \"cloth\""));
  add(library, entity(Kind::fibre, "cotton", "parent = \"yarn\""));
  EXPECT_THAT(library.children("shirt"), ElementsAre("cloth"));
  EXPECT_THAT(error_of([&] { add(library, fabric("other", "parent = \"yarn\"")); }),
              HasSubstr("the parent yarn is a yarn; the parent of a fabric is a garment"));
  EXPECT_THAT(error_of([&] { add(library, fabric("other", "parent = \"nobody\"")); }),
              HasSubstr("no entity \"nobody\""));
  EXPECT_THAT(error_of([&] { library.change([](Stroke& stroke) { stroke.remove("cloth"); }); }),
              HasSubstr("is the parent of yarn"));
  EXPECT_THAT(error_of([&] { add(library, entity(Kind::tissue, "cotton", "")); }), HasSubstr("is the ID of a fibre"));
  EXPECT_EQ(library.count(), 4);
}

TEST_F(LibraryStore, OneItemHasOneDimensionEverywhere) {
  Library library = open_empty();
  EXPECT_THAT(error_of([&] { add(library, fabric("a", "weight = \"3 m\"")); }),
              HasSubstr("weight: \"3 m\" is of another dimension; write it with a unit that converts to kg/m2"));
  EXPECT_THAT(error_of([&] { add(library, fabric("a", "WT = \"10\"")); }), HasSubstr("has no unit"));
  EXPECT_THAT(error_of([&] { add(library, fabric("a", "LT = \"high\"")); }), HasSubstr("\"high\" is no number"));
  add(library, fabric("a", "pilling = \"3 1/cm2\""));
  EXPECT_THAT(error_of([&] { add(library, fabric("b", "pilling = \"3 1/cm\"")); }), HasSubstr("converts to"));
  add(library, fabric("b", "pilling = \"30000 1/m2\""));
  EXPECT_THAT(library.find_where("pilling = 3 1/cm2"), ElementsAre("a", "b")) << "a new item is at once searchable";
}

TEST_F(LibraryStore, AnItemThatNobodyHasAnyMoreMayBecomeSomethingElse) {
  // A slip in the unit of a new item is mended by the one who made it, not when others have the item.
  Library library = open_empty();
  add(library, fabric("a", "pilling = \"3 kg\""));
  add(library, fabric("a", "pilling = \"3 1/cm2\""));
  EXPECT_THAT(library.find_where("pilling > 2 1/cm2"), ElementsAre("a"));
  add(library, fabric("b", "pilling = \"4 1/cm2\""));
  EXPECT_THAT(error_of([&] { add(library, fabric("a", "pilling = \"3 kg\"")); }), HasSubstr("another dimension"));
  EXPECT_THAT(error_of([&] { add(library, fabric("c", "feel = [{ value = \"3 kg\" }, { value = \"3 m\" }]")); }),
              HasSubstr("another dimension"));
}

TEST_F(LibraryStore, EveryChangeHasItsHistoryAndIsUndone) {
  Library library = open_empty("first");
  add(library, fabric("a", "weight = \"100 g/m2\""));
  library.change([](Stroke& stroke) {
    Entity entity = stroke.entity("a");
    entity.data.front().value = "120";
    stroke.put(entity, "edited");
    stroke.put(fabric("b", "weight = \"5 g/m2\""), "added");
  });
  library.change([](Stroke& stroke) { stroke.remove("a"); });
  const auto history = library.history("a");
  ASSERT_EQ(history.size(), 3u);
  EXPECT_EQ(history[0].action, "removed");
  EXPECT_EQ(history[2].action, "added");
  EXPECT_EQ(history[1].who, "first");
  EXPECT_THAT(history[1].moment, ::testing::MatchesRegex("20..-..-..T..:..:......Z"));
  EXPECT_THAT(error_of([&] { open_empty("second").undo(); }), HasSubstr("the last change is by first"));
  library.undo();
  EXPECT_EQ(library.entity("a").find("weight")->value, "120");
  library.undo();  // both of the stroke
  EXPECT_EQ(library.entity("a").find("weight")->value, "100");
  EXPECT_FALSE(library.find("b"));
  library.undo();
  EXPECT_EQ(library.count(), 0);
  EXPECT_THAT(error_of([&] { library.undo(); }), HasSubstr("nothing to undo"));
}

TEST_F(LibraryStore, AStrokeThatFailsChangesNothing) {
  Library library = open_empty();
  EXPECT_THROW(library.change([](Stroke& stroke) {
    stroke.put(fabric("a", "softness = \"3 m\""), "added");
    stroke.put(fabric("b", "weight = \"3 m\""), "added");
  }),
               input::InputError);
  EXPECT_EQ(library.count(), 0);
  EXPECT_TRUE(library.history().empty());
  add(library, fabric("a", "softness = \"3 N\""));  // the item was not kept, either
  EXPECT_EQ(library.count(), 1);
}

TEST_F(LibraryStore, SqlInNamesAndValuesIsText) {
  // Names take no quotes and semicolons; texts do, and come back; questions bind what they hold.
  Library library = open_empty();
  const std::string attack = "x\"); DROP TABLE entity; --";
  add(library, fabric("kept", "weight = \"1 g/m2\""));
  EXPECT_THAT(error_of([&] { add(library, {.kind = Kind::fabric, .id = "x'); DROP TABLE datum;--"}); }),
              HasSubstr("cannot be a name"));
  EXPECT_THAT(
      error_of([&] { add(library, {.kind = Kind::fabric, .id = "ok", .data = {{.name = attack, .value = "1"}}}); }),
      HasSubstr("cannot be a name"));
  add(library, {.kind = Kind::fabric, .id = "ok", .parent = {}, .data = {{.name = "note", .value = attack}}});
  EXPECT_EQ(library.entity("ok").find("note")->value, attack);
  EXPECT_THAT(library.find_where("note ~ \"); DROP\""), ElementsAre("ok"));
  EXPECT_THAT(library.find_where("id = \"' OR 1=1 --\""), ElementsAre());
  EXPECT_THAT(library.find_where("note ~ \"%\""), ElementsAre()) << "a pattern of SQL is a text, too";
  EXPECT_FALSE(library.find(attack));
  EXPECT_EQ(library.count(), 2);
}

TEST_F(LibraryStore, HostileEntitiesAreRefused) {
  Library library = open_empty();
  const auto error = [&](Datum datum) {
    datum.name = datum.name.empty() ? "item" : datum.name;
    return error_of([&] { add(library, {.kind = Kind::fabric, .id = "hostile", .data = {datum}}); });
  };
  EXPECT_THAT(error({.name = "weight", .value = "nan", .unit = "g/m2"}), HasSubstr("no finite number"));
  EXPECT_THAT(error({.name = "weight", .value = "inf g/m2"}), HasSubstr("no finite number"));
  EXPECT_THAT(error({.name = "weight", .value = "1e400", .unit = "g/m2"}), HasSubstr("no finite number"));
  EXPECT_THAT(error({.name = "n", .value = "NaN"}), HasSubstr("no finite number"));
  EXPECT_THAT(error({.name = "n", .value = "1", .uncertainty = "-1"}), HasSubstr("below zero"));
  EXPECT_THAT(error({.name = "n", .value = "1", .low = "3", .high = "2"}), HasSubstr("smaller limit first"));
  EXPECT_THAT(error({.value = std::string(200'000, 'a')}), HasSubstr("at most 100000"));
  EXPECT_THAT(error({.value = "a\x01"}), HasSubstr("control character"));
  EXPECT_THAT(error({.value = "\xff\xfe"}), HasSubstr("no UTF-8"));
  EXPECT_THAT(error({.name = "t", .value = "20", .unit = "degC"}), HasSubstr("no unit"));
  EXPECT_THAT(error({.type = DatumType::equation, .value = std::string(1'000'000, '(')}), HasSubstr("at most 100000"));
  EXPECT_THAT(error({.type = DatumType::equation, .value = std::string(1'900, '(')}),
              HasSubstr("nested more than 50 deep"));
  EXPECT_THAT(error({.type = DatumType::equation, .value = std::string(1'900, '-') + "1"}),
              HasSubstr("nested more than 50 deep"));
  EXPECT_THAT(error({.type = DatumType::equation, .value = "item + 1"}), HasSubstr("needs itself"));
  EXPECT_THAT(error({.type = DatumType::equation, .value = "system(1)"}), HasSubstr("no function system"));
  EXPECT_THAT(error_of([&] { add(library, {.kind = Kind::fabric, .id = "rigid"}); }), HasSubstr("word of the cases"));
  EXPECT_EQ(library.count(), 0);
}

TEST_F(LibraryStore, EquationsThatNeedEachOtherAreRefused) {
  Library library = open_empty();
  EXPECT_THAT(
      error_of([&] {
        add(library,
            fabric("a", "x = { equation = \"y + 1\" }\ny = { equation = \"z + 1\" }\nz = { equation = \"x + 1\" }"));
      }),
      HasSubstr("one another in a chain"));
  std::string doubling("x0 = \"1\"\n");  // each needs the one before twice: 2^60 evaluations, were they not kept
  for (int n = 1; n <= 60; ++n) doubling += fmt::format("x{0} = {{ equation = \"x{1} + x{1}\" }}\n", n, n - 1);
  add(library, fabric("b", doubling));
  EXPECT_EQ(*library.entity("b").find("x60")->si, std::pow(2.0, 60));
}

TEST_F(LibraryStore, FilesAreKeptByTheirContentAndLargeOnesRefused) {
  std::ofstream(folder_ / "curve.csv") << "strain [%],force [N]\n0,0\n1,2\n";
  std::ofstream(folder_ / "photo.png") << "\x89PNG";
  std::ofstream(folder_ / "a.toml")
      << "[fabric.a]\n\"tensile curve\" = { table = \"curve.csv\" }\npicture = { figure = \"photo.png\" }\n";
  Library library = open_empty();
  const auto entries = materials::read_entries(folder_ / "a.toml", Kind::fabric, library.units());
  library.change([&](Stroke& stroke) {
    for (const auto& file : entries.files) stroke.keep(file);
    for (const auto& entity : entries.entities) stroke.put(entity, "imported");
  });
  const Entity found = library.entity("a");
  EXPECT_EQ(library.file(found.find("picture")->value).content, "\x89PNG");
  EXPECT_EQ(library.file(found.find("picture")->value).name, "photo.png");
  EXPECT_EQ(found.find("tensile curve")->value, materials::sha256("strain [%],force [N]\n0,0\n1,2\n"));
  const auto error_with = [&](const std::string& name) {
    std::ofstream(folder_ / "a.toml") << "[fabric.b]\npicture = { figure = \"" + name + "\" }\n";
    return error_of([&] { materials::read_entries(folder_ / "a.toml", Kind::fabric, library.units()); });
  };
  std::ofstream(folder_ / "large.png") << "";
  fs::resize_file(folder_ / "large.png", std::uintmax_t{1} << 30);  // 1 GB, sparse
  EXPECT_THAT(error_with("large.png"), HasSubstr("1073741824 bytes, at most 16777216"));
  EXPECT_THAT(error_with("/etc/passwd"), HasSubstr("not in the folder"));
  EXPECT_THAT(error_with("../x"), HasSubstr("not in the folder"));
  EXPECT_THAT(error_with("none.png"), HasSubstr("no such file"));
}

TEST_F(LibraryStore, ExportAndImportGiveTheSame) {
  // By each of the three forms: all that ships and one entity with everything.
  Library library = open();
  add(library, fabric("all of it", R"toml(
parent = "001"
weight = "215.0 g/m2"
LT = [{ value = "1.00 +- 0.11", source = "a, \"b\"" }, { value = "1.02", source = "table 7.1", range = ["0.9", "1.1"] }]
c = { value = "", unit = "m/s", symbol = "c'" }
d = { equation = "weight*c'^2", unit = "N/m", symbol = "D" }
"number of my own" = "007.50"
note = "# no comment, \\ \"quoted\""
weft = { LT = "1.1", WT = "3 J/m2" }
)toml"));
  for (const char* ending : {".toml", ".json", ".csv"}) {
    const fs::path file = folder_ / (std::string("out") + ending);
    std::vector<Entity> all;
    for (const std::string& id : library.ids()) all.push_back(library.entity(id));
    materials::write_entries(all, library, file);
    const auto entries = materials::read_entries(file, Kind::fabric, library.units());
    ASSERT_EQ(entries.entities.size(), all.size()) << ending;
    for (const Entity& entity : entries.entities)
      EXPECT_TRUE(materials::same_values(entity, library.entity(entity.id))) << ending << " " << entity.id;
  }
}

TEST_F(LibraryStore, ATableOfOneRowAnEntityIsRead) {
  std::ofstream(folder_ / "mill.csv") << "id,weight [g/m2],thickness [mm],LT,composition,fabric "
                                         "type\nA1,180,0.5,0.9,100% cotton,knitted\nA2,\"200 +- 3\",,1.1,,woven\n";
  materials::UnitBook units;
  const auto entries = materials::read_entries(folder_ / "mill.csv", Kind::fabric, units);
  ASSERT_EQ(entries.entities.size(), 2u);
  EXPECT_NEAR(*entries.entities[0].find("weight")->si, 0.18, 1e-16);
  EXPECT_EQ(entries.entities[0].find("composition")->value, "100% cotton");
  EXPECT_EQ(entries.entities[1].find("weight")->uncertainty, "3");
  EXPECT_EQ(entries.entities[1].find("thickness"), nullptr);
  std::ofstream(folder_ / "two.csv") << "id,parent,item,value\na,x,weight,1 g/m2\na,y,LT,1\n";
  EXPECT_THAT(error_of([&] { materials::read_entries(folder_ / "two.csv", Kind::fabric, units); }),
              HasSubstr("two.csv:3:1: error: a has another kind or parent above"));
  std::ofstream(folder_ / "bad.csv") << "id,weight [gram]\nA1,a lot\n";
  EXPECT_THAT(error_of([&] { materials::read_entries(folder_ / "bad.csv", Kind::fabric, units); }),
              HasSubstr("bad.csv:2:1: error: weight: \"a lot\" is no finite number"));
}

TEST(Sha256, KnownDigests) {
  // FIPS 180-4, examples of one block, two blocks and none.
  EXPECT_EQ(materials::sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(materials::sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(materials::sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(materials::sha256(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

}  // namespace
}  // namespace snug::testing
