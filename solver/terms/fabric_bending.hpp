// Bending of the garment: a thin sheet that is flat as cut, on the same quadratic triangles as its membrane.
#pragma once

#include <array>
#include <vector>

#include "materials/fabric/fabric.hpp"
#include "mesh/garment/garment_mesh.hpp"
#include "solver/terms/shell_kernel.hpp"
#include "solver/terms/term.hpp"

namespace snug::solver {

/// Energy  int (B1 k11^2 + B2 k22^2 + D (2 k12)^2)/2 dA  over the flat pattern with k = n . x_,ij, the second fundamental form
/// along warp and weft, and at each edge between two triangles, in a piece or across a seam, the angle between their normals
/// against the mean bending moment and a penalty (C0 interior penalty, see shell_kernel.hpp). The rest state is the flat
/// pattern, seams flat, too: a sewn tube is bent by its own roundness. Second forms are tensors and vanish on the pattern,
/// so that the triangle's own coordinates serve even where its edges are curved. Free edges and those that are held turn
/// freely; where more than two pieces meet at a seam, it is a hinge. Pieces of several fabrics bend each as its own; a seam between two has
/// the mean of their moments and of their penalties, so that the angle stays none there, too. Lengths at rest of a tube that is knitted round are
/// those of its courses. Gathered cloth resists here, too (materials/fabric/packing.hpp), since it is bending that draws slack cloth in: b falls
/// with the lengths.
class FabricBending : public Term {
 public:
  /// Takes quadratic triangles (mesh.order 2). `stiffness`: of the garment's own fabric, then of those of its zones. `in_plane`: N/m, of the
  /// same, for what gathered cloth resists with; empty: it does not.
  FabricBending(std::string garment, const Field& positions, const mesh::GarmentMesh& mesh, const std::vector<materials::BendingStiffness>& stiffness,
                std::vector<double> in_plane = {});

  std::string name() const override { return "bending of " + garment_; }
  const ElementEntries& entries(const State&) const override { return entries_; }
  bool bends() const override { return true; }
  double energy(const State& state) const override;
  /// Tangent::convex leaves out what turning normals and the push of gathered cloth add, which may be indefinite; the rest is positive for flat triangles.
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  double step_bound(const State& state, const Eigen::VectorXd& direction, double limit) const override;

 private:
  struct Point {
    TrianglePlace place;
    Eigen::Matrix3d stiffness;  ///< along the coordinates (11, 22, 12)
    double weight = 0.0;        ///< pattern area, m2
    Derivatives<6> gradient;    ///< grad N_a on the pattern, 1/m
  };
  struct Triangle {
    std::array<int, 6> nodes;              ///< representative nodes
    Eigen::Matrix<double, 2, 6> pattern;   ///< m
    Eigen::Matrix<double, 1, 6> course;    ///< of the nodes (mesh.course)
    Eigen::Matrix2d frame;                 ///< columns: warp, weft on the pattern
    int fabric = 0;
    double area = 0.0;
    std::vector<Point> points;

    /// Along (xi, eta), of the cloth at rest, m.
    Eigen::Matrix2d tangents(const TrianglePlace& place) const;
  };
  struct Slot;
  void add_triangle(const mesh::GarmentMesh& mesh, std::size_t triangle);
  void add_edges();
  void add_edge(const std::vector<std::array<int, 2>>& sides);
  void set_side(EdgePoint& point, int side, const std::array<int, 2>& at, int q) const;
  TriangleNodes positions(const State& state, int triangle) const;
  void add_point(const TriangleNodes& x, const Triangle& triangle, const Point& point, bool tangent, bool geometric, MembraneElement<6>& element) const;
  EdgeElement edge_element(const State& state, const EdgeSides& edge, Tangent tangent) const;

  std::string garment_;
  Field field_;
  std::vector<Eigen::Matrix3d> stiffness_;  ///< of the fabrics, along warp and weft, of (k11, k22, 2 k12)
  std::vector<double> in_plane_;            ///< N/m, of the fabrics, or empty
  std::vector<Triangle> triangles_;
  std::vector<EdgeSides> edges_;
  ElementEntries entries_;     ///< triangles first, then edges
};

}  // namespace snug::solver
