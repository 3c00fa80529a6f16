#include "mesh/garment/tube_girth.hpp"

#include <algorithm>

namespace snug::mesh {

TubeGirth::TubeGirth(const input::PatternSpec& tube) : mean_(tube.flat_circumference) {
  if (!tube.graduated() || tube.circumferences.empty()) return;
  std::vector<double> heights, girths;
  for (const input::GirthRow& row : tube.circumferences) heights.push_back(row.height), girths.push_back(row.girth);
  low_ = heights.front(), high_ = heights.back();
  rows_.emplace(heights, girths, Spline::Kind::monotone);
  constexpr int samples = 64;
  mean_ = 0.0;
  for (int i = 0; i < samples; ++i) mean_ += (*this)((i + 0.5) / samples * tube.length) / samples;
}

double TubeGirth::operator()(double height) const { return rows_ ? (*rows_)(std::clamp(height, low_, high_)) : mean_; }

}  // namespace snug::mesh
