#include "solver/scene/movement.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "cases/input/suggestion.hpp"
#include "solver/terms/master_surface.hpp"

namespace snug::solver {

namespace {

constexpr double turn_of_a_step = std::numbers::pi / 18.0, shift_of_a_step = 0.01;  // rad, m
constexpr double least_ratio = 0.1;  // of volume where the core is pressed together: below it its surface nearly folds

double degrees(double angle) { return angle * 180.0 / std::numbers::pi; }

int usual_steps(const mesh::Pose& from, const mesh::Pose& to) {
  double way = 1.0;
  for (std::size_t b = 0; b < to.size(); ++b)
    way = std::max({way, std::abs(to[b].turn - from[b].turn) / turn_of_a_step, (to[b].shift - from[b].shift).norm() / shift_of_a_step});
  return static_cast<int>(std::ceil(way - 1e-9));
}

std::vector<std::string> names_of(const mesh::Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const mesh::Bone& bone : skeleton.bones()) names.push_back(bone.name);
  return names;
}

mesh::Pose pose_of(const input::PostureSpec& posture, const mesh::Skeleton& skeleton) {
  mesh::Pose pose(skeleton.bones().size());
  for (const input::BoneMoveSpec& move : posture.move) {
    const int bone = skeleton.find(move.bone);
    if (bone < 0) throw input::InputError(move.where, fmt::format("the posture \"{}\" moves \"{}\", which is no bone of the case", posture.name, move.bone), input::did_you_mean(move.bone, names_of(skeleton)));
    if (!skeleton.bones()[bone].joint)
      throw input::InputError(move.where, fmt::format("the posture \"{}\" moves \"{}\", which has no joint", posture.name, move.bone),
                              fmt::format("give the [[bone]] \"{}\" a joint, e.g. joint = {{ point = [\"0 mm\", \"0 mm\", \"300 mm\"], towards = \"lower\" }}", move.bone));
    pose[bone] = {move.turn, Eigen::Vector3d(move.shift[0], move.shift[1], move.shift[2])};
  }
  return pose;
}

/// Nodes of the skin near a place have a share each; the facet that faces it weighs them.
class SkinShares {
 public:
  SkinShares(const mesh::BodyMesh& body, const Field& position, const State& state, const std::vector<double>& shares, std::size_t bones)
      : position_(position), state_(state), shares_(shares), bones_(bones), skin_(position, body, body.skin_facets) {
    for (const auto& facet : body.skin_facets)
      for (const int node : facet)
        if (node >= 0) nodes_.push_back(node);
    std::sort(nodes_.begin(), nodes_.end());
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  }

  std::vector<double> at(const Eigen::Vector3d& x) const {
    std::vector<double> found(bones_, 0.0);
    const auto add = [&](int node, double weight) {
      for (std::size_t b = 0; b < bones_; ++b) found[b] += weight * shares_[(position_(node) / 3) * bones_ + b];
    };
    if (const Site site = skin_.find(state_, x); site.facet >= 0) {
      const FacetShape shape = facet_shape(skin_.kind(), clamped(skin_.kind(), site.xi));
      for (int a = 0; a < 9; ++a)
        if (const int node = skin_.nodes_of(site.facet)[a]; node >= 0) add(node, shape.N[a]);
    } else {
      add(*std::min_element(nodes_.begin(), nodes_.end(), [&](int a, int b) { return distance(a, x) < distance(b, x); }), 1.0);
    }
    for (double& share : found) share = snapped(share);
    return found;
  }

 private:
  double distance(int node, const Eigen::Vector3d& x) const { return (state_.values.segment<3>(position_(node)) - x).squaredNorm(); }
  /// Quadratic functions leave [0, 1] between nodes, and sum to one to round-off.
  static double snapped(double share) { return share < 1e-12 ? 0.0 : share > 1.0 - 1e-12 ? 1.0 : share; }

  const Field& position_;
  const State& state_;
  const std::vector<double>& shares_;
  std::size_t bones_;
  MasterSurface skin_;
  std::vector<int> nodes_;
};

}  // namespace

Movement::Movement(const Model& model, const mesh::BodyMesh& body) {
  if (!model.deformable() || model.asked.postures.empty()) return;
  skeleton_ = mesh::Skeleton(model.asked.bones, body);
  poses_.emplace_back(skeleton_.bones().size());
  for (const input::PostureSpec& posture : model.asked.postures) {
    add(posture);
    const mesh::Skeleton::Squeeze worst = skeleton_.squeeze(poses_.back(), body);
    if (worst.ratio < least_ratio)
      throw input::InputError(posture.where, fmt::format("in the posture \"{}\" the core would fold at the joint of \"{}\": over {:.4g} mm it cannot turn so far", posture.name,
                                                         skeleton_.bones()[worst.bone].name, 1e3 * skeleton_.bones()[worst.bone].joint->blend),
                              fmt::format("let it turn less, or go over along more: joint.blend = \"{:.0f} mm\"", std::ceil(1e3 * worst.blend_needed)));
  }
  check_garments(model);
}

void Movement::add(const input::PostureSpec& posture) {
  const mesh::Pose pose = pose_of(posture, skeleton_);
  steps_.push_back(posture.steps.value_or(usual_steps(poses_.back(), pose)));
  names_.push_back(posture.name), poses_.push_back(pose);
}

int Movement::all_steps() const { return std::accumulate(steps_.begin(), steps_.end(), 0); }

void Movement::check_garments(const Model& model) const {
  for (std::size_t g = 0; g < model.garments.size(); ++g)
    if (model.contact_of(static_cast<int>(g)) && model.probed(static_cast<int>(g)))
      throw input::InputError(model.asked.postures.front().where, fmt::format("neither friction nor an edge holds the {} while the body moves", model.garments[g].spec.name),
                              "give contact.friction, or hold an edge: garment.held = [{ edge = \"upper\", held = \"axis\" }]");
}

mesh::Pose Movement::pose(double progress) const {
  const double at = std::clamp(progress, 0.0, static_cast<double>(postures()));
  const int from = std::min(static_cast<int>(at), postures() - 1);
  const double part = at - from;
  mesh::Pose pose = poses_[from];
  for (std::size_t b = 0; b < pose.size(); ++b) {
    const mesh::BoneMove& to = poses_[from + 1][b];
    pose[b] = {(1.0 - part) * pose[b].turn + part * to.turn, (1.0 - part) * pose[b].shift + part * to.shift};
  }
  return pose;
}

std::string Movement::text(double progress) const {
  const mesh::Pose now = pose(progress);
  std::vector<std::string> texts;
  for (std::size_t b = 0; b < now.size(); ++b) {
    const std::string& name = skeleton_.bones()[b].name;
    if (now[b].turn != 0.0) texts.push_back(fmt::format("{} {:.1f} deg", name, degrees(now[b].turn)));
    if (const Eigen::Vector3d& u = now[b].shift; !u.isZero(0.0)) texts.push_back(fmt::format("{} ({:.3g}, {:.3g}, {:.3g}) mm", name, 1e3 * u.x(), 1e3 * u.y(), 1e3 * u.z()));
  }
  return texts.empty() ? "as put on" : fmt::format("{}", fmt::join(texts, ", "));
}

Carrier::Carrier(Movement movement, const Meshes& meshes, const Layout& layout, const State& dressed)
    : movement_(std::move(movement)), positions_(layout.positions()), dressed_(dressed.values.head(layout.positions())) {
  const std::size_t bones = movement_.skeleton().bones().size();
  shares_.assign(static_cast<std::size_t>(positions_) / 3 * bones, 0.0);
  const auto set = [&](int first, const std::vector<double>& shares) { std::copy(shares.begin(), shares.end(), shares_.begin() + static_cast<std::ptrdiff_t>(first / 3 * bones)); };
  const Field& body = layout["body"];
  for (int node = 0; node < body.count; ++node) set(body(node), movement_.skeleton().shares_of(node));
  if (meshes.garments.empty()) return;
  const SkinShares skin(meshes.body, body, dressed, shares_, bones);
  for (const mesh::GarmentMesh& garment : meshes.garments) {
    const Field& position = layout[garment.name];
    for (int node = 0; node < position.count; ++node) set(position(node), skin.at(dressed.values.segment<3>(position(garment.merged[node]))));
  }
}

std::span<const double> Carrier::shares(int first) const {
  const std::size_t bones = movement_.skeleton().bones().size();
  return std::span(shares_).subspan(static_cast<std::size_t>(first) / 3 * bones, bones);
}

bool Carrier::moves(int first) const {
  const auto own = shares(first);
  return std::any_of(own.begin(), own.end(), [](double share) { return share > 0.0; });
}

Eigen::Vector3d Carrier::place(int first, double progress) const { return movement_.skeleton().placed(dressed_.segment<3>(first), shares(first), movement_.pose(progress)); }

void Carrier::carry(State& state, double progress) const {
  const mesh::Pose from = movement_.pose(state.posture), to = movement_.pose(progress);
  for (int first = 0; first < positions_; first += 3)
    if (moves(first)) {
      const Eigen::Vector3d rest = movement_.skeleton().unplaced(state.values.segment<3>(first), shares(first), from);
      state.values.segment<3>(first) = movement_.skeleton().placed(rest, shares(first), to);
    }
}

}  // namespace snug::solver
