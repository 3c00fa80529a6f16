#include "mesh/particles/particle_cloth.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace snug::mesh {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Beyond that distance (m) from its reach the body is not seen: no step goes so far.
constexpr double sight = 0.03;
/// Friction's stiffness over that of pressing.
constexpr double holding = 0.5;

/// A third of its triangles' `value` per area for every particle.
std::vector<double> lumped(const ClothSheet& sheet, std::size_t particles, auto value) {
  std::vector<double> sums(particles, 0.0);
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t)
    for (const int n : sheet.triangles[t].particles) sums.at(n) += sheet.triangles[t].area() / 3.0 * value(t);
  return sums;
}

std::vector<double> masses(const ClothSheet& sheet, std::size_t particles) {
  return lumped(sheet, particles, [&](std::size_t t) {
    return sheet.laws.at(sheet.triangle_laws.empty() ? 0 : sheet.triangle_laws.at(t)).density;
  });
}

/// Flatter sums would turn round in a line search: a triangle must not be degenerate on the flat cloth.
void check(const ClothSheet& sheet) {
  for (const FlatTriangle& triangle : sheet.triangles)
    if (!(triangle.area() > 0.0)) throw std::invalid_argument("a triangle of cloth is turned over");
}

/// Its energy is quadratic in the places.
Eigen::SparseMatrix<double> bending_of(const ClothSheet& sheet, std::size_t particles) {
  const auto neighbours = neighbours_of(sheet.triangles);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    const ClothLaws& laws = sheet.laws[sheet.triangle_laws.empty() ? 0 : sheet.triangle_laws[t]];
    if (!(laws.bending_warp > 0.0) || !(laws.bending_weft > 0.0)) continue;
    for (const BendingPart& part :
         bending_parts(sheet.triangles[t], neighbours[t], laws.bending_warp, laws.bending_weft))
      for (const Weight& one : part.weights)
        for (const Weight& other : part.weights)
          entries.emplace_back(one.particle, other.particle, part.stiffness * one.weight * other.weight);
  }
  Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(particles), static_cast<Eigen::Index>(particles));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

ParticleCloth::ParticleCloth(ClothSheet sheet, Places places, std::vector<HeldComponents> held,
                             MinimumSearch search)
    : ImplicitParticles(places, std::move(held), masses(sheet, places.size()),
                        lumped(sheet, places.size(), [&](std::size_t) { return sheet.drag; }), sheet.gravity, search),
      sheet_(std::move(sheet)) {
  check(sheet_);
  area_ = lumped(sheet_, places.size(), [](std::size_t) { return 1.0; });
  for (const FlatTriangle& triangle : sheet_.triangles) {
    const auto slopes = triangle.gradients();
    Directions& along = directions_.emplace_back();
    along.area = triangle.area();
    for (int a = 0; a < 3; ++a) along.warp[a] = {a, slopes[a].x()}, along.weft[a] = {a, slopes[a].y()};
  }
  bending_ = bending_of(sheet_, places.size());
  find_planes();
}

/// Of every triangle with its own three corners first: nine entries of a pair of them are one then.
void ParticleCloth::add_strained(bool stretch, bool shear, const Places& x, ForceSum& into) const {
  ForceSum own(3, into.second);
  Places corners(3);
  for (std::size_t t = 0; t < directions_.size(); ++t) {
    const Directions& along = directions_[t];
    const std::array<int, 3>& particles = sheet_.triangles[t].particles;
    for (int a = 0; a < 3; ++a) corners[a] = x[particles[a]], own.gradient[a].setZero();
    own.energy = 0.0;
    own.entries.clear();
    if (stretch) own.add_stretch(along.warp, corners, 1.0, along.area, laws_of(t).warp);
    if (stretch) own.add_stretch(along.weft, corners, 1.0, along.area, laws_of(t).weft);
    if (shear) own.add_shear(along.warp, along.weft, corners, along.area * laws_of(t).shear);
    into.energy += own.energy;
    for (int a = 0; a < 3; ++a) into.gradient[particles[a]] += own.gradient[a];
    if (!into.second) continue;
    Eigen::Matrix<double, 9, 9> second = Eigen::Matrix<double, 9, 9>::Zero();
    for (const auto& entry : own.entries) second(entry.row(), entry.col()) += entry.value();
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) into.add_block(particles[a], particles[b], second.block<3, 3>(3 * a, 3 * b));
  }
}

void ParticleCloth::add_bending(const Places& x, ForceSum& into) const {
  for (int n = 0; n < bending_.outerSize(); ++n) {
    Vector3d slope = Vector3d::Zero();
    for (Eigen::SparseMatrix<double>::InnerIterator it(bending_, n); it; ++it) {
      slope += it.value() * x[it.row()];
      for (int c = 0; into.second && c < 3; ++c)
        into.entries.emplace_back(3 * static_cast<int>(it.row()) + c, 3 * n + c, it.value());
    }
    into.energy += 0.5 * slope.dot(x[n]);
    into.gradient[n] += slope;
  }
}

void ParticleCloth::add_pressing(const Places& x, ForceSum& into) const {
  for (std::size_t n = 0; n < planes_.size(); ++n) {
    const Plane& plane = planes_[n];
    const double within = sheet_.body->reach - plane.distance - plane.away.dot(x[n] - plane.at);
    if (!plane.near || within <= 0.0) continue;
    const double stiffness = sheet_.body->stiffness * area_[n];
    into.energy += 0.5 * stiffness * within * within;
    into.gradient[n] -= stiffness * within * plane.away;
    if (into.second)
      into.add_block(static_cast<int>(n), static_cast<int>(n), stiffness * plane.away * plane.away.transpose());
  }
}

/// Of the way t along the body from the anchor: k t^2/2 while k t is below the bound, and linear beyond.
void ParticleCloth::add_friction(const Places& x, ForceSum& into) const {
  for (std::size_t n = 0; n < planes_.size(); ++n) {
    const Plane& plane = planes_[n];
    const double bound = sheet_.body->friction * plane.pressing;
    if (!plane.held || !(bound > 0.0)) continue;
    const Matrix3d along = Matrix3d::Identity() - plane.away * plane.away.transpose();
    const Vector3d way = along * (x[n] - plane.anchor);
    const double stiffness = holding * sheet_.body->stiffness * area_[n], length = way.norm(), far = bound / stiffness;
    const bool sticks = length <= far;
    into.energy += sticks ? 0.5 * stiffness * length * length : bound * (length - 0.5 * far);
    into.gradient[n] += (sticks ? stiffness : bound / length) * way;
    if (!into.second) continue;
    const Matrix3d second = sticks ? Matrix3d(stiffness * along)
                                   : Matrix3d(bound / length * (along - way * way.transpose() / (length * length)));
    into.add_block(static_cast<int>(n), static_cast<int>(n), second);
  }
}

void ParticleCloth::add(ClothForce kind, const Places& x, ForceSum& into) const {
  switch (kind) {
    case ClothForce::stretch:
      return add_strained(true, false, x, into);
    case ClothForce::shear:
      return add_strained(false, true, x, into);
    case ClothForce::bending:
      return add_bending(x, into);
    case ClothForce::band:
      for (const ElasticLine& band : sheet_.bands)
        into.add_stretch(std::array{Weight{band.a, -1.0}, Weight{band.b, 1.0}}, x, band.length, band.length,
                         [&](double stretch) {
                           const double strain = std::max(stretch - 1.0, 0.0), k = band.stiffness;
                           return Tensile{0.5 * k * strain * strain, k * strain, strain > 0.0 ? k : 0.0};
                         });
      return;
    case ClothForce::pressing:
      return add_pressing(x, into);
    case ClothForce::friction:
      return add_friction(x, into);
    case ClothForce::drag:  // of velocities, not of places: it has no energy
      return;
    case ClothForce::weight:
      return add_gravity(x, into);
  }
}

void ParticleCloth::add_laws(const Places& x, ForceSum& into) const {
  add_strained(true, true, x, into);
  for (const ClothForce kind : {ClothForce::bending, ClothForce::band, ClothForce::pressing, ClothForce::friction})
    add(kind, x, into);
}

/// Where friction's bound was passed its anchor follows; a particle that has left the body has none.
void ParticleCloth::arrive() { find_planes(); }

void ParticleCloth::find_planes() {
  if (!sheet_.body) return;
  const bool first = planes_.empty();
  if (first) planes_.resize(places().size());
  for (std::size_t n = 0; n < planes_.size(); ++n) {
    Plane& plane = planes_[n];
    const auto [distance, away] = sheet_.body->body(places()[n]);
    const double stiffness = sheet_.body->stiffness * area_[n];
    plane.at = places()[n], plane.away = away, plane.distance = distance;
    plane.near = distance < sheet_.body->reach + sight && away.squaredNorm() > 0.5;
    plane.pressing = plane.near ? stiffness * std::max(0.0, sheet_.body->reach - distance) : 0.0;
    if (!(plane.pressing > 0.0)) {
      plane.held = false;
      continue;
    }
    if (!plane.held) plane.held = true, plane.anchor = plane.at;
    Vector3d way = plane.at - plane.anchor;
    way -= way.dot(away) * away;
    const double far = sheet_.body->friction * plane.pressing / (holding * stiffness);
    if (way.norm() > far) plane.anchor = plane.at - far * way.normalized();
  }
}

bool ParticleCloth::has(ClothForce kind) const {
  switch (kind) {
    case ClothForce::stretch:
    case ClothForce::shear:
      return true;
    case ClothForce::bending:
      return bending_.nonZeros() > 0;
    case ClothForce::band:
      return !sheet_.bands.empty();
    case ClothForce::pressing:
      return sheet_.body.has_value();
    case ClothForce::friction:
      return sheet_.body && sheet_.body->friction > 0.0;
    case ClothForce::drag:
      return sheet_.drag > 0.0;
    case ClothForce::weight:
      return sheet_.gravity != 0.0;
  }
  return false;
}

std::vector<ClothForce> ParticleCloth::kinds() const {
  std::vector<ClothForce> list;
  for (std::size_t n = 0; n < texts_of(ClothForce{}).size(); ++n)
    if (const auto kind = static_cast<ClothForce>(n); has(kind)) list.push_back(kind);
  return list;
}

Places ParticleCloth::forces(ClothForce kind) const {
  if (kind == ClothForce::drag) return drag_forces();
  ForceSum sum(places().size());
  add(kind, places(), sum);
  for (Vector3d& gradient : sum.gradient) gradient = -gradient;
  return sum.gradient;
}

double ParticleCloth::penetration() const {
  double deepest = 0.0;
  for (const Plane& plane : planes_) deepest = std::max(deepest, -plane.distance);
  return deepest;
}

ParticleCloth::Strained ParticleCloth::strained(int triangle) const {
  const Directions& along = directions_[triangle];
  Places corners;
  for (const int n : sheet_.triangles[triangle].particles) corners.push_back(places()[n]);
  const Vector3d warp = weighted_sum(along.warp, corners), weft = weighted_sum(along.weft, corners);
  const ClothLaws& laws = laws_of(triangle);
  const Vector2d stretch(warp.norm(), weft.norm());
  return {stretch,
          {laws.warp(stretch.x()).tension, laws.weft(stretch.y()).tension},
          std::asin(std::clamp(warp.normalized().dot(weft.normalized()), -1.0, 1.0))};
}

}  // namespace snug::mesh
