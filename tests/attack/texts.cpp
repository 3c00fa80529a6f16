// Texts of users: long, deep, odd ones in, and none that another program would take for a command out.
#include <nlohmann/json.hpp>

#include "cases/input/csv.hpp"
#include "cases/input/files.hpp"
#include "cases/input/table.hpp"
#include "cases/input/units.hpp"
#include "postproc/grid.hpp"
#include "postproc/tables.hpp"
#include "solver/app/study/study_files.hpp"
#include <sys/stat.h>

#include "tests/attack/attack.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int n = 0; n < times; ++n) all += text;
  return all;
}

/// What is wrong with TOML text; empty: nothing.
std::string fault(const std::string& toml) {
  input::Diagnostics diagnostics;
  input::parse_text(toml, {"case.toml", 1, 1}, diagnostics);
  try {
    diagnostics.throw_if_any();
  } catch (const input::InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Texts, DeepAndLongTomlIsRefusedWithItsLine) {
  // Brackets in brackets, also after a text with an escaped quote or a long text, long keys and lines: told with the line, in time.
  const std::string deep = "x = " + repeated("[", 300) + repeated("]", 300) + "\n";
  for (const std::string before : {"a = \"b\\\"\"\n", "a = 'b\\'\n", "a = \"\"\"\n\"q\" # \"\"\"\n", "a = '''it's'''\n", "# \"\n"})
    EXPECT_NE(fault(before + deep).find("nested more than"), std::string::npos) << before << fault(before + deep);
  EXPECT_NE(fault("t = 1\n" + repeated("a.", 3000) + "b = 1\n").find("case.toml:2:"), std::string::npos);
  EXPECT_NE(fault(repeated("\"" + repeated(" ", 9000) + "\" = 1\n", 2)), "");
  EXPECT_NE(fault(repeated("\"" + repeated(" ", 50000) + "\" = 1\n", 2)).find("a line of more than"), std::string::npos);
  EXPECT_EQ(fault("a = \"[[[[\" # [[[\nb = '''\n[[[[[\n'''\nc = [1.5, 2.5, 3.5]\n"), "");
  EXPECT_EQ(fault("list = [" + repeated("1.5, ", 3000) + "]\n"), "");  // points of numbers are none of a key
}

TEST(Texts, UnitsOfAnyLengthAreToldInTime) {
  // Blanks in a unit: 300,000 of them used to end the program.
  double factor = 0.0;
  EXPECT_FALSE(input::unit_factor("m" + repeated(" ", 300000) + "m", "m", factor));
  EXPECT_TRUE(input::unit_factor("gf  /  cm2", "Pa", factor));
  EXPECT_NEAR(factor, 98.0665, 1e-9);
  EXPECT_NEAR(input::to_si("90 deg", "rad").value, 1.5707963267948966, 1e-12);
  EXPECT_NEAR(input::to_si("2 1/deg", "1/rad").value, 114.59155902616465, 1e-9);
  EXPECT_FALSE(input::to_si("2 degx", "rad").ok());
}

TEST(Texts, LongCellsAreNotEchoedWhole) {
  // A message shows the two ends of what is too long to read, and no control character that a terminal would obey.
  input::Diagnostics diagnostics;
  diagnostics.error({"a.csv", 2, 1}, "\"" + repeated("x", 2'000'000) + "\" is no number", "give a number");
  diagnostics.error({"a.csv", 3, 1}, "\"\x1b[2J\" is no number", "give a number");
  try {
    diagnostics.throw_if_any();
    FAIL();
  } catch (const input::InputError& error) {
    EXPECT_LT(std::string(error.what()).size(), 2000u);
    EXPECT_NE(std::string(error.what()).find("is no number"), std::string::npos);
    EXPECT_EQ(std::string(error.what()).find('\x1b'), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("\\x1b[2J"), std::string::npos);
  }
}

TEST_F(Attack, PipesAndDevicesAreNotWaitedFor) {
  // A pipe or a device in the place of a file: status 2 with its name at once.
  ASSERT_EQ(snug("new mine --like limb-alone").status, 0);
  for (const std::string file : {"mine/case.toml", "mine/body/tube.csv"}) {
    fs::rename(folder_ / file, folder_ / "kept");
    ASSERT_EQ(::mkfifo((folder_ / file).c_str(), 0600), 0);
    Outcome outcome = bounded("check mine");
    EXPECT_EQ(outcome.status, 2) << outcome.text;
    fs::remove(folder_ / file);
    fs::create_symlink("/dev/zero", folder_ / file);
    outcome = bounded("check mine --allow-outside");
    EXPECT_EQ(outcome.status, 2) << outcome.text;
    fs::remove(folder_ / file);
    fs::rename(folder_ / "kept", folder_ / file);
  }
}

TEST_F(Attack, PathsThatCannotBeAreTheInputs) {
  // Names too long and links in a circle end with status 2, not as a fault of snug.
  ASSERT_EQ(snug("new mine --like limb-alone").status, 0);
  EXPECT_EQ(bounded("check " + repeated("a", 5000)).status, 2);
  EXPECT_EQ(bounded("check mine --set body.stations=" + repeated("a", 5000) + ".csv").status, 2);
  fs::create_symlink("loop.csv", folder_ / "mine/body/loop.csv");
  EXPECT_EQ(bounded("check mine --set body.stations=body/loop.csv").status, 2);
  EXPECT_EQ(bounded("run mine --out " + repeated("a", 5000)).status, 2);
}

TEST_F(Attack, ACaseTooLargeForTheMachineIsRefusedBeforeMeshing) {
  // Cells and triangles are reckoned first: status 2 at once, with numbers that would fit.
  ASSERT_EQ(snug("new mine --like tube-sleeve").status, 0);
  Outcome outcome = bounded("check mine --set body.cells_around=720 --set body.cells_along=720 --set body.layers.tissue.cells=40");
  EXPECT_EQ(outcome.status, 2) << outcome.text;
  EXPECT_NE(outcome.text.find("cells_around = "), std::string::npos) << outcome.text;
  outcome = bounded("check mine --set 'garment.pattern.flat_circumference=\"1000000 m\"'");
  EXPECT_EQ(outcome.status, 2) << outcome.text;
  EXPECT_NE(outcome.text.find("cell_size = "), std::string::npos) << outcome.text;
  outcome = bounded("check mine --set 'garment.cell_size=\"0.001 mm\"'");
  EXPECT_EQ(outcome.status, 2) << outcome.text;
  EXPECT_EQ(snug("check mine --memory 0.3").status, 2);
  EXPECT_EQ(snug("check mine --memory 8").status, 0);
}

TEST(Texts, ASeriesNamesFilesOfItsOwnFolder) {
  // A PVD with a long name, a name elsewhere or a time that is none is refused with its line.
  const fs::path pvd = fs::temp_directory_path() / ("snug-series-" + std::to_string(::getpid()) + ".pvd");
  const auto series = [&](const std::string& time, const std::string& file) {
    std::ofstream(pvd) << "<VTKFile>\n<Collection>\n<DataSet timestep=\"" + time + "\" group=\"\" part=\"0\" file=\"" + file + "\"/>\n</Collection>\n";
    return postproc::read_series(pvd);
  };
  EXPECT_EQ(series("0.5", "states/body_0000.vtu").at(0).time, 0.5);
  for (const std::string& file : {repeated("x", 500'000), std::string("../x.vtu"), std::string("/etc/passwd"), std::string()}) {
    try {
      series("0.5", file);
      ADD_FAILURE() << file.substr(0, 40);
    } catch (const input::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(":3:"), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(series("soon", "a.vtu"), input::InputError);
  fs::remove(pvd);
}

TEST(Texts, CellsOfTablesAreNoFormulas) {
  // A spreadsheet runs what begins with = + - @: such a text stands behind an apostrophe.
  EXPECT_EQ(postproc::csv_cell("=cmd|' /C calc'!A0"), "'=cmd|' /C calc'!A0");
  EXPECT_EQ(postproc::csv_cell("@SUM(1,2)"), "\"'@SUM(1,2)\"");
  EXPECT_EQ(postproc::csv_cell("+1"), "'+1");
  EXPECT_EQ(postproc::csv_cell("a; b"), "a; b");
  EXPECT_EQ(postproc::csv_cell("a; b", ",;"), "\"a; b\"");
  EXPECT_EQ(postproc::csv_cell("Front thigh"), "Front thigh");
}

TEST(Texts, NamesReachGnuplotAsData) {
  // Titles and series stand in single quotes, in which gnuplot runs nothing; what is drawn is drawn all the same.
  const fs::path folder = fs::temp_directory_path() / ("snug-plot-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::vector<app::StudyRow> rows(2);
  for (std::size_t n = 0; n < 2; ++n) {
    rows[n].series = "it's `touch ran` \"$(touch ran)\", =x\n", rows[n].level = "1", rows[n].status = "converged";
    rows[n].wall = 1.0 + static_cast<double>(n), rows[n].memory = 1e8, rows[n].unknowns = 100.0, rows[n].errors.mean_pressure = 0.1;
  }
  app::write_study_csv(rows, folder / "study.csv");
  app::write_study_plot(rows, "innocent `touch ran` title', '\n!touch ran\n", folder / "study.gp");
  std::ifstream in(folder / "study.gp");
  const std::string script{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(script.find("\n!touch"), std::string::npos) << script;
  EXPECT_NE(script.find("'it''s `touch ran`"), std::string::npos) << script;
  if (std::system("command -v gnuplot > /dev/null") == 0) {
    EXPECT_EQ(std::system(("cd '" + folder.string() + "' && gnuplot study.gp > log 2>&1").c_str()), 0);
    EXPECT_TRUE(fs::exists(folder / "study.svg"));
  }
  EXPECT_FALSE(fs::exists(folder / "ran"));
  fs::remove_all(folder);
}

TEST_F(Attack, ThePageOfDamagedResultsIsTheInputs) {
  // Grids, tables and JSON in a folder of results that are cut short or not as a run writes them: status 2, with the file.
  ASSERT_EQ(snug("new mine --like tube-sleeve").status, 0);
  ASSERT_EQ(snug(std::string("run mine --tier L1") + coarse).status, 0);
  const std::map<std::string, std::vector<std::string>> damage = {
      {"body_0000.vtu", {text("mine/out/body_0000.vtu").substr(0, 3000), "<VTKFile type=\"UnstructuredGrid\">", "nonsense", ""}},
      {"skin.csv", {"node\n99999999\n", "node\n-1\n", "node\nnan\n", "x"}},
      {"summary.json", {"{}", "[]", "{\"status\": 3}", "nonsense", "{\"numbers\": 7}", ""}},
      {"history.csv", {"increment,load\n1,x\n"}},
      {"body.pvd", {"<DataSet timestep=\"x\" file=\"y\"/>", "<DataSet timestep=\"0\" file=\"../../../etc/passwd\"/>"}}};
  for (const auto& [name, contents] : damage) {
    const std::string whole = text("mine/out/" + name);
    for (const std::string& content : contents) {
      put("mine/out/" + name, content);
      const Outcome outcome = bounded("report mine/out --no-pictures");
      EXPECT_EQ(outcome.status, 2) << name << ": " << content.substr(0, 40) << " -> " << outcome.text;
      EXPECT_NE(outcome.text.find("error: "), std::string::npos) << outcome.text;
    }
    put("mine/out/" + name, whole);
  }
  EXPECT_EQ(snug("report mine/out --no-pictures").status, 0);
}

TEST_F(Attack, NamesOfPlacesCannotEndTheScriptOfThePage) {
  // A location called <!--<script> or </script> stands in the page as text; the data of the view are JSON still.
  ASSERT_EQ(snug("new mine --like tube-sleeve").status, 0);
  std::string toml = text("mine/case.toml");
  toml += "\n[[body.locations]]\nname = \"<!--<script></script>\"\nfrom_angle = \"0 deg\"\nto_angle = \"180 deg\"\n";
  put("mine/case.toml", toml);
  ASSERT_EQ(snug(std::string("run mine --tier L1") + coarse).status, 0);
  const std::string page = text("mine/out/report.html"), opening = "id=\"surfaces\">";
  const std::size_t begin = page.find(opening) + opening.size(), end = page.find("</script>", begin);
  const std::string data = page.substr(begin, end - begin);
  EXPECT_EQ(data.find('<'), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(data).at("skin").at("locations").at(0), "<!--<script></script>");
  EXPECT_EQ(page.find("<!--<script>"), std::string::npos);
}

}  // namespace
}  // namespace snug
