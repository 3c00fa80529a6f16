#include "mesh/body/scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "cases/input/warned_error.hpp"
#include "mesh/body/elliptic_outline.hpp"
#include "mesh/body/fourier_outline.hpp"
#include "mesh/body/section_centres.hpp"
#include "mesh/body/smoothing.hpp"
#include "mesh/body/tracked_sections.hpp"

namespace snug::mesh {

namespace {

using input::InputError;
using input::Location;

constexpr int rays = 1024;  // many to a facet of the scan, so that its corners do not alias into the low harmonics
constexpr int most_harmonics = 64;
constexpr double two_pi = 2.0 * std::numbers::pi;

/// Two rows: the centroids of the sections, smoothed along z.
Eigen::MatrixXd centre_line(const TrackedSections& sections, double sigma) {
  Eigen::MatrixXd centre(2, sections.loops.size());
  for (std::size_t n = 0; n < sections.loops.size(); ++n) centre.col(n) = sections.loops[n].centroid;
  return smooth_along(centre, sections.dz, sigma);
}

Eigen::VectorXd sampled_radii(const SectionLoop& loop, const Eigen::Vector2d& centre, double z, const Location& where) {
  const Eigen::VectorXd radii = ray_radii(loop, centre, rays);
  if (radii.minCoeff() > 0.0) return radii;
  throw InputError(where, fmt::format("the limb's centre line leaves the section at height {:.1f} mm", 1e3 * z),
                   "bring the cut planes closer together, to where the sections are rounder");
}

/// Harmonics that still pass the filter on a section of mean radius `radius`.
int harmonics_needed(double radius, double sigma) {
  int n = 4;
  while (n < most_harmonics && gaussian_pass(n / radius, sigma) > 1e-5) ++n;
  return n;
}

/// Filtered Fourier coefficients a0, a1, b1, ... of equally spaced radii.
Eigen::VectorXd filtered_series(const Eigen::VectorXd& radii, int harmonics, double sigma) {
  Eigen::VectorXd series = Eigen::VectorXd::Zero(1 + 2 * harmonics);
  series[0] = radii.mean();
  for (int n = 1; n <= harmonics; ++n) {
    const double pass = gaussian_pass(n / series[0], sigma);
    for (int i = 0; i < rays; ++i) {
      const double angle = two_pi * n * i / rays;
      series[2 * n - 1] += pass * 2.0 / rays * radii[i] * std::cos(angle);
      series[2 * n] += pass * 2.0 / rays * radii[i] * std::sin(angle);
    }
  }
  return series;
}

/// Rows centre x, centre y, a0, a1, b1, ...; one column a section.
Eigen::MatrixXd smooth_coefficients(const TrackedSections& sections, double sigma, const Location& where) {
  const Eigen::MatrixXd centre = centre_line(sections, sigma);
  std::vector<Eigen::VectorXd> radii;
  double largest = 0.0;
  for (std::size_t n = 0; n < sections.loops.size(); ++n) {
    radii.push_back(sampled_radii(sections.loops[n], centre.col(n), sections.z0 + sections.dz * n, where));
    largest = std::max(largest, radii.back().mean());
  }
  const int harmonics = harmonics_needed(largest, sigma);
  Eigen::MatrixXd series(1 + 2 * harmonics, radii.size());
  for (std::size_t n = 0; n < radii.size(); ++n) series.col(n) = filtered_series(radii[n], harmonics, sigma);
  Eigen::MatrixXd coefficients(2 + series.rows(), series.cols());
  coefficients << centre, smooth_along(series, sections.dz, sigma);
  return coefficients;
}

/// The bone follows the centre line with the offset of `spec`.
std::unique_ptr<Outline> bone_along(const Eigen::MatrixXd& coefficients, const TrackedSections& sections,
                                    const input::BoneSpec& spec, const Location& where) {
  if (!(spec.girth > 0.0) || !(spec.width_to_depth > 0.0))
    throw InputError(
        where,
        fmt::format("the bone has a girth of {:g} mm and a ratio of {:g}", 1e3 * spec.girth, spec.width_to_depth),
        "write a positive girth and width_to_depth");
  std::vector<Ellipse> ellipses;
  for (Eigen::Index n = 0; n < coefficients.cols(); ++n)
    ellipses.push_back(ellipse_of_girth(sections.z0 + sections.dz * static_cast<double>(n), spec.girth,
                                        spec.width_to_depth, coefficients(0, n) + spec.offset[0],
                                        coefficients(1, n) + spec.offset[1]));
  return std::make_unique<EllipticOutline>(ellipses);
}

/// Distances of the scan's section points to the smooth skin, to first order: radial difference x cosine to the normal.
FitResidual residual_of(const Limb& limb, const Eigen::MatrixXd& coefficients, const TrackedSections& sections) {
  FitResidual residual;
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t n = 0; n < sections.loops.size(); ++n) {
    const double z = sections.z0 + sections.dz * static_cast<double>(n), tolerance = 1e-6 * sections.dz;
    if (z < limb.lower - tolerance || z > limb.upper + tolerance) continue;
    for (const Eigen::Vector2d& point : sections.loops[n].points) {
      const Eigen::Vector2d from = point - coefficients.col(n).head<2>();
      const double turn = std::atan2(from.y(), from.x()) / two_pi;
      const Eigen::Vector3d off = Eigen::Vector3d(point.x(), point.y(), z) - limb.skin->at(turn, z);
      const double distance = std::abs(off.dot(limb.skin_normal(turn, z)));
      sum += distance * distance;
      residual.max = std::max(residual.max, distance);
      ++count;
    }
  }
  residual.rms = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(count, 1)));
  return residual;
}

}  // namespace

namespace {

/// Heights between which the surface has no border: its cut ends.
HeightRange closed_range(const TriangleSurface& surface) {
  std::map<std::pair<int, int>, int> triangles_at;
  HeightRange all{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (const auto& triangle : surface.triangles)
    for (int k = 0; k < 3; ++k) {
      ++triangles_at[std::minmax(triangle[k], triangle[(k + 1) % 3])];
      const double z = surface.vertices[triangle[k]].z();
      all = {std::min(all.lower, z), std::max(all.upper, z)};
    }
  const double middle = 0.5 * (all.lower + all.upper);
  HeightRange closed = all;
  for (const auto& [edge, count] : triangles_at)
    for (const int vertex : {edge.first, edge.second}) {
      if (count > 1) continue;
      const double z = surface.vertices[vertex].z();
      (z < middle ? closed.lower : closed.upper) = z < middle ? std::max(closed.lower, z) : std::min(closed.upper, z);
    }
  return closed;
}

/// The middle of the surface's vertices at about this height.
Eigen::Vector3d middle_at(const TriangleSurface& surface, double z, double reach) {
  Eigen::Vector3d sum(0.0, 0.0, 0.0);
  int count = 0;
  for (const auto& vertex : surface.vertices)
    if (std::abs(vertex.z() - z) <= reach) sum += vertex, ++count;
  if (count > 0) sum /= count;
  return {sum.x(), sum.y(), z};
}

}  // namespace

Limb limb_from_skin(const BodyMesh& body, double lower, double upper, const Location& where) {
  if (body.skin_facets.empty())
    throw InputError(where, "the mesh has no surface \"skin\" for a garment to touch",
                     "name the outer surface \"skin\" in gmsh (Physical Surface)");
  OrientedScan scan{triangulated(body), {}, {}, {}};
  const HeightRange closed = closed_range(scan.surface);
  const double hair = 1e-6 * body.mean_skin_cell;  // a section exactly through the nodes of a cut end may be open
  Limb limb;
  limb.lower = std::max(lower, closed.lower), limb.upper = std::min(upper, closed.upper);
  if (!(limb.upper > limb.lower))
    throw InputError(where,
                     fmt::format("the garment is at heights {:.1f} to {:.1f} mm, the skin of the mesh at {:.1f} to {:.1f} mm",
                                 1e3 * lower, 1e3 * upper, 1e3 * closed.lower, 1e3 * closed.upper),
                     "give position and length in the heights of the mesh (times body.unit), z upwards");
  scan.lower = middle_at(scan.surface, limb.lower + hair, body.mean_skin_cell);
  scan.upper = middle_at(scan.surface, limb.upper - hair, body.mean_skin_cell);
  const double sigma = body.mean_skin_cell;
  const TrackedSections sections = track_sections(scan, 0.5 * sigma, 3.0 * sigma, where);
  limb.skin = std::make_unique<FourierOutline>(
      VectorSpline(sections.z0, sections.dz, smooth_coefficients(sections, sigma, where)));
  return limb;
}

namespace {

/// Skin, bone and ends of the limb that is scanned.
void fit_limb(const OrientedScan& scan, const input::BodySpec& spec, Limb& limb) {
  double radius = spec.scan->smoothing_radius;
  if (!(radius > 0.0)) radius = 2.0 * lower_section(scan, spec.where).girth / spec.cells_around;
  const double sigma = 0.5 * radius;
  const TrackedSections sections = track_sections(scan, 0.5 * sigma, 3.0 * sigma, spec.where);
  const Eigen::MatrixXd coefficients = smooth_coefficients(sections, sigma, spec.where);

  limb.skin = std::make_unique<FourierOutline>(VectorSpline(sections.z0, sections.dz, coefficients));
  limb.bone = bone_along(coefficients, sections, spec.scan->bone.value_or(input::BoneSpec{}), spec.where);
  limb.lower = scan.lower.z();
  limb.upper = scan.upper.z();
  limb.residual = residual_of(limb, coefficients, sections);
  limb.residual.smoothing_radius = radius;
  check_bone_inside(limb, spec.where);
}

}  // namespace

Limb limb_from_scan(const input::BodySpec& spec) {
  if (!spec.scan) throw InputError(spec.where, "body kind \"scan\" without a scan", "add the table [body.scan]");
  const OrientedScan scan = read_scan(*spec.scan, spec.where);
  Limb limb;
  for (const std::string& said : scan.said) limb.remarks.push_back({{spec.scan->surface.string()}, said, "write unit = \"1 mm\", or as it is"});
  for (const std::string& said : scan.mended) limb.remarks.push_back({{spec.scan->surface.string()}, said, "look at the scan there"});
  input::with_warnings(limb.remarks, [&] { fit_limb(scan, spec, limb); });
  return limb;
}

}  // namespace snug::mesh
