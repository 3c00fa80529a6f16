#include "mesh/particles/implicit_particles.hpp"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace snug::mesh {

using Eigen::Matrix3d;
using Eigen::Vector3d;

ImplicitParticles::ImplicitParticles(Places places, std::vector<HeldComponents> held, std::vector<double> masses,
                                     std::vector<double> drags, double gravity, MinimumSearch search)
    : places_(std::move(places)),
      held_(std::move(held)),
      mass_(std::move(masses)),
      drag_(std::move(drags)),
      gravity_(gravity),
      search_(search) {
  const std::size_t count = mass_.size();
  if (count == 0 || places_.size() != count || held_.size() != count || drag_.size() != count)
    throw std::invalid_argument("every particle needs a place, a mass and what holds it");
  if (!(*std::min_element(mass_.begin(), mass_.end()) > 0.0) || !(*std::min_element(drag_.begin(), drag_.end()) >= 0.0))
    throw std::invalid_argument("particles need masses, and a drag that is not negative");
  velocities_.assign(count, Vector3d::Zero());
  pulls_.assign(count, Vector3d::Zero());
}

/// Weight, and what pulls at single particles.
void ImplicitParticles::add_gravity(const Places& x, ForceSum& into) const {
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double weight = mass(static_cast<int>(n)) * gravity_;
    into.energy += weight * x[n].z();
    into.gradient[n].z() += weight;
  }
}

double ImplicitParticles::potential(const Places& x) const {
  ForceSum sum(x.size());
  add_laws(x, sum);
  add_gravity(x, sum);
  for (std::size_t n = 0; n < x.size(); ++n) sum.energy -= pulls_[n].dot(x[n]);
  return sum.energy;
}

double ImplicitParticles::energy_of(const Places& way, double step) const {
  Places x = places_;
  for (std::size_t n = 0; n < x.size(); ++n) x[n] += step * way[n];
  return potential(x);
}

double ImplicitParticles::kinetic_energy() const {
  double sum = 0.0;
  for (std::size_t n = 0; n < velocities_.size(); ++n)
    sum += 0.5 * mass(static_cast<int>(n)) * velocities_[n].squaredNorm();
  return sum;
}

void ImplicitParticles::move_to(Places places, Places velocities) {
  if (velocities.empty()) velocities.assign(places.size(), Vector3d::Zero());
  if (places.size() != places_.size() || velocities.size() != places_.size())
    throw std::invalid_argument("every particle needs a place and a velocity");
  places_ = std::move(places);
  velocities_ = std::move(velocities);
  arrive();
}

Vector3d ImplicitParticles::free_part(int particle, Vector3d vector) const {
  for (int c = 0; c < 3; ++c)
    if (held_[particle] >> c & 1) vector[c] = 0.0;
  return vector;
}

Places ImplicitParticles::total_forces() const {
  ForceSum sum(places_.size());
  add_laws(places_, sum);
  add_gravity(places_, sum);
  for (std::size_t n = 0; n < places_.size(); ++n) sum.gradient[n] = pulls_[n] - sum.gradient[n];
  return sum.gradient;
}

Places ImplicitParticles::drag_forces() const {
  Places forces;
  for (std::size_t n = 0; n < velocities_.size(); ++n) forces.emplace_back(-drag_[n] * velocities_[n]);
  return forces;
}

namespace {

double extent(const Places& x) {
  double largest = 0.0;
  for (const Vector3d& p : x) largest = std::max(largest, p.lpNorm<Eigen::Infinity>());
  return largest;
}

}  // namespace

double ImplicitParticles::objective(const Places& x, double dt) const {
  double sum = potential(x);
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double inertia = mass(static_cast<int>(n)) / (dt * dt), resistance = drag(static_cast<int>(n)) / dt;
    sum += 0.5 * inertia * (x[n] - places_[n] - dt * velocities_[n]).squaredNorm() +
           0.5 * resistance * (x[n] - places_[n]).squaredNorm();
  }
  return sum;
}

/// Gradient and second derivatives of the objective; those of held particles are zero, and a diagonal.
ForceSum ImplicitParticles::derivatives(const Places& x, double dt) const {
  ForceSum sum(x.size(), true);
  add_laws(x, sum);
  add_gravity(x, sum);
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double inertia = mass(static_cast<int>(n)) / (dt * dt), resistance = drag(static_cast<int>(n)) / dt;
    sum.gradient[n] +=
        inertia * (x[n] - places_[n] - dt * velocities_[n]) + resistance * (x[n] - places_[n]) - pulls_[n];
    sum.gradient[n] = free_part(static_cast<int>(n), sum.gradient[n]);
    sum.add_block(static_cast<int>(n), static_cast<int>(n), (inertia + resistance) * Matrix3d::Identity());
  }
  const auto is_held = [&](int row) { return held_[row / 3] >> row % 3 & 1; };
  std::erase_if(sum.entries, [&](const auto& entry) {
    return entry.row() != entry.col() && (is_held(entry.row()) || is_held(entry.col()));
  });
  return sum;
}

/// As far along a way as the objective falls enough (Armijo).
Places ImplicitParticles::searched(const Places& x, const Eigen::VectorXd& way, double slope, double dt) const {
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

std::optional<Places> ImplicitParticles::minimum(double dt) {
  const std::size_t count = places_.size();
  double load = 0.0;
  for (std::size_t n = 0; n < count; ++n)
    load = std::max(load, mass(static_cast<int>(n)) * gravity_ + pulls_[n].norm());
  Places x = places_;
  for (int iteration = 0; iteration <= search_.iterations; ++iteration) {
    const ForceSum sum = derivatives(x, dt);
    Eigen::VectorXd right(3 * count);
    for (std::size_t n = 0; n < count; ++n) right.segment<3>(3 * n) = -sum.gradient[n];
    Eigen::SparseMatrix<double> matrix(3 * count, 3 * count);
    matrix.setFromTriplets(sum.entries.begin(), sum.entries.end());
    const double round_off = 4e-16 * matrix.diagonal().maxCoeff() * extent(x);
    if (right.lpNorm<Eigen::Infinity>() < search_.tolerance * load + round_off) return x;
    ++iterations_;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
    if (factor.info() != Eigen::Success) return std::nullopt;
    const Eigen::VectorXd way = factor.solve(right);
    x = searched(x, way, -right.dot(way), dt);
  }
  return search_.take_what_there_is ? std::optional(x) : std::nullopt;
}

void ImplicitParticles::step(double dt) {
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
    arrive();
    done += part;
    part = std::min(2.0 * part, 1.0 - done);
  }
}

}  // namespace snug::mesh
