#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "cases/input/csv.hpp"
#include "cases/input/suggestion.hpp"
#include "cases/input/units.hpp"

namespace snug::input {
namespace {

double si(const std::string& text, const std::string& unit) {
  const Quantity quantity = to_si(text, unit);
  EXPECT_TRUE(quantity.ok()) << quantity.found;
  return quantity.value;
}

TEST(Units, OfTextilesAndClinicsAreKnown) {
  // Units that fabric sheets, KES reports and compression standards use convert to SI by their definitions.
  const double gf = 9.80665e-3, degree = std::numbers::pi / 180;
  EXPECT_DOUBLE_EQ(si("0.57 mm", "m"), 0.57e-3);
  EXPECT_NEAR(si("20 gf/cm2", "Pa"), 20 * gf / 1e-4, 1e-9);
  EXPECT_NEAR(si("20 gf/cm^2", "Pa"), 20 * gf / 1e-4, 1e-9);
  EXPECT_NEAR(si("0.77 gf/(cm degree)", "N/(m rad)"), 0.77 * gf / 1e-2 / degree, 1e-9);
  EXPECT_NEAR(si("0.77 gf/(cm·degree)", "N/(m rad)"), 0.77 * gf / 1e-2 / degree, 1e-9);
  EXPECT_NEAR(si("8.5 gf·cm/cm²", "J/m2"), 8.5 * gf * 1e-2 / 1e-4, 1e-9);
  EXPECT_NEAR(si("0.05 gf cm2/cm", "N m"), 0.05 * gf * 1e-2, 1e-12);
  EXPECT_NEAR(si("500 gf/cm", "N/m"), 500 * gf / 1e-2, 1e-9);
  EXPECT_NEAR(si("15 mmHg", "Pa"), 15 * 133.322, 0.02);
  EXPECT_DOUBLE_EQ(si("10 kPa", "Pa"), 1e4);
  EXPECT_NEAR(si("35 deg", "rad"), 35 * degree, 1e-12);
  EXPECT_NEAR(si("35°", "rad"), 35 * degree, 1e-12);
  EXPECT_NEAR(si("100 dyn/cm", "N/m"), 0.1, 1e-15);
  EXPECT_NEAR(si("180 g/m2", "kg/m2"), 0.18, 1e-12);
  EXPECT_DOUBLE_EQ(si("1e3 N / m", "N/m"), 1000);
  EXPECT_DOUBLE_EQ(si("-5mm", "m"), -5e-3);
}

TEST(Units, StiffnessesPerAngleAreReadAsSheetsPrintThem) {
  // The product behind the last slash of a printed unit divides, where the dimension leaves no other reading.
  const double centinewton_per_cm_degree = 1e-2 / 1e-2 * 180.0 / std::numbers::pi;  // N/(m rad)
  for (const char* unit : {"cN/(cm deg)", "cN/cm.deg", "cN/cm·deg", "cN/cm⋅degree", "cN/cm degrees", "cN/cm/°", "cN cm-1 deg-1", "cN·cm⁻¹·deg⁻¹",
                           "cN/cm*deg.", "cN/cm º", "cN/cm\u00a0deg"})
    EXPECT_NEAR(si(std::string("2.5 ") + unit, "N/(m rad)"), 2.5 * centinewton_per_cm_degree, 1e-9) << unit;
  EXPECT_NEAR(si("3 mN/mm·rad", "N/(m rad)"), 3.0, 1e-12);
  EXPECT_NEAR(si("40 N/50 mm", "N/m"), 800.0, 1e-9);  // a strip of 50 mm
  EXPECT_NEAR(si("40 N/5cm", "N/m"), 800.0, 1e-9);
  EXPECT_NEAR(si("12 cN.cm2/cm", "N m"), 12e-2 * 1e-2, 1e-12);
  EXPECT_NEAR(si("9 μN·m", "N m"), 9e-6, 1e-18);
  EXPECT_NEAR(si("175 gsm", "kg/m2"), 0.175, 1e-12);
}

TEST(Units, AnAngleIsNoPlainNumber) {
  // What lacks the angle, or has one too many, is refused with what it is likely to be.
  for (const char* text : {"30 N/m", "2 cN/cm", "1 gf deg/cm", "3 N/(m deg2)", "1 gf cm/deg"}) EXPECT_FALSE(to_si(text, "N/(m rad)").ok()) << text;
  EXPECT_NE(to_si("2 cN/cm", "N/(m rad)").found.find("a force per length"), std::string::npos);
  EXPECT_NE(to_si("2 mN/mm.rad", "N/m").found.find("per radian it is \"2 N/m\""), std::string::npos) << to_si("2 mN/mm.rad", "N/m").found;
  EXPECT_FALSE(to_si("5 m/m", "rad").ok());
  EXPECT_FALSE(to_si("5 rad/m", "1/m").ok());
  EXPECT_FALSE(to_si("7 gf cm2", "N m").ok());  // a bending stiffness that is not per width
  EXPECT_NE(to_si("5 g/cm.deg", "N/(m rad)").found.find("write \"gf/cm.deg\""), std::string::npos) << to_si("5 g/cm.deg", "N/(m rad)").found;
}

TEST(Units, WrongTextsAreRefusedWithTheReason) {
  // A text that is no quantity of the dimension says why.
  EXPECT_NE(to_si("5", "m").found.find("has no unit"), std::string::npos);
  EXPECT_NE(to_si("mm", "m").found.find("does not begin with a number"), std::string::npos);
  EXPECT_NE(to_si("0,57 mm", "m").found.find("is not a unit"), std::string::npos);
  EXPECT_NE(to_si("5 furlongz", "m").found.find("is not a unit"), std::string::npos);
  EXPECT_NE(to_si("5 kPa", "m").found.find("is not a length"), std::string::npos);
  EXPECT_FALSE(to_si("", "m").ok());
}

TEST(Units, ANumberBehindTheLastSlashIsDividedByWithItsUnit) {
  // A force per width at a share of stretch: both readings have the dimension, and a sheet means one of them.
  for (const char* unit : {"N/cm/25 %", "N/cm / 25 %", "N/cm per 25%", "N per cm/25 %"}) EXPECT_NEAR(si(std::string("3 ") + unit, "N/m"), 300.0 / 0.25, 1e-9) << unit;
  EXPECT_NEAR(si("3 N per 40 mm", "N/m"), 75.0, 1e-9);
  EXPECT_NEAR(si("20 mmHg/4", "Pa"), 5 * 133.322, 0.01);
}

TEST(Units, OfMillsAndOfPeopleInAHurryAreKnown) {
  EXPECT_NEAR(si("7 oz/yd2", "kg/m2"), 7 * 0.028349523125 / (0.9144 * 0.9144), 1e-12);  // avoirdupois ounce and yard by definition
  EXPECT_NEAR(si("190 GSM", "kg/m2"), 0.19, 1e-12);
  EXPECT_NEAR(si("190 gm/m2", "kg/m2"), 0.19, 1e-12);
  EXPECT_NEAR(si("18 MMHG", "Pa"), si("18 mmHg", "Pa"), 1e-12);
  EXPECT_NEAR(si("12\"", "m"), 0.3048, 1e-12);
  EXPECT_NEAR(si("2 cN/ cm . deg", "N/(m rad)"), si("2 cN/(cm deg)", "N/(m rad)"), 1e-9);
  EXPECT_NE(to_si("4 lb/in", "N/m").found.find("write \"lbf/in\""), std::string::npos) << to_si("4 lb/in", "N/m").found;
}

TEST(Units, TwoNumbersWhereOneIsDueAreToldApart) {
  // A decimal comma, a range and a deviation are each refused with what to write.
  EXPECT_NE(to_si("1,5 kPa", "Pa").found.find("\"1.5 kPa\""), std::string::npos) << to_si("1,5 kPa", "Pa").found;
  for (const char* range : {"15-20 mmHg", "15 - 20 mmHg", "15..20 mmHg", "15 to 20 mmHg", "15 – 20 mmHg"}) EXPECT_NE(to_si(range, "Pa").found.find("a range"), std::string::npos) << range;
  for (const char* deviation : {"15 ± 2 mmHg", "15 +- 2 mmHg", "15+/-2 mmHg"}) EXPECT_NE(to_si(deviation, "Pa").found.find("its deviation"), std::string::npos) << deviation;
  EXPECT_EQ(to_si("15 mmHg-", "Pa").found.find("a range"), std::string::npos);
}

TEST(Suggestion, NearestNameIsFound) {
  // A misspelt name finds the one that was meant, and a foreign one finds none.
  EXPECT_EQ(nearest("ficton", {"friction", "basis"}), "friction");
  EXPECT_EQ(nearest("N85l15", {"N85L15", "R95C"}), "N85L15");
  EXPECT_EQ(nearest("zzz", {"friction", "basis"}), "");
  EXPECT_EQ(edit_distance("gril", "girl"), 1);
}

class CsvFile : public testing::Test {
 protected:
  Csv read(const std::string& text) {
    const auto path = std::filesystem::temp_directory_path() / ("snug-csv-" + std::to_string(::getpid()) + ".csv");
    std::ofstream(path) << text;
    Csv csv = read_csv(path, diagnostics_, "limb.csv");
    std::filesystem::remove(path);
    return csv;
  }
  Diagnostics diagnostics_;
};

TEST_F(CsvFile, ColumnsArriveInSi) {
  // Units stand in the head; comments and empty lines do not count.
  const Csv csv = read("# a limb\n\nheight [cm], girth [mm], ratio, name\n1, 500, 0.9, \"a, b\"\n2, 510, 1, c\n");
  EXPECT_EQ(numbers(csv, "height", "m", diagnostics_), (std::vector<double>{0.01, 0.02}));
  EXPECT_EQ(numbers(csv, "ratio", "", diagnostics_), (std::vector<double>{0.9, 1.0}));
  EXPECT_EQ(texts(csv, "name", diagnostics_), (std::vector<std::string>{"a, b", "c"}));
  EXPECT_FALSE(optional_numbers(csv, "depth", "m", diagnostics_));
  EXPECT_FALSE(diagnostics_.any());
}

TEST(Units, ReciprocalsAndOffsetsAreNoFactors) {
  // A length is not given by a curvature, nor a temperature difference by a reading of a thermometer.
  double factor = 0.0;
  for (const auto& [from, to] : {std::pair{"1/m", "m"}, {"m/N", "N/m"}, {"degC", "K"}}) EXPECT_FALSE(unit_factor(from, to, factor)) << from;
  ASSERT_TRUE(unit_factor("1/mm", "1/m", factor));
  EXPECT_DOUBLE_EQ(factor, 1000.0);
}

TEST_F(CsvFile, NumbersAreWhole) {
  // A unit or anything else behind the number of a cell is an error and not left out.
  const Csv csv = read("girth [mm]\n500 mm\n5x\n5;1\n0x10\n");
  numbers(csv, "girth", "m", diagnostics_);
  EXPECT_EQ(diagnostics_.errors().size(), 4u);
}

TEST_F(CsvFile, TitlesOverTheHeadArePassedOver) {
  // An instrument's export: names and settings, the head, its units, numbers in quotes. Lines without numbers below are no titles.
  const Csv csv = read("Method,strip\nWidth,40,mm\n\n\"Time\",\"Load\",\"Strain\"\n\"(s)\",\"(N)\",\"(%)\"\n\"0\",\"0\",\"0\"\n\"1\",\"2.5\",\"8\"\n");
  EXPECT_EQ(numbers(csv, "load", "N", diagnostics_), (std::vector<double>{0.0, 2.5}));
  EXPECT_EQ(csv.rows[1].line, 7);
  const Csv semicolons = read("Herr X\nheight;girth\ncm;cm\n0;24,5\n5;26\n");
  EXPECT_EQ(numbers(semicolons, "girth", "m", diagnostics_), (std::vector<double>{0.245, 0.26}));
  EXPECT_FALSE(diagnostics_.any());
}

TEST_F(CsvFile, DecimalCommasInQuotesAreNumbers) {
  // As spreadsheets of other countries write tables with commas between the columns; "1,234" alone could be a thousand.
  const Csv csv = read("height [cm],girth [cm]\n\"0\",\"24,5\"\n\"5,25\",\"26\"\n");
  EXPECT_EQ(numbers(csv, "height", "m", diagnostics_), (std::vector<double>{0.0, 0.0525}));
  EXPECT_FALSE(diagnostics_.any());
  read("height [mm],girth [mm]\n\"0\",\"1,245\"\n");
  EXPECT_TRUE(diagnostics_.any());
}

TEST_F(CsvFile, UnitsStandAtTheEndOfKnownNamesAndInchesAsMarks) {
  Csv csv = read("height_cm,girth in,width_to_depth,bone (\")\n1,10,0.9,2\n");
  take_units_from_names(csv, {"height", "girth", "width_to_depth"});
  EXPECT_EQ(numbers(csv, "height", "m", diagnostics_), (std::vector<double>{0.01}));
  EXPECT_EQ(numbers(csv, "girth", "m", diagnostics_), (std::vector<double>{0.254}));
  EXPECT_EQ(numbers(csv, "width_to_depth", "", diagnostics_), (std::vector<double>{0.9}));
  EXPECT_NEAR(numbers(csv, "bone", "m", diagnostics_).at(0), 0.0508, 1e-15);
  EXPECT_FALSE(diagnostics_.any());
}

TEST_F(CsvFile, AColumnThatIsThereTwiceIsRefusedWhereItIsRead) {
  // Of two specimens side by side the first would be taken without a word.
  const Csv csv = read("strain [%],force [N],strain [%],force [N],note,note\n0,0,0,0,a,b\n");
  EXPECT_TRUE(numbers(csv, "force", "N", diagnostics_).empty());
  ASSERT_EQ(diagnostics_.errors().size(), 1u);
  EXPECT_EQ(diagnostics_.errors()[0].where.column, 33);
}

TEST_F(CsvFile, BlanksThatDoNotBreakAreBlanks) {
  const Csv csv = read("height\u00a0[mm],girth\u202f[mm]\n\u00a05,\u2009310\n");
  EXPECT_EQ(numbers(csv, "girth", "m", diagnostics_), (std::vector<double>{0.31}));
  EXPECT_FALSE(diagnostics_.any());
}

TEST_F(CsvFile, ErrorsAreAtTheirCells) {
  // Missing columns, units, numbers and cells are errors at line and column of the file.
  const Csv csv = read("height, girth [kPa]\n1, nan\n2\n3, x\n");
  numbers(csv, "height", "m", diagnostics_);
  numbers(csv, "girth", "m", diagnostics_);
  numbers(csv, "girth", "Pa", diagnostics_);
  numbers(csv, "depth", "m", diagnostics_);
  std::vector<std::string> places;
  for (const Diagnostic& error : diagnostics_.errors())
    places.push_back(std::to_string(error.where.line) + ":" + std::to_string(error.where.column));
  EXPECT_EQ(places, (std::vector<std::string>{"3:1", "1:1", "1:9", "2:4", "4:4", "1:1"}));
}

}  // namespace
}  // namespace snug::input
