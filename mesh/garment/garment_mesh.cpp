#include "mesh/garment/garment_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "mesh/garment/girth_curve.hpp"
#include "mesh/garment/pattern.hpp"
#include "mesh/garment/tube_girth.hpp"
#include "solver/fem/union_find.hpp"

namespace snug::mesh {

namespace {

using input::InputError;

void check(const input::GarmentSpec& spec, const TubeGirth& girth, const Limb& limb, double cell_size) {
  const auto& pattern = spec.pattern;
  if (!(girth.mean() > 0.0) || !(pattern.length > 0.0))
    throw InputError(spec.where, fmt::format("the pattern measures {:g} mm by {:g} mm", 1e3 * girth.mean(), 1e3 * pattern.length),
                     "write a positive flat_circumference and length");
  if (!(cell_size > 0.0))
    throw InputError(spec.where, fmt::format("the cell size is {:g} mm", 1e3 * cell_size),
                     "write a positive cell_size, or leave it out to take the skin's");
  constexpr double tolerance = 1e-9;  // m, so that a garment of the limb's whole length fits
  const double lower = input::lowest_point(spec), upper = lower + pattern.length;
  if (lower < limb.lower - tolerance || upper > limb.upper + tolerance)
    throw InputError(spec.where,
                     fmt::format("the garment covers heights {:.1f} to {:.1f} mm, the body {:.1f} to {:.1f} mm",
                                 1e3 * lower, 1e3 * upper, 1e3 * limb.lower, 1e3 * limb.upper),
                     "move it (position), shorten it (length), or let the body reach further");
}

void sew(const PatternMesh& pattern, bool knitted, GarmentMesh& mesh) {
  const auto &left = pattern.sides.at("left"), &right = pattern.sides.at("right");
  if (left.size() != right.size()) throw std::logic_error("the sides of a seam are divided differently");
  fem::UnionFind nodes(pattern.nodes.size());
  SewnSeam seam{"seam", {}};
  for (std::size_t n = 0; n < left.size(); ++n) nodes.merge(left[n], right[n]), seam.pairs.push_back({left[n], right[n]});
  mesh.merged = nodes.representatives();
  if (!knitted) mesh.seams.push_back(std::move(seam));  // what is knitted round has none
}

/// The pattern's x runs counter-clockwise seen from above and its y upwards, which keeps its orientation seen from
/// outside.
void place(const input::GarmentSpec& spec, const TubeGirth& girth, const Limb& limb, double lift, GarmentMesh& mesh) {
  const double width = girth.mean(), seam = spec.seam.value_or(std::numbers::pi);
  std::map<double, GirthCurve> curves;  // the nodes of an edge share a height
  for (std::size_t n = 0; n < mesh.pattern.size(); ++n) {
    const Eigen::Vector2d& x = mesh.pattern[mesh.merged[n]];
    const double z = *spec.position + x.y();
    auto it = curves.find(z);
    if (it == curves.end()) it = curves.emplace(z, GirthCurve(limb, z, girth(x.y()), lift, limb.skin->turn_at_angle(seam, z))).first;
    const GirthCurve& curve = it->second;
    const double turn = curve.turn_at(x.x() / width);
    mesh.placed.push_back(limb.skin->at(turn, z) + curve.distance() * outward_normal(*limb.skin, turn, z));
    if (curve.loose()) mesh.stand_off = std::max(mesh.stand_off, curve.distance());
  }
}

/// Heights over the lower edge at which the cloth of a tube changes, ascending.
std::vector<double> zone_borders(const input::GarmentSpec& spec) {
  constexpr double same = 1e-6;  // m
  std::vector<double> borders;
  for (const input::ZoneSpec& zone : spec.zone)
    for (const double height : {zone.from_height, zone.to_height.value_or(spec.pattern.length)})
      if (height > same && height < spec.pattern.length - same) borders.push_back(height);
  std::sort(borders.begin(), borders.end());
  borders.erase(std::unique(borders.begin(), borders.end(), [](double a, double b) { return b - a < same; }), borders.end());
  return borders;
}

/// Of a tube at a height over its lower edge; -1: none.
int zone_at(const input::GarmentSpec& spec, double height) {
  for (std::size_t z = 0; z < spec.zone.size(); ++z)
    if (height >= spec.zone[z].from_height && height <= spec.zone[z].to_height.value_or(spec.pattern.length)) return static_cast<int>(z);
  return -1;
}

/// "0 to 120 mm"
std::string zone_name(double from, double to) { return fmt::format("{:.4g} to {:.4g} mm", 1e3 * from, 1e3 * to); }

/// The stretches between borders are what its pieces are to a sewn garment.
void set_zones(const input::GarmentSpec& spec, GarmentMesh& mesh) {
  if (spec.zone.empty()) {
    mesh.pieces = {"tube"};
    return;
  }
  std::vector<double> ends{0.0};
  for (const double border : zone_borders(spec)) ends.push_back(border);
  ends.push_back(spec.pattern.length);
  for (std::size_t e = 0; e + 1 < ends.size(); ++e) mesh.pieces.push_back(zone_name(ends[e], ends[e + 1]));
  for (const auto& t : mesh.triangles) {
    const double middle = (mesh.pattern[t[0]].y() + mesh.pattern[t[1]].y() + mesh.pattern[t[2]].y()) / 3.0;
    mesh.triangle_piece.push_back(static_cast<int>(std::upper_bound(ends.begin() + 1, ends.end() - 1, middle) - ends.begin()) - 1);
    mesh.triangle_zone.push_back(zone_at(spec, middle));
  }
}

/// How far the limb stretches the garment round it, in the mean over the cover; at least 1. To a thousandth, so that what
/// round-off makes of the same limb elsewhere does not give it another mesh.
double mean_stretch(const input::GarmentSpec& spec, const TubeGirth& girth, const Limb& limb) {
  constexpr int samples = 16;
  double sum = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double height = (i + 0.5) / samples * spec.pattern.length;
    sum += std::max(1.0, limb.girth(*spec.position + height) / girth(height));
  }
  return std::round(1e3 * sum / samples) / 1e3;
}

/// Triangles that are even as worn: meshed at the width that the limb stretches them to, then brought back.
PatternMesh mesh_as_worn(const input::GarmentSpec& spec, const TubeGirth& girth, const Limb& limb, double worn_size) {
  const double stretch = mean_stretch(spec, girth, limb);
  PatternMesh pattern = mesh_rectangle(stretch * girth.mean(), spec.pattern.length, worn_size, zone_borders(spec));
  for (Eigen::Vector2d& x : pattern.nodes) x.x() /= stretch;
  return pattern;
}

std::vector<int> representatives(const std::vector<int>& side, const std::vector<int>& merged) {
  std::vector<int> nodes;
  for (int node : side)
    if (merged[node] == node || std::find(side.begin(), side.end(), merged[node]) == side.end())
      nodes.push_back(merged[node]);
  return nodes;
}

}  // namespace

Eigen::Matrix<double, 1, 6> GarmentMesh::course_of(std::size_t triangle) const {
  Eigen::Matrix<double, 1, 6> values = Eigen::Matrix<double, 1, 6>::Ones();
  for (int a = 0; a < 6 && !course.empty(); ++a) values[a] = course[triangles[triangle][a]];
  return values;
}

double GarmentMesh::cut_area(std::size_t triangle) const {
  const auto& t = triangles[triangle];
  const Eigen::Vector2d a = pattern[t[1]] - pattern[t[0]], b = pattern[t[2]] - pattern[t[0]];
  return course_of(triangle).head<3>().mean() * 0.5 * std::abs(a.x() * b.y() - a.y() * b.x());
}

namespace {

std::vector<FitRow> tube_rows(const input::GarmentSpec& spec) {
  const TubeGirth girth(spec.pattern);
  const double lower = input::lowest_point(spec);
  if (!spec.pattern.graduated() && spec.zone.empty()) return {{lower, girth.mean(), 1.0}};
  constexpr int steps = 48;
  constexpr double beside = 1e-9;  // m: zones change at once
  std::vector<double> heights;
  for (int i = 0; i <= steps; ++i) heights.push_back(spec.pattern.length * i / steps);
  for (const double border : zone_borders(spec)) heights.push_back(border - beside), heights.push_back(border + beside);
  std::sort(heights.begin(), heights.end());
  std::vector<FitRow> rows;
  for (const double height : heights) {
    FitRow row{.height = lower + height, .girth = girth(height), .zones = std::vector<double>(spec.zone.size(), 0.0)};
    if (const int zone = zone_at(spec, height); zone >= 0) row.zones[zone] = 1.0;
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

GarmentFit tube_fit(const input::GarmentSpec& spec) {
  return {.rows = tube_rows(spec),
          .lower = *spec.position,
          .upper = *spec.position + spec.pattern.length,
          .warp_along = spec.warp == input::WarpDirection::along};
}

GarmentMesh make_tube_mesh(const input::GarmentSpec& spec, const Limb& limb, double worn_size, double lift) {
  const bool given = spec.cell_size > 0.0;
  const TubeGirth girth(spec.pattern);
  check(spec, girth, limb, given ? spec.cell_size : worn_size);
  const PatternMesh pattern = given ? mesh_rectangle(girth.mean(), spec.pattern.length, spec.cell_size, zone_borders(spec))
                                    : mesh_as_worn(spec, girth, limb, worn_size);

  GarmentMesh mesh;
  mesh.pattern = pattern.nodes;
  mesh.triangles = pattern.triangles;
  sew(pattern, spec.pattern.graduated(), mesh);
  if (spec.pattern.graduated())
    for (const Eigen::Vector2d& x : mesh.pattern) mesh.course.push_back(girth(x.y()) / girth.mean());
  set_zones(spec, mesh);
  place(spec, girth, limb, lift, mesh);
  const Eigen::Vector2d warp = spec.warp == input::WarpDirection::around ? Eigen::Vector2d(1, 0) : Eigen::Vector2d(0, 1);
  mesh.warp.assign(mesh.triangles.size(), warp);
  for (const char* edge : {"lower", "upper"}) mesh.edges[edge] = representatives(pattern.sides.at(edge), mesh.merged);
  mesh.mean_edge = mean_edge_length(pattern);
  mesh.name = spec.name, mesh.order = spec.order;
  mesh.fit = tube_fit(spec);
  return mesh;
}

}  // namespace snug::mesh
