// Where the points of contact stand, which facets they meet and what they couple.
#include "solver/terms/contact.hpp"

#include <algorithm>

#include "solver/terms/parallel.hpp"

namespace snug::solver {

namespace {

// A facet counts as coupled to a triangle when a point is this near to its edge (a facet measures 2), so that the pattern
// of the matrix lasts.
constexpr double coupling_margin = 0.15;

}  // namespace

void Contact::couple(int facet, Element& element) {
  if (facet < 0 || std::find(element.facets.begin(), element.facets.end(), facet) != element.facets.end()) return;
  element.facets.push_back(facet);
  for (const int node : skin_.nodes_of(facet))
    if (node >= 0 && std::find(element.skin_nodes.begin(), element.skin_nodes.end(), node) == element.skin_nodes.end())
      element.skin_nodes.push_back(node);
}

void Contact::couple(Element& element) {
  element.facets.clear();
  element.skin_nodes.clear();
  for (const ContactPoint& point : element.points) {
    const Site& site = point.site;
    if (site.facet < 0) continue;
    couple(site.facet, element);
    const auto& next = skin_.neighbours(site.facet);
    for (std::size_t edge = 0; edge < next.size(); ++edge)
      if (beyond(skin_.domain(), static_cast<int>(edge), site.xi) > -coupling_margin) couple(next[edge], element);
  }
}

std::vector<std::vector<int>> Contact::coupled() const {
  std::vector<std::vector<int>> facets;
  for (const Element& element : elements_) facets.push_back(element.facets);
  return facets;
}

void Contact::recall(const std::vector<char>& active, const std::vector<std::vector<int>>& coupled) {
  active_.set(active);
  for (std::size_t e = 0; e < coupled.size(); ++e)
    for (const int facet : coupled[e]) couple(facet, elements_[e]);
  rebuild_entries();
}

void Contact::rebuild_entries() {
  entries_ = {};
  std::vector<int> entries;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const Element& element = elements_[e];
    entries.clear();
    for (const int entry : slave_.triangles[e].entries)
      for (int c = 0; c < 3; ++c) entries.push_back(entry + c);
    for (const int node : element.skin_nodes)
      for (int c = 0; c < 3; ++c) entries.push_back(layout_.body(node, c));
    for (const int vertex : slave_.triangles[e].vertices) entries.push_back(layout_.multiplier(vertex));
    entries_.push(entries);
  }
}

void Contact::renew(const State& state) {
  active_.begin();
  const SkinNodes nodes = skin_nodes(skin_, state, skin_nodes_);
  tbb::parallel_for(0, static_cast<int>(elements_.size()), [&](int e) {
    Element& element = elements_[e];
    const TriangleNodes x = positions(state, e);
    const Eigen::Vector3d centre = x * garment_values(slave_.order, Eigen::Vector3d::Constant(1.0 / 3.0));
    const Site site = skin_.find(state, centre);
    element.points.clear();
    if (site.facet >= 0) element.points = cut_by_facets(skin_, nodes, x, slave_.order, site.facet);
    if (element.points.empty()) element.points = uncut_rule(fallback_parts_, slave_.order);
    for (ContactPoint& point : element.points) point.weight *= slave_.area_ratio(e, point.L);
  });
}

bool Contact::locate(const State& state) {
  tbb::parallel_for(0, static_cast<int>(elements_.size()), [&](int e) {
    const TriangleNodes x = positions(state, e);
    for (ContactPoint& point : elements_[e].points) point.site = skin_.follow(state, x * point.N, point.site);
  });
  if (!skin_.deformable()) return false;
  bool changed = false;
  for (Element& element : elements_)
    for (const auto& [L, weight, N, site] : element.points)
      if (site.facet >= 0 && std::find(element.facets.begin(), element.facets.end(), site.facet) == element.facets.end()) {
        couple(element);
        changed = true;
        break;
      }
  if (changed) rebuild_entries();
  return changed;
}

double Contact::step_bound(const State&, const Eigen::VectorXd& direction, double limit) const {
  // A point may not move farther than half an edge, so that it stays near the facets it was found on.
  double longest = 0.0;
  for (const auto& triangle : slave_.triangles)
    for (const int entry : triangle.entries) longest = std::max(longest, direction.segment<3>(entry).norm());
  return longest * limit > step_limit_ ? step_limit_ / longest : limit;
}

}  // namespace snug::solver
