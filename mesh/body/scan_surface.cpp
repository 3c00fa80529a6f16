#include "mesh/body/scan_surface.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mesh/surface/morph.hpp"

namespace snug::mesh {

namespace {

using input::InputError;
using input::Location;

Eigen::Vector3d direction(input::FileAxis axis) {
  const int n = static_cast<int>(axis);
  return (n < 3 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(n % 3);
}

/// Rows: the body's x (side), y (front) and z (up) in the axes of the file.
Eigen::Matrix3d file_to_body(const input::ScanSpec& spec, const Location& where) {
  const Eigen::Vector3d up = direction(spec.up), front = direction(spec.front);
  if (std::abs(up.dot(front)) > 0.5)
    throw InputError(where, fmt::format("up = \"{}\" and front = \"{}\" lie along one axis", text_of(spec.up), text_of(spec.front)),
                     "name the file's axes that point up and to the front of the body");
  Eigen::Matrix3d rotation;
  rotation << front.cross(up).transpose(), front.transpose(), up.transpose();
  return rotation;
}

double largest_extent(const TriangleSurface& surface) {
  Eigen::Vector3d low = surface.vertices.front(), high = low;
  for (const auto& x : surface.vertices) low = low.cwiseMin(x), high = high.cwiseMax(x);
  return (high - low).maxCoeff();
}

/// A person and parts of one are 5 cm to 2.3 m long: below 3 the file counts in metres, from 230 on in millimetres.
double guessed_unit(const TriangleSurface& surface, std::vector<std::string>& said) {
  const double size = largest_extent(surface);
  const auto [unit, name] = size < 3.0 ? std::pair{1.0, "m"} : size < 230.0 ? std::pair{1e-2, "cm"} : std::pair{1e-3, "mm"};
  said.push_back(fmt::format("unit left out: the file is taken to count in {}, which makes it {:.4g} m long", name, size * unit));
  return unit;
}

Eigen::Vector3d vector(const std::array<double, 3>& x) { return {x[0], x[1], x[2]}; }

/// Gives a standard body the stature and girths that are asked, and says what came out.
void reshape(const input::BodyMorph& asked, const Location& where, ScanSurface& scan) {
  scan.before = scan.surface.vertices;
  for (auto& x : scan.surface.vertices) x.z() *= asked.stature;
  std::vector<Ring> rings;
  for (const input::BodyRing& ring : asked.rings) rings.push_back({ring.name, vector(ring.point), vector(ring.normal), ring.factor, vector(ring.shift), ring.asked, ring.end});
  try {
    for (const RingGirth& girth : morph(scan.surface, rings))
      scan.said.push_back(girth.asked ? fmt::format("girth of {}: {:.1f} mm, asked {:.1f}, before {:.1f}", girth.name, 1e3 * girth.is, 1e3 * *girth.asked, 1e3 * girth.was)
                                      : fmt::format("girth of {}: {:.1f} mm, goes along, before {:.1f}", girth.name, 1e3 * girth.is, 1e3 * girth.was));
  } catch (const std::runtime_error& error) {
    throw InputError(where, fmt::format("the standard body cannot be given these girths: {}", error.what()), "ask for girths that are nearer to its own");
  }
}

}  // namespace

ScanSurface read_scan_surface(const input::ScanSpec& spec, const Location& where) {
  if (spec.unit && !(*spec.unit > 0.0)) throw InputError(where, fmt::format("the scan's unit is {:g} m", *spec.unit), "write unit = \"1 mm\"");
  ScanSurface scan;
  scan.to_body = file_to_body(spec, where);
  scan.surface = read_surface(spec.surface);
  scan.unit = spec.unit ? *spec.unit : guessed_unit(scan.surface, scan.said);
  for (auto& vertex : scan.surface.vertices) vertex = scan.to_body * (scan.unit * vertex);
  if (spec.morph) reshape(*spec.morph, where, scan);
  return scan;
}

std::vector<input::LocationSpec> on_skin(std::vector<input::LocationSpec> locations, const ScanSurface& scan) {
  if (scan.before.empty()) return locations;
  for (input::LocationSpec& location : locations) {
    if (!location.where_there || !location.at) continue;
    const Eigen::Vector3d at = vector(*location.at);
    const auto nearest = std::min_element(scan.before.begin(), scan.before.end(), [&](const auto& a, const auto& b) { return (a - at).squaredNorm() < (b - at).squaredNorm(); });
    const Eigen::Vector3d way = scan.surface.vertices[nearest - scan.before.begin()] - *nearest;
    for (int k = 0; k < 3; ++k) (*location.at)[k] += way[k];
  }
  return locations;
}

}  // namespace snug::mesh
