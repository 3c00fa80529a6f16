#include "mesh/body/locations.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <queue>

#include "mesh/body/location_shares.hpp"
#include "mesh/body/section_centres.hpp"
#include "mesh/body/sections.hpp"
#include "mesh/surface/vectors.hpp"

namespace snug::mesh {

namespace {

using input::InputError;
using input::LocationSpec;

/// The skin's nodes with their neighbours along edges of the fine triangles (between all nodes of a facet).
class Skin {
 public:
  explicit Skin(const BodyMesh& mesh) : mesh_(mesh), next_(mesh.nodes.size()), normal_(mesh.nodes.size(), Eigen::Vector3d::Zero()) {
    for (const auto& t : triangulated_nodes(mesh)) {
      const Eigen::Vector3d twice = (mesh.nodes[t[1]] - mesh.nodes[t[0]]).cross(mesh.nodes[t[2]] - mesh.nodes[t[0]]);
      for (int n = 0; n < 3; ++n) {
        next_[t[n]].push_back(t[(n + 1) % 3]), next_[t[(n + 1) % 3]].push_back(t[n]);
        normal_[t[n]] += twice;
      }
    }
    find_border();
    for (std::size_t n = 0; n < next_.size(); ++n)
      if (!next_[n].empty()) nodes_.push_back(static_cast<int>(n)), normal_[n].normalize();
  }
  const std::vector<int>& nodes() const { return nodes_; }
  const Eigen::Vector3d& normal(int node) const { return normal_[node]; }

  int nearest(const Eigen::Vector3d& x) const {
    return *std::min_element(nodes_.begin(), nodes_.end(), [&](int a, int b) { return (mesh_.nodes[a] - x).squaredNorm() < (mesh_.nodes[b] - x).squaredNorm(); });
  }

  /// m, to where the skin ends; infinite where it is closed.
  double to_border(const Eigen::Vector3d& x) const {
    double least = std::numeric_limits<double>::infinity();
    for (const int node : border_) least = std::min(least, (mesh_.nodes[node] - x).norm());
    return least;
  }

  /// Marks the nodes that hang together with the one nearest to `middle` by a way along edges that is hardly longer than a distance (m).
  std::vector<char> reached(const Eigen::Vector3d& middle, double distance) const {
    constexpr double detour = 1.2;  // of ways along edges
    std::vector<double> way(next_.size(), std::numeric_limits<double>::max());
    using Item = std::pair<double, int>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    const int start = nearest(middle);
    way[start] = (mesh_.nodes[start] - middle).norm();
    queue.emplace(way[start], start);
    std::vector<char> found(next_.size(), 0);
    while (!queue.empty()) {
      const auto [length, at] = queue.top();
      queue.pop();
      if (length > way[at]) continue;
      found[at] = 1;
      for (const int to : next_[at]) {
        const double longer = length + (mesh_.nodes[to] - mesh_.nodes[at]).norm();
        if (longer < way[to] && longer <= detour * distance) way[to] = longer, queue.emplace(longer, to);
      }
    }
    return found;
  }

 private:
  /// Neighbours are entered once a triangle: along the border once.
  void find_border() {
    for (std::size_t n = 0; n < next_.size(); ++n)
      for (const int to : next_[n]) {
        const auto times = std::count(next_[n].begin(), next_[n].end(), to);
        if (times < 2) border_.push_back(static_cast<int>(n)), border_.push_back(to);
      }
  }

  const BodyMesh& mesh_;
  std::vector<std::vector<int>> next_;
  std::vector<Eigen::Vector3d> normal_;
  std::vector<int> nodes_, border_;
};

/// A patch of the skin: points that satisfy `holds`, with the skin's normal there, on what hangs together.
struct Patch {
  std::vector<char> on;  ///< by node; empty: all of the skin
  std::function<bool(const Eigen::Vector3d& x, const Eigen::Vector3d& normal)> holds;

  bool has(int node) const { return on.empty() || on[node]; }
};

/// None where a landmark of a standard body has been cut away, or cut in two.
std::optional<Patch> at_landmark(const LocationSpec& spec, const BodyMesh& mesh, const Skin& skin) {
  const Eigen::Vector3d given = vector(*spec.at), middle = mesh.nodes[skin.nearest(given)];
  const double off = (middle - given).norm();
  if (spec.where_there && (off > 0.5 * *spec.radius || skin.to_border(middle) < 0.5 * *spec.radius)) return std::nullopt;
  if (off > *spec.radius)
    throw InputError(spec.where, fmt::format("the landmark of \"{}\" is {:.0f} mm away from the skin", spec.name, 1e3 * off),
                     fmt::format("the nearest point of the skin is ({:.0f}, {:.0f}, {:.0f}) mm in the frame of the body", 1e3 * middle.x(), 1e3 * middle.y(), 1e3 * middle.z()));
  const double radius = std::hypot(*spec.radius, off);
  return Patch{skin.reached(given, radius), [given, radius](const Eigen::Vector3d& x, const Eigen::Vector3d&) { return (x - given).norm() <= radius; }};
}

bool in_polygon(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& p) {
  bool in = false;
  for (std::size_t n = 0, last = polygon.size() - 1; n < polygon.size(); last = n++) {
    const Eigen::Vector2d &a = polygon[n], &b = polygon[last];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) in = !in;
  }
  return in;
}

/// Inside the polygon as seen along its mean normal, on the side of the skin that its landmarks lie on.
Patch in_polygon(const LocationSpec& spec, const Skin& skin) {
  std::vector<Eigen::Vector3d> corner;
  for (const auto& x : spec.polygon) corner.push_back(vector(x));
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::Zero(), outward = Eigen::Vector3d::Zero();
  for (const auto& x : corner) middle += x / static_cast<double>(corner.size());
  double reach = 0.0;
  for (std::size_t n = 0; n < corner.size(); ++n) {
    normal += (corner[n] - middle).cross(corner[(n + 1) % corner.size()] - middle);
    outward += skin.normal(skin.nearest(corner[n]));
    reach = std::max(reach, (corner[n] - middle).norm());
  }
  if (normal.norm() == 0.0) throw InputError(spec.where, fmt::format("the landmarks of \"{}\" lie along a line", spec.name), "give them in order along the border of the patch");
  normal.normalize();
  if (normal.dot(outward) < 0.0) normal = -normal;
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  const auto flat = [=](const Eigen::Vector3d& x) { return Eigen::Vector2d(u.dot(x - middle), v.dot(x - middle)); };
  std::vector<Eigen::Vector2d> polygon;
  for (const auto& x : corner) polygon.push_back(flat(x));
  return {skin.reached(middle, 2.0 * reach), [=](const Eigen::Vector3d& x, const Eigen::Vector3d& outer) {
            return outer.dot(normal) > 0.0 && (x - middle).norm() <= 2.0 * reach && in_polygon(polygon, flat(x));
          }};
}

/// Sectors count round the middle of the skin's section at the node's height: of the whole body's largest one, or of the limb that is named.
Patch in_sector(const LocationSpec& spec, const BodyMesh& mesh) {
  const SectionCentres centres = spec.limb ? SectionCentres(mesh, vector(*spec.limb)) : SectionCentres(mesh);
  return {{}, [one = std::vector{spec}, centres](const Eigen::Vector3d& x, const Eigen::Vector3d&) {
            if (!centres.holds(x)) return false;
            const Eigen::Vector2d arm = x.head<2>() - centres.at(x.z());
            return location_of(one, std::atan2(arm.y(), arm.x()), x.z()) == 0;
          }};
}

/// The nodes of a patch that no earlier one holds become its own; whether it holds any.
bool mark(const Patch& patch, const Skin& skin, int location, BodyMesh& mesh) {
  bool any = false;
  for (const int node : skin.nodes()) {
    if (!patch.has(node) || !patch.holds(mesh.nodes[node], skin.normal(node))) continue;
    any = true;
    if (mesh.node_location[node] < 0) mesh.node_location[node] = location;
  }
  return any;
}

/// The first of the patches that holds a point of a triangle.
int holder(const std::vector<Patch>& patches, const BodyMesh& mesh, const Eigen::Vector3d& x, const std::array<int, 3>& t) {
  const Eigen::Vector3d normal = (mesh.nodes[t[1]] - mesh.nodes[t[0]]).cross(mesh.nodes[t[2]] - mesh.nodes[t[0]]);
  for (std::size_t p = 0; p < patches.size(); ++p)
    if ((patches[p].has(t[0]) || patches[p].has(t[1]) || patches[p].has(t[2])) && patches[p].holds(x, normal)) return static_cast<int>(p);
  return -1;
}

}  // namespace

void assign_locations(const std::vector<LocationSpec>& locations, BodyMesh& mesh) {
  mesh.locations.clear();
  mesh.location_shares.clear();
  mesh.node_location.assign(mesh.nodes.size(), -1);
  if (mesh.skin_facets.empty()) {
    for (const auto& location : locations) mesh.locations.push_back(location.name);
    return;
  }
  if (locations.empty()) return;
  const Skin skin(mesh);
  std::vector<Patch> patches;
  for (const LocationSpec& spec : locations) {
    const std::optional<Patch> patch = spec.at ? at_landmark(spec, mesh, skin) : !spec.polygon.empty() ? in_polygon(spec, skin) : in_sector(spec, mesh);
    const bool any = patch && mark(*patch, skin, static_cast<int>(patches.size()), mesh);
    if (!any && spec.where_there) continue;
    if (!any && !spec.is_sector())
      throw InputError(spec.where, fmt::format("the location \"{}\" holds no node of the skin", spec.name), "make it larger, or the cells smaller");
    patches.push_back(*patch);
    mesh.locations.push_back(spec.name);
  }
  mesh.location_shares = location_shares(mesh, patches.size(), [&](const Eigen::Vector3d& x, const std::array<int, 3>& t) { return holder(patches, mesh, x, t); });
}

}  // namespace snug::mesh
