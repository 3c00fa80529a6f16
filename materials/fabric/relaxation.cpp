// A fabric shortens by wrinkles at no cost: A is the wrinkle strain. The problem is convex, its conditions are
//   A >= 0, N = dW/dE(E + A) >= 0, N : A = 0:
//   taut      A = 0, N positive semidefinite;
//   slack     E + A = 0, N = 0, possible when -E is positive semidefinite;
//   wrinkled  A = beta n n, N = sigma m m with m across the wrinkles' normal n, both factors positive.
// Strains are vectors (E11, E22, 2 E12), forces (N11, N22, N12).
#include "materials/fabric/relaxation.hpp"

#include <algorithm>
#include <cmath>

namespace snug::materials {
namespace {

using Eigen::Matrix;
using Eigen::Matrix2d, Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

// Strain below which a state counts as unstrained: round-off of coordinates must not choose between taut and slack.
constexpr double strain_roundoff = 1e-12;

bool positive_semidefinite(double a11, double a22, double a12, double tolerance) {
  const double p = a11 + tolerance, q = a22 + tolerance;
  return p >= 0.0 && q >= 0.0 && p * q >= a12 * a12;
}

struct Wrinkle {
  double angle = 0.0;  // of n from the warp, rad
  double beta = 0.0;   // wrinkle strain along n
};

// Wrinkle strain direction p = n n and its change with the angle q = n m + m n, as strain vectors.
struct Frame {
  Vector2d n, m;
  Vector3d p, q;
  explicit Frame(double angle)
      : n(std::cos(angle), std::sin(angle)),
        m(-n[1], n[0]),
        p(n[0] * n[0], n[1] * n[1], 2.0 * n[0] * n[1]),
        q(2.0 * n[0] * m[0], 2.0 * n[1] * m[1], 2.0 * (n[0] * m[1] + n[1] * m[0])) {}
  // m.N m
  double across(const Vector3d& N) const { return m[0] * m[0] * N[0] + m[1] * m[1] * N[1] + 2.0 * m[0] * m[1] * N[2]; }
};

// Start: the dual problem with frozen compliance S, max over m of (m.E m)+^2 / (2 M:S:M), M = m m, over some
// directions. Exact for a linear fabric up to the spacing of the directions.
Wrinkle start(const Matrix3d& C, const Vector3d& E) {
  constexpr int directions = 12;
  const double det = C(0, 0) * C(1, 1) - C(0, 1) * C(0, 1);
  const double s11 = C(1, 1) / det, s22 = C(0, 0) / det, s12 = -C(0, 1) / det, s33 = 1.0 / C(2, 2);
  Wrinkle best;
  double best_value = -1.0;
  for (int k = 0; k < directions; ++k) {
    const double angle = M_PI * k / directions;
    const double m0 = std::cos(angle), m1 = std::sin(angle);
    const Vector3d M(m0 * m0, m1 * m1, m0 * m1);
    const double stretch = M[0] * E[0] + M[1] * E[1] + M[2] * E[2];
    if (stretch <= 0.0) continue;
    const Vector3d SM(s11 * M[0] + s12 * M[1], s12 * M[0] + s22 * M[1], s33 * M[2]);
    const double compliance = M.dot(SM);
    if (stretch * stretch <= best_value * compliance) continue;
    best_value = stretch * stretch / compliance;
    const double sigma = stretch / compliance;
    const Vector3d p(m1 * m1, m0 * m0, -m0 * m1);  // n n paired with (E11, E22, 2 E12)
    best = {angle - M_PI_2, std::max(0.0, p.dot(sigma * SM - E))};
  }
  return best;
}

// Newton for n.N n = 0 and n.N m = 0 in (beta, angle); true when it ends in an admissible wrinkled state.
bool newton(const Fabric& fabric, const Vector3d& E, double stiffness, Wrinkle& w) {
  const double size = E.cwiseAbs().maxCoeff();
  for (int k = 0; k < 25; ++k) {
    const Frame f(w.angle);
    const MembraneResponse r = fabric.unrelaxed(E + w.beta * f.p);
    const double sigma = f.across(r.force);
    const double along = f.p.dot(r.force);
    const double mixed = 0.5 * f.q.dot(r.force);
    const Vector3d Cp = r.tangent * f.p, Cq = r.tangent * f.q;
    Matrix2d jacobian;
    jacobian << f.p.dot(Cp), w.beta * f.p.dot(Cq) + 2.0 * mixed, 0.5 * f.q.dot(Cp),
        0.5 * w.beta * f.q.dot(Cq) + sigma - along;
    const double det = jacobian(0, 0) * jacobian(1, 1) - jacobian(0, 1) * jacobian(1, 0);
    const double d_beta = -(jacobian(1, 1) * along - jacobian(0, 1) * mixed) / det;
    const double d_angle = -(jacobian(0, 0) * mixed - jacobian(1, 0) * along) / det;
    if (!std::isfinite(d_beta) || !std::isfinite(d_angle)) return false;
    const double scale = std::min(1.0, 0.4 / std::max(std::abs(d_angle), 1e-300));
    w.beta = std::max(0.0, w.beta + scale * d_beta);
    w.angle += scale * d_angle;
    const bool still = std::abs(d_beta) <= 1e-9 * size && std::abs(d_angle) <= 1e-9;
    const bool balanced = std::abs(along) + std::abs(mixed) <= 1e-13 * stiffness * size;
    if (still || balanced) return sigma >= -1e-12 * stiffness * size;
  }
  return false;
}

// min over beta >= 0 of W(E + beta n n) for one direction: a convex scalar problem, Newton inside a bracket.
double best_beta(const Fabric& fabric, const Vector3d& E, const Vector3d& p, double& energy) {
  double low = 0.0, high = 0.0, beta = 0.0;
  MembraneResponse r = fabric.unrelaxed(E);
  energy = r.energy;
  if (p.dot(r.force) >= 0.0) return 0.0;
  for (int k = 0; k < 100; ++k) {
    const double slope = p.dot(r.force);
    (slope < 0.0 ? low : high) = beta;
    double next = beta - slope / p.dot(r.tangent * p);
    if (high > low && !(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - beta) <= 1e-14 * next) break;
    beta = next;
    r = fabric.unrelaxed(E + beta * p);
    energy = r.energy;
  }
  return beta;
}

// Safeguard: search all directions for the least energy, then golden section round the best.
Wrinkle search(const Fabric& fabric, const Vector3d& E) {
  constexpr int directions = 48;
  const auto energy_at = [&](double angle) {
    double energy = 0.0;
    best_beta(fabric, E, Frame(angle).p, energy);
    return energy;
  };
  double best = 0.0, best_energy = energy_at(0.0);
  for (int k = 1; k < directions; ++k) {
    const double energy = energy_at(M_PI * k / directions);
    if (energy < best_energy) best = M_PI * k / directions, best_energy = energy;
  }
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = best - M_PI / directions, b = best + M_PI / directions;
  double c = b - golden * (b - a), d = a + golden * (b - a), ec = energy_at(c), ed = energy_at(d);
  while (b - a > 1e-8) {
    if (ec < ed) {
      b = d, d = c, ed = ec, c = b - golden * (b - a), ec = energy_at(c);
    } else {
      a = c, c = d, ec = ed, d = a + golden * (b - a), ed = energy_at(d);
    }
  }
  double energy = 0.0;
  Wrinkle w{0.5 * (a + b), 0.0};
  w.beta = best_beta(fabric, E, Frame(w.angle).p, energy);
  return w;
}

// Implicit function theorem at N(E + beta n n) = sigma m m:  C_r = C - C V (V'C V + D)^-1 V'C with
// V = [n n, sqrt(beta) (n m + m n)] and D = diag(0, 2 sigma): the second column is scaled so that both borders
// (beta -> 0: taut, sigma -> 0: slack) stay regular.
MembraneResponse wrinkled(const Fabric& fabric, const Vector3d& E, const Wrinkle& w) {
  const Frame f(w.angle);
  MembraneResponse r = fabric.unrelaxed(E + w.beta * f.p);
  const double sigma = std::max(0.0, f.across(r.force));
  Matrix<double, 3, 2> CV;
  const Vector3d v2 = std::sqrt(w.beta) * f.q;
  CV.col(0) = r.tangent * f.p;
  CV.col(1) = r.tangent * v2;
  const double a = f.p.dot(CV.col(0)), b = f.p.dot(CV.col(1)), d = v2.dot(CV.col(1)) + 2.0 * sigma;
  const double det = a * d - b * b;
  if (det > 1e-14 * a * d) {
    r.tangent -= (d * CV.col(0) * CV.col(0).transpose() - b * CV.col(0) * CV.col(1).transpose() -
                  b * CV.col(1) * CV.col(0).transpose() + a * CV.col(1) * CV.col(1).transpose()) /
                 det;
  } else {
    r.tangent -= CV.col(0) * CV.col(0).transpose() / a;
  }
  // The exact force is sigma m m; writing it so removes what the iteration left across the tension.
  r.force = sigma * Vector3d(f.m[0] * f.m[0], f.m[1] * f.m[1], f.m[0] * f.m[1]);
  r.state = MembraneResponse::State::wrinkled;
  return r;
}

}  // namespace

MembraneResponse relax(const Fabric& fabric, const Vector3d& strain, const MembraneResponse& plain) {
  const Matrix3d& C = plain.tangent;
  const double stiffness = std::max({C(0, 0), C(1, 1), C(2, 2)});
  if (positive_semidefinite(plain.force[0], plain.force[1], plain.force[2], strain_roundoff * stiffness)) return plain;

  if (positive_semidefinite(-strain[0], -strain[1], 0.5 * strain[2], 0.0)) {
    MembraneResponse slack;
    slack.state = MembraneResponse::State::slack;
    return slack;
  }
  if (!plain.force.allFinite()) return plain;  // for the caller's recovery, not for a search
  Wrinkle w = start(C, strain);
  if (!newton(fabric, strain, stiffness, w)) {
    w = search(fabric, strain);
    Wrinkle polished = w;
    if (newton(fabric, strain, stiffness, polished)) w = polished;
  }
  return wrinkled(fabric, strain, w);
}

}  // namespace snug::materials
