#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <utility>

#include "mesh/body/import_shell.hpp"
#include "solver/fem/union_find.hpp"

namespace snug::mesh {

namespace {

/// Of a triangle's corners: its middle and its area along its normal.
struct Flat {
  Eigen::Vector3d middle, area;
};

Flat flat(const BodyMesh& body, const FacetNodeNumbers& facet) {
  const Eigen::Vector3d &a = body.nodes[facet[0]], &b = body.nodes[facet[1]], &c = body.nodes[facet[2]];
  return {(a + b + c) / 3.0, 0.5 * (b - a).cross(c - a)};
}

struct PieceOfSkin {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero(), closure = Eigen::Vector3d::Zero();  // sums of |dA| x and of dA
  double area = 0.0, flux = 0.0;                                                        // of |dA| and of x . dA

  /// Three times the volume about its middle: positive where normals point away from it.
  bool outwards() const { return flux - (moment / area).dot(closure) > 0.0; }
};

}  // namespace

void turn_skin_outwards(BodyMesh& body) {
  fem::UnionFind joined(body.nodes.size());
  for (const FacetNodeNumbers& facet : body.skin_facets)
    for (int a = 1; a < 6; ++a) joined.merge(facet[0], facet[a]);
  std::map<int, PieceOfSkin> pieces;
  for (const FacetNodeNumbers& facet : body.skin_facets) {
    PieceOfSkin& piece = pieces[joined.find(facet[0])];
    const auto [middle, area] = flat(body, facet);
    piece.moment += area.norm() * middle, piece.area += area.norm(), piece.closure += area, piece.flux += middle.dot(area);
  }
  for (FacetNodeNumbers& facet : body.skin_facets)
    if (!pieces.at(joined.find(facet[0])).outwards()) std::swap(facet[1], facet[2]), std::swap(facet[3], facet[5]);
}

}  // namespace snug::mesh
