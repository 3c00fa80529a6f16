#include "mesh/body/filled_surfaces.hpp"

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>

#include "mesh/body/locations.hpp"
#include "mesh/body/quadratic_cells.hpp"

namespace snug::mesh {

namespace {

class Filling {
 public:
  Filling(const input::BodySpec& spec, const Layering& layering, const ScannedSurfaces& from, ScanReport& report)
      : spec_(spec), layering_(layering), from_(from), report_(report) {}

  BodyMesh operator()() {
    make_caps();
    fill();
    return std::move(mesh_);
  }

 private:
  /// Triangles of the cut faces between each surface and the next one inside.
  void make_caps() {
    for (const NestedSurface& surface : from_.surfaces) {
      first_.push_back(static_cast<int>(complex_.nodes.size()));
      complex_.nodes.insert(complex_.nodes.end(), surface.mesh.vertices.begin(), surface.mesh.vertices.end());
    }
    const std::size_t regions = layering_.bone() ? from_.surfaces.size() : from_.surfaces.size() - 1;
    caps_.assign(from_.cuts.size(), std::vector<std::vector<std::array<int, 3>>>(regions));
    for (std::size_t c = 0; c < from_.cuts.size(); ++c)
      for (std::size_t s = 0; s < regions; ++s)
        for (const Rim& rim : from_.surfaces[s].rims[c]) fill_cap(c, s, rim);
  }

  void fill_cap(std::size_t c, std::size_t s, const Rim& rim) {
    const PlaneFrame frame(from_.cuts[c]);
    const auto outer = flat_rim(from_.surfaces[s], rim, frame);
    std::vector<int> number;
    for (const int v : rim) number.push_back(first_[s] + v);
    std::vector<std::vector<Eigen::Vector2d>> holes;
    if (s + 1 < from_.surfaces.size())
      for (const Rim& inner : from_.surfaces[s + 1].rims[c]) {
        auto hole = flat_rim(from_.surfaces[s + 1], inner, frame);
        const auto in = std::count_if(hole.begin(), hole.end(), [&](const auto& p) { return inside_polygon(p, outer); });
        if (in == 0) continue;
        if (in < static_cast<long>(hole.size()))
          throw NotMeshed(from_.cuts[c].where, fmt::format("\"{}\" and \"{}\" meet at the cut \"{}\"", from_.surfaces[s].name, from_.surfaces[s + 1].name, from_.cuts[c].name), "make the layers or the core thinner there");
        for (const int v : inner) number.push_back(first_[s + 1] + v);
        holes.push_back(std::move(hole));
      }
    const PlaneMesh plane = by_gmsh(from_.cuts[c].where, fmt::format("the face of the cut \"{}\"", from_.cuts[c].name), [&] { return filled(outer, holes); });
    while (number.size() < plane.nodes.size()) {
      complex_.nodes.push_back(frame.lifted(plane.nodes[number.size()]));
      number.push_back(static_cast<int>(complex_.nodes.size()) - 1);
    }
    for (const auto& t : plane.triangles) caps_[c][s].push_back({number[t[0]], number[t[1]], number[t[2]]});
  }

  template <class Work>
  auto by_gmsh(const input::Location& where, const std::string& what, Work work) -> decltype(work()) {
    try {
      return work();
    } catch (const std::runtime_error& error) {
      throw NotMeshed(where, fmt::format("{} cannot be meshed: gmsh: {}", what, error.what()), "take another cell_size, thinner layers or a smaller core: surfaces meet, perhaps");
    }
  }

  int add_patch(const std::string& name, std::vector<std::array<int, 3>> triangles, int first) {
    for (auto& t : triangles)
      for (int& v : t) v += first;
    complex_.patches.push_back({name, std::move(triangles)});
    return static_cast<int>(complex_.patches.size()) - 1;
  }

  void fill() {
    std::vector<int> patch;
    for (std::size_t s = 0; s < from_.surfaces.size(); ++s) patch.push_back(add_patch(from_.surfaces[s].name, from_.surfaces[s].mesh.triangles, first_[s]));
    const std::size_t regions = caps_.empty() ? 0 : caps_.front().size();
    for (std::size_t s = 0; s < regions; ++s) {
      PatchComplex::Region region{from_.surfaces[s].name, {patch[s]}};
      if (s + 1 < from_.surfaces.size()) region.patches.push_back(patch[s + 1]);
      for (std::size_t c = 0; c < from_.cuts.size(); ++c)
        if (!caps_[c][s].empty()) region.patches.push_back(add_patch(from_.cuts[c].name, caps_[c][s], 0));
      complex_.regions.push_back(std::move(region));
    }
    const Tetrahedra linear = by_gmsh(spec_.where, "the body", [&] { return filled(complex_); });
    if (linear.cells.empty()) throw NotMeshed(spec_.where, "gmsh filled the body with no cells", "take another cell_size");
    std::vector<std::vector<std::array<int, 3>>> faces(from_.cuts.size());
    for (std::size_t c = 0; c < from_.cuts.size(); ++c)
      for (const auto& part : caps_[c]) faces[c].insert(faces[c].end(), part.begin(), part.end());
    take_over(linear, quadratic(linear, from_.surfaces, first_, faces, from_.cuts));
  }

  /// Layers from the inside out; region s lies outside of surface s + 1.
  void take_over(const Tetrahedra& linear, QuadraticCells cells) {
    mesh_.kind = CellKind::tet10;
    if (const auto* bone = layering_.bone()) mesh_.layers.push_back({bone->name, bone->material});
    for (const auto& layer : layering_.solids()) mesh_.layers.push_back({layer.name, layer.material});
    for (const auto& layer : layering_.membranes()) mesh_.membranes.push_back({layer.name, layer.material, *layer.thickness});
    const std::vector<int> number = numbers_in_use(cells);
    mesh_.cells = std::move(cells.cells);
    for (CellNodes& cell : mesh_.cells)
      for (int a = 0; a < 10; ++a) cell[a] = number[cell[a]];
    for (const int region : linear.region) mesh_.cell_layer.push_back(static_cast<int>(mesh_.layers.size()) - 1 - region);
    if (cells.straightened > 0) report_.said.push_back(fmt::format("{} edges were left less curved than the surface, so that no cell turns inside out", cells.straightened));
    check_cells();
    for (std::size_t s = 0; s < from_.surfaces.size(); ++s) add_surface(from_.surfaces[s].name, cells.on_surface[s], number);
    for (std::size_t c = 0; c < from_.cuts.size(); ++c) add_surface(from_.cuts[c].name, cells.on_cut[c], number);
    if (!layering_.bone()) mesh_.bone_nodes = mesh_.surface("bone")->nodes;
    mesh_.skin_facets = mesh_.surface("skin")->facets;
    mesh_.mean_skin_cell = mean_edge(mesh_, mesh_.skin_facets);
    assign_locations(from_.locations, mesh_);
  }

  /// New numbers of the nodes that cells use.
  std::vector<int> numbers_in_use(const QuadraticCells& cells) {
    std::vector<int> number(cells.nodes.size(), -1);
    for (const CellNodes& cell : cells.cells)
      for (int a = 0; a < 10; ++a) number[cell[a]] = 0;
    for (std::size_t n = 0; n < number.size(); ++n)
      if (number[n] == 0) number[n] = static_cast<int>(mesh_.nodes.size()), mesh_.nodes.push_back(cells.nodes[n]);
    return number;
  }

  void add_surface(const std::string& name, const std::vector<int>& nodes, const std::vector<int>& number) {
    Surface surface{name, {}, {}};
    std::vector<char> keep(mesh_.nodes.size(), 0);
    for (const int n : nodes)
      if (number[n] >= 0) surface.nodes.push_back(number[n]), keep[number[n]] = 1;
    surface.facets = boundary_facets(mesh_, keep);
    mesh_.surfaces.push_back(std::move(surface));
  }

  void check_cells() {
    for (const CellNodes& cell : mesh_.cells) {
      const CellPositions x = cell_positions(mesh_.kind, cell, mesh_.nodes);
      for (const SamplePoint& sample : check_points(mesh_.kind)) {
        if (jacobian(x, sample).determinant() > 0.0) continue;
        const Eigen::Vector3d at = 1e3 * x.rowwise().mean();
        throw NotMeshed(spec_.where, fmt::format("a cell near ({:.0f}, {:.0f}, {:.0f}) mm would turn inside out", at.x(), at.y(), at.z()), "take a smaller cell_size or thicker layers there");
      }
    }
  }

  const input::BodySpec& spec_;
  const Layering& layering_;
  const ScannedSurfaces& from_;
  ScanReport& report_;
  BodyMesh mesh_;
  PatchComplex complex_;
  std::vector<int> first_;
  std::vector<std::vector<std::vector<std::array<int, 3>>>> caps_;  // by cut and region
};

}  // namespace

BodyMesh filled_body(const input::BodySpec& spec, const Layering& layering, const ScannedSurfaces& surfaces, ScanReport& report) {
  return Filling(spec, layering, surfaces, report)();
}

}  // namespace snug::mesh
