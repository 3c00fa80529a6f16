#include "mesh/body/scan_measures.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "mesh/body/nested_surfaces.hpp"
#include "mesh/body/sections.hpp"
#include "mesh/surface/mending.hpp"

namespace snug::mesh {

namespace {

constexpr int parts_of_edge = 6, section_rows = 13;

/// A point of a six-node triangle; which of its nodes are corners their reference places say.
Eigen::Vector3d point_of(const BodyMesh& mesh, const FacetNodeNumbers& facet, double r, double s) {
  static const fem::Points place = fem::reference_nodes(fem::Element::tri6);
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  const double t = 1.0 - r - s;
  for (int a = 0; a < 6; ++a) {
    const std::array<double, 3> at = {1.0 - place(0, a) - place(1, a), place(0, a), place(1, a)}, here = {t, r, s};
    double value = 1.0;
    int halves = 0;
    for (int k = 0; k < 3; ++k) halves += std::abs(at[k] - 0.5) < 0.1;
    if (halves == 2) {
      value = 4.0;
      for (int k = 0; k < 3; ++k)
        if (std::abs(at[k] - 0.5) < 0.1) value *= here[k];
    } else {
      for (int k = 0; k < 3; ++k)
        if (at[k] > 0.9) value = here[k] * (2.0 * here[k] - 1.0);
    }
    x += value * mesh.nodes[facet[a]];
  }
  return x;
}

double nearest_girth(const TriangleSurface& surface, const Cut& cut, double* area) {
  // The surface turned so that the plane is horizontal.
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(cut.normal, Eigen::Vector3d::UnitZ());
  TriangleSurface turned = surface;
  for (auto& x : turned.vertices) x = turn * (x - cut.point);
  const auto loops = slice(turned, -1e-4);
  std::vector<std::vector<Eigen::Vector2d>> polygons;
  for (const auto& loop : loops) polygons.push_back(loop.points);
  const auto chosen = section_at_origin(polygons);
  if (chosen.empty()) return 0.0;
  if (area) *area = std::abs(loops[chosen[0]].area);
  return loops[chosen[0]].girth;
}

}  // namespace

double length_of(const TriangleSurface& surface, const Rim& rim) {
  double length = 0.0;
  for (std::size_t n = 0; n < rim.size(); ++n) length += (surface.vertices[rim[(n + 1) % rim.size()]] - surface.vertices[rim[n]]).norm();
  return length;
}

void measure_deviation(const SmoothSurface& smooth, const TriangleSurface& kept, ScanReport& report) {
  constexpr std::size_t enough = 2000;  // vertices, all over the scan: their mean is known to a few hundredths
  const std::size_t step = std::max<std::size_t>(1, kept.vertices.size() / enough);
  double sum = 0.0;
  int count = 0;
  for (std::size_t v = 0; v < kept.vertices.size(); v += step, ++count) {
    const double off = (smooth.onto(kept.vertices[v]).x - kept.vertices[v]).norm();
    sum += off * off;
    report.deviation_max = std::max(report.deviation_max, off);
  }
  report.deviation_rms = std::sqrt(sum / std::max(1, count));
}

namespace {

/// Curved facets as flat triangles, `parts` to an edge.
TriangleSurface fine_surface(const BodyMesh& mesh, const std::vector<FacetNodeNumbers>& facets, int parts) {
  TriangleSurface fine;
  for (const FacetNodeNumbers& facet : facets) {
    const int base = static_cast<int>(fine.vertices.size());
    std::vector<std::vector<int>> number(parts + 1);
    int next = base;
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j) {
        number[i].push_back(next++);
        fine.vertices.push_back(point_of(mesh, facet, static_cast<double>(i) / parts, static_cast<double>(j) / parts));
      }
    for (int i = 0; i < parts; ++i)
      for (int j = 0; i + j < parts; ++j) {
        fine.triangles.push_back({number[i][j], number[i + 1][j], number[i][j + 1]});
        if (i + j + 1 < parts) fine.triangles.push_back({number[i + 1][j], number[i + 1][j + 1], number[i][j + 1]});
      }
  }
  return weld(fine);
}

}  // namespace

TriangleSurface fine_skin(const BodyMesh& mesh, int parts) { return fine_surface(mesh, mesh.skin_facets, parts); }

void measure_sections(const BodyMesh& mesh, const TriangleSurface& closed_scan, ScanReport& report) {
  const TriangleSurface fine = closed_flat(fine_skin(mesh, parts_of_edge));
  double low = 1e300, high = -1e300;
  for (const auto& x : fine.vertices) low = std::min(low, x.z()), high = std::max(high, x.z());
  const auto largest = [](const std::vector<SectionLoop>& loops) { return std::max_element(loops.begin(), loops.end(), [](const auto& a, const auto& b) { return a.girth < b.girth; }); };
  for (int n = 0; n < section_rows; ++n) {
    const double z = low + (high - low) * (n + 0.5) / section_rows;
    const auto ours = slice(fine, z), scan = slice(closed_scan, z);
    if (ours.empty() || scan.empty()) continue;
    report.sections.push_back({z, largest(scan)->girth, largest(ours)->girth, static_cast<int>(ours.size())});
  }
}

CutRow cut_row(const BodyMesh& mesh, const TriangleSurface& closed_scan, const Cut& cut) {
  CutRow row{cut.name, nearest_girth(closed_scan, cut, nullptr), 0.0, 0.0};
  row.girth = nearest_girth(fine_skin(mesh, parts_of_edge), cut, &row.area);
  return row;
}

double volume_between(const BodyMesh& mesh) { return enclosed_volume(closed_flat(fine_skin(mesh, parts_of_edge))); }

double volume_inside(const BodyMesh& mesh, const std::string& surface) {
  return std::abs(enclosed_volume(closed_flat(fine_surface(mesh, mesh.surface(surface)->facets, parts_of_edge))));
}

}  // namespace snug::mesh
