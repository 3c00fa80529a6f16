#include "mesh/particles/particle_sheet.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>

namespace snug::mesh {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Sums of energies, their gradient, and where wanted second derivatives without what could make them indefinite.
struct ParticleSheet::Assembly {
  bool second = false;
  double energy = 0.0;
  Places gradient;
  std::vector<Eigen::Triplet<double>> entries;

  explicit Assembly(std::size_t particles, bool with_second = false)
      : second(with_second), gradient(particles, Vector3d::Zero()) {}

  void add_block(int a, int b, const Matrix3d& block) {
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) entries.emplace_back(3 * a + i, 3 * b + k, block(i, k));
  }
};

namespace {

/// Particles with weights: a difference of places.
struct Weight {
  int particle;
  double weight;
};

}  // namespace

ParticleSheet::ParticleSheet(const SheetGrid& grid, SheetLaws laws, std::vector<Vector3d> places,
                             std::vector<bool> held, std::optional<Repulsion> repulsion)
    : grid_(grid),
      laws_(std::move(laws)),
      repulsion_(std::move(repulsion)),
      places_(std::move(places)),
      held_(std::move(held)) {
  const std::size_t count = static_cast<std::size_t>(std::max(grid.along_warp, 0)) * std::max(grid.along_weft, 0);
  if (count == 0 || places_.size() != count || held_.size() != count)
    throw std::invalid_argument("a sheet needs a place for every particle");
  if (!(grid.spacing_warp > 0.0) || !(grid.spacing_weft > 0.0) || !(laws_.density > 0.0) || !(laws_.drag >= 0.0))
    throw std::invalid_argument("a sheet needs spacings and a density");
  velocities_.assign(count, Vector3d::Zero());
  pulls_.assign(count, Vector3d::Zero());
  for (int j = 0; j < grid_.along_weft; ++j)
    for (int i = 0; i < grid_.along_warp; ++i)
      area_.push_back(share(i, grid_.along_warp) * grid_.spacing_warp * share(j, grid_.along_weft) *
                      grid_.spacing_weft);
}

/// Along every edge: width w times its flat length times the energy of the strip at its stretch. Compressed edges keep
/// the tangent along themselves only, so that the second derivatives stay definite.
void ParticleSheet::add_stretch(const Places& x, Assembly& into) const {
  const auto add_edge = [&](int a, int b, double length, double width, const TensileCurve& curve) {
    const Vector3d way = x[b] - x[a];
    const double now = way.norm();
    const auto [energy, tension, tangent] = curve(now / length);
    const Vector3d along = way / now;
    into.energy += width * length * energy;
    into.gradient[b] += width * tension * along, into.gradient[a] -= width * tension * along;
    if (!into.second) return;
    const Matrix3d axial = along * along.transpose();
    const Matrix3d block = width * (std::max(tangent, 0.0) / length * axial +
                                    std::max(tension, 0.0) / now * (Matrix3d::Identity() - axial));
    into.add_block(a, a, block), into.add_block(b, b, block), into.add_block(a, b, -block),
        into.add_block(b, a, -block);
  };
  for (int j = 0; j < grid_.along_weft; ++j)
    for (int i = 0; i < grid_.along_warp; ++i) {
      if (i + 1 < grid_.along_warp)
        add_edge(number(i, j), number(i + 1, j), grid_.spacing_warp, share(j, grid_.along_weft) * grid_.spacing_weft,
                 laws_.warp);
      if (j + 1 < grid_.along_weft)
        add_edge(number(i, j), number(i, j + 1), grid_.spacing_weft, share(i, grid_.along_warp) * grid_.spacing_warp,
                 laws_.weft);
    }
}

/// Of every cell: shear A phi^2/2, sin phi the product of the unit directions of its mean sides. The second derivatives
/// are those of Gauss and Newton.
void ParticleSheet::add_trellis(const Places& x, Assembly& into) const {
  const double stiffness = laws_.shear * grid_.spacing_warp * grid_.spacing_weft;
  if (stiffness == 0.0) return;
  for (int j = 0; j + 1 < grid_.along_weft; ++j)
    for (int i = 0; i + 1 < grid_.along_warp; ++i) {
      const std::array<int, 4> n = {number(i, j), number(i + 1, j), number(i, j + 1), number(i + 1, j + 1)};
      const Vector3d warp = x[n[1]] + x[n[3]] - x[n[0]] - x[n[2]], weft = x[n[2]] + x[n[3]] - x[n[0]] - x[n[1]];
      const Vector3d u = warp.normalized(), v = weft.normalized();
      const double sine = std::clamp(u.dot(v), -0.999999, 0.999999), angle = std::asin(sine), cosine = std::cos(angle);
      const Vector3d by_warp = (v - sine * u) / (warp.norm() * cosine),
                     by_weft = (u - sine * v) / (weft.norm() * cosine);
      const std::array<Vector3d, 4> slope = {-by_warp - by_weft, by_warp - by_weft, by_weft - by_warp,
                                             by_warp + by_weft};
      into.energy += 0.5 * stiffness * angle * angle;
      for (int a = 0; a < 4; ++a) {
        into.gradient[n[a]] += stiffness * angle * slope[a];
        for (int b = 0; into.second && b < 4; ++b)
          into.add_block(n[a], n[b], stiffness * slope[a] * slope[b].transpose());
      }
    }
}

/// Curvatures by second differences of places: of three particles in a row B k^2/2 on the area between their middles;
/// of a cell 4 Bt k^2/2 with the mixed difference and Bt = sqrt(B_warp B_weft)/2, which makes a plate of equal B
/// isotropic.
void ParticleSheet::add_differences(bool twist, Assembly& into, const Places& x) const {
  const double a = grid_.spacing_warp, b = grid_.spacing_weft;
  const auto add_difference = [&](std::initializer_list<Weight> weights, double stiffness) {
    Vector3d sum = Vector3d::Zero();
    for (const Weight& one : weights) sum += one.weight * x[one.particle];
    into.energy += 0.5 * stiffness * sum.squaredNorm();
    for (const Weight& one : weights) {
      into.gradient[one.particle] += stiffness * one.weight * sum;
      for (const Weight& other : weights)
        if (into.second)
          into.add_block(one.particle, other.particle, stiffness * one.weight * other.weight * Matrix3d::Identity());
    }
  };
  const double twisting = 2.0 * std::sqrt(laws_.bending_warp * laws_.bending_weft) / (a * b);
  for (int j = 0; j < grid_.along_weft; ++j)
    for (int i = 0; i < grid_.along_warp; ++i) {
      const bool inner_warp = i > 0 && i + 1 < grid_.along_warp, inner_weft = j > 0 && j + 1 < grid_.along_weft;
      if (!twist && inner_warp)
        add_difference({{number(i - 1, j), 1.0}, {number(i, j), -2.0}, {number(i + 1, j), 1.0}},
                       laws_.bending_warp * share(j, grid_.along_weft) * b / (a * a * a));
      if (!twist && inner_weft)
        add_difference({{number(i, j - 1), 1.0}, {number(i, j), -2.0}, {number(i, j + 1), 1.0}},
                       laws_.bending_weft * share(i, grid_.along_warp) * a / (b * b * b));
      if (twist && i + 1 < grid_.along_warp && j + 1 < grid_.along_weft)
        add_difference(
            {{number(i, j), 1.0}, {number(i + 1, j), -1.0}, {number(i, j + 1), -1.0}, {number(i + 1, j + 1), 1.0}},
            twisting);
    }
}

void ParticleSheet::add_repulsion(const Places& x, Assembly& into) const {
  if (!repulsion_) return;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const auto [distance, away] = repulsion_->body(x[n]);
    const double into_reach = repulsion_->reach - distance, stiffness = repulsion_->stiffness * area_[n];
    if (into_reach <= 0.0) continue;
    into.energy += 0.5 * stiffness * into_reach * into_reach;
    into.gradient[n] -= stiffness * into_reach * away;
    if (into.second) into.add_block(static_cast<int>(n), static_cast<int>(n), stiffness * away * away.transpose());
  }
}

/// Weight, and what pulls at single particles.
void ParticleSheet::add_gravity(const Places& x, Assembly& into) const {
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double weight = mass(static_cast<int>(n)) * laws_.gravity;
    into.energy += weight * x[n].z();
    into.gradient[n].z() += weight;
  }
}

void ParticleSheet::add(SheetForce kind, const Places& x, Assembly& into) const {
  switch (kind) {
    case SheetForce::stretch:
      return add_stretch(x, into);
    case SheetForce::trellis:
      return add_trellis(x, into);
    case SheetForce::bend:
      return add_differences(false, into, x);
    case SheetForce::twist:
      return add_differences(true, into, x);
    case SheetForce::repulsion:
      return add_repulsion(x, into);
    case SheetForce::gravity:
      return add_gravity(x, into);
  }
}

namespace {

constexpr std::array every_force = {SheetForce::stretch, SheetForce::trellis,   SheetForce::bend,
                                    SheetForce::twist,   SheetForce::repulsion, SheetForce::gravity};

}  // namespace

double ParticleSheet::potential(const Places& x) const {
  Assembly sum(x.size());
  for (const SheetForce kind : every_force) add(kind, x, sum);
  for (std::size_t n = 0; n < x.size(); ++n) sum.energy -= pulls_[n].dot(x[n]);
  return sum.energy;
}

double ParticleSheet::kinetic_energy() const {
  double sum = 0.0;
  for (std::size_t n = 0; n < velocities_.size(); ++n)
    sum += 0.5 * mass(static_cast<int>(n)) * velocities_[n].squaredNorm();
  return sum;
}

std::vector<Vector3d> ParticleSheet::forces(SheetForce kind) const {
  Assembly sum(places_.size());
  add(kind, places_, sum);
  for (Vector3d& gradient : sum.gradient) gradient = -gradient;
  return sum.gradient;
}

namespace {

double extent(const std::vector<Vector3d>& x) {
  double largest = 0.0;
  for (const Vector3d& p : x) largest = std::max(largest, p.lpNorm<Eigen::Infinity>());
  return largest;
}

}  // namespace

double ParticleSheet::objective(const Places& x, double dt) const {
  double sum = potential(x);
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double inertia = mass(static_cast<int>(n)) / (dt * dt), resistance = drag(static_cast<int>(n)) / dt;
    sum += 0.5 * inertia * (x[n] - places_[n] - dt * velocities_[n]).squaredNorm() +
           0.5 * resistance * (x[n] - places_[n]).squaredNorm();
  }
  return sum;
}

/// Gradient and second derivatives of the objective; those of held particles are zero, and a diagonal.
ParticleSheet::Assembly ParticleSheet::derivatives(const Places& x, double dt) const {
  Assembly sum(x.size(), true);
  for (const SheetForce kind : every_force) add(kind, x, sum);
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double inertia = mass(static_cast<int>(n)) / (dt * dt), resistance = drag(static_cast<int>(n)) / dt;
    sum.gradient[n] +=
        inertia * (x[n] - places_[n] - dt * velocities_[n]) + resistance * (x[n] - places_[n]) - pulls_[n];
    if (held_[n]) sum.gradient[n].setZero();
    sum.add_block(static_cast<int>(n), static_cast<int>(n), (inertia + resistance) * Matrix3d::Identity());
  }
  std::erase_if(sum.entries, [&](const auto& entry) {
    return entry.row() != entry.col() && (held_[entry.row() / 3] || held_[entry.col() / 3]);
  });
  return sum;
}

/// As far along a way as the objective falls enough (Armijo).
ParticleSheet::Places ParticleSheet::searched(const Places& x, const Eigen::VectorXd& way, double slope,
                                              double dt) const {
  const double before = objective(x, dt);
  Places next;
  double length = 1.0;
  for (int halving = 0; halving <= 40; ++halving, length *= 0.5) {
    next = x;
    for (std::size_t n = 0; n < x.size(); ++n) next[n] += length * way.segment<3>(3 * n);
    if (objective(next, dt) <= before + 1e-4 * length * slope + 1e-14 * std::abs(before)) break;
  }
  return next;
}

std::optional<ParticleSheet::Places> ParticleSheet::minimum(double dt) const {
  constexpr int most_iterations = 50;
  const std::size_t count = places_.size();
  double load = 0.0;
  for (std::size_t n = 0; n < count; ++n)
    load = std::max(load, mass(static_cast<int>(n)) * laws_.gravity + pulls_[n].norm());
  Places x = places_;
  for (int iteration = 0; iteration <= most_iterations; ++iteration) {
    const Assembly sum = derivatives(x, dt);
    Eigen::VectorXd right(3 * count);
    for (std::size_t n = 0; n < count; ++n) right.segment<3>(3 * n) = -sum.gradient[n];
    Eigen::SparseMatrix<double> matrix(3 * count, 3 * count);
    matrix.setFromTriplets(sum.entries.begin(), sum.entries.end());
    const double round_off = 4e-16 * matrix.diagonal().maxCoeff() * extent(x);
    if (right.lpNorm<Eigen::Infinity>() < 1e-10 * load + round_off) return x;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
    if (factor.info() != Eigen::Success) return std::nullopt;
    const Eigen::VectorXd way = factor.solve(right);
    x = searched(x, way, -right.dot(way), dt);
  }
  return std::nullopt;
}

void ParticleSheet::step(double dt) {
  if (!(dt > 0.0)) throw std::invalid_argument("a step needs a time");
  constexpr int most_halvings = 16;
  for (double done = 0.0, part = 1.0; done < 1.0;) {  // shares of the step, sums of powers of two
    auto next = minimum(part * dt);
    for (int halving = 0; !next; ++halving) {
      if (halving == most_halvings) throw std::runtime_error("the step of the particles does not converge");
      part *= 0.5;
      next = minimum(part * dt);
    }
    for (std::size_t n = 0; n < places_.size(); ++n) velocities_[n] = ((*next)[n] - places_[n]) / (part * dt);
    places_ = std::move(*next);
    done += part;
    part = std::min(2.0 * part, 1.0 - done);
  }
}

}  // namespace snug::mesh
