// Where a skin has two limbs side by side, as legs below a trunk.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "postproc/report/region.hpp"

namespace snug::postproc::report {

/// The limb of each node (along z): 0 where the skin is one tube, or hangs together otherwise than in two; 1 on the limb on the side of +x, 2 on the other.
/// By slices of the height in which the triangles hang together in two pieces of like size.
std::vector<int> limbs_of(const std::vector<Eigen::Vector3d>& nodes, const std::vector<Triangle>& triangles);

}  // namespace snug::postproc::report
