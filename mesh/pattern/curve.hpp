// Plane curves of pattern pieces: spans one after the other, measured by arc length.
#pragma once

#include <Eigen/Geometry>

#include <utility>
#include <variant>
#include <vector>

namespace snug::mesh {

struct Line {
  Eigen::Vector2d from, to;
};
/// Bezier curve with one control point.
struct Quadratic {
  Eigen::Vector2d from, control, to;
};
/// Bezier curve with two control points.
struct Cubic {
  Eigen::Vector2d from, first, second, to;
};
/// centre + u cos(angle) + v sin(angle). A circle has u and v of one length and at a right angle; an affine map, which
/// grading is, makes an ellipse of it.
struct Arc {
  Eigen::Vector2d centre, u, v;
  double from = 0.0, to = 0.0;  ///< rad
};

using Span = std::variant<Line, Quadratic, Cubic, Arc>;

/// The circle's arc from one point to another through a third; a line where the three stand in one.
Span arc_through(const Eigen::Vector2d& from, const Eigen::Vector2d& through, const Eigen::Vector2d& to);
/// The arc of a circle of this radius (m; at least half the chord): `large`: more than half a turn; `left`: it turns
/// left, counter-clockwise, on its way.
Span arc_of_radius(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double radius, bool large, bool left);

/// At t in [0, 1].
Eigen::Vector2d at(const Span& span, double t);
Eigen::Vector2d derivative(const Span& span, double t);

/// A curve without gaps between its spans. Coordinates in m.
struct Curve {
  std::vector<Span> spans;

  Eigen::Vector2d begin() const { return at(spans.front(), 0.0); }
  Eigen::Vector2d end() const { return at(spans.back(), 1.0); }
  /// Unit directions in which it starts and arrives; that of its chord where the derivative vanishes there.
  Eigen::Vector2d first_direction() const;
  Eigen::Vector2d last_direction() const;
};

/// The same way, walked from its end.
Curve reversed(const Curve& curve);
/// Its image; exact, whatever the map.
Curve mapped(const Curve& curve, const Eigen::Affine2d& map);

/// Spans that formats without arcs know: an arc becomes cubic Bezier curves of a sixteenth of a turn at most, which are
/// off by 7e-8 of its half-axes.
std::vector<Span> without_arcs(const Curve& curve);

/// Points on the curve, both ends among them, between which it stays within `tolerance` (m) of its chords.
std::vector<Eigen::Vector2d> flattened(const Curve& curve, double tolerance);

/// The part of the plane on the left of the curve, counted from the origin: half the integral of x dy - y dx, m2. The
/// sum over a closed outline is its area, positive when it runs counter-clockwise.
double swept_area(const Curve& curve);

/// Arc length along a curve and its inverse, by Gauss's rule on panels; round-off for what has no cusps.
class ArcLength {
 public:
  explicit ArcLength(const Curve& curve);

  double length() const { return panels_.back().after; }  ///< m
  /// The point at a share of the length in [0, 1].
  Eigen::Vector2d at(double share) const;
  /// The stretch between two shares of the length, from < to; exactly the same curve.
  Curve between(double from, double to) const;
  /// Share of the length at which the curve comes nearest to a point.
  double nearest(const Eigen::Vector2d& point) const;

 private:
  struct Panel {
    int span = 0;
    double from = 0.0, to = 0.0;       // of the span's parameter
    double before = 0.0, after = 0.0;  // m, along the curve
  };
  const Panel& panel_at(double length) const;
  std::pair<int, double> parameter_at(double share) const;  // span and its t

  Curve curve_;
  std::vector<Panel> panels_;
};

}  // namespace snug::mesh
