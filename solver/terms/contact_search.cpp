// Where the points of contact stand, which facets they meet and what they couple.
#include "solver/terms/contact.hpp"

#include <algorithm>
#include <utility>

#include "solver/terms/parallel.hpp"
#include "solver/terms/stack_cut.hpp"

namespace snug::solver {

namespace {

// A facet counts as coupled to a triangle when a point is this near to its edge (a facet measures 2), so that the pattern
// of the matrix lasts.
constexpr double coupling_margin = 0.15;

}  // namespace

void Contact::couple(int facet, Element& element) const {
  if (facet < 0 || std::find(element.facets.begin(), element.facets.end(), facet) != element.facets.end()) return;
  element.facets.push_back(facet);
  if (!master().moves(facet)) return;
  for (const int node : master().nodes_of(facet))
    if (node >= 0 && std::find(element.master_nodes.begin(), element.master_nodes.end(), node) == element.master_nodes.end())
      element.master_nodes.push_back(node);
}

void Contact::couple(Element& element) const {
  element.facets.clear();
  element.master_nodes.clear();
  for (const ContactPoint& point : element.points) {
    const Site& site = point.site;
    if (site.facet < 0) continue;
    couple(site.facet, element);
    const auto& next = master().neighbours(site.facet);
    for (std::size_t edge = 0; edge < next.size(); ++edge)
      if (beyond(master().domain(site.facet), static_cast<int>(edge), site.xi) > -coupling_margin) couple(next[edge], element);
  }
}

void Contact::rebuild_entries(ContactHistory& history) const {
  auto all = std::make_shared<ElementEntries>();
  std::vector<int> entries;
  for (std::size_t e = 0; e < history.elements.size(); ++e) {
    const Element& element = history.elements[e];
    entries.clear();
    for (const int entry : interface_.slave.triangles[e].entries)
      for (int c = 0; c < 3; ++c) entries.push_back(entry + c);
    for (const int node : element.master_nodes)
      for (int c = 0; c < 3; ++c) entries.push_back(master().entry(node, c));
    for (const int vertex : interface_.slave.triangles[e].vertices) entries.push_back(interface_.pressures(vertex));
    all->push(entries);
  }
  history.entries = std::move(all);
}

const ElementEntries& Contact::entries(const State& state) const { return *history(state).entries; }

/// The state's own history, which begins with nothing coupled and nothing in contact.
ContactHistory& Contact::edit(State& state) const {
  ContactHistory& history = state.history.edit<ContactHistory>(name_);
  if (!history.elements.empty()) return history;
  history.active = ActiveSet(vertices());
  history.elements.resize(triangles());
  rebuild_entries(history);
  return history;
}

void Contact::renew(State& state) const {
  ContactHistory& history = edit(state);
  history.active.begin();
  history.reference.resize(vertices());
  for (int i = 0; i < vertices(); ++i) history.reference[i] = std::max(0.0, multiplier(state, i));
  const ContactSlave& slave = interface_.slave;
  const std::vector<MasterNodes> nodes = master_nodes(master(), state);
  history.trees = master().trees(state);
  tbb::parallel_for(0, triangles(), [&](int e) {
    Element& element = history.elements[e];
    const TriangleNodes x = positions(state, e);
    element.points = cut_by_stack(master(), nodes, state, x, slave.order, fallback_parts_, history.trees);
    for (ContactPoint& point : element.points) point.weight *= slave.area_ratio(e, point.L);
    if (const auto line = slave.lines.find(e); line != slave.lines.end())
      for (const auto& [L, weight] : line->second) element.points.push_back({L, weight, garment_values(slave.order, L), {}, 1});
  });
}

void Contact::locate(const State& state, ContactHistory& history) const {
  tbb::parallel_for(0, triangles(), [&](int e) {
    const TriangleNodes x = positions(state, e);
    for (ContactPoint& point : history.elements[e].points) point.site = master().follow(state, x * point.N, point.site, history.trees);
  });
  if (!master().deformable()) return;
  bool changed = false;
  for (Element& element : history.elements)
    for (const ContactPoint& point : element.points)
      if (const Site& site = point.site; site.facet >= 0 && std::find(element.facets.begin(), element.facets.end(), site.facet) == element.facets.end()) {
        couple(element);
        changed = true;
        break;
      }
  if (changed) rebuild_entries(history);
}

// Members that the others follow from are not stored; writing and reading share the lists.
template <class Archive, class S>
  requires std::is_same_v<std::remove_const_t<S>, ContactPoint>
static void each(Archive& with, S& point) {
  with(point.L[0]), with(point.L[1]), with(point.L[2]), with(point.weight);
  with(point.site.facet), with(point.site.xi[0]), with(point.site.xi[1]), with(point.line);
}

template <class Archive, class S>
  requires std::is_same_v<std::remove_const_t<S>, ContactHistory::Element>
static void each(Archive& with, S& element) {
  with(element.facets), with(element.points);
}

template <class Archive, class S>
  requires std::is_same_v<std::remove_const_t<S>, ActiveSet::Memory>
static void each(Archive& with, S& memory) {
  with(memory.flags), with(memory.changed), with(memory.fewest_wrong), with(memory.waited), with(memory.circled), with(memory.turns);
}

void ContactHistory::write(ByteWriter& writer) const {
  each(writer, active.memory());
  writer(reference), writer(elements);
}

void Contact::restore(State& state) const {
  const auto* stored = state.history.find<StoredHistory>(name_);
  if (!stored) return;
  auto history = std::make_shared<ContactHistory>(vertices());
  ByteReader reader(stored->bytes);
  ActiveSet::Memory memory;
  each(reader, memory), reader(history->reference), reader(history->elements), reader.finish();
  if (static_cast<int>(memory.flags.size()) != vertices() || static_cast<int>(history->elements.size()) != triangles())
    throw std::runtime_error("a stored state has another contact");
  history->active = ActiveSet(std::move(memory));
  for (Element& element : history->elements) {
    for (ContactPoint& point : element.points) point.N = garment_values(interface_.slave.order, point.L);
    for (const int facet : std::exchange(element.facets, {})) couple(facet, element);
  }
  rebuild_entries(*history);
  weigh(state, *history);
  state.history.put(name_, std::move(history));
}

double Contact::step_bound(const State&, const Eigen::VectorXd& direction, double limit) const {
  // A point may not move farther than half an edge, so that it stays near the facets it was found on.
  double longest = 0.0;
  for (const auto& triangle : interface_.slave.triangles)
    for (const int entry : triangle.entries) longest = std::max(longest, direction.segment<3>(entry).norm());
  return longest * limit > step_limit_ ? step_limit_ / longest : limit;
}

}  // namespace snug::solver
