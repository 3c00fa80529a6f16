#include "mesh/garment/garment_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "mesh/garment/arc_length.hpp"
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
  const double lower = spec.position, upper = spec.position + pattern.length;
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

/// The curve parallel to the skin of a limb at a distance outwards.
class Parallel : public Outline {
 public:
  Parallel(const Outline& skin, double distance) : skin_(skin), distance_(distance) {}
  Eigen::Vector3d at(double turn, double z) const override {
    return skin_.at(turn, z) + distance_ * outward_normal(skin_, turn, z);
  }

 private:
  const Outline& skin_;
  double distance_;
};

/// How far off the skin a garment of this width stands at height z: a curve parallel to a closed one is longer by 2 pi times
/// the distance. Not so far that the parallel curve folds where the section is hollow.
double distance(const Limb& limb, const SectionArc& skin, double z, double width, double lift) {
  const double wide = (width - skin.girth()) / (2.0 * std::numbers::pi);
  if (wide <= lift + 1e-6 * skin.girth()) return lift;  // as wide as the limb but for round-off is not loose
  double hollow = 0.0;  // 1/m
  constexpr int samples = 64;
  for (int i = 0; i < samples; ++i)
    hollow = std::max(hollow, -limb.skin_curvature(static_cast<double>(i) / samples, z).x());
  return std::max(lift, hollow > 0.0 ? std::min(wide, 0.5 / hollow) : wide);
}

/// Where the garment runs round the limb at one height.
struct Section {
  double distance = 0.0;                ///< m
  std::unique_ptr<Outline> parallel;    ///< where it is wider than the limb
  std::unique_ptr<SectionArc> arc;      ///< of it, else of the skin
};

Section section(const Limb& limb, double z, double width, double lift, double seam) {
  Section s;
  s.arc = std::make_unique<SectionArc>(*limb.skin, z, seam);
  s.distance = distance(limb, *s.arc, z, width, lift);
  if (s.distance == lift) return s;
  s.parallel = std::make_unique<Parallel>(*limb.skin, s.distance);
  s.arc = std::make_unique<SectionArc>(*s.parallel, z, seam);
  return s;
}

/// The pattern's x runs counter-clockwise seen from above and its y upwards, which keeps its orientation seen from
/// outside.
void place(const input::GarmentSpec& spec, const Limb& limb, double lift, GarmentMesh& mesh) {
  const double width = spec.pattern.flat_circumference;
  std::map<double, Section> sections;  // the nodes of an edge share a height
  for (std::size_t n = 0; n < mesh.pattern.size(); ++n) {
    const Eigen::Vector2d& x = mesh.pattern[mesh.merged[n]];
    const double z = spec.position + x.y();
    auto it = sections.find(z);
    if (it == sections.end()) it = sections.emplace(z, section(limb, z, width, lift, limb.skin->turn_at_angle(spec.seam, z))).first;
    const Section& s = it->second;
    const double turn = s.arc->turn_at(x.x() / width);
    mesh.placed.push_back(limb.skin->at(turn, z) + s.distance * outward_normal(*limb.skin, turn, z));
    if (s.parallel) mesh.stand_off = std::max(mesh.stand_off, s.distance);
  }
}

/// How far the limb stretches the garment round it, in the mean over the cover; at least 1. To a thousandth, so that what
/// round-off makes of the same limb elsewhere does not give it another mesh.
double mean_stretch(const input::GarmentSpec& spec, const Limb& limb) {
  constexpr int samples = 16;
  double sum = 0.0;
  for (int i = 0; i < samples; ++i)
    sum += std::max(1.0, limb.girth(spec.position + (i + 0.5) / samples * spec.pattern.length) / spec.pattern.flat_circumference);
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

GarmentMesh make_garment_mesh(const input::GarmentSpec& spec, const Limb& limb, double worn_size, double lift) {
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
  return mesh;
}

}  // namespace snug::mesh
