#include "mesh/pattern/curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/surface/vectors.hpp"
#include "solver/fem/element.hpp"

namespace snug::mesh {

namespace {

using Eigen::Vector2d;

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

Span reversed(const Span& span) {
  return std::visit(Overloaded{[](const Line& s) -> Span {
                                 return Line{s.to, s.from};
                               },
                               [](const Quadratic& s) -> Span {
                                 return Quadratic{s.to, s.control, s.from};
                               },
                               [](const Cubic& s) -> Span {
                                 return Cubic{s.to, s.second, s.first, s.from};
                               },
                               [](const Arc& s) -> Span {
                                 return Arc{s.centre, s.u, s.v, s.to, s.from};
                               }},
                    span);
}

Span mapped(const Span& span, const Eigen::Affine2d& map) {
  return std::visit(Overloaded{[&](const Line& s) -> Span {
                                 return Line{map * s.from, map * s.to};
                               },
                               [&](const Quadratic& s) -> Span {
                                 return Quadratic{map * s.from, map * s.control, map * s.to};
                               },
                               [&](const Cubic& s) -> Span {
                                 return Cubic{map * s.from, map * s.first, map * s.second, map * s.to};
                               },
                               [&](const Arc& s) -> Span {
                                 return Arc{map * s.centre, map.linear() * s.u, map.linear() * s.v, s.from, s.to};
                               }},
                    span);
}

/// The span between two parameters: control points by the blossom of its polynomial.
Span part(const Span& span, double a, double b) {
  const auto mix = [](const Vector2d& p, const Vector2d& q, double t) -> Vector2d { return (1.0 - t) * p + t * q; };
  return std::visit(
      Overloaded{[&](const Line& s) -> Span {
                   return Line{mix(s.from, s.to, a), mix(s.from, s.to, b)};
                 },
                 [&](const Quadratic& s) -> Span {
                   const auto blossom = [&](double t, double u) {
                     return mix(mix(s.from, s.control, t), mix(s.control, s.to, t), u);
                   };
                   return Quadratic{blossom(a, a), blossom(a, b), blossom(b, b)};
                 },
                 [&](const Cubic& s) -> Span {
                   const auto blossom = [&](double t, double u, double v) {
                     const Vector2d p = mix(s.from, s.first, t), q = mix(s.first, s.second, t),
                                    r = mix(s.second, s.to, t);
                     return mix(mix(p, q, u), mix(q, r, u), v);
                   };
                   return Cubic{blossom(a, a, a), blossom(a, a, b), blossom(a, b, b), blossom(b, b, b)};
                 },
                 [&](const Arc& s) -> Span {
                   return Arc{s.centre, s.u, s.v, s.from + a * (s.to - s.from), s.from + b * (s.to - s.from)};
                 }},
      span);
}

/// Gauss's rule on [-1, 1], exact to degree 15.
const fem::Rule& rule() {
  static const fem::Rule eight = fem::quadrature(fem::Domain::line, 15);
  return eight;
}

template <class Integrand>
double integral(double from, double to, const Integrand& integrand) {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0.0;
  for (int q = 0; q < rule().weights.size(); ++q)
    sum += half * rule().weights[q] * integrand(middle + half * rule().points(0, q));
  return sum;
}

/// Panels that make the rule exact to round-off for what a pattern draws: an arc's by its angle.
int panel_count(const Span& span) {
  if (std::holds_alternative<Line>(span)) return 1;
  if (const Arc* arc = std::get_if<Arc>(&span))
    return std::max(1, static_cast<int>(std::ceil(std::abs(arc->to - arc->from) / (std::numbers::pi / 8.0))));
  return 16;
}

double length_between(const Span& span, double from, double to) {
  return integral(from, to, [&](double t) { return derivative(span, t).norm(); });
}

Vector2d unit_or(const Vector2d& direction, const Vector2d& otherwise) {
  const double norm = direction.norm();
  if (norm > 1e-12) return direction / norm;
  return otherwise.norm() > 0.0 ? otherwise.normalized() : Vector2d(1.0, 0.0);
}

void flatten(const Span& span, double from, double to, double tolerance, int depth, std::vector<Vector2d>& points) {
  const Vector2d a = at(span, from), b = at(span, to), chord = b - a;
  double off = 0.0;
  for (const double share : {0.25, 0.5, 0.75}) {
    const Vector2d p = at(span, from + share * (to - from)) - a;
    const double along = chord.squaredNorm() > 0.0 ? std::clamp(p.dot(chord) / chord.squaredNorm(), 0.0, 1.0) : 0.0;
    off = std::max(off, (p - along * chord).norm());
  }
  if (depth == 0 || off <= tolerance) return points.push_back(b);
  flatten(span, from, 0.5 * (from + to), tolerance, depth - 1, points);
  flatten(span, 0.5 * (from + to), to, tolerance, depth - 1, points);
}

}  // namespace

Span arc_through(const Vector2d& from, const Vector2d& through, const Vector2d& to) {
  // The centre is as far from all three: two linear equations.
  const Vector2d p = through - from, q = to - from;
  const double twice = 2.0 * cross(p, q);
  if (std::abs(twice) <= 1e-9 * p.norm() * q.norm()) return Line{from, to};
  const Vector2d offset =
      Vector2d(q.y() * p.squaredNorm() - p.y() * q.squaredNorm(), p.x() * q.squaredNorm() - q.x() * p.squaredNorm()) /
      twice;
  const Vector2d centre = from + offset, start = from - centre, end = to - centre;
  const double radius = start.norm(), full = 2.0 * std::numbers::pi;
  const double first = std::atan2(start.y(), start.x());
  double turn =
      std::atan2(end.y(), end.x()) - first;  // counter-clockwise when the point stands on the right of the chord
  if (twice < 0.0 && turn > 0.0) turn -= full;
  if (twice > 0.0 && turn < 0.0) turn += full;
  return Arc{centre, Vector2d(radius, 0.0), Vector2d(0.0, radius), first, first + turn};
}

Span arc_of_radius(const Vector2d& from, const Vector2d& to, double radius, bool large, bool left) {
  const Vector2d chord = to - from;
  const double half = 0.5 * chord.norm(), full = 2.0 * std::numbers::pi;
  const double height = std::sqrt(std::max(0.0, radius * radius - half * half));
  const Vector2d to_left = Vector2d(-chord.y(), chord.x()) / (2.0 * half);
  const Vector2d centre = 0.5 * (from + to) + (left != large ? height : -height) * to_left;
  const Vector2d start = from - centre, end = to - centre;
  const double first = std::atan2(start.y(), start.x());
  double turn = std::atan2(end.y(), end.x()) - first;
  if (left && turn < 0.0) turn += full;
  if (!left && turn > 0.0) turn -= full;
  return Arc{centre, Vector2d(start.norm(), 0.0), Vector2d(0.0, start.norm()), first, first + turn};
}

Vector2d at(const Span& span, double t) {
  const double s = 1.0 - t;
  return std::visit(
      Overloaded{
          [&](const Line& p) -> Vector2d { return s * p.from + t * p.to; },
          [&](const Quadratic& p) -> Vector2d { return s * s * p.from + 2.0 * s * t * p.control + t * t * p.to; },
          [&](const Cubic& p) -> Vector2d {
            return s * s * s * p.from + 3.0 * s * t * (s * p.first + t * p.second) + t * t * t * p.to;
          },
          [&](const Arc& p) -> Vector2d {
            const double angle = s * p.from + t * p.to;
            return p.centre + std::cos(angle) * p.u + std::sin(angle) * p.v;
          }},
      span);
}

Vector2d derivative(const Span& span, double t) {
  const double s = 1.0 - t;
  return std::visit(
      Overloaded{
          [&](const Line& p) -> Vector2d { return p.to - p.from; },
          [&](const Quadratic& p) -> Vector2d { return 2.0 * (s * (p.control - p.from) + t * (p.to - p.control)); },
          [&](const Cubic& p) -> Vector2d {
            return 3.0 * (s * s * (p.first - p.from) + 2.0 * s * t * (p.second - p.first) + t * t * (p.to - p.second));
          },
          [&](const Arc& p) -> Vector2d {
            const double angle = s * p.from + t * p.to;
            return (p.to - p.from) * (std::cos(angle) * p.v - std::sin(angle) * p.u);
          }},
      span);
}

Vector2d Curve::first_direction() const {
  return unit_or(derivative(spans.front(), 0.0), at(spans.front(), 0.01) - begin());
}

Vector2d Curve::last_direction() const {
  return unit_or(derivative(spans.back(), 1.0), end() - at(spans.back(), 0.99));
}

Curve reversed(const Curve& curve) {
  Curve result;
  for (auto span = curve.spans.rbegin(); span != curve.spans.rend(); ++span) result.spans.push_back(reversed(*span));
  return result;
}

Curve mapped(const Curve& curve, const Eigen::Affine2d& map) {
  Curve result;
  for (const Span& span : curve.spans) result.spans.push_back(mapped(span, map));
  return result;
}

std::vector<Span> without_arcs(const Curve& curve) {
  std::vector<Span> result;
  for (const Span& span : curve.spans) {
    const Arc* arc = std::get_if<Arc>(&span);
    if (!arc) {
      result.push_back(span);
      continue;
    }
    const int count =
        std::max(1, static_cast<int>(std::ceil(std::abs(arc->to - arc->from) / (std::numbers::pi / 8.0) - 1e-9)));
    for (int n = 0; n < count; ++n) {
      const double from = static_cast<double>(n) / count, to = static_cast<double>(n + 1) / count;
      // The control points of a circle's arc of angle a stand 4/3 tan(a/4) radii from its ends; an affine map keeps
      // them.
      const double angle = (arc->to - arc->from) / count,
                   reach = 4.0 / 3.0 * std::tan(angle / 4.0) / (arc->to - arc->from);
      const Vector2d a = at(span, from), b = at(span, to);
      result.push_back(Cubic{a, a + reach * derivative(span, from), b - reach * derivative(span, to), b});
    }
  }
  return result;
}

std::vector<Vector2d> flattened(const Curve& curve, double tolerance) {
  std::vector<Vector2d> points{curve.begin()};
  for (const Span& span : curve.spans) {
    const int parts = std::holds_alternative<Line>(span) ? 1 : 4;  // an S is not taken for its chord
    for (int part = 0; part < parts; ++part)
      flatten(span, static_cast<double>(part) / parts, static_cast<double>(part + 1) / parts, tolerance, 6, points);
  }
  return points;
}

double swept_area(const Curve& curve) {
  double sum = 0.0;
  for (const Span& span : curve.spans) {
    const int panels = panel_count(span);
    for (int n = 0; n < panels; ++n)
      sum += integral(static_cast<double>(n) / panels, static_cast<double>(n + 1) / panels,
                      [&](double t) { return 0.5 * cross(at(span, t), derivative(span, t)); });
  }
  return sum;
}

ArcLength::ArcLength(const Curve& curve) : curve_(curve) {
  double length = 0.0;
  for (std::size_t s = 0; s < curve.spans.size(); ++s) {
    const int panels = panel_count(curve.spans[s]);
    for (int n = 0; n < panels; ++n) {
      Panel panel{static_cast<int>(s), static_cast<double>(n) / panels, static_cast<double>(n + 1) / panels, length,
                  length};
      panel.after += length_between(curve.spans[s], panel.from, panel.to);
      length = panel.after;
      panels_.push_back(panel);
    }
  }
}

const ArcLength::Panel& ArcLength::panel_at(double length) const {
  const auto found =
      std::lower_bound(panels_.begin(), panels_.end(), length, [](const Panel& p, double l) { return p.after < l; });
  return found == panels_.end() ? panels_.back() : *found;
}

Vector2d ArcLength::at(double share) const {
  const auto [span, t] = parameter_at(share);
  return mesh::at(curve_.spans[span], t);
}

Curve ArcLength::between(double from, double to) const {
  const auto [first, t0] = parameter_at(from);
  const auto [last, t1] = parameter_at(to);
  Curve result;
  for (int s = first; s <= last; ++s) {
    const double a = s == first ? t0 : 0.0, b = s == last ? t1 : 1.0;
    if (b - a > 1e-12 || first == last) result.spans.push_back(part(curve_.spans[s], a, b));
  }
  return result;
}

std::pair<int, double> ArcLength::parameter_at(double share) const {
  if (share <= 0.0) return {0, 0.0};
  if (share >= 1.0) return {static_cast<int>(curve_.spans.size()) - 1, 1.0};
  const double wanted = share * length();
  const Panel& panel = panel_at(wanted);
  const Span& span = curve_.spans[panel.span];
  const double inside = panel.after - panel.before;
  double low = panel.from, high = panel.to;
  double t = inside > 0.0 ? low + (wanted - panel.before) / inside * (high - low) : low;
  for (int iteration = 0; iteration < 50; ++iteration) {  // Newton, kept between two bounds
    const double error = panel.before + length_between(span, panel.from, t) - wanted;
    if (std::abs(error) <= 1e-14 * length()) break;
    (error > 0.0 ? high : low) = t;
    const double speed = derivative(span, t).norm();
    const double next = speed > 0.0 ? t - error / speed : low - 1.0;
    t = next > low && next < high ? next : 0.5 * (low + high);
  }
  return {panel.span, t};
}

double ArcLength::nearest(const Vector2d& point) const {
  constexpr int samples = 400;
  const auto off = [&](double share) { return (at(share) - point).squaredNorm(); };
  int best = 0;
  for (int n = 1; n <= samples; ++n)
    if (off(static_cast<double>(n) / samples) < off(static_cast<double>(best) / samples)) best = n;
  double low = std::max(0.0, (best - 1.0) / samples), high = std::min(1.0, (best + 1.0) / samples);
  for (int iteration = 0; iteration < 40; ++iteration) {  // by thirds
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    (off(a) < off(b) ? high : low) = off(a) < off(b) ? b : a;
  }
  const double middle = 0.5 * (low + high);
  for (const double end : {0.0, 1.0})
    if (off(end) <= off(middle)) return end;
  return middle;
}

}  // namespace snug::mesh
