#include "solver/terms/master_surface.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace snug::solver {

namespace {

// A point may leave the border of the surface by this much of a facet and still meet it.
constexpr double border_reach = 1.0 + 1e-6;
// A point that was on a facet stays with its extended surface this far over the edge. Facets meet at a slight kink; a point
// that changed sides at the edge itself would meet a jump of the normal there, and in a concave kink no normal at all would
// bring it to rest. The extended surface is off by the kink angle times this fraction of the facet: of third order in h.
// The same holds at the border: a point that faced the skin when its triangle was cut faces it until the next cut.
constexpr double hysteresis = 0.2;

std::vector<mesh::FacetNodeNumbers> facets_of(const mesh::GarmentMesh& garment) {
  if (garment.order != 2) throw std::invalid_argument("the master surface of a contact has quadratic facets");
  std::vector<mesh::FacetNodeNumbers> facets;
  for (const auto& triangle : garment.triangles) {
    auto& facet = facets.emplace_back();
    facet.fill(-1);
    for (int a = 0; a < 6; ++a) facet[a] = garment.merged[triangle[a]];
  }
  return facets;
}

}  // namespace

MasterSurface::MasterSurface(const Field& positions, mesh::FacetKind kind, std::vector<mesh::FacetNodeNumbers> list,
                             std::vector<Eigen::Vector3d> reference, double mean_edge)
    : positions_(positions), kind_(kind), domain_(&facet_domain(kind_)), facets_(std::move(list)), reference_(std::move(reference)),
      mean_edge_(mean_edge), tree_(boxes()) {
  connect();
}

MasterSurface::MasterSurface(const Field& positions, const mesh::BodyMesh& mesh, std::vector<mesh::FacetNodeNumbers> list)
    : MasterSurface(positions, facet_kind(mesh.kind), list, mesh.nodes, mesh::mean_edge(mesh, list)) {}

MasterSurface::MasterSurface(const Field& positions, const mesh::GarmentMesh& garment)
    : MasterSurface(positions, mesh::FacetKind::tri6, facets_of(garment), garment.placed, garment.mean_edge) {}

std::vector<Eigen::AlignedBox3d> MasterSurface::boxes() const {
  std::vector<Eigen::AlignedBox3d> boxes(facets_.size());
  for (std::size_t f = 0; f < facets_.size(); ++f)
    for (const int node : facets_[f])
      if (node >= 0) boxes[f].extend(reference_[node]);
  return boxes;
}

fem::BoxTree MasterSurface::tree(const State& state) const {
  std::vector<Eigen::AlignedBox3d> boxes(facets_.size());
  for (int f = 0; f < facets(); ++f) {
    const FacetNodes nodes = positions(state, f);
    for (int a = 0; a < 9 && facets_[f][a] >= 0; ++a) boxes[f].extend(Eigen::Vector3d(nodes.col(a)));
  }
  return fem::BoxTree(boxes);
}

void MasterSurface::connect() {
  std::map<std::pair<int, int>, std::pair<int, int>> open;  // corner pair -> facet, edge
  const int edges = static_cast<int>(domain_->edges.size());
  neighbours_.assign(facets_.size(), std::vector<int>(edges, -1));
  for (int f = 0; f < facets(); ++f)
    for (int e = 0; e < edges; ++e) {
      const int a = facets_[f][domain_->edge_corners[e][0]], b = facets_[f][domain_->edge_corners[e][1]];
      const auto key = std::minmax(a, b);
      const auto [it, fresh] = open.emplace(key, std::pair{f, e});
      if (fresh) continue;
      neighbours_[f][e] = it->second.first;
      neighbours_[it->second.first][it->second.second] = f;
    }
}

FacetNodes MasterSurface::positions(const State& state, int facet) const {
  FacetNodes nodes = FacetNodes::Zero();
  for (int a = 0; a < 9 && facets_[facet][a] >= 0; ++a)
    nodes.col(a) = deformable() ? Eigen::Vector3d(state.values.segment<3>(positions_(facets_[facet][a])))
                                : reference_[facets_[facet][a]];
  return nodes;
}

bool MasterSurface::settle(const State& state, const Eigen::Vector3d& x, double stay, Site& site) const {
  std::vector<Site> way;  // facets that x projects beyond, with the place
  for (int walk = 0; walk < 12; ++walk, stay = 0.0) {
    if (!project(kind_, positions(state, site.facet), x, 1.5, site.xi)) return false;
    int edge = 0;
    for (int e = 1; e < static_cast<int>(domain_->edges.size()); ++e)
      if (beyond(*domain_, e, site.xi) > beyond(*domain_, edge, site.xi)) edge = e;
    const double over = beyond(*domain_, edge, site.xi);
    if (over <= 1e-9 || over <= stay) return true;
    way.push_back(site);
    const int next = neighbours_[site.facet][edge];
    if (next < 0) {  // the border: a hair's breadth over it still counts
      site.xi = clamped(kind_, site.xi);
      return over <= border_reach - 1.0;
    }
    const auto seen = std::find_if(way.begin(), way.end(), [&](const Site& at) { return at.facet == next; });
    if (seen != way.end()) {  // the point stands over a convex kink, an edge or a corner, that these facets share
      way.erase(way.begin(), seen);
      site = nearest_of(state, x, std::move(way));
      return true;
    }
    site = {next, domain_->centre};
  }
  return false;
}

double MasterSurface::distance(const State& state, const Eigen::Vector3d& x, const Site& site) const {
  return (x - positions(state, site.facet) * facet_shape(kind_, site.xi).N).norm();
}

/// The nearest of the places, each drawn to its facet's edge; the first of those that are as near, so that a point which comes from one
/// of the facets stays with it: one that went round with every look would meet another normal in every iterate.
Site MasterSurface::nearest_of(const State& state, const Eigen::Vector3d& x, std::vector<Site> places) const {
  const double as_near = 1e-3 * mean_edge_;
  for (Site& at : places) at.xi = clamped(kind_, at.xi);
  const Site* best = &places.front();
  double least = distance(state, x, *best);
  for (const Site& at : places)
    if (const double d = distance(state, x, at); d < least - as_near) least = d, best = &at;
  return *best;
}

Site MasterSurface::follow(const State& state, const Eigen::Vector3d& x, const Site& last, const fem::BoxTree* tree) const {
  if (last.facet >= 0) {
    Site site = last;
    if (settle(state, x, hysteresis, site)) return site;
  }
  return find(state, x, tree);
}

Site MasterSurface::find(const State& state, const Eigen::Vector3d& x, const fem::BoxTree* tree) const {
  Site best;
  double least = std::numeric_limits<double>::max();
  for (const int facet : (tree ? *tree : tree_).nearest(x, 6)) {
    Site site{facet, domain_->centre};
    if (!settle(state, x, 0.0, site)) continue;
    const double d = distance(state, x, site);
    if (d < least) least = d, best = site;
  }
  return best;
}

}  // namespace snug::solver
