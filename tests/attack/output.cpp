// Where results go: only what snug wrote there is ever replaced, and one whole set stands under the name at every instant.
#include "tests/attack/attack.hpp"

#include "solver/app/output_directory.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;

TEST_F(Attack, WhatTheUserPutsAmongResultsIsKept) {
  // A note, a folder of notes and a link in out/ are there after the next run, and snug's own files are the new ones.
  ASSERT_EQ(snug("new mine --like limb-alone").status, 0);
  ASSERT_EQ(snug(std::string("run mine") + coarse).status, 0);
  put("mine/out/note.txt", "talk to Anna");
  put("mine/out/talk/slides.txt", "first");
  fs::create_symlink("note.txt", folder_ / "mine/out/link");
  const std::string before = text("mine/out/summary.json");
  ASSERT_EQ(snug("run mine --quiet --set body.cells_around=12 --set body.cells_along=1").status, 0);
  EXPECT_EQ(text("mine/out/note.txt"), "talk to Anna");
  EXPECT_EQ(text("mine/out/talk/slides.txt"), "first");
  EXPECT_TRUE(fs::is_symlink(folder_ / "mine/out/link"));
  EXPECT_NE(text("mine/out/summary.json"), before);
  EXPECT_EQ(names("mine"), (std::vector<std::string>{"README.md", "body", "case.toml", "out"}));
}

TEST_F(Attack, FilesThatARunNoLongerWritesGo) {
  // What an earlier run of snug listed as its own and the next one does not write is no leftover beside new results.
  ASSERT_EQ(snug("new mine --like limb-alone").status, 0);
  ASSERT_EQ(snug(std::string("run mine") + coarse).status, 0);
  ASSERT_TRUE(there("mine/out/report.html"));
  ASSERT_EQ(snug(std::string("run mine --no-report") + coarse).status, 0);
  EXPECT_FALSE(there("mine/out/report.html"));
}

TEST_F(Attack, AFolderWithoutTheMarkIsRefused) {
  // A folder with somebody's files is refused whatever names it holds: those of results, a mesh, a study.
  ASSERT_EQ(snug("new mine --like limb-alone").status, 0);
  for (const std::string name : {"study.csv", "summary.json", "body.vtu", "mesh/body.vtu"}) {
    put("theirs/" + name, "precious");
    put("theirs/chapter.tex", "more precious");
    const Outcome outcome = snug(std::string("run mine --out theirs") + coarse);
    EXPECT_EQ(outcome.status, 2) << name << outcome.text;
    EXPECT_NE(outcome.text.find("theirs: error: "), std::string::npos) << outcome.text;
    EXPECT_EQ(text("theirs/" + name), "precious");
    fs::remove(folder_ / "theirs/chapter.tex");
    EXPECT_EQ(snug(std::string("run mine --out theirs") + coarse).status, 2) << name;
    EXPECT_EQ(text("theirs/" + name), "precious");
    fs::remove_all(folder_ / "theirs");
  }
}

TEST_F(Attack, AFileOfTheUserIsNotTakenForAResult) {
  // Where the user keeps a file under the name of a result that snug did not write, the run is refused before the solve, and
  // `report` does not write over it.
  ASSERT_EQ(snug("new mine --like limb-alone").status, 0);
  ASSERT_EQ(snug(std::string("run mine --no-report") + coarse).status, 0);
  put("mine/out/report.html", "my own words");
  EXPECT_EQ(snug(std::string("run mine") + coarse).status, 2);
  EXPECT_EQ(snug("report mine/out --no-pictures").status, 2);
  EXPECT_EQ(text("mine/out/report.html"), "my own words");
  EXPECT_EQ(snug(std::string("run mine --no-report") + coarse).status, 0);
  EXPECT_EQ(text("mine/out/report.html"), "my own words");
}

TEST_F(Attack, ALinkedOutputKeepsItsLink) {
  // out/ may be a symbolic link to a larger disk, there already or not yet.
  ASSERT_EQ(snug("new mine --like limb-alone").status, 0);
  fs::create_directories(folder_ / "disk");
  fs::create_directory_symlink("../disk/results", folder_ / "mine/out");
  for (int n = 0; n < 2; ++n) {
    ASSERT_EQ(snug(std::string("run mine") + coarse).status, 0);
    EXPECT_TRUE(fs::is_symlink(folder_ / "mine/out"));
    EXPECT_TRUE(there("disk/results/summary.json"));
    EXPECT_EQ(names("disk"), (std::vector<std::string>{"results"}));
  }
}

TEST_F(Attack, WhatAKilledRunLeftIsPutRight) {
  // Results that were whole when the run was killed take the free name; a directory that was being filled goes; one that only
  // has such a name stays.
  app::write_result_list(folder_, {}, false);
  fs::remove(folder_ / app::result_mark);
  const auto aside = [&](const std::string& name, const std::string& content, bool complete) {
    put(name + "/summary.json", content);
    app::write_result_list(folder_ / name, {"summary.json"}, complete);
  };
  aside("out.tmp-1", "half", false);
  aside("out.tmp-2", "whole", true);
  put("out.tmp-3/mine.txt", "the user's");
  put("out.tmp-5/.snug-results.part-5", "killed as it beg");
  fs::create_directories(folder_ / "out.tmp-6");  // killed before it wrote anything, or after it had removed everything
  app::repair_results(folder_ / "out");
  EXPECT_EQ(text("out/summary.json"), "whole");
  EXPECT_EQ(names(""), (std::vector<std::string>{"out", "out.tmp-3"}));
  aside("out.tmp-4", "earlier", true);  // the exchange was done, the earlier results were not yet taken away
  put("out.tmp-4/note.txt", "written in the last moment");
  app::repair_results(folder_ / "out");
  EXPECT_EQ(text("out/summary.json"), "whole");
  EXPECT_EQ(text("out/note.txt"), "written in the last moment");
  EXPECT_EQ(names(""), (std::vector<std::string>{"out", "out.tmp-3"}));
}

TEST_F(Attack, ResultsThatCannotTakeTheirPlaceAreKept) {
  // The place changed during the run: the results stay under another name, which no later run takes away.
  app::OutputDirectory out(folder_ / "out");
  write((out.aside() / "summary.json").lexically_relative(folder_).string(), "whole");
  put("out", "a file of the user");
  EXPECT_THROW(out.commit(), std::exception);
  app::repair_results(folder_ / "out");
  const auto all = names("");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_TRUE(all[1].starts_with("out.kept-")) << all[1];
  EXPECT_EQ(text(all[1] + "/summary.json"), "whole");
}

TEST_F(Attack, APlaceThatCannotBeWrittenIsSaidBeforeTheSolve) {
  // The place is tried before the solve, is the user's to mend (status 2), and nothing is left.
  ASSERT_EQ(snug("new mine --like limb-alone").status, 0);
  put("file", "");
  const Outcome outcome = snug(std::string("run mine --out file/results") + coarse);
  EXPECT_EQ(outcome.status, 2) << outcome.text;
  EXPECT_NE(outcome.text.find("--out"), std::string::npos) << outcome.text;
  EXPECT_EQ(names(""), (std::vector<std::string>{"file", "mine"}));
}

TEST_F(Attack, AWriteThatFailsKeepsTheEarlierResults) {
  // A limit on the size of files fails the writes from some file on, as a full disk does: the status says so, the earlier
  // results stay whole, and nothing half-written remains.
  ASSERT_EQ(snug("new mine --like limb-alone").status, 0);
  ASSERT_EQ(snug(std::string("run mine --no-report") + coarse).status, 0);
  const auto before = tables("mine/out");
  for (const int blocks : {0, 1, 8, 24}) {
    const std::string command = "cd '" + folder_.string() + "' && ulimit -f " + std::to_string(blocks) + " && '" + SNUG_BINARY + "' run mine --no-report" + coarse +
                                "> /dev/null 2> " + (blocks < 8 ? "/dev/null" : "said");
    const int state = std::system(("bash -c \"" + command + "\"").c_str());
    EXPECT_TRUE(WEXITSTATUS(state) == 4 || WEXITSTATUS(state) == 2) << blocks << " " << WEXITSTATUS(state);
    if (blocks >= 8) EXPECT_NE(text("said").find("File too large; see what this path leads to"), std::string::npos) << text("said");
    EXPECT_EQ(tables("mine/out"), before) << blocks;
    EXPECT_EQ(names("mine").size(), 4u) << blocks;
  }
}

TEST_F(Attack, AFullStandardOutputIsTold) {
  // What is said to a full device is not said, and the status tells it.
  ASSERT_EQ(snug("new mine --like limb-alone").status, 0);
  put("worn.csv", "location,pressure_gf_per_cm2\nFront thigh,3.89\n");
  for (const std::string command : {"check mine", "score worn.csv --json", "list"}) {
    const std::string line = "cd '" + folder_.string() + "' && '" + SNUG_BINARY + "' " + command + " > /dev/full 2> said";
    EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 4) << command;
    EXPECT_NE(text("said").find("standard output"), std::string::npos) << text("said");
  }
}

TEST_F(Attack, TheSameCaseTwiceGivesTheSameBytes) {
  // Tables and grids are the same to the byte; times stand in summary.json and on the page only.
  ASSERT_EQ(snug("new mine --like tube-sleeve").status, 0);
  const std::string run = "run mine --quiet --set body.cells_around=12 --set body.cells_along=1 --out ";
  ASSERT_EQ(snug(run + "first").status, 0);
  ASSERT_EQ(snug(run + "second").status, 0);
  const auto first = tables("first"), second = tables("second");
  ASSERT_GT(first.size(), 8u);
  for (const auto& [name, content] : first) EXPECT_EQ(content == second.at(name), true) << name;
}

TEST_F(Attack, EightRunsAtOnceLeaveOneWholeResult) {
  // Runs that end at the same time in one directory follow each other; what stands is the whole result of one.
  ASSERT_EQ(snug("new mine --like limb-alone").status, 0);
  ASSERT_EQ(snug(std::string("run mine --no-report") + coarse).status, 0);
  const auto expected = tables("mine/out");
  std::vector<pid_t> running;
  for (int n = 0; n < 8; ++n)
    running.push_back(start({"run", "mine", "--no-report", "--quiet", "--set", "body.cells_around=8", "--set", "body.cells_along=1"}));
  for (const pid_t one : running) EXPECT_EQ(end(one), 0) << text("log");
  EXPECT_EQ(tables("mine/out"), expected);
  EXPECT_EQ(names("mine"), (std::vector<std::string>{"README.md", "body", "case.toml", "out"}));
}

}  // namespace
}  // namespace snug
