// A thin elastic shell as a body, on an elastic foundation where it has one.
#pragma once

#include <Eigen/Core>

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "cases/input/diagnostics.hpp"
#include "mesh/body/body_mesh.hpp"
#include "solver/terms/membrane_kernel.hpp"
#include "solver/terms/shell_kernel.hpp"
#include "solver/terms/term.hpp"

namespace snug::solver {

/// Isotropic constants of a layer of the shell.
struct ShellElasticity {
  double youngs_modulus = 0.0;  ///< Pa
  double poisson_ratio = 0.0;
};

/// Edges of a shell that keep their angle because rotations are held at both ends, by their corner nodes, lower number first.
std::vector<std::pair<int, int>> clamped_edges(const mesh::BodyMesh& mesh);

/// Energy of the triangles (membrane, bending, foundation k/2 int (u . N)^2 dA with the reference normal N) and of the
/// edges between them. Source: see shell_kernel.hpp. Edges on which the rotation is held keep their angle to the
/// reference; other free edges are hinges.
class Shell : public Term {
 public:
  /// `elasticity`: one a layer of the mesh. Throws input::InputError at `where` when three triangles share an edge, or a
  /// rotation that is no turn about the normal is held at a node but along none of its edges.
  Shell(const Field& positions, const mesh::BodyMesh& mesh, std::vector<ShellElasticity> elasticity, input::Location where = {});

  std::string name() const override { return "shell"; }
  const ElementEntries& entries(const State&) const override { return entries_; }
  bool bends() const override { return true; }
  double energy(const State& state) const override;
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  double step_bound(const State& state, const Eigen::VectorXd& direction, double limit) const override;

  /// The stress of top, middle and bottom: averages over the triangles of a node.
  void publish(const State& state, PublishedFields& fields) const override;

  /// Cauchy stresses (xx yy zz xy yz xz, Pa) at the six nodes of a triangle, at `height` times half the thickness along the
  /// normal (-1, 0, 1); the thickness stays what it is.
  Eigen::Matrix<double, 6, 6> nodal_stress(const State& state, int triangle, double height) const;
  /// Forces of the springs on the shell, N, one a node of the body.
  std::vector<Eigen::Vector3d> foundation_forces(const State& state) const;
  int triangles() const { return static_cast<int>(triangles_.size()); }

 private:
  struct Point {
    TrianglePlace place;
    Derivatives<6> frame_gradient;      ///< along an orthonormal frame of the reference, 1/m
    Eigen::Matrix<double, 6, 1> N;
    Eigen::Vector3d normal, reference_b;
    Eigen::Matrix3d bending;            ///< h^3/12 C along the coordinates (11, 22, 12), N m
    double weight = 0.0;                ///< reference area, m2
  };
  struct Triangle {
    std::array<int, 6> nodes;
    Eigen::Matrix3d membrane;           ///< h C in the orthonormal frame, N/m
    double thickness = 0.0, foundation = 0.0;
    ShellElasticity elasticity;
    std::vector<Point> points;
  };

  void add_triangle(const mesh::ShellTriangle& given, const ShellElasticity& elasticity);
  void add_edges(const mesh::BodyMesh& mesh);
  void add_edge(const std::vector<std::pair<int, int>>& sides);
  void check_rotations(const mesh::BodyMesh& mesh, const std::map<int, std::set<int>>& held, const std::set<int>& used) const;
  TriangleNodes positions(const State& state, int triangle) const;
  TriangleNodes reference(int triangle) const;
  void add_point(const TriangleNodes& x, const TriangleNodes& X, const Triangle& triangle, const Point& point, bool tangent,
                 MembraneElement<6>& element) const;
  std::vector<postproc::Stress> averaged_stress(const State& state, double height) const;
  EdgeElement edge_element(const State& state, const EdgeSides& edge, bool tangent) const;

  Field field_;
  input::Location where_;
  std::vector<Eigen::Vector3d> reference_;
  std::vector<Triangle> triangles_;
  std::vector<EdgeSides> edges_;
  ElementEntries entries_;  ///< triangles first, then edges
};

}  // namespace snug::solver
