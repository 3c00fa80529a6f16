// A limb from a scanned surface between two cut planes.
#pragma once

#include "mesh/body/body_mesh.hpp"

namespace snug::mesh {

/// Builds the limb of `spec.scan`: the surface is turned into the frame of the body and cut horizontally between the
/// heights of the two planes' points (the planes' normals only have to agree with the body's axis within 20 degrees).
/// The limb is the section nearest to the lower plane's point, followed upwards. Its radius about a smooth centre line
/// is filtered round and along with a Gaussian of standard deviation `smoothing_radius / 2` (0: a radius of two cell
/// widths) and interpolated by Fourier series and cubic splines. The bone is an ellipse that follows the centre line.
/// Limb::residual says how far the smooth skin is from the scan.
/// Throws input::InputError: everything that `read_scan` and `track_sections` refuse, a section that is not star-shaped
/// about the centre line, a bone of no girth or outside the skin.
Limb limb_from_scan(const input::BodySpec& spec);

/// The smooth geometry of a mesh's skin between `lower` and `upper` (m) or as far as the skin reaches, where it is cut;
/// sections, filter and interpolation as of a scan, with a smoothing radius of two skin cells. There is no bone.
/// Throws input::InputError (at `where`) where a height has no closed section or the sections do not make one limb.
Limb limb_from_skin(const BodyMesh& body, double lower, double upper, const input::Location& where);

}  // namespace snug::mesh
