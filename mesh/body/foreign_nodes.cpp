#include "mesh/body/foreign_nodes.hpp"

#include <fmt/format.h>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <optional>

namespace snug::mesh {

ForeignNodes::ForeignNodes(const Model& model, const input::BodySpec& spec, BodyMesh& mesh)
    : model_(model), spec_(spec), mesh_(mesh) {
  for (const ModelNode& node : model.nodes) place_[node.number] = spec.unit * node.at;
}

int ForeignNodes::node_of(int number) {
  const auto [it, fresh] = ours_.emplace(number, static_cast<int>(mesh_.nodes.size()));
  if (fresh) {
    const auto place = place_.find(number);
    if (place == place_.end())
      throw input::InputError({spec_.mesh.string(), 0, 0}, fmt::format("an element names node {}, which the file does not have", number),
                              "give the node its place");
    mesh_.nodes.push_back(place->second);
    mesh_.node_numbers.push_back(number);
    parents_.emplace_back();
  }
  return it->second;
}

int ForeignNodes::between(std::vector<int> around, const Eigen::Vector3d& at, std::vector<int> parents) {
  std::sort(around.begin(), around.end());
  const auto [it, fresh] = between_.emplace(around, static_cast<int>(mesh_.nodes.size()));
  if (fresh) {
    mesh_.nodes.push_back(at);
    mesh_.node_numbers.push_back(0);  // numbered when all are known
    parents_.push_back(parents.empty() ? around : std::move(parents));
  }
  return it->second;
}

int ForeignNodes::find(std::vector<int> around) const {
  std::sort(around.begin(), around.end());
  const auto found = between_.find(around);
  return found == between_.end() ? -1 : found->second;
}

void ForeignNodes::set_middle(int a, int b, int number) {
  std::vector<int> ends = {std::min(a, b), std::max(a, b)};
  between_.emplace(std::move(ends), node_of(number));
}

void ForeignNodes::number_the_rest() {
  int next = model_.nodes.empty() ? 1 : model_.nodes.back().number + 1;
  for (int& number : mesh_.node_numbers)
    if (number == 0) number = next++;
}

std::vector<char> ForeignNodes::marked(const std::vector<int>& numbers) const {
  std::vector<char> mark(mesh_.nodes.size(), 0);
  for (const int number : numbers)
    if (has(number)) mark[at(number)] = 1;
  for (std::size_t n = 0; n < mark.size(); ++n)  // parents come before
    if (!parents_[n].empty())
      mark[n] = std::all_of(parents_[n].begin(), parents_[n].end(), [&](int p) { return mark[p] != 0; });
  return mark;
}

std::map<int, double> ForeignNodes::held(int component) const {
  std::map<int, double> held;
  for (const ModelSupport& support : model_.supports)
    if (support.component == component && has(support.node)) held[at(support.node)] = support.value;
  for (std::size_t n = 0; n < parents_.size(); ++n) {
    double mean = 0.0;
    bool all = !parents_[n].empty();
    for (const int parent : parents_[n]) {
      const auto it = held.find(parent);
      all = all && it != held.end();
      if (!all) break;
      mean += it->second / static_cast<double>(parents_[n].size());
    }
    if (all) held[static_cast<int>(n)] = mean;
  }
  return held;
}

namespace {

/// What a node's lines say of a direction that they span; nothing of others.
std::optional<double> along(const std::vector<HeldAlong>& lines, const Eigen::Vector3d& direction) {
  Eigen::Matrix3Xd span(3, lines.size());
  Eigen::RowVectorXd displacements(lines.size());
  for (std::size_t l = 0; l < lines.size(); ++l) span.col(l) = lines[l].direction, displacements[l] = lines[l].displacement;
  if (lines.empty()) return std::nullopt;
  const Eigen::VectorXd weights = span.completeOrthogonalDecomposition().solve(direction);
  if ((span * weights - direction).norm() > 1e-9) return std::nullopt;
  return displacements * weights;
}

/// The direction itself where the lines span it, else the line that points most like it; nothing where none is within 60 degrees.
std::optional<HeldAlong> like(const std::vector<HeldAlong>& lines, const Eigen::Vector3d& direction) {
  if (const auto displacement = along(lines, direction)) return HeldAlong{-1, direction, *displacement};
  std::optional<HeldAlong> best;
  double nearest = 0.5;
  for (const HeldAlong& line : lines)
    if (const double cosine = line.direction.dot(direction); std::abs(cosine) > nearest) {
      nearest = std::abs(cosine);
      const double sign = cosine > 0.0 ? 1.0 : -1.0;
      best = HeldAlong{-1, sign * line.direction, sign * line.displacement};
    }
  return best;
}

}  // namespace

/// A node that was added is held along the mean of the lines along which all of its parents are; the parent with the fewest says which these are.
void ForeignNodes::add_oblique_supports() {
  if (model_.oblique_supports.empty()) return;
  std::map<int, std::vector<HeldAlong>> lines;
  for (const HeldComponent& held : mesh_.held) lines[held.node].push_back({held.node, Eigen::Vector3d::Unit(held.component), held.displacement});
  const auto add = [&](const HeldAlong& line) { lines[line.node].push_back(line), mesh_.held_along.push_back(line); };
  for (const ModelObliqueSupport& support : model_.oblique_supports)
    if (has(support.node)) add({at(support.node), support.direction, spec_.unit * support.value});
  for (std::size_t n = 0; n < parents_.size(); ++n) {
    if (parents_[n].empty()) continue;
    const int fewest = *std::min_element(parents_[n].begin(), parents_[n].end(), [&](int a, int b) { return lines[a].size() < lines[b].size(); });
    for (const HeldAlong& first : std::vector<HeldAlong>(lines[fewest])) {
      HeldAlong mean{static_cast<int>(n), Eigen::Vector3d::Zero(), 0.0};
      bool all = true;
      for (const int parent : parents_[n]) {
        const auto found = like(lines[parent], first.direction);
        all = all && found;
        if (!all) break;
        mean.direction += found->direction, mean.displacement += found->displacement / static_cast<double>(parents_[n].size());
      }
      mean.direction.normalize();
      if (all && !along(lines[static_cast<int>(n)], mean.direction)) add(mean);
    }
  }
}

void ForeignNodes::add_supports() {
  for (int c = 0; c < 3; ++c)
    for (const auto& [node, value] : held(c)) mesh_.held.push_back({node, c, spec_.unit * value});
  add_oblique_supports();
  if (mesh_.shell.empty()) return;
  for (int c = 0; c < 3; ++c)
    for (const auto& [node, value] : held(3 + c)) {
      if (value != 0.0)
        throw input::InputError({spec_.mesh.string(), 0, 0},
                                fmt::format("a rotation of {} is prescribed at node {}", value, mesh_.node_numbers[node]),
                                "rotations of a shell are held at 0; move displacements");
      mesh_.held_rotations.push_back({node, c});
    }
}

void ForeignNodes::add_forces() {
  std::map<int, Eigen::Vector3d> sum;
  for (const ModelForce& force : model_.forces) {
    if (!has(force.node))
      throw input::InputError({spec_.mesh.string(), 0, 0},
                              fmt::format("a force acts on node {}, which belongs to no element", force.node),
                              "load a node of the body");
    sum.emplace(at(force.node), Eigen::Vector3d::Zero()).first->second[force.component] += spec_.force_unit * force.value;
  }
  for (const auto& [node, force] : sum) mesh_.forces.push_back({node, force});
}

}  // namespace snug::mesh
