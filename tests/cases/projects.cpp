// Recorded runs as a user meets them: snug run, snug project, snug materials near, clusters, regress, suggest.
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cases/program.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;

class ProjectProgram : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    ::setenv("SNUG_RECORD", "on", 1);
  }
  void TearDown() override {
    ::setenv("SNUG_RECORD", "off", 1);
    Program::TearDown();
  }
  std::string content(const fs::path& file) const {
    std::ifstream in(folder_ / file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  nlohmann::json summary(const std::string& out) const { return nlohmann::json::parse(content(out + "/summary.json")); }
  std::string expect(const std::string& arguments, int status, const std::string& said) const {
    const Outcome outcome = snug(arguments);
    EXPECT_EQ(outcome.status, status) << arguments << "\n" << outcome.text;
    EXPECT_NE(outcome.text.find(said), std::string::npos) << arguments << "\n" << said << "\n" << outcome.text;
    return outcome.text;
  }
  /// The line of a text that holds all of the words.
  static std::string line_of(const std::string& text, const std::vector<std::string>& words) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      if (std::all_of(words.begin(), words.end(), [&](const std::string& word) { return line.find(word) != line.npos; })) return line;
    ADD_FAILURE() << "no line has " << fmt::format("{}", fmt::join(words, ", ")) << "\n" << text;
    return {};
  }
  const fs::path library_ = folder_ / "library.db";
  static constexpr const char* coarse = " --quiet --no-report --tier L1 --set body.cells_around=12 --set body.cells_along=4 --set 'garment.cell_size=\"25 mm\"' ";
  static constexpr const char* laplace = " --quiet --no-report --tier L0 --set body.cells_around=12 --set body.cells_along=4 ";
};

TEST_F(ProjectProgram, ARunIsRecordedWithWhatWentInAndWhatCameOut) {
  // Pressures are those of summary.json; the inputs have their hashes; the project is the case's directory; what is changed or gone since is said.
  ASSERT_EQ(snug("new tights --like thigh-sleeve").status, 0);
  const std::string said = expect("run tights --note 'first try'" + std::string(laplace).substr(std::string(" --quiet").size()), 0, "run 1 of project tights");
  const double pressure = summary("tights/out")["locations"][0]["mean_pressure_Pa"];
  const std::string all = expect("project show 1 --unit Pa", 0, "first try");
  EXPECT_NE(line_of(all, {"Front thigh "}).find(fmt::format("{:.4g}", pressure)), std::string::npos) << all;
  line_of(all, {"input", "body/thigh.csv", "unchanged"});
  line_of(all, {"input", "case.toml", "unchanged"});
  line_of(all, {"material", "garment.fabric = N85L15"});
  line_of(all, {"material", "body.layers.tissue.material = relaxed thigh"});
  line_of(all, {"results", "as recorded"});
  line_of(all, {"version", "snug"});
  EXPECT_NE(line_of(expect("project show tights", 0, ""), {"first try"}).find(fmt::format("{:.4g}", pressure / 98.0665)), std::string::npos);
  EXPECT_EQ(snug("run tights --project other" + std::string(laplace) + "--set garment.fabric=P98L2").status, 0);
  line_of(snug("project list").text, {"other", "1"});
  const std::string later = snug("project show 1").text;
  line_of(later, {"results", "others are there now"});
  write("tights/body/thigh.csv", content("tights/body/thigh.csv") + "\n");
  fs::remove_all(folder_ / "tights/out");
  line_of(snug("project show 2").text, {"results", "no longer there"});
  line_of(snug("project show 1").text, {"input", "body/thigh.csv", "changed since"});
}

TEST_F(ProjectProgram, NothingIsRecordedWhereItIsSwitchedOff) {
  ASSERT_EQ(snug("new mine --like thigh-sleeve").status, 0);
  EXPECT_EQ(snug(std::string("run mine --no-record") + laplace).status, 0);
  EXPECT_EQ(snug(std::string("run mine") + laplace, "SNUG_RECORD=off").status, 0);
  EXPECT_FALSE(fs::exists(library_));
  EXPECT_EQ(snug("check mine").status, 0);
  EXPECT_FALSE(fs::exists(library_)) << "what does not run is not recorded";
}

TEST_F(ProjectProgram, AFailureToRecordIsAWarningAndCostsNothing) {
  // A damaged library, one in a folder that is none, a folder of that name, and no home: the results are there and the status is that of the run.
  ASSERT_EQ(snug("new mine --like thigh-sleeve").status, 0);
  write("library.db", std::string(5000, 'x'));
  const auto warns = [&](const std::string& before, const std::string& said) {
    fs::remove_all(folder_ / "mine/out");
    const Outcome outcome = snug(std::string("run mine") + laplace, before);
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_NE(outcome.text.find("warning: the run is not recorded"), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find(said), std::string::npos) << outcome.text;
    EXPECT_TRUE(fs::exists(folder_ / "mine/out/summary.json"));
  };
  warns("", "this is no library of snug, or a damaged one");
  EXPECT_EQ(content("library.db"), std::string(5000, 'x')) << "left as it was";
  warns("SNUG_LIBRARY=mine/case.toml/library.db", "library");
  warns("SNUG_LIBRARY=mine", "is a directory");
  warns("env -u SNUG_LIBRARY -u XDG_DATA_HOME -u HOME", "no home folder");
}

TEST_F(ProjectProgram, AStudyDoesNotFillTheLibrary) {
  ASSERT_EQ(snug("new mine --like thigh-sleeve").status, 0);
  ASSERT_EQ(snug("study mine --levels 1 --tier L1 --set body.cells_around=12 --set body.cells_along=4").status, 0) << snug("study --help").text;
  EXPECT_FALSE(fs::exists(library_));
}

TEST_F(ProjectProgram, APressureIsTracedToTheDatumAndItsSource) {
  // Of an own fabric, a copy of N85L15 with another weight of a named source: WT as printed with its deviation and table, the value that the run used in
  // SI, and, after the entry was edited, what it is today. The run's own text stays as it was.
  ASSERT_EQ(snug("new mine --like thigh-sleeve").status, 0);
  ASSERT_EQ(snug("materials copy N85L15 'my knit'").status, 0);
  ASSERT_EQ(snug("materials edit 'my knit' 'weight={ value=\"212 g/m2\", source=\"weighed on Monday\" }'").status, 0);
  ASSERT_EQ(snug(std::string("run mine") + laplace + "--set 'garment.fabric=\"my knit\"'").status, 0);
  const std::string traced = expect("project trace 1 'Front thigh'", 0, "garment.fabric = my knit of the library");
  const std::string work = line_of(traced, {" WT ", "10.02 +- 8.26 gf cm/cm2", "9.82626"});
  EXPECT_NE(work.find("table"), std::string::npos) << work;
  line_of(traced, {"weight", "212 g/m2", "weighed on Monday"});
  line_of(traced, {"EMT", "43.26"});
  line_of(traced, {"garment.pattern.flat_circumference = 0.42 m"});
  line_of(traced, {"body.layers.tissue.material = relaxed thigh of the library"});
  EXPECT_EQ(traced.find("today"), std::string::npos) << traced;
  ASSERT_EQ(snug("materials edit 'my knit' 'WT=11 gf cm/cm2'").status, 0);
  line_of(snug("project trace 1 'Front thigh'").text, {" WT ", "10.02 +- 8.26 gf cm/cm2", "today 11 gf cm/cm2"});
  ASSERT_EQ(snug("materials remove 'my knit'").status, 0);
  line_of(snug("project trace 1 'Front thigh'").text, {" WT ", "10.02 +- 8.26 gf cm/cm2", "no longer has the entity"});
  expect("project trace 1 'Front tigh'", 2, "did you mean Front thigh");
  expect("project trace 7 'Front thigh'", 2, "there is no run 7");
}

TEST_F(ProjectProgram, RunsAreComparedAndDecidedOn) {
  // The change of the pressure against the first run is that of summary.json.
  ASSERT_EQ(snug("new mine --like thigh-sleeve").status, 0);
  ASSERT_EQ(snug(std::string("run mine --out one") + laplace).status, 0);
  ASSERT_EQ(snug(std::string("run mine --out two") + laplace + "--set garment.fabric=P98L2").status, 0);
  const double one = summary("one")["locations"][0]["mean_pressure_Pa"], two = summary("two")["locations"][0]["mean_pressure_Pa"];
  const std::string compared = expect("project compare 1 2", 0, "garment.fabric.name");
  line_of(compared, {"Front thigh [gf/cm2]", fmt::format("({:+.1f} %)", 100.0 * (two / one - 1.0))});
  line_of(compared, {"garment.fabric.name", "N85L15", "P98L2"});
  expect("project compare 1", 2, "error");
  expect("project decide mine 2 'the softer one'", 0, "");
  line_of(snug("project list").text, {"mine", "run 2"});
  line_of(snug("project show mine").text, {"decided for run 2: the softer one"});
  expect("project decide mien 2", 2, "did you mean mine?");
  expect("project note 1 'too tight'", 0, "");
  line_of(snug("project show mine").text, {"too tight"});
  expect("project page mine --out page.html", 0, "page.html");
  const std::string page = content("page.html");
  for (const char* part : {"the softer one", "too tight", "garment.fabric.name", "class=\"chosen\"", "map-1"}) EXPECT_NE(page.find(part), std::string::npos) << part;
  expect("project forget 1", 0, "");
  expect("project show 1", 2, "there is no run 1");
}

TEST_F(ProjectProgram, ADerivedCaseGivesTheDigitsOfItsRun) {
  // From the library alone, after the case has gone: the same numbers to the last digit, and the same material in its trace; with --set another one.
  ASSERT_EQ(snug("new mine --like thigh-sleeve").status, 0);
  ASSERT_EQ(snug(std::string("run mine --out first") + coarse + "--set 'garment.pattern.flat_circumference=\"410 mm\"'").status, 0);
  fs::remove_all(folder_ / "mine");
  expect("project derive 1 again", 0, "again is derived from run 1");
  ASSERT_EQ(snug("run again --quiet --no-report --out second").status, 0);
  EXPECT_EQ(content("first/skin.csv"), content("second/skin.csv"));
  EXPECT_EQ(content("first/locations.csv"), content("second/locations.csv"));
  line_of(snug("project show 2").text, {"derived", "from run 1"});
  line_of(snug("project trace 2 'Front thigh'").text, {"garment.fabric = N85L15 of the library"});
  expect("project derive 1 again", 2, "this is there already");
  expect("project derive 1 other --set garment.fabric=N88P", 0, "other is derived");
  expect("check other", 0, "N88P");
  expect("project derive 1 wrong --set body.cells_around=-3", 2, "cells_around");
  EXPECT_FALSE(fs::exists(folder_ / "wrong"));
  for (const auto& entry : fs::directory_iterator(folder_)) EXPECT_EQ(entry.path().string().find(".tmp-"), std::string::npos) << entry.path();
}

TEST_F(ProjectProgram, ACaseWithoutPressuresIsRecordedToo) {
  // A limb alone, under a load, and a run that is refused: the first has no locations, the second is no run.
  ASSERT_EQ(snug("new alone --like limb-alone").status, 0);
  ASSERT_EQ(snug("run alone --quiet --no-report --set body.cells_around=8 --set body.cells_along=2").status, 0);
  expect("project show alone", 0, "converged");
  expect("project page alone", 0, "alone.html");
  EXPECT_EQ(snug("run alone --set body.cells_around=-1").status, 2);
  EXPECT_EQ(snug("project show 2").status, 2);
}

TEST_F(ProjectProgram, ProjectsOfAnyName) {
  // A year, blanks, quotes, a slash: shown and drawn under their names; a note that no text can hold is a warning.
  ASSERT_EQ(snug("new 2026 --like thigh-sleeve").status, 0);
  ASSERT_EQ(snug(std::string("run 2026") + laplace).status, 0);
  line_of(expect("project show 2026", 0, "converged"), {"1", "converged"});
  expect("project show 1", 0, "run 1 of project 2026");
  const std::string name = "\"men's / <b>&'; DROP TABLE run; --\"";
  ASSERT_EQ(snug(std::string("run 2026") + laplace + "--project " + name).status, 0);
  line_of(expect("project list", 0, "men's / <b>&'; DROP TABLE run; --"), {"2026", "1"});
  expect("project show " + name, 0, "converged");
  expect("project page " + name + " --out page.html", 0, "page.html");
  const std::string page = content("page.html");
  EXPECT_NE(page.find("&lt;b&gt;&amp;"), std::string::npos);
  EXPECT_EQ(page.find("<b>"), std::string::npos) << "a name is text";
  const Outcome warned = snug(std::string("run 2026") + laplace + "--note $(printf 'a\\001b')");
  EXPECT_EQ(warned.status, 0);
  EXPECT_NE(warned.text.find("warning: the run is not recorded"), std::string::npos) << warned.text;
}

TEST_F(ProjectProgram, FabricsThatAreAlike) {
  // The nearest in weight alone is the one with the nearest weight: 215 of N85L15, 220 of P98L2. A copy is at distance 0.
  const std::string near = expect("materials near N85L15 --by weight --most 2", 0, "P98L2");
  EXPECT_LT(near.find("P98L2"), near.find("E95C")) << near;
  ASSERT_EQ(snug("materials copy N85L15 'my knit'").status, 0);
  line_of(expect("materials near N85L15 --most 1", 0, "my knit"), {"my knit", "0.000"});
  const std::string groups = expect("materials clusters --by EMT,weight --count 2", 0, "2 groups by EMT, weight");
  const auto group = [&](const std::string& id) { return line_of(groups, {" " + id + " "}).substr(0, 4); };
  EXPECT_EQ(group("N85L15"), group("my knit"));
  EXPECT_NE(group("P98L2"), group("C98L2")) << groups;  // EMT 56 % and 7 %
  expect("materials clusters --by EMT --count 40", 2, "ask for fewer");
  // For programs in SI, and numbers as numbers: 215 and 220 g/m2 are 0.215 and 0.22 kg/m2.
  const auto json = nlohmann::json::parse(expect("materials near N85L15 --by weight --most 2 --json", 0, "entities"))["entities"];
  EXPECT_DOUBLE_EQ(json[0]["items"]["weight"].get<double>(), 0.215);
  EXPECT_DOUBLE_EQ(json[2]["items"]["weight"].get<double>(), 0.22);
  EXPECT_GT(json[2]["distance"].get<double>(), 0.0);
  EXPECT_EQ(nlohmann::json::parse(expect("materials clusters --by EMT,weight --count 2 --json", 0, "entities"))["entities"].size(), 4u);  // the three that have both, and the copy
  expect("materials near N85L15 --by wieght", 2, "did you mean weight?");
  expect("materials near 'no knit'", 2, "did you mean my knit?");
}

TEST_F(ProjectProgram, AResponseIsLearntFromRuns) {
  // Seven circumferences of one fabric by the law of Laplace: a quadratic tells each from the others to a percent; its slope is that of the neighbours' difference.
  ASSERT_EQ(snug("new mine --like thigh-sleeve").status, 0);
  std::map<int, double> pressure;
  for (const int width : {380, 390, 400, 410, 420, 430, 440}) {
    ASSERT_EQ(snug(std::string("run mine --out out") + laplace + fmt::format("--set 'garment.pattern.flat_circumference=\"{} mm\"'", width)).status, 0);
    pressure[width] = summary("out")["locations"][0]["mean_pressure_Pa"];
  }
  EXPECT_EQ(snug(std::string("run mine --out out") + laplace + "--set 'garment.pattern.flat_circumference=\"440 mm\"'").status, 0);
  const std::string learnt = expect("materials regress 'Front thigh' --quadratic --unit Pa", 0, "7 runs; left out: 1 of a case that was run before");
  double rms = 0.0;
  std::sscanf(line_of(learnt, {"cross-validated"}).c_str(), "  cross-validated (each run told by the others): rms %lf", &rms);
  EXPECT_GT(rms, 0.0);
  EXPECT_LT(rms, 0.02 * pressure[410]) << learnt;
  std::istringstream row(line_of(learnt, {"garment.pattern.flat_circumference [m]"}));
  std::string key, unit;
  double mean = 0.0, from = 0.0, to = 0.0, slope = 0.0;
  row >> key >> unit >> mean >> from >> to >> slope;
  EXPECT_NEAR(mean, 0.41, 1e-9);
  EXPECT_NEAR(slope, (pressure[420] - pressure[400]) / 0.02, 0.02 * std::abs(slope)) << learnt;
  EXPECT_EQ(learnt, snug("materials regress 'Front thigh' --quadratic --unit Pa --on flat_circumference").text);
  expect("materials regress 'Front thigh' --on flat_circumference,RT --quadratic", 2, "a property is the same in all runs");
  expect("materials regress 'Front thigh' --on flat_circumferense", 2, "did you mean flat_circumference");
  expect("materials regress 'Frnt thigh'", 2, "did you mean Front thigh");
  expect("materials regress comfort --project mien", 2, "did you mean mine?");
}

TEST_F(ProjectProgram, ASuggestionIsVerifiedByRunsAndItsErrorTold) {
  // For 3 gf/cm2 on the front of the thigh: the runs of the best come within a few percent of it, the error of the guess is that between what was said
  // and what the runs gave, and they are recorded.
  ASSERT_EQ(snug("new mine --like thigh-sleeve").status, 0);
  const std::string among = "--among 'id = N85L15 or id = P98L2 or id = N88P' ";
  const std::string said = expect("materials suggest --for mine --target 'Front thigh = 3 gf/cm2' --verify 2 --tier L1 --set body.cells_around=12 --set body.cells_along=4 --set 'garment.cell_size=\"25 mm\"' " + among, 0, "verified by running");
  int verified = 0;
  double worst = 0.0;
  for (const auto& entry : fs::directory_iterator(folder_ / "mine/suggested")) {
    if (entry.path().filename() == "as-it-is" || !fs::exists(entry.path() / "summary.json")) continue;
    const double found = summary("mine/suggested/" + entry.path().filename().string())["locations"][0]["mean_pressure_Pa"].get<double>() / 98.0665;
    EXPECT_NEAR(found, 3.0, 0.3) << entry.path();
    worst = std::max(worst, std::abs(3.0 / found - 1.0));
    line_of(said.substr(said.find("verified")), {entry.path().filename().string(), fmt::format("{:.3g}", found)});
    ++verified;
  }
  EXPECT_EQ(verified, 2) << said;
  double told = 0.0;
  std::sscanf(said.substr(said.find("error of the guess: ")).c_str(), "error of the guess: %lf", &told);
  EXPECT_LE(told, 100.0 * worst + 0.5) << said;
  EXPECT_NE(said.find("rms over 2 pressures"), std::string::npos) << said;
  line_of(snug("project show mine").text, {"suggested: "});
  expect("materials suggest --for mine --target 'Front tigh = 3 gf/cm2' " + among, 2, "did you mean Front thigh");
  expect("materials suggest --for mine --target 'Front thigh = 3'", 2, "is no target");
  expect("materials suggest --for mine --target 'Front thigh = 3 gf/cm2' --among 'weight < 1 g/m2'", 2, "no fabric of the library");
}

TEST_F(ProjectProgram, ASuggestionIsForPatternsAndForOneOfSeveralGarments) {
  // Where the case itself is of tier L0 the guess is the run: no error. The widths of a vest that the case names as a text, and the bandage alone of bandage and
  // stocking; a graduated tube is for snug design.
  ASSERT_EQ(snug("new top --like vest").status, 0);
  const std::string vest = expect("materials suggest --for top --tier L0 --target 'Chest = 2 gf/cm2' --among 'id = E95C' --verify 1", 0, "widths of the pattern");
  line_of(vest.substr(vest.find("verified")), {"E95C", "Chest", "+0.0 %"});
  ASSERT_EQ(snug("new leg --like sleeve-over-sleeve").status, 0);
  const std::string target = "materials suggest --for leg --tier L0 --target 'Under the bandage = 9 gf/cm2' --among 'id = C98L2' --verify 1";
  expect(target, 2, "--garment names one of stocking, bandage");
  const std::string bandage = expect(target + " --garment bandage", 0, "circumference as cut");
  line_of(bandage.substr(bandage.find("verified")), {"C98L2", "Under the bandage", "+0.0 %"});
  line_of(snug("project trace 4 'Under the bandage'").text, {"garment.stocking.fabric = P98L2 of the library"});
  ASSERT_EQ(snug("new graduated --like stocking").status, 0);
  expect("materials suggest --for graduated --target 'calf = 2 gf/cm2'", 2, "snug design finds them");
}

}  // namespace
}  // namespace snug
