// The kernel of a thin elastic shell on quadratic triangles: bending of a point and the angle between two triangles.
//
// Kirchhoff-Love with Koiter's energy, h/2 E:C:E + h^3/24 K:C:K, E = (a - A)/2, K = b - B: change of the first and second
// fundamental forms along the triangle's own coordinates, C of plane stress with the reference metric (Ciarlet, An
// Introduction to Differential Geometry, 2005, sec. 4.1). Triangles are joined by the C0 interior penalty method, with the
// angle between neighbours measured from its reference value, so that the reference may be curved or have edges.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

#include "solver/terms/membrane_kernel.hpp"

namespace snug::solver {

using TriangleNodes = Eigen::Matrix<double, 3, 6>;

/// A point of a triangle: derivatives of its shape functions along its coordinates (11, 22, 12 for the second ones).
struct TrianglePlace {
  Eigen::Matrix<double, 6, 1> N;
  Eigen::Matrix<double, 6, 2> dN;
  Eigen::Matrix<double, 6, 3> ddN;
};
TrianglePlace triangle_place(const Eigen::Vector2d& xi);

/// First and second fundamental form with what their derivatives need.
struct ShellPoint {
  Eigen::Matrix<double, 3, 2> tangent;
  Eigen::Vector3d normal;
  double area = 0.0;                   ///< |t1 x t2|
  Eigen::Matrix<double, 3, 6> gradient;  ///< g_a = sum_c N_a,c t^c, surface gradients
  Eigen::Vector3d b;                   ///< n . x_,11, n . x_,22, n . x_,12
  Eigen::Matrix<double, 6, 3> c;       ///< db_I/dx_a = c_aI n: N_a,I - Gamma^c_I N_a,c
};
ShellPoint shell_point(const TriangleNodes& x, const TrianglePlace& place);

/// Adds sum_I mu_I d2 b_I to an 18 x 18 block (leading dimension and node places by `at`):
///   d2 b_I(a, b) = -c_aI g_b n' - c_bI n g_a' - b_I (g_a . g_b) n n'.
void add_second_form_hessian(const ShellPoint& p, const Eigen::Vector3d& mu, const std::array<int, 6>& at,
                             Eigen::Ref<Eigen::MatrixXd> matrix);

/// Adds weight times  (b - B).Q.(b - B)/2  and its derivatives, Q a stiffness (N m) along the coordinates (11, 22, 12).
/// Without its `geometric` part, which may be indefinite, the tangent is positive semidefinite.
void add_bending_point(const ShellPoint& p, const Eigen::Vector3d& reference_b, const Eigen::Matrix3d& Q, double weight,
                       bool tangent, bool geometric, MembraneElement<6>& element);

/// Three points, exact to degree 2, which do not lock (see the definition); weights add up to 1/2.
struct BendingRulePoint {
  Eigen::Vector2d xi;
  double weight = 0.0;
};
const std::vector<BendingRulePoint>& bending_rule();

/// Plane stress stiffness per E/(1 - nu^2) along the coordinates, for strains (11, 22, 2 x 12): (1 - nu)/2
/// (A^ac A^bd + A^ad A^bc) + nu A^ab A^cd.
Eigen::Matrix3d plane_stress(double poisson_ratio, const Eigen::Matrix2d& inverse_metric);

/// One side of an edge at a point of it.
struct EdgeSide {
  TrianglePlace place;
  Eigen::Vector2d along;       ///< the edge's direction in the triangle's coordinates, dx/ds = sum along_c t_c
  Eigen::Vector3d moment;      ///< mu with m = mu . (b - B): bending moment per length about the edge
  Eigen::Vector3d reference_b; ///< B
};

/// The angle between the normals of two sides about the edge, from the second to the first, or from a fixed normal.
struct EdgePoint {
  std::array<EdgeSide, 2> side;
  Eigen::Vector3d fixed_normal = Eigen::Vector3d::Zero();  ///< of a clamped edge, which has one side
  double reference_angle = 0.0;
  double weight = 0.0;   ///< m of the reference edge
  double penalty = 0.0;  ///< N (moment per length and angle)
};

/// Energy, gradient and second derivative of  w (mean m (theta - Theta) + p/2 (theta - Theta)^2)  at an edge point; `at[s]`
/// are the places of the side's nodes in the element. One side: m is its own. Douglas et al. (C0 interior penalty:
/// Brenner & Sung, J. Sci. Comput. 22 (2005), eq. 3.8) with normals that turn instead of slopes.
struct EdgeElement {
  double energy = 0.0;
  Eigen::VectorXd residual;
  Eigen::MatrixXd matrix;
  explicit EdgeElement(int size) : residual(Eigen::VectorXd::Zero(size)), matrix(Eigen::MatrixXd::Zero(size, size)) {}
};
void add_edge_point(const std::vector<TriangleNodes>& x, const EdgePoint& point, const std::vector<std::array<int, 6>>& at,
                    bool tangent, bool geometric, EdgeElement& element);

/// The angle itself.
double edge_angle(const std::vector<TriangleNodes>& x, const EdgePoint& point);

/// Corners and middle of each edge of a triangle, turning with it.
inline constexpr std::array<std::array<int, 3>, 3> triangle_edges = {{{0, 1, 3}, {1, 2, 4}, {2, 0, 5}}};
/// Place of a node (corners, then middles) on the reference triangle.
Eigen::Vector2d triangle_node(int a);

/// An edge as an element: one or two triangles that turn the same way, so that the second runs the edge backwards.
struct EdgeSides {
  std::vector<int> triangles;
  std::vector<std::array<int, 6>> at;  ///< places of their nodes in the element
  std::vector<int> nodes;              ///< of the element
  std::vector<EdgePoint> points;

  /// Takes a triangle with these nodes in.
  void add(int triangle, const std::array<int, 6>& triangle_nodes);
};

/// The places of a side at Gauss point `q` of 3 along the edge `edge` of its triangle; `second`: it runs backwards.
struct EdgePlace {
  TrianglePlace place;
  Eigen::Vector2d along;
};
EdgePlace edge_place(int edge, int q, bool second);
/// Weight of Gauss point q; they add up to 1.
double edge_weight(int q);

/// Penalty (N, moment per length and angle) that keeps the energy of flat triangles positive for every jump: a side's
/// `stiffness` across the edge (N m), the edge's length and the triangle's area; `share`: 1/2 inside, 1 on a clamped edge.
double edge_penalty(double share, double stiffness, double length, double area);

}  // namespace snug::solver
