#include "mesh/placement/body_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "mesh/body/sections.hpp"

namespace snug::mesh {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using input::InputError;

Vector3d direction(input::FileAxis axis) {
  const int n = static_cast<int>(axis);
  return (n < 3 ? 1.0 : -1.0) * Vector3d::Unit(n % 3);
}

/// Some right-handed frame whose third axis is the file's upwards one; its second is the file's front where one is
/// given.
Matrix3d upright(const BodyAxes& axes, const input::Location& where) {
  const Vector3d up = direction(axes.up);
  const Vector3d front =
      axes.front ? direction(*axes.front) : Vector3d(Vector3d::Unit((static_cast<int>(axes.up) + 2) % 3));
  if (std::abs(up.dot(front)) > 0.5)
    throw InputError(where, "up and front of the body lie along one axis of the file",
                     "name the axes that point up and to the front of the body");
  Matrix3d rotation;
  rotation << front.cross(up).transpose(), front.transpose(), up.transpose();
  return rotation;
}

double volume(const TriangleSurface& surface) {
  double sum = 0.0;
  const Vector3d origin = surface.vertices[0];
  for (const auto& t : surface.triangles)
    sum += (surface.vertices[t[0]] - origin)
               .dot((surface.vertices[t[1]] - origin).cross(surface.vertices[t[2]] - origin)) /
           6.0;
  return sum;
}

/// Turns the triangles outwards.
void orient(TriangleSurface& surface, double stature, const input::Location& where) {
  const double enclosed = volume(surface);
  if (std::abs(enclosed) < 1e-4 * stature * stature * stature)
    throw InputError(where,
                     fmt::format("the surface encloses {:.3g} litres at a height of {:.3g} m", 1e3 * enclosed, stature),
                     "give the closed surface of a whole body, its triangles turned one way, and the unit of the file");
  if (enclosed < 0.0)
    for (auto& t : surface.triangles) std::swap(t[1], t[2]);
}

struct Shanks {
  Vector2d one, other;
};

Shanks find_shanks(const TriangleSurface& surface, double stature, const input::Location& where) {
  std::vector<SectionLoop> loops = slice(surface, 0.2 * stature);
  if (loops.size() < 2)
    throw InputError(where,
                     fmt::format("a section at a fifth of the height ({:.0f} mm) has {} closed loops, not two shanks",
                                 0.2e3 * stature, loops.size()),
                     "give a standing body with its legs apart, and the axis of the file that points up");
  std::partial_sort(loops.begin(), loops.begin() + 2, loops.end(),
                    [](const SectionLoop& a, const SectionLoop& b) { return a.girth > b.girth; });
  return {loops[0].centroid, loops[1].centroid};
}

/// Unit direction to the front, at a right angle to the line between the shanks.
Vector2d find_front(const TriangleSurface& surface, double stature, const Shanks& shanks, bool given,
                    const input::Location& where) {
  const Vector2d across = (shanks.other - shanks.one).normalized(), middle = 0.5 * (shanks.one + shanks.other);
  Vector2d front(-across.y(), across.x());
  if (given) return front.y() < 0.0 ? Vector2d(-front) : front;
  double sum = 0.0;
  int count = 0;
  for (const Vector3d& vertex : surface.vertices)
    if (vertex.z() < 0.03 * stature) sum += (vertex.head<2>() - middle).dot(front), ++count;
  const double toes = count > 0 ? sum / count : 0.0;
  if (std::abs(toes) < 0.004 * stature)
    throw InputError(
        where, fmt::format("which side is the front does not show: the feet lie {:.1f} mm off the shanks", 1e3 * toes),
        "name the axis of the file that points to the front of the body");
  return toes < 0.0 ? Vector2d(-front) : front;
}

}  // namespace

void check_encloses(const TriangleSurface& surface, const input::Location& where) {
  std::map<std::array<int, 2>, int> balance;
  for (const auto& t : surface.triangles)
    for (int n = 0; n < 3; ++n) {
      const int a = t[n], b = t[(n + 1) % 3];
      balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  const auto open = [](const auto& edge) { return edge.second != 0; };
  const auto count = std::count_if(balance.begin(), balance.end(), open);
  if (count == 0) return;
  const auto& [ends, difference] = *std::find_if(balance.begin(), balance.end(), open);
  const Vector3d &a = surface.vertices[ends[0]], &b = surface.vertices[ends[1]];
  throw InputError(
      where,
      fmt::format("the surface is open, or its triangles are not turned one way: {} edges, one of them from ({:.4g}, "
                  "{:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g})",
                  count, a.x(), a.y(), a.z(), b.x(), b.y(), b.z()),
      "close its holes and unify its normals in the scanner's program");
}

BodySurface standing_body(TriangleSurface in_file, const BodyAxes& axes, const input::Location& where) {
  check_encloses(in_file, where);
  const Matrix3d rotation = upright(axes, where);
  for (Vector3d& vertex : in_file.vertices) vertex = rotation * (axes.unit * vertex);
  const auto lower = [](const Vector3d& a, const Vector3d& b) { return a.z() < b.z(); };
  const auto [low, high] = std::minmax_element(in_file.vertices.begin(), in_file.vertices.end(), lower);
  BodySurface body{.surface = std::move(in_file), .stature = high->z() - low->z(), .where = where};
  body.scale = body.stature;
  const double bottom = low->z();
  for (Vector3d& vertex : body.surface.vertices) vertex.z() -= bottom;
  orient(body.surface, body.stature, where);
  const Shanks shanks = find_shanks(body.surface, body.stature, where);
  const Vector2d front = find_front(body.surface, body.stature, shanks, axes.front.has_value(), where);
  const Vector2d middle = 0.5 * (shanks.one + shanks.other);
  Matrix3d yaw = Matrix3d::Identity();
  yaw.topLeftCorner<2, 2>() << front.y(), -front.x(), front.x(), front.y();
  const Vector3d origin(middle.x(), middle.y(), 0.0);
  for (Vector3d& vertex : body.surface.vertices) vertex = yaw * (vertex - origin);
  body.rotation = yaw * rotation;
  body.translation = yaw * (-origin - bottom * Vector3d::UnitZ());
  return body;
}

}  // namespace snug::mesh
