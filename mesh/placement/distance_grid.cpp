#include "mesh/placement/distance_grid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mesh/placement/triangle_bins.hpp"

namespace snug::mesh {

namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr double margin = 0.06;  // m, of the grid round the surface
constexpr float far_away = 1e3f;
constexpr double cells_exact = 2.5;

/// Twice the area of a, b, p seen along -x, from the smaller number of the two vertices, so that both triangles of an
/// edge find the same value.
double edge_value(const std::vector<Vector3d>& x, int a, int b, double y, double z) {
  if (a > b) return -edge_value(x, b, a, y, z);
  return (x[b].y() - x[a].y()) * (z - x[a].z()) - (x[b].z() - x[a].z()) * (y - x[a].y());
}

/// Where a line along x meets the surface, and the winding number's change there on the way to larger x.
struct Passage {
  double x = 0.0;
  int change = 0;
};

}  // namespace

DistanceGrid::DistanceGrid(const TriangleSurface& surface, double cell) : cell_(cell) {
  AlignedBox3d box;
  for (const Vector3d& vertex : surface.vertices) box.extend(vertex);
  origin_ = box.min() - Vector3d::Constant(margin);
  const Vector3d count = (box.sizes() + Vector3d::Constant(2.0 * margin)) / cell + Vector3d::Constant(2.0);
  if (!(count.prod() < 2e8)) throw std::invalid_argument("a grid of distances of more than 2e8 points");
  count_ = count.cast<int>();
  value_.assign(number(0, 0, count_.z()), far_away);
  const std::vector<char> inside = winding_signs(surface);
  sample_near(surface, cells_exact * cell_);
  sweep(known(inside, cells_exact * cell_));
  for (std::size_t n = 0; n < value_.size(); ++n)
    if (inside[n]) value_[n] = -value_[n];
}

/// 1 at grid points whose winding number is positive, by the passages of lines along x. The lines run some
/// micrometres beside the grid points, since vertices of drawn bodies often lie on round coordinates.
std::vector<char> DistanceGrid::winding_signs(const TriangleSurface& surface) const {
  constexpr double beside_y = 1.37e-6, beside_z = 2.11e-6;
  const auto line = [&](int j, int k) { return static_cast<std::size_t>(k) * count_[1] + j; };
  std::vector<std::vector<Passage>> passages(line(0, count_[2]));
  const auto& x = surface.vertices;
  for (const auto& t : surface.triangles) {
    const AlignedBox3d box = box_of({x[t[0]], x[t[1]], x[t[2]]});
    const auto first = [&](int a) { return std::max(0, static_cast<int>((box.min()[a] - origin_[a]) / cell_)); };
    const auto last = [&](int a) {
      return std::min(count_[a] - 1, static_cast<int>((box.max()[a] - origin_[a]) / cell_) + 1);
    };
    for (int k = first(2); k <= last(2); ++k)
      for (int j = first(1); j <= last(1); ++j) {
        const double y = origin_.y() + j * cell_ + beside_y, z = origin_.z() + k * cell_ + beside_z;
        const double w0 = edge_value(x, t[1], t[2], y, z), w1 = edge_value(x, t[2], t[0], y, z),
                     w2 = edge_value(x, t[0], t[1], y, z), sum = w0 + w1 + w2;
        const bool in = (w0 > 0.0 && w1 > 0.0 && w2 > 0.0) || (w0 < 0.0 && w1 < 0.0 && w2 < 0.0);
        if (!in) continue;
        // The projection turns counter-clockwise where the normal looks along +x: there the line leaves the body.
        passages[line(j, k)].push_back(
            {(w0 * x[t[0]].x() + w1 * x[t[1]].x() + w2 * x[t[2]].x()) / sum, sum > 0.0 ? -1 : 1});
      }
  }
  std::vector<char> inside(value_.size(), 0);
  for (int k = 0; k < count_[2]; ++k)
    for (int j = 0; j < count_[1]; ++j) {
      auto& along = passages[line(j, k)];
      std::sort(along.begin(), along.end(), [](const Passage& a, const Passage& b) { return a.x < b.x; });
      int winding = 0;
      std::size_t next = 0;
      for (int i = 0; i < count_[0]; ++i) {
        for (; next < along.size() && along[next].x < origin_.x() + i * cell_; ++next) winding += along[next].change;
        inside[number(i, j, k)] = winding > 0;
      }
    }
  return inside;
}

void DistanceGrid::sample_near(const TriangleSurface& surface, double band) {
  for (const auto& t : surface.triangles) {
    const Triangle3 triangle = {surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]};
    const AlignedBox3d box = box_of(triangle);
    Vector3i low, high;
    for (int a = 0; a < 3; ++a) {
      low[a] = std::max(0, static_cast<int>(std::ceil((box.min()[a] - band - origin_[a]) / cell_)));
      high[a] = std::min(count_[a] - 1, static_cast<int>(std::floor((box.max()[a] + band - origin_[a]) / cell_)));
    }
    for (int k = low.z(); k <= high.z(); ++k)
      for (int j = low.y(); j <= high.y(); ++j)
        for (int i = low.x(); i <= high.x(); ++i) {
          float& value = value_[number(i, j, k)];
          value = std::min(value, static_cast<float>(distance_to_triangle(point(i, j, k), triangle)));
        }
  }
}

/// The points whose sampled distance stands. Where a body cuts itself its walls have body on both sides and are no
/// skin: what was sampled from them is forgotten.
std::vector<char> DistanceGrid::known(const std::vector<char>& inside, double band) {
  std::vector<char> result(value_.size(), 0);
  for (int k = 0; k < count_[2]; ++k)
    for (int j = 0; j < count_[1]; ++j)
      for (int i = 0; i < count_[0]; ++i) {
        const std::size_t n = number(i, j, k);
        if (value_[n] > band) continue;
        const int reach = std::min(3, static_cast<int>(std::ceil(value_[n] / cell_)) + 1);
        if (inside[n] && !outside_near(inside, {i, j, k}, reach))
          value_[n] = far_away;
        else
          result[n] = 1;
      }
  return result;
}

bool DistanceGrid::outside_near(const std::vector<char>& inside, const Vector3i& at, int reach) const {
  for (int k = at.z() - reach; k <= at.z() + reach; ++k)
    for (int j = at.y() - reach; j <= at.y() + reach; ++j)
      for (int i = at.x() - reach; i <= at.x() + reach; ++i) {
        if (i < 0 || j < 0 || k < 0 || i >= count_[0] || j >= count_[1] || k >= count_[2]) return true;
        if (!inside[number(i, j, k)]) return true;
      }
  return false;
}

/// Solves |grad d| = 1 from what is fixed (fast sweeping: Zhao, Math. Comp. 74 (2005) 603): each of the eight orders
/// once.
void DistanceGrid::sweep(const std::vector<char>& fixed) {
  for (int order = 0; order < 8; ++order)
    for (int kk = 0; kk < count_[2]; ++kk)
      for (int jj = 0; jj < count_[1]; ++jj)
        for (int ii = 0; ii < count_[0]; ++ii) {
          const int i = order & 1 ? count_[0] - 1 - ii : ii, j = order & 2 ? count_[1] - 1 - jj : jj,
                    k = order & 4 ? count_[2] - 1 - kk : kk;
          const std::size_t n = number(i, j, k);
          if (!fixed[n]) value_[n] = std::min(value_[n], static_cast<float>(upwind(i, j, k)));
        }
}

double DistanceGrid::upwind(int i, int j, int k) const {
  const std::size_t n = number(i, j, k), row = count_[0], sheet = row * count_[1];
  const auto least = [&](int at, int count, std::size_t stride) -> double {
    return std::min(at > 0 ? value_[n - stride] : far_away, at + 1 < count ? value_[n + stride] : far_away);
  };
  double a = least(i, count_[0], 1), b = least(j, count_[1], row), c = least(k, count_[2], sheet);
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  const double h = cell_;
  if (a + h <= b) return a + h;
  const double two = 0.5 * (a + b + std::sqrt(std::max(0.0, 2.0 * h * h - (a - b) * (a - b))));
  if (two <= c) return two;
  const double sum = a + b + c;
  return (sum + std::sqrt(std::max(0.0, sum * sum - 3.0 * (a * a + b * b + c * c - h * h)))) / 3.0;
}

DistanceGrid::Corner DistanceGrid::corner(const Vector3d& p) const {
  Corner result;
  Vector3i at;
  for (int a = 0; a < 3; ++a) {
    const double q = (p[a] - origin_[a]) / cell_;
    at[a] = static_cast<int>(std::clamp(q, 0.0, static_cast<double>(count_[a] - 2)));
    result.share[a] = std::clamp(q - at[a], 0.0, 1.0);
  }
  result.first = number(at.x(), at.y(), at.z());
  const std::size_t row = count_[0], sheet = row * count_[1];
  for (int n = 0; n < 8; ++n)
    result.value[n] = value_[result.first + (n & 1 ? 1 : 0) + (n & 2 ? row : 0) + (n & 4 ? sheet : 0)];
  return result;
}

double DistanceGrid::distance(const Vector3d& p) const {
  const auto [first, s, v] = corner(p);
  const auto along = [&](int n) { return v[n] + s.x() * (v[n + 1] - v[n]); };
  const double low = along(0) + s.y() * (along(2) - along(0)), high = along(4) + s.y() * (along(6) - along(4));
  return low + s.z() * (high - low);
}

DistanceGrid::Value DistanceGrid::at(const Vector3d& p) const {
  const auto [first, s, v] = corner(p);
  const auto along = [&](int n) { return v[n] + s.x() * (v[n + 1] - v[n]); };
  const auto slope = [&](int n) { return v[n + 1] - v[n]; };
  const double low = along(0) + s.y() * (along(2) - along(0)), high = along(4) + s.y() * (along(6) - along(4));
  const double slope_low = slope(0) + s.y() * (slope(2) - slope(0)),
               slope_high = slope(4) + s.y() * (slope(6) - slope(4));
  Vector3d gradient(slope_low + s.z() * (slope_high - slope_low),
                    (1.0 - s.z()) * (along(2) - along(0)) + s.z() * (along(6) - along(4)), high - low);
  const double length = gradient.norm();
  return {low + s.z() * (high - low), length > 1e-9 * cell_ ? Vector3d(gradient / length) : Vector3d(Vector3d::Zero())};
}

}  // namespace snug::mesh
