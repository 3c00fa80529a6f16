// Garments of several fabrics and graduated tubes through the program, and the shipped garments at a coarse mesh.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <numbers>

#include "tests/cases/program.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;

class Garments : public Program {
 protected:
  nlohmann::json summary(const std::string& out) const {
    std::ifstream file(folder_ / out / "summary.json");
    return nlohmann::json::parse(file);
  }
  static std::string shipped(const std::string& name) { return "'" + (fs::path(SNUG_SOURCE_DIR) / "cases" / name).string() + "'"; }
  const std::string coarse_ = " --no-report --set body.cells_around=12 --set body.cells_along=10";
};

TEST_F(Garments, LeggingsWearEachPieceInItsFabric) {
  // The plan says which piece is of which; the results have their rows, and the stiffer panel is stretched less; weights are area times areal density.
  const Outcome check = snug("check " + shipped("leggings"));
  EXPECT_EQ(check.status, 0) << check.text;
  EXPECT_THAT(check.text, testing::HasSubstr("side: C98L2"));
  EXPECT_THAT(check.text, testing::HasSubstr("front: N85L15"));
  const Outcome run = snug("run " + shipped("leggings") + " --out out --set solver.tier=L1" + coarse_);
  ASSERT_EQ(run.status, 0) << run.text;
  EXPECT_THAT(run.text, testing::HasSubstr("piece              leggings, side: C98L2"));
  const nlohmann::json of = summary("out");
  ASSERT_EQ(of.at("pieces").size(), 4u);
  const auto& side = of.at("pieces")[0];
  EXPECT_EQ(side.at("fabric"), "C98L2");
  for (int p = 1; p < 4; ++p) EXPECT_GT(of.at("pieces")[p].at("stretch_weft").get<double>(), side.at("stretch_weft").get<double>());
  ASSERT_EQ(of.at("seams").size(), 4u);
  for (const auto& seam : of.at("seams")) EXPECT_GT(seam.at("line_load_N_per_m").get<double>(), 0.0);
  // One fabric for all of them, said by the case.
  const Outcome one = snug("check " + shipped("leggings") + " --set 'garment.zone={ pieces = [\"side\"], fabric = \"N85L15\" }'");
  EXPECT_EQ(one.status, 0) << one.text;
  EXPECT_EQ(one.text.find("C98L2"), std::string::npos) << one.text;
  EXPECT_EQ(one.text.find("fabric of leggings"), std::string::npos) << one.text;
}

TEST_F(Garments, TheEchoOfTwoFabricsReadsBackToTheSame) {
  // case.echo.toml beside the case's files gives the same pressures to the last digit.
  const std::string rigid = " --set solver.tier=L1" + coarse_;
  ASSERT_EQ(snug("run " + shipped("leggings") + " --out first" + rigid).status, 0);
  fs::copy(fs::path(SNUG_SOURCE_DIR) / "cases/leggings", folder_ / "again", fs::copy_options::recursive);
  fs::copy_file(folder_ / "first/case.echo.toml", folder_ / "again/case.toml", fs::copy_options::overwrite_existing);
  const Outcome again = snug("run again --out second --no-report");
  ASSERT_EQ(again.status, 0) << again.text;
  EXPECT_EQ(summary("first").at("numbers").at("mean_contact_pressure_Pa"), summary("second").at("numbers").at("mean_contact_pressure_Pa"));
}

TEST_F(Garments, TheStockingPressesAsItIsMadeForAndDesignFindsIt) {
  // Designed anew on a coarse mesh from the law of Laplace, it is within 5 % at every height that it names; the lines printed are a case's.
  const std::string anew = " --set garment.pattern.circumferences=[]";  // whatever the case has by now
  const Outcome design = snug("design " + shipped("stocking") + " --within 5 --out lines.toml --set body.cells_around=12 --set body.cells_along=16" + anew);
  ASSERT_EQ(design.status, 0) << design.text;
  std::ifstream file(folder_ / "lines.toml");
  const std::string lines{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(lines, testing::HasSubstr("circumferences = [\n  { height = \"0.0 mm\", girth = \""));
  const Outcome none = snug("design " + shipped("vest"));
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.text, testing::HasSubstr("no garment says what pressures it is made for"));
}

TEST_F(Garments, JeansPressMoreTheStifferTheirDenimAndTheTShirtHangs) {
  // Two denims on a coarse rigid thigh: the order of their weft moduli (112500 and 48000 kgf/m2) is that of their pressures.
  double before = 0.0;
  for (const std::string fabric : {"001-01", "008-01"}) {
    const Outcome run = snug("run " + shipped("jeans") + " --out out --set solver.tier=L1 --set garment.fabric=" + fabric + coarse_);
    ASSERT_EQ(run.status, 0) << run.text;
    const double mean = summary("out").at("numbers").at("mean_contact_pressure_Pa");
    EXPECT_GT(mean, before);
    before = mean;
  }
  const Outcome shirt = snug("run " + shipped("tshirt") + " --out shirt --no-report --set solver.tier=L1 --set body.cells_around=10 --set body.cells_along=6");
  ASSERT_EQ(shirt.status, 0) << shirt.text;
  EXPECT_LT(summary("shirt").at("balance").at("contact_force_N").get<double>(), 20.0);
}

TEST_F(Garments, TheVestRanksItsFabricsByTheirStiffnessAtEveryLocation) {
  // C98L2, N85L15 and P98L2 stretch by 24.6, 43.3 and 56.4 % under the greatest force of the test (table 7.1): the stiffer, the more the one cut presses, on a coarse rigid trunk.
  const Outcome sweep = snug("run " + shipped("vest") + " --out out --no-report --tier L1 --sweep garment.fabric=C98L2,N85L15,P98L2" + coarse_);
  ASSERT_EQ(sweep.status, 0) << sweep.text;
  const auto stiff = summary("out/fabric-C98L2").at("locations"), middle = summary("out/fabric-N85L15").at("locations"), soft = summary("out/fabric-P98L2").at("locations");
  ASSERT_GE(stiff.size(), 5u);
  for (std::size_t l = 0; l < stiff.size(); ++l) {
    if (middle.at(l).at("coverage").get<double>() < 0.5) continue;
    const double pressure = middle.at(l).at("mean_pressure_Pa");
    EXPECT_GT(stiff.at(l).at("mean_pressure_Pa").get<double>(), 1.05 * pressure) << middle.at(l).at("location");
    EXPECT_LT(soft.at(l).at("mean_pressure_Pa").get<double>(), 0.95 * pressure) << middle.at(l).at("location");
  }
}

TEST_F(Garments, ThePressureOfALocationHardlyHangsOnTheMesh) {
  // Rows of nodes fall otherwise to the borders of locations and hems on either mesh. Counted by whole nodes the means differ by 4 %.
  const auto worn = [&](const std::string& out, const std::string& cells) {
    const Outcome outcome = snug("run " + shipped("thigh-sleeve") + " --tier L1 --no-report --out " + out + cells);
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    return summary(out).at("locations");
  };
  const auto coarse = worn("coarse", ""), fine = worn("fine", " --set body.cells_around=44 --set body.cells_along=20");
  ASSERT_EQ(coarse.size(), 4u);
  for (std::size_t l = 0; l < 4; ++l) {
    const double mean = fine.at(l).at("mean_pressure_Pa"), area = fine.at(l).at("area_m2");
    EXPECT_NEAR(coarse.at(l).at("mean_pressure_Pa").get<double>(), mean, 2e-3 * mean) << fine.at(l).at("location");
    EXPECT_NEAR(coarse.at(l).at("area_m2").get<double>(), area, 3e-3 * area);
  }
}

TEST_F(Garments, AVestOnTheNetOfItsKeyPointsIsWornAsOneLaidOnTheSkin) {
  // Eight key points at each of five heights, 15 mm off ellipses of the torso's girths (body/torso.csv); subdivided they are the placed shape. Friction
  // remembers where cloth came to lie and triangles bridge other chords there: locations agree to 1e-3, the mean pressure to 5e-5.
  std::string rows;
  for (const auto& [height, girth, ratio] : {std::array{0.0, 985.0, 1.42}, std::array{110.0, 860.0, 1.40}, std::array{210.0, 735.0, 1.36}, std::array{310.0, 800.0, 1.34}, std::array{410.0, 910.0, 1.30}}) {
    const double depth = girth / (std::numbers::pi * (3.0 * (ratio + 1.0) - std::sqrt((3.0 * ratio + 1.0) * (ratio + 3.0))));  // mm, half of it, after Ramanujan
    rows += rows.empty() ? "[" : ", [";
    for (int k = 0; k < 8; ++k) {
      const double angle = 0.25 * std::numbers::pi * k;
      rows += fmt::format("{}[{:.2f}, {:.2f}, {}]", k ? ", " : "", (ratio * depth + 15.0) * std::cos(angle), (depth + 15.0) * std::sin(angle), height);
    }
    rows += "]";
  }
  fs::copy(fs::path(SNUG_SOURCE_DIR) / "cases/vest", folder_ / "vest", fs::copy_options::recursive);
  write("vest/net.json", R"({"format": "snug curves", "unit": "1 mm", "nets": [{"name": "vest", "closed": [false, true], "points": [)" + rows + "]}]}");
  const std::string rigid = " --set solver.tier=L1" + coarse_;
  const Outcome skin = snug("run vest --out skin" + rigid), net = snug("run vest --out net --set garment.shape=net.json" + rigid);
  ASSERT_EQ(skin.status, 0) << skin.text;
  ASSERT_EQ(net.status, 0) << net.text;
  EXPECT_THAT(net.text, testing::HasSubstr("placed on the net vest of net.json"));
  const nlohmann::json on_skin = summary("skin"), on_net = summary("net");
  EXPECT_EQ(on_net.at("status"), "converged");
  ASSERT_GE(on_skin.at("locations").size(), 4u);
  for (std::size_t l = 0; l < on_skin.at("locations").size(); ++l) {
    const double expected = on_skin.at("locations")[l].at("mean_pressure_Pa");
    EXPECT_NEAR(on_net.at("locations")[l].at("mean_pressure_Pa").get<double>(), expected, 1e-3 * expected) << on_skin.at("locations")[l].at("location");
  }
  const double mean = on_skin.at("numbers").at("mean_contact_pressure_Pa");
  EXPECT_NEAR(on_net.at("numbers").at("mean_contact_pressure_Pa").get<double>(), mean, 5e-5 * mean);
}

TEST_F(Garments, AsParticlesAShapeIsGivenAndNoPressures) {
  // Cases that ask for comfort or have two garments are refused at their place; the skirt's plan says what particles leave out. A tight sleeve
  // comes to rest, and no file of it has a pressure of the skin.
  for (const std::string name : {"jeans", "sleeve-over-sleeve"}) {
    const Outcome refused = snug("check " + shipped(name) + " --tier particle");
    EXPECT_EQ(refused.status, 2) << refused.text;
    EXPECT_THAT(refused.text, testing::HasSubstr("case.toml:"));
    EXPECT_THAT(refused.text, testing::HasSubstr("tier particle"));
  }
  const Outcome check = snug("check " + shipped("skirt"));
  EXPECT_EQ(check.status, 0) << check.text;
  EXPECT_THAT(check.text, testing::HasSubstr("pressures: particles give the shape of cloth"));
  const Outcome tight = snug("run " + shipped("verification/tube-sleeve") + " --tier particle --out tight --no-report --states 2");
  ASSERT_EQ(tight.status, 0) << tight.text;
  EXPECT_LT(summary("tight").at("max_penetration_m").get<double>(), 1e-3);
  EXPECT_FALSE(summary("tight").at("numbers").contains("max_contact_pressure_Pa"));
  EXPECT_EQ(summary("tight").at("locations").size(), 0u);
  std::ifstream skin(folder_ / "tight/skin.csv");
  std::string head;
  std::getline(skin, head);
  EXPECT_EQ(head.find("pressure"), std::string::npos) << head;
  EXPECT_TRUE(fs::exists(folder_ / "tight/states/garment_0001.vtu"));
}

}  // namespace
}  // namespace snug
