#include "mesh/curves/b_spline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace snug::mesh::curves {

namespace {

std::string knot_fault(int degree, const std::vector<double>& knots) {
  if (degree < 1 || degree > highest_degree) return fmt::format("degree {}; it is 1 to {}", degree, highest_degree);
  if (static_cast<int>(knots.size()) < 2 * degree + 2)
    return fmt::format("{} knots; degree {} has {} at least", knots.size(), degree, 2 * degree + 2);
  for (std::size_t k = 0; k < knots.size(); ++k)
    if (!std::isfinite(knots[k]) || (k > 0 && knots[k] < knots[k - 1]))
      return fmt::format("knot {} is {}; knots never fall", k, knots[k]);
  const auto first = knots.begin() + degree, last = knots.end() - degree - 1;
  if (!(*first < *last)) return fmt::format("no span between the knots {} and {}", *first, *last);
  for (auto knot = knots.begin(); knot != knots.end(); ++knot) {
    const bool inner = *knot > *first && *knot < *last;
    const int most = inner ? degree : degree + 1;
    if (knots.end() - knot > most && knot[most] == *knot)
      return fmt::format("knot {} is there more than {} times", *knot, most);
  }
  return {};
}

std::string point_fault(Eigen::Index expected, const Eigen::MatrixXd& points, const Eigen::VectorXd& weights) {
  if (points.cols() != expected) return fmt::format("{} points; the knots go with {}", points.cols(), expected);
  if (weights.size() != expected) return fmt::format("{} weights for {} points", weights.size(), expected);
  if (!points.allFinite()) return "a point is not finite";
  if (!weights.allFinite() || !(weights.array() > 0.0).all()) return "a weight is not positive";
  return {};
}

/// Positions j of the spans [t_j, t_{j+1}] that are not empty.
std::vector<int> spans(int degree, const std::vector<double>& knots) {
  std::vector<int> found;
  for (int j = degree; j + degree + 1 < static_cast<int>(knots.size()); ++j)
    if (knots[j] < knots[j + 1]) found.push_back(j);
  return found;
}

int span_of(int degree, const std::vector<double>& knots, double t) {
  const auto first = knots.begin() + degree, last = knots.end() - degree - 1;
  const auto after = std::upper_bound(first, last, t);
  const int j = static_cast<int>(after - knots.begin()) - 1;
  if (j < degree) return spans(degree, knots).front();
  return after == last && *last == *(knots.begin() + j) ? spans(degree, knots).back() : j;
}

SegmentKnots local_knots(int degree, const std::vector<double>& knots, int span) {
  const auto here = knots.begin() + span + 1;
  return {{here - degree, here}, {here, here + degree}};
}

WCurve segment_of(const BSplineCurve& curve, int span) {
  const int p = curve.degree;
  return {local_knots(p, curve.knots, span), curve.points.middleCols(span - p, p + 1),
          curve.weights.segment(span - p, p + 1)};
}

WSurface patch_of(const BSplineSurface& s, int i, int j) {
  const auto [p, q] = s.degrees;
  Eigen::Matrix3Xd points(3, (p + 1) * (q + 1));
  Eigen::VectorXd weights(points.cols());
  for (int k = 0; k <= p; ++k) {
    const int from = (i - p + k) * s.columns() + j - q;
    points.middleCols(k * (q + 1), q + 1) = s.points.middleCols(from, q + 1);
    weights.segment(k * (q + 1), q + 1) = s.weights.segment(from, q + 1);
  }
  return {local_knots(p, s.knots[0], i), local_knots(q, s.knots[1], j), points, weights};
}

std::vector<double> clamped_knots(int degree, std::vector<double> knots) {
  const double first = knots[degree], last = knots[knots.size() - 1 - degree];
  std::erase_if(knots, [&](double knot) { return knot <= first || knot >= last; });
  knots.insert(knots.begin(), degree + 1, first);
  knots.insert(knots.end(), degree + 1, last);
  return knots;
}

/// A polynomial curve in as many dimensions as the matrix has rows.
BSplineCurve polynomial(int degree, std::vector<double> knots, Eigen::MatrixXd points) {
  const Eigen::Index count = points.cols();
  return {degree, std::move(knots), std::move(points), Eigen::VectorXd::Ones(count)};
}

}  // namespace

std::string BSplineCurve::fault() const {
  const std::string wrong = knot_fault(degree, knots);
  return wrong.empty() ? point_fault(static_cast<Eigen::Index>(knots.size()) - degree - 1, points, weights) : wrong;
}

std::vector<WCurve> BSplineCurve::segments() const {
  std::vector<WCurve> all;
  for (const int span : spans(degree, knots)) all.push_back(segment_of(*this, span));
  return all;
}

Eigen::VectorXd BSplineCurve::point(double t) const { return segment_of(*this, span_of(degree, knots, t)).point(t); }

BSplineCurve BSplineCurve::with_knots(const std::vector<double>& finer) const {
  const auto count = static_cast<Eigen::Index>(finer.size()) - degree - 1;
  BSplineCurve curve{degree, finer, Eigen::MatrixXd(points.rows(), count), Eigen::VectorXd(count)};
  for (const int span : spans(degree, finer)) {
    const WCurve segment = segment_of(*this, span_of(degree, knots, 0.5 * (finer[span] + finer[span + 1])));
    const WCurve finer_one = segment.with_knots(local_knots(degree, finer, span));
    curve.points.middleCols(span - degree, degree + 1) = finer_one.points();
    curve.weights.segment(span - degree, degree + 1) = finer_one.weights();
  }
  return curve;
}

BSplineCurve BSplineCurve::clamped() const {
  const std::vector<double> wanted = clamped_knots(degree, knots);
  return wanted == knots ? *this : with_knots(wanted);
}

BSplineCurve b_spline_of(const WCurve& curve) {
  if (!curve.knots().sorted()) return b_spline_of(curve.bezier());
  std::vector<double> knots(curve.knots().u().begin(), curve.knots().u().end());
  knots.insert(knots.begin(), knots.front());  // the outermost two have no part in the curve
  knots.insert(knots.end(), curve.knots().r().begin(), curve.knots().r().end());
  knots.push_back(knots.back());
  return {curve.degree(), knots, curve.points(), curve.weights()};
}

std::string BSplineSurface::fault() const {
  for (int side = 0; side < 2; ++side)
    if (const std::string wrong = knot_fault(degrees[side], knots[side]); !wrong.empty()) return wrong;
  return point_fault(static_cast<Eigen::Index>(rows()) * columns(), points, weights);
}

std::vector<WSurface> BSplineSurface::patches() const {
  std::vector<WSurface> all;
  for (const int i : spans(degrees[0], knots[0]))
    for (const int j : spans(degrees[1], knots[1])) all.push_back(patch_of(*this, i, j));
  return all;
}

Eigen::Vector3d BSplineSurface::point(double u, double v) const {
  return patch_of(*this, span_of(degrees[0], knots[0], u), span_of(degrees[1], knots[1], v)).point(u, v);
}

BSplineSurface BSplineSurface::clamped() const {
  BSplineSurface s{degrees, {clamped_knots(degrees[0], knots[0]), clamped_knots(degrees[1], knots[1])}, {}, {}};
  if (s.knots == knots) return *this;
  // Homogeneous points: one polynomial curve along u of whole rows, then one along v for each row.
  Eigen::Matrix4Xd h(4, points.cols());
  h << points * weights.asDiagonal(), weights.transpose();
  h = polynomial(degrees[0], knots[0], h.reshaped(4 * columns(), rows()))
          .with_knots(s.knots[0])
          .points.reshaped(4, s.rows() * columns())
          .eval();
  Eigen::Matrix4Xd all(4, s.rows() * s.columns());
  for (int i = 0; i < s.rows(); ++i)
    all.middleCols(i * s.columns(), s.columns()) =
        polynomial(degrees[1], knots[1], h.middleCols(i * columns(), columns())).with_knots(s.knots[1]).points;
  s.weights = all.row(3);
  s.points = all.topRows<3>() * s.weights.cwiseInverse().asDiagonal();
  return s;
}

BSplineSurface b_spline_of(const WSurface& surface) {
  if (!surface.u_knots().sorted() || !surface.v_knots().sorted()) return b_spline_of(surface.bezier());
  const auto flat = [](const SegmentKnots& knots) {
    return b_spline_of(WCurve(knots, Eigen::MatrixXd::Zero(1, knots.degree() + 1))).knots;
  };
  return {{surface.u_knots().degree(), surface.v_knots().degree()},
          {flat(surface.u_knots()), flat(surface.v_knots())},
          surface.points(),
          surface.weights()};
}

}  // namespace snug::mesh::curves
