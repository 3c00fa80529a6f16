#include "mesh/particles/bending_patch.hpp"

#include <Eigen/Dense>

#include <cmath>
#include <map>
#include <utility>

namespace snug::mesh {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Of a point in the plane of a triangle.
std::array<double, 3> barycentric(const FlatTriangle& t, const Vector2d& p) {
  const std::array<Vector2d, 3> slopes = t.gradients();
  std::array<double, 3> shares{};
  for (int a = 0; a < 3; ++a) shares[a] = slopes[a].dot(p - t.flat[a]) + 1.0;
  return shares;
}

/// The corners across the other sides of a neighbour of triangle t, where it lies in the plane of t.
void add_beyond(const std::vector<FlatTriangle>& triangles, const std::vector<std::vector<Neighbour>>& beside, int t,
                const Neighbour& first, std::vector<Neighbour>& into) {
  constexpr double weight = 0.1;
  const FlatTriangle &mine = triangles[t], &between = triangles[first.triangle];
  std::array<Vector2d, 3> corners;  // of the neighbour, in the plane of t
  for (int a = 0; a < 3; ++a) {
    corners[a] = first.flat;
    for (int b = 0; b < 3; ++b)
      if (between.particles[a] == mine.particles[b]) corners[a] = mine.flat[b];
  }
  for (const Neighbour& next : beside[first.triangle]) {
    if (next.triangle == t) continue;
    const std::array<double, 3> shares = barycentric(between, next.flat);
    into.push_back({next.particle, next.triangle,
                    shares[0] * corners[0] + shares[1] * corners[1] + shares[2] * corners[2], weight});
  }
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
        {other.particles[(there.first + 2) % 3], there.triangle, begin + share * way + off * outwards, 1.0});
  };
  for (const auto& [ends, of] : sides)
    if (of.size() == 2) unfold(of[0], of[1]), unfold(of[1], of[0]);
  const std::vector<std::vector<Neighbour>> beside = result;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (beside[t].size() < 3)
      for (const Neighbour& first : beside[t]) add_beyond(triangles, beside, static_cast<int>(t), first, result[t]);
  return result;
}

std::vector<BendingPart> bending_parts(const FlatTriangle& triangle, const std::vector<Neighbour>& neighbours,
                                       double bending_warp, double bending_weft) {
  const auto count = static_cast<Eigen::Index>(neighbours.size());
  if (count == 0) return {};
  // How far a neighbour lies off the plane of the triangle by the second derivatives (11, 22, 12).
  MatrixXd by_curvature(count, 3);
  std::vector<std::vector<Weight>> off;
  Eigen::VectorXd weight(count);
  for (const Neighbour& neighbour : neighbours) {
    const std::array<double, 3> shares = barycentric(triangle, neighbour.flat);
    Eigen::Matrix2d second = neighbour.flat * neighbour.flat.transpose();
    const auto row = static_cast<Eigen::Index>(off.size());
    off.push_back({{neighbour.particle, 1.0}});
    for (int a = 0; a < 3; ++a) {
      second -= shares[a] * triangle.flat[a] * triangle.flat[a].transpose();
      off.back().push_back({triangle.particles[a], -shares[a]});
    }
    by_curvature.row(row) = Vector3d(0.5 * second(0, 0), 0.5 * second(1, 1), second(0, 1)).transpose();
    weight[row] = neighbour.weight;
  }
  const Vector3d stiffness =
      triangle.area() * Vector3d(bending_warp, bending_weft, 2.0 * std::sqrt(bending_warp * bending_weft));
  std::vector<BendingPart> parts;
  const auto add = [&](const Eigen::RowVectorXd& shares, double of) {
    BendingPart& part = parts.emplace_back();
    part.stiffness = of;
    for (Eigen::Index e = 0; e < count; ++e)
      for (const Weight& one : off[e]) part.weights.push_back({one.particle, shares[e] * one.weight});
  };
  // The least squares of all; six points on a conic, or fewer, do not tell a quadratic.
  constexpr double well_told = 0.02;
  const Eigen::JacobiSVD<MatrixXd> fit(weight.asDiagonal() * by_curvature, Eigen::ComputeThinU | Eigen::ComputeThinV);
  if (count >= 3 && fit.singularValues()[2] > well_told * fit.singularValues()[0]) {
    const MatrixXd told = fit.solve(MatrixXd(weight.asDiagonal()));
    for (int k = 0; k < 3; ++k) add(told.row(k), stiffness[k]);
    return parts;
  }
  // Least energy of all second derivatives with these distances: (H C^-1 H^T)^-1, of what the neighbours tell.
  const MatrixXd compliance = by_curvature * stiffness.cwiseInverse().asDiagonal() * by_curvature.transpose();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> own(compliance);
  constexpr double least_share = 1e-3;
  for (Eigen::Index k = 0; k < count; ++k)
    if (const double give = own.eigenvalues()[k]; give > least_share * own.eigenvalues()[count - 1])
      add(own.eigenvectors().col(k).transpose(), 1.0 / give);
  return parts;
}

}  // namespace snug::mesh
