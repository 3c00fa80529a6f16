// The surface of a control net as the shape that a garment is placed in.
#pragma once

#include <Eigen/Core>

#include "cases/input/garment_spec.hpp"
#include "mesh/body/limb.hpp"
#include "mesh/formats/ring_net.hpp"
#include "mesh/garment/garment_mesh.hpp"

namespace snug::mesh {

/// Reads the net and subdivides it (four_point.hpp): between its points it is bilinear; beyond its ends it goes on upright. Throws
/// input::InputError as ring_net, and where the columns do not go up.
RingNet read_net_shape(const input::ShapeSpec& spec);

/// The point of the shape at height z (m) on the ray from `centre` at an `angle` (rad, from +x). Throws input::InputError where the shape does
/// not go once round the centre.
Eigen::Vector3d on_ray(const RingNet& shape, const Eigen::Vector2d& centre, double angle, double z);

/// Moves the nodes of a garment that lies on the limb out to the shape, along the normals of the skin, so that each stays over the place of
/// the skin where it lay. Where the shape lies below the node the node stays: cloth does not start in the body. Throws
/// input::InputError where a triangle would be stretched so that no homotopy starts from there (0.3 to 3), or a normal does not meet the shape.
void lay_on(const RingNet& shape, const Limb& limb, GarmentMesh& mesh);

}  // namespace snug::mesh
