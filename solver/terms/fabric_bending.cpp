#include "solver/terms/fabric_bending.hpp"

#include <Eigen/Dense>

#include <cmath>
#include <map>

#include "materials/fabric/packing.hpp"
#include "solver/terms/garment_shape.hpp"
#include "solver/terms/parallel.hpp"

namespace snug::solver {

namespace {

/// (k11, k22, 2 k12) along the columns of `frame` from the second form (11, 22, 12) along the columns of `tangents`:
/// k = f.b f with the frame's components f in the coordinates.
Eigen::Matrix3d to_frame(const Eigen::Matrix2d& tangents, const Eigen::Matrix2d& frame) {
  const Eigen::Matrix2d f = tangents.inverse() * frame;
  Eigen::Matrix3d T;
  T << f(0, 0) * f(0, 0), f(1, 0) * f(1, 0), 2.0 * f(0, 0) * f(1, 0),
      f(0, 1) * f(0, 1), f(1, 1) * f(1, 1), 2.0 * f(0, 1) * f(1, 1),
      2.0 * f(0, 0) * f(0, 1), 2.0 * f(1, 0) * f(1, 1), 2.0 * (f(0, 0) * f(1, 1) + f(1, 0) * f(0, 1));
  return T;
}

}  // namespace

FabricBending::FabricBending(std::string garment, const Field& positions, const mesh::GarmentMesh& mesh,
                             const std::vector<materials::BendingStiffness>& stiffness, std::vector<double> in_plane)
    : garment_(std::move(garment)), field_(positions), in_plane_(std::move(in_plane)) {
  for (const materials::BendingStiffness& one : stiffness) stiffness_.emplace_back(Eigen::Vector3d(one.warp, one.weft, one.twist()).asDiagonal());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) add_triangle(mesh, t);
  add_edges();
}

Eigen::Matrix2d FabricBending::Triangle::tangents(const TrianglePlace& place) const {
  Eigen::Matrix2d along = pattern * place.dN;
  along.row(0) *= course_value(course, place.N);
  return along;
}

void FabricBending::add_triangle(const mesh::GarmentMesh& mesh, std::size_t t) {
  Triangle triangle;
  triangle.fabric = 1 + mesh.zone_of(t), triangle.course = mesh.course_of(t);
  triangle.frame.col(0) = mesh.warp[t];
  triangle.frame.col(1) = Eigen::Vector2d(-mesh.warp[t].y(), mesh.warp[t].x());
  std::array<int, 18> entries{};
  for (int a = 0; a < 6; ++a) {
    triangle.nodes[a] = mesh.merged[mesh.triangles[t][a]];
    triangle.pattern.col(a) = mesh.pattern[mesh.triangles[t][a]];
    for (int c = 0; c < 3; ++c) entries[3 * a + c] = field_(triangle.nodes[a], c);
  }
  for (const BendingRulePoint& q : bending_rule()) {
    Point point;
    point.place = triangle_place(q.xi);
    const Eigen::Matrix2d tangents = triangle.tangents(point.place);
    const Eigen::Matrix3d T = to_frame(tangents, triangle.frame);
    point.stiffness = T.transpose() * stiffness_[triangle.fabric] * T;
    point.weight = q.weight * tangents.determinant();
    point.gradient = tangents.inverse().transpose() * point.place.dN.transpose();
    triangle.area += point.weight;
    triangle.points.push_back(point);
  }
  entries_.push(entries);
  triangles_.push_back(std::move(triangle));
}

// Triangles meet where they share the node in the middle of an edge, which seams have merged.
void FabricBending::add_edges() {
  std::map<int, std::vector<std::array<int, 2>>> sides;  // middle -> triangle and edge
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (int e = 0; e < 3; ++e)
      sides[triangles_[t].nodes[triangle_edges[e][2]]].push_back({static_cast<int>(t), e});
  for (const auto& [middle, around] : sides)
    if (around.size() == 2) add_edge(around);
}

void FabricBending::add_edge(const std::vector<std::array<int, 2>>& sides) {
  EdgeSides edge;
  for (const auto& [t, e] : sides) edge.add(t, triangles_[t].nodes);
  for (int q = 0; q < 3; ++q) {
    EdgePoint point;
    for (int k = 0; k < 2; ++k) set_side(point, k, sides[k], q);
    edge.points.push_back(point);
  }
  std::vector<int> entries;
  for (const int node : edge.nodes)
    for (int c = 0; c < 3; ++c) entries.push_back(field_(node, c));
  entries_.push(entries);
  edges_.push_back(std::move(edge));
}

// The moment about the edge, m = M_ij n_i n_j with the normal n of the edge in the pattern: each side has its own edge there,
// its own fabric direction and its own length where ease is sewn in. A seam lies flat: its rest angle is nothing.
void FabricBending::set_side(EdgePoint& point, int k, const std::array<int, 2>& at, int q) const {
  const auto [t, e] = at;
  const Triangle& triangle = triangles_[t];
  const EdgePlace place = edge_place(e, q, k == 1);
  EdgeSide& side = point.side[k];
  side.place = place.place, side.along = place.along;
  side.reference_b.setZero();
  const Eigen::Matrix2d tangents = triangle.tangents(place.place);
  const Eigen::Matrix3d& stiffness = stiffness_[triangle.fabric];
  const Eigen::Vector2d along = tangents * place.along, n = triangle.frame.transpose() * Eigen::Vector2d(along.y(), -along.x()).normalized();
  const Eigen::Vector3d across(n[0] * n[0], n[1] * n[1], 2.0 * n[0] * n[1]);
  side.moment = to_frame(tangents, triangle.frame).transpose() * stiffness * across;
  point.weight += 0.5 * edge_weight(q) * along.norm();
  point.penalty += edge_penalty(0.5, across.dot(stiffness * across), along.norm(), triangle.area);
}

TriangleNodes FabricBending::positions(const State& state, int triangle) const {
  TriangleNodes x;
  for (int a = 0; a < 6; ++a) x.col(a) = state.values.segment<3>(field_(triangles_[triangle].nodes[a]));
  return x;
}

EdgeElement FabricBending::edge_element(const State& state, const EdgeSides& edge, Tangent tangent) const {
  EdgeElement element(3 * static_cast<int>(edge.nodes.size()));
  std::vector<TriangleNodes> x;
  for (const int t : edge.triangles) x.push_back(positions(state, t));
  for (const EdgePoint& point : edge.points)
    add_edge_point(x, point, edge.at, wanted(tangent), tangent == Tangent::full, element);
  return element;
}

void FabricBending::add_point(const TriangleNodes& x, const Triangle& triangle, const Point& point, bool tangent, bool geometric, MembraneElement<6>& element) const {
  add_bending_point(shell_point(x, point.place), Eigen::Vector3d::Zero(), point.stiffness, point.weight, tangent, geometric, element);
  if (in_plane_.empty()) return;
  materials::MembraneResponse response;
  const Eigen::Vector3d strain = membrane_strain<6>(x, point.gradient);
  materials::add_packing(strain, in_plane_[triangle.fabric], response);
  if (response.energy == 0.0) return;
  const bool convex = tangent && !geometric;
  add_membrane_point<6>(x, point.gradient, point.weight, response, tangent && !convex, element);
  if (!convex) return;
  response.energy = 0.0, response.force.setZero();  // its push, which turns with the sheet, is what may be indefinite
  add_membrane_point<6>(x, point.gradient, point.weight, response, true, element);
}

double FabricBending::energy(const State& state) const {
  double sum = 0.0;
  MembraneElement<6> element;
  element.zero();
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (const Point& point : triangles_[t].points) add_point(positions(state, static_cast<int>(t)), triangles_[t], point, false, false, element);
  sum += element.energy;
  for (const EdgeSides& edge : edges_) sum += edge_element(state, edge, Tangent::none).energy;
  return sum;
}

struct FabricBending::Slot {
  MembraneElement<6> triangle;
  EdgeElement edge{0};
};

bool FabricBending::assemble(const State& state, Tangent tangent, Sink& sink) const {
  std::vector<Slot> slots(128);
  const int count = static_cast<int>(triangles_.size());
  const bool matrix = wanted(tangent), geometric = tangent == Tangent::full;
  const auto compute = [&](int e, Slot& slot) {
    if (e >= count) {
      slot.edge = edge_element(state, edges_[e - count], tangent);
      return slot.edge.residual.allFinite();
    }
    slot.triangle.zero();
    const TriangleNodes x = positions(state, e);
    for (const Point& point : triangles_[e].points) add_point(x, triangles_[e], point, matrix, geometric, slot.triangle);
    return slot.triangle.residual.allFinite();
  };
  const auto consume = [&](int e, Slot& slot) {  // matrices are symmetric: it does not matter how they are stored
    const auto add = [&](const double* residual, const double* tangents, std::size_t size) {
      sink.add(e, {residual, size}, matrix ? std::span<const double>(tangents, size * size) : std::span<const double>());
    };
    if (e < count) return add(slot.triangle.residual.data(), slot.triangle.matrix.data(), 18);
    add(slot.edge.residual.data(), slot.edge.matrix.data(), static_cast<std::size_t>(slot.edge.residual.size()));
  };
  return for_elements(sink, entries_.elements(), slots, compute, consume);
}

double FabricBending::step_bound(const State& state, const Eigen::VectorXd& direction, double limit) const {
  // No point may turn by more than a right angle.
  State moved = state;
  for (int halving = 0; halving < 12; ++halving, limit *= 0.5) {
    moved.values = state.values + limit * direction;
    bool ok = true;
    for (int t = 0; t < static_cast<int>(triangles_.size()) && ok; ++t)
      for (const Point& point : triangles_[t].points)
        ok = ok && shell_point(positions(moved, t), point.place).normal.dot(shell_point(positions(state, t), point.place).normal) > 0.0;
    if (ok) break;
  }
  return limit;
}

}  // namespace snug::solver
