// A flat piece of a pattern as it is cut, seen from the outside of the garment.
#pragma once

#include <Eigen/Geometry>

#include <optional>
#include <string>
#include <vector>

#include "cases/input/material_entry.hpp"
#include "mesh/pattern/curve.hpp"

namespace snug::mesh {

/// A named way along the border of a piece, or an inner line.
struct PieceEdge {
  std::string name;
  Curve curve;
  input::Location where = {};
};

/// Consecutive edges of a piece that close: [begin, end) of its edges.
struct Loop {
  int begin = 0, end = 0;
  std::string name = {};  ///< of a hole
};

/// A mark on an edge. Notches of one name on the two sides of a seam meet when it is sewn.
struct Notch {
  std::string name;
  int edge = 0;
  double share = 0.0;  ///< of the edge's length
  input::Location where = {};
};

/// Where a format puts a piece in space before it is sewn: x = rotation (p, 0) + translation, m, in the frame of the
/// file. The outside of the cloth looks along the third column of the rotation.
struct GivenPlace {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

struct Piece {
  std::string name;
  /// Border: the outline first, counter-clockwise, then the holes, clockwise; the cloth is on the left of all of them.
  std::vector<PieceEdge> edges;
  std::vector<Loop> loops;
  std::vector<Notch> notches;
  std::vector<PieceEdge> lines;                ///< drawn on the piece, without effect
  Eigen::Vector2d grain = {0.0, 1.0};          ///< unit direction of the warp (grain line, wales)
  std::optional<input::MaterialEntry> fabric;  ///< where it is not the pattern's
  std::optional<GivenPlace> place;
  bool from_inside = false;  ///< the file draws it from the other side: x has changed its sign
  input::Location where = {};

  /// Index of an edge by its name, -1: none.
  int find(const std::string& edge) const;
  const Loop& loop_of(int edge) const;
  int next(int edge) const;  ///< along its loop
  int previous(int edge) const;
};

/// m2, holes taken off.
double area(const Piece& piece);
/// Smallest box with all edges.
Eigen::AlignedBox2d box(const Piece& piece);
/// rad, in [0, 2 pi): angle inside the cloth where an edge begins and its predecessor ends.
double corner_angle(const Piece& piece, int edge);

/// The piece seen from its other side: x changes its sign, its edges keep their order and direction, so that its loops
/// run the other way round. Gives the image of its grain, lines and place, too.
Piece flipped(const Piece& piece);
/// Its loops walked the other way, from the last edge to the first; nothing else changes.
Piece turned_round(const Piece& piece);
/// The piece stretched along its x and y.
Piece scaled(const Piece& piece, double across, double along);

}  // namespace snug::mesh
