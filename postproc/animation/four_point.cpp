#include "postproc/animation/four_point.hpp"

#include <algorithm>
#include <stdexcept>

namespace snug::postproc::animation {

namespace {

/// Lagrange's weights at time t of the frames first ... first + count - 1.
Eigen::VectorXd weights(const std::vector<double>& times, std::size_t first, std::size_t count, double t) {
  Eigen::VectorXd result = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(count));
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b)
      if (a != b) result[a] *= (t - times[first + b]) / (times[first + a] - times[first + b]);
  return result;
}

}  // namespace

Eigen::VectorXd between(const Frames& frames, std::size_t i) {
  const std::size_t n = frames.times.size();
  if (i + 1 >= n) throw std::invalid_argument("between: no frame behind this one");
  const std::size_t count = std::min<std::size_t>(4, n), first = std::min(i == 0 ? 0 : i - 1, n - count);
  const Eigen::VectorXd weight = weights(frames.times, first, count, 0.5 * (frames.times[i] + frames.times[i + 1]));
  Eigen::VectorXd result = Eigen::VectorXd::Zero(frames.values[i].size());
  for (std::size_t k = 0; k < count; ++k) result += weight[k] * frames.values[first + k];
  return result;
}

Frames fill_in(Frames frames, const Distance& distance, double step, std::size_t most) {
  std::vector<double> gaps;
  const auto gap = [&](std::size_t i) { return distance(frames.values[i], frames.values[i + 1]); };
  for (std::size_t i = 0; i + 1 < frames.times.size(); ++i) gaps.push_back(gap(i));
  while (!gaps.empty() && frames.times.size() < most) {
    const auto widest = std::max_element(gaps.begin(), gaps.end());
    if (*widest <= step) break;
    const std::size_t i = widest - gaps.begin();
    const double time = 0.5 * (frames.times[i] + frames.times[i + 1]);
    Eigen::VectorXd values = between(frames, i);
    frames.times.insert(frames.times.begin() + i + 1, time);
    frames.values.insert(frames.values.begin() + i + 1, std::move(values));
    gaps[i] = gap(i);
    gaps.insert(gaps.begin() + i + 1, gap(i + 1));
  }
  return frames;
}

}  // namespace snug::postproc::animation
