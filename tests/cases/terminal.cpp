// What programs and shells read of the program: documents, completion, the manual; and what people read on a terminal and in a log.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cases/program.hpp"
#include "solver/app/wrapping.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Contains, testing::HasSubstr, testing::Not;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::size_t widest(const std::string& text) {
  std::size_t most = 0;
  for (const std::string& line : lines_of(text)) most = std::max(most, app::columns_of(line));
  return most;
}

TEST(Wrapping, GoesOnBelowTheLastColumnAndKeepsWordsAndTables) {
  // A row with a column of text goes on below it; words are never broken, and none is lost; a row whose last column begins late stays as it is.
  const std::string row = "  warning            one two three four five six seven eight nine ten eleven twelve";
  const std::string broken = app::wrapped(row, 50);
  ASSERT_GE(lines_of(broken).size(), 2u);
  for (const std::string& line : lines_of(broken)) EXPECT_LE(app::columns_of(line), 50u) << line;
  EXPECT_EQ(lines_of(broken)[1].find_first_not_of(' '), row.find("one"));
  std::istringstream words(broken), before(row);
  for (std::string a, b; words >> a, before >> b;) EXPECT_EQ(a, b);
  const std::string table = "  Ankle   100 %    347    3.54    2.60    460   1.23 comfortable and a text at the end";
  EXPECT_EQ(app::wrapped(table, 60), table);
  const std::string path = "files: /a/very/long/path/that/no/line/of/this/terminal/has/room/for/case.toml";
  EXPECT_THAT(app::wrapped(path, 40), HasSubstr("/a/very/long/path/that/no/line/of/this/terminal/has/room/for/case.toml"));
  EXPECT_EQ(app::wrapped("ä ö ü ß\n", 7), "ä ö ü ß\n");  // columns, not bytes
  EXPECT_EQ(app::wrapped(row, 0), row);
  EXPECT_EQ(app::wrapped("a length of 12.5 mm, 3 %", 16), "a length of\n    12.5 mm, 3 %");  // a number and its unit stay together
}

class Terminal : public Program {
 protected:
  /// Standard output of a command alone; what went to standard error is lost.
  json document(const std::string& arguments, int status = 0) const {
    const Outcome outcome = shell(std::string("'") + SNUG_BINARY + "' " + arguments + " 2> /dev/null");
    EXPECT_EQ(outcome.status, status) << arguments;
    const json answer = json::parse(outcome.text, nullptr, false);
    EXPECT_FALSE(answer.is_discarded()) << arguments << "\n" << outcome.text;
    EXPECT_EQ(answer.value("exit_status", -1), status);
    return answer;
  }
  /// On a terminal of so many columns.
  std::string on_terminal(const std::string& arguments, int columns) const {
    const std::string command = "COLUMNS=" + std::to_string(columns) + " script -qec \"'" + SNUG_BINARY + "' " + arguments + "\" /dev/null < /dev/null";
    std::string text = Outcome(shell(command)).text;
    std::erase(text, '\r');
    return text;
  }
  Outcome shell(const std::string& line) const {
    write("line.sh", line + "\n");
    return snug("", "bash line.sh || exit $?; true ");
  }
};

TEST_F(Terminal, EveryCommandAnswersProgramsWithOneDocument) {
  // --json gives one document whatever the command, with its name, exit status, warnings and errors.
  ASSERT_EQ(snug("new mine --like calf-sleeve").status, 0);
  const json check = document("check mine --json");
  const json& first = check.at("cases").at(0);
  EXPECT_EQ(check.at("command"), "check");
  EXPECT_TRUE(first.at("right").get<bool>());
  EXPECT_EQ(first.at("plan").at("tier"), "L4");
  EXPECT_NEAR(first.at("garments").at(0).at("mean_girth_as_cut_m").get<double>(), 0.205, 1e-9);  // case.toml: 205 mm
  EXPECT_TRUE(check.at("errors").empty());
  EXPECT_THAT(document("materials list --json").at("fabrics").get<std::vector<std::string>>(), Contains("N85L15"));
  EXPECT_EQ(document("explain garment.position --json").at("keys").at(0).at("unit"), "m");
  EXPECT_EQ(document("list curves --json").at("command"), "list");
  const json show = document("materials show N85L15 --json");
  EXPECT_EQ(show.at("entity").at("id"), "N85L15");
  const json found = document("materials find \"weight < 250 g/m2\" --items weight --json").at("entities");
  ASSERT_FALSE(found.empty());
  EXPECT_LT(found.at(0).at("data").at(0).at("value_SI").get<double>(), 0.25);  // kg/m2
  const json run = document("run mine --tier L0 --json").at("runs").at(0);
  EXPECT_EQ(run.at("summary").at("status"), "converged");
  EXPECT_EQ(document("report mine/out --no-pictures --json").at("files").at(0), "mine/out/report.html");
  EXPECT_EQ(document("project list --json").at("command"), "project list");
}

TEST_F(Terminal, ErrorsAreInTheDocumentWithTheirPlace) {
  // Wrong input, a wrong option and a missing directory: one document each, with file, line and remedy where there are such.
  ASSERT_EQ(snug("new mine --like calf-sleeve").status, 0);
  const json typo = document("check mine --set garment.pattern.flat_circumfrence=\"200 mm\" --json", 2);
  EXPECT_FALSE(typo.at("cases").at(0).at("right").get<bool>());
  EXPECT_THAT(typo.at("errors").at(0).at("remedy").get<std::string>(), HasSubstr("did you mean flat_circumference"));
  EXPECT_THAT(document("run nowhere --json", 2).at("errors").at(0).at("file").get<std::string>(), HasSubstr("nowhere"));
  EXPECT_THAT(document("check mine --alow-outside --json", 2).at("errors").at(0).at("text").get<std::string>(), HasSubstr("did you mean --allow-outside"));
  EXPECT_THAT(shell(std::string("'") + SNUG_BINARY + "' check nowhere --json 2>&1 > /dev/null").text, HasSubstr("nowhere"));  // people still read it
}

TEST_F(Terminal, NoLineIsWiderThanTheTerminalAndNoRecordIsBrokenInALog) {
  // At 80 columns help, plan, errors and results fit, but for paths and tables; in a file a record is one line without codes of a terminal.
  ASSERT_EQ(snug("new mine --like calf-sleeve").status, 0);
  for (const std::string command : {"--help", "run --help", "size --help", "materials --help", "compare --help", "explain garment", "check mine", "run mine --tier L0 --no-report", "list curves",
                                    "check mine --set garment.patern=3"}) {
    const std::string text = on_terminal(command, 80);
    EXPECT_FALSE(text.empty()) << command;
    EXPECT_LE(widest(text), 80u) << command << "\n" << text;
  }
  const std::string log = snug("check mine --set garment.patern=3").text;
  EXPECT_EQ(lines_of(log).size(), 1u) << log;
  EXPECT_THAT(snug("run mine --tier L0 --no-report").text, Not(HasSubstr("\033")));
}

TEST_F(Terminal, MisspeltWordsBelowACommandAreTold) {
  // As those of the first level: a command of a group, and an option of it.
  EXPECT_THAT(snug("materials fnd \"weight < 1\"").text, HasSubstr("did you mean snug materials find?"));
  EXPECT_THAT(snug("materials find --kidn fabric \"weight < 1\"").text, HasSubstr("did you mean --kind?"));
}

TEST_F(Terminal, RanksWriteNoCodesOfATerminalIntoALog) {
  // mpirun gives a rank a terminal of its own; what it writes to is the launcher's.
  fs::copy(fs::path(SNUG_SOURCE_DIR) / "cases/verification/tube-sleeve", folder_ / "tube", fs::copy_options::recursive);
  const Outcome outcome = snug("run tube --tier L1 --no-report --ranks 2 --set body.cells_around=8");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("increment"));
  EXPECT_THAT(outcome.text, Not(HasSubstr("\033")));
}

TEST_F(Terminal, ShellsCompleteCommandsOptionsKeysAndFolders) {
  // What bash completes comes from the program's own commands and from the keys of its cases.
  const auto completed = [&](const std::string& line) {
    std::string words;
    int count = 0;
    std::istringstream in(line);
    for (std::string word; in >> word; ++count) words += " '" + word + "'";
    if (line.ends_with(" ")) words += " ''", ++count;
    return lines_of(shell("source <('" SNUG_BINARY "' completion bash)\nCOMP_WORDS=(" + words + ")\nCOMP_CWORD=" + std::to_string(count - 1) + "\n_snug\nprintf '%s\\n' \"${COMPREPLY[@]}\"").text);
  };
  EXPECT_THAT(completed("snug ru"), Contains("run"));
  EXPECT_THAT(completed("snug run --swe"), Contains("--sweep"));
  EXPECT_THAT(completed("snug run --set garment.posi"), Contains("garment.position="));
  EXPECT_THAT(completed("snug materials fi"), Contains("find"));
  EXPECT_THAT(completed("snug materials find --kind ti"), Contains("tissue"));
  EXPECT_THAT(completed("snug explain garment.posi"), Contains("garment.position"));
  fs::create_directories(folder_ / "my-case");
  EXPECT_THAT(completed("snug check my-"), Contains("my-case"));
  for (const std::string shell : {"zsh", "fish"}) EXPECT_THAT(snug("completion " + shell).text, HasSubstr("garment.position"));
  EXPECT_EQ(snug("completion tcsh").status, 2);
}

TEST_F(Terminal, TheManualHasEveryCommandWithItsOptions) {
  // Commands and options of the help stand in the page of man(1), which man reads without complaint.
  const std::string page = snug("man").text;
  for (const std::string part : {".TH SNUG 1", "snug run", "snug materials find", "snug completion", "\\-\\-sweep", ".SH EXIT STATUS"}) EXPECT_THAT(page, HasSubstr(part));
  write("snug.1", page);
  const std::string complaints = shell("command -v groff > /dev/null && groff -K utf8 -man -Tutf8 -ww snug.1 2>&1 > /dev/null").text;
  EXPECT_TRUE(complaints.empty()) << complaints;
}

}  // namespace
}  // namespace snug
