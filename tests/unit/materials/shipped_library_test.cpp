// What ships in the library, against the tables as they were printed (tests/data/library, one CSV file a table).
#include <gmock/gmock.h>

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "cases/input/csv.hpp"
#include "materials/database/doubts.hpp"
#include "materials/database/evaluation.hpp"
#include "materials/database/shipped.hpp"
#include "materials/fabric/fabric.hpp"
#include "materials/laws/solid_law.hpp"
#include "tests/unit/materials/library_under_test.hpp"

namespace snug::testing {
namespace {

using materials::Datum, materials::Entity, materials::Kind, materials::Library;
using ::testing::ElementsAre, ::testing::HasSubstr;

class ShippedLibrary : public LibraryTest {
 protected:
  static input::Csv printed(const std::string& table) {
    input::Diagnostics diagnostics;
    input::Csv csv =
        input::read_csv(std::filesystem::path(SNUG_SOURCE_DIR) / "tests/data/library" / (table + ".csv"), diagnostics);
    diagnostics.throw_if_any();
    return csv;
  }
  static std::string cell(const input::Csv& csv, std::size_t row, const std::string& column) {
    return csv.rows[row].cells.at(static_cast<std::size_t>(csv.find(column)));
  }
  /// The datum of a source, by the digits that were printed.
  static const Datum* datum(const Entity& entity, const std::string& item, const std::string& digits,
                            const std::string& source) {
    for (const Datum& one : entity.data)
      if (one.name == item && one.value == digits && one.source.find(source) != std::string::npos) return &one;
    return nullptr;
  }
  static void expect_printed(const Entity& entity, const std::string& item, const std::string& digits,
                             double si_per_unit, const std::string& source) {
    const Datum* found = datum(entity, item, digits, source);
    ASSERT_NE(found, nullptr) << entity.id << " " << item << " " << digits << " of " << source;
    ASSERT_TRUE(found->si) << entity.id << " " << item;
    double number = 0.0;
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    EXPECT_NEAR(*found->si, number * si_per_unit, 1e-14 * std::abs(number * si_per_unit)) << entity.id << " " << item;
  }
};

constexpr double gravity = 9.80665, one_degree = 3.14159265358979323846 / 180.0;

TEST_F(ShippedLibrary, EveryNumberOfTables25And26ComesBackAsPrintedAndInSi) {
  // Size of each printed unit in SI, by hand: kgf = 9.80665 N.
  struct Column {
    const char *column, *item, *source;
    double si;
  };
  const std::vector<Column> products = {{"weight_g_per_m2", "weight", "table 2.5", 1e-3},
                                        {"ends_per_cm", "ends", "table 2.5", 100.0},
                                        {"picks_per_cm", "picks", "table 2.5", 100.0},
                                        {"warp_count_ntex", "warp count", "Ntex", 1.0},
                                        {"weft_count_ntex", "weft count", "Ntex", 1.0},
                                        {"warp_cover_factor", "warp cover factor", "table 2.5", 1.0},
                                        {"weft_cover_factor", "weft cover factor", "table 2.5", 1.0},
                                        {"warp_crimp_percent", "warp crimp", "table 2.5", 0.01},
                                        {"weft_crimp_percent", "weft crimp", "table 2.5", 0.01}};
  const std::vector<Column> fabrics = {
      {"density_kg_per_m3", "density", "table 2.6", 1.0}, {"EA_kgf_per_m2", "EA", "table 2.6", gravity},
      {"EB_kgf_per_m2", "EB", "table 2.6", gravity},      {"poisson_BA", "poisson_BA", "table 2.6", 1.0},
      {"GAB_kgf_per_m2", "GAB", "table 2.6", gravity},    {"thickness_mm", "thickness", "", 1e-3}};
  const Library library = open();
  const input::Csv of_products = printed("table_2_5"), of_fabrics = printed("table_2_6");
  ASSERT_EQ(of_products.rows.size(), 9u);
  for (std::size_t r = 0; r < 9; ++r) {
    const Entity fabric = library.entity(cell(of_products, r, "fabric_id")),
                 garment = library.entity(cell(of_products, r, "garment_id"));
    EXPECT_EQ(fabric.parent, garment.id);
    EXPECT_EQ(garment.find("commercial name")->value, cell(of_products, r, "commercial_name"));
    expect_printed(garment, "price", cell(of_products, r, "price_dollar"), 1.0, "$");
    for (const Column& one : products)
      expect_printed(fabric, one.item, cell(of_products, r, one.column), one.si, one.source);
    for (const char* text : {"structure", "picture", "composition"})
      EXPECT_EQ(fabric.find(text)->value, cell(of_products, r,
                                               std::string(text) == "structure" ? "structure"
                                               : std::string(text) == "picture" ? "fabric_image_id"
                                                                                : "fibre_composition"));
    ASSERT_EQ(cell(of_fabrics, r, "fabric_id"), fabric.id);
    for (const Column& one : fabrics)
      expect_printed(fabric, one.item, cell(of_fabrics, r, one.column), one.si, one.source);
    EXPECT_EQ(fabric.find("warp curve")->value, cell(of_fabrics, r, "warp_curve_id"));
    EXPECT_EQ(fabric.find("weft curve")->value, cell(of_fabrics, r, "weft_curve_id"));
  }
}

TEST_F(ShippedLibrary, EveryNumberOfTables51To71ComesBackWithItsDeviationAndItsTable) {
  const std::map<std::string, double> si = {{"1", 1.0},
                                            {"%", 0.01},
                                            {"mm", 1e-3},
                                            {"g/m2", 1e-3},
                                            {"gf/cm", 1e-3 * gravity / 1e-2},
                                            {"gf.cm/cm2", 1e-3 * gravity / 1e-2},
                                            {"gf.cm2/cm", 1e-3 * gravity * 1e-2},
                                            {"gf.cm/cm", 1e-3 * gravity},
                                            {"gf/cm/degree", 1e-3 * gravity / 1e-2 / one_degree}};
  const Library library = open();
  int count = 0;
  for (const auto& [file, source, id, item] : {std::tuple{"table_5_2", "table 5.2", "fabric", "kes_symbol"},
                                               std::tuple{"table_7_1", "table 7.1", "fabric", "symbol"}}) {
    const input::Csv csv = printed(file);
    for (std::size_t r = 0; r < csv.rows.size(); ++r, ++count) {
      const Entity fabric = library.entity(cell(csv, r, id));
      expect_printed(fabric, cell(csv, r, item), cell(csv, r, "mean"), si.at(cell(csv, r, "unit")), source);
      EXPECT_EQ(datum(fabric, cell(csv, r, item), cell(csv, r, "mean"), source)->uncertainty, cell(csv, r, "sd"));
    }
  }
  EXPECT_EQ(count, 88 + 33);
  const input::Csv weights = printed("table_5_1");
  for (std::size_t r = 0; r < weights.rows.size(); ++r) {
    const Entity fabric = library.entity(cell(weights, r, "fabric"));
    expect_printed(fabric, "weight", cell(weights, r, "weight_g_per_m2"), 1e-3, "table 5.1");
    expect_printed(fabric, "thickness", cell(weights, r, "thickness_mm"), 1e-3, "table 5.1");
    EXPECT_EQ(fabric.find("composition")->value, cell(weights, r, "content"));
  }
}

TEST_F(ShippedLibrary, ContradictionsOfTwoTablesAreTwoSources) {
  // Tables 5.2 and 7.1 print WT of P98L2 as 6.28 and 6.27, B of C98L2 as 0.03 and 0.02.
  const Library library = open();
  const auto values = [&](const std::string& id, const std::string& item) {
    std::vector<std::string> texts;
    const Entity entity = library.entity(id);
    for (const Datum& one : entity.data)
      if (one.name == item) texts.push_back(one.value + " of " + one.source);
    return texts;
  };
  EXPECT_THAT(values("P98L2", "WT"), ElementsAre("6.28 of table 5.2", "6.27 of table 7.1"));
  EXPECT_THAT(values("C98L2", "B"), ElementsAre("0.03 of table 5.2", "0.02 of table 7.1"));
}

TEST_F(ShippedLibrary, WeightOverThicknessOfTheDenimsIsTheirDensity) {
  // Of all nine within 0.6 % (B11 of the notes on the source: 489.8/492, 456.7/455, ...).
  const Library library = open();
  const auto denims = library.find_where("structure = \"3x1 twill\"");
  EXPECT_EQ(denims.size(), 9u);
  for (const std::string& id : denims) {
    const Entity fabric = library.entity(id);
    const double density = *fabric.find("density")->si;
    EXPECT_NEAR(*fabric.find("weight")->si / *fabric.find("thickness")->si / density, 1.0, 0.006) << id;
  }
}

TEST_F(ShippedLibrary, NumbersThatDoNotGoTogetherAreDoubted) {
  // Nothing that ships; then a density a tenth off, a work that is not LT Fm EMT/2 (0.9 * 50 gf/cm * 40 %/2 = 9 gf
  // cm/cm2), a value outside its range.
  const Library library = open();
  for (const std::string& id : library.ids())
    EXPECT_THAT(materials::doubts_of(library.entity(id)), ElementsAre()) << id;
  EXPECT_THAT(
      materials::doubts_of(fabric("a", "weight = \"200 g/m2\"\nthickness = \"0.5 mm\"\ndensity = \"440 kg/m3\"")),
      ElementsAre(HasSubstr("is 400 kg/m3, the density 440")));
  const std::string test = "LT = 0.9\nFm = \"50 gf/cm\"\nEMT = \"40 %\"\n";
  EXPECT_THAT(materials::doubts_of(fabric("a", test + "WT = \"9.2 gf cm/cm2\"")), ElementsAre());
  EXPECT_THAT(materials::doubts_of(fabric("a", test + "WT = \"10 gf cm/cm2\"")),
              ElementsAre(HasSubstr("WT is 9.807 J/m2, LT Fm EMT/2 8.826 J/m2")));
  EXPECT_THAT(materials::doubts_of(fabric("a", "LT = { value = \"1.3\", range = [\"0.8\", \"1.2\"] }")),
              ElementsAre("LT = 1.3 is outside its range, 0.8 to 1.2"));
}

TEST_F(ShippedLibrary, AStripTestsFileIsNoNameOfAFabricAndTheRemedyIsItsCurve) {
  // What the program looks names up with used to list all fabrics, of which none is meant. Other names, also with a dot, are still compared with those known.
  const auto resolve = [&](const std::string& name, Kind kind) {
    return error_of([&] { materials::resolved({.name = name, .table = {}, .where = {"case.toml", 18, 10}}, kind, file_); });
  };
  for (const char* name : {"wale.csv", "tests/Wale 1.CSV", "course.xlsx"}) {
    const std::string said = resolve(name, Kind::fabric);
    EXPECT_THAT(said, HasSubstr("case.toml:18:10: error: \"" + std::string(name) + "\" is a file, and no fabric is called so"));
    EXPECT_THAT(said, HasSubstr("fabric = { law = \"curve\", warp = \"" + std::string(name) + "\""));
  }
  EXPECT_THAT(resolve("N85L16", Kind::fabric), HasSubstr("no fabric is called \"N85L16\""));
  EXPECT_THAT(resolve("N85.L15", Kind::fabric), HasSubstr("did you mean N85L15"));
  EXPECT_THAT(resolve("fat.csv", Kind::tissue), HasSubstr("no tissue is called"));
}

TEST_F(ShippedLibrary, StiffnessOfTheDenimsIsModulusTimesThickness) {
  // 001-01: 431.5, 414.2, 113.7 N/m; 009-01: 254.2, 635.5, 121.1 N/m (B11).
  const materials::Fabric first = materials::find_fabric(materials::resolved({.name = "001-01"}, Kind::fabric, {}));
  EXPECT_NEAR(first.warp.at(0.0).stiffness, 431.5, 0.05);
  EXPECT_NEAR(first.weft.at(0.0).stiffness, 414.2, 0.05);
  EXPECT_NEAR(first.shear, 113.7, 0.05);
  EXPECT_NEAR(first.coupling, 0.38 * 414.2, 0.05);
  const materials::Fabric last = materials::find_fabric(materials::resolved({.name = "009-01"}, Kind::fabric, {}));
  EXPECT_NEAR(last.warp.at(0.0).stiffness, 254.2, 0.05);
  EXPECT_NEAR(last.weft.at(0.0).stiffness, 635.5, 0.05);
  EXPECT_NEAR(last.shear, 121.1, 0.05);
  EXPECT_FALSE(std::filesystem::exists(file_)) << "a name that ships asks no library";
}

TEST_F(ShippedLibrary, WhatARunReadsStandsInTheLibraryWithTheSameDigits) {
  // The entity of each fabric and tissue, as the table that its law reads, gives the values of materials/data to the
  // last bit.
  const Library library = open();
  for (const std::string& name : materials::fabric_names()) {
    const auto entry =
        input::MaterialEntry{.name = {}, .table = materials::law_table(library.entity(name), library.units())};
    const input::Table plain = input::table_of(materials::shipped_fabrics);
    for (const input::Entry& one : plain.table(name)->entries) {
      if (one.key == "assumptions") continue;
      const input::Value* found = entry.table.find(one.key);
      ASSERT_NE(found, nullptr) << name << " " << one.key;
      double a = 0.0, b = 0.0;
      if (const auto* text = one.value.text())
        EXPECT_EQ(*found->text(), *text) << name << " " << one.key;
      else
        EXPECT_EQ(*found->number(a), *one.value.number(b)) << name << " " << one.key;
    }
  }
  for (const std::string& name : materials::tissue_names()) {
    const materials::Tissue by_name = materials::find_tissue({.name = name});
    const materials::Tissue by_values =
        materials::find_tissue({.name = {}, .table = materials::law_table(library.entity(name), library.units())});
    EXPECT_EQ(by_name.density, by_values.density);
    EXPECT_EQ(by_name.shear_range, by_values.shear_range) << name;
    EXPECT_EQ(materials::initial_shear_modulus(by_name.law), materials::initial_shear_modulus(by_values.law)) << name;
    EXPECT_EQ(materials::initial_youngs_modulus(by_name.law), materials::initial_youngs_modulus(by_values.law)) << name;
    EXPECT_EQ(by_name.source, by_values.source);
  }
}

TEST_F(ShippedLibrary, QuestionsOfTheSource) {
  // B8: weight < 250 g/m2 and LT > 1 of the eight fabrics.
  const Library library = open();
  EXPECT_THAT(library.find_where("weight < 250 g/m2"), ElementsAre("C98L2", "N85L15", "P98L2", "E95C"));
  EXPECT_THAT(library.find_where("LT > 1"), ElementsAre("N88P", "E95C", "A92Np", "N95C"));
  EXPECT_THAT(library.find_where("weight < 250 g/m2 and EMT > 30 %"), ElementsAre("N85L15", "P98L2"));
}

TEST_F(ShippedLibrary, TheSurfaceVolumeRatioIsAValueAndAnEquation) {
  // Table 2.8: 1000 /m at first; then 2 (eps_a/eps)(eps_f delta/R_f), delta = (eps_l/eps)^m. By hand, with eps_a = 0.4,
  // eps = 0.8, eps_f = 0.2, eps_l = 0.2, m = 0.5, R_f = 0.01 mm: delta = 0.5, 2 * 0.5 * 0.2 * 0.5/1e-5 m = 10000 /m.
  const Library library = open();
  const Entity woven = library.entity("woven fabric of table 2.8");
  const auto no_file = [](const std::string&) { return std::string(); };
  EXPECT_EQ(woven.find("surface volume ratio")->si, 1000.0);
  materials::Given given = {{"eps_a", "0.4"}, {"eps", "0.8"}, {"eps_f", "20 %"},
                            {"eps_l", "0.2"}, {"m", "0.5"},   {"R_f", "0.01 mm"}};
  EXPECT_NEAR(materials::evaluate(woven, "S'_v", given, library.units(), no_file).si, 10000.0, 1e-8);
  EXPECT_NEAR(materials::evaluate(woven, "delta", given, library.units(), no_file).si, 0.5, 1e-15);
  given.erase("R_f");
  EXPECT_THAT(error_of([&] { materials::evaluate(woven, "S'_v", given, library.units(), no_file); }),
              HasSubstr("needs R_f"));
  given["R_f"] = "3 kg";
  EXPECT_THAT(error_of([&] { materials::evaluate(woven, "S'_v", given, library.units(), no_file); }),
              HasSubstr("dimension of fibre radius"));
}

TEST_F(ShippedLibrary, ThePrintedFactorOfTheSurfaceVolumeRatioIsRefused) {
  // B12: with C*(T), kg/m3, the product comes to kg/m4 and not to 1/m.
  Library library = open();
  Entity woven = library.entity("woven fabric of table 2.8");
  woven.id = "mine";
  woven.data.push_back(
      {.name = "saturated vapour concentration", .symbol = "C_sat", .value = "0.0173", .unit = "kg/m3"});
  for (Datum& one : woven.data)
    if (one.name == "surface volume ratio" && one.type == materials::DatumType::equation) one.value += "*C_sat";
  EXPECT_THAT(error_of([&] { add(library, woven); }), HasSubstr("comes to (kg/m3) m^-1, its unit is \"1/m\""));
  EXPECT_FALSE(library.find("mine"));
}

TEST_F(ShippedLibrary, TheTensileTestIsAValueAndATable) {
  // Tables 2.9 and 2.10: 50 gf/cm, and 32 points, between which the force is monotone and through which it goes.
  const Library library = open();
  const Entity woven = library.entity("woven fabric of table 2.9");
  EXPECT_NEAR(*woven.find("weft tensile test")->si, 50.0 * 0.980665, 1e-12);
  const auto content = [&](const std::string& hash) { return library.file(hash).content; };
  const input::Csv csv = printed("table_2_9");
  double last = -1.0;
  for (std::size_t r = 0; r < csv.rows.size(); ++r) {
    const double force = std::stod(cell(csv, r, "force_gf"));
    EXPECT_NEAR(
        materials::evaluate(woven, "weft tensile test", {{"elongation", cell(csv, r, "elongation_percent") + " %"}},
                            library.units(), content)
            .in_unit,
        force, 1e-9);
  }
  for (double percent = 0.0; percent <= 3.1; percent += 0.01) {
    const double force = materials::evaluate(woven, "weft tensile test",
                                             {{"elongation", std::to_string(percent) + " %"}}, library.units(), content)
                             .si;
    EXPECT_GE(force, last);
    last = force;
  }
  EXPECT_THAT(error_of([&] {
                materials::evaluate(woven, "weft tensile test", {{"elongation", "3.2 %"}}, library.units(), content);
              }),
              HasSubstr("outside the points"));
}

TEST_F(ShippedLibrary, EveryMeasuredSiteOfTheLimbsComesBackWithItsQuartiles) {
  const Library library = open();
  const input::Csv csv = printed("limb_indentation");
  ASSERT_EQ(csv.rows.size(), 8u);
  for (std::size_t r = 0; r < csv.rows.size(); ++r) {
    const Entity site = library.entity(cell(csv, r, "place") + " of 95 persons");
    for (const auto& [column, item, si] :
         {std::tuple{"probe_area_mm2", "probe area", 1e-6}, std::tuple{"skin_mm", "skin thickness", 1e-3},
          std::tuple{"fat_mm", "fat thickness", 1e-3}, std::tuple{"muscle_mm", "muscle thickness", 1e-3},
          std::tuple{"total_mm", "soft tissue thickness", 1e-3}, std::tuple{"force_max_N", "largest force", 1.0},
          std::tuple{"displacement_mm", "largest displacement", 1e-3},
          std::tuple{"stiffness_N_per_mm", "indentation stiffness", 1e3},
          std::tuple{"shear_modulus_kPa", "shear_modulus", 1e3}})
      expect_printed(site, item, cell(csv, r, column), si, "");
    EXPECT_EQ(site.find("shear_modulus")->low, cell(csv, r, "shear_modulus_q25"));
    EXPECT_EQ(site.find("shear_modulus")->high, cell(csv, r, "shear_modulus_q75"));
    EXPECT_EQ(site.find("indentation stiffness")->low, cell(csv, r, "stiffness_q25"));
    EXPECT_EQ(site.find("indentation stiffness")->high, cell(csv, r, "stiffness_q75"));
  }
}

TEST_F(ShippedLibrary, GirthsOfASizeFollowFromThoseOfTheAverageOneByTheRuleThatTheirHeaderTells) {
  // x (1 + r (neck/neck0 - 1)), rounded to millimetres; the numbers of size 34 are those of the source (FreeSewing, models).
  const Library library = open();
  const auto mm = [&](int size, const char* item) { return 1e3 * *library.find(fmt::format("woman of size {}", size))->find(item)->si; };
  EXPECT_NEAR(mm(34, "upper leg girth"), 570.0, 1e-9);
  EXPECT_NEAR(mm(34, "ankle girth"), 245.0, 1e-9);
  for (int size = 28; size <= 46; size += 2)
    for (const auto& [item, r] : {std::pair{"ankle girth", 1.0}, std::pair{"waist", 0.85}, std::pair{"knee girth", 0.65}, std::pair{"upper leg girth", 0.45}, std::pair{"inseam", 0.25}})
      EXPECT_NEAR(mm(size, item), mm(34, item) * (1.0 + r * (size / 34.0 - 1.0)), 0.5 + 1e-9) << size << " " << item;
  EXPECT_THAT(library.find_where("\"upper leg girth\" > 67 cm"), ElementsAre("man of size 46", "man of size 48", "man of size 50"));
}

TEST_F(ShippedLibrary, TextAndLibraryAgreeAndADifferenceIsTold) {
  materials::UnitBook units;
  materials::Entries shipped = materials::shipped_entries(units);
  const Library library = open();
  EXPECT_THAT(library.differences(shipped), ElementsAre());
  shipped.entities.front().data.back().value += "1";
  shipped.entities.pop_back();
  EXPECT_EQ(library.differences(shipped).size(), 2u);
}

TEST_F(ShippedLibrary, WhatShipsIsBroughtUpToDateAndOwnDataStay) {
  // An edition with another weight and one entity more: the file follows; an own item and an own entity of the new ID
  // stay, the latter renamed.
  {
    Library library = open();
    add(library, fabric("N100", "weight = \"100 g/m2\""));
    library.change([](materials::Stroke& stroke) {
      Entity entity = stroke.entity("N88P");
      entity.data.push_back({.name = "hand", .value = "soft"});
      stroke.put(entity, "added an item");
    });
  }
  materials::Library::Settings later = materials::library_settings(file_, "tester");
  later.edition = "later";
  later.shipped = [](materials::UnitBook& units) {
    materials::Entries entries = materials::shipped_entries(units);
    for (Datum& one : entries.entities.front().data)
      if (one.name == "weight") one.value = "281.0", one.si.reset();
    entries.entities.push_back(
        {.kind = Kind::fabric, .id = "N100", .data = {{.name = "weight", .value = "120", .unit = "g/m2"}}});
    return entries;
  };
  const Library library{later};
  EXPECT_NEAR(*library.entity("N88P").find("weight")->si, 0.281, 1e-15);
  EXPECT_EQ(library.entity("N88P").find("hand")->value, "soft");
  EXPECT_EQ(library.entity("N100").find("weight")->value, "120");
  EXPECT_EQ(library.entity("N100 own").find("weight")->value, "100");
}

}  // namespace
}  // namespace snug::testing
