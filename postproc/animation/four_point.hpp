// In-between frames by four-point interpolatory subdivision.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <vector>

namespace snug::postproc::animation {

/// Key frames: the time of each (ascending, any unit) and its values in one column.
struct Frames {
  std::vector<double> times;
  std::vector<Eigen::VectorXd> values;
};

/// Values midway in time between frames i and i + 1: the cubic through the two frames before and the two behind it; at
/// an end the cubic through the four frames there, with fewer than four frames the polynomial through all. Evenly
/// spaced frames have the weights (-1, 9, 9, -1)/16, at the ends (5, 15, -5, 1)/16 (Dubuc, J. Math. Anal. Appl. 114
/// (1986) 185-204; Dyn, Gregory & Levin, CAGD 4 (1987) 257-268). Reproduces cubics in time. Needs two frames.
Eigen::VectorXd between(const Frames& frames, std::size_t i);

/// How far two frames are apart, in the unit of `step`.
using Distance = std::function<double(const Eigen::VectorXd&, const Eigen::VectorXd&)>;

/// Puts a frame in the widest gap (by `distance`) until there are `most` frames or no gap is wider than `step`. The
/// given frames stay as they are.
Frames fill_in(Frames frames, const Distance& distance, double step, std::size_t most);

}  // namespace snug::postproc::animation
