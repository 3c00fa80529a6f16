#include "solver/library/sensor.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>

#include "cases/input/job_checks.hpp"
#include "mesh/body/section_centres.hpp"
#include "postproc/skin_pressure.hpp"

namespace snug::solver {

namespace {

using Point = Eigen::Vector3d;

const input::LocationSpec* location_of(const input::SensorSpec& sensor, const input::Case& asked) {
  for (const input::LocationSpec& location : asked.body->locations)
    if (location.name == sensor.location) return &location;
  return nullptr;
}

/// Half way between the lowest and the highest node of a location.
double middle_height(const std::string& name, const mesh::BodyMesh& body) {
  double low = std::numeric_limits<double>::max(), high = -low;
  for (std::size_t n = 0; n < body.nodes.size(); ++n)
    if (const int l = body.node_location[n]; l >= 0 && body.locations[l] == name) low = std::min(low, body.nodes[n].z()), high = std::max(high, body.nodes[n].z());
  return 0.5 * (low + high);
}

/// The farthest point of a triangle's section at height z on the ray from `centre` at an angle.
std::optional<double> reach_along(const std::array<Point, 3>& corner, const Eigen::Vector2d& centre, double angle, double z) {
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
  std::array<Eigen::Vector2d, 2> cut;
  int found = 0;
  for (int i = 0; i < 3 && found < 2; ++i) {
    const Point &a = corner[i], &b = corner[(i + 1) % 3];
    if ((a.z() < z) != (b.z() < z)) cut[found++] = (a + (z - a.z()) / (b.z() - a.z()) * (b - a)).head<2>() - centre;
  }
  if (found < 2) return std::nullopt;
  const double s = across.dot(cut[0]), t = across.dot(cut[1]);
  if ((s < 0.0) == (t < 0.0)) return std::nullopt;
  const double way = along.dot(cut[0] + s / (s - t) * (cut[1] - cut[0]));
  return way > 0.0 ? std::optional(way) : std::nullopt;
}

Point nearest_skin_node(const Point& x, const mesh::BodyMesh& body) {
  Point best = x;
  double least = std::numeric_limits<double>::max();
  for (const auto& facet : body.skin_facets)
    for (const int n : facet)
      if (n >= 0 && (body.nodes[n] - x).squaredNorm() < least) least = (body.nodes[n] - x).squaredNorm(), best = body.nodes[n];
  return best;
}

/// The sensor's middle on the undeformed skin.
Point middle_of(const input::SensorSpec& sensor, const input::Case& asked, const mesh::BodyMesh& body) {
  const input::LocationSpec* location = location_of(sensor, asked);
  if (location && location->at && !sensor.height && !sensor.angle) return nearest_skin_node(Point((*location->at)[0], (*location->at)[1], (*location->at)[2]), body);
  const bool limb = location && location->limb;
  const mesh::SectionCentres centres = limb ? mesh::SectionCentres(body, Point((*location->limb)[0], (*location->limb)[1], (*location->limb)[2])) : mesh::SectionCentres(body);
  const double z = sensor.height.value_or(location ? middle_height(location->name, body) : 0.0);
  const double angle = sensor.angle.value_or(location ? input::middle_angle(*location).value_or(0.0) : 0.0);
  const Eigen::Vector2d centre = centres.at(z);
  double farthest = 0.0;
  for (const auto& t : mesh::triangulated_nodes(body)) {
    const std::array<Point, 3> corner = {body.nodes[t[0]], body.nodes[t[1]], body.nodes[t[2]]};
    if (const auto way = reach_along(corner, centre, angle, z); way && centres.holds(corner[0])) farthest = std::max(farthest, *way);
  }
  if (farthest == 0.0)
    throw input::InputError(sensor.where, fmt::format("the sensor \"{}\" at a height of {:.4g} mm is not on the skin", sensor.name, 1e3 * z), "give a height between the cuts of the body");
  return {centre.x() + farthest * std::cos(angle), centre.y() + farthest * std::sin(angle), z};
}

/// A facet of the skin cut into small plane cells, with what they bear.
class FineFacet {
 public:
  FineFacet(const postproc::RunResult& run, const std::vector<Point>& now, int facet, int parts) : run_(run), now_(now), facet_(facet), parts_(parts) {}

  /// cell(reference, deformed, area, pressure) at the middle of each.
  template <class Cell>
  void each(Cell cell) const {
    const std::array<int, 9>& nodes = run_.body.skin_facets[facet_];
    const bool triangle = nodes[8] < 0 && nodes[4] >= 0;
    for (int i = 0; i < parts_; ++i)
      for (int j = 0; j < (triangle ? parts_ - i : parts_); ++j) {
        const double low = triangle ? 0.0 : -1.0, step = (triangle ? 1.0 : 2.0) / parts_, x = low + i * step, y = low + j * step;
        if (!triangle) {
          one(x + 0.5 * step, y + 0.5 * step, (place(x + step, y + step) - place(x, y)).cross(place(x, y + step) - place(x + step, y)).norm() / 2.0, cell);
          continue;
        }
        const Point a = place(x, y), b = place(x + step, y), c = place(x, y + step);
        one(x + step / 3.0, y + step / 3.0, (b - a).cross(c - a).norm() / 2.0, cell);
        if (i + j + 1 < parts_) one(x + 2.0 * step / 3.0, y + 2.0 * step / 3.0, (place(x + step, y + step) - b).cross(c - b).norm() / 2.0, cell);
      }
  }

 private:
  template <class Cell>
  void one(double xi, double eta, double area, Cell& cell) const {
    cell(vector(run_.body.nodes, xi, eta), vector(now_, xi, eta), area, value(run_.body.fields[postproc::field::contact_pressure], xi, eta));
  }
  Point place(double xi, double eta) const { return vector(now_, xi, eta); }
  double value(const std::vector<double>& field, double xi, double eta) const {
    return postproc::field_at(run_.body.skin_facets, postproc::ContactSample{.facet = facet_, .xi = xi, .eta = eta}, field);
  }
  Point vector(const std::vector<Point>& field, double xi, double eta) const {
    Point sum = Point::Zero();
    const auto weights = postproc::shape_at(run_.body.skin_facets[facet_], xi, eta);
    for (int n = 0; n < 9; ++n)
      if (run_.body.skin_facets[facet_][n] >= 0) sum += weights[n] * field[run_.body.skin_facets[facet_][n]];
    return sum;
  }

  const postproc::RunResult& run_;
  const std::vector<Point>& now_;
  int facet_, parts_;
};

/// Sum of both tensions of the cloth over the disc, N/m: the mean over the triangles whose middles are in it, or of the nearest one.
double tension_over(const Point& middle, double radius, const postproc::GarmentResult& garment) {
  const std::vector<double>*warp = garment.fields.find(postproc::field::tension_warp), *weft = garment.fields.find(postproc::field::tension_weft);
  if (!warp || !weft) return std::numeric_limits<double>::quiet_NaN();
  double area = 0.0, sum = 0.0, nearest = std::numeric_limits<double>::max(), of_nearest = nearest;
  for (std::size_t t = 0; t < garment.triangles.size(); ++t) {
    const Point &a = garment.current[garment.triangles[t][0]], &b = garment.current[garment.triangles[t][1]], &c = garment.current[garment.triangles[t][2]];
    const double away = ((a + b + c) / 3.0 - middle).norm(), own = 0.5 * (b - a).cross(c - a).norm(), tension = (*warp)[t] + (*weft)[t];
    if (away < nearest) nearest = away, of_nearest = tension;
    if (away < radius) area += own, sum += own * tension;
  }
  return area > 0.0 ? sum / area : of_nearest;
}

/// Where the cloth near a place is, from the corners of its triangles: what of the skin lies under it.
class ClothNear {
 public:
  /// Triangles of which a corner is within `reach` of `middle`, m, all as they are now.
  ClothNear(const postproc::GarmentResult& garment, const Point& middle, double reach) {
    for (const postproc::GarmentPart& part : garment.parts) {
      std::map<std::pair<int, int>, int> sides;
      const auto side = [](int a, int b) { return std::pair(std::min(a, b), std::max(a, b)); };
      for (int t = part.first_triangle; t < part.end_triangle; ++t)
        for (int i = 0; i < 3; ++i) ++sides[side(garment.triangles[t][i], garment.triangles[t][(i + 1) % 3])];
      std::vector<Triangle>& own = parts_.emplace_back();
      for (int t = part.first_triangle; t < part.end_triangle; ++t) {
        Triangle triangle;
        double nearest = std::numeric_limits<double>::max();
        for (int i = 0; i < 3; ++i) {
          triangle.corner[i] = garment.current[garment.triangles[t][i]];
          triangle.border[i] = sides[side(garment.triangles[t][i], garment.triangles[t][(i + 1) % 3])] == 1;
          nearest = std::min(nearest, (triangle.corner[i] - middle).norm());
        }
        if (nearest < reach) own.push_back(triangle);
      }
    }
  }

  /// Whether a point of the skin has cloth over it: the nearest of the cloth is not its border.
  bool covers(const Point& x) const {
    return std::any_of(parts_.begin(), parts_.end(), [&](const std::vector<Triangle>& part) {
      double least = std::numeric_limits<double>::max();
      bool inside = false;
      for (const Triangle& triangle : part)
        if (const auto [away, within] = triangle.nearest(x); away < least) least = away, inside = within;
      return inside;
    });
  }

 private:
  struct Triangle {
    std::array<Point, 3> corner;
    std::array<bool, 3> border = {};  ///< of the side from corner i to the next: nothing is sewn to it

    /// Distance, and whether it is to the inside or to a side that goes on.
    std::pair<double, bool> nearest(const Point& x) const {
      const Point u = corner[1] - corner[0], v = corner[2] - corner[0], n = u.cross(v), d = x - corner[0];
      const double whole = n.squaredNorm(), a = u.cross(d).dot(n) / whole, b = d.cross(v).dot(n) / whole;
      if (a >= 0.0 && b >= 0.0 && a + b <= 1.0) return {std::abs(d.dot(n)) / std::sqrt(whole), true};
      double least = std::numeric_limits<double>::max();
      bool within = false;
      for (int i = 0; i < 3; ++i) {
        const Point along = corner[(i + 1) % 3] - corner[i];
        const double s = std::clamp(along.dot(x - corner[i]) / along.squaredNorm(), 0.0, 1.0), away = (corner[i] + s * along - x).norm();
        if (away < least || (away == least && border[i])) least = away, within = !border[i];
      }
      return {least, within};
    }
  };
  std::vector<std::vector<Triangle>> parts_;  ///< by garment
};

/// Mean pressure of the cloth that lies on the disc, by the forces that it passes to the skin there; nothing where none are known one by one (tier L0).
std::optional<double> pressure_of_cloth(const Point& middle, double radius, const postproc::RunResult& run) {
  double force = 0.0, area = 0.0;
  for (const postproc::ContactSample& sample : run.samples) {
    if (sample.facet < 0 || !(sample.area > 0.0)) continue;
    Point at = Point::Zero();
    const auto weights = postproc::shape_at(run.body.skin_facets[sample.facet], sample.xi, sample.eta);
    for (int n = 0; n < 9; ++n)
      if (run.body.skin_facets[sample.facet][n] >= 0) at += weights[n] * run.body.nodes[run.body.skin_facets[sample.facet][n]];
    if ((at - middle).norm() <= radius) force += sample.force, area += sample.area;
  }
  return area > 0.0 ? std::optional(force / area) : std::nullopt;
}

/// How far a facet's nodes are from a point at least, and how long it is.
std::pair<double, double> near_and_size(const std::array<int, 9>& facet, const std::vector<Point>& nodes, const Point& x) {
  double near = std::numeric_limits<double>::max(), size = 0.0;
  for (const int n : facet)
    if (n >= 0) near = std::min(near, (nodes[n] - x).norm()), size = std::max(size, (nodes[n] - nodes[facet[0]]).norm());
  return {near, size};
}

/// Where the skin node is now that is nearest to a place on the undeformed skin.
Point middle_now(const Point& x, const postproc::RunResult& run, const std::vector<Point>& now) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::max();
  for (const auto& facet : run.body.skin_facets)
    for (const int n : facet)
      if (n >= 0 && (run.body.nodes[n] - x).squaredNorm() < least) least = (run.body.nodes[n] - x).squaredNorm(), best = static_cast<std::size_t>(n);
  return now[best];
}

double longest_side(const postproc::GarmentResult& garment) {
  double longest = 0.0;
  for (const auto& t : garment.triangles)
    for (int i = 0; i < 3; ++i) longest = std::max(longest, (garment.current[t[(i + 1) % 3]] - garment.current[t[i]]).norm());
  return longest;
}

postproc::SensorRow row_of(const input::SensorSpec& sensor, const Model& model, const Meshes& meshes, const postproc::RunResult& run, const std::vector<Point>& now) {
  postproc::SensorRow row{.name = sensor.name, .at = middle_of(sensor, model.asked, meshes.body), .diameter = sensor.diameter, .thickness = sensor.thickness};
  constexpr double across = 150.0;  // cells over the diameter: half a row of them, which a straight hem may gain or lose, is 0.4 % of the area
  const double radius = 0.5 * sensor.diameter;
  const ClothNear cloth(run.garment, middle_now(row.at, run, now), 1.5 * sensor.diameter + 2.0 * longest_side(run.garment));
  double area = 0.0, covered = 0.0, force = 0.0;
  Point middle = Point::Zero();
  for (std::size_t f = 0; f < run.body.skin_facets.size(); ++f) {
    const auto [near, size] = near_and_size(run.body.skin_facets[f], run.body.nodes, row.at);
    if (near > radius + size) continue;
    FineFacet(run, now, static_cast<int>(f), std::clamp(static_cast<int>(std::ceil(across * size / sensor.diameter)), 2, 400))
        .each([&](const Point& reference, const Point& deformed, double own, double pressure) {
          if ((reference - row.at).norm() > radius) return;
          area += own, middle += own * deformed;
          if (cloth.covers(deformed)) covered += own, force += own * pressure;
        });
  }
  if (area == 0.0) return row;
  row.coverage = covered / area;
  const std::optional<double> of_cloth = pressure_of_cloth(row.at, radius, run);
  row.skin_pressure = of_cloth ? row.coverage * *of_cloth : force / area;
  row.tension = tension_over(middle / area, radius, run.garment);
  if (sensor.bulge && std::isfinite(row.tension))
    row.bulge = row.coverage * bulge_pressure(row.tension, sensor.thickness, sensor.diameter, model.deformable() ? softest_shear_modulus(model) : std::numeric_limits<double>::infinity());
  return row;
}

}  // namespace

double bulge_pressure(double tension, double thickness, double diameter, double shear_modulus) {
  if (!(tension > 0.0)) return 0.0;
  const auto lift = [&](double height) { return tension * 8.0 * height / (diameter * diameter + 4.0 * height * height); };
  if (!std::isfinite(shear_modulus)) return lift(thickness);
  double low = 0.0, high = thickness;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high), yields = 16.0 * shear_modulus * (thickness - middle) / (std::numbers::pi * diameter);
    (lift(middle) < yields ? low : high) = middle;
  }
  return lift(0.5 * (low + high));
}

std::vector<Eigen::Vector3d> sensor_places(const std::vector<input::SensorSpec>& sensors, const input::Case& asked, const mesh::BodyMesh& body) {
  std::vector<Eigen::Vector3d> places;
  for (const input::SensorSpec& sensor : sensors) places.push_back(middle_of(sensor, asked, body));
  return places;
}

std::vector<postproc::SensorRow> sensor_rows(const std::vector<input::SensorSpec>& sensors, const Model& model, const Meshes& meshes, const postproc::RunResult& run) {
  std::vector<postproc::SensorRow> rows;
  if (sensors.empty() || run.status == postproc::Status::failed || !run.body.fields.has(postproc::field::contact_pressure)) return rows;
  const std::vector<Point> now = postproc::nodes_now(run.body);
  for (const input::SensorSpec& sensor : sensors) rows.push_back(row_of(sensor, model, meshes, run, now));
  return rows;
}

}  // namespace snug::solver
