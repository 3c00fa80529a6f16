#include "mesh/body/joints.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/input/suggestion.hpp"
#include "mesh/placement/dress_form.hpp"
#include "mesh/surface/vectors.hpp"
#include "solver/fem/union_find.hpp"

namespace snug::mesh {

namespace {

constexpr double inside = 0.25;     // winding number: the ends of the core are open
constexpr double across = 0.9;      // cosine between axis and limb beyond which a turn twists more than it bends
constexpr double of_the_way = 0.9;  // from the joint to the nearer end of the core, that half of the usual blend takes at most

std::string text(const Eigen::Vector3d& x) { return fmt::format("({:.4g}, {:.4g}, {:.4g}) mm", 1e3 * x.x(), 1e3 * x.y(), 1e3 * x.z()); }

/// The body's outside, cuts and skin, as triangles between corners of facets.
TriangleSurface outside(const BodyMesh& body) {
  TriangleSurface surface{.vertices = body.nodes, .triangles = {}};
  std::vector<char> core(body.nodes.size(), 0);
  for (const int node : body.bone_nodes) core[node] = 1;
  const FacetKind kind = facet_kind(body.kind);
  const int nodes = node_count(kind);
  for (const FacetNodeNumbers& f : boundary_facets(body, std::vector<char>(body.nodes.size(), 1))) {
    if (std::all_of(f.begin(), f.begin() + nodes, [&](int n) { return core[n]; })) continue;
    if (kind == FacetKind::tri6) surface.triangles.push_back({f[0], f[1], f[2]});
    else {
      const auto c = kind == FacetKind::quad9 ? std::array{f[0], f[2], f[8], f[6]} : std::array{f[0], f[1], f[3], f[2]};
      surface.triangles.push_back({c[0], c[1], c[2]}), surface.triangles.push_back({c[0], c[2], c[3]});
    }
  }
  return surface;
}

int nearest_of(const std::vector<int>& nodes, const Eigen::Vector3d& x, const BodyMesh& body) {
  return *std::min_element(nodes.begin(), nodes.end(), [&](int a, int b) { return (body.nodes[a] - x).squaredNorm() < (body.nodes[b] - x).squaredNorm(); });
}

class Finder {
 public:
  Finder(const input::JointSpec& spec, const std::string& name, const BodyMesh& body) : spec_(spec), name_(name), body_(body), point_(vector(spec.point)) {}

  FoundJoint operator()() {
    if (spec_.towards == "everything") return whole_body();
    FoundJoint found;
    found.joint.point = point_;
    found.joint.direction = direction();
    check_point();
    found.joint.axis = axis(found.joint.direction);
    found.joint.blend = spec_.blend ? *spec_.blend : usual_blend(found.joint);
    const std::vector<char> beyond = hanging_together(found.joint, 0.5 * found.joint.blend);
    found.share.resize(body_.nodes.size());
    for (std::size_t n = 0; n < body_.nodes.size(); ++n) found.share[n] = beyond[n] ? found.joint.share(found.joint.distance(body_.nodes[n])) : 0.0;
    check_sides(found);
    return found;
  }

 private:
  [[noreturn]] void refuse(const std::string& found, const std::string& remedy) const { throw input::InputError(spec_.where, fmt::format("the joint of \"{}\" {}", name_, found), remedy); }

  FoundJoint whole_body() const {
    if (!spec_.axis) refuse("is of everything and has no axis", "say what the body turns about: axis = [1, 0, 0]");
    FoundJoint found;
    found.joint.point = point_, found.joint.axis = unit(*spec_.axis, "axis");
    found.share.assign(body_.nodes.size(), 1.0);
    return found;
  }

  Eigen::Vector3d unit(const std::array<double, 3>& given, const char* key) const {
    const Eigen::Vector3d v = vector(given);
    if (v.norm() == 0.0) refuse(fmt::format("has {} of no length", key == std::string("axis") ? "an axis" : "a direction"), fmt::format("write {} = [1, 0, 0] or another direction", key));
    return v.normalized();
  }

  const Surface* cut() const {
    if (spec_.towards.empty()) return nullptr;
    const Surface* surface = body_.surface(spec_.towards);
    if (surface && !surface->nodes.empty()) return surface;
    std::vector<std::string> names = {"everything"};
    for (const Surface& one : body_.surfaces)
      if (one.name != "skin" && one.name != "bone") names.push_back(one.name);
    refuse(fmt::format("lies towards \"{}\", which is no cut of the body", spec_.towards), input::did_you_mean(spec_.towards, names));
  }

  Eigen::Vector3d direction() const {
    const Surface* end = cut();
    if (spec_.direction) return unit(*spec_.direction, "direction");
    if (!end) refuse("does not say on which side the bone lies", "add towards = \"lower\" (the name of a cut), or direction = [x, y, z] along the limb into the bone");
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int node : end->nodes) middle += body_.nodes[node] / static_cast<double>(end->nodes.size());
    if ((middle - point_).norm() < 1e-9) refuse("lies in the middle of the cut that it lies towards", "move point into the limb");
    return (middle - point_).normalized();
  }

  void check_point() const {
    if (winding_number(outside(body_), point_) > inside) return;
    Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Eigen::Vector3d& x : body_.nodes) low = low.cwiseMin(x), high = high.cwiseMax(x);
    refuse(fmt::format("at {} lies outside the body", text(point_)), fmt::format("give a point inside the limb, in the frame of the body, which reaches from {} to {}; is it in the right unit?", text(low), text(high)));
  }

  Eigen::Vector3d axis(const Eigen::Vector3d& along) const {
    if (spec_.axis) return unit(*spec_.axis, "axis");
    Eigen::Vector3d side = Eigen::Vector3d::UnitX();
    if (std::abs(side.dot(along)) > across) side = Eigen::Vector3d::UnitY();  // an arm held out
    return (side - side.dot(along) * along).normalized();
  }

  /// Nodes beyond the plane `before` (m) before the joint that hang together with the cut, or with what lies nearest to the point.
  std::vector<char> hanging_together(const Joint& joint, double before) const {
    std::vector<char> region(body_.nodes.size(), 0);
    for (std::size_t n = 0; n < body_.nodes.size(); ++n) region[n] = joint.distance(body_.nodes[n]) > -before;
    fem::UnionFind parts(body_.nodes.size());
    for (const CellNodes& cell : body_.cells) {
      int first = -1;
      for (int a = 0; a < node_count(body_.kind); ++a) {
        if (!region[cell[a]]) continue;
        if (first >= 0) parts.merge(first, cell[a]);
        first = cell[a];
      }
    }
    std::vector<int> candidates;
    for (std::size_t n = 0; n < region.size(); ++n)
      if (region[n]) candidates.push_back(static_cast<int>(n));
    if (candidates.empty()) refuse("has nothing of the body beyond it", "move point into the limb, or turn direction round");
    const Surface* end = cut();
    if (end && !region[nearest_of(end->nodes, point_, body_)]) refuse(fmt::format("lies towards \"{}\", and its direction points away from that cut", spec_.towards), "turn direction round, or leave it out");
    const int part = parts.find(end ? nearest_of(end->nodes, point_, body_) : nearest_of(candidates, point_, body_));
    std::vector<char> beyond(region.size(), 0);
    for (const int n : candidates) beyond[n] = parts.find(n) == part;
    return beyond;
  }

  /// Twice the width of the core, where the core is as long on both sides.
  double usual_blend(const Joint& joint) const {
    const int nearest = nearest_of(body_.bone_nodes, point_, body_);
    const double reach = (body_.nodes[nearest] - point_).norm();
    const std::vector<char> beyond = hanging_together(joint, reach);
    double radius = 0.0, last = 0.0, first = 0.0;
    for (const int node : body_.bone_nodes) {
      const double s = joint.distance(body_.nodes[node]);
      first = std::min(first, s);
      if (!beyond[node]) continue;
      last = std::max(last, s);
      const Eigen::Vector3d arm = body_.nodes[node] - point_ - s * joint.direction;
      if (std::abs(s) <= reach) radius = std::max(radius, arm.norm());
    }
    const double room = of_the_way * 2.0 * std::min(last, -first);
    if (!(room > 0.0)) refuse("has the whole core on one of its sides", "move point to where the limb bends");
    return std::min(radius > 0.0 ? 4.0 * radius : room, room);
  }

  /// The ends of the core stay rigid.
  void check_sides(const FoundJoint& found) const {
    bool whole = false, none = false;
    for (const int node : body_.bone_nodes) whole = whole || found.share[node] == 1.0, none = none || found.share[node] == 0.0;
    if (whole && none) return;
    refuse(fmt::format("goes over from one bone to the other along {:.4g} mm, which reaches beyond the {} end of the core", 1e3 * found.joint.blend, whole ? "near" : "far"),
           "give a shorter blend, move point to where the limb bends, or take more of the limb into the body");
  }

  const input::JointSpec& spec_;
  const std::string& name_;
  const BodyMesh& body_;
  const Eigen::Vector3d point_;
};

}  // namespace

FoundJoint find_joint(const input::JointSpec& spec, const std::string& name, const BodyMesh& body) { return Finder(spec, name, body)(); }

}  // namespace snug::mesh
