#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <unistd.h>

#include "mesh/body/elliptic_outline.hpp"
#include "mesh/body/spline_outline.hpp"
#include "mesh/formats/curve_set.hpp"
#include "tests/unit/mesh/bodies.hpp"

namespace snug::mesh {
namespace {

using ::testing::HasSubstr;
using std::numbers::pi;

/// A tapering, bent limb of elliptic sections 0.3 m long.
EllipticOutline forearm() {
  return EllipticOutline({{0.0, 0.030, 0.022, 0.0, 0.0}, {0.1, 0.036, 0.028, 0.002, 0.001}, {0.2, 0.044, 0.040, 0.004, 0.001}, {0.3, 0.046, 0.043, 0.003, -0.002}});
}

/// Points of an outline: `tilt` lets the sections rise towards +x (a share of the way).
curves::Net points_of(const Outline& outline, int rows, int columns, double tilt = 0.0) {
  curves::Net net{.rows = rows, .columns = columns, .rows_closed = false, .columns_closed = true, .points = Eigen::MatrixXd(3, rows * columns)};
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double turn = (j + 0.3 * std::sin(2 * pi * j / columns)) / columns, z = 0.3 * i / (rows - 1);
      net.points.col(i * columns + j) = outline.at(turn, z + tilt * outline.at(turn, z).x());
    }
  return net;
}

SplineOutline through(const curves::Net& net) { return {net, "the net", {}}; }

/// A net of a limb in a file of its own, read as a case would.
class OutlineFiles : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }
  Limb limb(const std::vector<Named<curves::Net>>& nets) const {
    CurveSet set;
    set.nets = nets;
    return limb(curve_json(set));
  }
  Limb limb(const std::string& text) const {
    std::ofstream(file_) << text;
    input::BodySpec spec = layered_spec();
    spec.stations = file_;
    return make_limb(spec);
  }
  template <class What>
  std::string refusal(const What& what) const {
    try {
      limb(what);
    } catch (const input::InputError& error) {
      return error.what();
    }
    return "no error";
  }

  const std::filesystem::path file_ = std::filesystem::temp_directory_path() / fmt::format("snug-outlines-{}.json", ::getpid());
};

TEST(SplineOutlines, PassThroughThePointsOfSectionsThatAreNotLevel) {
  const curves::Net net = points_of(forearm(), 5, 11, 0.4);
  const SplineOutline outline = through(net);
  for (Eigen::Index k = 0; k < net.points.cols(); ++k) {
    const Eigen::Vector3d point = net.points.col(k);
    const Eigen::Vector2d from = point.head<2>() - section_centre(outline, point.z());
    const double turn = outline.turn_at_angle(std::atan2(from.y(), from.x()), point.z());
    EXPECT_LT((outline.at(turn, point.z()) - point).norm(), 1e-12) << k;
  }
}

TEST(SplineOutlines, DerivativesAreThoseOfThePoints) {
  // By fourth-order differences of the points, whose own error is some 1e-9 of a second derivative; above, below and between the sections.
  const SplineOutline outline = through(points_of(forearm(), 6, 13, 0.4));
  for (const double turn : {0.03, 0.26, 0.61, 0.97})
    for (const double z : {-0.05, 0.04, 0.13, 0.29, 0.36}) {
      const OutlinePoint exact = outline.derivatives(turn, z), found = outline.Outline::derivatives(turn, z);
      const auto near = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, double bound) { EXPECT_LT((a - b).norm(), bound * (1.0 + b.norm())) << turn << " " << z; };
      near(exact.x, found.x, 1e-14);
      EXPECT_EQ(exact.x.z(), z);
      EXPECT_EQ(outline.at(turn, z).z(), z);
      near(exact.x_t, found.x_t, 1e-8);
      near(exact.x_z, found.x_z, 1e-8);
      near(exact.x_tt, found.x_tt, 1e-4);
      near(exact.x_tz, found.x_tz, 1e-4);
      near(exact.x_zz, found.x_zz, 1e-4);
    }
}

TEST(SplineOutlines, CurvatureHasNoJumpWhereItsPatchesMeet) {
  const curves::Net net = points_of(forearm(), 5, 12);
  const SplineOutline outline = through(net);
  const double e = 1e-9;
  for (int j = 0; j < net.columns; ++j) {
    const Eigen::Vector3d point = net.points.col(2 * net.columns + j);
    const Eigen::Vector2d from = point.head<2>() - section_centre(outline, point.z());
    const double turn = outline.turn_at_angle(std::atan2(from.y(), from.x()), point.z());
    const OutlinePoint before = outline.derivatives(turn - e, point.z() - e), after = outline.derivatives(turn + e, point.z() + e);
    EXPECT_LT((before.x_tt - after.x_tt).norm(), 1e-5) << j;
    EXPECT_LT((before.x_zz - after.x_zz).norm(), 1e-5) << j;
  }
}

TEST(SplineOutlines, ComeToTheLimbWithTheFourthPowerOfThePointsDistanceAndItsCurvatureWithTheSecond) {
  const EllipticOutline exact({{0.0, 0.05, 0.04, 0.0, 0.0}, {0.3, 0.05, 0.04, 0.0, 0.0}});
  const auto errors = [&](int columns) {
    const Limb limb{std::make_unique<SplineOutline>(points_of(exact, 3, columns), "", input::Location{}), nullptr, 0.0, 0.3};
    double place = 0.0, curvature = 0.0;
    for (int k = 0; k < 50; ++k) {
      const double turn = k / 50.0;
      const Eigen::Vector3d x = limb.skin->at(turn, 0.11);
      const double t = std::atan2(x.y() / 0.04, x.x() / 0.05);
      const double k_exact = 0.05 * 0.04 / std::pow(std::pow(0.05 * std::sin(t), 2) + std::pow(0.04 * std::cos(t), 2), 1.5);
      place = std::max(place, std::abs(std::pow(x.x() / 0.05, 2) + std::pow(x.y() / 0.04, 2) - 1.0));
      curvature = std::max(curvature, std::abs(limb.skin_curvature(turn, 0.11)[0] / k_exact - 1.0));
    }
    return std::pair(place, curvature);
  };
  const auto coarse = errors(32), fine = errors(64);
  EXPECT_NEAR(std::log2(coarse.first / fine.first), 4.0, 0.4);
  EXPECT_NEAR(std::log2(coarse.second / fine.second), 2.0, 0.4);
  EXPECT_LT(fine.second, 0.01);
}

TEST(SplineOutlines, GoOnStraightBeyondTheirSections) {
  const SplineOutline outline = through(points_of(forearm(), 4, 12));
  for (const double turn : {0.1, 0.55}) {
    for (const double end_height : {0.0, 0.3}) {
      const double way = end_height > 0.0 ? 0.12 : -0.12;
      const OutlinePoint end = outline.derivatives(turn, end_height), beyond = outline.derivatives(turn, end_height + way);
      EXPECT_LT((beyond.x - (end.x + way * end.x_z)).norm(), 1e-12);
      EXPECT_LT(end.x_zz.norm(), 1e-9);
    }
  }
}

TEST_F(OutlineFiles, ALimbOfNetsIsTheLimbOfItsSections) {
  // Sections of a circle of 5 cm: 24 points put the girth 2e-5 beside it (fourth order).
  const Ellipse skin{0.0, 0.05, 0.05, 0.0, 0.0}, bone{0.0, 0.01, 0.01, 0.005, 0.0};
  const Limb straight = straight_limb(skin, bone, 0.0, 0.3);
  const Limb found = limb({{"bone", points_of(*straight.bone, 3, 24)}, {"skin", points_of(*straight.skin, 4, 24)}});
  EXPECT_NEAR(found.girth(0.17), 2.0 * pi * 0.05, 2e-5 * 2.0 * pi * 0.05);
  EXPECT_NEAR(section_centre(*found.bone, 0.2).x(), 0.005, 1e-6);
  EXPECT_DOUBLE_EQ(found.lower, 0.0);
  EXPECT_DOUBLE_EQ(found.upper, 0.3);
  EXPECT_TRUE(found.remarks.empty());
}

TEST_F(OutlineFiles, WithoutABoneAQuarterOfEverySectionIsTakenAndThatIsSaid) {
  const Limb found = limb({{"arm", points_of(forearm(), 4, 16)}});
  for (const double z : {0.05, 0.22}) {
    const Eigen::Vector2d centre = section_centre(*found.skin, z);
    EXPECT_LT((section_centre(*found.bone, z) - centre).norm(), 1e-3);
    EXPECT_NEAR((found.bone->at(0.1, z) - found.bone->at(0.6, z)).norm() / (found.skin->at(0.1, z) - found.skin->at(0.6, z)).norm(), 0.25, 1e-9);
  }
  ASSERT_EQ(found.remarks.size(), 1u);
  EXPECT_THAT(found.remarks[0].found, HasSubstr("25 % of each section"));
}

TEST_F(OutlineFiles, RowsDownwardsColumnsClockwiseOrALimbFromAnotherPointAreTheSame) {
  const curves::Net net = points_of(forearm(), 4, 12, 0.2);
  curves::Net other = net;
  for (int i = 0; i < net.rows; ++i)
    for (int j = 0; j < net.columns; ++j) other.points.col(i * net.columns + j) = net.points.col((net.rows - 1 - i) * net.columns + (2 * net.columns + 4 - j) % net.columns);
  const Limb a = limb({{"skin", net}}), b = limb({{"skin", other}});
  for (const double turn : {0.0, 0.2, 0.7}) EXPECT_LT((a.skin->at(turn, 0.13) - b.skin->at(turn, 0.13)).norm(), 1e-12) << turn;
}

TEST_F(OutlineFiles, NetsThatAreNoLimbAreRefusedWithPlaceAndRemedy) {
  curves::Net swapped = points_of(forearm(), 4, 12);
  swapped.points.col(2 * 12 + 5).swap(swapped.points.col(2 * 12 + 6));
  EXPECT_THAT(refusal(std::vector<Named<curves::Net>>{{"skin", swapped}}), HasSubstr("do not go round one after the other in the section at 200 mm (point 7 of 12)"));
  curves::Net sunk = points_of(forearm(), 4, 12);
  sunk.points(2, 3 * 12 + 1) = 0.15;
  EXPECT_THAT(refusal(std::vector<Named<curves::Net>>{{"skin", sunk}}), HasSubstr("does not go up everywhere"));
  curves::Net millimetres = points_of(forearm(), 4, 12);
  millimetres.points *= 1e3;
  EXPECT_THAT(refusal(std::vector<Named<curves::Net>>{{"skin", millimetres}}), HasSubstr("look at \"unit\" in the file"));
  const curves::Net skin = points_of(forearm(), 4, 12);
  curves::Net bone = skin;
  bone.points.topRows<2>() *= 1.1;
  EXPECT_THAT(refusal(std::vector<Named<curves::Net>>{{"skin", skin}, {"bone", bone}}), HasSubstr("the bone is outside the skin at height"));
  EXPECT_THAT(refusal(std::vector<Named<curves::Net>>{{"left", skin}, {"right", skin}}), HasSubstr("has 2 nets"));
  EXPECT_THAT(refusal(std::string("{\"format\": \"snug curves\", \"unit\": \"1 m\"}")), HasSubstr("there is no net in"));
}

}  // namespace
}  // namespace snug::mesh
