#include "mesh/pattern/sewn_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/fem/union_find.hpp"
#include "mesh/pattern/piece_mesh.hpp"

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using input::InputError;

/// The stretches of a pattern divided into sides of triangles; vertices of the border numbered over all pieces.
class DividedBorder {
 public:
  DividedBorder(const CheckedPattern& checked, double cell_size) : pattern_(checked.pattern), sewing_(checked.sewing) {
    for (std::size_t s = 0; s < sewing_.stretches.size(); ++s)
      divisions_.push_back(divisions(static_cast<int>(s), cell_size));
    for (const OpenLoop& loop : sewing_.open) open_at_least_three(loop);
    for (const Stretch& stretch : sewing_.stretches) add(stretch);
    same_ = merged();
  }

  int count(int stretch) const { return divisions_[stretch]; }
  /// The k-th vertex of a stretch, from 0 to its count.
  int vertex(int stretch, int k) const {
    return k < divisions_[stretch] ? first_[stretch] + k : first_[sewing_.stretches[stretch].next];
  }
  const Vector2d& place(int vertex) const { return places_[vertex]; }
  int representative(int vertex) const { return same_[vertex]; }
  int size() const { return static_cast<int>(places_.size()); }

  /// Vertices of the loops of a piece, in their order.
  std::vector<std::vector<int>> loops(int piece) const {
    std::vector<std::vector<int>> result;
    for (const Loop& loop : pattern_.pieces[piece].loops) {
      result.emplace_back();
      for (std::size_t s = 0; s < sewing_.stretches.size(); ++s) {
        const EdgePart& part = sewing_.stretches[s].part;
        if (part.piece != piece || part.edge < loop.begin || part.edge >= loop.end) continue;
        for (int k = 0; k < divisions_[s]; ++k) result.back().push_back(first_[s] + k);
      }
    }
    return result;
  }

 private:
  /// By the longer side of a seam. A stretch whose ends become one vertex closes in itself: three at least.
  int divisions(int s, double cell_size) const {
    const Stretch& stretch = sewing_.stretches[s];
    const auto closes = [&](const Stretch& one) { return sewing_.corners[one.begin] == sewing_.corners[one.end]; };
    double longest = stretch.length;
    bool closed = closes(stretch);
    if (stretch.partner >= 0) {
      longest = std::max(longest, sewing_.stretches[stretch.partner].length);
      closed = closed || closes(sewing_.stretches[stretch.partner]);
    }
    return std::max(closed ? 3 : 1, static_cast<int>(std::lround(std::min(longest / cell_size, 1e6))));
  }

  /// Two sides of triangles that go to and fro would look like a seam.
  void open_at_least_three(const OpenLoop& loop) {
    int count = 0;
    for (const int s : loop.stretches) count += divisions_[s];
    if (count < 3)
      for (const int s : loop.stretches) divisions_[s] = 3;
  }

  void add(const Stretch& stretch) {
    const int count = divisions_[first_.size()];
    first_.push_back(static_cast<int>(places_.size()));
    const ArcLength along(pattern_.pieces[stretch.part.piece].edges[stretch.part.edge].curve);
    for (int k = 0; k < count; ++k)
      places_.push_back(along.at(stretch.part.from + (stretch.part.to - stretch.part.from) * k / count));
  }

  std::vector<int> merged() const {
    fem::UnionFind nodes(places_.size());
    for (std::size_t s = 0; s < sewing_.stretches.size(); ++s) {
      const int partner = sewing_.stretches[s].partner, count = divisions_[s];
      if (partner > static_cast<int>(s))
        for (int k = 0; k <= count; ++k) nodes.merge(vertex(static_cast<int>(s), k), vertex(partner, count - k));
    }
    return nodes.representatives();
  }

  const Pattern& pattern_;
  const Sewing& sewing_;
  std::vector<int> divisions_, first_, same_;
  std::vector<Vector2d> places_;
};

/// Puts the meshes of the pieces together.
class Assembly {
 public:
  Assembly(const CheckedPattern& checked, double cell_size)
      : checked_(checked), cell_size_(cell_size), border_(checked, cell_size), node_(border_.size(), -1) {}

  SewnMesh take() {
    for (std::size_t p = 0; p < checked_.pattern.pieces.size(); ++p) add_piece(static_cast<int>(p));
    merge();
    name_edges();
    name_open();
    return std::move(mesh_);
  }

 private:
  void add_piece(int p) {
    const Piece& piece = checked_.pattern.pieces[p];
    std::vector<std::vector<Vector2d>> loops;
    std::vector<int> vertices, same;
    for (const std::vector<int>& loop : border_.loops(p)) {
      loops.emplace_back();
      for (const int vertex : loop) {
        loops.back().push_back(border_.place(vertex));
        vertices.push_back(vertex), same.push_back(border_.representative(vertex));
      }
    }
    const PieceMesh piece_mesh = meshed(piece, loops, same);
    const int first = static_cast<int>(mesh_.flat.size());
    for (std::size_t n = 0; n < vertices.size(); ++n) node_[vertices[n]] = first + static_cast<int>(n);
    for (const Vector2d& x : piece_mesh.vertices) add_node(x, p);
    for (const auto& t : piece_mesh.triangles) {
      const std::array<int, 3> v = {first + t[0], first + t[1], first + t[2]};
      mesh_.triangles.push_back(
          {v[0], v[1], v[2], middle(v[0], v[1], p), middle(v[1], v[2], p), middle(v[2], v[0], p)});
      mesh_.triangle_piece.push_back(p);
      mesh_.warp.push_back(piece.grain);
      for (int n = 0; n < 3; ++n) sum_ += (mesh_.flat[v[n]] - mesh_.flat[v[(n + 1) % 3]]).norm();
    }
    mesh_.pieces.push_back(piece.name);
    mesh_.mean_edge = sum_ / (3.0 * static_cast<double>(mesh_.triangles.size()));
  }

  PieceMesh meshed(const Piece& piece, const std::vector<std::vector<Vector2d>>& loops,
                   const std::vector<int>& same) const {
    std::string reason;
    for (const auto& loop : loops)
      if (loop.size() < 3) reason = "a border of less than three sides";
    if (area(piece) > 2e6 * cell_size_ * cell_size_) reason = "more than some five million triangles";
    if (reason.empty()) try {
        return mesh_piece(loops, same, cell_size_);
      } catch (const std::exception& error) {
        reason = error.what();
      }
    throw InputError(
        piece.where,
        fmt::format("the piece {} cannot be meshed with cells of {:.3g} mm: {}", piece.name, 1e3 * cell_size_, reason),
        "take smaller cells where the piece is narrow, larger ones where it is large");
  }

  int add_node(const Vector2d& x, int piece) {
    mesh_.flat.push_back(x);
    mesh_.node_piece.push_back(piece);
    return static_cast<int>(mesh_.flat.size()) - 1;
  }

  int middle(int a, int b, int piece) {
    const auto [at, added] = middles_.emplace(std::pair(std::min(a, b), std::max(a, b)), 0);
    if (added) at->second = add_node(0.5 * (mesh_.flat[a] + mesh_.flat[b]), piece);
    return at->second;
  }

  /// Nodes of a stretch from its beginning to its end, mid-edge nodes too.
  std::vector<int> nodes_of(int stretch) const {
    std::vector<int> result{node_[border_.vertex(stretch, 0)]};
    for (int k = 0; k < border_.count(stretch); ++k) {
      const int a = result.back(), b = node_[border_.vertex(stretch, k + 1)];
      result.push_back(middles_.at({std::min(a, b), std::max(a, b)}));
      result.push_back(b);
    }
    return result;
  }

  bool covers(const EdgePart& part, const EdgePart& stretch) const {
    return part.piece == stretch.piece && part.edge == stretch.edge && part.from <= stretch.from + 1e-6 &&
           part.to >= stretch.to - 1e-6;
  }

  /// Stretches of a chain, in order.
  std::vector<int> stretches_of(const EdgeChain& chain) const {
    std::vector<int> result;
    for (const EdgePart& part : chain)
      for (std::size_t s = 0; s < checked_.sewing.stretches.size(); ++s)
        if (covers(part, checked_.sewing.stretches[s].part)) result.push_back(static_cast<int>(s));
    return result;
  }

  void merge() {
    fem::UnionFind nodes(mesh_.flat.size());
    for (const Seam& seam : checked_.pattern.seams) {
      SewnSeam sewn{seam.name, {}};
      for (const int s : stretches_of(seam.a)) {
        const std::vector<int> a = nodes_of(s), b = nodes_of(checked_.sewing.stretches[s].partner);
        for (std::size_t n = sewn.pairs.empty() ? 0 : 1; n < a.size(); ++n)
          sewn.pairs.push_back({a[n], b[b.size() - 1 - n]});
        for (std::size_t n = 0; n < a.size(); ++n) nodes.merge(a[n], b[b.size() - 1 - n]);
      }
      mesh_.seams.push_back(std::move(sewn));
    }
    mesh_.merged = nodes.representatives();
  }

  std::vector<int> nodes_along(const std::vector<int>& stretches) const {
    std::vector<int> result;
    for (const int s : stretches)
      for (const int node : nodes_of(s))
        if (result.empty() || result.back() != node) result.push_back(node);
    return result;
  }

  void name_edges() {
    const auto& pieces = checked_.pattern.pieces;
    for (std::size_t p = 0; p < pieces.size(); ++p)
      for (std::size_t e = 0; e < pieces[p].edges.size(); ++e)
        mesh_.edges[pieces[p].name + "." + pieces[p].edges[e].name] =
            nodes_along(stretches_of({{static_cast<int>(p), static_cast<int>(e)}}));
  }

  std::vector<int> representatives_along(const std::vector<int>& stretches, bool closed) const {
    std::vector<int> result;
    for (const int s : stretches)
      for (const int node : nodes_of(s))
        if (const int one = mesh_.merged[node]; result.empty() || result.back() != one) result.push_back(one);
    if (closed && result.size() > 1 && result.front() == result.back()) result.pop_back();
    return result;
  }

  void name_open() {
    for (const OpenLoop& loop : checked_.sewing.open)
      mesh_.open[loop.name] = representatives_along(loop.stretches, true);
    for (const Hem& hem : checked_.pattern.hems)
      if (!mesh_.open.contains(hem.name)) mesh_.open[hem.name] = representatives_along(stretches_of(hem.edges), false);
  }

  const CheckedPattern& checked_;
  double cell_size_;
  DividedBorder border_;
  std::vector<int> node_;  // of the border's vertices
  std::map<std::pair<int, int>, int> middles_;
  SewnMesh mesh_;
  double sum_ = 0.0;
};

/// The pieces in a row, a hand's breadth apart.
std::vector<Vector2d> side_by_side(const SewnMesh& sewn) {
  std::vector<Eigen::AlignedBox2d> boxes(sewn.pieces.size());
  for (std::size_t n = 0; n < sewn.flat.size(); ++n) boxes[sewn.node_piece[n]].extend(sewn.flat[n]);
  std::vector<Vector2d> shift;
  double x = 0.0;
  for (const Eigen::AlignedBox2d& box : boxes) {
    shift.emplace_back(x - box.min().x(), -box.min().y());
    x += box.sizes().x() + 0.1;
  }
  return shift;
}

}  // namespace

SewnMesh mesh_pattern(const CheckedPattern& checked, double cell_size) {
  double perimeter = 0.0;
  for (const Stretch& stretch : checked.sewing.stretches) perimeter += stretch.length;
  if (!(cell_size > 0.0) || perimeter > 1e6 * cell_size)
    throw InputError({.file = checked.pattern.file},
                     fmt::format("cells of {:.3g} mm for borders of {:.3g} m", 1e3 * cell_size, perimeter),
                     "take larger cells");
  return Assembly(checked, cell_size).take();
}

GarmentMesh garment_mesh(const SewnMesh& sewn, const std::vector<Eigen::Vector3d>& placed, const std::string& name) {
  if (placed.size() != sewn.flat.size())
    throw std::invalid_argument(fmt::format("{} places for {} nodes", placed.size(), sewn.flat.size()));
  for (std::size_t n = 0; n < placed.size(); ++n)
    if (placed[n] != placed[sewn.merged[n]]) throw std::invalid_argument("two nodes of a seam stand in two places");
  GarmentMesh mesh;
  mesh.name = name;
  const std::vector<Vector2d> shift = side_by_side(sewn);
  for (std::size_t n = 0; n < sewn.flat.size(); ++n) mesh.pattern.push_back(sewn.flat[n] + shift[sewn.node_piece[n]]);
  mesh.placed = placed;
  mesh.triangles = sewn.triangles;
  mesh.merged = sewn.merged;
  mesh.warp = sewn.warp;
  mesh.edges = sewn.open;
  mesh.mean_edge = sewn.mean_edge;
  mesh.pieces = sewn.pieces;
  mesh.triangle_piece = sewn.triangle_piece;
  mesh.seams = sewn.seams;
  return mesh;
}

}  // namespace snug::mesh
