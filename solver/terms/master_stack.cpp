#include "solver/terms/master_stack.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace snug::solver {

namespace {

// A point outside an upper surface that lies on the lowest one is no farther from it than from that one but for what their
// meshes differ; one that has got through it is, by as much as it may have got through. Fractions of the upper one's edge.
// What is farther away is another limb's.
constexpr double unlike_meshes = 0.05, got_through = 0.5;

struct Distance {
  double length = std::numeric_limits<double>::infinity(), gap = 0.0;  // m
};

Distance distance(const MasterSurface& surface, const State& state, const Eigen::Vector3d& x, const Site& site) {
  if (site.facet < 0) return {};
  const FacetPoint at = facet_point(surface.positions(state, site.facet), facet_shape(surface.kind(), site.xi));
  return {(x - at.y).norm(), (x - at.y).dot(at.n)};
}

}  // namespace

MasterStack::MasterStack(MasterSurface surface) {
  surfaces_.push_back(std::move(surface));
  number_through();
}

MasterStack::MasterStack(std::vector<MasterSurface> surfaces) : surfaces_(std::move(surfaces)) {
  if (surfaces_.empty()) throw std::invalid_argument("a contact needs a master surface");
  number_through();
}

void MasterStack::number_through() {
  first_facet_ = first_node_ = {0};
  for (const MasterSurface& surface : surfaces_) {
    const int facet = first_facet_.back(), node = first_node_.back();
    for (int f = 0; f < surface.facets(); ++f) {
      nodes_.push_back(surface.nodes_of(f)), neighbours_.push_back(surface.neighbours(f));
      for (int& n : nodes_.back())
        if (n >= 0) n += node;
      for (int& n : neighbours_.back())
        if (n >= 0) n += facet;
    }
    first_facet_.push_back(facet + surface.facets()), first_node_.push_back(node + surface.nodes());
    deformable_ = deformable_ || surface.deformable();
  }
}

int MasterStack::surface_of(int facet) const {
  int surface = 0;
  while (facet >= first_facet_[surface + 1]) ++surface;
  return surface;
}

double MasterStack::longest_mean_edge() const {
  double edge = 0.0;
  for (const MasterSurface& surface : surfaces_) edge = std::max(edge, surface.mean_edge());
  return edge;
}

double MasterStack::shortest_mean_edge() const {
  double edge = std::numeric_limits<double>::infinity();
  for (const MasterSurface& surface : surfaces_) edge = std::min(edge, surface.mean_edge());
  return edge;
}

int MasterStack::entry(int node, int component) const {
  int surface = 0;
  while (node >= first_node_[surface + 1]) ++surface;
  return surfaces_[surface].entry(node - first_node_[surface], component);
}

FacetNodes MasterStack::positions(const State& state, int facet) const {
  const int surface = surface_of(facet);
  return surfaces_[surface].positions(state, facet - first_facet_[surface]);
}

Site MasterStack::shifted(int surface, Site site) const {
  if (site.facet >= 0) site.facet += first_facet_[surface];
  return site;
}

MasterStack::Trees MasterStack::trees(const State& state) const {
  if (state.posture == 0.0) return {};
  std::vector<fem::BoxTree> trees;
  for (const MasterSurface& surface : surfaces_) trees.push_back(surface.tree(state));
  return std::make_shared<const std::vector<fem::BoxTree>>(std::move(trees));
}

Site MasterStack::find(const State& state, const Eigen::Vector3d& x, const Trees& trees) const {
  const auto tree = [&](int s) { return trees ? &(*trees)[s] : nullptr; };
  const int lowest = surfaces() - 1;
  const Site ground = surfaces_[lowest].find(state, x, tree(lowest));
  if (lowest == 0) return ground;
  const double depth = distance(surfaces_[lowest], state, x, ground).length;
  for (int s = 0; s < lowest; ++s) {
    const Site site = surfaces_[s].find(state, x, tree(s));
    const auto [length, gap] = distance(surfaces_[s], state, x, site);
    if (site.facet >= 0 && length <= depth + (gap < 0.0 ? got_through : unlike_meshes) * surfaces_[s].mean_edge()) return shifted(s, site);
  }
  return shifted(lowest, ground);
}

Site MasterStack::follow(const State& state, const Eigen::Vector3d& x, const Site& last, const Trees& trees) const {
  if (last.facet >= 0) {
    const int s = surface_of(last.facet);
    const Site site = surfaces_[s].follow(state, x, {last.facet - first_facet_[s], last.xi}, trees ? &(*trees)[s] : nullptr);
    if (site.facet >= 0 || surfaces() == 1) return shifted(s, site);
  }
  return find(state, x, trees);
}

}  // namespace snug::solver
