#include "mesh/body/scanned_surfaces.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/body/branching_body.hpp"
#include "mesh/body/scan.hpp"
#include "mesh/body/scan_measures.hpp"
#include "mesh/body/scan_surface.hpp"
#include "mesh/surface/level_surface.hpp"
#include "mesh/surface/mending.hpp"
#include "mesh/surface/vectors.hpp"

namespace snug::mesh {

namespace {

using input::InputError;

constexpr double cells_round_narrowest = 32.0, core_over_skin = 1.5;
constexpr double fewest_cells_round = 12.0;  // of an inner surface: its curved edges then keep its volume to some thousandths
constexpr double grid_over_size = 0.3;  // of the grid that inner surfaces are found on

/// Of a tube of the same volume and area: 2 pi r with r = 2 V/A. A core that runs out at a cut may have rims of no size.
double mean_girth(const TriangleSurface& surface) {
  double area = 0.0;
  for (const auto& t : surface.triangles) {
    const auto& x = surface.vertices;
    area += 0.5 * (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).norm();
  }
  return 4.0 * std::numbers::pi * std::abs(enclosed_volume(closed_flat(surface))) / area;
}

class Maker {
 public:
  Maker(const input::BodySpec& spec, const Layering& layering, ScanReport& report) : spec_(spec), scan_(*spec.scan), layering_(layering), report_(report) {}

  ScannedSurfaces make() {
    ScanSurface read = read_scan_surface(scan_, spec_.where);
    report_.said = read.said;
    to_body_ = read.to_body, unit_ = read.unit;
    made_.locations = on_skin(spec_.locations, read);
    find_cuts();
    mended_ = mend(read.surface, {.hole = scan_.fill_holes});
    say_mendings(mended_.mendings);
    if (scan_.wrap > 0.0) wrap_surface(scan_.wrap);
    make_skin();
    make_inner();
    return std::move(made_);
  }

 private:
  void say_mendings(const std::vector<Mending>& mendings) {
    for (const Mending& one : mendings)
      report_.said.push_back(one.at.isZero(0.0) ? "mended: " + one.what
                                                 : fmt::format("mended: {}, the first at ({:.0f}, {:.0f}, {:.0f}) mm", one.what, 1e3 * one.at.x(), 1e3 * one.at.y(), 1e3 * one.at.z()));
  }

  void find_cuts() {
    const auto add = [&](const std::string& name, const std::array<double, 3>& point, const std::array<double, 3>& normal, const input::Location& where) {
      made_.cuts.push_back({name, to_body_ * vector(point), (to_body_ * vector(normal)).normalized(), where});
    };
    for (const input::NamedCut& cut : scan_.cuts) add(cut.name, cut.point, cut.normal, cut.where);
    if (scan_.cuts.empty() && scan_.lower && scan_.upper) {
      add("lower", scan_.lower->point, scan_.lower->normal, spec_.where);
      add("upper", scan_.upper->point, scan_.upper->normal, spec_.where);
    }
  }

  void wrap_surface(double alpha) {
    std::vector<Mending> before = std::move(mended_.mendings);
    const std::vector<WideHole> holes = mended_.wide_holes;
    mended_ = wrap(mended_.surface, alpha, 0.08 * alpha);
    mended_.wide_holes = holes;
    say_mendings(mended_.mendings);
  }

  using Sections = std::vector<std::vector<Eigen::Vector2d>>;

  /// The section at the cut's point. Where the point lies outside of all of them the nearest is meant, if that is near and no other nearly as near.
  std::vector<std::size_t> section_of(const Cut& cut, const Sections& sections) {
    constexpr double beside = 0.5, farthest = 2.0;  // of the radius of a circle as large as the section
    const auto distance = [](const auto& section) { return inside_polygon(Eigen::Vector2d::Zero(), section) ? 0.0 : distance_to_polygon(Eigen::Vector2d::Zero(), section); };
    const std::vector<std::size_t> found = section_at_origin(sections);
    if (found.empty()) return found;
    const double off = distance(sections[found.front()]), radius = std::sqrt(std::abs(polygon_area(sections[found.front()])) / std::numbers::pi);
    if (off <= beside * radius) return found;
    const auto nearly = std::count_if(sections.begin(), sections.end(), [&](const auto& section) { return distance(section) < 2.0 * off; });
    const std::string outside = fmt::format("the point of the cut \"{}\" lies {:.0f} mm outside the surface", cut.name, 1e3 * off);
    if (off > farthest * radius || nearly > 1) throw InputError(cut.where, outside, "give a point inside the limb that is cut, in the file's axes");
    if (made_.surfaces.empty()) report_.said.push_back(outside + "; the limb next to it is cut");
    return found;
  }

  /// What the cuts leave of the whole surface.
  TriangleSurface cut_surface() {
    TriangleSurface kept = mended_.surface;
    for (const Cut& cut : made_.cuts)
      if (cut_off(kept, cut, [&](const Sections& sections) { return section_of(cut, sections); }).empty())
        throw InputError(cut.where, fmt::format("the cut \"{}\" misses the surface", cut.name), "check its point (in the file's frame), the scan's unit and its up axis");
    return compacted(kept);
  }

  void refuse_wide_holes(const TriangleSurface& kept) const {
    for (const WideHole& hole : mended_.wide_holes)
      if (std::any_of(kept.vertices.begin(), kept.vertices.end(), [&](const auto& x) { return x == hole.rim; }))
        throw InputError({scan_.surface.string()},
                         fmt::format("the surface has a hole {:.0f} mm wide at ({:.0f}, {:.0f}, {:.0f}) mm in the frame of the body", 1e3 * hole.width, 1e3 * hole.rim.x(), 1e3 * hole.rim.y(),
                                     1e3 * hole.rim.z()),
                         "close it in the scanner's program, let a cut drop it, or fill it flat: fill_holes");
  }

  double narrowest_girth(const TriangleSurface& kept) const {
    double narrowest = 1e300;
    for (const Rim& rim : border_loops(kept)) narrowest = std::min(narrowest, length_of(kept, rim));
    return narrowest;
  }

  void make_skin() {
    TriangleSurface kept = cut_surface();
    refuse_wide_holes(kept);
    if (border_loops(kept).empty()) throw InputError(spec_.where, "nothing of the scan lies between the cuts", "turn the normals of the cuts: they point out of what is kept");
    size_ = scan_.cell_size > 0.0 ? scan_.cell_size : narrowest_girth(kept) / cells_round_narrowest;
    report_.cell_size = size_;
    radius_ = scan_.smoothing_radius > 0.0 ? scan_.smoothing_radius : size_;
    const auto make = [&] {
      made_.surfaces.clear();
      made_.surfaces.push_back(nested_surface("skin", mended_.surface, kept, made_.cuts, size_, {.radius = radius_}, spec_.where));
    };
    try {
      make();
    } catch (const std::runtime_error& error) {
      if (dynamic_cast<const InputError*>(&error)) throw;
      throw InputError({scan_.surface.string()}, fmt::format("the surface cannot be meshed: {}", error.what()), "mend it in the scanner's program, or write wrap = \"10 mm\"");
    }
    if (made_.surfaces[0].cuts_itself && !(scan_.wrap > 0.0)) {
      report_.said.push_back("the surface cuts itself between the cuts");
      wrap_surface(0.8 * size_);
      kept = cut_surface();
      make();
    }
    if (made_.surfaces[0].cuts_itself)
      throw NotMeshed({scan_.surface.string()}, "the surface still cuts itself where it was remeshed", "take a smaller cell_size, or write wrap = \"10 mm\"");
    made_.kept = closed_flat(kept);
    report_.smoothing_radius = radius_;
    report_.skin_triangles = static_cast<int>(made_.surfaces[0].mesh.triangles.size()), report_.skin_on_facets = made_.surfaces[0].on_facets;
    report_.volume_of_scan = enclosed_volume(made_.kept);
    measure_deviation(*made_.surfaces[0].smooth, kept, report_);
  }

  /// Where level functions are looked at: what is kept, and as far beyond the cuts as inner surfaces have to reach.
  Box box() const {
    Box box{made_.kept.vertices.front(), made_.kept.vertices.front()};
    for (const auto& x : made_.kept.vertices) box.low = box.low.cwiseMin(x), box.high = box.high.cwiseMax(x);
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(4.0 * size_);
    return {box.low - margin, box.high + margin};
  }

  double tissue_at(const Eigen::Vector3d& x) const {
    double more = 0.0, weights = 0.0;
    for (const input::CorePlace& place : scan_.core->places) {
      const double weight = std::exp(-(x - to_body_ * vector(place.at)).squaredNorm() / (place.radius * place.radius));
      more += weight * (place.thickness - *scan_.core->thickness), weights += weight;
    }
    return *scan_.core->thickness + more / std::max(1.0, weights);
  }

  /// The core as a closed surface that reaches beyond the cuts.
  TriangleSurface core_surface() {
    if (!scan_.core) return bone_of_limb();
    if (!scan_.core->surface.empty()) {
      TriangleSurface core = read_surface(scan_.core->surface);
      for (auto& x : core.vertices) x = to_body_ * (unit_ * x);
      MendedSurface mended = mend(core);
      for (Mending& one : mended.mendings) one.what = "core: " + one.what;
      say_mendings(mended.mendings);
      return std::move(mended.surface);
    }
    const SurfaceTree& skin = made_.surfaces[0].smooth->tree();
    return level_surface([&](const Eigen::Vector3d& x) { return -skin.signed_distance(x) - tissue_at(x); }, box(), grid_over_size * size_);
  }

  /// The ellipse along the limb's middle, as the hexahedra have it, a little beyond the cuts.
  TriangleSurface bone_of_limb() {
    const Limb limb = limb_from_scan(with_lower_and_upper(spec_));
    constexpr int around = 96, along = 80;
    const double margin = 4.0 * size_;
    TriangleSurface tube;
    for (int j = 0; j <= along; ++j)
      for (int i = 0; i < around; ++i) {
        const double z = limb.lower - margin + j * (limb.upper - limb.lower + 2.0 * margin) / along, inside = std::clamp(z, limb.lower, limb.upper);
        Eigen::Vector3d x = limb.bone->at(static_cast<double>(i) / around, inside);
        x.z() = z;
        tube.vertices.push_back(x);
      }
    const auto node = [&](int i, int j) { return j * around + i % around; };
    for (int j = 0; j < along; ++j)
      for (int i = 0; i < around; ++i) {
        tube.triangles.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
        tube.triangles.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
      }
    return closed_flat(std::move(tube));
  }

  void refuse_empty(const TriangleSurface& surface, const std::string& name) const {
    if (surface.triangles.empty()) throw InputError(spec_.where, fmt::format("nothing of the body is so deep that there could be a surface \"{}\"", name), "make the tissue thinner");
  }

  void add_inner(const std::string& name, TriangleSurface whole, double size, const SurfaceTree& inside, double at_corners = exact_corners) {
    refuse_empty(whole, name);
    const double asked = size;
    const auto make = [&](double corners) {
      const TriangleSurface kept = kept_inside(whole, made_.cuts, made_.surfaces[0], inside);
      if (kept.triangles.empty()) throw InputError(spec_.where, fmt::format("no part of \"{}\" lies between the cuts", name), "check unit and place of the core, or make the tissue thinner");
      size = std::min(asked, mean_girth(kept) / fewest_cells_round);
      return nested_surface(name, whole, kept, made_.cuts, size, {std::min(radius_, 0.5 * size), corners}, spec_.where);
    };
    NestedSurface surface = make(at_corners);
    if (surface.cuts_itself) {  // where a layer ends as thin as an edge
      MendedSurface wrapped = wrap(whole, 0.8 * size, 0.08 * size);
      for (Mending& one : wrapped.mendings) one.what = name + ": " + one.what;
      say_mendings(wrapped.mendings);
      whole = std::move(wrapped.surface);
      surface = make(scanned_corners);
    }
    if (surface.cuts_itself) throw NotMeshed(spec_.where, fmt::format("the surface \"{}\" cuts itself", name), "take a smaller cell_size, or another thickness");
    made_.surfaces.push_back(std::move(surface));
  }

  /// From the outside: layers with a thickness under the skin, those over the core, the core.
  void make_inner() {
    const SurfaceTree inside(made_.kept), &skin = made_.surfaces[0].smooth->tree();
    const auto& solids = layering_.solids();
    std::size_t rest = 0;
    while (rest < solids.size() && solids[rest].thickness) ++rest;
    TriangleSurface core = core_surface();
    refuse_empty(core, "bone");
    double depth = 0.0;
    for (std::size_t n = solids.size() - 1; n > rest; --n) {
      depth += *solids[n].thickness;
      add_inner(solids[n - 1].name + " to " + solids[n].name,
                level_surface([&](const Eigen::Vector3d& x) { return -skin.signed_distance(x) - depth; }, box(), grid_over_size * size_), size_, inside);
    }
    const SurfaceTree bone(core);
    for (std::size_t n = rest; n > 0; --n) {
      double over = 0.0;
      for (std::size_t m = 0; m < n; ++m) over += *solids[m].thickness;
      add_inner(solids[n - 1].name + " to " + solids[n].name,
                level_surface([&](const Eigen::Vector3d& x) { return over - bone.signed_distance(x); }, box(), grid_over_size * size_), size_, inside);
    }
    const double core_size = scan_.core && scan_.core->cell_size ? *scan_.core->cell_size : core_over_skin * size_;
    add_inner("bone", std::move(core), core_size, inside, scan_.core && !scan_.core->surface.empty() ? scanned_corners : exact_corners);
  }

  const input::BodySpec& spec_;
  const input::ScanSpec& scan_;
  const Layering& layering_;
  ScanReport& report_;
  ScannedSurfaces made_;
  Eigen::Matrix3d to_body_;
  double unit_ = 1.0, size_ = 0.0, radius_ = 0.0;
  MendedSurface mended_;
};

}  // namespace

ScannedSurfaces scanned_surfaces(const input::BodySpec& spec, const Layering& layering, ScanReport& report) { return Maker(spec, layering, report).make(); }

}  // namespace snug::mesh
