#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <unistd.h>

#include "mesh/formats/curve_set.hpp"
#include "mesh/garment/garment_cut.hpp"
#include "tests/unit/mesh/bodies.hpp"

namespace snug::mesh {
namespace {

using ::testing::HasSubstr;

/// Nets in a file of their own.
class NetShapes : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove_all(file_); }

  /// Rows of `columns` points round the axis at these heights (m), of a radius by height and turn.
  template <class Radius>
  static curves::Net net(const std::vector<double>& heights, int columns, Radius radius) {
    curves::Net result{.rows = static_cast<int>(heights.size()), .columns = columns, .rows_closed = false, .columns_closed = true, .points = Eigen::MatrixXd(3, heights.size() * columns)};
    for (int i = 0; i < result.rows; ++i)
      for (int j = 0; j < columns; ++j) {
        const double angle = 2.0 * std::numbers::pi * j / columns, r = radius(heights[i], angle);
        result.points.col(i * columns + j) << r * std::cos(angle), r * std::sin(angle), heights[i];
      }
    return result;
  }
  input::ShapeSpec written(const std::vector<curves::Net>& nets) const {
    CurveSet set;
    for (const curves::Net& one : nets) set.nets.push_back({fmt::format("net {}", set.nets.size()), one});
    std::ofstream(file_) << curve_json(set);
    return {.net = file_, .name = "net 0"};
  }
  GarmentMesh worn(const curves::Net& net) const {
    input::GarmentSpec spec = tube_spec(0.28, 0.06, 0.08);
    spec.shape = written({net});
    return make_garment_mesh(read_cut(spec), cylinder(), 0.012);
  }
  std::string refusal(const input::ShapeSpec& shape) const {
    input::GarmentSpec spec = tube_spec(0.28, 0.06, 0.08);
    spec.shape = shape;
    try {
      make_garment_mesh(read_cut(spec), cylinder(), 0.012);
    } catch (const input::InputError& error) {
      return error.what();
    }
    return {};
  }

  const std::filesystem::path file_ = std::filesystem::temp_directory_path() / fmt::format("snug-nets-{}.json", ::getpid());
  const std::vector<double> heights_ = {0.0, 0.05, 0.1, 0.15, 0.2};
};

double cone(double z, double) { return 0.06 + 0.05 * z; }

TEST_F(NetShapes, AGarmentLiesOnTheNetOverThePlacesOfTheSkinWhereItLay) {
  // On a cylinder its heights and angles stay. A cone of twelve points a row: linear along, its first points between them lie 1 - (9 cos 15° - cos 45°)/8 = 1.73e-3 of the radius inside, chords of 96 points 0.54e-3.
  const GarmentMesh on_skin = make_garment_mesh(read_cut(tube_spec(0.28, 0.06, 0.08)), cylinder(), 0.012);
  const GarmentMesh on_net = worn(net(heights_, 12, cone));
  ASSERT_EQ(on_net.placed.size(), on_skin.placed.size());
  for (std::size_t n = 0; n < on_net.placed.size(); ++n) {
    const Eigen::Vector3d &x = on_net.placed[n], &skin = on_skin.placed[n];
    EXPECT_NEAR(x.z(), skin.z(), 1e-12);
    EXPECT_NEAR(x.head<2>().norm(), cone(x.z(), 0.0), 2.5e-3 * cone(x.z(), 0.0)) << n;
    EXPECT_NEAR(std::remainder(std::atan2(x.y(), x.x()) - std::atan2(skin.y(), skin.x()), 2.0 * std::numbers::pi), 0.0, 1e-9);
  }
  EXPECT_EQ(on_net.fit.placing, fmt::format("on the net net 0 of {}", file_.filename().string()));
  EXPECT_EQ(on_net.stand_off, on_skin.stand_off);
}

TEST_F(NetShapes, RowsDownwardsColumnsClockwiseOrRowsAlongTheAxisAreTheSameShape) {
  const curves::Net usual = net(heights_, 12, cone);
  const GarmentMesh expected = worn(usual);
  curves::Net down = usual, clockwise = usual;
  curves::Net along{.rows = usual.columns, .columns = usual.rows, .rows_closed = true, .columns_closed = false, .points = usual.points};
  for (int i = 0; i < usual.rows; ++i)
    for (int j = 0; j < usual.columns; ++j) {
      down.points.col((usual.rows - 1 - i) * usual.columns + j) = usual.points.col(i * usual.columns + j);
      clockwise.points.col(i * usual.columns + usual.columns - 1 - j) = usual.points.col(i * usual.columns + j);
      along.points.col(j * usual.rows + i) = usual.points.col(i * usual.columns + j);
    }
  for (const curves::Net& other : {down, clockwise, along}) {
    const GarmentMesh mesh = worn(other);
    for (std::size_t n = 0; n < mesh.placed.size(); ++n) ASSERT_LT((mesh.placed[n] - expected.placed[n]).norm(), 1e-12) << n;
  }
}

TEST_F(NetShapes, WhereTheNetCutsIntoTheBodyClothStaysOnTheSkin) {
  // 60 mm at one side of the limb of 50 mm, 40 mm at the other: a node is on the net or stands where it stood.
  const auto uneven = [](double, double angle) { return 0.05 + 0.01 * std::cos(angle); };
  const GarmentMesh on_skin = make_garment_mesh(read_cut(tube_spec(0.28, 0.06, 0.08)), cylinder(), 0.012);
  const GarmentMesh mesh = worn(net(heights_, 16, uneven));
  int moved = 0, stood = 0;
  for (std::size_t n = 0; n < mesh.placed.size(); ++n) {
    const double radius = mesh.placed[n].head<2>().norm();
    EXPECT_GE(radius, on_skin.placed[n].head<2>().norm());
    (mesh.placed[n] == on_skin.placed[n] ? stood : moved) += 1;
  }
  EXPECT_GT(moved, 50);
  EXPECT_GT(stood, 50);
}

TEST_F(NetShapes, BeyondItsEndsItGoesOnUpright) {
  const RingNet shape = read_net_shape(written({net({0.05, 0.06, 0.07}, 12, [](double z, double) { return z; })}));
  EXPECT_NEAR(on_ray(shape, {0, 0}, 0.0, 0.01).x(), 0.05, 1e-12);
  EXPECT_NEAR(on_ray(shape, {0, 0}, 0.0, 0.3).x(), 0.07, 1e-12);
  EXPECT_NEAR(on_ray(shape, {0, 0}, 0.0, 0.055).x(), 0.055, 1e-12);
  EXPECT_EQ(on_ray(shape, {0, 0}, 0.0, 0.3).z(), 0.3);
}

TEST_F(NetShapes, NetsThatAreNoShapeAreRefusedWithARemedy) {
  const curves::Net good = net(heights_, 12, cone);
  curves::Net open = good, back = good, large = good, beside = good;
  open.columns_closed = false;
  back.points(2, 12) = -0.01;  // a point of the second row below that of the first
  large.points *= 25.4;
  beside.points.row(0).array() += 0.3;
  EXPECT_THAT(refusal(written({open})), HasSubstr("\"closed\": [false, true]"));
  EXPECT_THAT(refusal(written({back})), HasSubstr("does not go up everywhere"));
  EXPECT_THAT(refusal(written({large})), HasSubstr("look at the unit of the net"));
  EXPECT_THAT(refusal(written({beside})), HasSubstr("does not go once round the body at height"));
  EXPECT_THAT(refusal(written({})), HasSubstr("there is no net in"));
  EXPECT_THAT(refusal(written({net(heights_, 3, cone)})), HasSubstr("3 points round the body"));
  input::ShapeSpec unnamed = written({good, good}), misnamed = unnamed;
  unnamed.name.clear(), misnamed.name = "net 7";
  EXPECT_THAT(refusal(unnamed), HasSubstr("\"net 0\", \"net 1\""));
  EXPECT_THAT(refusal(misnamed), HasSubstr("there is no net \"net 7\""));
  EXPECT_EQ(refusal(written({good})), "");
}

}  // namespace
}  // namespace snug::mesh
