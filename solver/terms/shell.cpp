#include "solver/terms/shell.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "solver/terms/facet_kind.hpp"
#include "solver/terms/parallel.hpp"

namespace snug::solver {

namespace {

// Three points, exact to degree 2: as many membrane strains as a flat triangle has ways to deform in its plane. With the seven
// of degree 5 a thin shell locks: its strain in bending, (curvature x edge)^2, cannot vanish at all of them. Measured on a
// strip of t/L = 1e-3 in 40 cells that hangs by its own weight (reference book 2.3, q = 8): tip 1.5e-2 off with seven, 2.6e-3
// with three.
const std::array<FacetRulePoint, 3> inner_points = {{{{1.0 / 6.0, 1.0 / 6.0}, 1.0 / 6.0},
                                                     {{2.0 / 3.0, 1.0 / 6.0}, 1.0 / 6.0},
                                                     {{1.0 / 6.0, 2.0 / 3.0}, 1.0 / 6.0}}};

/// Corners and middle of each edge of a triangle, turning with it.
constexpr std::array<std::array<int, 3>, 3> edge_nodes = {{{0, 1, 3}, {1, 2, 4}, {2, 0, 5}}};
constexpr std::array<std::array<double, 2>, 3> corner = {{{0, 0}, {1, 0}, {0, 1}}};

/// Corners, then middles, on the reference triangle.
Eigen::Vector2d node_place(int a) {
  const auto at = [](int v) { return Eigen::Vector2d(corner[v][0], corner[v][1]); };
  return a < 3 ? at(a) : Eigen::Vector2d(0.5 * (at(a - 3) + at((a - 2) % 3)));
}

/// Of the penalty: with 1 the energy of flat triangles is just positive for every jump (see edge_penalty).
constexpr double safety = 1.5;

double bending_stiffness(const ShellElasticity& e, double thickness) {
  return e.youngs_modulus * std::pow(thickness, 3) / (12.0 * (1.0 - e.poisson_ratio * e.poisson_ratio));
}

// The quadratic triangle's curvature is constant. A third of a triangle's bending energy, D k^2 |K|/6, bears the jumps of
// each of its edges: share D k |e| turn <= D k^2 |K|/6 + 3/2 share^2 D |e|^2/|K| turn^2, which p |e| turn^2/2 outweighs from
// p = 3 share^2 D |e|/|K| summed over the sides on (share 1/2 inside, 1 on a clamped edge).
double edge_penalty(double share, double stiffness, double length, double area) {
  return safety * 3.0 * share * share * stiffness * length / area;
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
    for (const auto& edge : edge_nodes)
      if (const auto ends = std::minmax({triangle.nodes[edge[0]], triangle.nodes[edge[1]]}); keeps_angle(mesh, held, ends))
        clamped.insert(ends);
  return {clamped.begin(), clamped.end()};
}

Shell::Shell(const Layout& layout, const mesh::BodyMesh& mesh, std::vector<ShellElasticity> elasticity,
             input::Location where)
    : layout_(layout), where_(std::move(where)), reference_(mesh.nodes) {
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
  for (const FacetRulePoint& q : inner_points) {
    Point point;
    point.place = triangle_place(q.xi);
    point.N = facet_shape(mesh::FacetKind::tri6, q.xi).N.head<6>();
    const ShellPoint p = shell_point(X, point.place);
    Eigen::Matrix<double, 3, 2> e;
    e.col(0) = p.tangent.col(0).normalized();
    e.col(1) = p.normal.cross(e.col(0));
    point.frame_gradient = e.transpose() * p.gradient;
    point.normal = p.normal, point.reference_b = p.b;
    point.weight = q.weight * p.area;
    const Eigen::Matrix2d metric = p.tangent.transpose() * p.tangent;
    point.bending = std::pow(given.thickness, 3) / 12.0 * plane * plane_stress(nu, metric.inverse());
    triangle.points.push_back(point);
  }
  std::array<int, 18> entries{};
  for (int a = 0; a < 6; ++a)
    for (int c = 0; c < 3; ++c) entries[3 * a + c] = layout_.body(triangle.nodes[a], c);
  entries_.push(entries);
  triangles_.push_back(std::move(triangle));
}

void Shell::add_edges(const mesh::BodyMesh& mesh) {
  std::map<std::pair<int, int>, std::vector<std::pair<int, int>>> sides;  // corners -> triangle and edge
  for (int t = 0; t < triangles(); ++t)
    for (int e = 0; e < 3; ++e) {
      const int a = triangles_[t].nodes[edge_nodes[e][0]], b = triangles_[t].nodes[edge_nodes[e][1]];
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
      for (const int a : edge_nodes[e]) used.insert(triangles_[t].nodes[a]);
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
  Edge edge;
  std::vector<TriangleNodes> X;
  for (const auto& [t, e] : sides) {
    edge.triangles.push_back(t);
    X.push_back(reference(t));
    std::array<int, 6>& at = edge.at.emplace_back();
    for (int a = 0; a < 6; ++a) {
      const int node = triangles_[t].nodes[a];
      const auto found = std::find(edge.nodes.begin(), edge.nodes.end(), node);
      at[a] = static_cast<int>(found - edge.nodes.begin());
      if (found == edge.nodes.end()) edge.nodes.push_back(node);
    }
  }
  const bool clamped = sides.size() == 1;
  const double g = std::sqrt(0.6), share = clamped ? 1.0 : 0.5;
  for (const auto& [s, weight] : {std::pair{-g, 5.0 / 18.0}, {0.0, 8.0 / 18.0}, {g, 5.0 / 18.0}}) {
    EdgePoint point;
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const auto [t, e] = sides[k];
      const Triangle& triangle = triangles_[t];
      const Eigen::Vector2d from = node_place(edge_nodes[e][0]), to = node_place(edge_nodes[e][1]);
      // The second side runs the edge backwards: the same point, the same direction in space.
      const double r = k == 0 ? 0.5 * (1.0 + s) : 0.5 * (1.0 - s);
      EdgeSide& side = point.side[k];
      side.place = triangle_place(from + r * (to - from));
      side.along = k == 0 ? Eigen::Vector2d(to - from) : Eigen::Vector2d(from - to);
      const ShellPoint p = shell_point(X[k], side.place);
      const Eigen::Vector3d T = p.tangent * side.along, conormal = T.normalized().cross(p.normal);
      const Eigen::Vector2d nu = p.tangent.transpose() * conormal;
      const Eigen::Matrix2d inverse_metric = (p.tangent.transpose() * p.tangent).inverse();
      const ShellElasticity& el = triangle.elasticity;
      const double D = bending_stiffness(el, triangle.thickness);
      // m = M^ab nu_a nu_b, M = D C : K; each component of b counts once.
      const Eigen::Vector3d q = D * plane_stress(el.poisson_ratio, inverse_metric) *
                                Eigen::Vector3d(nu[0] * nu[0], nu[1] * nu[1], 2.0 * nu[0] * nu[1]);
      side.moment = {q[0], q[1], 2.0 * q[2]};
      side.reference_b = p.b;
      if (k == 0) point.weight = weight * T.norm();
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
    for (int c = 0; c < 3; ++c) entries.push_back(layout_.body(node, c));
  entries_.push(entries);
  edges_.push_back(std::move(edge));
}

TriangleNodes Shell::positions(const State& state, int triangle) const {
  TriangleNodes x;
  for (int a = 0; a < 6; ++a) x.col(a) = state.values.segment<3>(layout_.body(triangles_[triangle].nodes[a]));
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

  static constexpr std::array<int, 6> own = {0, 1, 2, 3, 4, 5};
  const ShellPoint p = shell_point(x, point.place);
  const Eigen::Vector3d twice(1.0, 1.0, 2.0);
  const Eigen::Vector3d K = (p.b - point.reference_b).cwiseProduct(twice), M = point.bending * K, mu = M.cwiseProduct(twice);
  const Eigen::Vector3d deflection = (x - X) * point.N;
  const double w = deflection.dot(point.normal), k = triangle.foundation;
  element.energy += point.weight * 0.5 * (K.dot(M) + k * w * w);
  const Eigen::Matrix<double, 6, 1> c = p.c * mu;
  for (int a = 0; a < 6; ++a)
    element.residual.segment<3>(3 * a) += point.weight * (c[a] * p.normal + k * w * point.N[a] * point.normal);
  if (!tangent) return;
  const Eigen::Matrix<double, 6, 3> c2 = p.c * twice.asDiagonal();
  const Eigen::Matrix<double, 6, 6> stiff = point.weight * c2 * point.bending * c2.transpose(),
                                    springs = point.weight * k * point.N * point.N.transpose();
  const Eigen::Matrix3d nn = p.normal * p.normal.transpose(), NN = point.normal * point.normal.transpose();
  Eigen::MatrixXd more = Eigen::MatrixXd::Zero(18, 18);
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) more.block<3, 3>(3 * a, 3 * b) = stiff(a, b) * nn + springs(a, b) * NN;
  add_second_form_hessian(p, point.weight * mu, own, more);
  element.matrix += more;
}

EdgeElement Shell::edge_element(const State& state, const Edge& edge, bool tangent) const {
  EdgeElement element(3 * static_cast<int>(edge.nodes.size()));
  std::vector<TriangleNodes> x;
  for (const int t : edge.triangles) x.push_back(positions(state, t));
  for (const EdgePoint& point : edge.points) add_edge_point(x, point, edge.at, tangent, element);
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
  for (const Edge& edge : edges_) sum += edge_element(state, edge, false).energy;
  return sum;
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
      slot.matrix = slot.edge.matrix;
      return slot.edge.residual.allFinite();
    }
    slot.triangle.zero();
    const TriangleNodes x = positions(state, e), X = reference(e);
    for (const Point& point : triangles_[e].points) add_point(x, X, triangles_[e], point, wanted(tangent), slot.triangle);
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
      const double pressure = triangles_[t].foundation * (u * point.N).dot(point.normal);
      for (int a = 0; a < 6; ++a) forces[triangles_[t].nodes[a]] -= point.weight * pressure * point.N[a] * point.normal;
    }
  }
  return forces;
}

// S^ab = C^abcd (E - z K)_cd; sigma = S^ab a_a (x) a_b/(area ratio) with the tangents at z left at the middle's.
Eigen::Matrix<double, 6, 6> Shell::nodal_stress(const State& state, int t, double height) const {
  const Triangle& triangle = triangles_[t];
  const TriangleNodes x = positions(state, t), X = reference(t);
  const double nu = triangle.elasticity.poisson_ratio, plane = triangle.elasticity.youngs_modulus / (1.0 - nu * nu);
  const double z = 0.5 * height * triangle.thickness;
  Eigen::Matrix<double, 6, 6> stress;
  for (int a = 0; a < 6; ++a) {
    const TrianglePlace place = triangle_place(node_place(a));
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
