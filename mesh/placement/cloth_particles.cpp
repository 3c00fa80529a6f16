#include "mesh/placement/cloth_particles.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A triangle's corner opposite an edge in the frame of that edge: along it from the smaller number, and off it.
Vector2d opposite(const std::array<Vector2d, 3>& flat, int n, bool from_end) {
  const Vector2d &a = flat[n], &b = flat[(n + 1) % 3], &c = flat[(n + 2) % 3];
  const Vector2d along = (b - a).normalized();
  const double t = along.dot(c - a), off = along.x() * (c - a).y() - along.y() * (c - a).x();
  return {from_end ? (b - a).norm() - t : t, std::abs(off)};
}

}  // namespace

ClothParticles::ClothParticles(std::vector<Vector3d> places, ClothTriangles triangles)
    : places_(std::move(places)), before_(places_), triangles_(std::move(triangles)) {
  find_links();
}

/// Edges, as long as in the flat pieces (the mean of both sides of a seam), and the distances across them between
/// the corners of their two triangles when these lie flat.
void ClothParticles::find_links() {
  std::map<std::pair<int, int>, std::vector<std::pair<int, int>>> sides;  // ends -> triangle and its side
  for (std::size_t t = 0; t < triangles_.nodes.size(); ++t)
    for (int n = 0; n < 3; ++n)
      sides[std::minmax(triangles_.nodes[t][n], triangles_.nodes[t][(n + 1) % 3])].push_back({static_cast<int>(t), n});
  for (const auto& [ends, uses] : sides) {
    double length = 0.0;
    for (const auto& [t, n] : uses) length += (triangles_.flat[t][n] - triangles_.flat[t][(n + 1) % 3]).norm();
    edges_.push_back({ends.first, ends.second, length / static_cast<double>(uses.size()), uses.size() == 1});
    if (uses.size() != 2) continue;
    std::array<int, 2> corner;
    std::array<Vector2d, 2> off;
    for (int k = 0; k < 2; ++k) {
      const auto [t, n] = uses[k];
      corner[k] = triangles_.nodes[t][(n + 2) % 3];
      off[k] = opposite(triangles_.flat[t], n, triangles_.nodes[t][n] != ends.first);
    }
    across_.push_back({corner[0], corner[1], std::hypot(off[0].x() - off[1].x(), off[0].y() + off[1].y())});
  }
  std::shuffle(edges_.begin(), edges_.end(), std::minstd_rand(12345));  // sweeps in order would favour one direction
}

void ClothParticles::smooth(const std::vector<int>& particles, double clearance, const DistanceGrid& body) {
  struct Sum {
    Vector3d places = Vector3d::Zero();
    int count = 0;
    bool open = false;
  };
  std::vector<Sum> sums(places_.size());
  for (const Link& edge : edges_)
    if (edge.open) sums[edge.a].open = sums[edge.b].open = true;
  for (const Link& edge : edges_)
    for (const auto& [to, from] : {std::pair(edge.a, edge.b), std::pair(edge.b, edge.a)})
      if (edge.open || !sums[to].open) sums[to].places += places_[from], ++sums[to].count;
  for (const int n : particles) {
    if (sums[n].count > 0) places_[n] = sums[n].places / sums[n].count;
    const auto [distance, away] = body.at(places_[n]);
    if (distance < clearance) places_[n] += (clearance - distance) * away;
  }
}

namespace {

/// The deformation gradient with its smaller stretch raised to a bound.
Eigen::Matrix<double, 3, 2> widened(const Eigen::Matrix<double, 3, 2>& gradient, double least) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> metric(gradient.transpose() * gradient);  // ascending
  const double smaller = std::sqrt(std::max(0.0, metric.eigenvalues()[0]));
  if (smaller >= least) return gradient;
  const Vector2d across = metric.eigenvectors().col(0), along = metric.eigenvectors().col(1);
  const Vector3d normal = gradient.col(0).cross(gradient.col(1));
  const Vector3d direction =
      smaller > 1e-9 ? Vector3d(gradient * across / smaller) : normal.cross(gradient * along).normalized();
  return gradient + (least - smaller) * direction * across.transpose();
}

}  // namespace

void ClothParticles::widen(const std::vector<int>& triangles, double least, double clearance,
                           const DistanceGrid& body) {
  for (const int t : triangles) {
    const auto& n = triangles_.nodes[t];
    const auto& flat = triangles_.flat[t];
    Eigen::Matrix2d reference;
    reference << flat[1] - flat[0], flat[2] - flat[0];
    Eigen::Matrix<double, 3, 2> placed;
    placed << places_[n[1]] - places_[n[0]], places_[n[2]] - places_[n[0]];
    const Eigen::Matrix<double, 3, 2> gradient = placed * reference.inverse();
    const Eigen::Matrix<double, 3, 2> change = widened(gradient, least) - gradient;
    const Vector2d middle = (flat[0] + flat[1] + flat[2]) / 3.0;
    for (int k = 0; k < 3; ++k) {
      Vector3d& place = places_[n[k]];
      place += 0.5 * change * (flat[k] - middle);
      const auto [distance, away] = body.at(place);
      if (distance < clearance) place += (clearance - distance) * away;
    }
  }
}

void ClothParticles::pull_edges(const ParticleStep& step) {
  for (const Link& edge : edges_) {
    const Vector3d way = places_[edge.b] - places_[edge.a];
    const double length = way.norm();
    if (length < 1e-9) continue;
    const double share = length > edge.length ? step.stiffness : step.stiffness * step.compression;
    const Vector3d half = (0.5 * share * (length - edge.length) / length) * way;
    places_[edge.a] += half, places_[edge.b] -= half;
  }
}

/// Opposite corners of two neighbours are pushed apart while they are nearer than in the flat piece.
void ClothParticles::unfold(const ParticleStep& step) {
  for (const Link& link : across_) {
    const Vector3d way = places_[link.b] - places_[link.a];
    const double length = way.norm();
    if (length < 1e-9 || length > link.length) continue;
    const Vector3d half = (0.5 * step.bending * step.stiffness * (length - link.length) / length) * way;
    places_[link.a] += half, places_[link.b] -= half;
  }
}

void ClothParticles::stitch(const std::vector<Stitching>& stitching) {
  for (const Stitching& one : stitching) {
    const Vector3d way = places_[one.b] - places_[one.a];
    const double length = way.norm();
    if (!(length > one.gap)) continue;
    const Vector3d half = (0.5 * (length - one.gap) / length) * way;
    places_[one.a] += half, places_[one.b] -= half;
  }
}

void ClothParticles::keep_off(const ParticleStep& step, const DistanceGrid& body, bool middles) {
  constexpr double farthest = 0.010;  // m, of one push
  for (std::size_t n = 0; n < places_.size(); ++n) {
    const auto [distance, away] = body.at(places_[n]);
    if (distance >= step.clearance) continue;
    places_[n] += std::min(step.clearance - distance, farthest) * away;
    const Vector3d moved = places_[n] - before_[n];
    places_[n] -= step.friction * (moved - away.dot(moved) * away);
  }
  if (!middles) return;
  for (const auto& t : triangles_.nodes) {
    const Vector3d middle = (places_[t[0]] + places_[t[1]] + places_[t[2]]) / 3.0;
    const auto [distance, away] = body.at(middle);
    if (distance >= step.clearance) continue;
    for (const int n : t) places_[n] += std::min(step.clearance - distance, farthest) * away;
  }
}

void ClothParticles::keep_apart() {
  constexpr double off = 0.001;  // m, of the middle
  for (std::size_t n = 0; n < gap_.side.size(); ++n) {
    if (gap_.side[n] == 0 || places_[n].z() > gap_.top || places_[n].z() < 0.0) continue;
    const auto row = std::min(static_cast<std::size_t>(places_[n].z() / gap_.spacing), gap_.middle.size() - 1);
    const double out = gap_.side[n] * (places_[n].x() - gap_.middle[row]);
    if (out < off) places_[n].x() += gap_.side[n] * (off - out);
  }
}

void ClothParticles::advance(const ParticleStep& step, const std::vector<Stitching>& stitching,
                             const DistanceGrid& body) {
  constexpr double carried = 0.9;
  for (std::size_t n = 0; n < places_.size(); ++n) {
    Vector3d on = carried * (places_[n] - before_[n]);
    if (const double length = on.norm(); length > step.farthest) on *= step.farthest / length;
    before_[n] = places_[n];
    places_[n] += on;
  }
  for (int sweep = 0; sweep < step.sweeps; ++sweep) {
    const bool last = sweep + 1 == step.sweeps;
    pull_edges(step);
    if (sweep == 0) unfold(step);
    stitch(stitching);
    if (sweep % 2 == 1 || last) keep_off(step, body, last);
    if (last) keep_apart();
  }
}

}  // namespace snug::mesh
