// A run that is stopped or killed.
#include <nlohmann/json.hpp>

#include "solver/app/cleaner.hpp"
#include "solver/app/output_directory.hpp"
#include "tests/attack/attack.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;

class Stopped : public Attack {
 protected:
  void SetUp() override {
    Attack::SetUp();
    ASSERT_EQ(snug("new mine --like tube-sleeve").status, 0);
    ASSERT_EQ(snug("run mine --quiet --tier L1 --set body.cells_around=8 --set body.cells_along=1").status, 0);
    before_ = text("mine/out/summary.json");
  }
  /// A solution of some ten seconds, well on its way.
  pid_t solving(std::vector<std::string> more = {}) const {
    std::vector<std::string> words = {"run", "mine", "--quiet", "--states", "60"};
    words.insert(words.end(), more.begin(), more.end());
    const pid_t run = start(words);
    EXPECT_TRUE(eventually([&] { return has_converged(); }));
    return run;
  }
  /// A step has: the state after the placed one is kept.
  bool has_converged() const {
    for (const std::string& name : names("mine"))
      if (name.starts_with("out.tmp-") && there(fs::path("mine") / name / "states/garment_0001.vtu")) return true;
    return false;
  }
  bool nothing_left() const { return names("mine").size() == 4 && fs::is_empty(temporary_); }
  std::string before_;
};

TEST_F(Stopped, ASignalGivesUpTheStepAndKeepsWhatConverged) {
  // SIGINT and SIGTERM end the run in good order with 130 and 143: the last converged state is the result, called partial.
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t run = solving();
    ::kill(run, signal);
    EXPECT_EQ(end(run), 128 + signal) << text("log");
    const auto summary = nlohmann::json::parse(text("mine/out/summary.json"));
    EXPECT_EQ(summary.at("status"), "partial");
    EXPECT_NE(summary.at("message").get<std::string>().find("stopped by you"), std::string::npos);
    EXPECT_TRUE(there("mine/out/skin.csv"));
    EXPECT_EQ(names("mine"), (std::vector<std::string>{"README.md", "body", "case.toml", "out"}));
  }
}

TEST_F(Stopped, AKilledRunLeavesTheEarlierResults) {
  // After SIGKILL the earlier results stand, nothing lies beside them or in the temporary folder, and the next run works.
  const pid_t run = solving();
  ::kill(run, SIGKILL);
  EXPECT_EQ(end(run), 137);
  EXPECT_TRUE(eventually([&] { return nothing_left(); }));
  EXPECT_EQ(text("mine/out/summary.json"), before_);
  EXPECT_EQ(snug("run mine --quiet --tier L1 --set body.cells_around=8 --set body.cells_along=1").status, 0);
}

TEST_F(Stopped, ASecondSignalEndsAtOnce) {
  // The first asks, the second does not; the earlier results stand.
  const pid_t run = solving();
  ::kill(run, SIGINT);
  ::kill(run, SIGINT);
  ::kill(run, SIGTERM);
  const int status = end(run);
  EXPECT_TRUE(status == 130 || status == 143) << status;
  EXPECT_TRUE(eventually([&] { return nothing_left(); }));
}

TEST_F(Attack, AKilledRunOfAnyNameLeavesNothing) {
  // The name ends as the farewell to the cleaner does, which waits for the end of the process all the same.
  const fs::path place = folder_ / "sleeve";
  const pid_t run = ::fork();
  if (run == 0) {
    const app::Cleaner cleaner;
    app::OutputDirectory out(place);
    cleaner.repair(place);
    out.aside();
    ::raise(SIGKILL);
  }
  EXPECT_EQ(end(run), 137);
  EXPECT_TRUE(eventually([&] { return names("").empty(); }));
}

/// Processes of the program that work in a folder.
std::vector<pid_t> programs(const fs::path& folder) {
  std::vector<pid_t> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::error_code ignored;
    const fs::path binary = fs::read_symlink(entry.path() / "exe", ignored);
    if (binary == fs::canonical(SNUG_BINARY) && fs::read_symlink(entry.path() / "cwd", ignored) == fs::canonical(folder)) found.push_back(std::stoi(entry.path().filename().string()));
  }
  return found;
}

std::vector<std::string> shared_memory() {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator("/dev/shm"))
    if (entry.path().filename().string().starts_with("vader")) found.push_back(entry.path().filename().string());
  return found;
}

TEST_F(Stopped, RanksEndWithTheirLauncher) {
  // Killed or asked, the launcher takes its ranks along, and no segment stays in shared memory.
  const auto shared_before = shared_memory().size();
  for (const int signal : {SIGKILL, SIGTERM}) {
    const pid_t run = solving({"--ranks", "2"});
    ::kill(run, signal);
    EXPECT_EQ(end(run), 128 + signal) << text("log");
    EXPECT_TRUE(eventually([&] { return programs(folder_).empty(); }));
    EXPECT_TRUE(eventually([&] { return shared_memory().size() <= shared_before; }));
    EXPECT_TRUE(eventually([&] { return nothing_left(); }));
    if (signal == SIGTERM) EXPECT_EQ(nlohmann::json::parse(text("mine/out/summary.json")).at("status"), "partial");
  }
}

}  // namespace
}  // namespace snug
