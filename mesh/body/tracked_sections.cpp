#include "mesh/body/tracked_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "mesh/body/scan_surface.hpp"
#include "mesh/surface/mending.hpp"

namespace snug::mesh {

namespace {

using input::InputError;
using input::Location;

void check_plane(const Eigen::Vector3d& normal, const char* name, const Location& where) {
  const double upright = std::abs(normal.z()) / std::max(normal.norm(), 1e-300);
  if (upright < std::cos(20.0 * std::numbers::pi / 180.0))
    throw InputError(where,
                     fmt::format("the {} cut plane is tilted by {:.0f} degrees against the body's axis", name,
                                 std::acos(upright) * 180.0 / std::numbers::pi),
                     "give a normal within 20 degrees of the up axis; the cut itself is horizontal");
}

/// Whether `next` can be the section above or below `last`, a few millimetres away.
bool continues(const SectionLoop& last, const SectionLoop& next) {
  const double radius = last.girth / (2.0 * std::numbers::pi);
  return std::abs(next.girth - last.girth) < 0.15 * last.girth &&
         (next.centroid - last.centroid).norm() < 0.25 * radius;
}

std::optional<SectionLoop> nearest_loop(const OrientedScan& scan, double z, const Eigen::Vector2d& to) {
  auto loops = slice(scan.surface, z);
  if (loops.empty()) return {};
  const auto nearer = [&](const SectionLoop& a, const SectionLoop& b) {
    return (a.centroid - to).squaredNorm() < (b.centroid - to).squaredNorm();
  };
  return *std::min_element(loops.begin(), loops.end(), nearer);
}

/// The sections beyond one cut plane, nearest first, as long as the limb goes on.
std::vector<SectionLoop> beyond(const OrientedScan& scan, SectionLoop last, double z, double step, int count) {
  std::vector<SectionLoop> found;
  for (int n = 1; n <= count; ++n) {
    const auto next = nearest_loop(scan, z + n * step, last.centroid);
    if (!next || !continues(last, *next)) break;
    found.push_back(last = *next);
  }
  return found;
}

std::vector<SectionLoop> between(const OrientedScan& scan, double dz, int steps, const Location& where) {
  std::vector<SectionLoop> loops = {lower_section(scan, where)};
  for (int n = 1; n <= steps; ++n) {
    const double z = scan.lower.z() + n * dz;
    const auto next = nearest_loop(scan, z, loops.back().centroid);
    if (!next || !continues(loops.back(), *next))
      throw InputError(where,
                       fmt::format("the limb ends or joins another part of the body at height {:.1f} mm", 1e3 * z),
                       "bring the cut planes closer together, to where the limb stands alone");
    loops.push_back(*next);
  }
  const auto aimed = nearest_loop(scan, scan.upper.z(), scan.upper.head<2>());
  if (aimed && (aimed->centroid - loops.back().centroid).norm() > 1e-6)
    throw InputError(where, "the two cut planes lie on different parts of the body",
                     "move the planes' points into the same limb");
  return loops;
}

/// Small holes are filled, faces given twice go; wider holes are told as they are.
void close_between(OrientedScan& scan, const input::ScanSpec& spec) {
  const HeightRange range{scan.lower.z(), scan.upper.z()};
  const Location where{spec.surface.string()};
  try {
    return check_closed(scan.surface, where, range);
  } catch (const InputError&) {
    MendedSurface mended = mend(scan.surface, {.hole = spec.fill_holes});
    for (const WideHole& hole : mended.wide_holes)
      if (hole.rim.z() >= range.lower && hole.rim.z() <= range.upper)
        throw InputError(where, fmt::format("the surface is not closed: a hole {:.0f} mm wide at ({:.0f}, {:.0f}, {:.0f}) mm", 1e3 * hole.width, 1e3 * hole.rim.x(), 1e3 * hole.rim.y(), 1e3 * hole.rim.z()),
                         fmt::format("fill_holes = \"{:.0f} mm\" in [body.scan] fills it flat; or close it in the scanner's program, or move the cut planes so that it lies outside them", std::ceil(1e3 * hole.width)));
    scan.surface = std::move(mended.surface);
    for (const Mending& one : mended.mendings) scan.mended.push_back(fmt::format("mended: {}, the first at ({:.0f}, {:.0f}, {:.0f}) mm", one.what, 1e3 * one.at.x(), 1e3 * one.at.y(), 1e3 * one.at.z()));
    check_closed(scan.surface, where, range);
  }
}

}  // namespace

OrientedScan read_scan(const input::ScanSpec& spec, const Location& where) {
  if (!spec.lower || !spec.upper) throw InputError(where, "the limb has no lower and upper cut", "add lower and upper to [body.scan]");
  ScanSurface read = read_scan_surface(spec, where);
  const auto turned = [&](const std::array<double, 3>& v) -> Eigen::Vector3d {
    return read.to_body * Eigen::Vector3d(v[0], v[1], v[2]);
  };
  check_plane(turned(spec.lower->normal), "lower", where);
  check_plane(turned(spec.upper->normal), "upper", where);
  OrientedScan scan{std::move(read.surface), turned(spec.lower->point), turned(spec.upper->point), std::move(read.said), {}};
  if (!(scan.upper.z() > scan.lower.z()))
    throw InputError(where,
                     fmt::format("the upper cut plane (height {:.1f} mm) is not above the lower one ({:.1f} mm)",
                                 1e3 * scan.upper.z(), 1e3 * scan.lower.z()),
                     "give heights along the up axis, in metres or with a unit");
  close_between(scan, spec);
  return scan;
}

SectionLoop lower_section(const OrientedScan& scan, const Location& where) {
  const auto loop = nearest_loop(scan, scan.lower.z(), scan.lower.head<2>());
  if (loop) return *loop;
  throw InputError(where,
                   fmt::format("the lower cut plane at height {:.1f} mm misses the surface", 1e3 * scan.lower.z()),
                   "check the plane's point, the scan's unit and its up axis");
}

TrackedSections track_sections(const OrientedScan& scan, double spacing, double margin, const Location& where) {
  const double length = scan.upper.z() - scan.lower.z();
  const int steps = std::clamp(static_cast<int>(std::ceil(length / spacing)), 8, 400);
  const double dz = length / steps;
  const int beyond_steps = static_cast<int>(std::ceil(margin / dz));
  const auto inside = between(scan, dz, steps, where);
  const auto above = beyond(scan, inside.back(), scan.upper.z(), dz, beyond_steps);
  auto below = beyond(scan, inside.front(), scan.lower.z(), -dz, beyond_steps);
  TrackedSections sections{scan.lower.z() - dz * static_cast<double>(below.size()), dz, {}};
  std::reverse(below.begin(), below.end());
  const auto append = [&](const auto& part) { sections.loops.insert(sections.loops.end(), part.begin(), part.end()); };
  append(below);
  append(inside);
  append(above);
  return sections;
}

}  // namespace snug::mesh
