#include "materials/laws/ogden.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>

#include "materials/laws/tensor.hpp"

namespace snug::materials {
namespace {

/// (x^e - y^e)/(x - y) for x, y > 0, exact to rounding however near they are; e y^(e - 1) where they are equal.
double power_quotient(double x, double y, double e) {
  const double d = (x - y) / y;
  const double quotient = d == 0.0 ? e : std::expm1(e * std::log1p(d)) / d;
  return std::pow(y, e - 1.0) * quotient;
}

}  // namespace

// In the eigenvectors N_a of C = F^T F, eigenvalues c_a = lambda_a^2, t_pa = mu_p (c_a J^(-2/3))^(alpha_p/2):
//   W    = sum_p (sum_a t_pa - 3 mu_p)/alpha_p
//   beta_a = sum_p (t_pa - sum_c t_pc/3),   S = sum_a beta_a/c_a N_a (x) N_a,   P = F S
//   A    = d_ik S_JL + 2 sum_ab D_ab G_aa (x) G_bb + sum_a<b theta_ab G_ab (x) G_ab
// with M_a = F N_a, G_aa = M_a (x) N_a, G_ab = M_a (x) N_b + M_b (x) N_a, and by the spectral theorem
//   D_ab = d(beta_a/c_a)/dc_b,   theta_ab = (beta_a/c_a - beta_b/c_b)/(c_a - c_b).
// theta is written with the quotient (c_a^e - c_b^e)/(c_a - c_b), so that equal stretches are no special case.
SolidResponse Ogden::isochoric(const Eigen::Matrix3d& F) const {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(F.transpose() * F);
  const Eigen::Vector3d& c = solver.eigenvalues();
  const Eigen::Matrix3d& N = solver.eigenvectors();
  const double J = determinant(F, cofactor(F)), J23 = std::cbrt(J * J);

  SolidResponse r;
  r.energy = 0.0;
  Eigen::Vector3d beta = Eigen::Vector3d::Zero();
  Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();     // c_b dbeta_a/dc_b
  Eigen::Matrix3d quotient = Eigen::Matrix3d::Zero();  // (beta_a - beta_b)/(c_a - c_b)
  for (const OgdenTerm& term : terms) {
    const double e = 0.5 * term.alpha;
    const Eigen::Vector3d t = term.mu * (c / J23).array().pow(e).matrix();
    const double mean = t.sum() / 3.0;
    r.energy += 3.0 * (mean - term.mu) / term.alpha;
    beta += (t.array() - mean).matrix();
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) slope(a, b) += e / 3.0 * ((a == b ? 3.0 * t[a] : 0.0) - t[a] - t[b] + mean);
    const double scale = term.mu * std::pow(J23, -e);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < a; ++b) quotient(a, b) += scale * power_quotient(c[a], c[b], e);
  }

  const Eigen::Vector3d s = beta.cwiseQuotient(c);
  const Eigen::Matrix3d S = N * s.asDiagonal() * N.transpose(), M = F * N;
  r.stress = F * S;
  r.tangent.setZero();
  add_geometric(r.tangent, S);
  Eigen::Matrix<double, 9, 3> G;
  Eigen::Matrix3d D;
  for (int a = 0; a < 3; ++a) {
    G.col(a) = components(M.col(a) * N.col(a).transpose());
    for (int b = 0; b < 3; ++b) D(a, b) = (slope(a, b) - (a == b ? beta[a] : 0.0)) / (c[a] * c[b]);
  }
  r.tangent += 2.0 * G * D * G.transpose();
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < a; ++b) {
      const double theta = quotient(a, b) / c[a] - beta[b] / (c[a] * c[b]);
      const Eigen::Matrix<double, 9, 1> g =
          components(M.col(a) * N.col(b).transpose() + M.col(b) * N.col(a).transpose());
      r.tangent += theta * g * g.transpose();
    }
  return r;
}

}  // namespace snug::materials
