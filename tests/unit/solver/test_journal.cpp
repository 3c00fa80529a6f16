// What a run keeps of its paths, written and read back.
#include <gtest/gtest.h>

#include <stdexcept>

#include "solver/stepping/journal.hpp"

namespace snug::solver {
namespace {

PathRecord record() {
  PathRecord path;
  path.state.values = Eigen::VectorXd::LinSpaced(7, -1.0 / 3.0, 1e-300);
  path.state.load = 0.1, path.state.release = 0.7, path.state.stiffening = 3.0;
  path.state.history.put("contact", std::make_shared<StoredHistory>(std::string("\x01\x00\x7f", 3)));
  path.before = 0.3 * path.state.values;
  path.reached = 0.25, path.span = 0.125, path.step = 0.0625;
  path.increments = 2, path.lost = 11, path.crept = 5, path.slid = 0.013, path.message = "the iteration makes no progress";
  path.rows = {{.increment = 1, .load = 0.5, .iteration = 3, .residual = 1e-5, .event = "lagged", .attempt = 2}};
  return path;
}

TEST(Journal, IsReadBackToTheLastBit) {
  // What is written and read is written as the same bytes again, and its numbers are the same to the last bit.
  Journal journal;
  journal.begin();
  journal.note(record());
  const Journal read = Journal::of_bytes(journal.bytes());
  EXPECT_EQ(read.bytes(), journal.bytes());
  ASSERT_EQ(read.paths().size(), 1u);
  const PathRecord& path = read.paths()[0];
  EXPECT_EQ(path.state.values, record().state.values);
  EXPECT_EQ(path.before, record().before);
  EXPECT_EQ(path.state.history.get<StoredHistory>("contact").bytes, std::string("\x01\x00\x7f", 3));
  EXPECT_EQ(path.rows[0].event, "lagged");
  EXPECT_EQ(path.lost, 11);
  EXPECT_EQ(path.crept, 5);
  EXPECT_EQ(path.slid, 0.013);
}

TEST(Journal, GivesThePathsInTheirOrderAndThenNone) {
  // The second walk finds the first path, then nothing; what it notes then is the second one.
  Journal first;
  first.begin();
  first.note(record());
  Journal journal = Journal::of_bytes(first.bytes());
  ASSERT_TRUE(journal.begin().has_value());
  EXPECT_FALSE(journal.begin().has_value());
  journal.note(record());
  EXPECT_EQ(journal.paths().size(), 2u);
}

TEST(Journal, RecordsNothingAfterAStop) {
  // What a run does once it is stopped is no part of its way.
  Journal journal;
  journal.begin();
  journal.note(record());
  journal.stop();
  journal.begin();
  journal.note(record());
  EXPECT_EQ(journal.paths().size(), 1u);
}

TEST(Journal, BytesThatEndTooSoonAreRefused) {
  // Cut anywhere, or with something behind their end, bytes are refused and never read beyond.
  Journal journal;
  journal.begin();
  journal.note(record());
  const std::string bytes = journal.bytes();
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_THROW(Journal::of_bytes(std::string_view(bytes).substr(0, length)), std::runtime_error) << length;
  EXPECT_THROW(Journal::of_bytes(bytes + "x"), std::runtime_error);
}

}  // namespace
}  // namespace snug::solver
