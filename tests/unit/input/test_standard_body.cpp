// Standard bodies by name: what a case gets from them, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "cases/input/case.hpp"
#include "cases/input/echo.hpp"
#include "cases/input/standard_body.hpp"

namespace snug::input {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

const fs::path bodies = fs::path(SNUG_SOURCE_DIR) / "mesh/data/bodies";

class StandardBodies : public testing::Test {
 protected:
  StandardBodies() { fs::create_directories(folder_); }
  ~StandardBodies() override { fs::remove_all(folder_); }

  /// A case with these lines in [body.scan].
  Case read_scan(const std::string& scan, const std::string& more = "") {
    return read_text("title = \"t\"\n[body]\nkind = \"scan\"\nlayers = [{ name = \"bone\", material = \"rigid\" }, { name = \"tissue\", material = \"muscle\" }]\n"
                     "[body.scan]\ncore = { thickness = \"30 mm\" }\n" + scan + "\n" + more + "[load]\nskin_pressure = \"1 kPa\"\n");
  }
  Case read_text(const std::string& text) {
    std::ofstream(folder_ / "case.toml") << text;
    return read_case(folder_, {.overrides = {}, .bodies = bodies});
  }
  std::string error_of(const std::string& scan) {
    try {
      read_scan(scan);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }
  /// z of the normals of the cuts.
  std::vector<double> upwards(const std::string& cuts) {
    const Case c = read_scan("standard = \"woman\"\ncut = " + cuts);
    std::vector<double> result;
    for (const NamedCut& cut : c.body->scan->cuts) result.push_back(cut.normal[2]);
    return result;
  }

  const fs::path folder_ = fs::temp_directory_path() / ("snug-standard-" + std::to_string(::getpid()) + "-" + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(StandardBodies, ANameStandsForSurfaceAxesAndLocations) {
  // The case gets the surface in metres with z upwards, the points of the cuts and the nine locations on both sides.
  const Case c = read_scan("standard = \"man\"\ncut = [\"waist\", \"ankle left\", \"ankle right\"]");
  const ScanSpec& scan = *c.body->scan;
  EXPECT_EQ(scan.surface.lexically_normal(), (bodies / "man.obj").lexically_normal());
  EXPECT_EQ(scan.unit, 1.0);
  EXPECT_LT(scan.cuts[1].point[0], -0.1) << "the left side has negative x: x points to the right of the person";
  EXPECT_GT(scan.cuts[2].point[0], 0.1);
  ASSERT_EQ(c.body->locations.size(), 18u);
  std::set<std::string> places;
  for (const LocationSpec& location : c.body->locations) places.insert(location.name.substr(0, location.name.rfind(' ')));
  EXPECT_EQ(places, (std::set<std::string>{"Chest", "Side lats", "Front waist", "Side waist", "Back waist", "Side pelvis", "Front thigh", "Side thigh", "Back thigh"}));
}

TEST_F(StandardBodies, CutsFaceOutOfThePartThatAllOfThemBorderOn) {
  // The waist is the upper end of the legs and the lower end of the trunk.
  EXPECT_THAT(upwards("[\"waist\", \"ankle left\", \"ankle right\"]"), ElementsAre(1, -1, -1));
  EXPECT_THAT(upwards("[\"neck\", \"waist\"]"), ElementsAre(1, -1));
  EXPECT_THAT(upwards("[\"knee left\", \"ankle left\"]"), ElementsAre(1, -1));
  EXPECT_THAT(upwards("[\"ankle right\", \"mid-thigh right\"]"), ElementsAre(-1, 1));
  const std::vector<double> sleeve = upwards("[\"wrist left\", \"arm left\"]");
  EXPECT_LT(sleeve[0], -0.3);
  EXPECT_GT(sleeve[1], 0.3);
}

TEST_F(StandardBodies, PlanesOfOnesOwnStandBesideTheNamedOnes) {
  // Shorts end above the knee, a band above the waist: the named cut faces away from them; with a normal of its own a name may stand alone.
  EXPECT_THAT(upwards("[\"waist\", { name = \"hem left\", point = [\"-110 mm\", \"50 mm\", \"600 mm\"], normal = [0, 0, -1] },"
                      " { name = \"hem right\", point = [\"110 mm\", \"50 mm\", \"600 mm\"], normal = [0, 0, -1] }]"),
              ElementsAre(1, -1, -1));
  EXPECT_THAT(upwards("[\"waist\", { name = \"band\", point = [\"0 cm\", \"5 cm\", \"115 cm\"], normal = [0, 0, 1] }]"), ElementsAre(-1, 1));
  EXPECT_THAT(upwards("[\"waist\", { name = \"hips\", point = [\"0 mm\", \"20 mm\", \"900 mm\"], normal = [0, 0, -1] }]"), ElementsAre(1, -1));
  EXPECT_THAT(upwards("[\"ankle left\", { name = \"toes\", point = [\"-180 mm\", \"150 mm\", \"20 mm\"], normal = [0, 1, 0] }]"), ElementsAre(1, 0));
  EXPECT_THAT(upwards("[{ name = \"knee left\", normal = [0, 0, 1] }]"), ElementsAre(1));
}

TEST_F(StandardBodies, LocationsOfTheCaseReplaceTheStandardOnes) {
  const Case c = read_scan("standard = \"woman\"\ncut = [\"neck\", \"waist\"]", "[[body.locations]]\nname = \"Navel\"\nat = [\"0 mm\", \"140 mm\", \"1000 mm\"]\nradius = \"20 mm\"\n");
  ASSERT_EQ(c.body->locations.size(), 1u);
  EXPECT_EQ(c.body->locations[0].name, "Navel");
}

TEST_F(StandardBodies, WhatDoesNotFitTogetherIsRefusedWithARemedy) {
  const std::string cuts = "cut = [\"waist\", \"ankle left\", \"ankle right\"]\n";
  EXPECT_THAT(error_of("standard = \"womann\"\n" + cuts), HasSubstr("there is no standard body \"womann\"; did you mean woman?"));
  EXPECT_THAT(error_of("standard = \"woman\"\ncut = [\"waste\", \"neck\"]\n"), HasSubstr("the standard body \"woman\" has no cut \"waste\"; did you mean waist?"));
  EXPECT_THAT(error_of("standard = \"woman\"\ncut = [\"knee left\"]\n"), HasSubstr("leaves two parts"));
  EXPECT_THAT(error_of("standard = \"woman\"\ncut = [\"neck\", \"knee left\", \"ankle left\"]\n"), HasSubstr("do not border on one part"));
  EXPECT_THAT(error_of("standard = \"woman\"\ncut = [\"waist\", \"neck\", \"waist\"]\n"), HasSubstr("\"waist\" of a cut is taken"));
  EXPECT_THAT(error_of("standard = \"woman\"\n"), HasSubstr("no cut says which part"));
  EXPECT_THAT(error_of("standard = \"woman\"\nlower = { point = [\"0 mm\", \"0 mm\", \"600 mm\"], normal = [0, 0, -1] }\n"), HasSubstr("the scan has no cuts"));
  EXPECT_THAT(error_of("standard = \"woman\"\nunit = \"1 mm\"\n" + cuts), HasSubstr("unit is given"));
  EXPECT_THAT(error_of("standard = \"woman\"\nup = \"y\"\nfront = \"z\"\n" + cuts), HasSubstr("up is given"));
  EXPECT_THAT(error_of("standard = \"woman\"\nsurface = \"case.toml\"\n" + cuts), HasSubstr("surface is given"));
  EXPECT_THAT(error_of(cuts), HasSubstr("neither a surface nor a standard body"));
  EXPECT_THAT(error_of("surface = \"case.toml\"\n" + cuts), HasSubstr("the cut \"waist\" has no point"));
  EXPECT_THAT(error_of("standard = \"woman\"\n" + cuts), testing::StrEq("none"));
}

TEST_F(StandardBodies, GirthsThatAreNotAskedGoAlong) {
  // The factor of the seat is that of the whole leg down to the knee, which has its own; the chest goes along with the waist, and shoulders with the chest.
  const Case c = read_scan("standard = \"woman\"\nstature = \"170 cm\"\ngirth = [{ at = \"waist\", length = \"726 mm\" }, { at = \"hips\", length = \"103.73 cm\" }, { at = \"knee\", length = \"365.2 mm\" }]\n"
                           "cut = [\"waist\", \"ankle left\", \"ankle right\"]");
  ASSERT_TRUE(c.body->scan->morph);
  const auto ring = [&](const std::string& name) {
    for (const BodyRing& one : c.body->scan->morph->rings)
      if (one.name == name) return one;
    ADD_FAILURE() << name;
    return BodyRing{};
  };
  for (const std::string name : {"waist", "seat", "chest", "neck", "arm left", "wrist right", "thigh left", "knee right", "ankle left"}) EXPECT_NEAR(ring(name).factor, 1.1, 1e-3) << name;
  EXPECT_TRUE(ring("knee left").asked && ring("knee right").asked && !ring("calf left").asked);
  EXPECT_NEAR(ring("waist").point[2], 1.0371 * 1.700 / 1.605, 1e-3);
  EXPECT_NEAR(ring("thigh right").shift[0], 0.00999, 1e-4);
  EXPECT_NEAR(ring("ankle left").shift[0], -0.00999, 1e-4) << "a leg moves as a whole";
  EXPECT_NEAR(c.body->scan->cuts[0].point[2], ring("waist").point[2], 1e-12) << "cuts go with the body";
}

TEST_F(StandardBodies, GirthsThatCannotBeMadeAreRefused) {
  const std::string cuts = "cut = [\"waist\", \"ankle left\", \"ankle right\"]\n", woman = "standard = \"woman\"\n" + cuts;
  EXPECT_THAT(error_of(woman + "girth = [{ at = \"wast\", length = \"72 cm\" }]\n"), HasSubstr("the standard body has no girth \"wast\"; did you mean waist?"));
  EXPECT_THAT(error_of(woman + "girth = [{ at = \"waist\", length = \"72 mm\" }]\n"), HasSubstr("waist is 660 mm round and 72 mm are asked"));
  EXPECT_THAT(error_of(woman + "girth = [{ at = \"knee\", length = \"35 cm\" }, { at = \"knee left\", length = \"36 cm\" }]\n"), HasSubstr("the girth of \"knee left\" is asked twice"));
  EXPECT_THAT(error_of(woman + "girth = [{ at = \"waist\", length = 72 }]\n"), HasSubstr("72"));
  EXPECT_THAT(error_of(woman + "stature = \"17 cm\"\n"), HasSubstr("a stature of 170 mm is asked of a body of 1605 mm"));
  EXPECT_THAT(error_of("surface = \"case.toml\"\nstature = \"170 cm\"\n" + cuts), HasSubstr("stature is asked of a scan, which has its own"));
}

TEST_F(StandardBodies, TheEchoIsReadAsTheSameCase) {
  const Case c = read_scan("standard = \"woman\"\ncut = [\"waist\", \"ankle left\", \"ankle right\"]");
  const std::string echo = echo_text(c);
  EXPECT_THAT(echo, HasSubstr("standard = \"woman\""));
  EXPECT_EQ(echo.find("surface"), std::string::npos) << "the file's place is this machine's";
  const Case again = read_text(echo);
  EXPECT_EQ(echo_text(again), echo);
  EXPECT_EQ(again.body->scan->surface, c.body->scan->surface);
}

struct Surface {
  std::vector<std::array<double, 3>> vertices;
  std::string faces;
};

Surface surface_of(const fs::path& file) {
  Surface surface;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line.substr(std::min<std::size_t>(2, line.size())));
    if (line.rfind("v ", 0) == 0)
      if (std::array<double, 3> x; words >> x[0] >> x[1] >> x[2]) surface.vertices.push_back(x);
    if (line.rfind("f ", 0) == 0) surface.faces += line + "\n";
  }
  return surface;
}

TEST(ShippedBodies, AreOfOneTopologySymmetricAndSmall) {
  // Woman and man share their faces and are at most 2 MB together; every place of the left side has its mirror image on the right; locations lie on the
  // surface, within the edge of its coarsest facets.
  ASSERT_THAT(standard_bodies(bodies), ElementsAre("man", "woman"));
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(bodies)) bytes += entry.file_size();
  EXPECT_LT(bytes, 2'000'000u);
  std::set<std::string> faces;
  for (const std::string& name : standard_bodies(bodies)) {
    const StandardBody body = read_standard_body(bodies, name);
    const Surface surface = surface_of(body.surface);
    faces.insert(surface.faces);
    for (const StandardCut& cut : body.cuts) EXPECT_TRUE(cut.towards.empty() || body.cut(cut.towards)) << cut.name;
    for (std::size_t n = 0; n + 1 < body.locations.size(); n += 2) {
      const LocationSpec &left = body.locations[n], &right = body.locations[n + 1];
      EXPECT_THAT(left.name, testing::EndsWith(" left"));
      EXPECT_LT((*left.at)[0], 0.0);
      for (int k = 0; k < 3; ++k) EXPECT_NEAR((*left.at)[k], (k == 0 ? -1.0 : 1.0) * (*right.at)[k], 2e-4) << left.name;
      double least = 1.0;
      for (const auto& x : surface.vertices) least = std::min(least, std::hypot(x[0] - (*left.at)[0], x[1] - (*left.at)[1], x[2] - (*left.at)[2]));
      EXPECT_LT(least, 0.02) << left.name;
    }
  }
  EXPECT_EQ(faces.size(), 1u);
}

TEST(ShippedBodies, HaveTheGirthsOfTheirSource) {
  // The woman's surface as it came: hip 93, waist 66.6 and thigh 54.7 cm (shared description of the source), to what the height of the section leaves open.
  const StandardBody woman = read_standard_body(bodies, "woman");
  const auto girth = [&](const std::string& name) {
    for (const Landmark& one : woman.landmarks)
      if (one.name == name) return one.girth.value_or(0.0);
    return 0.0;
  };
  EXPECT_NEAR(woman.stature, 1.605, 1e-3);
  EXPECT_NEAR(girth("seat"), 0.93, 0.02);
  EXPECT_NEAR(girth("waist"), 0.666, 0.01);
  EXPECT_NEAR(woman.cut("thigh left")->girth, 0.547, 0.015);
}

}  // namespace
}  // namespace snug::input
