// The garment as a tension-field membrane on its flat pattern, tightened by metric homotopy.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "materials/fabric/fabric.hpp"
#include "mesh/garment/garment_mesh.hpp"
#include "solver/terms/garment_shape.hpp"
#include "solver/terms/membrane_kernel.hpp"
#include "solver/terms/term.hpp"

namespace snug::solver {

/// Metric homotopy: with F0 = grad x_placed = R U0 on the pattern and U0 = sum l_i e_i e_i^T (l clipped to [0.3, 3]),
///   H(s) = sum l_i^(1-s) m_i^s e_i e_i^T,   F_e = F H(s)^-1,   dA_rest = det H(s) dA_pattern.
/// m_i = 1: at s = 1 the rest metric is exactly the pattern's. On a tube that is knitted round (mesh.course) the pattern is that of its courses:
/// F0 and F take their gradients along the lengths of the cloth at rest, (x course, y), and dA_pattern is its area. With a `prestretch` p, m_i = l_i / p: the rest shape is the
/// placed shape shrunk by p (verification cases whose rest shape is not flat).
class FabricMembrane : public Term {
 public:
  /// `fabrics`: the garment's own, then those of its zones.
  FabricMembrane(std::string garment, const Field& positions, const mesh::GarmentMesh& mesh, std::vector<materials::Fabric> fabrics,
                 std::optional<double> prestretch = {});

  static std::string name_of(const std::string& garment) { return "fabric of " + garment; }
  std::string name() const override { return name_of(garment_); }
  const ElementEntries& entries(const State&) const override { return entries_; }
  double energy(const State& state) const override;
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  void measure(const State& state, Measure& measure) const override;
  double step_bound(const State& state, const Eigen::VectorXd& direction, double limit) const override;
  /// Stiffness over the mean edge squared times the area of the node: slack cloth has no stiffness of its own.
  void damp(Eigen::VectorXd& weights) const override;
  /// Forces, stretches and state of the triangles, and their area ratio.
  void publish(const State& state, PublishedFields& fields) const override;

  /// Residual compressive stiffness eta of the relaxed energy at load s: 1e-2 at the start, `final_eta` at s = 1. Without
  /// one a sleeve that is free along its axis stands on the kink between taut and wrinkled, and Newton finds no rest.
  double eta(double load) const;
  void set_final_eta(double eta) { final_eta_ = eta; }

  /// Averages over a triangle: Cauchy forces per current length (N/m) along warp, weft and shear, stretches, state.
  struct Summary {
    double tension_warp = 0, tension_weft = 0, shear = 0, stretch_warp = 0, stretch_weft = 0, wrinkled = 0, area_ratio = 1;
  };
  Summary summary(const State& state, int triangle) const;
  int triangles() const { return static_cast<int>(elements_.size()); }
  /// Current area over pattern area at the area coordinates L of a triangle.
  double area_ratio(const State& state, int triangle, const Eigen::Vector3d& L) const;
  double pattern_area(int triangle) const { return elements_[triangle].area; }

  /// N, on the nodes of a triangle: the derivative of its energy by their places.
  NodeVectors<6> nodal_forces(const State& state, int triangle) const;

  /// What a side of a triangle (0: vertices 0 and 1, …) transmits to the cloth beyond it, from the stress at it.
  struct SideForce {
    double length = 0.0;    ///< m, as worn
    Eigen::Vector3d out = Eigen::Vector3d::Zero();  ///< m, the normals of the side in the cloth, out of the triangle, times its length
    double along = 0.0;     ///< N, amount along the side
    double largest = 0.0;   ///< N/m, across, at a point
  };
  SideForce side_force(const State& state, const mesh::GarmentMesh& mesh, int triangle, int side) const;

 private:
  struct Point {
    Eigen::Matrix<double, 2, 6> gradient;  ///< grad N_a on the pattern, 1/m
    double weight = 0.0;                   ///< pattern area, m2
    Eigen::Matrix2d axes;                  ///< eigenvectors of U0
    Eigen::Vector2d log_placed, log_rest;  ///< ln l_i, ln m_i
  };
  struct Element {
    std::array<int, 6> nodes;              ///< representative nodes
    Eigen::Matrix<double, 2, 6> pattern;   ///< nodes on the pattern, m
    Eigen::Matrix<double, 1, 6> course;    ///< of the nodes (mesh.course)
    double area = 0.0;                     ///< on the pattern, m2
    int fabric = 0;
    Eigen::Matrix2d frame;                 ///< columns: warp, weft on the pattern
    std::vector<Point> points;
  };
  NodeVectors<6> positions(const State& state, const Element& element) const;
  static Derivatives<6> derivatives(const Element& element, const Point& point, double load, double& rest_weight);
  Point point_at(const Element& element, const NodeVectors<6>& placed, const TrianglePoint& q) const;

  std::string garment_;
  Field field_;
  std::vector<materials::Fabric> fabrics_;
  std::optional<double> prestretch_;
  int order_;                              ///< of the triangles
  double mean_edge_;                       ///< m
  std::vector<Element> elements_;
  ElementEntries entries_;
  double final_eta_ = 1e-3;
};

}  // namespace snug::solver
