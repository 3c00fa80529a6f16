#include "mesh/body/scan_surface.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "mesh/surface/morph.hpp"
#include "mesh/surface/vectors.hpp"

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

struct Extent {
  Eigen::Vector3d low, high;
  explicit Extent(const TriangleSurface& surface) : low(surface.vertices.front()), high(low) {
    for (const auto& x : surface.vertices) low = low.cwiseMin(x), high = high.cwiseMax(x);
  }
  double size() const { return (high - low).maxCoeff(); }
};

/// Points of the cuts, in the file's axes and metres.
std::vector<Eigen::Vector3d> cut_points(const input::ScanSpec& spec) {
  std::vector<Eigen::Vector3d> points;
  for (const input::NamedCut& cut : spec.cuts) points.push_back(vector(cut.point));
  if (points.empty() && spec.lower && spec.upper) points = {vector(spec.lower->point), vector(spec.upper->point)};
  return points;
}

struct FileUnit {
  double size;
  const char* name;
};

/// The unit in which the surface is as long as a person or a part of one (2 cm to 2.5 m) and holds the points of the cuts; of several that do
/// the one in which two cuts take most of it, since what is scanned apart is cut near its ends. Where none holds them: below 3 the file
/// counts in metres, from 230 on in millimetres, between in centimetres.
FileUnit guessed_unit(const Extent& box, const std::vector<Eigen::Vector3d>& cuts) {
  constexpr double shortest = 0.02, longest = 2.5, slack = 0.02;
  const auto holds = [&](double unit) {
    const Eigen::Vector3d way = Eigen::Vector3d::Constant(slack * unit * box.size()), low = unit * box.low - way, high = unit * box.high + way;
    return std::all_of(cuts.begin(), cuts.end(), [&](const auto& x) { return (x.array() >= low.array()).all() && (x.array() <= high.array()).all(); });
  };
  const double size = box.size();
  const FileUnit by_size = size < 3.0 ? FileUnit{1.0, "m"} : size < 230.0 ? FileUnit{1e-2, "cm"} : FileUnit{1e-3, "mm"};
  if (cuts.empty()) return by_size;
  constexpr std::array units = {FileUnit{1e-3, "mm"}, FileUnit{1e-2, "cm"}, FileUnit{1.0, "m"}, FileUnit{0.0254, "inch"}};  // inches where no other fits
  for (const FileUnit& unit : units)  // in the smaller unit the cuts take more of the surface
    if (unit.size * size >= shortest && unit.size * size <= longest && holds(unit.size)) return unit;
  return by_size;
}

double guessed_unit(const TriangleSurface& surface, const input::ScanSpec& spec, std::vector<std::string>& said) {
  const Extent box(surface);
  const FileUnit unit = guessed_unit(box, cut_points(spec));
  said.push_back(fmt::format("unit left out: the file is taken to count in {}, which makes it {:.4g} m long", unit.name, box.size() * unit.size));
  return unit.size;
}

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
  scan.unit = spec.unit ? *spec.unit : guessed_unit(scan.surface, spec, scan.said);
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
