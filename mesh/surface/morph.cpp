#include "mesh/surface/morph.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "mesh/surface/cutting.hpp"

namespace snug::mesh {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Displacements = Eigen::Matrix<double, Eigen::Dynamic, 3>;

constexpr double beyond_an_end = 0.03;  // m
constexpr int rounds = 3;

/// A section of the surface: its girth, and what of the surface belongs to it.
struct Section {
  double girth = 0.0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> rim;
  std::vector<int> beyond;  ///< vertices that hang on there
};

Section section_of(const TriangleSurface& surface, const Ring& ring, const Eigen::Vector3d& point) {
  TriangleSurface rest = surface;
  const Cut cut{ring.name, point, ring.normal.normalized()};
  const std::vector<Rim> rims = cut_off(rest, cut, section_at_origin);
  if (rims.empty()) throw std::runtime_error(fmt::format("the plane of \"{}\" misses the surface", ring.name));
  Section section;
  for (std::size_t n = 0; n < rims.front().size(); ++n) {
    const Eigen::Vector3d &a = rest.vertices[rims.front()[n]], &b = rest.vertices[rims.front()[(n + 1) % rims.front().size()]];
    section.rim.push_back(a);
    section.girth += (b - a).norm(), section.middle += 0.5 * (a + b) * (b - a).norm();
  }
  section.middle /= section.girth;
  std::vector<char> stays(surface.vertices.size(), 0);
  for (const auto& t : rest.triangles)
    for (const int v : t)
      if (v < static_cast<int>(stays.size())) stays[v] = 1;
  for (std::size_t v = 0; v < stays.size(); ++v)
    if (!stays[v]) section.beyond.push_back(static_cast<int>(v));
  return section;
}

/// Ends of the edges that the rim crosses.
std::vector<int> vertices_at(const TriangleSurface& surface, const Ring& ring, const Section& section) {
  const Eigen::Vector3d normal = ring.normal.normalized();
  std::set<int> found;
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      const double over = normal.dot(surface.vertices[a] - ring.point), under = normal.dot(surface.vertices[b] - ring.point);
      if (over * under > 0.0 || over == under) continue;
      const Eigen::Vector3d x = surface.vertices[a] + over / (over - under) * (surface.vertices[b] - surface.vertices[a]);
      if (std::any_of(section.rim.begin(), section.rim.end(), [&](const Eigen::Vector3d& r) { return (r - x).squaredNorm() < 1e-10; })) found.insert(a), found.insert(b);
    }
  return {found.begin(), found.end()};
}

/// The Laplacian with cotangent weights, a row a vertex, over a third of the area about it.
std::pair<Sparse, Eigen::VectorXd> laplacian(const TriangleSurface& surface) {
  const auto count = static_cast<Eigen::Index>(surface.vertices.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd area = Eigen::VectorXd::Zero(count);
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
      const Eigen::Vector3d u = surface.vertices[a] - surface.vertices[c], v = surface.vertices[b] - surface.vertices[c];
      const double twice = u.cross(v).norm(), weight = 0.5 * std::max(u.dot(v), 0.0) / std::max(twice, 1e-12);
      area[c] += twice / 6.0;
      entries.emplace_back(a, b, weight), entries.emplace_back(b, a, weight), entries.emplace_back(a, a, -weight), entries.emplace_back(b, b, -weight);
    }
  Sparse matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return {matrix, area};
}

/// Displacements of all vertices from those of some.
class Smooth {
 public:
  Smooth(const TriangleSurface& surface, const std::vector<char>& fixed) : number_(fixed.size()) {
    const auto [laplace, area] = laplacian(surface);
    const Eigen::VectorXd over = (area.array() + 1e-12).inverse();
    energy_ = laplace.transpose() * over.asDiagonal() * laplace;
    int free = 0, held = 0;
    for (std::size_t v = 0; v < fixed.size(); ++v) number_[v] = fixed[v] ? -1 - held++ : free++;
    std::vector<Eigen::Triplet<double>> inner, border;
    for (int column = 0; column < energy_.outerSize(); ++column)
      for (Sparse::InnerIterator entry(energy_, column); entry; ++entry) {
        const int row = number_[entry.row()], other = number_[column];
        if (row >= 0 && other >= 0) inner.emplace_back(row, other, entry.value());
        if (row >= 0 && other < 0) border.emplace_back(row, -1 - other, entry.value());
      }
    Sparse matrix(free, free);
    border_.resize(free, held);
    matrix.setFromTriplets(inner.begin(), inner.end());
    border_.setFromTriplets(border.begin(), border.end());
    factor_.compute(matrix);
    if (factor_.info() != Eigen::Success) throw std::runtime_error("the surface falls into parts that no ring holds");
  }

  /// `given` has a row a vertex; those that are not fixed are filled in.
  void fill(Displacements& given) const {
    Displacements held(border_.cols(), 3);
    for (std::size_t v = 0; v < number_.size(); ++v)
      if (number_[v] < 0) held.row(-1 - number_[v]) = given.row(static_cast<Eigen::Index>(v));
    const Displacements free = factor_.solve(-(border_ * held));
    for (std::size_t v = 0; v < number_.size(); ++v)
      if (number_[v] >= 0) given.row(static_cast<Eigen::Index>(v)) = free.row(number_[v]);
  }

 private:
  Sparse energy_, border_;
  std::vector<int> number_;  ///< free ones from 0 on, fixed ones from -1 downwards
  Eigen::SimplicialLDLT<Sparse> factor_;
};

}  // namespace

std::vector<RingGirth> morph(TriangleSurface& surface, std::vector<Ring> rings) {
  const TriangleSurface before = surface;
  std::vector<char> fixed(before.vertices.size(), 0);
  std::vector<Section> sections;
  std::vector<std::vector<int>> at, beyond;
  std::vector<RingGirth> girths;
  for (const Ring& ring : rings) {
    sections.push_back(section_of(before, ring, ring.point));
    at.push_back(vertices_at(before, ring, sections.back()));
    beyond.emplace_back();
    for (const int v : sections.back().beyond)
      if (ring.end && ring.normal.normalized().dot(before.vertices[v] - ring.point) > beyond_an_end) beyond.back().push_back(v), fixed[v] = 1;
    for (const int v : at.back()) fixed[v] = 1;
    girths.push_back({ring.name, sections.back().girth, 0.0, ring.asked});
  }
  const Smooth smooth(before, fixed);
  for (int round = 0; round < rounds; ++round) {
    Displacements displacement = Displacements::Zero(static_cast<Eigen::Index>(fixed.size()), 3);
    for (std::size_t r = 0; r < rings.size(); ++r) {
      const Eigen::Vector3d normal = rings[r].normal.normalized();
      for (const int v : beyond[r]) displacement.row(v) = rings[r].shift.transpose();
      for (const int v : at[r]) {
        const Eigen::Vector3d arm = before.vertices[v] - sections[r].middle;
        displacement.row(v) = ((rings[r].factor - 1.0) * (arm - normal.dot(arm) * normal) + rings[r].shift).transpose();
      }
    }
    smooth.fill(displacement);
    for (std::size_t v = 0; v < fixed.size(); ++v) surface.vertices[v] = before.vertices[v] + displacement.row(static_cast<Eigen::Index>(v)).transpose();
    for (std::size_t r = 0; r < rings.size(); ++r) {
      girths[r].is = section_of(surface, rings[r], rings[r].point + rings[r].shift).girth;
      if (rings[r].asked) rings[r].factor *= *rings[r].asked / girths[r].is;
    }
  }
  return girths;
}

}  // namespace snug::mesh
