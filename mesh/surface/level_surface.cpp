#include "mesh/surface/level_surface.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace snug::mesh {

namespace {

constexpr int block = 4;           // cells of a block that is looked at in one
constexpr double unknown = -1e30;  // as outside

/// The function at the points of a grid; where the surface is not near, its sign alone counts.
class LevelGrid {
 public:
  LevelGrid(const std::function<double(const Eigen::Vector3d&)>& level, const Box& box, double spacing) : level_(level), low_(box.low), h_(spacing) {
    for (int a = 0; a < 3; ++a) n_[a] = std::max(2, static_cast<int>(std::ceil((box.high[a] - box.low[a]) / h_)) + 1);
    value_.assign(static_cast<std::size_t>(n_[0]) * n_[1] * n_[2], unknown);
    const double radius = 0.5 * block * std::sqrt(3.0) * h_;
    for (int i = 0; i + 1 < n_[0]; i += block)
      for (int j = 0; j + 1 < n_[1]; j += block)
        for (int k = 0; k + 1 < n_[2]; k += block) {
          const double at = over(low_ + h_ * (Eigen::Vector3d(i, j, k) + Eigen::Vector3d::Constant(0.5 * block)));
          fill(i, j, k, std::abs(at) > 1.5 * radius ? at : std::numeric_limits<double>::quiet_NaN());
        }
  }
  const std::array<int, 3>& counts() const { return n_; }
  std::size_t index(int i, int j, int k) const { return (static_cast<std::size_t>(i) * n_[1] + j) * n_[2] + k; }
  /// Points on the border count as outside, so that the surface is closed.
  double value(int i, int j, int k) const {
    const bool border = i == 0 || j == 0 || k == 0 || i == n_[0] - 1 || j == n_[1] - 1 || k == n_[2] - 1;
    const double at = value_[index(i, j, k)];
    return border ? std::min(at, -0.5 * h_) : at;
  }
  bool on_border(const Eigen::Vector3d& x) const {
    const Eigen::Array3d at = ((x - low_) / h_).array();
    return (at < 0.5).any() || (at > Eigen::Array3d(n_[0], n_[1], n_[2]) - 1.5).any();
  }
  Eigen::Vector3d point(int i, int j, int k) const { return low_ + h_ * Eigen::Vector3d(i, j, k); }

 private:
  double over(const Eigen::Vector3d& x) const {
    const double at = level_(x);
    return std::abs(at) < 1e-9 * h_ ? 1e-9 * h_ : at;
  }
  void fill(int i0, int j0, int k0, double all) {
    for (int i = i0; i <= std::min(i0 + block, n_[0] - 1); ++i)
      for (int j = j0; j <= std::min(j0 + block, n_[1] - 1); ++j)
        for (int k = k0; k <= std::min(k0 + block, n_[2] - 1); ++k) {
          double& at = value_[index(i, j, k)];
          if (!std::isnan(all)) {
            if (at == unknown) at = all > 0.0 ? 1.0 : -1.0;
          } else if (at == unknown || std::abs(at) == 1.0) {
            at = over(point(i, j, k));
          }
        }
  }

  const std::function<double(const Eigen::Vector3d&)>& level_;
  Eigen::Vector3d low_;
  double h_;
  std::array<int, 3> n_{};
  std::vector<double> value_;
};

/// The surface where a function on a grid is zero, by Kuhn's tetrahedra; triangles show the side of negative values.
class Marching {
 public:
  Marching(const LevelGrid& grid, const std::function<double(const Eigen::Vector3d&)>& level) : grid_(grid), level_(level) {
    const auto& n = grid.counts();
    for (int i = 0; i + 1 < n[0]; ++i)
      for (int j = 0; j + 1 < n[1]; ++j)
        for (int k = 0; k + 1 < n[2]; ++k) cell(i, j, k);
  }
  TriangleSurface take() { return std::move(surface_); }

 private:
  struct Corner {
    std::size_t index;
    double value;
    Eigen::Vector3d x;
  };

  void cell(int i, int j, int k) {
    int positive = 0;
    std::array<double, 8> v;
    for (int c = 0; c < 8; ++c) positive += (v[c] = grid_.value(i + (c & 1), j + ((c >> 1) & 1), k + (c >> 2))) > 0.0;
    if (positive == 0 || positive == 8) return;
    static constexpr std::array<std::array<int, 4>, 6> tetrahedra = {{{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};
    for (const auto& t : tetrahedra) {
      std::array<Corner, 4> corner;
      for (int a = 0; a < 4; ++a) {
        const int c = t[a], x = i + (c & 1), y = j + ((c >> 1) & 1), z = k + (c >> 2);
        corner[a] = {grid_.index(x, y, z), v[c], grid_.point(x, y, z)};
      }
      tetrahedron(corner);
    }
  }

  void tetrahedron(const std::array<Corner, 4>& c) {
    std::vector<Corner> in, out;
    for (const Corner& corner : c) (corner.value > 0.0 ? in : out).push_back(corner);
    if (in.empty() || out.empty()) return;
    std::vector<int> p;
    if (in.size() == 2) p = {between(in[0], out[0]), between(in[0], out[1]), between(in[1], out[1]), between(in[1], out[0])};
    else if (in.size() == 1) for (const Corner& o : out) p.push_back(between(in[0], o));
    else for (const Corner& i : in) p.push_back(between(i, out[0]));
    const Eigen::Vector3d outwards = out[0].x - in[0].x;
    for (std::size_t n = 2; n < p.size(); ++n) {
      std::array<int, 3> t = {p[0], p[n - 1], p[n]};
      const auto& x = surface_.vertices;
      if ((x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).dot(outwards) < 0.0) std::swap(t[1], t[2]);
      surface_.triangles.push_back(t);
    }
  }

  /// Share of the way from a to b at which the function is zero: false position, and once more between the point found and the end beyond. Straight
  /// between the ends a curved surface would lie too far inside by h^2/8 of its curvature.
  double zero_between(const Corner& a, const Corner& b) const {
    const double first = a.value / (a.value - b.value), there = level_((1.0 - first) * a.x + first * b.x);
    if (there == 0.0 || grid_.on_border(a.x) || grid_.on_border(b.x)) return first;
    const bool like_a = (there > 0.0) == (a.value > 0.0);
    return like_a ? first + (1.0 - first) * there / (there - b.value) : first * a.value / (a.value - there);
  }

  int between(const Corner& a, const Corner& b) {
    const auto key = std::pair(std::min(a.index, b.index), std::max(a.index, b.index));
    const auto [it, fresh] = at_.try_emplace(key, static_cast<int>(surface_.vertices.size()));
    if (fresh) {
      const double s = std::clamp(zero_between(a, b), 0.02, 0.98);  // no triangles without area
      surface_.vertices.push_back((1.0 - s) * a.x + s * b.x);
    }
    return it->second;
  }

  const LevelGrid& grid_;
  const std::function<double(const Eigen::Vector3d&)>& level_;
  TriangleSurface surface_;
  std::map<std::pair<std::size_t, std::size_t>, int> at_;
};

}  // namespace

TriangleSurface level_surface(const std::function<double(const Eigen::Vector3d&)>& level, const Box& box, double spacing) {
  return Marching(LevelGrid(level, box, spacing), level).take();
}

}  // namespace snug::mesh
