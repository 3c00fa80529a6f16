// Fabric as an orthotropic membrane: forces per length from one potential in the Green strains (E11, E22, 2 E12) of the
// pattern frame turned to the warp (1 = warp, 2 = weft); relaxed for wrinkling (tension field).
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/material_entry.hpp"
#include "materials/laws/response.hpp"

namespace snug::materials {

/// Second Piola-Kirchhoff force per rest length S(E) (N/m) of a uniaxially strained, laterally held strip and its
/// integral. S = F/(1 + e) with the nominal force F of the engineering strain e inside the data; linear in E beyond the
/// data (C1) and in compression. Strictly increasing, so that the energy is convex: where the slope dS/dE falls below a
/// twentieth of the initial one (LT > 1, or a straight F at large stretch) the data range ends there, earlier than the
/// data itself.
class TensionCurve {
 public:
  struct Value {
    double energy, force, stiffness;
  };                         ///< J/m2, N/m, N/m
  TensionCurve() = default;  ///< no stiffness at all
  /// S = stiffness * E (St Venant-Kirchhoff): F = stiffness * l (l^2 - 1)/2 at stretch l.
  static TensionCurve linear(double stiffness);
  /// KES tensile curve: F(e) = Fm (exp(a e) - 1)/(exp(a em) - 1), em = 2 WT / (LT Fm), where x = a em solves
  /// LT/2 = (exp(x) - 1 - x)/(x (exp(x) - 1)): x > 0 for LT < 1, straight for LT = 1, concave for LT > 1
  /// (reference book section 6). All SI: work J/m2, maximum force N/m. Throws std::invalid_argument outside 0 < LT < 2.
  static TensionCurve kes(double linearity, double work, double maximum_force);
  /// F(e) = k1 e + k3 e^3 (N/m) up to the engineering strain `data_end`; k1 > 0, k3 >= 0.
  static TensionCurve cubic(double k1, double k3, double data_end);

  /// F(e) through points of a test, both rising from 0: cubic between them, never falling, with the slope of the first chord at 0
  /// (Fritsch & Carlson, SIAM J. Numer. Anal. 17 (1980) 238-246). Throws std::invalid_argument.
  static TensionCurve through(const std::vector<double>& strain, const std::vector<double>& force);

  /// The same up to the end of its data, and beyond it with the slope that `other` has there. The way back ends where it began: cloth that
  /// is stretched further than its test is on its way up again. The force is continuous, its slope falls.
  TensionCurve continued_as(const TensionCurve& other) const;

  Value at(double green_strain) const;
  /// Smallest dS/dE over all E (N/m).
  double smallest_stiffness() const { return smallest_stiffness_; }
  /// Green strain where the curve goes over into its straight continuation.
  double data_end() const { return end_; }

 private:
  enum class Kind { linear, kes, cubic, points } kind_ = Kind::linear;
  struct Knot {
    double strain, energy, force, slope;  ///< 1, J/m2, N/m, N/m
  };
  std::vector<Knot> knots_;  ///< of a curve through points
  double p0_ = 0, p1_ = 0;  ///< kes: initial stiffness (N/m), a; cubic: k1, k3 (N/m)
  double end_ = 0;          ///< Green strain where the data ends
  Value at_end_{};
  double initial_stiffness_ = 0, smallest_stiffness_ = 0;

  TensionCurve(Kind kind, double p0, double p1, double data_end, std::vector<Knot> knots = {});
  /// Integral, value and slope of F over e.
  Value between_knots(double engineering_strain) const;
  Value inside(double green_strain) const;
};

/// a em of the exponential curve of that linearity, 0 < LT < 2: the x of TensionCurve::kes.
double exponent_of_linearity(double linearity);

/// Bending stiffness per width, N m.
struct BendingStiffness {
  double warp = 0.0, weft = 0.0;
  /// Of (2 k12): sqrt(B1 B2)/2, Huber's for an orthotropic sheet whose directions do not feel each other; KES has no test.
  double twist() const { return 0.5 * std::sqrt(warp * weft); }
};

/// W = f1(E11) + f2(E22) + c E11 E22 + G/2 (2 E12)^2 with c = poisson * min stiffness (convex).
struct Fabric {
  std::string name;
  TensionCurve warp, weft;
  double coupling = 0.0;       ///< c, N/m
  double shear = 0.0;          ///< G, N/m per rad
  BendingStiffness bending;    ///< 0 = not measured
  double areal_density = 0.0;  ///< kg/m2, 0 = not measured
  double thickness = 0.0;      ///< m
  std::optional<double> friction;  ///< coefficient of friction on skin, where it was measured
  std::string source;          ///< how each number was turned into SI

  /// The larger initial one of warp and weft, N/m.
  double stiffness() const { return std::max(warp.at(0.0).stiffness, weft.at(0.0).stiffness); }
  MembraneResponse unrelaxed(const Eigen::Vector3d& strain) const;
  /// W_used = (1 - eta) W_r + eta W; W_r(E) = min over A >= 0 of W(E + A) (relaxed energy, any convex W):
  /// the sheet may shorten by wrinkles at no cost. Force continuous, tangent consistent and positive semidefinite.
  /// `state` is that of W_r. Source: Pipkin, IMA J. Appl. Math. 36 (1986) 85-99.
  MembraneResponse relaxed(const Eigen::Vector3d& strain, double eta) const;
};

/// What a fabric without a weight or a bending stiffness of its own is taken to have: the medians of the eight fabrics of the
/// wear trial, 0.25 kg/m2 and a bending length (B / (weight g))^(1/3) of 12 mm (theirs: 9.8 to 17 mm).
Fabric with_usual_sheet(Fabric fabric);

/// Shipped fabric (materials/data/fabrics.toml) or inline table, on one of its branches. Throws input::InputError with the nearest known
/// name, and where the unloading branch is asked for and was not measured.
Fabric find_fabric(const input::MaterialEntry& asked, input::FabricBranch branch = input::FabricBranch::loading);
/// The fabric as a table of its values in SI, which reads back to the same. The entry has been found before.
input::Table written_out_fabric(const input::MaterialEntry& asked);
std::vector<std::string> fabric_names();

}  // namespace snug::materials
