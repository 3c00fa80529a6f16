#include "solver/terms/fabric_membrane.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "solver/fem/element.hpp"
#include "solver/terms/garment_shape.hpp"
#include "solver/terms/parallel.hpp"

namespace snug::solver {

namespace {

// Where nothing touches, the residual is measured against the force of this strain across the garment.
constexpr double noticeable_strain = 1e-3;

/// d (xi, eta) along a side per its own coordinate from 0 to 1, L = (1 - xi - eta, xi, eta).
Eigen::Vector2d side_direction(int side) {
  const std::array<Eigen::Vector2d, 3> corner = {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)};
  return corner[(side + 1) % 3] - corner[side];
}

NodeVectors<6> placed_nodes(const mesh::GarmentMesh& mesh, std::size_t triangle) {
  NodeVectors<6> placed;
  for (int a = 0; a < 6; ++a) placed.col(a) = mesh.placed[mesh.triangles[triangle][a]];
  return placed;
}

}  // namespace

FabricMembrane::FabricMembrane(std::string garment, const Field& positions, const mesh::GarmentMesh& mesh, std::vector<materials::Fabric> fabrics,
                               std::optional<double> prestretch)
    : garment_(std::move(garment)), field_(positions), fabrics_(std::move(fabrics)), prestretch_(prestretch), order_(mesh.order), mean_edge_(mesh.mean_edge) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corner = mesh.triangles[t];
    Element element;
    element.fabric = 1 + mesh.zone_of(t);
    element.frame.col(0) = mesh.warp[t];
    element.frame.col(1) = Eigen::Vector2d(-mesh.warp[t].y(), mesh.warp[t].x());
    element.course = mesh.course_of(t);
    std::array<int, 18> entries{};
    for (int a = 0; a < 6; ++a) {
      element.nodes[a] = mesh.merged[corner[a]];
      element.pattern.col(a) = mesh.pattern[corner[a]];
      for (int c = 0; c < 3; ++c) entries[3 * a + c] = positions(element.nodes[a], c);
    }
    const NodeVectors<6> placed = placed_nodes(mesh, t);
    for (const TrianglePoint& q : triangle_rule()) {
      element.points.push_back(point_at(element, placed, q));
      element.area += q.weight * pattern_point(order_, element.pattern, q.L).area;
    }
    entries_.push(entries);
    elements_.push_back(std::move(element));
  }
}

FabricMembrane::Point FabricMembrane::point_at(const Element& element, const NodeVectors<6>& placed, const TrianglePoint& q) const {
  Point point;
  const PatternPoint flat = pattern_point(order_, element.pattern, q.L);
  const double course = course_value(element.course, garment_values(order_, q.L));
  point.gradient = flat.gradient.transpose();
  point.gradient.row(0) /= course;
  point.weight = q.weight * flat.area * course;
  const Eigen::Matrix<double, 3, 2> F0 = placed * point.gradient.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> U0(Eigen::Matrix2d(F0.transpose() * F0));
  point.axes = U0.eigenvectors();
  point.log_placed = U0.eigenvalues().cwiseSqrt().cwiseMax(0.3).cwiseMin(3.0).array().log();
  point.log_rest.setZero();
  if (prestretch_) point.log_rest = point.log_placed.array() - std::log(*prestretch_);
  return point;
}

double FabricMembrane::eta(double load) const { return std::pow(1e-2, 1.0 - load) * std::pow(final_eta_, load); }

NodeVectors<6> FabricMembrane::positions(const State& state, const Element& element) const {
  NodeVectors<6> x;
  for (int a = 0; a < 6; ++a) x.col(a) = state.values.segment<3>(field_(element.nodes[a]));
  return x;
}

Derivatives<6> FabricMembrane::derivatives(const Element& element, const Point& point, double load, double& rest_weight) {
  const Eigen::Vector2d log_H = (1.0 - load) * point.log_placed + load * point.log_rest;
  const Eigen::Matrix2d H_inverse = point.axes * (-log_H).array().exp().matrix().asDiagonal() * point.axes.transpose();
  rest_weight = point.weight * std::exp(log_H.sum());
  return (H_inverse * element.frame).transpose() * point.gradient;
}

double FabricMembrane::energy(const State& state) const {
  double sum = 0.0;
  for (const Element& element : elements_) {
    const NodeVectors<6> x = positions(state, element);
    for (const Point& point : element.points) {
      double weight = 0.0;
      const Derivatives<6> d = derivatives(element, point, state.load, weight);
      sum += weight * fabrics_[element.fabric].relaxed(membrane_strain<6>(x, d), eta(state.load)).energy;
    }
  }
  return sum;
}

bool FabricMembrane::assemble(const State& state, Tangent tangent, Sink& sink) const {
  std::vector<MembraneElement<6>> slots(256);
  const double compressive = eta(state.load);
  const auto compute = [&](int e, MembraneElement<6>& slot) {
    const Element& element = elements_[e];
    const materials::Fabric& fabric = fabrics_[element.fabric];
    const NodeVectors<6> x = positions(state, element);
    slot.zero();
    for (const Point& point : element.points) {
      double weight = 0.0;
      const Derivatives<6> d = derivatives(element, point, state.load, weight);
      add_membrane_point<6>(x, d, weight, fabric.relaxed(membrane_strain<6>(x, d), compressive), wanted(tangent), slot);
    }
    return slot.residual.allFinite();
  };
  return for_elements(sink, triangles(), slots, compute, [&](int e, MembraneElement<6>& slot) {
    sink.add(e, {slot.residual.data(), 18}, wanted(tangent) ? std::span<const double>(slot.matrix.data(), 324) : std::span<const double>());
  });
}

void FabricMembrane::measure(const State&, Measure& measure) const {
  double area = 0.0;
  for (const Element& element : elements_) area += element.area;
  double softest = fabrics_.front().stiffness();
  for (const materials::Fabric& fabric : fabrics_) softest = std::min(softest, fabric.stiffness());
  measure.smallest_force = std::max(measure.smallest_force, noticeable_strain * softest * std::sqrt(area));
}

void FabricMembrane::damp(Eigen::VectorXd& weights) const {
  for (const Element& element : elements_) {
    const double area = flat_triangle(element.pattern.col(0), element.pattern.col(1), element.pattern.col(2)).area;
    for (const int node : element.nodes)
      for (int c = 0; c < 3; ++c)
        weights[field_(node, c)] += area / 6.0 * fabrics_[element.fabric].stiffness() / (mean_edge_ * mean_edge_);
  }
}

double FabricMembrane::step_bound(const State& state, const Eigen::VectorXd& direction, double limit) const {
  // The current area of a point may not fall below a twentieth of what it is now.
  State moved = state;
  for (int halving = 0; halving < 12; ++halving, limit *= 0.5) {
    moved.values = state.values + limit * direction;
    bool ok = true;
    for (int t = 0; t < triangles() && ok; ++t)
      for (const TrianglePoint& q : triangle_rule())
        ok = ok && area_ratio(moved, t, q.L) > 0.05 * area_ratio(state, t, q.L);
    if (ok) break;
  }
  return limit;
}

double FabricMembrane::area_ratio(const State& state, int triangle, const Eigen::Vector3d& L) const {
  const Element& element = elements_[triangle];
  const Eigen::Matrix<double, 3, 2> F = positions(state, element) * pattern_point(order_, element.pattern, L).gradient;
  return F.col(0).cross(F.col(1)).norm();
}

void FabricMembrane::publish(const State& state, PublishedFields& fields) const {
  namespace field = postproc::field;
  std::vector<double> warp, weft, shear, wrinkled, area_ratio;
  std::vector<Eigen::Vector2d> stretch;
  for (int t = 0; t < triangles(); ++t) {
    const Summary s = summary(state, t);
    warp.push_back(s.tension_warp), weft.push_back(s.tension_weft), shear.push_back(s.shear);
    stretch.emplace_back(s.stretch_warp, s.stretch_weft);
    wrinkled.push_back(s.wrinkled), area_ratio.push_back(s.area_ratio);
  }
  postproc::Fields& garment = fields[garment_];
  garment.add(named(field::tension_warp, std::move(warp)));
  garment.add(named(field::tension_weft, std::move(weft)));
  garment.add(named(field::shear, std::move(shear)));
  garment.add(named(field::stretch, std::move(stretch)));
  garment.add(named(field::wrinkled, std::move(wrinkled)));
  garment.add(named(field::area_ratio, std::move(area_ratio)));
}

FabricMembrane::Summary FabricMembrane::summary(const State& state, int triangle) const {
  const Element& element = elements_[triangle];
  const NodeVectors<6> x = positions(state, element);
  Summary s;
  s.area_ratio = 0.0;
  double area = 0.0;
  for (const Point& point : element.points) {
    double weight = 0.0;
    const Derivatives<6> d = derivatives(element, point, state.load, weight);
    const Eigen::Matrix<double, 3, 2> f = x * d.transpose();
    const auto response = fabrics_[element.fabric].relaxed(membrane_strain<6>(x, d), eta(state.load));
    const double l1 = f.col(0).norm(), l2 = f.col(1).norm(), J = f.col(0).cross(f.col(1)).norm();
    // Cauchy force sigma = F N F^T / J, components along the current warp and weft directions.
    s.tension_warp += point.weight * response.force[0] * l1 * l1 / J;
    s.tension_weft += point.weight * response.force[1] * l2 * l2 / J;
    s.shear += point.weight * response.force[2] * l1 * l2 / J;
    s.stretch_warp += point.weight * l1;
    s.stretch_weft += point.weight * l2;
    s.wrinkled = std::max(s.wrinkled, static_cast<double>(response.state));
    s.area_ratio += weight * J;
    area += point.weight;
  }
  for (double* value : {&s.tension_warp, &s.tension_weft, &s.shear, &s.stretch_warp, &s.stretch_weft, &s.area_ratio})
    *value /= area;
  return s;
}

NodeVectors<6> FabricMembrane::nodal_forces(const State& state, int triangle) const {
  const Element& element = elements_[triangle];
  const NodeVectors<6> x = positions(state, element);
  MembraneElement<6> sums;
  sums.zero();
  for (const Point& point : element.points) {
    double weight = 0.0;
    const Derivatives<6> d = derivatives(element, point, state.load, weight);
    add_membrane_point<6>(x, d, weight, fabrics_[element.fabric].relaxed(membrane_strain<6>(x, d), eta(state.load)), false, sums);
  }
  return Eigen::Map<const NodeVectors<6>>(sums.residual.data());
}

// Force on an element dL of a side with the normal n at rest: P n dL, P = F N. At rest, as far as the way of the metric has come, the side is
// H dX; turned by a right angle it is n dL, outwards where the triangle runs counter-clockwise.
FabricMembrane::SideForce FabricMembrane::side_force(const State& state, const mesh::GarmentMesh& mesh, int triangle, int side) const {
  const Element& element = elements_[triangle];
  const NodeVectors<6> x = positions(state, element), placed = placed_nodes(mesh, static_cast<std::size_t>(triangle));
  const fem::Rule rule = fem::quadrature(fem::Domain::line, 5);
  SideForce force;
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const double s = 0.5 * (1.0 + rule.points(0, q));
    Eigen::Vector3d L = Eigen::Vector3d::Zero();
    L[side] = 1.0 - s, L[(side + 1) % 3] = s;
    const Point point = point_at(element, placed, {L, 1.0});
    double weight = 0.0;
    const Derivatives<6> d = derivatives(element, point, state.load, weight);
    const Eigen::Matrix<double, 3, 2> f = x * d.transpose();
    const Eigen::Vector3d n = fabrics_[element.fabric].relaxed(membrane_strain<6>(x, d), eta(state.load)).force;
    // Along the side, per dxi: of the cloth now, and in the frame at rest from f e = dx.
    Eigen::Matrix<double, 6, 1> slope = garment_slopes(order_, L) * side_direction(side);
    const Eigen::Vector3d now = 0.5 * x * slope;
    const Eigen::Vector2d rest = (f.transpose() * f).ldlt().solve(f.transpose() * now);
    const Eigen::Vector3d traction = f * Eigen::Vector2d(n[0] * rest.y() - n[2] * rest.x(), n[2] * rest.y() - n[1] * rest.x());
    const double length = now.norm();
    const Eigen::Vector3d along = now / length, normal = f.col(0).cross(f.col(1)).normalized(), out = along.cross(normal);
    force.length += rule.weights[q] * length, force.out += rule.weights[q] * length * out;
    force.along += rule.weights[q] * traction.dot(along);
    force.largest = std::max(force.largest, traction.dot(out) / length);
  }
  force.along = std::abs(force.along);
  return force;
}

}  // namespace snug::solver
