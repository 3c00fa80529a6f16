#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "mesh/formats/apdl_deck.hpp"

namespace snug::mesh {

namespace {

constexpr int most_divisions = 200;
constexpr double most_elements = 2e6;

/// Lays nodes on keypoints, lines and areas; neighbours share those of their lines.
class AreaMesher {
 public:
  AreaMesher(ApdlDeck& deck, const std::string& file, input::Diagnostics& diagnostics)
      : deck_(deck), file_(file), diagnostics_(diagnostics), parts_(deck.divisions) {
    // Numbers of keypoints first, so that nodes keep them; everything between follows.
    for (const auto& [number, at] : deck.nodes) next_ = std::max(next_, number + 1);
    for (const auto& [number, at] : deck.keypoints) next_ = std::max(next_, number + 1);
    for (const ApdlElement& element : deck.elements) next_element_ = std::max(next_element_, element.number + 1);
  }

  void mesh(const ApdlArea& area) {
    for (const int corner : area.corners)
      if (!deck_.keypoints.contains(corner))
        return diagnostics_.error({file_, area.line, 1}, fmt::format("an area names keypoint {}, which is not there", corner),
                                  "give the keypoint: k, number, x, y, z");
    if (area.corners.size() == 3) return triangle(area);
    quadrilateral(area);
  }

  int node_at(int keypoint) {
    const auto [it, fresh] = at_keypoint_.emplace(keypoint, keypoint);
    if (fresh && deck_.nodes.contains(keypoint)) it->second = next_++;
    if (fresh) deck_.nodes[it->second] = deck_.keypoints.at(keypoint);
    return it->second;
  }

 private:
  /// Nodes from one corner of a line to the other, both included.
  std::vector<int> line(int from, int to) {
    if (from > to) {
      std::vector<int> nodes = line(to, from);
      std::reverse(nodes.begin(), nodes.end());
      return nodes;
    }
    std::vector<int>& nodes = lines_[{from, to}];
    if (!nodes.empty()) return nodes;
    const Eigen::Vector3d a = deck_.keypoints.at(from), b = deck_.keypoints.at(to);
    nodes.push_back(node_at(from));
    for (int i = 1; i < parts_; ++i) nodes.push_back(fresh_node(a + (b - a) * i / parts_));
    nodes.push_back(node_at(to));
    return nodes;
  }

  int fresh_node(const Eigen::Vector3d& at) {
    deck_.nodes[next_] = at;
    return next_++;
  }

  void add(const ApdlArea& area, std::vector<int> nodes) {
    deck_.elements.push_back({next_element_++, area.type, area.material, area.real, area.section, std::move(nodes), area.line});
  }

  /// Row i has the nodes at i/parts from the first corner, from the side to the second to the side to the third.
  void triangle(const ApdlArea& area) {
    const std::vector<int> left = line(area.corners[0], area.corners[1]), right = line(area.corners[0], area.corners[2]),
                           last = line(area.corners[1], area.corners[2]);
    std::vector<int> above = {left[0]};
    for (int i = 1; i <= parts_; ++i) {
      std::vector<int> row = {left[i]};
      for (int j = 1; j < i && i < parts_; ++j)
        row.push_back(fresh_node(deck_.nodes.at(left[i]) + (deck_.nodes.at(right[i]) - deck_.nodes.at(left[i])) * j / i));
      row.push_back(right[i]);
      if (i == parts_) row = last;
      for (int j = 0; j < i; ++j) {
        add(area, {above[j], row[j], row[j + 1]});
        if (j + 1 < i) add(area, {above[j], row[j + 1], above[j + 1]});
      }
      above = std::move(row);
    }
  }

  void quadrilateral(const ApdlArea& area) {
    const std::vector<int> low = line(area.corners[0], area.corners[1]), right = line(area.corners[1], area.corners[2]),
                           high = line(area.corners[3], area.corners[2]), left = line(area.corners[0], area.corners[3]);
    const auto at = [&](int node) { return deck_.nodes.at(node); };
    std::vector<int> below = low;
    for (int j = 1; j <= parts_; ++j) {
      std::vector<int> row = {left[j]};
      const double v = static_cast<double>(j) / parts_;
      for (int i = 1; i < parts_ && j < parts_; ++i) {  // Coons' patch of straight sides
        const double u = static_cast<double>(i) / parts_;
        row.push_back(fresh_node((1 - v) * at(low[i]) + v * at(high[i]) + (1 - u) * at(left[j]) + u * at(right[j]) -
                                 (1 - u) * ((1 - v) * at(low[0]) + v * at(high[0])) -
                                 u * ((1 - v) * at(low[parts_]) + v * at(high[parts_]))));
      }
      row.push_back(right[j]);
      if (j == parts_) row = high;
      for (int i = 0; i < parts_; ++i) add(area, {below[i], below[i + 1], row[i + 1], row[i]});
      below = std::move(row);
    }
  }

  ApdlDeck& deck_;
  const std::string& file_;
  input::Diagnostics& diagnostics_;
  int parts_, next_ = 1, next_element_ = 1;
  std::map<int, int> at_keypoint_;
  std::map<std::pair<int, int>, std::vector<int>> lines_;
};

}  // namespace

void mesh_areas(ApdlDeck& deck, const std::string& file, input::Diagnostics& diagnostics) {
  const bool loaded = !deck.keypoint_forces.empty() || !deck.keypoint_supports.empty();
  if (deck.areas.empty() && loaded)
    diagnostics.error({file, 0, 0}, "keypoints are loaded or held, but there are no areas to mesh",
                      "give the areas (a, k1, k2, k3), or load nodes with f and d");
  if (deck.areas.empty() || diagnostics.any()) return;
  if (deck.divisions < 1 || deck.divisions > most_divisions)
    return diagnostics.error({file, deck.areas.front().line, 1}, "it is not said how fine the areas are meshed",
                             fmt::format("write esize,,N: N divisions of each line, 1 to {}", most_divisions));
  if (static_cast<double>(deck.areas.size()) * deck.divisions * deck.divisions > most_elements)
    return diagnostics.error({file, deck.areas.front().line, 1}, "the areas would have more than 2 million elements",
                             "divide the lines less finely with esize");
  AreaMesher mesher(deck, file, diagnostics);
  for (const ApdlArea& area : deck.areas)
    if (diagnostics.errors().size() < 20) mesher.mesh(area);
  const auto node_of = [&](int keypoint) {
    if (deck.keypoints.contains(keypoint)) return mesher.node_at(keypoint);
    diagnostics.error({file, 0, 0}, fmt::format("keypoint {} is loaded or held but not there", keypoint), "give it: k, number, x, y, z");
    return 0;
  };
  for (ModelForce force : deck.keypoint_forces) force.node = node_of(force.node), deck.forces.push_back(force);
  for (ModelSupport support : deck.keypoint_supports) support.node = node_of(support.node), deck.supports.push_back(support);
}

}  // namespace snug::mesh
