// The engineering database as a store: many writers, kills, earlier schemas, damage, hostile input.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <ctime>
#include <random>
#include <thread>

#include "materials/database/evaluation.hpp"
#include "materials/database/exchange.hpp"
#include "materials/database/schema.hpp"
#include "materials/database/sha256.hpp"
#include "tests/unit/materials/library_under_test.hpp"

namespace snug::testing {
namespace {

namespace fs = std::filesystem;
using materials::Datum, materials::DatumType, materials::Entity, materials::Kind, materials::Library, materials::Stroke;
using ::testing::ElementsAre, ::testing::HasSubstr;

class LibraryStore : public LibraryTest {
 protected:
  /// Runs `work` in a process of its own, which ends without a word; returns its ID.
  static pid_t process(const std::function<void()>& work) {
    const pid_t child = ::fork();
    if (child != 0) return child;
    try {
      work();
    } catch (...) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  static int status_of(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return status;
  }
  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void put_bytes(const std::string& content) const { std::ofstream(file_, std::ios::binary) << content; }
};

#ifdef NDEBUG
constexpr bool optimised = true;
#else
constexpr bool optimised = false;  // with asserts or sanitizers the times say nothing
#endif
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

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

TEST_F(LibraryStore, AHundredThousandEntitiesAreWrittenAndAskedFast) {
  // 20,000 entities a second in one stroke, and a question by an index in 50 ms: time of the processor, so that
  // neighbours do not matter.
  Library library = open_empty();
  std::vector<Entity> entities;
  for (int n = 0; n < 100'000; ++n)
    entities.push_back(
        {.kind = Kind::fabric,
         .id = "fabric " + std::to_string(n),
         .data = {{.name = "weight", .value = std::to_string(100 + n % 400) + "." + std::to_string(n), .unit = "g/m2"},
                  {.name = "thickness", .value = "0." + std::to_string(10 + n % 90), .unit = "mm"},
                  {.name = "LT", .value = "0.9", .uncertainty = "0.1"}}});
  double start = cpu_seconds();
  library.change([&](Stroke& stroke) {
    for (const Entity& one : entities) stroke.put(one, "added");
  });
  const double writing = cpu_seconds() - start;
  EXPECT_EQ(library.count(), 100'000);
  EXPECT_LT(writing, optimised ? 5.0 : 60.0);
  start = cpu_seconds();
  const auto found = library.find_where("weight < 100.5 g/m2 and thickness > 0.5 mm");
  const double asking = cpu_seconds() - start;
  EXPECT_GT(found.size(), 1u);
  EXPECT_LT(found.size(), 250u);
  EXPECT_LT(asking, optimised ? 0.05 : 1.0);
  start = cpu_seconds();
  EXPECT_TRUE(library.find("fabric 77777"));
  EXPECT_LT(cpu_seconds() - start, optimised ? 0.05 : 1.0);
  std::printf("[ measured ] %.0f entities a second, a question %.1f ms\n", 1e5 / writing, 1e3 * asking);
}

TEST_F(LibraryStore, EightProcessesWritingLoseNothing) {
  // Each makes the file when it is not there, adds 25 entities, and counts up one number that all share.
  std::vector<pid_t> children;
  for (int p = 0; p < 8; ++p)
    children.push_back(process([&] {
      Library library = open_empty("process " + std::to_string(p));
      for (int n = 0; n < 25; ++n)
        library.change([&](Stroke& stroke) {
          const auto common = library.find("common");
          const int count = common ? std::stoi(common->find("count of all")->value) : 0;
          stroke.put(fabric("common", "\"count of all\" = \"" + std::to_string(count + 1) + "\""), "counted");
          stroke.put(fabric(std::to_string(p) + " " + std::to_string(n), "weight = \"100 g/m2\""), "added");
        });
    }));
  for (const pid_t child : children) EXPECT_EQ(status_of(child), 0);
  const Library library = open_empty();
  EXPECT_EQ(library.count(), 201);
  EXPECT_EQ(library.entity("common").find("count of all")->value, "200");
  EXPECT_EQ(library.history({}, 1000).size(), 400u);
  library.check_file();
}

TEST_F(LibraryStore, AKillInTheMiddleOfAWriteLeavesASoundFile) {
  // Pairs are written in one stroke each; whenever the writer is killed, both of a pair are there or none, and all that
  // was told as done is.
  std::mt19937 random(7);
  open_empty();
  for (int round = 0; round < 12; ++round) {
    int done[2];
    ASSERT_EQ(::pipe(done), 0);
    const pid_t child = process([&] {
      Library library = open_empty();
      for (int n = 0; n < 100'000; ++n) {
        const std::string id = std::to_string(round) + " " + std::to_string(n);
        library.change([&](Stroke& stroke) {
          stroke.put(fabric(id + " a", "weight = \"100 g/m2\""), "added");
          stroke.put(fabric(id + " b", "weight = \"100 g/m2\""), "added");
        });
        if (::write(done[1], "x", 1) != 1) return;
      }
    });
    ::close(done[1]);
    std::this_thread::sleep_for(std::chrono::milliseconds(20 + random() % 120));
    ::kill(child, SIGKILL);
    status_of(child);
    std::size_t told = 0;
    for (char c; ::read(done[0], &c, 1) == 1;) ++told;
    ::close(done[0]);
    const Library library = open_empty();
    library.check_file();
    std::size_t there = 0;
    for (std::size_t n = 0; library.find(std::to_string(round) + " " + std::to_string(n) + " a"); ++n, ++there)
      EXPECT_TRUE(library.find(std::to_string(round) + " " + std::to_string(n) + " b"));
    EXPECT_GE(there, told);
    EXPECT_EQ(library.count() % 2, 0);
  }
}

TEST_F(LibraryStore, AnEarlierSchemaIsMigratedWithABackup) {
  // Schema 1 had no history and no files. What stood in it stands there after the migration, and the copy beside it is
  // as it was.
  {
    materials::sql::Connection connection(file_, materials::sql::Connection::Open::or_new);
    materials::sql::bring_up_to_date(connection, 1);
    connection.execute(
        "INSERT INTO item VALUES ('weight', 'kg/m2'); INSERT INTO entity VALUES (1, 'old', 'fabric', NULL, 0);"
        "INSERT INTO datum VALUES (1, 0, 'weight', 1, 0, 'value', NULL, '150', 'g/m2', NULL, NULL, NULL, NULL, 0.15)");
  }
  {
    Library library = open_empty();
    EXPECT_EQ(library.entity("old").find("weight")->value, "150");
    EXPECT_THAT(library.find_where("weight = 150 g/m2"), ElementsAre("old"));
    add(library, fabric("new", "weight = \"1 g/m2\""));
  }
  const fs::path backup = file_.string() + ".schema-1.backup";
  ASSERT_TRUE(fs::exists(backup));
  const materials::sql::Connection copy(backup, materials::sql::Connection::Open::existing);
  EXPECT_EQ(copy.integer("PRAGMA user_version"), 1);
  EXPECT_EQ(copy.integer("SELECT count(*) FROM entity"), 1);
  const materials::sql::Connection now(file_, materials::sql::Connection::Open::existing);
  EXPECT_EQ(now.integer("PRAGMA user_version"), materials::sql::schema_version());
}

TEST_F(LibraryStore, ALaterSchemaAndAnotherProgramsFileAreRefusedAndLeft) {
  open_empty();
  {
    materials::sql::Connection connection(file_, materials::sql::Connection::Open::existing);
    connection.execute("PRAGMA user_version = 99");
  }
  const std::string before = bytes();
  EXPECT_THAT(error_of([&] { open_empty(); }), HasSubstr("made by a later snug (schema 99"));
  EXPECT_EQ(bytes(), before);
  fs::remove(file_);
  {
    materials::sql::Connection other(file_, materials::sql::Connection::Open::or_new);
    other.execute("CREATE TABLE mine (x); INSERT INTO mine VALUES (1)");
  }
  const std::string theirs = bytes();
  EXPECT_THAT(error_of([&] { open_empty(); }), HasSubstr("database of another program"));
  EXPECT_EQ(bytes(), theirs);
}

TEST_F(LibraryStore, ADamagedFileIsRefusedAndNotTouched) {
  {
    Library library = open();
    add(library, fabric("a", "weight = \"100 g/m2\""));
  }
  const std::string whole = bytes();
  const auto refused = [&](const std::string& content) {
    put_bytes(content);
    const std::string error = error_of([&] {
      const Library library = open();
      library.check_file();
    });
    EXPECT_EQ(bytes(), content) << "the file is left as it is";
    return error;
  };
  EXPECT_THAT(refused("no database at all, a text of some length that is longer than a header of a hundred bytes, so "
                      "that it is looked at"),
              HasSubstr("no library of snug, or a damaged one"));
  EXPECT_THAT(refused(whole.substr(0, whole.size() / 2)), HasSubstr("damaged"));
  std::string zeros = whole;
  std::fill(zeros.begin() + 4096, zeros.begin() + 3 * 4096, '\0');
  EXPECT_THAT(refused(zeros), HasSubstr("damaged"));
  std::mt19937 random(3);
  std::string noise = whole;
  for (std::size_t at = 4096; at < noise.size(); ++at) noise[at] = static_cast<char>(random());
  EXPECT_THAT(refused(noise), HasSubstr("damaged"));
  put_bytes(whole);
  EXPECT_EQ(open().entity("a").find("weight")->value, "100");
}

TEST_F(LibraryStore, WhatIsNoFileIsRefused) {
  fs::create_directory(file_);
  EXPECT_THAT(error_of([&] { open_empty(); }), HasSubstr("is a directory"));
  fs::remove(file_);
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  EXPECT_THAT(error_of([&] { open_empty(); }), HasSubstr("a pipe or a device"));
  fs::remove(file_);
  put_bytes("");
  EXPECT_EQ(open_empty().count(), 0) << "an empty file is a library that was about to be made";
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
