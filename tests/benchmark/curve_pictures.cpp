// The pictures of docs/curves.md: build and run the target snug_curve_pictures by scripts/curves.
//
// usage: snug_curve_pictures FOLDER
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "mesh/curves/composition.hpp"
#include "mesh/curves/joins.hpp"
#include "mesh/curves/quadratic_spline.hpp"
#include "mesh/formats/curve_set.hpp"

namespace {

using namespace snug::mesh;
using namespace snug::mesh::curves;

Eigen::MatrixXd columns(std::initializer_list<Eigen::Vector2d> points) {
  Eigen::MatrixXd matrix(2, points.size());
  Eigen::Index i = 0;
  for (const Eigen::Vector2d& point : points) matrix.col(i++) = point;
  return matrix;
}

WCurve example_curve() {
  const Eigen::MatrixXd points = columns({{0, 0}, {1, 3}, {4, 3.4}, {5.4, 0.6}, {3.6, -0.6}});
  return {SegmentKnots({-1.3, -0.9, -0.4, 0.0}, {1.0, 1.5, 2.2, 3.0}), points, Eigen::VectorXd{{1, 1.5, 0.7, 1.2, 1}}};
}

/// The W curve with its polygon and, finer, its Bézier polygon.
CurveSet w_curve() {
  CurveSet set;
  set.curves = {{"W", b_spline_of(example_curve())}, {"Bézier", b_spline_of(example_curve().bezier())}};
  return set;
}

/// The curve as the envelope of its tangents, which three of its four steps leave.
CurveSet envelope() {
  CurveSet set;
  set.curves = {{"W", b_spline_of(example_curve())}};
  for (int k = 0; k <= 10; ++k) set.curves.push_back({"", b_spline_of(example_curve().stepped(3, k / 10.0))});
  return set;
}

CurveSet w_surface() {
  Eigen::Matrix3Xd points(3, 12);
  Eigen::VectorXd weights(12);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j) {
      points.col(i * 3 + j) << i, 1.5 * j, std::sin(1.3 * i + 0.4 * j) + (j == 1);
      weights[i * 3 + j] = j == 1 ? 2.0 : 1.0;
    }
  CurveSet set;
  set.surfaces = {{"surface", b_spline_of(WSurface(SegmentKnots({-1.0, -0.3, 0.0}, {1.0, 1.4, 2.0}),
                                                   SegmentKnots::bezier(2), points, weights))}};
  return set;
}

/// A quarter of a cylinder: degrees 2 and 1.
CurveSet cylinder() {
  const double h = std::numbers::sqrt2 / 2.0;
  Eigen::Matrix3Xd points(3, 6);
  points << 1, 1, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1, 0, 2, 0, 2, 0, 2;
  CurveSet set;
  set.surfaces = {{"cylinder", b_spline_of(WSurface(SegmentKnots::bezier(2), SegmentKnots::bezier(1), points,
                                                    Eigen::VectorXd{{1, 1, h, h, 1, 1}}))}};
  return set;
}

BForm triangle() {
  const MultiIndices indices(3, 3);
  Eigen::MatrixXd points(3, indices.count());
  for (int a = 0; a < indices.count(); ++a) {
    const double x = indices[a][1], y = indices[a][2];
    points.col(a) << x, y, 0.9 * std::sin(x + 0.7 * y) + (x > 0 && y > 0 ? 0.5 : 0.0);
  }
  return {3, 3, points};
}

CurveSet b_form() {
  CurveSet set;
  set.forms = {{"triangle", triangle()}};
  return set;
}

/// A B-form of six corners over the regular hexagon, drawn along rays from the middle and round it.
CurveSet hexagon() {
  const MultiIndices indices(6, 2);
  Eigen::MatrixXd points(3, indices.count());
  for (int a = 0; a < indices.count(); ++a) {
    Eigen::Vector2d place(0, 0);
    int different = 0;
    for (int j = 0; j < 6; ++j) {
      place +=
          indices[a][j] * 0.5 * Eigen::Vector2d(std::cos(j * std::numbers::pi / 3), std::sin(j * std::numbers::pi / 3));
      different += indices[a][j] > 0;
    }
    points.col(a) << place.x(), place.y(), different == 2 ? 0.6 : 0.1;
  }
  const BForm form(6, 2, points);
  CurveSet set;
  Net net{5, 24, false, true, Eigen::MatrixXd(3, 5 * 24)};
  for (int i = 0; i < net.rows; ++i)
    for (int j = 0; j < net.columns; ++j) {
      const int side = j / 4;
      const auto corner = [](int k) {
        return Eigen::Vector2d(std::cos(k * std::numbers::pi / 3), std::sin(k * std::numbers::pi / 3));
      };
      const Eigen::Vector2d edge = corner(side) + (j % 4) / 4.0 * (corner(side + 1) - corner(side));
      net.points.col(i * net.columns + j) = form.value(polygon_coordinates(6, i / 4.0 * edge));
    }
  set.nets = {{"hexagon", net}};
  return set;
}

/// A triangle and the rectangle joined to its edge u1u2 with one tangent plane.
CurveSet join() {
  const BForm first = triangle();
  Eigen::MatrixXd r(3, 16);
  for (int i = 0; i <= 3; ++i)
    for (int j = 0; j <= 3; ++j) r.col(i * 4 + j) << i, -j, 0.3 * j;
  complete(r, rectangle_join(3, {1.8, 0.2, -1.0}, {1.8, 0.2, -1.0}), first.coefficients());
  CurveSet set;
  set.forms = {{"triangle", first}};
  set.surfaces = {
      {"rectangle", b_spline_of(WSurface(SegmentKnots::bezier(3), SegmentKnots::bezier(3), Eigen::Matrix3Xd(r)))}};
  return set;
}

/// A vest's upper part as a control net, closed round the body.
CurveSet four_point() {
  Net net{5, 8, false, true, Eigen::MatrixXd(3, 40)};
  const double width[] = {0.18, 0.155, 0.17, 0.175, 0.15};
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 8; ++j) {
      const double angle = j * std::numbers::pi / 4;
      net.points.col(i * 8 + j) << width[i] * std::cos(angle), 0.7 * width[i] * std::sin(angle), 0.1 * i;
    }
  CurveSet set;
  set.nets = {{"vest", net}};
  return set;
}

CurveSet quadratic_spline() {
  const Eigen::MatrixXd points = columns({{0, 0}, {1, 1.6}, {2.2, 1.1}, {3, 2.2}, {4.6, 1.4}, {5, 0}});
  CurveSet set;
  set.curves = {{"spline", b_spline_of(QuadraticSpline::by_chords(points))}};
  return set;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: snug_curve_pictures FOLDER\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const std::pair<const char*, CurveSet> pictures[] = {
      {"w-curve", w_curve()},   {"envelope", envelope()},     {"w-surface", w_surface()},
      {"cylinder", cylinder()}, {"b-form", b_form()},         {"hexagon", hexagon()},
      {"join", join()},         {"four-point", four_point()}, {"quadratic-spline", quadratic_spline()}};
  for (const auto& [name, set] : pictures)
    std::ofstream(folder / (std::string(name) + ".svg")) << curve_svg(set, {.subdivisions = 4, .width = 420.0});
}
