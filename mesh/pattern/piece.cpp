#include "mesh/pattern/piece.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace snug::mesh {

namespace {

using Eigen::Vector2d;

Piece image(const Piece& piece, const Eigen::Affine2d& map) {
  Piece result = piece;
  for (PieceEdge& edge : result.edges) edge.curve = mapped(edge.curve, map);
  for (PieceEdge& line : result.lines) line.curve = mapped(line.curve, map);
  result.grain = (map.linear() * piece.grain).normalized();
  return result;
}

}  // namespace

int Piece::find(const std::string& edge) const {
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].name == edge) return static_cast<int>(e);
  return -1;
}

const Loop& Piece::loop_of(int edge) const {
  return *std::find_if(loops.begin(), loops.end(), [&](const Loop& loop) { return edge < loop.end; });
}

int Piece::next(int edge) const {
  const Loop& loop = loop_of(edge);
  return edge + 1 < loop.end ? edge + 1 : loop.begin;
}

int Piece::previous(int edge) const {
  const Loop& loop = loop_of(edge);
  return edge > loop.begin ? edge - 1 : loop.end - 1;
}

double area(const Piece& piece) {
  double sum = 0.0;
  for (const PieceEdge& edge : piece.edges) sum += swept_area(edge.curve);
  return sum;
}

Eigen::AlignedBox2d box(const Piece& piece) {
  Eigen::AlignedBox2d result;
  for (const PieceEdge& edge : piece.edges)
    for (const Vector2d& point : flattened(edge.curve, 1e-4)) result.extend(point);
  return result;
}

double corner_angle(const Piece& piece, int edge) {
  const Vector2d back = -piece.edges[piece.previous(edge)].curve.last_direction(),
                 on = piece.edges[edge].curve.first_direction();
  const double angle = std::atan2(on.x() * back.y() - on.y() * back.x(), on.dot(back));
  return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
}

Piece flipped(const Piece& piece) {
  Eigen::Affine2d map = Eigen::Affine2d::Identity();
  map(0, 0) = -1.0;
  Piece result = image(piece, map);
  if (result.place) result.place->rotation = piece.place->rotation * Eigen::Vector3d(-1.0, 1.0, -1.0).asDiagonal();
  result.from_inside = !piece.from_inside;
  return result;
}

Piece turned_round(const Piece& piece) {
  Piece result = piece;
  std::vector<int> moved(piece.edges.size());
  for (const Loop& loop : piece.loops)
    for (int e = loop.begin; e < loop.end; ++e) {
      const int to = loop.begin + loop.end - 1 - e;
      moved[e] = to;
      result.edges[to] = piece.edges[e];
      result.edges[to].curve = reversed(piece.edges[e].curve);
    }
  for (Notch& notch : result.notches) notch.edge = moved[notch.edge], notch.share = 1.0 - notch.share;
  return result;
}

Piece scaled(const Piece& piece, double across, double along) {
  Eigen::Affine2d map = Eigen::Affine2d::Identity();
  map.linear() = Vector2d(across, along).asDiagonal();
  return image(piece, map);
}

}  // namespace snug::mesh
