#include "mesh/garment/arc_length.hpp"

#include <algorithm>

#include "solver/fem/element.hpp"

namespace snug::mesh {

SectionArc::SectionArc(const Outline& outline, double z, double start) : outline_(outline), z_(z), start_(start) {
  for (int n = 0; n < panels; ++n)
    length_[n + 1] = length_[n] + length_between(start + static_cast<double>(n) / panels,
                                                 start + static_cast<double>(n + 1) / panels);
}

double SectionArc::length_between(double from, double to) const {
  // Two points: fourth order in the panel, about 1e-9 of the girth at 128 panels.
  static const fem::Rule rule = fem::quadrature(fem::Domain::line, 3);
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double length = 0.0;
  for (int q = 0; q < 2; ++q) length += half * rule.weights[q] * outline_.derivatives(middle + half * rule.points(0, q), z_).x_t.norm();
  return length;
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
