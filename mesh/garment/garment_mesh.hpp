// The garment: P2 triangles on flat pattern pieces, sewn by merging nodes, placed round the body.
#pragma once

#include <Eigen/Core>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "mesh/body/limb.hpp"
#include "mesh/garment/garment_fit.hpp"

namespace snug::mesh {

/// Nodes of two sides of a seam that become one, in order along it, mid-edge nodes too.
struct SewnSeam {
  std::string name;
  std::vector<std::array<int, 2>> pairs;
};

struct GarmentMesh {
  std::string name = "garment";
  std::vector<Eigen::Vector2d> pattern;  ///< nodes on the flat pieces, m; both sides of a seam have nodes of their own
  std::vector<Eigen::Vector3d> placed;   ///< placed round the body, m, frame of the body; equal on merged nodes
  std::vector<std::array<int, 6>> triangles;  ///< vertices 0 1 2, then mid-edge nodes 01, 12, 20; counter-clockwise
                                              ///< in the pattern and seen from outside the body when placed
  std::vector<int> merged;                    ///< node -> representative node (itself when not sewn)
  std::vector<Eigen::Vector2d> warp;          ///< per triangle: unit warp direction in the pattern plane
  std::map<std::string, std::vector<int>>
      edges;               ///< named edges ("upper", "lower"): representative nodes, mid-edge nodes too
  double mean_edge = 0.0;  ///< m, in the pattern
  std::vector<std::string> pieces;   ///< of a pattern, or zones of a tube; a tube without zones: one
  std::vector<int> triangle_piece;   ///< per triangle; empty: all are of the first
  std::vector<int> triangle_zone;    ///< per triangle: index into the garment's zones (input::GarmentSpec::zone), -1: in none; empty: all are in none
  std::vector<SewnSeam> seams;
  /// Per pattern node: length of a course (along x) at rest over that on the pattern. Tubes that are knitted round have courses of other lengths than
  /// a flat piece can; empty: 1 everywhere.
  std::vector<double> course;
  /// m, how far off the skin the garment is placed at most because it is wider than the body there; 0: nowhere.
  double stand_off = 0.0;
  /// 2: quadratic triangles. 1: linear triangles, for comparison: mid-edge nodes carry no unknowns and follow their edge.
  int order = 2;
  GarmentFit fit = {};

  int piece_of(std::size_t triangle) const { return triangle_piece.empty() ? 0 : triangle_piece[triangle]; }
  int zone_of(std::size_t triangle) const { return triangle_zone.empty() ? -1 : triangle_zone[triangle]; }
  /// Of its six nodes.
  Eigen::Matrix<double, 1, 6> course_of(std::size_t triangle) const;
  /// m2, of the cloth at rest between its vertices.
  double cut_area(std::size_t triangle) const;
};

/// Of a garment that is a tube.
GarmentFit tube_fit(const input::GarmentSpec& spec);

/// Meshes a tube with gmsh (irregular triangles, equal divisions along both sides of the seam) and wraps it round
/// the limb with its seam at the inner side (turn 0.5), lifted to `lift` off the skin along its normal. Edges are about
/// `worn_size` (m) on the garment as it is worn, stretched round the limb, or `spec.cell_size` on the pattern where the
/// case gives one. At heights where it is longer than the skin so lifted it is placed at its own size instead, on the curve
/// parallel to the skin that is as long. A graduated tube is meshed on a rectangle of its mean circumference and has the lengths of its courses
/// in `course`; borders of zones are sides of triangles. Throws input::InputError when the garment does not fit between the cut planes or a size is not positive.
GarmentMesh make_tube_mesh(const input::GarmentSpec& spec, const Limb& limb, double worn_size, double lift = 2e-4);

}  // namespace snug::mesh
