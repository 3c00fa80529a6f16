#include "mesh/garment/tube_pattern.hpp"

namespace snug::mesh {

CheckedPattern tube_pattern(const input::GarmentSpec& spec) {
  using Eigen::Vector2d;
  const double x = 0.5 * spec.pattern.flat_circumference, y = spec.pattern.length;
  const auto side = [&](const char* name, const Vector2d& from, const Vector2d& to) {
    return PieceEdge{name, Curve{{Line{from, to}}}, spec.where};
  };
  Piece piece;
  piece.name = "tube", piece.where = spec.where;
  piece.edges = {side("lower", {-x, 0.0}, {x, 0.0}), side("right", {x, 0.0}, {x, y}), side("upper", {x, y}, {-x, y}), side("left", {-x, y}, {-x, 0.0})};
  piece.loops = {{0, 4}};
  piece.grain = spec.warp == input::WarpDirection::around ? Vector2d(1.0, 0.0) : Vector2d(0.0, 1.0);
  Pattern pattern;
  pattern.title = spec.name, pattern.file = spec.pattern.where.file;
  pattern.pieces = {piece};
  pattern.seams = {{.name = "seam", .a = {{.piece = 0, .edge = 1}}, .b = {{.piece = 0, .edge = 3}}, .where = spec.where}};
  pattern.hems = {{.name = "lower", .edges = {{.piece = 0, .edge = 0}}, .where = spec.where}, {.name = "upper", .edges = {{.piece = 0, .edge = 2}}, .where = spec.where}};
  return checked(std::move(pattern));
}

}  // namespace snug::mesh
