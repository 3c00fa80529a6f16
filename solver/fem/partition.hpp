// Elements shared out among ranks.
#pragma once

#include <vector>

namespace snug::fem {

/// The part of each element, by METIS. Elements that share a node are neighbours; METIS makes parts of about one size and cuts
/// as few pairs of neighbours as it can. `nodes`: of each element, numbered from 0.
std::vector<int> partition(const std::vector<std::vector<int>>& nodes, int parts);

}  // namespace snug::fem
