#include <gtest/gtest.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/input/echo.hpp"
#include "materials/fabric/fabric.hpp"
#include "materials/laws/solid_law.hpp"

namespace snug::testing {
namespace {

using input::InputError, input::MaterialEntry;
using materials::Fabric, materials::find_fabric, materials::find_tissue, materials::NeoHooke;

MaterialEntry named(const std::string& name) { return {.name = name, .table = {}, .where = {"case.toml", 7, 12}}; }
MaterialEntry inline_entry(const std::string& text) {
  const input::Location where{"case.toml", 7, 12};
  return {.name = {}, .table = input::table_of(text, where), .where = where};
}
std::string error_of(auto&& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}
double nominal(const materials::TensionCurve& curve, double e) { return (1 + e) * curve.at(e + 0.5 * e * e).force; }

TEST(Data, EveryEntryCanBeRead) {
  // Each shipped tissue and fabric reads, names its source and what was assumed, and lies in its own range.
  EXPECT_EQ(materials::fabric_names().size(), 8u);
  for (const auto& name : materials::fabric_names()) {
    const Fabric f = find_fabric(named(name));
    EXPECT_EQ(f.name, name);
    EXPECT_NE(f.source.find("assumed: "), std::string::npos) << name;
    EXPECT_GT(f.warp.smallest_stiffness(), 0.0) << name;
    EXPECT_LT(f.coupling, f.warp.smallest_stiffness()) << name;
    EXPECT_GT(f.areal_density, 0.1) << name;
    EXPECT_GT(f.bending.warp, 0.0) << name;
  }
  for (const auto& name : materials::tissue_names()) {
    const auto tissue = find_tissue(named(name));
    const double mu = initial_shear_modulus(tissue.law);
    EXPECT_GE(mu, tissue.shear_range[0]) << name;
    EXPECT_LE(mu, tissue.shear_range[1]) << name;
    EXPECT_FALSE(tissue.source.empty()) << name;
  }
}

TEST(Data, WearTrialFabric) {
  // N85L15 (LT 1.00, WT 10.02 gf cm/cm2, EMT 43.26 %, G 0.66 gf/(cm degree)): Fm = 2 WT/(LT EMT) = 46.325 gf/cm,
  // straight to Fm at EMT, shear 0.66 * 56.18796562 N/m per rad.
  const Fabric f = find_fabric(named("N85L15"));
  const double Fm = 2 * 10.02 / 0.4326 * 0.980665;
  EXPECT_NEAR(nominal(f.warp, 0.4326), Fm, 1e-9 * Fm);
  EXPECT_NEAR(nominal(f.weft, 0.2163), 0.5 * Fm, 1e-9 * Fm);
  EXPECT_NEAR(f.warp.at(0.4326 + 0.5 * 0.4326 * 0.4326).energy, 10.02 * 0.980665, 1e-9);
  EXPECT_NEAR(f.shear, 0.66 * 56.18796562, 1e-6);
  EXPECT_NEAR(f.areal_density, 0.215, 1e-12);
  EXPECT_NEAR(f.thickness, 0.57e-3, 1e-15);
  EXPECT_NEAR(f.bending.warp, 0.02 * 9.80665e-5, 1e-15);
  EXPECT_NEAR(f.coupling, 0.2 * f.warp.smallest_stiffness(), 1e-12);
}

TEST(Data, FmIsAssumedWhereEmtIsNotPrinted) {
  // A92Np reaches 50 gf/cm at EMT = 2 WT/(LT Fm); its concave curve (LT = 1.14) is kept to the end of its data.
  const Fabric f = find_fabric(named("A92Np"));
  const double em = 2 * 8.79 / (1.14 * 50);
  EXPECT_NEAR(nominal(f.warp, em), 50 * 0.980665, 1e-9);
  EXPECT_NEAR(f.warp.data_end(), em + 0.5 * em * em, 1e-12);
}

TEST(Data, TissuesHoldWhatTheirSourcesPrint) {
  // mu = 2 C10 and kappa as printed: thigh 111 kPa, skin 666.67 kPa, fat 66.67 kPa; bone E = 7 GPa.
  const auto law = [](const char* name) { return std::get<NeoHooke>(find_tissue(named(name)).law); };
  EXPECT_NEAR(law("relaxed thigh").shear_modulus, 2 * 2750.0, 1e-9);
  EXPECT_NEAR(law("relaxed thigh").initial_bulk_modulus(), 111e3, 1e3);
  EXPECT_NEAR(law("skin").shear_modulus, 8e3, 1e-9);
  EXPECT_NEAR(law("skin").initial_bulk_modulus(), 666.67e3, 5e3);
  EXPECT_NEAR(law("fat").shear_modulus, 0.8e3, 1e-9);
  EXPECT_NEAR(law("fat").initial_bulk_modulus(), 66.67e3, 500);
  EXPECT_NEAR(initial_youngs_modulus(find_tissue(named("bone")).law), 7e9, 1e6);
}

TEST(Data, OgdenSetsHoldWhatTheirSourcesPrint) {
  // Heel pad: mu = 0.001084 MPa is the shear modulus at rest; skin: mu_1 = 10 Pa with alpha 40 makes 200 Pa.
  EXPECT_NEAR(materials::initial_shear_modulus(find_tissue(named("stiffening fat")).law), 1084.0, 0.5);
  EXPECT_NEAR(materials::initial_shear_modulus(find_tissue(named("stiffening skin")).law), 200.0, 1e-9);
  EXPECT_NEAR(materials::initial_shear_modulus(find_tissue(named("fat in vivo")).law), 3040.0, 1e-9);   // Chakouch et al. 2015, abstract
  EXPECT_NEAR(materials::initial_shear_modulus(find_tissue(named("skin in vivo")).law), 43000.0, 1e-9);  // E = 129 kPa
}

TEST(Data, EveryLawCanBeWrittenInline) {
  // Each law reads from a table; the pair of moduli may be the bulk modulus, and the volumetric form is taken.
  using namespace materials;
  const auto law = [](const std::string& text) { return find_tissue(inline_entry(text)).law; };
  const auto mooney = law(
      R"({ law = "Mooney-Rivlin", C10 = "4 kPa", C01 = "1 kPa", bulk_modulus = "500 kPa", volumetric = "quadratic" })");
  EXPECT_NEAR(initial_shear_modulus(mooney), 10e3, 1e-9);
  EXPECT_NEAR(initial_bulk_modulus(mooney), 500e3, 1e-9);
  EXPECT_EQ(std::get<MooneyRivlin>(mooney).volume.form, VolumetricForm::quadratic);
  const auto ogden = law(
      R"({ law = "Ogden", terms = [{ mu = "5 kPa", alpha = 3 }, { mu = "-2 kPa", alpha = -2.5 }], poisson_ratio = 0.49, volumetric = "logarithmic" })");
  EXPECT_NEAR(initial_shear_modulus(ogden), 10e3, 1e-9);
  EXPECT_EQ(std::get<Ogden>(ogden).volume.form, VolumetricForm::logarithmic);
  const auto fung = law(R"({ law = "Fung", shear_modulus = "10 kPa", stiffening = 3, poisson_ratio = 0.49 })");
  EXPECT_EQ(std::get<Fung>(fung).stiffening, 3.0);
  EXPECT_EQ(std::get<Fung>(fung).volume.form, VolumetricForm::barrier);
  const auto foam = law(R"({ law = "compressible-neo-Hooke", shear_modulus = "10 kPa", poisson_ratio = 0.3 })");
  EXPECT_NEAR(initial_youngs_modulus(foam), 26e3, 1e-8);
  EXPECT_NEAR(std::get<CompressibleNeoHooke>(foam).lame_parameter, 15e3, 1e-9);
  EXPECT_NEAR(
      initial_shear_modulus(law(R"({ law = "linear-elastic", youngs_modulus = "26 kPa", poisson_ratio = 0.3 })")), 10e3,
      1e-9);
}

TEST(Data, WrongLawsSayWhatToWrite) {
  // What is no stable solid, or a law for the wrong element, is refused at its place with a remedy.
  struct Wrong {
    std::string table, place, remedy;
  };
  const std::vector<Wrong> all = {
      {R"({ law = "neo-Hooke", shear_modulus = "-1 kPa", poisson_ratio = 0.49 })", "7:49", "greater than 0 Pa"},
      {R"({ law = "neo-Hooke", shear_modulus = "1 kPa", poisson_ratio = 0.5 })", "7:74", "less than 0.5"},
      {R"({ law = "neo-Hooke", shear_modulus = "1 kPa" })", "7:12", "write one of them"},
      {R"({ law = "neo-Hooke", shear_modulus = "1 kPa", poisson_ratio = 0.4, bulk_modulus = "9 kPa" })", "7:12",
       "write one of them"},
      {R"({ law = "neo-Hooke", shear_modulus = "9 kPa", bulk_modulus = "5 kPa" })", "7:58", "two thirds"},
      {R"({ law = "Ogdn", terms = [] })", "7:20", "Ogden"},
      {R"({ law = "Ogden", terms = [], poisson_ratio = 0.49 })", "7:29", "at least one"},
      {R"({ law = "Ogden", terms = [{ mu = "1 kPa", alpha = -2 }], poisson_ratio = 0.49 })", "7:29", "sum of mu alpha"},
      {R"({ law = "Ogden", terms = [{ mu = "1 kPa", alpha = 0 }], poisson_ratio = 0.49 })", "7:", "leave it out"},
      {R"({ law = "Mooney-Rivlin", C10 = "1 kPa", C01 = "-1 kPa", poisson_ratio = 0.49 })", "7:", "at least 0 Pa"},
      {R"({ law = "Fung", shear_modulus = "1 kPa", stiffening = 0, poisson_ratio = 0.49 })", "7:", "greater than 0"},
      {R"({ law = "neo-Hooke", shear_modulus = "1 kPa", poisson_ratio = 0.4, volumetric = "barier" })",
       "7:", "barrier"},
      {R"({ law = "linear-elastic", youngs_modulus = "1 GPa", poisson_ratio = 0.4999 })", "7:", "law with split"},
      {R"({ law = "compressible-neo-Hooke", shear_modulus = "1 kPa", bulk_modulus = "1 MPa" })",
       "7:", "law with split"}};
  for (const Wrong& wrong : all) {
    const std::string error = error_of([&] { find_tissue(inline_entry(wrong.table)); });
    EXPECT_NE(error.find("case.toml:" + wrong.place), std::string::npos) << wrong.table << "\n" << error;
    EXPECT_NE(error.find(wrong.remedy), std::string::npos) << wrong.table << "\n" << error;
  }
  const std::string membrane = error_of([] { materials::find_membrane_tissue(named("bone")); });
  EXPECT_NE(membrane.find("case.toml:7:12"), std::string::npos) << membrane;
}

TEST(Data, UnknownNamesGetTheNearestOne) {
  // A misspelt entry is an error at its place that names the nearest known one.
  const std::string tissue = error_of([] { find_tissue(named("relaxed claf")); });
  EXPECT_NE(tissue.find("case.toml:7:12"), std::string::npos) << tissue;
  EXPECT_NE(tissue.find("relaxed calf"), std::string::npos) << tissue;
  const std::string fabric = error_of([] { find_fabric(named("N85L16")); });
  EXPECT_NE(fabric.find("N85L15"), std::string::npos) << fabric;
}

TEST(Data, InlineTissue) {
  // A table of the case's own values is a tissue.
  const auto tissue =
      find_tissue(inline_entry(R"toml({ law = "neo-Hooke", shear_modulus = "10 kPa", poisson_ratio = 0.49 })toml"));
  EXPECT_DOUBLE_EQ(initial_shear_modulus(tissue.law), 10e3);
  EXPECT_NEAR(initial_bulk_modulus(tissue.law), 1490e3 / 3, 1e-8);
}

TEST(Data, InlineFabrics) {
  // Linear, cubic and KES tables, in one line or several, are fabrics; units are converted, a weft of its own is taken.
  const Fabric linear = find_fabric(inline_entry(
      R"toml({ law = "linear", warp = "1000 N/m", weft = "300 N/m", shear = "250 N/m", poisson = 0.5 })toml"));
  EXPECT_NEAR(linear.warp.at(0.1).force, 100, 1e-12);
  EXPECT_NEAR(linear.weft.at(0.1).force, 30, 1e-12);
  EXPECT_NEAR(linear.coupling, 150, 1e-12);
  EXPECT_NEAR(linear.shear, 250, 1e-12);
  const Fabric cubic =
      find_fabric(inline_entry(R"toml({ law = "cubic", k1 = "100 N/m", k3 = "2000 N/m", shear = "50 N/m" })toml"));
  EXPECT_NEAR(nominal(cubic.weft, 0.2), 20 + 16, 1e-12);
  const Fabric kes = find_fabric(inline_entry(
      R"toml(law = "kes"
             LT = 0.7
             WT = "12 gf cm/cm2"
             Fm = "500 gf/cm"
             G = "0.8 gf/(cm degree)"
             weft = { LT = 0.9, WT = "5 gf cm/cm2", Fm = "500 gf/cm" })toml"));
  EXPECT_NEAR(kes.warp.at(0).stiffness, 2379.713952, 1e-6);
  EXPECT_NEAR(kes.weft.at(0).stiffness, 16071.336829, 1e-6);
  EXPECT_NEAR(kes.shear, 44.950372, 1e-6);
}

TEST(Data, TheEchoOfACaseHasTheShearStiffnessOfAKesTestInSi) {
  // G = 0.6 gf/cm.deg as KES prints it: 0.6 * 9.80665e-3 N / 0.01 m / (pi/180 rad) = 33.7128 N/m per rad; a factor of 57.3 less without the degree.
  const double per_radian = 0.6 * 0.980665 * 180.0 / std::numbers::pi;
  input::Case asked;
  asked.garments.emplace_back().fabric = inline_entry(
      R"toml({ law = "kes", LT = 0.9, WT = "8.2 gf.cm/cm^2", EMT = 40, G = "0.6 gf/cm.deg" })toml");
  const std::string echo = input::echo_text(asked, [](const input::Field& field, const MaterialEntry& entry) {
    return field.key == "fabric" ? std::optional(materials::written_out_fabric(entry)) : std::nullopt;
  });
  const std::size_t at = echo.find("G = \"");
  ASSERT_NE(at, std::string::npos) << echo;
  const std::string written = echo.substr(at + 5, echo.find('"', at + 5) - at - 5);
  EXPECT_TRUE(written.ends_with(" N/(m rad)")) << written;
  EXPECT_NEAR(std::stod(written), per_radian, 1e-12);
  EXPECT_NEAR(find_fabric(asked.garments[0].fabric).shear, per_radian, 1e-12);
}

TEST(Data, WrongInlineTablesSayWhatToWrite) {
  // A wrong key, a missing number, a Poisson ratio that would lose convexity, or Fm and EMT together are located
  // errors.
  EXPECT_NE(error_of([] {
              find_tissue(inline_entry(R"toml({ law = "neo-Hooke", shear_modulos = "10 kPa" })toml"));
            }).find("shear_modulus"),
            std::string::npos);
  EXPECT_NE(error_of([] {
              find_tissue(inline_entry(R"toml({ law = "neo-Hook", shear_modulus = "10 kPa" })toml"));
            }).find("neo-Hooke"),
            std::string::npos);
  EXPECT_NE(error_of([] {
              find_fabric(inline_entry(
                  R"toml({ law = "linear", warp = "1 N/m", weft = "1 N/m", shear = "1 N/m", poisson = 1.0 })toml"));
            }).find("poisson"),
            std::string::npos);
  const std::string both = error_of([] {
    find_fabric(inline_entry(
        R"toml(law = "kes"
             LT = 0.7
             WT = "12 gf cm/cm2"
             Fm = "500 gf/cm"
             EMT = 7
             G = "0.8 gf/(cm degree)")toml"));
  });
  EXPECT_NE(both.find("both Fm and EMT"), std::string::npos) << both;
  const std::string neither = error_of([] {
    find_fabric(inline_entry(R"toml({ law = "kes", LT = 0.7, WT = "12 gf cm/cm2", G = "0.8 gf/(cm degree)" })toml"));
  });
  EXPECT_NE(neither.find("neither Fm nor EMT"), std::string::npos) << neither;
}

TEST(Data, WhatIsWrittenOutReadsBackToTheSame) {
  // Every shipped entry, written out in SI, is the same law to the last bit, under its name and with its source.
  for (const auto& name : materials::fabric_names()) {
    const Fabric f = find_fabric(named(name)), g = find_fabric({.table = materials::written_out_fabric(named(name))});
    EXPECT_EQ(g.name, name);
    EXPECT_EQ(g.source, f.source);
    EXPECT_EQ(g.bending.weft, f.bending.weft);
    EXPECT_EQ(g.areal_density, f.areal_density);
    EXPECT_EQ(g.friction, f.friction);
    for (const Eigen::Vector3d& strain : {Eigen::Vector3d(0.03, 0.1, 0.02), Eigen::Vector3d(-0.01, 0.4, -0.1)})
      EXPECT_EQ(g.relaxed(strain, 1e-3).force, f.relaxed(strain, 1e-3).force) << name;
  }
  Eigen::Matrix3d F;
  F << 1.1, 0.2, -0.1, 0.05, 0.9, 0.1, 0.0, -0.2, 1.05;
  for (const auto& name : materials::tissue_names()) {
    const materials::Tissue a = find_tissue(named(name)), b = find_tissue({.table = materials::written_out_tissue(named(name))});
    EXPECT_EQ(b.name, name);
    EXPECT_EQ(b.source, a.source);
    EXPECT_EQ(b.density, a.density);
    EXPECT_EQ(b.shear_range, a.shear_range);
    EXPECT_EQ(materials::coupled(b.law, F).stress, materials::coupled(a.law, F).stress) << name;
  }
}

TEST(Data, InlineValuesAreWrittenOutInSi) {
  // Units and defaults of values in a case are those of SI, and a name stays what results call it.
  const input::Table table = materials::written_out_tissue(
      inline_entry(R"toml({ name = "my fat", law = "neo-Hooke", shear_modulus = "1.5 kPa", poisson_ratio = 0.49 })toml"));
  EXPECT_EQ(*table.find("shear_modulus")->text(), "1500 Pa");
  EXPECT_EQ(*table.find("volumetric")->text(), "barrier");
  EXPECT_EQ(*table.find("density")->text(), "1060 kg/m3");
  EXPECT_EQ(find_tissue({.table = table}).name, "my fat");
}

}  // namespace
}  // namespace snug::testing
