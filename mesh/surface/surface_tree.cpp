#include "mesh/surface/surface_tree.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/alpha_wrap_3.h>
#include <fmt/format.h>

#include "mesh/surface/cgal_mesh.hpp"
#include "mesh/surface/mending.hpp"

namespace snug::mesh {

struct SurfaceTree::Tree {
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<CgalMesh>;
  using Boxes = CGAL::AABB_tree<CGAL::AABB_traits<CgalKernel, Primitive>>;
  explicit Tree(const TriangleSurface& surface) : mesh(cgal_mesh(surface)), boxes(faces(mesh).begin(), faces(mesh).end(), mesh), side(boxes) {
    boxes.accelerate_distance_queries();
  }
  CgalMesh mesh;
  Boxes boxes;
  CGAL::Side_of_triangle_mesh<CgalMesh, CgalKernel> side;
};

SurfaceTree::SurfaceTree(const TriangleSurface& surface) {
  if (surface.triangles.empty()) throw std::runtime_error("a surface without triangles");
  tree_ = std::make_unique<Tree>(surface);
}
SurfaceTree::~SurfaceTree() = default;
SurfaceTree::SurfaceTree(SurfaceTree&&) noexcept = default;

NearestPoint SurfaceTree::nearest(const Eigen::Vector3d& x) const {
  const auto [point, face] = tree_->boxes.closest_point_and_primitive(cgal_point(x));
  return {eigen_point(point), static_cast<int>(face)};
}

bool SurfaceTree::inside(const Eigen::Vector3d& x) const { return tree_->side(cgal_point(x)) != CGAL::ON_UNBOUNDED_SIDE; }

double SurfaceTree::signed_distance(const Eigen::Vector3d& x) const {
  const double distance = (nearest(x).x - x).norm();
  return inside(x) ? -distance : distance;
}

MendedSurface wrap(const TriangleSurface& surface, double alpha, double offset) {
  std::vector<CgalKernel::Point_3> points;
  std::vector<std::array<std::size_t, 3>> faces;
  for (const auto& x : surface.vertices) points.push_back(cgal_point(x));
  for (const auto& t : surface.triangles) faces.push_back({std::size_t(t[0]), std::size_t(t[1]), std::size_t(t[2])});
  CgalMesh wrapped;
  CGAL::alpha_wrap_3(points, faces, alpha, offset, wrapped);
  MendedSurface result{triangle_surface(wrapped), {}, {}};
  const std::vector<Eigen::Vector3d> outside = result.surface.vertices;
  const SurfaceTree tree(surface);
  std::vector<Eigen::Vector3d> on;
  for (const auto& x : outside) on.push_back(tree.nearest(x).x);
  result.surface.vertices = on;
  std::size_t stayed = 0;
  std::vector<char> back(outside.size(), 0);
  for (int round = 0; round < 20; ++round) {  // those that would cut each other stay outside
    const auto cuts = self_intersections(result.surface);
    if (cuts.empty()) break;
    for (const auto& pair : cuts)
      for (const int triangle : pair)
        for (const int v : result.surface.triangles[triangle])
          if (!back[v]) back[v] = 1, ++stayed, result.surface.vertices[v] = outside[v];
  }
  double most = 0.0;
  for (std::size_t v = 0; v < outside.size(); ++v) most = std::max(most, (result.surface.vertices[v] - on[v]).norm());
  result.mendings.push_back({fmt::format("surface wrapped: gaps narrower than {:.1f} mm closed; {} of {} vertices are up to {:.2f} mm outside the scan, the others on it",
                                         1e3 * alpha, stayed, outside.size(), 1e3 * most),
                             Eigen::Vector3d::Zero()});
  return result;
}

}  // namespace snug::mesh
