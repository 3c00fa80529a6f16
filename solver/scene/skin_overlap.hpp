// Where the skin of a bent body has gone through itself: contact of the skin with itself is not computed.
#pragma once

#include "postproc/result.hpp"

namespace snug::solver {

/// Facets of the skin that lie behind others which face them: nearer than a cell, far apart at rest, of opposing normals. A sign, and no measure of depth.
/// `cell`: mean edge of the skin's facets, m.
int skin_overlap(const postproc::BodyResult& body, double cell);

}  // namespace snug::solver
