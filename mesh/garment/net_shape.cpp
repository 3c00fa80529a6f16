#include "mesh/garment/net_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "cases/input/files.hpp"
#include "mesh/curves/root.hpp"
#include "mesh/formats/curve_set.hpp"
#include "mesh/garment/start_stretch.hpp"

namespace snug::mesh {

namespace {

using curves::Net;
using input::InputError;

constexpr double most_points = 1e6;  // of the subdivided net

/// A column of the net at a height, upright beyond its ends.
Eigen::Vector3d at_height(const Net& net, int column, double z) {
  const auto point = [&](int row) { return net_point(net, row, column); };
  const auto height = [&](int row) { return point(row).z(); };
  if (z <= height(0) || z >= height(net.rows - 1)) {
    const Eigen::Vector3d end = point(z <= height(0) ? 0 : net.rows - 1);
    return {end.x(), end.y(), z};
  }
  int below = 0, above = net.rows - 1;
  while (above - below > 1) {
    const int middle = (below + above) / 2;
    (height(middle) <= z ? below : above) = middle;
  }
  const double t = (z - height(below)) / (height(above) - height(below));
  return (1.0 - t) * point(below) + t * point(above);
}

void check_stretch(const RingNet& shape, const GarmentMesh& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& n = mesh.triangles[t];
    const Eigen::Vector2d stretch = principal_stretches(n, mesh.pattern, mesh.placed);
    if (can_start(stretch)) continue;
    throw InputError(shape.where, fmt::format("on {} the garment would be stretched to {:.2f} times its size ({:.2f} across) at height {:.0f} mm", shape.text, stretch[0], stretch[1], 1e3 * mesh.placed[n[0]].z()),
                     "look at the unit of the net, and let it follow the body more closely there");
  }
}

}  // namespace

RingNet read_net_shape(const input::ShapeSpec& spec) {
  RingNet shape = ring_net(parse_curve_json(input::read_file(spec.net), spec.net.string()), spec.net, spec.name, spec.where);
  if (static_cast<double>(shape.net.points.cols()) * std::pow(4.0, spec.subdivide) > most_points)
    throw InputError(shape.where, fmt::format("{} has {} points, subdivided {} times too many", shape.text, shape.net.points.cols(), spec.subdivide), "subdivide less");
  for (int step = 0; step < spec.subdivide; ++step) shape.net = curves::subdivided(shape.net);
  check_rises(shape);
  return shape;
}

Eigen::Vector3d on_ray(const RingNet& shape, const Eigen::Vector2d& centre, double angle, double z) {
  const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
  const auto side = [&](const Eigen::Vector3d& p) { return ray.x() * (p.y() - centre.y()) - ray.y() * (p.x() - centre.x()); };
  const auto ahead = [&](const Eigen::Vector3d& p) { return ray.dot(p.head<2>() - centre) > 0.0; };
  Eigen::Vector3d before = at_height(shape.net, shape.net.columns - 1, z), found = Eigen::Vector3d::Zero();
  int crossings = 0;
  for (int j = 0; j < shape.net.columns; ++j) {
    const Eigen::Vector3d here = at_height(shape.net, j, z);
    const double a = side(before), b = side(here);
    if ((a < 0.0) != (b < 0.0)) {
      const Eigen::Vector3d cut = before + a / (a - b) * (here - before);
      if (ahead(cut)) found = cut, ++crossings;
    }
    before = here;
  }
  if (crossings == 1) return {found.x(), found.y(), z};
  throw InputError(shape.where, fmt::format("{} does not go once round the body at height {:.0f} mm", shape.text, 1e3 * z),
                   "its points are to lie round the body's axis in the body's frame (snug check prints heights and girths), in a unit that the file names");
}

namespace {

double angle_of(const Eigen::Vector2d& from) { return std::atan2(from.y(), from.x()); }

/// Outward normal of the skin at the foot of a point that lies near it.
Eigen::Vector3d normal_below(const Limb& limb, const Eigen::Vector2d& centre, const Eigen::Vector3d& x) {
  Eigen::Vector3d foot = x, normal = Eigen::Vector3d::Zero();
  for (int i = 0; i < 4; ++i) {
    const double turn = limb.skin->turn_at_angle(angle_of(foot.head<2>() - centre), foot.z());
    const Eigen::Vector3d skin = limb.skin->at(turn - std::floor(turn), foot.z());
    normal = outward_normal(*limb.skin, turn - std::floor(turn), foot.z());
    foot = x - normal.dot(x - skin) * normal;
  }
  return normal;
}

/// How far (m) a point has to go along a direction to come to the shape; 0 where it lies outside already.
double way_out(const RingNet& shape, const Eigen::Vector2d& centre, const Eigen::Vector3d& x, const Eigen::Vector3d& direction) {
  const auto outside = [&](double way) {
    const Eigen::Vector3d p = x + way * direction;
    const Eigen::Vector2d from = p.head<2>() - centre;
    return from.norm() - (on_ray(shape, centre, angle_of(from), p.z()).head<2>() - centre).norm();
  };
  const curves::Sample here{0.0, outside(0.0)};
  if (here.value >= 0.0) return 0.0;
  double far = -2.0 * here.value, at_far = outside(far);
  for (int i = 0; i < 8 && at_far < 0.0; ++i) far *= 2.0, at_far = outside(far);
  if (at_far < 0.0)
    throw InputError(shape.where, fmt::format("{} cannot be reached from the skin at height {:.0f} mm", shape.text, 1e3 * x.z()), "let it follow the body more closely there");
  constexpr double near_enough = 1e-9;  // m
  return curves::bracketed_root(outside, here, {far, at_far}, near_enough, near_enough);
}

}  // namespace

void lay_on(const RingNet& shape, const Limb& limb, GarmentMesh& mesh) {
  std::map<double, Eigen::Vector2d> centres;  // the nodes of an edge share a height
  for (Eigen::Vector3d& x : mesh.placed) {
    auto it = centres.find(x.z());
    if (it == centres.end()) it = centres.emplace(x.z(), section_centre(*limb.skin, x.z())).first;
    const Eigen::Vector3d normal = normal_below(limb, it->second, x);
    x += way_out(shape, it->second, x, normal) * normal;
  }
  check_stretch(shape, mesh);
  mesh.fit.placing = "on " + shape.text;
}

}  // namespace snug::mesh
