// Rational W surfaces: one patch of a rational B-spline (NURBS) surface.
#pragma once

#include <Eigen/Core>

#include "mesh/curves/segment_knots.hpp"

namespace snug::mesh::curves {

/// A point of a surface with its derivatives up to the second.
struct SurfacePoint {
  Eigen::Vector3d x, x_u, x_v, x_uu, x_uv, x_vv;

  /// Unit normal along x_u × x_v. Throws std::domain_error where the two are parallel (a pole, a collapsed edge).
  Eigen::Vector3d normal() const;
  /// Principal curvatures, the greater first, positive where the surface bends towards the normal. Throws as `normal`.
  Eigen::Vector2d curvatures() const;
};

/// R(u, v) = sum w_ij P_ij G_i(u) H_j(v) / sum w_ij G_i(u) H_j(v) (3.14). u and v are stepped one after the other: the
/// source steps both at once (3.15), (3.16), which comes to an end for equal degrees only.
class WSurface {
 public:
  /// `points`: 3 rows, column i (m + 1) + j for the control point i of n + 1 along u and j of m + 1 along v; `weights`
  /// positive, in the same order. Throws std::invalid_argument otherwise.
  WSurface(SegmentKnots u, SegmentKnots v, const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights);
  WSurface(SegmentKnots u, SegmentKnots v, const Eigen::Matrix3Xd& points);

  const SegmentKnots& u_knots() const { return u_; }
  const SegmentKnots& v_knots() const { return v_; }
  Eigen::Matrix3Xd points() const;
  Eigen::VectorXd weights() const { return homogeneous_.row(3); }

  Eigen::Vector3d point(double u, double v) const;
  SurfacePoint derivatives(double u, double v) const;

  /// What remains after k steps of u at `eps` and l steps of v at `eta`: a member of the family whose envelope this
  /// surface is (3.17); it touches at (eps, eta) with (n-k)/n and (m-l)/m of this surface's derivatives. k = n-1, l =
  /// m-1 are ruled surfaces.
  WSurface stepped(int k, int l, double eps, double eta) const;

  /// The same surface by other knots of its degrees. Throws as WCurve::with_knots.
  WSurface with_knots(const SegmentKnots& u, const SegmentKnots& v) const;
  /// By Bézier knots on its whole domain: n - i steps at the start of u and i at its end, m - j at the start of v and j
  /// at its end give the homogeneous point (i, j) (3.18), (3.19).
  WSurface bezier() const;

 private:
  using Homogeneous = Eigen::Matrix4Xd;
  WSurface(Homogeneous homogeneous, SegmentKnots u, SegmentKnots v);
  int across() const { return v_.degree() + 1; }
  Eigen::Vector4d sum(const Bases& g, const Bases& h) const;

  SegmentKnots u_, v_;
  Homogeneous homogeneous_;  // (w P, w)
};

}  // namespace snug::mesh::curves
