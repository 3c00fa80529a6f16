#include "solver/terms/band.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "solver/fem/element.hpp"
#include "solver/terms/garment_shape.hpp"

namespace snug::solver {

namespace {

/// dN_a/dxi of vertex, middle and vertex at xi in [-1, 1]: those of a triangle along its first side.
Eigen::Vector3d slopes(int order, double xi) {
  const double s = 0.5 * (1.0 + xi);
  const Eigen::Matrix<double, 6, 2> dN = garment_slopes(order, {1.0 - s, s, 0.0});
  return 0.5 * Eigen::Vector3d(dN(0, 0), dN(3, 0), dN(1, 0));
}

/// The turn from a to b, along its axis, rad.
Eigen::Vector3d turn_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d axis = a.cross(b);
  return axis.norm() > 0.0 ? Eigen::Vector3d(std::atan2(axis.norm(), a.dot(b)) * axis.normalized()) : Eigen::Vector3d::Zero();
}

/// A side of a triangle whose middle is a node of the edge: its vertex, middle and vertex on the pattern.
struct Side {
  int triangle, first;
  std::array<int, 3> nodes;
};

std::vector<Side> sides_along(const mesh::GarmentMesh& garment, const std::string& edge) {
  const auto& nodes = garment.edges.at(edge);
  const std::set<int> on_edge(nodes.begin(), nodes.end());
  std::vector<Side> sides;
  for (std::size_t e = 0; e < garment.triangles.size(); ++e)
    for (int k = 0; k < 3; ++k)
      if (const auto& t = garment.triangles[e]; on_edge.contains(garment.merged[t[3 + k]]))
        sides.push_back({static_cast<int>(e), k, {t[k], t[3 + k], t[(k + 1) % 3]}});
  return sides;
}

/// |dX/dxi| on the pattern, m; of courses with lengths of their own (mesh.course) theirs.
double pattern_stretch(const mesh::GarmentMesh& garment, const Side& side, const Eigen::Vector3d& slope) {
  Eigen::Vector2d tangent = Eigen::Vector2d::Zero();
  for (int a = 0; a < 3; ++a) tangent += slope[a] * garment.pattern[side.nodes[a]];
  if (!garment.course.empty()) tangent.x() *= (garment.course[side.nodes[0]] + garment.course[side.nodes[1]] + garment.course[side.nodes[2]]) / 3.0;
  return tangent.norm();
}

}  // namespace

void bear_along(const mesh::GarmentMesh& garment, const std::string& edge, double width, ContactSlave& slave) {
  const fem::Rule rule = fem::quadrature(fem::Domain::line, 7);
  for (const Side& side : sides_along(garment, edge))
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const double xi = rule.points(0, q), s = 0.5 * (1.0 + xi);
      Eigen::Vector3d L = Eigen::Vector3d::Zero();
      L[side.first] = 1.0 - s, L[(side.first + 1) % 3] = s;
      const double area = width * rule.weights[q] * pattern_stretch(garment, side, slopes(garment.order, xi));
      slave.lines[side.triangle].push_back({L, area / slave.triangles[side.triangle].area});
    }
}

double edge_length(const mesh::GarmentMesh& garment, const std::string& edge) {
  double length = 0.0;
  const fem::Rule rule = fem::quadrature(fem::Domain::line, 5);
  for (const Side& side : sides_along(garment, edge))
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) length += rule.weights[q] * pattern_stretch(garment, side, slopes(garment.order, rule.points(0, q)));
  return length;
}

Band::Band(const mesh::GarmentMesh& garment, const std::string& edge, const Field& positions, double stiffness, double rest_length)
    : garment_(garment.name), edge_(edge), field_(positions), stiffness_(stiffness), rest_length_(rest_length), order_(garment.order) {
  const double shortening = rest_length / edge_length(garment, edge);
  const fem::Rule rule = fem::quadrature(fem::Domain::line, 5);
  for (const Side& side : sides_along(garment, edge)) {
    Element element;
    std::array<int, 9> entries{};
    for (int a = 0; a < 3; ++a) {
      element.nodes[a] = garment.merged[side.nodes[a]];
      for (int c = 0; c < 3; ++c) entries[3 * a + c] = positions(element.nodes[a], c);
    }
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      Point point{.slope = slopes(order_, rule.points(0, q)), .weight = rule.weights[q]};
      Eigen::Vector3d placed = Eigen::Vector3d::Zero();
      for (int a = 0; a < 3; ++a) placed += point.slope[a] * garment.placed[side.nodes[a]];
      point.log_placed = std::log(placed.norm()), point.log_rest = std::log(shortening * pattern_stretch(garment, side, point.slope));
      element.points.push_back(point);
    }
    entries_.push(entries);
    elements_.push_back(std::move(element));
  }
}

Eigen::Matrix3d Band::positions(const State& state, const Element& element) const {
  Eigen::Matrix3d x;
  for (int a = 0; a < 3; ++a) x.col(a) = state.values.segment<3>(field_(element.nodes[a]));
  return x;
}

double Band::rest(const Point& point, double load) { return std::exp((1.0 - load) * point.log_placed + load * point.log_rest); }

double Band::energy(const State& state) const {
  double sum = 0.0;
  for (const Element& element : elements_) {
    const Eigen::Matrix3d x = positions(state, element);
    for (const Point& point : element.points) {
      const double length = rest(point, state.load), strain = std::max(0.0, (x * point.slope).norm() / length - 1.0);
      sum += point.weight * length * 0.5 * stiffness_ * strain * strain;
    }
  }
  return sum;
}

bool Band::assemble(const State& state, Tangent tangent, Sink& sink) const {
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    if (!sink.wants(static_cast<int>(e))) continue;
    const Element& element = elements_[e];
    const Eigen::Matrix3d x = positions(state, element);
    Eigen::Matrix<double, 9, 1> residual = Eigen::Matrix<double, 9, 1>::Zero();
    Eigen::Matrix<double, 9, 9, Eigen::RowMajor> matrix = Eigen::Matrix<double, 9, 9, Eigen::RowMajor>::Zero();
    for (const Point& point : element.points) {
      const Eigen::Vector3d d = x * point.slope;
      const double now = d.norm(), length = rest(point, state.load), strain = now / length - 1.0;
      if (!(now > 0.0)) return false;
      if (strain <= 0.0) continue;
      const Eigen::Vector3d t = d / now;
      const Eigen::Matrix3d along = t * t.transpose();
      const Eigen::Matrix3d K = point.weight * stiffness_ * (along / length + strain / now * (Eigen::Matrix3d::Identity() - along));
      for (int a = 0; a < 3; ++a) {
        residual.segment<3>(3 * a) += point.weight * stiffness_ * strain * point.slope[a] * t;
        for (int b = 0; b < 3 && wanted(tangent); ++b) matrix.block<3, 3>(3 * a, 3 * b) += point.slope[a] * point.slope[b] * K;
      }
    }
    sink.add(static_cast<int>(e), {residual.data(), 9}, wanted(tangent) ? std::span<const double>(matrix.data(), 81) : std::span<const double>());
  }
  return true;
}

// Within the elements and, where two of them meet, from the one to the other: all run round their cloth the same way. What turns to
// and fro cancels.
double Band::turn(const State& state) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::map<int, Eigen::Vector3d> arriving, leaving;  // at a vertex
  for (const Element& element : elements_) {
    const Eigen::Matrix3d x = positions(state, element);
    const Eigen::Vector3d first = x * slopes(order_, -1.0), middle = x * slopes(order_, 0.0), last = x * slopes(order_, 1.0);
    sum += turn_between(first, middle) + turn_between(middle, last);
    leaving[element.nodes[0]] = first, arriving[element.nodes[2]] = last;
  }
  for (const auto& [node, tangent] : arriving)
    if (const auto next = leaving.find(node); next != leaving.end()) sum += turn_between(tangent, next->second);
  return sum.norm();
}

Band::Worn Band::worn(const State& state) const {
  Worn worn{.least = std::numeric_limits<double>::infinity()};
  for (const Element& element : elements_) {
    const Eigen::Matrix3d x = positions(state, element);
    for (const Point& point : element.points) {
      const double now = (x * point.slope).norm();
      const double tension = stiffness_ * std::max(0.0, now / rest(point, state.load) - 1.0);
      worn.length += point.weight * now, worn.tension += point.weight * now * tension;
      worn.least = std::min(worn.least, tension), worn.largest = std::max(worn.largest, tension);
    }
  }
  worn.tension /= worn.length;
  worn.turn = turn(state);
  return worn;
}

}  // namespace snug::solver
