// B-forms over curved regions of their simplex.
#pragma once

#include "mesh/curves/b_form.hpp"
#include "mesh/curves/tensor_bezier.hpp"

namespace snug::mesh::curves {

/// P(xi(sigma)) for a B-form P of degree n and a map xi into its simplex, given by the Bézier form of its barycentric
/// coordinates (one row a corner of P): again of that form, by n times the degree (propositions 3.1 and 3.2). Throws
/// std::invalid_argument where the rows are not the corners.
BForm composed(const BForm& outer, const BForm& region);
TensorBezier composed(const BForm& outer, const TensorBezier& region);

/// The parallelogram between the middles of the edges u1u2, u2u3, u3u4, u4u1 of a tetrahedron, its section parallel to
/// u1u3 and u2u4: xi = (s, t, 1-s, 1-t)/2, so that xi_1 + xi_3 = xi_2 + xi_4 = 1/2. (In print the sum of all four is
/// 1/2, which is 1.)
TensorBezier parallelogram_section();

/// Coordinates of a point of the regular polygon with `corners` corners (cos, sin)(2 pi j / corners), in the simplex of
/// as many corners: the product of the distances from the edges that do not end at the corner, over the sum of these
/// products (Loop and DeRose 1989, "A multisided generalization of Bézier surfaces"). They sum to 1, reproduce the
/// point, and on an edge only its two ends count. In the square it is the manifold of tensor_coordinates; the source
/// names hexagon and octagon and gives no map.
Eigen::VectorXd polygon_coordinates(int corners, const Eigen::Vector2d& point);

}  // namespace snug::mesh::curves
