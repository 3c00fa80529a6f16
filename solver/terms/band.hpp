// An elastic band along an edge of a garment.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesh/garment/garment_mesh.hpp"
#include "solver/terms/contact_slave.hpp"
#include "solver/terms/term.hpp"

namespace snug::solver {

/// Length of an edge of a garment on its pattern, m; both sides of a seam count where both are of that edge. Throws
/// std::out_of_range where the garment has no such edge.
double edge_length(const mesh::GarmentMesh& garment, const std::string& edge);

/// Lets the garment bear on what it meets with a strip of that width (m) along the edge: the weighted gaps of its contact have the
/// line int Phi_i g b ds beside the area. Without it a band that presses like a line would pull the edge's middle nodes through
/// the skin: multipliers on vertices weigh the gap of the triangles beside the edge alone. The edge's multipliers weigh the line together with
/// half a cell beside it, so that the edge sinks in by what that half stands off: with the square of the cells, and the more the narrower the band.
void bear_along(const mesh::GarmentMesh& garment, const std::string& edge, double width, ContactSlave& slave);

/// Line elements on the sides of the triangles along the edge (quadratic like these). With the stretch l = |dx| / dL(s),
///   W = sum of EA/2 <l - 1>^2 dL(s),   tension T = EA <l - 1>,   <a> = max(a, 0): a band bears no compression.
/// Its rest length follows the way of the fabric's metric: dL(s) = dL_placed^(1-s) dL_rest^s, point by point, from the placed
/// edge to the edge on the pattern times rest length over pattern length.
class Band : public Term {
 public:
  /// `stiffness` EA, N (force at a strain of 1); `rest_length`, m, of the whole edge. Throws std::out_of_range where the
  /// garment has no such edge.
  Band(const mesh::GarmentMesh& garment, const std::string& edge, const Field& positions, double stiffness, double rest_length);

  std::string name() const override { return "band of " + garment_ + ", " + edge_; }
  const ElementEntries& entries(const State&) const override { return entries_; }
  double energy(const State& state) const override;
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;

  const std::string& garment() const { return garment_; }
  const std::string& edge() const { return edge_; }
  double stiffness() const { return stiffness_; }
  double rest_length() const { return rest_length_; }
  /// The band as worn. What it presses with along its line is its tension times its curvature: over the whole band, mean
  /// tension times the angle that its tangent turns by, over its length.
  struct Worn {
    double length = 0.0;                                 ///< m
    double tension = 0.0, least = 0.0, largest = 0.0;    ///< N, mean over its length and extremes
    double turn = 0.0;                                   ///< rad
    double line_load() const { return tension * turn / length; }  ///< N/m
  };
  Worn worn(const State& state) const;

 private:
  struct Point {
    Eigen::Vector3d slope;                    ///< dN_a / dxi
    double log_placed = 0.0, log_rest = 0.0;  ///< ln of dL/dxi
    double weight = 0.0;                      ///< of the rule
  };
  struct Element {
    std::array<int, 3> nodes;                 ///< vertex, middle, vertex; representatives
    std::vector<Point> points;
  };
  Eigen::Matrix3d positions(const State& state, const Element& element) const;
  static double rest(const Point& point, double load);
  double turn(const State& state) const;

  std::string garment_, edge_;
  Field field_;
  double stiffness_, rest_length_;
  int order_;
  std::vector<Element> elements_;
  ElementEntries entries_;
};

}  // namespace snug::solver
