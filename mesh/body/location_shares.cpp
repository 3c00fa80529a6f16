#include "mesh/body/location_shares.hpp"

#include <Eigen/Geometry>

#include <algorithm>

#include "mesh/body/section_centres.hpp"

namespace snug::mesh {

namespace {

using Points = std::vector<Eigen::Vector3d>;

/// Barycentric coordinates of the middles of the equal triangles that a triangle is cut into, each of its sides `cuts` times.
Points middles(int cuts) {
  Points found;
  const auto add = [&](double a, double b) { found.push_back(Eigen::Vector3d(cuts - a - b, a, b) / cuts); };
  for (int i = 0; i < cuts; ++i)
    for (int j = 0; i + j < cuts; ++j) {
      add(i + 1.0 / 3, j + 1.0 / 3);
      if (i + j + 1 < cuts) add(i + 2.0 / 3, j + 2.0 / 3);
    }
  return found;
}

/// One triangle: the locations at its points, coarse ones if those agree, fine ones where a border runs through it.
class Sampled {
 public:
  Sampled(const BodyMesh& mesh, const LocationAt& at, const std::array<int, 3>& triangle) {
    static const Points coarse = middles(4), fine = middles(12);
    Eigen::Matrix3d corner;
    for (int c = 0; c < 3; ++c) corner.col(c) = mesh.nodes[triangle[c]];
    const auto look = [&](const Points& points) {
      hats = &points;
      location.clear();
      for (const Eigen::Vector3d& hat : points) location.push_back(at(corner * hat, triangle));
    };
    look(coarse);
    if (std::any_of(location.begin(), location.end(), [&](int l) { return l != location.front(); })) look(fine);
    weight = (corner.col(1) - corner.col(0)).cross(corner.col(2) - corner.col(0)).norm() / (2.0 * static_cast<double>(location.size()));
  }
  const Points* hats = nullptr;
  std::vector<int> location;
  double weight = 0.0;  ///< m2 a point
};

}  // namespace

std::vector<std::vector<double>> location_shares(const BodyMesh& mesh, std::size_t locations, const LocationAt& at) {
  std::vector<std::vector<double>> inside(locations, std::vector<double>(mesh.nodes.size(), 0.0));
  std::vector<double> all(mesh.nodes.size(), 0.0);
  for (const auto& triangle : triangulated_nodes(mesh)) {
    const Sampled sampled(mesh, at, triangle);
    for (std::size_t p = 0; p < sampled.location.size(); ++p)
      for (int c = 0; c < 3; ++c) {
        const double own = sampled.weight * (*sampled.hats)[p][c];
        all[triangle[c]] += own;
        if (sampled.location[p] >= 0) inside[sampled.location[p]][triangle[c]] += own;
      }
  }
  for (std::vector<double>& share : inside)
    for (std::size_t n = 0; n < share.size(); ++n)
      if (share[n] > 0.0) share[n] /= all[n];
  return inside;
}

}  // namespace snug::mesh
