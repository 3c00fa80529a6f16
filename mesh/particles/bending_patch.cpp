#include "mesh/particles/bending_patch.hpp"

#include <Eigen/Core>

#include <cmath>
#include <map>
#include <utility>

#include "mesh/surface/vectors.hpp"

namespace snug::mesh {

using Eigen::Vector2d;

namespace {

/// Of a point in the plane of a triangle.
std::array<double, 3> barycentric(const FlatTriangle& t, const Vector2d& p) {
  const std::array<Vector2d, 3> slopes = t.gradients();
  std::array<double, 3> shares{};
  for (int a = 0; a < 3; ++a) shares[a] = slopes[a].dot(p - t.flat[a]) + 1.0;
  return shares;
}

}  // namespace

double FlatTriangle::area() const { return 0.5 * cross(flat[1] - flat[0], flat[2] - flat[0]); }

std::array<Vector2d, 3> FlatTriangle::gradients() const {
  std::array<Vector2d, 3> slopes;
  for (int a = 0; a < 3; ++a) {
    const Vector2d across = flat[(a + 2) % 3] - flat[(a + 1) % 3];
    slopes[a] = Vector2d(-across.y(), across.x()) / (2.0 * area());
  }
  return slopes;
}

std::vector<std::vector<Neighbour>> neighbours_of(const std::vector<FlatTriangle>& triangles) {
  struct Side {
    int triangle, first;
  };
  std::map<std::pair<int, int>, std::vector<Side>> sides;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int a = 0; a < 3; ++a) {
      const int p = triangles[t].particles[a], q = triangles[t].particles[(a + 1) % 3];
      sides[std::minmax(p, q)].push_back({static_cast<int>(t), a});
    }
  std::vector<std::vector<Neighbour>> result(triangles.size());
  // Along a seam both sides have lengths of their own: places along it are shares of them.
  const auto unfold = [&](const Side& here, const Side& there) {
    const FlatTriangle &mine = triangles[here.triangle], &other = triangles[there.triangle];
    const Vector2d begin = mine.flat[here.first], way = mine.flat[(here.first + 1) % 3] - begin;
    const Vector2d top = other.flat[(there.first + 2) % 3];
    Vector2d from = other.flat[there.first], along = other.flat[(there.first + 1) % 3] - from;
    if (other.particles[there.first] != mine.particles[here.first]) from += along, along = -along;
    const double share = along.dot(top - from) / along.squaredNorm(),
                 off = std::abs(cross(along, top - from)) / along.norm();
    const Vector2d outwards = Vector2d(way.y(), -way.x()).normalized();
    result[here.triangle].push_back(
        {other.particles[(there.first + 2) % 3], here.first, begin + share * way + off * outwards});
  };
  for (const auto& [ends, of] : sides)
    if (of.size() == 2) unfold(of[0], of[1]), unfold(of[1], of[0]);
  return result;
}

std::vector<BendingPart> bending_parts(const FlatTriangle& triangle, const std::vector<Neighbour>& neighbours,
                                       double bending_warp, double bending_weft) {
  const double area = triangle.area();
  const std::array<double, 3> stiffness = {bending_warp, bending_weft, 2.0 * std::sqrt(bending_warp * bending_weft)};
  std::vector<BendingPart> parts(3);
  for (int k = 0; k < 3; ++k) parts[k].stiffness = area * stiffness[k];
  for (const Neighbour& neighbour : neighbours) {
    const Vector2d begin = triangle.flat[neighbour.side], way = triangle.flat[(neighbour.side + 1) % 3] - begin;
    const Vector2d normal = Vector2d(way.y(), -way.x()).normalized();
    // The jump of the slope times this is how far the neighbour lies off the plane of the triangle.
    const double high = normal.dot(neighbour.flat - begin), factor = way.norm() / (2.0 * area * high);
    const std::array<double, 3> shares = {normal.x() * normal.x(), normal.y() * normal.y(), normal.x() * normal.y()};
    const std::array<double, 3> plane = barycentric(triangle, neighbour.flat);
    for (int k = 0; k < 3; ++k) {
      parts[k].weights.push_back({neighbour.particle, factor * shares[k]});
      for (int a = 0; a < 3; ++a) parts[k].weights.push_back({triangle.particles[a], -factor * shares[k] * plane[a]});
    }
  }
  if (neighbours.empty()) parts.clear();
  return parts;
}

}  // namespace snug::mesh
