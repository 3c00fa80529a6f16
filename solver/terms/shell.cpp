#include "solver/terms/shell.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "solver/fem/plane_shape.hpp"
#include "solver/terms/parallel.hpp"

namespace snug::solver {

namespace {

double bending_stiffness(const ShellElasticity& e, double thickness) {
  return e.youngs_modulus * std::pow(thickness, 3) / (12.0 * (1.0 - e.poisson_ratio * e.poisson_ratio));
}

/// By node: the axes about which it may not turn.
std::map<int, std::set<int>> held_axes(const mesh::BodyMesh& mesh) {
  std::map<int, std::set<int>> held;
  for (const mesh::HeldRotation& rotation : mesh.held_rotations) held[rotation.node].insert(rotation.component);
  return held;
}

/// The edge between two corners may not turn about itself.
bool keeps_angle(const mesh::BodyMesh& mesh, const std::map<int, std::set<int>>& held, const std::pair<int, int>& ends) {
  const Eigen::Vector3d along = (mesh.nodes[ends.second] - mesh.nodes[ends.first]).normalized();
  for (const int node : {ends.first, ends.second}) {
    const auto axes = held.find(node);
    if (axes == held.end()) return false;
    Eigen::Vector3d free = along;
    for (const int axis : axes->second) free[axis] = 0.0;
    if (free.norm() > 1e-3) return false;
  }
  return true;
}

}  // namespace

std::vector<std::pair<int, int>> clamped_edges(const mesh::BodyMesh& mesh) {
  if (mesh.held_rotations.empty()) return {};
  const std::map<int, std::set<int>> held = held_axes(mesh);
  std::set<std::pair<int, int>> clamped;
  for (const mesh::ShellTriangle& triangle : mesh.shell)
    for (const auto& edge : triangle_edges)
      if (const auto ends = std::minmax({triangle.nodes[edge[0]], triangle.nodes[edge[1]]}); keeps_angle(mesh, held, ends))
        clamped.insert(ends);
  return {clamped.begin(), clamped.end()};
}

Shell::Shell(const Field& positions, const mesh::BodyMesh& mesh, std::vector<ShellElasticity> elasticity,
             input::Location where)
    : field_(positions), where_(std::move(where)), reference_(mesh.nodes) {
  for (const mesh::ShellTriangle& triangle : mesh.shell) add_triangle(triangle, elasticity.at(triangle.layer));
  add_edges(mesh);
}

void Shell::add_triangle(const mesh::ShellTriangle& given, const ShellElasticity& elasticity) {
  Triangle triangle;
  std::copy_n(given.nodes.begin(), 6, triangle.nodes.begin());
  triangle.thickness = given.thickness, triangle.foundation = given.foundation, triangle.elasticity = elasticity;
  const double nu = elasticity.poisson_ratio, plane = elasticity.youngs_modulus / (1.0 - nu * nu);
  triangle.membrane = given.thickness * plane * plane_stress(nu, Eigen::Matrix2d::Identity());
  TriangleNodes X;
  for (int a = 0; a < 6; ++a) X.col(a) = reference_[triangle.nodes[a]];
  for (const BendingRulePoint& q : bending_rule()) {
    Point point;
    point.place = triangle_place(q.xi);
    point.N = fem::plane_values<fem::Element::tri6>(q.xi);
    const ShellPoint p = shell_point(X, point.place);
    Eigen::Matrix<double, 3, 2> e;
    e.col(0) = p.tangent.col(0).normalized();
    e.col(1) = p.normal.cross(e.col(0));
    point.frame_gradient = e.transpose() * p.gradient;
    point.normal = p.normal, point.reference_b = p.b;
    point.weight = q.weight * p.area;
    const Eigen::Matrix2d metric = p.tangent.transpose() * p.tangent;
    const Eigen::Vector3d twice(1.0, 1.0, 2.0);  // b_12 stands for b_21, too
    point.bending = std::pow(given.thickness, 3) / 12.0 * plane *
                    (twice.asDiagonal() * plane_stress(nu, metric.inverse()) * twice.asDiagonal());
    triangle.points.push_back(point);
  }
  std::array<int, 18> entries{};
  for (int a = 0; a < 6; ++a)
    for (int c = 0; c < 3; ++c) entries[3 * a + c] = field_(triangle.nodes[a], c);
  entries_.push(entries);
  triangles_.push_back(std::move(triangle));
}

void Shell::add_edges(const mesh::BodyMesh& mesh) {
  std::map<std::pair<int, int>, std::vector<std::pair<int, int>>> sides;  // corners -> triangle and edge
  for (int t = 0; t < triangles(); ++t)
    for (int e = 0; e < 3; ++e) {
      const int a = triangles_[t].nodes[triangle_edges[e][0]], b = triangles_[t].nodes[triangle_edges[e][1]];
      sides[std::minmax(a, b)].push_back({t, e});
    }
  const std::map<int, std::set<int>> held = held_axes(mesh);
  std::set<int> used;
  for (const auto& [ends, around] : sides) {
    if (around.size() > 2)
      throw input::InputError(where_, fmt::format("{} shell triangles share the edge between nodes {} and {}", around.size(),
                                                      ends.first + 1, ends.second + 1),
                              "a shell is one surface: take the branch away");
    if (keeps_angle(mesh, held, ends)) {
      const auto [t, e] = around.front();
      for (const int a : triangle_edges[e]) used.insert(triangles_[t].nodes[a]);
      for (const auto& side : around) add_edge({side});
    } else if (around.size() == 2) {
      add_edge(around);
    }
  }
  check_rotations(mesh, held, used);
}

// A rotation about the normal means nothing to a shell; any other is held along an edge or not at all.
void Shell::check_rotations(const mesh::BodyMesh& mesh, const std::map<int, std::set<int>>& held, const std::set<int>& used) const {
  std::map<int, Eigen::Vector3d> normal;
  for (int t = 0; t < triangles(); ++t)
    for (const int node : triangles_[t].nodes)
      normal.emplace(node, Eigen::Vector3d::Zero()).first->second += triangles_[t].points[0].normal;
  for (const auto& [node, axes] : held) {
    if (used.contains(node) || !normal.contains(node)) continue;
    const Eigen::Vector3d n = normal.at(node).normalized();
    if (std::all_of(axes.begin(), axes.end(), [&](int axis) { return std::abs(n[axis]) > 0.999; })) continue;
    throw input::InputError(where_, fmt::format("a rotation is held at node {} but along none of its edges",
                                                    mesh.node_numbers.empty() ? node + 1 : mesh.node_numbers[node]),
                            "hold it at the nodes of whole edges; against turning as a body hold displacements of three nodes");
  }
}

void Shell::add_edge(const std::vector<std::pair<int, int>>& sides) {
  EdgeSides edge;
  std::vector<TriangleNodes> X;
  for (const auto& [t, e] : sides) {
    edge.add(t, triangles_[t].nodes);
    X.push_back(reference(t));
  }
  const bool clamped = sides.size() == 1;
  const double share = clamped ? 1.0 : 0.5;
  for (int q = 0; q < 3; ++q) {
    EdgePoint point;
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const auto [t, e] = sides[k];
      const Triangle& triangle = triangles_[t];
      EdgeSide& side = point.side[k];
      const EdgePlace at = edge_place(e, q, k == 1);
      side.place = at.place, side.along = at.along;
      const ShellPoint p = shell_point(X[k], side.place);
      const Eigen::Vector3d T = p.tangent * side.along, conormal = T.normalized().cross(p.normal);
      const Eigen::Vector2d nu = p.tangent.transpose() * conormal;
      const Eigen::Matrix2d inverse_metric = (p.tangent.transpose() * p.tangent).inverse();
      const ShellElasticity& el = triangle.elasticity;
      const double D = bending_stiffness(el, triangle.thickness);
      // m = M^ab nu_a nu_b, M = D C : K; each component of b counts once.
      const Eigen::Vector3d m = D * plane_stress(el.poisson_ratio, inverse_metric) *
                                Eigen::Vector3d(nu[0] * nu[0], nu[1] * nu[1], 2.0 * nu[0] * nu[1]);
      side.moment = {m[0], m[1], 2.0 * m[2]};
      side.reference_b = p.b;
      if (k == 0) point.weight = edge_weight(q) * T.norm();
      if (clamped) point.fixed_normal = p.normal;
      double area = 0.0;
      for (const Point& inner : triangle.points) area += inner.weight;
      point.penalty += edge_penalty(share, D, T.norm(), area);
    }
    point.reference_angle = edge_angle(X, point);
    edge.points.push_back(point);
  }
  std::vector<int> entries;
  for (const int node : edge.nodes)
    for (int c = 0; c < 3; ++c) entries.push_back(field_(node, c));
  entries_.push(entries);
  edges_.push_back(std::move(edge));
}

TriangleNodes Shell::positions(const State& state, int triangle) const {
  TriangleNodes x;
  for (int a = 0; a < 6; ++a) x.col(a) = state.values.segment<3>(field_(triangles_[triangle].nodes[a]));
  return x;
}

TriangleNodes Shell::reference(int triangle) const {
  TriangleNodes X;
  for (int a = 0; a < 6; ++a) X.col(a) = reference_[triangles_[triangle].nodes[a]];
  return X;
}

void Shell::add_point(const TriangleNodes& x, const TriangleNodes& X, const Triangle& triangle, const Point& point,
                      bool tangent, MembraneElement<6>& element) const {
  const Eigen::Vector3d E = membrane_strain<6>(x, point.frame_gradient);
  materials::MembraneResponse membrane;
  membrane.force = triangle.membrane * E;
  membrane.energy = 0.5 * E.dot(membrane.force);
  membrane.tangent = triangle.membrane;
  add_membrane_point<6>(x, point.frame_gradient, point.weight, membrane, tangent, element);

  add_bending_point(shell_point(x, point.place), point.reference_b, point.bending, point.weight, tangent, true, element);
  const double deflection = ((x - X) * point.N).dot(point.normal), k = triangle.foundation;
  if (k == 0.0) return;
  element.energy += point.weight * 0.5 * k * deflection * deflection;
  for (int a = 0; a < 6; ++a)
    element.residual.segment<3>(3 * a) += point.weight * k * deflection * point.N[a] * point.normal;
  if (!tangent) return;
  const Eigen::Matrix3d NN = point.weight * k * point.normal * point.normal.transpose();
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) element.matrix.block<3, 3>(3 * a, 3 * b) += point.N[a] * point.N[b] * NN;
}

EdgeElement Shell::edge_element(const State& state, const EdgeSides& edge, bool tangent) const {
  EdgeElement element(3 * static_cast<int>(edge.nodes.size()));
  std::vector<TriangleNodes> x;
  for (const int t : edge.triangles) x.push_back(positions(state, t));
  for (const EdgePoint& point : edge.points) add_edge_point(x, point, edge.at, tangent, true, element);
  return element;
}

double Shell::energy(const State& state) const {
  double sum = 0.0;
  for (int t = 0; t < triangles(); ++t) {
    MembraneElement<6> element;
    element.zero();
    for (const Point& point : triangles_[t].points)
      add_point(positions(state, t), reference(t), triangles_[t], point, false, element);
    sum += element.energy;
  }
  for (const EdgeSides& edge : edges_) sum += edge_element(state, edge, false).energy;
  return state.stiffening * sum;
}

bool Shell::assemble(const State& state, Tangent tangent, Sink& sink) const {
  struct Slot {
    MembraneElement<6> triangle;
    EdgeElement edge{0};
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> matrix;
  };
  std::vector<Slot> slots(128);
  const int count = triangles();
  const auto compute = [&](int e, Slot& slot) {
    if (e >= count) {
      slot.edge = edge_element(state, edges_[e - count], wanted(tangent));
      slot.matrix = state.stiffening * slot.edge.matrix, slot.edge.residual *= state.stiffening;
      return slot.edge.residual.allFinite();
    }
    slot.triangle.zero();
    const TriangleNodes x = positions(state, e), X = reference(e);
    for (const Point& point : triangles_[e].points) add_point(x, X, triangles_[e], point, wanted(tangent), slot.triangle);
    slot.triangle.residual *= state.stiffening, slot.triangle.matrix *= state.stiffening;
    return slot.triangle.residual.allFinite();
  };
  const auto consume = [&](int e, Slot& slot) {
    const auto matrix = [&](const double* data, std::size_t size) {
      return wanted(tangent) ? std::span<const double>(data, size * size) : std::span<const double>();
    };
    if (e < count)
      return sink.add(e, {slot.triangle.residual.data(), 18}, matrix(slot.triangle.matrix.data(), 18));
    const std::size_t size = slot.edge.residual.size();
    sink.add(e, {slot.edge.residual.data(), size}, matrix(slot.matrix.data(), size));
  };
  return for_elements(sink, entries_.elements(), slots, compute, consume);
}

double Shell::step_bound(const State& state, const Eigen::VectorXd& direction, double limit) const {
  // No point of a triangle may lose more than nineteen twentieths of its area, or turn by more than a right angle.
  State moved = state;
  for (int halving = 0; halving < 12; ++halving, limit *= 0.5) {
    moved.values = state.values + limit * direction;
    bool ok = true;
    for (int t = 0; t < triangles() && ok; ++t)
      for (const Point& point : triangles_[t].points) {
        const ShellPoint before = shell_point(positions(state, t), point.place), after = shell_point(positions(moved, t), point.place);
        ok = ok && after.area > 0.05 * before.area && after.normal.dot(before.normal) > 0.0;
      }
    if (ok) break;
  }
  return limit;
}

std::vector<Eigen::Vector3d> Shell::foundation_forces(const State& state) const {
  std::vector<Eigen::Vector3d> forces(reference_.size(), Eigen::Vector3d::Zero());
  for (int t = 0; t < triangles(); ++t) {
    const TriangleNodes u = positions(state, t) - reference(t);
    for (const Point& point : triangles_[t].points) {
      const double pressure = state.stiffening * triangles_[t].foundation * (u * point.N).dot(point.normal);
      for (int a = 0; a < 6; ++a) forces[triangles_[t].nodes[a]] -= point.weight * pressure * point.N[a] * point.normal;
    }
  }
  return forces;
}

std::vector<postproc::Stress> Shell::averaged_stress(const State& state, double height) const {
  std::vector<double> count(reference_.size(), 0.0);
  for (const Triangle& triangle : triangles_)
    for (const int node : triangle.nodes) count[node] += 1.0;
  std::vector<postproc::Stress> stress(reference_.size(), postproc::Stress::Zero());
  for (int t = 0; t < triangles(); ++t) {
    const auto nodal = nodal_stress(state, t, height);
    for (int a = 0; a < 6; ++a) stress[triangles_[t].nodes[a]] += nodal.col(a) / count[triangles_[t].nodes[a]];
  }
  return stress;
}

void Shell::publish(const State& state, PublishedFields& fields) const {
  postproc::Fields& body = fields[field_.name];
  add_stress(body, averaged_stress(state, 0.0));
  body.add(named(postproc::field::stress_top, averaged_stress(state, 1.0)));
  body.add(named(postproc::field::stress_bottom, averaged_stress(state, -1.0)));
}

// S^ab = C^abcd (E - z K)_cd; sigma = S^ab a_a (x) a_b/(area ratio) with the tangents at z left at the middle's.
Eigen::Matrix<double, 6, 6> Shell::nodal_stress(const State& state, int t, double height) const {
  const Triangle& triangle = triangles_[t];
  const TriangleNodes x = positions(state, t), X = reference(t);
  const double nu = triangle.elasticity.poisson_ratio, plane = triangle.elasticity.youngs_modulus / (1.0 - nu * nu);
  const double z = 0.5 * height * triangle.thickness;
  Eigen::Matrix<double, 6, 6> stress;
  for (int a = 0; a < 6; ++a) {
    const TrianglePlace place = triangle_place(triangle_node(a));
    const ShellPoint now = shell_point(x, place), rest = shell_point(X, place);
    const Eigen::Matrix2d A = rest.tangent.transpose() * rest.tangent;
    const Eigen::Matrix2d E = 0.5 * (now.tangent.transpose() * now.tangent - A);
    const Eigen::Vector3d K = now.b - rest.b;
    const Eigen::Vector3d strain(E(0, 0) - z * K[0], E(1, 1) - z * K[1], 2.0 * (E(0, 1) - z * K[2]));
    const Eigen::Vector3d S = plane * plane_stress(nu, A.inverse()) * strain;
    Eigen::Matrix2d S2;
    S2 << S[0], S[2], S[2], S[1];
    const Eigen::Matrix3d s = now.tangent * S2 * now.tangent.transpose() * (rest.area / now.area);
    stress.col(a) << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2);
  }
  return stress;
}

}  // namespace snug::solver
