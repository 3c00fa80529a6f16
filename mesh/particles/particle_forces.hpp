// What forces on particles are made of: energies of sums of places, with their slopes.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace snug::mesh {

/// Of a strip at a stretch (current over flat length): energy per flat area (N/m), tension (N/m), its derivative by the
/// stretch (N/m).
struct Tensile {
  double energy = 0.0, tension = 0.0, tangent = 0.0;
};
using TensileCurve = std::function<Tensile(double stretch)>;

/// How far a point is from a body and which way off it (unit), m.
struct Nearness {
  double distance = 0.0;
  Eigen::Vector3d away = Eigen::Vector3d::Zero();
};

using Places = std::vector<Eigen::Vector3d>;  ///< m, of particles

/// A particle's weight in a sum of places.
struct Weight {
  int particle;
  double weight;
};
using Weights = std::span<const Weight>;
Eigen::Vector3d weighted_sum(Weights weights, const Places& x);

/// Sums of energies (J), their gradient (N), and where wanted second derivatives (N/m) without what could make them
/// indefinite.
struct ForceSum {
  bool second = false;
  double energy = 0.0;
  Places gradient;
  std::vector<Eigen::Triplet<double>> entries;

  explicit ForceSum(std::size_t particles, bool with_second = false)
      : second(with_second), gradient(particles, Eigen::Vector3d::Zero()) {}

  void add_block(int a, int b, const Eigen::Matrix3d& block);

  /// measure (m2) times the curve's energy at |sum w x| / length. Sums that are short against `length` keep the tangent
  /// along themselves only, so that the second derivatives stay definite.
  void add_stretch(Weights weights, const Places& x, double length, double measure, const TensileCurve& curve);
  /// stiffness (N m) phi^2/2 with sin phi the product of the unit directions of two sums over the same particles. The
  /// second derivatives are those of Gauss and Newton.
  void add_shear(Weights warp, Weights weft, const Places& x, double stiffness);
};

}  // namespace snug::mesh
