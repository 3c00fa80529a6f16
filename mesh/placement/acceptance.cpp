#include "mesh/placement/acceptance.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "cases/input/choice.hpp"
#include "solver/fem/union_find.hpp"

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Places = std::vector<Vector3d>;

constexpr double least_stretch = 0.3, largest_stretch = 3.0;
constexpr double hardest_fold = 150.0 * std::numbers::pi / 180.0;

Triangle3 triangle_of(const ClothTriangles& cloth, const Places& places, std::size_t t) {
  return {places[cloth.nodes[t][0]], places[cloth.nodes[t][1]], places[cloth.nodes[t][2]]};
}

double flat_area(const std::array<Vector2d, 3>& flat) {
  const Vector2d u = flat[1] - flat[0], v = flat[2] - flat[0];
  return 0.5 * std::abs(u.x() * v.y() - u.y() * v.x());
}

/// The triangles of every edge.
using Edge = std::pair<int, int>;
std::map<Edge, std::vector<int>> triangles_by_edge(const ClothTriangles& cloth) {
  std::map<Edge, std::vector<int>> result;
  for (std::size_t t = 0; t < cloth.nodes.size(); ++t)
    for (int n = 0; n < 3; ++n)
      result[std::minmax(cloth.nodes[t][n], cloth.nodes[t][(n + 1) % 3])].push_back(static_cast<int>(t));
  return result;
}

}  // namespace

std::vector<std::array<double, 2>> principal_stretches(const ClothTriangles& cloth, const Places& places) {
  std::vector<std::array<double, 2>> result;
  for (std::size_t t = 0; t < cloth.nodes.size(); ++t) {
    const auto& flat = cloth.flat[t];
    const auto [a, b, c] = triangle_of(cloth, places, t);
    Eigen::Matrix2d reference;
    reference << flat[1] - flat[0], flat[2] - flat[0];
    Eigen::Matrix<double, 3, 2> placed;
    placed << b - a, c - a;
    const Eigen::Matrix<double, 3, 2> gradient = placed * reference.inverse();
    const Eigen::Matrix2d metric = gradient.transpose() * gradient;
    const double mean = 0.5 * metric.trace(), root = std::hypot(0.5 * (metric(0, 0) - metric(1, 1)), metric(0, 1));
    result.push_back({std::sqrt(mean + root), std::sqrt(std::max(0.0, mean - root))});
  }
  return result;
}

StretchFigures stretch_figures(const ClothTriangles& cloth, const std::vector<std::array<double, 2>>& stretches) {
  StretchFigures figures;
  if (stretches.empty()) return figures;
  std::vector<std::size_t> order(stretches.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return stretches[a][0] < stretches[b][0]; });
  double whole = 0.0, area = 0.0;
  for (const auto& flat : cloth.flat) whole += flat_area(flat);
  for (const std::size_t t : order) {
    if (area <= 0.5 * whole) figures.median = stretches[t][0];
    if (area <= 0.99 * whole) figures.percentile_99 = stretches[t][0];
    area += flat_area(cloth.flat[t]);
  }
  figures.largest = stretches[order.back()][0];
  figures.smallest = std::min_element(stretches.begin(), stretches.end(), [](const auto& a, const auto& b) {
                       return a[1] < b[1];
                     })->at(1);
  return figures;
}

std::vector<int> crossing_triangles(const ClothTriangles& cloth, const Places& places, const DressForm& form) {
  std::vector<int> result;
  for (std::size_t t = 0; t < cloth.nodes.size(); ++t) {
    const Triangle3 one = triangle_of(cloth, places, t);
    const Eigen::AlignedBox3d box = box_of(one);
    const auto crosses = [&](int other) {
      const Triangle3 skin = form.triangle(other);
      return box.intersects(box_of(skin)) && cross_each_other(one, skin);
    };
    if (form.bins.any(box, crosses)) result.push_back(static_cast<int>(t));
  }
  return result;
}

std::vector<std::array<int, 2>> self_crossings(const ClothTriangles& cloth, const Places& places) {
  const TriangleBins bins(places, cloth.nodes, 0.02);
  std::vector<std::array<int, 2>> pairs;
  for (std::size_t t = 0; t < cloth.nodes.size(); ++t) {
    const Triangle3 one = triangle_of(cloth, places, t);
    const Eigen::AlignedBox3d box = box_of(one);
    std::vector<int> found;
    bins.any(box, [&](int other) {
      const auto &a = cloth.nodes[t], &b = cloth.nodes[other];
      if (other <= static_cast<int>(t) || std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end())
        return false;
      const Triangle3 two = triangle_of(cloth, places, other);
      if (box.intersects(box_of(two)) && cross_each_other(one, two)) found.push_back(other);
      return false;
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    for (const int other : found) pairs.push_back({static_cast<int>(t), other});
  }
  return pairs;
}

std::vector<std::array<int, 2>> folds(const ClothTriangles& cloth, const Places& places, double angle) {
  std::vector<Vector3d> normals;
  for (std::size_t t = 0; t < cloth.nodes.size(); ++t) {
    const auto [a, b, c] = triangle_of(cloth, places, t);
    normals.push_back((b - a).cross(c - a).normalized());
  }
  std::vector<std::array<int, 2>> pairs;
  for (const auto& [edge, sides] : triangles_by_edge(cloth))
    if (sides.size() == 2 && normals[sides[0]].dot(normals[sides[1]]) < std::cos(angle))
      pairs.push_back({sides[0], sides[1]});
  return pairs;
}

namespace {

Criterion no_crossings(const ClothTriangles& cloth, const Places& places, const DressForm& form) {
  const std::size_t count = crossing_triangles(cloth, places, form).size();
  return {"no triangle crosses the body", fmt::format("{} do", count), count == 0};
}

/// With no crossing all nodes that hang together are on the same side of the skin.
Criterion outside(const ClothTriangles& cloth, const Places& places, const DressForm& form) {
  fem::UnionFind together(places.size());
  for (const auto& t : cloth.nodes) together.merge(t[0], t[1]), together.merge(t[0], t[2]);
  int inside = 0;
  for (const auto& t : cloth.nodes)
    if (together.find(t[0]) == t[0] && std::abs(winding_number(form.body.surface, places[t[0]])) > 0.5) {
      ++inside;
      break;
    }
  return {"the cloth is outside the body", inside == 0 ? "it is" : "a part of it is inside", inside == 0};
}

Criterion bounded_stretch(const ClothTriangles& cloth, const Places& places) {
  const StretchFigures figures = stretch_figures(cloth, principal_stretches(cloth, places));
  return {fmt::format("stretches from {} to {}", least_stretch, largest_stretch),
          fmt::format("{:.3f} to {:.3f}", figures.smallest, figures.largest),
          figures.smallest >= least_stretch && figures.largest <= largest_stretch};
}

Criterion no_hard_folds(const ClothTriangles& cloth, const Places& places) {
  const std::size_t count = folds(cloth, places, hardest_fold).size();
  return {"no edge is folded by more than 150 degrees", fmt::format("{} are", count), count == 0};
}

/// The section of the cloth at a height: parts between points, the outside of the cloth on their right, so that the
/// section runs counter-clockwise round what it encloses.
std::vector<std::array<Vector2d, 2>> cloth_section(const ClothTriangles& cloth, const Places& places, double z) {
  std::vector<std::array<Vector2d, 2>> result;
  for (std::size_t t = 0; t < cloth.nodes.size(); ++t) {
    const Triangle3 x = triangle_of(cloth, places, t);
    std::array<Vector2d, 2> part;
    int ends = 0;
    for (int n = 0; n < 3; ++n) {
      const Vector3d &a = x[n], &b = x[(n + 1) % 3];
      if ((a.z() > z) == (b.z() > z)) continue;
      part[ends++] = (a + (z - a.z()) / (b.z() - a.z()) * (b - a)).head<2>();
    }
    if (ends != 2) continue;
    const Vector2d outside = (x[1] - x[0]).cross(x[2] - x[0]).head<2>(), along = part[1] - part[0];
    if (along.y() * outside.x() - along.x() * outside.y() < 0.0) std::swap(part[0], part[1]);
    result.push_back(part);
  }
  return result;
}

double winding(const std::vector<std::array<Vector2d, 2>>& section, const Vector2d& about) {
  double sum = 0.0;
  for (const auto& [from, to] : section) {
    const Vector2d u = from - about, v = to - about;
    sum += std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v));
  }
  return sum / (2.0 * std::numbers::pi);
}

/// Heights at which no open edge is cut, some of each range of them.
std::vector<double> closed_heights(const Places& places, const OpenLoops& open) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  for (const Vector3d& p : places) low = std::min(low, p.z()), high = std::max(high, p.z());
  std::vector<double> result;
  constexpr int heights = 40;
  for (int n = 0; n < heights; ++n) {
    const double z = low + (high - low) * (n + 0.5) / heights;
    const bool cut = std::any_of(open.begin(), open.end(), [&](const auto& loop) {
      const auto [least, largest] = std::minmax_element(
          loop.second.begin(), loop.second.end(), [](const Vector3d& a, const Vector3d& b) { return a.z() < b.z(); });
      return least->z() <= z && largest->z() >= z;
    });
    if (!cut) result.push_back(z);
  }
  return result;
}

Criterion round_limbs(const ClothTriangles& cloth, const Places& places, const OpenLoops& open, const DressForm& form) {
  int sections = 0;
  std::string fault;
  for (const double z : closed_heights(places, open)) {
    std::vector<std::pair<const char*, SectionLoop>> limbs;
    if (z >= form.marks.crotch) {
      if (const auto trunk = form.sections.trunk(z)) limbs.emplace_back("trunk", *trunk);
    } else {
      if (const auto leg = form.sections.leg(Side::right, z)) limbs.emplace_back("right leg", *leg);
      if (const auto leg = form.sections.leg(Side::left, z)) limbs.emplace_back("left leg", *leg);
    }
    const auto section = cloth_section(cloth, places, z);
    for (const auto& [name, loop] : limbs) {
      const double turns = winding(section, loop.centroid);
      ++sections;
      if (std::abs(turns - 1.0) > 0.01 && fault.empty())
        fault = fmt::format("{:.2f} times round the {} at a height of {:.0f} mm", turns, name, 1e3 * z);
    }
  }
  if (sections == 0) fault = "no section of the cloth is closed";
  return {"the cloth goes once round trunk and legs, its outside out",
          fault.empty() ? fmt::format("it does at {} sections", sections) : fault, fault.empty()};
}

bool fits(std::vector<BodyPart> found, std::optional<GarmentKind> kind) {
  std::sort(found.begin(), found.end());
  using Parts = std::vector<BodyPart>;
  if (kind == GarmentKind::legs) return found == Parts{BodyPart::trunk, BodyPart::right_leg, BodyPart::left_leg};
  if (kind == GarmentKind::shoulders)
    return found == Parts{BodyPart::neck, BodyPart::trunk, BodyPart::right_arm, BodyPart::left_arm};
  if (kind == GarmentKind::tube) return found == Parts{BodyPart::trunk, BodyPart::trunk};
  const auto twice = std::adjacent_find(found.begin(), found.end());
  return std::count(found.begin(), found.end(), BodyPart::nothing) == 0 &&
         (twice == found.end() || *twice == BodyPart::trunk);
}

Criterion open_edges(const OpenLoops& open, const DressForm& form, std::optional<GarmentKind> kind) {
  const LimbPaths paths(form);
  std::vector<BodyPart> limbs;
  std::vector<std::string> texts;
  for (const auto& [name, loop] : open) {
    limbs.push_back(paths.enclosed_by(loop));
    texts.push_back(fmt::format("{} round {}", name, input::text_of(limbs.back())));
  }
  return {"each open edge goes round its limb", fmt::format("{}", fmt::join(texts, ", ")), fits(limbs, kind)};
}

/// m, from a point to the nearest triangle of the body that is skin, and to the nearest that is a lid over a cut; infinite beyond 60 mm.
std::array<double, 2> distances(const DressForm& form, const Vector3d& p) {
  std::array<double, 2> nearest;
  for (double reach = 0.015; reach < 0.1; reach *= 2.0) {
    nearest.fill(std::numeric_limits<double>::infinity());
    const Eigen::AlignedBox3d box(p - Vector3d::Constant(reach), p + Vector3d::Constant(reach));
    form.bins.any(box, [&](int t) {
      double& least = nearest[form.body.is_skin(t) ? 0 : 1];
      least = std::min(least, distance_to_triangle(p, form.triangle(t)));
      return false;
    });
    if (std::min(nearest[0], nearest[1]) < reach) break;
  }
  return nearest;
}

/// Beyond a cut the rim is nearest, which belongs to the skin and to the lid alike.
Criterion edges_on_skin(const OpenLoops& open, const DressForm& form) {
  constexpr double overhang = 0.005;  // m
  std::string fault;
  for (const auto& [name, loop] : open) {
    double farthest = 0.0;
    for (const Vector3d& p : loop) {
      const auto [skin, lid] = distances(form, p);
      if (!(lid > skin + 1e-9)) farthest = std::max(farthest, std::min(lid, 0.1));
    }
    if (farthest > overhang) fault += fmt::format("{}{} reaches {:.0f} mm beyond a cut", fault.empty() ? "" : ", ", name, 1e3 * farthest);
  }
  return {"every open edge lies over skin", fault.empty() ? "it does" : fault, fault.empty()};
}

}  // namespace

std::vector<Criterion> acceptance(const ClothTriangles& cloth, const Places& places, const OpenLoops& open,
                                  const DressForm& form, std::optional<GarmentKind> kind) {
  std::vector<Criterion> all = {no_crossings(cloth, places, form), outside(cloth, places, form),           bounded_stretch(cloth, places),
                                no_hard_folds(cloth, places),      round_limbs(cloth, places, open, form), open_edges(open, form, kind)};
  if (form.body.is_cut()) all.push_back(edges_on_skin(open, form));
  return all;
}

}  // namespace snug::mesh
