#include "mesh/garment/garment_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "mesh/garment/girth_curve.hpp"
#include "mesh/garment/pattern.hpp"
#include "mesh/garment/union_find.hpp"

namespace snug::mesh {

namespace {

using input::InputError;

void check(const input::GarmentSpec& spec, const Limb& limb, double cell_size) {
  const auto& pattern = spec.pattern;
  if (!(pattern.flat_circumference > 0.0) || !(pattern.length > 0.0))
    throw InputError(
        spec.where,
        fmt::format("the pattern measures {:g} mm by {:g} mm", 1e3 * pattern.flat_circumference, 1e3 * pattern.length),
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

std::vector<int> sew(const PatternMesh& pattern) {
  const auto &left = pattern.sides.at("left"), &right = pattern.sides.at("right");
  if (left.size() != right.size()) throw std::logic_error("the sides of a seam are divided differently");
  UnionFind nodes(pattern.nodes.size());
  for (std::size_t n = 0; n < left.size(); ++n) nodes.merge(left[n], right[n]);
  return nodes.representatives();
}

/// The pattern's x runs counter-clockwise seen from above and its y upwards, which keeps its orientation seen from
/// outside.
void place(const input::GarmentSpec& spec, const Limb& limb, double lift, GarmentMesh& mesh) {
  const double width = spec.pattern.flat_circumference, seam = spec.seam.value_or(std::numbers::pi);
  std::map<double, GirthCurve> curves;  // the nodes of an edge share a height
  for (std::size_t n = 0; n < mesh.pattern.size(); ++n) {
    const Eigen::Vector2d& x = mesh.pattern[mesh.merged[n]];
    const double z = *spec.position + x.y();
    auto it = curves.find(z);
    if (it == curves.end()) it = curves.emplace(z, GirthCurve(limb, z, width, lift, limb.skin->turn_at_angle(seam, z))).first;
    const GirthCurve& curve = it->second;
    const double turn = curve.turn_at(x.x() / width);
    mesh.placed.push_back(limb.skin->at(turn, z) + curve.distance() * outward_normal(*limb.skin, turn, z));
    if (curve.loose()) mesh.stand_off = std::max(mesh.stand_off, curve.distance());
  }
}

/// How far the limb stretches the garment round it, in the mean over the cover; at least 1. To a thousandth, so that what
/// round-off makes of the same limb elsewhere does not give it another mesh.
double mean_stretch(const input::GarmentSpec& spec, const Limb& limb) {
  constexpr int samples = 16;
  double sum = 0.0;
  for (int i = 0; i < samples; ++i)
    sum += std::max(1.0, limb.girth(*spec.position + (i + 0.5) / samples * spec.pattern.length) / spec.pattern.flat_circumference);
  return std::round(1e3 * sum / samples) / 1e3;
}

/// Triangles that are even as worn: meshed at the width that the limb stretches them to, then brought back.
PatternMesh mesh_as_worn(const input::GarmentSpec& spec, const Limb& limb, double worn_size) {
  const double stretch = mean_stretch(spec, limb);
  PatternMesh pattern = mesh_rectangle(stretch * spec.pattern.flat_circumference, spec.pattern.length, worn_size);
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

GarmentFit tube_fit(const input::GarmentSpec& spec) {
  return {.rows = {{input::lowest_point(spec), spec.pattern.flat_circumference, 1.0}},
          .lower = *spec.position,
          .upper = *spec.position + spec.pattern.length,
          .warp_along = spec.warp == input::WarpDirection::along};
}

GarmentMesh make_tube_mesh(const input::GarmentSpec& spec, const Limb& limb, double worn_size, double lift) {
  const bool given = spec.cell_size > 0.0;
  check(spec, limb, given ? spec.cell_size : worn_size);
  const double width = spec.pattern.flat_circumference;
  const PatternMesh pattern =
      given ? mesh_rectangle(width, spec.pattern.length, spec.cell_size) : mesh_as_worn(spec, limb, worn_size);

  GarmentMesh mesh;
  mesh.pattern = pattern.nodes;
  mesh.triangles = pattern.triangles;
  mesh.merged = sew(pattern);
  place(spec, limb, lift, mesh);
  const Eigen::Vector2d warp = spec.warp == input::WarpDirection::around ? Eigen::Vector2d(1, 0) : Eigen::Vector2d(0, 1);
  mesh.warp.assign(mesh.triangles.size(), warp);
  for (const char* edge : {"lower", "upper"}) mesh.edges[edge] = representatives(pattern.sides.at(edge), mesh.merged);
  mesh.mean_edge = mean_edge_length(pattern);
  mesh.name = spec.name, mesh.order = spec.order;
  mesh.fit = tube_fit(spec);
  return mesh;
}

}  // namespace snug::mesh
