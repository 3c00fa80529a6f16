#include "mesh/garment/arc_length.hpp"

#include <algorithm>
#include <cmath>

namespace snug::mesh {

SectionArc::SectionArc(const Outline& outline, double z, double start) : outline_(outline), z_(z), start_(start) {
  for (int n = 0; n < panels; ++n)
    length_[n + 1] = length_[n] + length_between(start + static_cast<double>(n) / panels,
                                                 start + static_cast<double>(n + 1) / panels);
}

double SectionArc::length_between(double from, double to) const {
  // Two-point Gauss rule: fourth order in the panel, about 1e-9 of the girth at 128 panels.
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from), d = half / std::sqrt(3.0);
  return half * (outline_.derivatives(middle - d, z_).x_t.norm() + outline_.derivatives(middle + d, z_).x_t.norm());
}

double SectionArc::turn_at(double share) const {
  const double wanted = share * girth();
  const auto above = std::upper_bound(length_.begin() + 1, length_.end() - 1, wanted);
  const auto panel = static_cast<double>(above - length_.begin() - 1);
  const double from = start_ + panel / panels, rest = wanted - *(above - 1);
  double turn = from + rest / (*above - *(above - 1)) / panels;
  for (int iteration = 0; iteration < 3; ++iteration)  // Newton; the first guess is linear in a small panel
    turn -= (length_between(from, turn) - rest) / outline_.derivatives(turn, z_).x_t.norm();
  return turn;
}

}  // namespace snug::mesh
