// Fabric as an orthotropic membrane: forces per length from one potential in the Green strains (E11, E22, 2 E12) of the
// pattern frame turned to the warp (1 = warp, 2 = weft); relaxed for wrinkling (tension field).
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "cases/input/case.hpp"

namespace snug::materials {

/// Second Piola-Kirchhoff force per rest length S(E) (N/m) of a uniaxially strained, laterally held strip and its integral.
/// Strictly increasing: exponential in the engineering strain e inside the data (KES LT, WT, Fm), linear in E beyond it
/// (C1) and in compression, so that the energy stays convex.
class TensionCurve {
 public:
  struct Value { double energy, force, stiffness; };  ///< J/m2, N/m, N/m
  /// S = stiffness * E.
  static TensionCurve linear(double stiffness);
  /// KES tensile curve: nominal force F(e) = Fm (exp(a e) - 1)/(exp(a em) - 1), em = 2 WT / (LT Fm), LT fixes a
  /// (reference book section 6); S = F / (1 + e). All SI: work J/m2, maximum force N/m.
  static TensionCurve kes(double linearity, double work, double maximum_force);
  /// Nominal force F(e) = k1 e + k3 e^3 (N/m).
  static TensionCurve cubic(double k1, double k3, double data_end);
  Value at(double green_strain) const;
  double smallest_stiffness() const { return smallest_stiffness_; }

 private:
  enum class Kind { linear, kes, cubic } kind_ = Kind::linear;
  double p0_ = 0, p1_ = 0;                  ///< parameters of the kind
  double end_ = 0;                          ///< Green strain where the data ends
  Value at_end_{};
  double initial_stiffness_ = 0, smallest_stiffness_ = 0;
  Value inside(double green_strain) const;
};

/// Energy per rest area (J/m2), force (N/m; derivative by E11, E22, 2 E12) and tangent (N/m).
struct MembraneResponse {
  double energy = 0.0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Matrix3d tangent = Eigen::Matrix3d::Zero();
  enum class State { taut, wrinkled, slack } state = State::taut;
};

/// W = f1(E11) + f2(E22) + c E11 E22 + G/2 (2 E12)^2 with c = poisson * min stiffness (convex).
struct Fabric {
  std::string name;
  TensionCurve warp, weft;
  double coupling = 0.0;       ///< c, N/m
  double shear = 0.0;          ///< G, N/m per rad
  double areal_density = 0.0;  ///< kg/m2
  double thickness = 0.0;      ///< m
  std::string source;          ///< how each number was turned into SI

  MembraneResponse unrelaxed(const Eigen::Vector3d& strain) const;
  /// W_used = (1 - eta) W_r + eta W; W_r(E) = min over A >= 0 of W(E + A) (relaxed energy, any convex W).
  MembraneResponse relaxed(const Eigen::Vector3d& strain, double eta) const;
};

/// Shipped fabric (materials/data/fabrics.toml) or inline table. Throws input::InputError with the nearest known name.
Fabric find_fabric(const input::MaterialReference& reference);
std::vector<std::string> fabric_names();

}  // namespace snug::materials
