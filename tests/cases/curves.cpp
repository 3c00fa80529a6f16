// Curves and surfaces as a user meets them: snug convert between formats, pictures, and errors.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/cases/program.hpp"

namespace snug {
namespace {

constexpr const char* shapes = R"({"format": "snug curves", "unit": "1 mm",
 "curves": [{"name": "arc", "degree": 2, "points": [[10, 0], [10, 10], [0, 10]], "weights": [1, 0.7071067811865476, 1]}],
 "surfaces": [{"name": "patch", "degrees": [1, 1], "points": [[[0, 0, 0], [0, 10, 0]], [[10, 0, 0], [10, 10, 5]]]}],
 "nets": [{"name": "net", "closed": [false, true], "points": [[[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 1], [1, 0, 1], [1, 1, 1]]]}]})";

TEST_F(Program, CurvesGoThroughEveryFormatAndWhatIsLostIsSaid) {
  write("shapes.json", shapes);
  const auto read = [&](const std::string& name) { return nlohmann::json::parse(std::ifstream(folder_ / name)); };
  for (const std::string ending : {"step", "igs", "dxf"}) {
    const Outcome out = snug("convert shapes.json a." + ending);
    EXPECT_EQ(out.status, 0) << out.text;
    EXPECT_NE(out.text.find("1 net"), std::string::npos) << out.text;
    EXPECT_EQ(out.text.find("1 surface,") != std::string::npos, ending == "dxf") << out.text;
    EXPECT_EQ(snug("convert a." + ending + " back.json").status, 0);
    const auto curve = read("back.json").at("curves").at(0);
    EXPECT_EQ(curve.at("name"), ending == "igs" ? "" : "arc");
    EXPECT_NEAR(curve.at("points").at(1).at(1).get<double>(), 0.01, 1e-14);
    EXPECT_NEAR(curve.at("weights").at(1).get<double>(), 0.7071067811865476, 1e-14);
  }
  const Outcome fine = snug("convert shapes.json fine.json --subdivide 2");
  EXPECT_EQ(fine.status, 0) << fine.text;
  EXPECT_EQ(read("fine.json").at("nets").at(0).at("points").size(), 5u);
  EXPECT_EQ(read("fine.json").at("nets").at(0).at("points").at(0).size(), 12u);
  EXPECT_EQ(snug("convert shapes.json picture.svg").status, 0);
  EXPECT_TRUE(std::filesystem::file_size(folder_ / "picture.svg") > 1000);
}

TEST_F(Program, WrongCurvesAreStatus2WithTheirPlace) {
  write("shapes.json",
        "{\"format\": \"snug curves\", \"unit\": \"1 mm\",\n \"curves\": [{\"degree\": 3, \"points\": [[0, 0]]}]}");
  const Outcome few = snug("convert shapes.json a.step");
  EXPECT_EQ(few.status, 2);
  EXPECT_NE(few.text.find("shapes.json:2:"), std::string::npos) << few.text;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.step"));
  write("shapes.json", shapes);
  EXPECT_EQ(snug("convert shapes.json a.obj").status, 2);
  EXPECT_EQ(snug("convert nowhere.json a.step").status, 2);
  EXPECT_EQ(snug("convert shapes.json nowhere/a.step").status, 2);
  EXPECT_EQ(snug("convert shapes.json a.json --subdivide 11").status, 2);
  write("broken.step", "ISO-10303-21;\n");
  const Outcome broken = snug("convert broken.step a.json");
  EXPECT_EQ(broken.status, 2) << broken.text;
  EXPECT_NE(broken.text.find("broken.step: error"), std::string::npos) << broken.text;
}

}  // namespace
}  // namespace snug
