#include "mesh/garment/tube_chart.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>

#include "mesh/garment/corner_gradients.hpp"

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using input::InputError;
using Edge = std::pair<int, int>;  // of representatives, from - to with the cloth on the left

constexpr std::array<int, 3> following = {1, 2, 0};

/// Triangles between representatives, and the edges that they have.
class Surface {
 public:
  explicit Surface(const SewnMesh& sewn) : sewn_(sewn) {
    for (const auto& t : sewn.triangles) corners_.push_back({sewn.merged[t[0]], sewn.merged[t[1]], sewn.merged[t[2]]});
    for (std::size_t t = 0; t < corners_.size(); ++t)
      for (int e = 0; e < 3; ++e) triangle_of_[edge(static_cast<int>(t), e)] = static_cast<int>(t);
  }

  int triangles() const { return static_cast<int>(corners_.size()); }
  const std::array<int, 3>& corners(int t) const { return corners_[t]; }
  Edge edge(int t, int e) const { return {corners_[t][e], corners_[t][following[e]]}; }
  /// The triangle across an edge, -1: none.
  int across(int t, int e) const {
    const auto [a, b] = edge(t, e);
    const auto it = triangle_of_.find({b, a});
    return it == triangle_of_.end() ? -1 : it->second;
  }

  /// Gradients of the corner functions in the drawing (columns) and the area, m2.
  double gradients(int t, Eigen::Matrix<double, 2, 3>& result) const {
    const auto& n = sewn_.triangles[t];
    const auto [shape, area] = corner_gradients(sewn_.flat[n[0]], sewn_.flat[n[1]], sewn_.flat[n[2]]);
    result = shape;
    return area;
  }

 private:
  const SewnMesh& sewn_;
  std::vector<std::array<int, 3>> corners_;
  std::map<Edge, int> triangle_of_;
};

/// The function of the vertices whose gradient is nearest to given vectors of the triangles; zero at one vertex.
std::vector<double> fit_gradient(const Surface& surface, std::size_t nodes, const std::vector<Vector2d>& wanted) {
  std::vector<int> unknown(nodes, -1);
  int count = 0;
  for (int t = 0; t < surface.triangles(); ++t)
    for (const int v : surface.corners(t))
      if (unknown[v] < 0) unknown[v] = count++;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  for (int t = 0; t < surface.triangles(); ++t) {
    Eigen::Matrix<double, 2, 3> g;
    const double area = surface.gradients(t, g);
    const auto& v = surface.corners(t);
    for (int a = 0; a < 3; ++a) {
      right[unknown[v[a]]] += area * g.col(a).dot(wanted[t]);
      for (int b = 0; b < 3; ++b) entries.emplace_back(unknown[v[a]], unknown[v[b]], area * g.col(a).dot(g.col(b)));
    }
  }
  entries.emplace_back(0, 0, 1.0);  // the constant
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  const Eigen::VectorXd x = factor.solve(right);
  std::vector<double> result(nodes, 0.0);
  for (std::size_t n = 0; n < nodes; ++n)
    if (unknown[n] >= 0) result[n] = x[unknown[n]];
  return result;
}

/// Differences along the edges of each triangle whose sums vanish in every triangle and are 1 once round: those of a strip of triangles
/// from one loop to the other, which every way round has to cross.
std::vector<Eigen::Vector3d> jumps(const Surface& surface, const std::vector<int>& from, const std::vector<int>& to) {
  const auto border_edge = [&](int t, const std::vector<int>& loop) {
    for (int e = 0; e < 3; ++e) {
      if (surface.across(t, e) >= 0) continue;
      const Edge edge = surface.edge(t, e);
      for (std::size_t k = 0; k < loop.size(); ++k)
        if (Edge{loop[k], loop[(k + 1) % loop.size()]} == edge) return e;
    }
    return -1;
  };
  std::vector<int> entered(surface.triangles(), -2), previous(surface.triangles(), -1);  // edge of this triangle
  std::deque<int> queue;
  for (int t = 0; t < surface.triangles(); ++t)
    if (const int e = border_edge(t, from); e >= 0) entered[t] = e, queue.push_back(t);
  std::vector<Eigen::Vector3d> result(surface.triangles(), Eigen::Vector3d::Zero());
  for (; !queue.empty(); queue.pop_front()) {
    int t = queue.front();
    int leave = border_edge(t, to);
    if (leave >= 0 && leave != entered[t]) {
      for (; t >= 0; t = previous[t]) {
        result[t][leave] += 1.0, result[t][entered[t]] -= 1.0;
        if (const int p = previous[t]; p >= 0)
          for (int e = 0; e < 3; ++e)
            if (surface.across(p, e) == t && surface.edge(p, e) == Edge{surface.edge(t, entered[t]).second, surface.edge(t, entered[t]).first}) leave = e;
      }
      return result;
    }
    for (int e = 0; e < 3; ++e)
      if (const int next = surface.across(t, e); next >= 0 && entered[next] == -2) {
        const Edge shared = surface.edge(t, e);
        for (int f = 0; f < 3; ++f)
          if (surface.edge(next, f) == Edge{shared.second, shared.first}) entered[next] = f;
        previous[next] = t;
        queue.push_back(next);
      }
  }
  return result;
}

/// Gradients in the triangles of a function that jumps.
std::vector<Vector2d> gradients(const Surface& surface, const std::vector<double>& values, const std::vector<Eigen::Vector3d>& jump) {
  std::vector<Vector2d> result;
  for (int t = 0; t < surface.triangles(); ++t) {
    Eigen::Matrix<double, 2, 3> g;
    surface.gradients(t, g);
    const auto& v = surface.corners(t);
    const double first = values[v[1]] - values[v[0]] + jump[t][0], last = values[v[2]] - values[v[0]] - jump[t][2];
    result.push_back(g.col(1) * first + g.col(2) * last);
  }
  return result;
}

double mean_height(const SewnMesh& sewn, const std::vector<int>& loop) {
  double sum = 0.0;
  for (const int v : loop) sum += sewn.flat[v].y() / static_cast<double>(loop.size());
  return sum;
}

double length(const SewnMesh& sewn, const std::vector<int>& loop) {
  // A side of the border lies in one piece; its ends may have representatives in others.
  std::map<Edge, double> sides;
  for (const auto& t : sewn.triangles)
    for (int e = 0; e < 3; ++e)
      sides[{sewn.merged[t[e]], sewn.merged[t[following[e]]]}] = (sewn.flat[t[e]] - sewn.flat[t[following[e]]]).norm();
  double sum = 0.0;
  for (std::size_t k = 0; k < loop.size(); ++k) sum += sides[{loop[k], loop[(k + 1) % loop.size()]}];
  return sum;
}

void check_connected(const SewnMesh& sewn, const Surface& surface, const input::Location& where) {
  std::vector<char> seen(surface.triangles(), 0);
  std::deque<int> queue = {0};
  seen[0] = 1;
  for (; !queue.empty(); queue.pop_front())
    for (int e = 0; e < 3; ++e)
      if (const int next = surface.across(queue.front(), e); next >= 0 && !seen[next]) seen[next] = 1, queue.push_back(next);
  for (int t = 0; t < surface.triangles(); ++t)
    if (!seen[t])
      throw InputError(where, fmt::format("the pieces {} and {} are not sewn together", sewn.pieces[sewn.triangle_piece[0]], sewn.pieces[sewn.triangle_piece[t]]),
                       "add the seams that join them, or name the pieces of one garment: pattern = { file = ..., pieces = [...] }");
}

/// Loops of a garment that goes round one limb.
struct Ends {
  std::vector<int> bottom, top;
};

Ends ends_of(const SewnMesh& sewn, const Surface& surface, const std::string& bottom, const input::Location& where) {
  std::vector<std::vector<int>> loops = open_loops(sewn);
  std::map<Edge, int> edges;
  std::map<int, int> vertices;
  for (int t = 0; t < surface.triangles(); ++t)
    for (int e = 0; e < 3; ++e) {
      const auto [a, b] = surface.edge(t, e);
      edges[{std::min(a, b), std::max(a, b)}] = 1, vertices[a] = 1;
    }
  const long euler = static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) + surface.triangles();
  if (loops.size() < 2)
    throw InputError(where, fmt::format("the sewn garment has {} opening{}", loops.size(), loops.size() == 1 ? "" : "s"),
                     "a garment round a limb has one below and one above; see the open edges that snug pattern lists");
  if (euler != 2 - static_cast<long>(loops.size()))
    throw InputError(where, "the sewn garment goes through itself: it has handles", "look whether seams are crossed (snug pattern)");
  std::sort(loops.begin(), loops.end(), [&](const auto& a, const auto& b) { return mean_height(sewn, a) < mean_height(sewn, b); });
  Ends ends{loops.front(), loops.back()};
  if (!bottom.empty()) {
    const auto named = sewn.open.find(bottom);
    const auto has = [&](const std::vector<int>& loop) {
      return named != sewn.open.end() && std::find(loop.begin(), loop.end(), named->second.front()) != loop.end();
    };
    const auto found = std::find_if(loops.begin(), loops.end(), has);
    if (found == loops.end()) {
      std::vector<std::string> names;
      for (const auto& [name, nodes] : sewn.open) names.push_back("\"" + name + "\"");
      throw InputError(where, fmt::format("\"{}\" is no open edge of the pattern", bottom), fmt::format("its open edges are {}", fmt::join(names, ", ")));
    }
    ends.bottom = *found;
    ends.top = found == loops.begin() ? loops.back() : loops.front();
    return ends;
  }
  const double apart = mean_height(sewn, ends.top) - mean_height(sewn, ends.bottom), low = length(sewn, ends.bottom), high = length(sewn, ends.top);
  if (apart < 0.05 * (low + high) && high < low) std::swap(ends.bottom, ends.top);  // drawn on its side: limbs taper downwards
  return ends;
}

double mean(const std::vector<double>& values, const std::vector<int>& at) {
  double sum = 0.0;
  for (const int v : at) sum += values[v] / static_cast<double>(at.size());
  return sum;
}

}  // namespace

std::vector<std::vector<int>> open_loops(const SewnMesh& sewn) {
  const Surface surface(sewn);
  std::map<int, int> next;
  for (int t = 0; t < surface.triangles(); ++t)
    for (int e = 0; e < 3; ++e)
      if (surface.across(t, e) < 0) next[surface.edge(t, e).first] = surface.edge(t, e).second;
  std::vector<std::vector<int>> loops;
  while (!next.empty()) {
    std::vector<int>& loop = loops.emplace_back();
    for (auto it = next.begin(); it != next.end();) {
      loop.push_back(it->first);
      const int to = it->second;
      next.erase(it);
      it = next.find(to);
    }
  }
  return loops;
}

TubeChart tube_chart(const SewnMesh& sewn, const std::string& bottom, const input::Location& where) {
  const Surface surface(sewn);
  check_connected(sewn, surface, where);
  const Ends ends = ends_of(sewn, surface, bottom, where);
  std::vector<Eigen::Vector3d> jump = jumps(surface, ends.bottom, ends.top);
  TubeChart chart;
  for (const double sign : {1.0, -1.0}) {  // the way round that has the outside out and the bottom below
    std::vector<Eigen::Vector3d> signed_jump = jump;
    for (Eigen::Vector3d& j : signed_jump) j *= sign;
    const std::vector<double> zero(sewn.flat.size(), 0.0);
    std::vector<Vector2d> wanted = gradients(surface, zero, signed_jump);
    for (Vector2d& g : wanted) g = -g;
    chart.round = fit_gradient(surface, sewn.flat.size(), wanted);
    std::vector<Vector2d> upwards = gradients(surface, chart.round, signed_jump);
    for (Vector2d& g : upwards) g = Vector2d(-g.y(), g.x()).normalized();
    chart.up = fit_gradient(surface, sewn.flat.size(), upwards);
    if (mean(chart.up, ends.top) > mean(chart.up, ends.bottom)) break;
  }
  double lowest = std::numeric_limits<double>::max();
  for (int t = 0; t < surface.triangles(); ++t)
    for (const int v : surface.corners(t)) lowest = std::min(lowest, chart.up[v]);
  for (double& u : chart.up) u -= lowest;
  return chart;
}

}  // namespace snug::mesh
