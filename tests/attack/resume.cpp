// A run that goes on from where another one was stopped or killed.
#include <nlohmann/json.hpp>

#include "tests/attack/attack.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;

class Resumed : public Attack {
 protected:
  void SetUp() override {
    Attack::SetUp();
    ASSERT_EQ(snug("new mine --like thigh-sleeve").status, 0);
  }
  /// Ends a run by the signal once it has left a checkpoint of so many bytes at least, which grows by every step.
  int ended_by(int signal, std::uintmax_t bytes = 1, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"run", "mine", "--no-report", "--checkpoint", "0"};
    for (const std::string& word : mesh_) words.push_back(word);
    words.insert(words.end(), more.begin(), more.end());
    const pid_t run = start(words);
    EXPECT_TRUE(eventually([&] {
      std::error_code none;
      const std::uintmax_t size = fs::file_size(folder_ / "mine/out.checkpoint", none);
      return !none && size >= bytes;
    }));
    ::kill(run, signal);
    return end(run);
  }
  Outcome run(const std::string& more) const { return snug("run mine --no-report " + mesh_text() + more); }
  std::string mesh_text() const { return mesh_[0] + " " + mesh_[1] + " " + mesh_[2] + " " + mesh_[3]; }

  const std::vector<std::string> mesh_ = {"--set", "body.cells_around=12", "--set", "body.cells_along=4"};
};

TEST_F(Resumed, AKilledRunGoesOnToTheSameBytes) {
  // Killed after its first step, and once more after a later one, a run that goes on gives the tables and the history of an
  // undisturbed one to the last bit, and takes its checkpoint away.
  ASSERT_EQ(run(" --quiet --out mine/plain").status, 0);
  const auto expected = tables("mine/plain");
  ASSERT_EQ(ended_by(SIGKILL), 137);
  const std::uintmax_t first = fs::file_size(folder_ / "mine/out.checkpoint");
  ASSERT_EQ(run(" --quiet --resume").status, 0);
  EXPECT_EQ(tables("mine/out"), expected);
  EXPECT_FALSE(there("mine/out.checkpoint"));
  ASSERT_EQ(ended_by(SIGKILL, first + 1), 137);
  ASSERT_EQ(run(" --quiet --resume").status, 0);
  EXPECT_EQ(tables("mine/out"), expected);
}

TEST_F(Resumed, TablesStayAsTheRunBeganThem) {
  // Begun with decimal commas, killed, and gone on from without a word of them, a run writes them; a word of another style counts.
  ASSERT_EQ(run(" --quiet --csv semicolon --out mine/plain").status, 0);
  const auto expected = tables("mine/plain");
  ASSERT_EQ(ended_by(SIGKILL, 1, {"--csv", "semicolon"}), 137);
  ASSERT_EQ(run(" --quiet --resume").status, 0);
  EXPECT_EQ(tables("mine/out"), expected);
  EXPECT_EQ(text("mine/out/skin.csv").find("node;x [m];"), 0u);
  ASSERT_EQ(ended_by(SIGKILL, 1, {"--csv", "semicolon"}), 137);
  ASSERT_EQ(run(" --quiet --resume --csv tab").status, 0);
  EXPECT_EQ(text("mine/out/skin.csv").find("node\tx [m]\t"), 0u);
}

TEST_F(Resumed, AStoppedRunSaysHowItGoesOn) {
  // Ctrl-C leaves what converged as partial, the checkpoint beside it and how to go on.
  ASSERT_EQ(ended_by(SIGINT), 130);
  EXPECT_EQ(nlohmann::json::parse(text("mine/out/summary.json")).at("status"), "partial");
  EXPECT_NE(text("log").find("the same command with --resume (from mine/out.checkpoint)"), std::string::npos) << text("log");
  ASSERT_EQ(run(" --quiet --resume").status, 0);
  EXPECT_EQ(nlohmann::json::parse(text("mine/out/summary.json")).at("status"), "converged");
}

TEST_F(Resumed, AnotherCaseOrATornFileIsRefused) {
  // A checkpoint of another case, and one that lost its end, are refused by name, and nothing is written.
  ASSERT_EQ(ended_by(SIGKILL), 137);
  const Outcome other = snug("run mine --no-report --resume --set body.cells_around=8 --set body.cells_along=4");
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.text.find("out.checkpoint"), std::string::npos) << other.text;
  EXPECT_NE(other.text.find("another than that of the checkpoint"), std::string::npos) << other.text;
  fs::resize_file(folder_ / "mine/out.checkpoint", fs::file_size(folder_ / "mine/out.checkpoint") - 100);
  const Outcome torn = run(" --resume");
  EXPECT_EQ(torn.status, 2);
  EXPECT_NE(torn.text.find("no whole checkpoint"), std::string::npos) << torn.text;
  EXPECT_TRUE(eventually([&] { return names("mine") == std::vector<std::string>{"README.md", "body", "case.toml", "out.checkpoint"}; }));
}

TEST_F(Resumed, WithoutACheckpointARunBeginsAtTheBeginning) {
  // Killed before its first step a run has left nothing to go on from; the same command works. A short run leaves none.
  const Outcome outcome = run(" --tier L1 --resume");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.text.find("from the beginning"), std::string::npos) << outcome.text;
  EXPECT_FALSE(there("mine/out.checkpoint"));
}

}  // namespace
}  // namespace snug
