// The file of the library: many writers, kills, full disks, earlier schemas, damage, and how fast it is.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <chrono>
#include <ctime>
#include <random>
#include <thread>

#include "materials/database/schema.hpp"
#include "tests/unit/materials/library_under_test.hpp"

namespace snug::testing {
namespace {

namespace fs = std::filesystem;
using materials::Datum, materials::DatumType, materials::Entity, materials::Kind, materials::Library, materials::Stroke;
using ::testing::ElementsAre, ::testing::HasSubstr;

class LibraryFileTest : public LibraryTest {
 protected:
  /// Runs `work` in a process of its own, which ends without a word; returns its ID.
  static pid_t process(const std::function<void()>& work) {
    const pid_t child = ::fork();
    if (child != 0) return child;
    try {
      work();
    } catch (const std::exception& error) {
      std::cerr << "a process ended with: " << error.what() << "\n";
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

TEST_F(LibraryFileTest, AHundredThousandEntitiesAreWrittenAndAskedFast) {
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

TEST_F(LibraryFileTest, EightProcessesWritingLoseNothing) {
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

TEST_F(LibraryFileTest, AKillInTheMiddleOfAWriteLeavesASoundFile) {
  // Pairs are written in one stroke each; whenever the writer is killed, both of a pair are there or none, and all
  // that was told as done is.
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

TEST_F(LibraryFileTest, AKillWhileTheLibraryIsMadeIsNoDamage) {
  // Whenever the first process is killed, the next one makes or finds the library as it ships.
  std::mt19937 random(11);
  materials::UnitBook units;
  const materials::Entries shipped = materials::shipped_entries(units);
  for (int round = 0; round < 15; ++round) {
    for (const char* beside : {"", "-wal", "-shm", "-journal"}) fs::remove(file_.string() + beside);
    const pid_t child = process([&] { open(); });
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 90'000));
    ::kill(child, SIGKILL);
    status_of(child);
    const Library library = open();
    library.check_file();
    EXPECT_THAT(library.differences(shipped), ElementsAre());
  }
}

TEST_F(LibraryFileTest, AFullDiskLosesNothing) {
  // A limit on the size of files stands for it: the write fails as a fault of the machine, what was there is there,
  // and writing goes on later.
  {
    Library library = open_empty();
    add(library, fabric("before", "weight = \"1 g/m2\""));
  }
  const pid_t child = process([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit little{300'000, 300'000};
    ::setrlimit(RLIMIT_FSIZE, &little);
    Library library = open_empty();
    try {
      library.change([](Stroke& stroke) {
        for (int n = 0; n < 20'000; ++n)
          stroke.put(fabric("new " + std::to_string(n), "note = \"a long text of no use\""), "added");
      });
    } catch (const std::runtime_error& error) {
      ::_exit(dynamic_cast<const input::InputError*>(&error) ? 2 : 7);
    }
    ::_exit(3);
  });
  EXPECT_EQ(WEXITSTATUS(status_of(child)), 7);
  Library library = open_empty();
  library.check_file();
  EXPECT_EQ(library.count(), 1);
  add(library, fabric("after", "weight = \"1 g/m2\""));
  EXPECT_THAT(library.ids(), ElementsAre("before", "after"));
}

TEST_F(LibraryFileTest, AnEarlierSchemaIsMigratedWithABackup) {
  // Schema 1 had no history and no files. What stood in it stands there after the migration, and the copy beside it
  // is as it was.
  {
    materials::sql::Connection connection(file_, materials::sql::Connection::Open::or_new);
    materials::sql::bring_up_to_date(connection, 1);
    connection.execute(
        "INSERT INTO item VALUES ('weight', 'kg/m2'); INSERT INTO entity VALUES (1, 'old', 'fabric', NULL, 0);"
        "INSERT INTO datum VALUES (1, 0, 'weight', 1, 0, 'value', NULL, '150', 'g/m2', NULL, NULL, NULL, NULL, "
        "0.15)");
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

TEST_F(LibraryFileTest, ALaterSchemaAndAnotherProgramsFileAreRefusedAndLeft) {
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

TEST_F(LibraryFileTest, ADamagedFileIsRefusedAndNotTouched) {
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

TEST_F(LibraryFileTest, WhatIsNoFileIsRefused) {
  fs::create_directory(file_);
  EXPECT_THAT(error_of([&] { open_empty(); }), HasSubstr("is a directory"));
  fs::remove(file_);
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  EXPECT_THAT(error_of([&] { open_empty(); }), HasSubstr("a pipe or a device"));
  fs::remove(file_);
  put_bytes("");
  EXPECT_EQ(open_empty().count(), 0) << "an empty file is a library that was about to be made";
}

}  // namespace
}  // namespace snug::testing
