// The surfaces of a scanned body, from the skin inwards, cut off at the same planes and made of even triangles.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mesh/surface/cutting.hpp"
#include "mesh/surface/smooth_surface.hpp"

namespace snug::mesh {

/// Named after the layer that lies outside of it: "skin", "fat", ..., and the innermost "bone".
struct NestedSurface {
  std::string name;
  std::unique_ptr<SmoothSurface> smooth;  ///< of the whole surface, before it was cut
  TriangleSurface mesh;                   ///< its vertices lie on the smooth one, those of the rims in their planes, too
  std::vector<std::vector<Rim>> rims;     ///< by cut; counter-clockwise about its normal
  int on_facets = 0;                      ///< vertices that stayed where the whole surface's facets are: the smooth ones would cut each other
  bool cuts_itself = false;
};

/// The polygon of a rim in the frame of its cut.
std::vector<Eigen::Vector2d> flat_rim(const NestedSurface& surface, const Rim& rim, const PlaneFrame& frame);

struct Smoothing {
  double radius = 0.0;                   ///< m
  double at_corners = scanned_corners;   ///< of SmoothSurface
};

/// Remeshes a surface that is cut already with edges of `size`, draws it onto the smooth one of `whole` and finds the rims. Throws
/// input::InputError (at `where`) for a rim that is of no cut: a hole.
NestedSurface nested_surface(const std::string& name, TriangleSurface whole, const TriangleSurface& kept, const std::vector<Cut>& cuts, double size,
                             const Smoothing& smoothing, const input::Location& where);

/// Of an inner surface: cuts it wherever it passes through the skin's sections, keeps what lies inside `skin` (closed).
TriangleSurface kept_inside(TriangleSurface whole, const std::vector<Cut>& cuts, const NestedSurface& skin, const SurfaceTree& inside);

/// A cut surface closed by fans over its loops.
TriangleSurface closed_flat(TriangleSurface surface);

}  // namespace snug::mesh
