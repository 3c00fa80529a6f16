#include "solver/terms/fabric_membrane.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>

#include "solver/terms/garment_shape.hpp"
#include "solver/terms/parallel.hpp"

namespace snug::solver {

namespace {

// Where nothing touches, the residual is measured against the force of this strain across the garment.
constexpr double noticeable_strain = 1e-3;

}  // namespace

FabricMembrane::FabricMembrane(std::string garment, const Field& positions, const mesh::GarmentMesh& mesh, const materials::Fabric& fabric,
                               std::optional<double> prestretch)
    : garment_(std::move(garment)), field_(positions), fabric_(fabric), order_(mesh.order), mean_edge_(mesh.mean_edge) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corner = mesh.triangles[t];
    Element element;
    element.frame.col(0) = mesh.warp[t];
    element.frame.col(1) = Eigen::Vector2d(-mesh.warp[t].y(), mesh.warp[t].x());
    NodeVectors<6> placed;
    std::array<int, 18> entries{};
    for (int a = 0; a < 6; ++a) {
      element.nodes[a] = mesh.merged[corner[a]];
      placed.col(a) = mesh.placed[corner[a]];
      element.pattern.col(a) = mesh.pattern[corner[a]];
      for (int c = 0; c < 3; ++c) entries[3 * a + c] = positions(element.nodes[a], c);
    }
    for (const TrianglePoint& q : triangle_rule()) {
      Point point;
      const PatternPoint flat = pattern_point(order_, element.pattern, q.L);
      point.gradient = flat.gradient.transpose();
      point.weight = q.weight * flat.area;
      element.area += point.weight;
      const Eigen::Matrix<double, 3, 2> F0 = placed * point.gradient.transpose();
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> U0(Eigen::Matrix2d(F0.transpose() * F0));
      point.axes = U0.eigenvectors();
      point.log_placed = U0.eigenvalues().cwiseSqrt().cwiseMax(0.3).cwiseMin(3.0).array().log();
      point.log_rest.setZero();
      if (prestretch) point.log_rest = point.log_placed.array() - std::log(*prestretch);
      element.points.push_back(point);
    }
    entries_.push(entries);
    elements_.push_back(std::move(element));
  }
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
      sum += weight * fabric_.relaxed(membrane_strain<6>(x, d), eta(state.load)).energy;
    }
  }
  return sum;
}

bool FabricMembrane::assemble(const State& state, Tangent tangent, Sink& sink) const {
  std::vector<MembraneElement<6>> slots(256);
  const double compressive = eta(state.load);
  const auto compute = [&](int e, MembraneElement<6>& slot) {
    const Element& element = elements_[e];
    const NodeVectors<6> x = positions(state, element);
    slot.zero();
    for (const Point& point : element.points) {
      double weight = 0.0;
      const Derivatives<6> d = derivatives(element, point, state.load, weight);
      add_membrane_point<6>(x, d, weight, fabric_.relaxed(membrane_strain<6>(x, d), compressive), wanted(tangent), slot);
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
  measure.smallest_force = std::max(measure.smallest_force, noticeable_strain * fabric_.stiffness() * std::sqrt(area));
}

void FabricMembrane::damp(Eigen::VectorXd& weights) const {
  for (const Element& element : elements_) {
    const double area = flat_triangle(element.pattern.col(0), element.pattern.col(1), element.pattern.col(2)).area;
    for (const int node : element.nodes)
      for (int c = 0; c < 3; ++c)
        weights[field_(node, c)] += area / 6.0 * fabric_.stiffness() / (mean_edge_ * mean_edge_);
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
    const auto response = fabric_.relaxed(membrane_strain<6>(x, d), eta(state.load));
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

}  // namespace snug::solver
