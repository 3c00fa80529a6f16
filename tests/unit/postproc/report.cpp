#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <regex>

#include "cases/input/diagnostics.hpp"
#include "postproc/recorders.hpp"
#include "postproc/report/base64.hpp"
#include "postproc/report/limbs.hpp"
#include "postproc/report/page.hpp"
#include "postproc/report/template.hpp"
#include "postproc/report/unrolled.hpp"
#include "postproc/store.hpp"
#include "tests/unit/postproc/scene.hpp"

namespace snug::postproc::report {
namespace {

using test::fresh_folder;
using test::run_scene;
using test::text_of;
using testing::HasSubstr;
using testing::Not;

/// Area that a path of region_path encloses (shoelace over its loops), px2, and its number of corners.
struct PathSize {
  double area = 0.0;
  int corners = 0;
};
PathSize size_of(const std::string& path) {
  static const std::regex loop("M([^z]*)z"), pair("(-?[0-9.]+),(-?[0-9.]+)");
  PathSize size;
  const std::sregex_iterator end;
  for (std::sregex_iterator l(path.begin(), path.end(), loop); l != end; ++l) {
    const std::string text = (*l)[1];
    std::vector<Eigen::Vector2d> corners;
    for (std::sregex_iterator p(text.begin(), text.end(), pair); p != end; ++p) {
      const Eigen::Vector2d step(std::stod((*p)[1]), std::stod((*p)[2]));
      corners.push_back(corners.empty() ? step : Eigen::Vector2d(corners.back() + step));
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % corners.size()];
      size.area += 0.5 * (a.x() * b.y() - b.x() * a.y());
    }
    size.corners += static_cast<int>(corners.size());
  }
  size.area = std::abs(size.area);
  return size;
}

/// A square of 100 px, n x n cells of two triangles.
Sheet square(int n) {
  Sheet sheet;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) sheet.points.emplace_back(100.0 * i / n, 100.0 * j / n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + n + 1;
      sheet.triangles.push_back({a, a + 1, b + 1});
      sheet.triangles.push_back({a, b, b + 1});  // the other sense: it must not matter
    }
  return sheet;
}

/// A tube of radius r round (cx, 0), height h, all covered; pressure rises linearly from 0 to `top` along it.
Skin tube(double r, double h, double cx, double top) {
  constexpr int around = 48, along = 10;
  Skin skin;
  skin.locations = {"behind"};
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / around, degrees = 360.0 * i / around;
      skin.numbers.push_back(static_cast<int>(skin.numbers.size()) + 1);
      skin.nodes.emplace_back(cx + r * std::cos(angle), r * std::sin(angle), h * j / along);
      skin.displacement.emplace_back(0.0, 0.0, 0.0);
      skin.pressure.push_back(top * j / along);
      skin.coverage.push_back(1.0);
      skin.location.push_back(degrees >= 225.0 && degrees <= 315.0 ? 0 : -1);
    }
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = j * around + i, b = j * around + (i + 1) % around;
      skin.triangles.push_back({a, b, b + around});
      skin.triangles.push_back({a, b + around, a + around});
    }
  return skin;
}

TEST(Region, HasTheAreaOfALinearField) {
  // The region x >= 30 of a square of 100 has 70 % of its area and is drawn as one outline, whatever the mesh inside:
  // a corner at each node of its border and where the level meets a diagonal or an edge.
  for (const int n : {1, 4, 10}) {
    const Sheet sheet = square(n);
    std::vector<double> x;
    for (const auto& point : sheet.points) x.push_back(point.x());
    const std::string path = region_path(sheet, x, 30.0);
    EXPECT_NEAR(size_of(path).area, 7000.0, 1e-6) << n;
    EXPECT_EQ(std::count(path.begin(), path.end(), 'M'), 1) << n;
    const std::string all = region_path(sheet, x, -1.0);
    EXPECT_NEAR(size_of(all).area, 10000.0, 1e-6) << n;
    EXPECT_EQ(size_of(all).corners, 4 * n) << n;
    EXPECT_EQ(region_path(sheet, x, 101.0), "");
  }
}

TEST(UnrolledMap, ATubeBecomesARectangle) {
  // A tube of radius 80 mm and height 200 mm, off the z axis, unrolls into a rectangle of girth by height; a pressure
  // that rises linearly leaves the share (1 - level) of it at or above each level, and a location behind is not cut.
  const Skin skin = tube(0.08, 0.2, 0.5, 1000.0);
  const PressureScale scale = pressure_scale({&skin});
  EXPECT_EQ(scale.top, 1000.0);
  EXPECT_EQ(scale.bands, 10);
  const UnrolledMap map = unroll(skin, scale, 720.0);
  ASSERT_TRUE(map.unrolled);
  EXPECT_NEAR(map.height / map.width, 0.2 / (2.0 * std::numbers::pi * 0.08), 1e-9);
  const double area = size_of(map.skin).area;  // cells over the cut are drawn at both ends, and clipped there
  EXPECT_NEAR(area, map.width * map.height, map.width * map.height / 48.0 + 0.1 * map.height);
  ASSERT_EQ(map.bands.size(), 10u);
  for (int band = 1; band < 10; ++band)
    EXPECT_NEAR(size_of(map.bands[band].second).area / area, 1.0 - 0.1 * band, 1e-3);
  ASSERT_EQ(map.patches.size(), 1u);
  EXPECT_EQ(std::count(map.patches[0].path.begin(), map.patches[0].path.end(), 'M'), 1);
  EXPECT_NEAR(map.largest_y, 0.0, 1e-9);
  EXPECT_THAT(map.largest_place, HasSubstr("height 200 mm"));
}

/// Another skin behind the first, `up` higher.
void add(const Skin& other, double up, Skin& skin) {
  const int first = static_cast<int>(skin.nodes.size());
  for (const Eigen::Vector3d& x : other.nodes) skin.nodes.push_back(x + up * Eigen::Vector3d::UnitZ());
  for (const Triangle& t : other.triangles) skin.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(skin.numbers, other.numbers), append(skin.displacement, other.displacement), append(skin.pressure, other.pressure);
  append(skin.coverage, other.coverage), append(skin.location, other.location);
}

TEST(UnrolledMap, LegsLieSideBySideBelowTheTrunkEachOfHalfTheWidth) {
  // Each leg is slit on its inner side and fills half of the map's width with no triangle drawn across: all of the map is skin, nothing of it twice but the
  // cells at the cut. A place is told by the leg's own angle.
  Skin skin = tube(0.07, 0.2, 0.09, 0.0);
  add(tube(0.07, 0.2, -0.09, 0.0), 0.0, skin);
  add(tube(0.16, 0.2, 0.0, 0.0), 0.2, skin);
  const std::size_t leg = 48 * 11;
  const std::vector<int> limbs = limbs_of(skin.nodes, skin.triangles);
  for (std::size_t n = 0; n < limbs.size(); ++n) EXPECT_EQ(limbs[n], n < leg - 48 ? 1 : n >= leg && n < 2 * leg - 48 ? 2 : limbs[n]) << n;
  EXPECT_EQ(std::count(limbs.begin() + 2 * leg + 48, limbs.end(), 0), 10 * 48);
  const std::size_t front = leg + 4 * 48 + 6;  // 45 deg of the left leg, 80 mm up
  skin.pressure[front] = 700.0;
  const UnrolledMap map = unroll(skin, pressure_scale({&skin}), 720.0);
  const double area = size_of(map.skin).area;
  EXPECT_NEAR(area, map.width * map.height, map.width * map.height / 48.0 + 0.1 * map.height);
  EXPECT_THAT(map.largest_place, HasSubstr("at 45° of the limb on the side of −x, height 80 mm"));
  EXPECT_THAT(map.across_name, HasSubstr("half the width each"));
  EXPECT_EQ(map.patches.size(), 1u);
}

TEST(UnrolledMap, NamesOfNeighboursDoNotCoverOneAnother) {
  // Three locations of one height 30 px apart have names of twice that: each has rows of its own; one far off stays in its middle.
  std::vector<MapPatch> patches;
  for (const double x : {100.0, 130.0, 160.0, 400.0}) patches.push_back({.name = "Side waist", .path = {}, .x = x, .y = 200.0});
  set_labels_apart(patches);
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_GE(std::abs(patches[a].label_y - patches[b].label_y), 30.0) << a << " " << b;
  EXPECT_EQ(patches[0].label_y, 200.0);
  EXPECT_EQ(patches[3].label_y, 200.0);
}

TEST(UnrolledMap, AFlatSkinIsSeenFromItsNormal) {
  // Ten by ten cells of a flat skin of 50 by 30 mm keep their shape.
  Skin skin;
  for (int j = 0; j <= 10; ++j)
    for (int i = 0; i <= 10; ++i) {
      skin.nodes.emplace_back(0.005 * i, 0.003 * j, 0.01);
      skin.numbers.push_back(1), skin.pressure.push_back(i), skin.coverage.push_back(1.0), skin.location.push_back(-1);
    }
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 10; ++i) {
      skin.triangles.push_back({11 * j + i, 11 * j + i + 1, 11 * j + i + 12});
      skin.triangles.push_back({11 * j + i, 11 * j + i + 12, 11 * j + i + 11});
    }
  const UnrolledMap map = unroll(skin, pressure_scale({&skin}), 500.0);
  EXPECT_FALSE(map.unrolled);
  EXPECT_NEAR(map.height, 300.0, 1e-9);
  EXPECT_NEAR(size_of(map.skin).area, 500.0 * 300.0, 1.0);
}

TEST(Scale, NumbersAreForPeople) {
  // Three digits, a true minus sign, powers of ten for what is very small or large, none for what is not there.
  EXPECT_EQ(number(0.0), "0");
  EXPECT_EQ(number(-2.1717), "−2.17");
  EXPECT_EQ(number(12345.6), "12 346");
  EXPECT_EQ(number(1.129e-12), "1.1 × 10⁻¹²");
  EXPECT_EQ(number(std::nan("")), "–");
  EXPECT_EQ(plain(50.0), "50");
  EXPECT_EQ(plain(1250000.0), "1 250 000");
  EXPECT_THAT(ticks(0.0, 0.28, 7), testing::Pointwise(testing::DoubleNear(1e-12), {0.0, 0.05, 0.1, 0.15, 0.2, 0.25}));
  EXPECT_EQ(colour(0.0), "#440154");  // the ends of viridis
  EXPECT_EQ(colour(1.0), "#fde725");
}

TEST(Base64, MatchesTheStandard) {
  // Test vectors of RFC 4648, section 10.
  const auto encoded = [](const std::string& text) {
    return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("foob"), "Zm9vYg==");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

TEST(Template, ShowsAndEscapes) {
  // What a user has named is text, not markup; empty texts hide their section.
  EXPECT_EQ(
      fill("{{a}}{{#b}}[{{c}}]{{/b}}{{^d}}none{{/d}}", {{"a", "<i>"}, {"b", {{{"c", "1"}}, {{"c", "2"}}}}, {"d", ""}}),
      "&lt;i&gt;[1][2]none");
  EXPECT_THROW(fill("{{#a}}", {}), std::logic_error);
}

TEST(Page, HoldsWhatTheRunSays) {
  // The page shows title, key figures, map, locations, plan and reactions of the files, and loads nothing.
  const auto folder = fresh_folder("report");
  RunResult run = run_scene();
  run.title = "sleeve <1>";
  run.balance.reactions["upper edge"] = {0.0, 0.0, 2.1717};
  run.balance.contact_force = 20.0;
  input::ComfortSpec trial;
  trial.curves.name = "wear trial 2002";
  write_results(run, evaluate(run, trial), folder);
  const std::string html = page(folder, {"\x89PNG", ""});
  for (const char* part : {"sleeve &lt;1&gt;", "<svg class=\"plot map\"", "Front thigh", "friction", "not in the case",
                           "Reaction, upper edge", "0, 0, 2.17 N", "Newton iteration",
                           "data:image/png;base64,iVBORw==", "\"numbers\":", "THREE", "300"})
    EXPECT_THAT(html, HasSubstr(part));
  EXPECT_THAT(html, Not(HasSubstr("{{")));
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  static const std::regex request(R"((src|href)\s*=\s*["']?(https?:|//)|url\(\s*["']?http|@import)");
  const std::string own = html.substr(0, html.find("<script"));
  EXPECT_FALSE(std::regex_search(own, request));
}

TEST(Page, SaysWhatIsMissing) {
  // Without pictures the page says why; a run that did not converge is called so; a folder without results is an error.
  const auto folder = fresh_folder("report-missing");
  EXPECT_THROW(page(folder, {}), input::InputError);
  RunResult run = run_scene();
  run.status = postproc::Status::failed;
  run.message = "make the steps smaller";
  write_results(run, {}, folder);
  const std::string html = page(folder, {"", "no display"});
  EXPECT_THAT(html, HasSubstr("No pictures here: no display"));
  EXPECT_THAT(html, HasSubstr("make the steps smaller"));
  EXPECT_THAT(html, HasSubstr("Nothing converged"));
  EXPECT_THAT(html, Not(HasSubstr("id=\"comfort\"")));
}

TEST(Page, TellsTheTruthAboutTheState) {
  // Of a partial state: stage, fraction, stiffening, what to try and no comfort. Warnings with place and remedy, assumptions, friction,
  // its spread, hems, gathered cloth and data stand on the page as the files have them.
  const auto folder = fresh_folder("report-truth");
  RunResult run = run_scene();
  run.status = postproc::Status::partial;
  run.truth = {.stage = "body, step by step", .fraction = 0.25, .stiffening = 12.0};
  run.remedies = {"give contact.friction"};
  run.assumptions = {"friction 0.31: textiles on dry skin"};
  run.hems = {{.edge = "upper", .length = 0.5, .strip = 0.021, .force = 3.0, .line_load = 0.417}};
  run.warnings = {{"gathered cloth", "23 % of the cloth lies in folds", "heights 10 to 20 mm", "hold both edges", "gathered_share", 0.23, 0.05}};
  run.numbers = {{"max_contact_pressure_Pa", 321.0}, {"gathered_share", 0.23}, {"fabric_beyond_data_share", 0.41}, {"fabric_data_end", 0.246},
                 {"fabric_largest_strain", 0.317}, {"max_shear_traction_Pa", 77.0}, {"slipping_share_of_contact", 0.52}};
  run.balance.friction_force = 4.85;
  run.donning = {{"friction on the tightened garment", 1.0, true, 266.0, 300.0}};
  input::ComfortSpec trial;
  trial.curves.name = "wear trial 2002";
  write_results(run, evaluate(run, trial), folder);
  const std::string html = page(folder, {});
  for (const char* part : {"at 25.0 % of the stage &quot;body, step by step&quot;, the body 12 times as stiff as it is", "give contact.friction",
                           "friction 0.31: textiles on dry skin", "0.417", "beside the hems", "23 % of the cloth lies in folds",
                           "heights 10 to 20 mm", "hold both edges", "stretched by up to 31.7 %", "Slipping share", "4.85",
                           "friction on the tightened garment"})
    EXPECT_THAT(html, HasSubstr(part));
  EXPECT_THAT(html, Not(HasSubstr("id=\"comfort\"")));
  run.status = postproc::Status::converged;
  write_results(run, evaluate(run, trial), folder);
  EXPECT_THAT(page(folder, {}), HasSubstr("id=\"comfort\""));
}

TEST(Page, DrawsThePiecesFlatAndListsWhatTheyBearAndTheirSeams) {
  // A square of two triangles, 200 mm wide, is 0.9 of the drawing's 760 px high, in half pixels: 1368; each quantity that is known is one drawing.
  RunResult run = run_scene();
  run.garment.parts = {{.name = "vest", .first_node = 0, .end_node = 9, .first_triangle = 0, .end_triangle = 2, .pieces = {"front", "back"}}};
  run.garment.piece = {0, 1};
  run.pieces = {{.garment = "vest", .piece = "front", .fabric = "N85L15", .area = 0.02, .weight = 0.0043, .tension_warp = 20.5, .tension_weft = 10.4, .largest_tension = 33.3,
                 .stretch_warp = 1.1234, .stretch_weft = 1.05}};
  run.seams = {{.garment = "vest", .seam = "left", .length = 0.31, .line_load = 17.6, .largest = 21.9, .along = 2.22}};
  run.fit = {{.garment = "vest", .height = 0.0, .body_girth = 0.5, .garment_girth = 0.45}, {.garment = "vest", .height = 0.1, .body_girth = 0.5, .garment_girth = 0.4}};
  run.profile = {{.garment = "vest", .height = 0.05, .wanted = 2000.0, .found = 1930.0}};
  const std::string text = page(stored_run(run, {}, {}, "vest"), {{}, "none"});
  for (const char* what : {"id=\"pieces\"", "vest, front", "N85L15", "200", "4.30", "33.3", "1.123", "vest, left", "17.6", "21.9", "2.22", "310", "96.5", "M0 1368l1368 0 -1368 -1368z",
                           "M1368 1368l0 -1368 -1368 0z", "<strong>Tension</strong> [N/m]", "<strong>Stretch</strong> [%]", "<strong>Ease</strong> [%]", ">front</text>", ">back</text>"})
    EXPECT_THAT(text, HasSubstr(what)) << what;
  run.fit.clear();
  EXPECT_THAT(page(stored_run(run, {}, {}, "vest"), {{}, "none"}), Not(HasSubstr("<strong>Ease</strong>")));
}

TEST(Page, GarmentOrBodyMayBeLeftOut) {
  // A body alone and a garment alone have pages of their own.
  const auto folder = fresh_folder("report-alone");
  RunResult body = run_scene(), garment = run_scene();
  body.garment = {};
  write_results(body, {}, folder);
  EXPECT_THAT(page(folder, {}), Not(HasSubstr("\"garment\":{")));
  garment.body = {};
  write_results(garment, {}, folder);
  const std::string html = page(folder, {});
  EXPECT_THAT(html, HasSubstr("\"garment\":{"));
  EXPECT_THAT(html, Not(HasSubstr("<svg class=\"plot map\"")));
}

TEST(ComparisonPage, PutsRunsSideBySide) {
  // Two runs of one case with another fabric: the difference of the pressures in percent, the value of the case that
  // differs and no other, one map a run with one scale.
  const auto first = fresh_folder("report-first"), second = fresh_folder("report-second");
  RunResult run = run_scene();
  write_results(run, evaluate(run, {}), first);
  std::ofstream(first / "case.echo.toml") << "[garment]\nfabric = \"A\"\norder = 2\n[[load]]\nforce = \"1 N\"\n";
  run.numbers["mean_contact_pressure_Pa"] = 330.0;
  for (double& p : run.body.fields[field::contact_pressure]) p *= 1.1;
  write_results(run, evaluate(run, {}), second);
  std::ofstream(second / "case.echo.toml") << "[garment]\nfabric = \"B\"\norder = 2\n[[load]]\nforce = \"1 N\"\n";
  const std::string html = comparison_page({first, second});
  for (const char* part : {"snug-postproc-report-first", "snug-postproc-report-second", "+10.0 %", "garment.fabric",
                           "&quot;B&quot;", "map-0", "map-1", "Front thigh"})
    EXPECT_THAT(html, HasSubstr(part));
  for (const char* part : {"garment.order", "load.1.force", "map-2", "{{", "<script"})
    EXPECT_THAT(html, Not(HasSubstr(part)));
}

}  // namespace
}  // namespace snug::postproc::report
