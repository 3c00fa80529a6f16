// Runs in the file of the library.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>

#include "materials/database/runs.hpp"
#include "materials/database/schema.hpp"
#include "materials/database/sha256.hpp"
#include "tests/unit/materials/library_under_test.hpp"

namespace snug::testing {
namespace {

using materials::Library, materials::LibraryFile, materials::RunRecord, materials::Runs;
using ::testing::ElementsAre, ::testing::HasSubstr;

LibraryFile text_file(const std::string& name, const std::string& content) {
  return {.hash = materials::sha256(content), .name = "run:" + name, .content = content};
}

class RunsTest : public LibraryTest {
 protected:
  /// A run of a project whose echo is `echo`.
  static std::int64_t record(Library& library, const std::string& project, const std::string& echo, const std::string& status = "converged") {
    const LibraryFile file = text_file("case.echo.toml", echo), input = text_file("case.toml", "# " + echo);
    RunRecord run{.project = project, .title = "a title", .directory = "/cases/" + project, .place = "/cases/out", .proof = "p", .case_hash = "c",
                  .echo = file.hash, .command = "snug run", .status = status, .message = {}, .note = "first try", .seconds = 1.5};
    run.inputs = {{.name = "case.toml", .value = input.hash, .unit = "bytes", .number = 7.0}};
    run.versions = {{.name = "snug", .value = "0.1"}};
    run.settings = {{.name = "garment.fabric.WT", .value = "9.8 J/m2", .unit = "J/m2", .number = 9.8}, {.name = "garment.name", .value = "sleeve"}};
    run.results = {{.name = "Front thigh", .value = "244.5", .unit = "Pa", .number = 244.5}, {.name = "comfort", .value = "1.4", .number = 1.4}};
    return Runs(library).record(run, {file, input});
  }
};

TEST_F(RunsTest, WhatWasRecordedComesBackAsItWas) {
  Library library = open_empty("anna");
  const auto number = record(library, "tights", "a = 1");
  const RunRecord run = Runs(library).run(number);
  EXPECT_EQ(run.project, "tights");
  EXPECT_EQ(run.who, "anna");
  EXPECT_EQ(run.moment.size(), 24u);
  EXPECT_EQ(run.note, "first try");
  EXPECT_EQ(run.seconds, 1.5);
  EXPECT_EQ(run.setting("garment.fabric.WT")->number, 9.8);
  EXPECT_EQ(run.setting("garment.name")->number, std::nullopt);
  EXPECT_EQ(run.result("Front thigh")->unit, "Pa");
  EXPECT_EQ(run.result("Back thigh"), nullptr);
  EXPECT_EQ(library.file(run.echo).content, "a = 1");
  EXPECT_THAT(run.inputs, ElementsAre(materials::RunValue{.name = "case.toml", .value = materials::sha256("# a = 1"), .unit = "bytes", .number = 7.0}));
}

TEST_F(RunsTest, ProjectsAreTheNamesOfTheirRuns) {
  // Counts are those of the runs; the project with the last run comes first; a name that is none is refused with the nearest.
  Library library = open_empty();
  record(library, "tights", "1"), record(library, "vest", "2"), record(library, "tights", "3", "partial");
  const auto projects = Runs(library).projects();
  ASSERT_EQ(projects.size(), 2u);
  EXPECT_EQ(projects[0].name, "tights");
  EXPECT_EQ(projects[0].runs, 2);
  EXPECT_EQ(projects[0].converged, 1);
  EXPECT_EQ(Runs(library).heads("tights").size(), 2u);
  EXPECT_EQ(Runs(library).heads({}, 2).front().number, 2) << "the newest two, the older of them first";
  EXPECT_THAT(error_of([&] { Runs(library).check_project("tihgts"); }), HasSubstr("did you mean tights?"));
  EXPECT_THAT(error_of([&] { Runs(library).run(99); }), HasSubstr("there is no run 99"));
}

TEST_F(RunsTest, NotesDecisionsAndDescent) {
  Library library = open_empty("anna");
  const auto first = record(library, "tights", "1");
  Runs runs(library);
  runs.note(first, "too tight");
  EXPECT_EQ(runs.run(first).note, "too tight");
  runs.derive("/cases/looser", first);
  EXPECT_EQ(runs.parent_of("/cases/looser"), first);
  EXPECT_EQ(runs.parent_of("/cases/other"), std::nullopt);
  runs.decide("tights", first, "softest");
  EXPECT_EQ(runs.decision("tights")->why, "softest");
  EXPECT_EQ(runs.decision("tights")->who, "anna");
  const auto other = record(library, "vest", "2");
  EXPECT_THAT(error_of([&] { runs.decide("tights", other, ""); }), HasSubstr("one of the project \"vest\""));
  EXPECT_THAT(error_of([&] { runs.note(first, std::string("a\0b", 3)); }), HasSubstr("control character"));
  runs.note(first, "'); DROP TABLE run; --");
  EXPECT_EQ(runs.run(first).note, "'); DROP TABLE run; --");
}

TEST_F(RunsTest, WhatIsForgottenTakesItsTextsAlongAndNobodyElses) {
  // Two runs share an echo: it stays until the second is forgotten. A file that a datum refers to stays in any case.
  Library library = open_empty();
  const auto a = record(library, "tights", "same"), b = record(library, "tights", "same");
  Runs runs(library);
  const std::string echo = runs.run(a).echo;
  library.change([&](materials::Stroke& stroke) {
    const LibraryFile table = text_file("shared", "of a datum and of a run");
    stroke.keep(table);
    materials::Entity one = fabric("knit", "weight = \"1 g/m2\"");
    one.data.push_back({.name = "curve", .type = materials::DatumType::table, .value = table.hash});
    stroke.put(one, "added");
  });
  runs.decide("tights", a, "");
  runs.forget({a});
  EXPECT_EQ(library.file(echo).content, "same");
  EXPECT_FALSE(runs.decision("tights"));
  EXPECT_THAT(error_of([&] { runs.forget({b, 77}); }), HasSubstr("no run 77"));
  EXPECT_EQ(runs.run(b).number, b) << "all or none";
  runs.forget({b});
  EXPECT_THAT(error_of([&] { library.file(echo); }), HasSubstr("no file of the hash"));
  EXPECT_EQ(library.file(materials::sha256("of a datum and of a run")).content, "of a datum and of a run");
  EXPECT_GT(record(library, "tights", "again"), b) << "numbers are not given twice";
  library.check_file();
}

TEST_F(RunsTest, ALibraryOfTheSchemaBeforeRunsIsMigratedWithABackup) {
  {
    materials::sql::Connection connection(file_, materials::sql::Connection::Open::or_new);
    materials::sql::bring_up_to_date(connection, 2);
    connection.execute("INSERT INTO entity VALUES (1, 'old', 'fabric', NULL, 0); INSERT INTO change (stroke, who, action, entity) VALUES (1, 'anna', 'added', 'old')");
  }
  Library library = open_empty();
  EXPECT_EQ(library.history().size(), 1u);
  record(library, "tights", "1");
  EXPECT_EQ(Runs(library).projects().size(), 1u);
  EXPECT_TRUE(std::filesystem::exists(file_.string() + ".schema-2.backup"));
}

TEST_F(RunsTest, EightProcessesThatRecordAtOnceLoseNothing) {
  { open_empty(); }
  std::vector<pid_t> children;
  for (int p = 0; p < 8; ++p) {
    const pid_t child = ::fork();
    if (child == 0) {
      int status = 0;
      try {
        Library library = open_empty("process " + std::to_string(p));
        for (int n = 0; n < 10; ++n) record(library, "shared", std::to_string(p) + " " + std::to_string(n));
      } catch (...) {
        status = 1;
      }
      ::_exit(status);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  Library library = open_empty();
  const auto heads = Runs(library).heads("shared");
  EXPECT_EQ(heads.size(), 80u);
  for (const RunRecord& head : heads) EXPECT_EQ(Runs(library).run(head.number).results.size(), 2u);
  library.check_file();
}

}  // namespace
}  // namespace snug::testing
